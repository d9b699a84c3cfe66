// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/light_field.h"

namespace hogel::render {

/// For renderers that go through a light field by epipolar planes: all rays of one place of hogels and one direction
/// along a slow axis lie in a plane, in which hogels and directions follow each other along a fast axis. On the front,
/// the top and the bottom the slow axis is t and V, the fast one s and U; on the left and the right the other way
/// round, for there the plane of fixed s and U holds all t and V. [K] 5.3.2 and docs/notation.md, section 2.
class RowAxes {
  public:
    explicit RowAxes(const LightFieldGrid& grid)
        : grid_(grid), turned_(grid.face() == Face::left || grid.face() == Face::right) {}

    bool turned() const { return turned_; }

    std::size_t slow_hogels(const HogelRange& range) const { return turned_ ? range.ns : range.nt; }
    std::size_t fast_hogels(const HogelRange& range) const { return turned_ ? range.nt : range.ns; }
    std::size_t slow_directions() const { return turned_ ? grid_.directions_u : grid_.directions_v; }
    std::size_t fast_directions() const { return turned_ ? grid_.directions_v : grid_.directions_u; }

    /// Where hogels lie: s or t.
    double slow_hogel(const HogelRange& range, std::size_t i) const {
        return turned_ ? grid_.s(static_cast<double>(range.s0 + i)) : grid_.t(static_cast<double>(range.t0 + i));
    }
    double fast_hogel(const HogelRange& range, std::size_t i) const {
        return turned_ ? grid_.t(static_cast<double>(range.t0 + i)) : grid_.s(static_cast<double>(range.s0 + i));
    }
    /// U or V of directions, and the way back.
    double slow_direction(std::size_t i) const {
        return turned_ ? grid_.u(static_cast<double>(i)) : grid_.v(static_cast<double>(i));
    }
    double fast_direction(std::size_t i) const {
        return turned_ ? grid_.v(static_cast<double>(i)) : grid_.u(static_cast<double>(i));
    }
    double slow_index(double direction) const { return turned_ ? grid_.column(direction) : grid_.row(direction); }
    double fast_index(double direction) const { return turned_ ? grid_.row(direction) : grid_.column(direction); }
    /// Which way fast hogels are numbered: +1 if with growing s, −1 if against t.
    double fast_sign() const { return turned_ ? -1 : 1; }

    /// Hogel (slow, fast) and direction (slow, fast) as the light field numbers them.
    struct Sample {
        std::size_t t, s, v, u;
    };
    Sample sample(std::size_t slow, std::size_t fast, std::size_t slow_dir, std::size_t fast_dir) const {
        return turned_ ? Sample{fast, slow, fast_dir, slow_dir} : Sample{slow, fast, slow_dir, fast_dir};
    }

    /// A point as seen from the hogels at `slow_hogel`: along the fast axis (s or t, not relative to a hogel), along
    /// the slow axis and forward in the face's picture.
    struct Seen {
        double fast, slow, forward;
    };
    Seen seen(Vec3 position, double slow_hogel) const {
        const Vec3 way{turned_ ? position.x - slow_hogel : position.x, turned_ ? position.y : position.y - slow_hogel,
                       -position.z};
        const Vec3 q = to_face(grid_.face(), way);
        return turned_ ? Seen{q.y, q.x, q.z} : Seen{q.x, q.y, q.z};
    }

  private:
    LightFieldGrid grid_;
    bool turned_;
};

}  // namespace hogel::render
