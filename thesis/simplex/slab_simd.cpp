// SPDX-License-Identifier: Apache-2.0
// Vector twins of slab.cpp, compiled for every SIMD target and selected at the first call.
#include <bit>
#include <cstring>

#include "hogel/core/simd_targets-inl.h"
#include "thesis/simplex/slab.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::simplex::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// Plain version for vectors with a single lane of doubles, which have no half vector of floats.
std::size_t FindInRows(const TriangleBlock& block, const SlabRows& rows, std::uint32_t* found) {
    return find_in_rows_plain(block, rows, found);
}

void DrawBands(std::span<const Band> bands, const SlabRays& rays, std::uint64_t* words, Visits& visits) {
    draw_bands_plain(bands, rays, words, visits);
}
#else
using FloatTag = hn::CappedTag<float, TriangleBlock::size>;

std::size_t FindInRows(const TriangleBlock& block, const SlabRows& rows, std::uint32_t* found) {
    const FloatTag d;
    const hn::RebindToUnsigned<FloatTag> du;
    const auto slope = hn::Set(d, rows.slope), margin = hn::Set(d, rows.margin(block)),
               last_row = hn::Set(d, rows.last);
    std::size_t count = 0;
    for (std::size_t i = 0; i < TriangleBlock::size; i += hn::Lanes(d)) {
        const auto row_of = [&](std::size_t corner) HWY_ATTR {
            return hn::Sub(hn::Load(d, block.row[corner] + i), hn::Mul(slope, hn::Load(d, block.depth[corner] + i)));
        };
        const auto a = row_of(0), b = row_of(1), c = row_of(2);
        const auto low = hn::Min(hn::Min(a, b), c), high = hn::Max(hn::Max(a, b), c);
        const auto first = hn::Ceil(hn::Max(hn::Sub(low, margin), hn::Zero(d)));
        const auto last = hn::Floor(hn::Min(hn::Add(high, margin), last_row));
        // At most as many are found as were tested, so a full vector fits.
        const auto may_cover = hn::RebindMask(du, hn::Le(first, last));
        hn::StoreU(hn::Compress(hn::Load(du, block.triangle + i), may_cover), du, found + count);
        count += hn::CountTrue(du, may_cover);
    }
    return count;
}

#if HWY_HAVE_SCALABLE
using Tag = hn::FixedTag<double, 2>;
#else
using Tag = hn::ScalableTag<double>;
#endif
// Vectors with as many floats or whole numbers as doubles.
using FloatHalf = hn::Rebind<float, Tag>;
using WholeHalf = hn::Rebind<std::int32_t, Tag>;
using Doubles = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Indices of words have 32 bits here.
constexpr std::size_t max_words = std::size_t{1} << 31;

// Queue of samples that meet triangles, with their words, so that no branch depends on the number of hits in a vector.
// Vectors of 32 bits are compressed, because Highway needs a table for 64 bits.
class Hits {
  public:
    explicit Hits(std::uint64_t* words) : words_(words) {}

    // Adds the lanes that meet the triangle at finite depths.
    HWY_INLINE void add(hn::Vec<FloatHalf> depths, hn::Vec<WholeHalf> at, std::uint32_t triangle) {
        const FloatHalf df;
        const WholeHalf d;
        const auto hit = hn::Lt(depths, hn::Set(df, std::numeric_limits<float>::infinity()));
        const auto mask = hn::RebindMask(d, hit);
        const auto bits = hn::BitCast(d, hn::Add(depths, hn::Zero(df)));  // −0 is 0
        constexpr std::int32_t sign = std::numeric_limits<std::int32_t>::min();
        const auto ordered = hn::Xor(bits, hn::Or(hn::BroadcastSignBit(bits), hn::Set(d, sign)));
        static_assert(std::endian::native == std::endian::little, "a word's lower half comes first");
        hn::StoreInterleaved2(hn::Set(d, static_cast<std::int32_t>(triangle)), hn::Compress(ordered, mask), d,
                              seen_[count_]);
        hn::StoreU(hn::Compress(at, mask), d, at_ + count_);
        count_ += hn::CountTrue(df, hit);
        if (count_ >= max_queued) draw();
    }

    HWY_NOINLINE void draw() {
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint64_t seen;
            std::memcpy(&seen, seen_[i], sizeof(seen));
            std::uint64_t& word = words_[at_[i]];
            word = std::min(word, seen);
        }
        count_ = 0;
    }

  private:
    static constexpr std::size_t max_queued = 512;

    std::uint64_t* words_;
    std::size_t count_ = 0;
    HWY_ALIGN std::int32_t at_[max_queued + hn::MaxLanes(Tag())];
    HWY_ALIGN std::int32_t seen_[max_queued + hn::MaxLanes(Tag())][2];  // halves of words
};

// A triangle in all lanes, projected along one direction per lane.
class TriangleLanes {
  public:
    HWY_INLINE TriangleLanes(const Band& band, Doubles slopes) : band_(band) {
        const Tag d;
        for (std::size_t i = 0; i < 3; ++i)
            fast_[i] = hn::Sub(hn::Set(d, band.fast[i]), hn::Mul(slopes, hn::Set(d, band.depth[i])));
    }

    // Computes ObliqueTriangle::at() for the hogels at these coordinates. Transposed axes change the sign of all three
    // weights and of the area, exactly. The caller handles lanes in which a ray meets an edge.
    struct Hit {
        Mask inside, on_edge;
        Doubles depth;
    };
    HWY_INLINE Hit at(Doubles hogels, Mask active, bool without_positive, bool without_negative) const {
        const Tag d;
        const Doubles zero = hn::Zero(d);
        const Doubles x0 = hn::Sub(fast_[0], hogels), x1 = hn::Sub(fast_[1], hogels), x2 = hn::Sub(fast_[2], hogels);
        const Doubles y0 = hn::Set(d, band_.slow[0]), y1 = hn::Set(d, band_.slow[1]), y2 = hn::Set(d, band_.slow[2]);
        const Doubles w0 = hn::Sub(hn::Mul(x1, y2), hn::Mul(y1, x2));
        const Doubles w1 = hn::Sub(hn::Mul(x2, y0), hn::Mul(y2, x0));
        const Doubles w2 = hn::Sub(hn::Mul(x0, y1), hn::Mul(y0, x1));
        const Doubles low = hn::Min(hn::Min(w0, w1), w2), high = hn::Max(hn::Max(w0, w1), w2);
        Mask positive = hn::And(active, hn::Ge(low, zero)), negative = hn::And(active, hn::Le(high, zero));
        if (without_positive) positive = hn::AndNot(positive, positive);
        if (without_negative) negative = hn::AndNot(negative, negative);
        const Mask edge = hn::Or(hn::And(positive, hn::Eq(low, zero)), hn::And(negative, hn::Eq(high, zero)));
        const Mask inside = hn::AndNot(edge, hn::Or(positive, negative));
        const Doubles area = hn::Add(hn::Add(w0, w1), w2);
        const Doubles sum =
            hn::Add(hn::Add(hn::Mul(w0, hn::Set(d, band_.depth[0])), hn::Mul(w1, hn::Set(d, band_.depth[1]))),
                    hn::Mul(w2, hn::Set(d, band_.depth[2])));
        return {inside, edge, hn::Div(sum, area)};
    }

  private:
    const Band& band_;
    Doubles fast_[3];
};

class BandDrawer {
  public:
    BandDrawer(const SlabRays& rays, std::uint64_t* words, Visits& visits)
        : rays_(rays), words_(words), visits_(visits), hits_(words) {
        const bool fronts = rays.fronts_only(), transposed = rays.axes().transposed();
        without_negative_ = fronts && !transposed;
        without_positive_ = fronts && transposed;
    }

    void finish() { hits_.draw(); }

    HWY_INLINE void draw(const Band& band) {
        const Tag d;
        const Doubles margin = hn::Set(d, render::scan_margin), zero = hn::Zero(d), one = hn::Set(d, 1.0);
        const Doubles last_hogel = hn::Set(d, static_cast<double>(rays_.hogels() - 1));
        for (std::size_t k = band.columns.first; k < band.columns.end; k += hn::Lanes(d)) {
            const Doubles steps = hn::LoadU(d, rays_.steps() + k);
            Doubles low = column_of(band.points[0], steps), high = low;
            for (std::size_t i = 1; i < band.count; ++i) {
                const Doubles s = column_of(band.points[i], steps);
                low = hn::Min(low, s);
                high = hn::Max(high, s);
            }
            // samples_between()
            const Doubles last = hn::Floor(hn::Min(hn::Add(high, margin), last_hogel));
            Doubles hogel = hn::Ceil(hn::Max(hn::Sub(low, margin), zero));
            Mask active = hn::And(hn::Le(hogel, last), hn::FirstN(d, band.columns.end - k));
            if (hn::AllFalse(d, active)) continue;
            visits_.slices += hn::CountTrue(d, active);
            const TriangleLanes triangle(band, hn::LoadU(d, rays_.slopes() + k));
            do {
                visits_.samples += hn::CountTrue(d, active);
                see(band, triangle, hogel, k, active);
                hogel = hn::Add(hogel, one);
                active = hn::And(active, hn::Le(hogel, last));
            } while (!hn::AllFalse(d, active));
        }
    }

  private:
    static HWY_INLINE Doubles column_of(const SegmentPoint& point, Doubles steps) {
        const Tag d;
        return hn::Sub(hn::Set(d, point.x), hn::Mul(steps, hn::Set(d, point.depth)));
    }

    HWY_INLINE void see(const Band& band, const TriangleLanes& triangle, Doubles hogel, std::size_t k, Mask active) {
        const Tag d;
        const Doubles at =
            hn::Mul(hn::Add(hn::Set(d, rays_.first_fast()), hn::Mul(hogel, hn::Set(d, rays_.fast_sign()))),
                    hn::Set(d, rays_.pitch()));
        const auto [inside, on_edge, depth] = triangle.at(at, active, without_positive_, without_negative_);
        if (!hn::AllFalse(d, on_edge)) see_one_by_one(band, hogel, k, on_edge);
        const Doubles nowhere = hn::Set(d, std::numeric_limits<double>::infinity());
        const Doubles number = hn::Add(hn::Mul(hogel, hn::Set(d, static_cast<double>(rays_.directions()))),
                                       hn::Iota(d, static_cast<double>(rays_.word(band.row, 0, k))));
        hits_.add(hn::DemoteTo(FloatHalf(), hn::IfThenElse(inside, depth, nowhere)), hn::DemoteTo(WholeHalf(), number),
                  band.triangle);
    }

    HWY_NOINLINE void see_one_by_one(const Band& band, Doubles hogel, std::size_t k, Mask mask) {
        const Tag d;
        HWY_ALIGN double hogels[hn::MaxLanes(Tag())], chosen[hn::MaxLanes(Tag())];
        hn::Store(hogel, d, hogels);
        hn::Store(hn::IfThenElseZero(mask, hn::Set(d, 1.0)), d, chosen);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i)
            if (chosen[i] != 0) see_sample(band, rays_, static_cast<std::size_t>(hogels[i]), k + i, words_);
    }

    const SlabRays& rays_;
    std::uint64_t* words_;
    Visits& visits_;
    Hits hits_;
    bool without_positive_, without_negative_;
};

void DrawBands(std::span<const Band> bands, const SlabRays& rays, std::uint64_t* words, Visits& visits) {
    if (rays.word(rays.rows(), 0, 0) > max_words) return draw_bands_plain(bands, rays, words, visits);
    BandDrawer drawer(rays, words, visits);
    for (const Band& band : bands) drawer.draw(band);
    drawer.finish();
}
#endif

}  // namespace hogel::simplex::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::simplex {
HOGEL_DISPATCH(find_in_rows, FindInRows);
HOGEL_DISPATCH(draw_bands, DrawBands);
}  // namespace hogel::simplex
