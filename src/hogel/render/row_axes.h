// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/light_field.h"

namespace hogel::render {

/// Axes of epipolar planes, for renderers that process a light field plane by plane. An epipolar plane contains all
/// rays of one hogel position and one direction along a slow axis; hogels and directions vary along a fast axis. On the
/// front, the top and the bottom the slow axis is t and V, the fast one s and U. On the left and the right they are
/// transposed, because the plane of fixed s and U holds all t and V. Source: [K] 5.3.2; docs/notation.md, section 2.
class RowAxes {
  public:
    explicit RowAxes(const LightFieldGrid& grid)
        : grid_(grid), transposed_(grid.face() == Face::left || grid.face() == Face::right) {}

    /// Returns whether the slow axis is s and U.
    bool transposed() const { return transposed_; }

    std::size_t slow_hogels(const HogelRange& range) const { return transposed_ ? range.ns : range.nt; }
    std::size_t fast_hogels(const HogelRange& range) const { return transposed_ ? range.nt : range.ns; }
    std::size_t slow_directions() const { return transposed_ ? grid_.directions_u : grid_.directions_v; }
    std::size_t fast_directions() const { return transposed_ ? grid_.directions_v : grid_.directions_u; }

    /// Returns the coordinate, s or t, of hogel i of a range along an axis.
    double slow_hogel(const HogelRange& range, std::size_t i) const {
        return transposed_ ? grid_.s(static_cast<double>(range.s0 + i)) : grid_.t(static_cast<double>(range.t0 + i));
    }
    double fast_hogel(const HogelRange& range, std::size_t i) const {
        return transposed_ ? grid_.t(static_cast<double>(range.t0 + i)) : grid_.s(static_cast<double>(range.s0 + i));
    }
    /// Returns the coordinate, U or V, of direction i along an axis; and the inverse.
    double slow_direction(std::size_t i) const {
        return transposed_ ? grid_.u(static_cast<double>(i)) : grid_.v(static_cast<double>(i));
    }
    double fast_direction(std::size_t i) const {
        return transposed_ ? grid_.v(static_cast<double>(i)) : grid_.u(static_cast<double>(i));
    }
    double slow_index(double direction) const { return transposed_ ? grid_.column(direction) : grid_.row(direction); }
    double fast_index(double direction) const { return transposed_ ? grid_.row(direction) : grid_.column(direction); }
    /// Returns +1 if the indices of fast hogels increase with their coordinate (s), −1 if they decrease (t).
    double fast_sign() const { return transposed_ ? -1 : 1; }

    /// Indices in the light field of hogel (slow, fast) and direction (slow, fast).
    struct Sample {
        std::size_t t, s, v, u;
    };
    Sample sample(std::size_t slow, std::size_t fast, std::size_t slow_dir, std::size_t fast_dir) const {
        return transposed_ ? Sample{fast, slow, fast_dir, slow_dir} : Sample{slow, fast, slow_dir, fast_dir};
    }

    /// Point seen from the hogels at `slow_hogel`: its coordinate along the fast axis (s or t, not relative to a
    /// hogel), along the slow axis relative to the hogels, and forward in the face's frame.
    struct Seen {
        double fast, slow, forward;
    };
    Seen seen(Vec3 position, double slow_hogel) const {
        const Vec3 relative{transposed_ ? position.x - slow_hogel : position.x,
                            transposed_ ? position.y : position.y - slow_hogel, -position.z};
        const Vec3 q = to_face(grid_.face(), relative);
        return transposed_ ? Seen{q.y, q.x, q.z} : Seen{q.x, q.y, q.z};
    }

  private:
    LightFieldGrid grid_;
    bool transposed_;
};

}  // namespace hogel::render
