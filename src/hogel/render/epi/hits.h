// SPDX-License-Identifier: Apache-2.0
// Queues of samples that spans (may) cover, for draw_simd.cpp. Included after hwy/highway.h for every SIMD target.
#if defined(HOGEL_RENDER_EPI_HITS) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_RENDER_EPI_HITS
#undef HOGEL_RENDER_EPI_HITS
#else
#define HOGEL_RENDER_EPI_HITS
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstring>
#include <limits>

#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/lane_bits.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors of at most one cell of directions.
using FloatTag = hn::CappedTag<float, directions_per_cell>;
using IntTag = hn::RebindToSigned<FloatTag>;
using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;

// One EpiSpan in all lanes, or one span per lane. c0 and c1 are the columns that see its ends in direction K. They
// determine whether column n sees the span, and at which depth.
struct SpanLanes {
    Floats x0, z0, x1, z1;

    HWY_INLINE Floats c0(Floats K) const { return hn::Sub(x0, hn::Mul(K, z0)); }
    HWY_INLINE Floats c1(Floats K) const { return hn::Sub(x1, hn::Mul(K, z1)); }
    // With `fronts_only`, returns an empty range where the back is visible.
    HWY_INLINE Floats c1(Floats K, Floats c0, bool fronts_only) const {
        return fronts_only ? hn::Max(c0, c1(K)) : c1(K);
    }
    static HWY_INLINE FloatMask covers(Floats n, Floats c0, Floats c1) { return hn::Xor(hn::Lt(c0, n), hn::Lt(c1, n)); }
    // Change of depth from column to column.
    HWY_INLINE Floats slope(Floats c0, Floats c1) const { return hn::Div(hn::Sub(z1, z0), hn::Sub(c1, c0)); }
    HWY_INLINE Floats depth(Floats n, Floats c0, Floats per_column) const {
        return hn::Add(z0, hn::Mul(hn::Sub(n, c0), per_column));
    }
};

HWY_INLINE SpanLanes in_all_lanes(const EpiSpan& span) {
    const FloatTag d;
    return {hn::Set(d, span.x0), hn::Set(d, span.z0), hn::Set(d, span.x1), hn::Set(d, span.z1)};
}

HWY_INLINE SpanLanes load_spans(const float* spans) {
    SpanLanes lanes;
    hn::LoadInterleaved4(FloatTag(), spans, lanes.x0, lanes.z0, lanes.x1, lanes.z1);
    return lanes;
}

HWY_INLINE Ints ordered_bits_of(Floats z) {
    const IntTag di;
    const Ints bits = hn::BitCast(di, z);
    return hn::Xor(bits, hn::Or(hn::BroadcastSignBit(bits), hn::Set(di, std::numeric_limits<std::int32_t>::min())));
}

// Number of hits or candidates that are queued before they are drawn, and of further entries that one vector may write.
constexpr std::size_t max_queued = 1024, max_vector = HWY_MAX_BYTES / 4;

// Queue of hits at arbitrary words. It avoids a loop with a mispredicted end over the few hits of each vector.
class Hits {
  public:
    explicit Hits(const EpipolarPlane& plane) : words_(plane.words) {}

    // Adds the hit lanes of span `number`, at these offsets of words.
    HWY_INLINE void add(FloatMask hit, Floats z, Ints offsets, std::uint32_t number) {
        const IntTag di;
        const auto mask = hn::RebindMask(di, hit);
        const Ints depths = hn::Compress(ordered_bits_of(z), mask);
        static_assert(std::endian::native == std::endian::little, "a word's lower half comes first");
        hn::StoreInterleaved2(hn::Set(di, static_cast<std::int32_t>(number)), depths, di, hits_[count_]);
        hn::StoreU(hn::Compress(offsets, mask), di, offsets_ + count_);
        count_ += hn::CountTrue(FloatTag(), hit);
        if (count_ >= max_queued) draw();
    }

    HWY_NOINLINE void draw() {
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint64_t& word = words_[offsets_[i]];
            std::uint64_t hit;
            std::memcpy(&hit, hits_[i], sizeof(hit));
            word = hit < word ? hit : word;
        }
        count_ = 0;
    }

  private:
    std::uint64_t* words_;
    std::size_t count_ = 0;
    HWY_ALIGN std::int32_t offsets_[max_queued + max_vector];
    HWY_ALIGN std::int32_t hits_[max_queued + max_vector][2];  // halves of words
};

// Queue of samples that thin spans may cover. Candidates of many spans are collected before the first is tested, so
// that tests do not wait for the search and mispredicted loop ends overlap with other work. The candidates of one span
// fill whole vectors, regardless of their columns.
class Candidates {
  public:
    Candidates(const EpipolarPlane& plane, std::span<const EpiSpan> spans, std::size_t first, Hits& hits)
        : plane_(plane), spans_(spans), first_(first), hits_(hits) {}

    HWY_INLINE std::size_t begin() const { return vectors_ * hn::Lanes(FloatTag()); }

    // Writes the lanes with k <= end, in columns n and directions k, at index `count`. Returns their number.
    HWY_INLINE std::size_t add(Floats n, Floats k, Floats end, std::size_t count) {
        const FloatTag d;
        const FloatMask candidate = hn::Le(k, end);
        hn::StoreU(hn::Compress(n, candidate), d, n_ + count);
        hn::StoreU(hn::Compress(k, candidate), d, k_ + count);
        return hn::CountTrue(d, candidate);
    }

    // Ends the candidates of a span: the range from begin() to `count`.
    HWY_INLINE void end(std::uint32_t span, std::size_t count) {
        const FloatTag d;
        const NumberTag du;
        const std::size_t lanes = hn::Lanes(d), vectors = (count + lanes - 1) / lanes;
        // Pads the last vector with invalid samples.
        hn::StoreU(hn::Set(d, std::numeric_limits<float>::quiet_NaN()), d, k_ + count);
        for (std::size_t i = vectors_; i < vectors; i += lanes) hn::StoreU(hn::Set(du, span), du, owners_ + i);
        vectors_ = vectors;
    }

    // Returns whether the candidates must be drawn before more are added.
    static HWY_INLINE bool is_full(std::size_t count) { return count >= max_queued; }

    HWY_NOINLINE void draw() {
        const FloatTag d;
        const IntTag di;
        const std::size_t lanes = hn::Lanes(d);
        const Floats k_first = hn::Set(d, plane_.first_direction);
        // Added to an integer below 2²³, this moves the integer to the low bits of the sum.
        constexpr float to_whole = 1 << 23;
        const Floats to_column = hn::Set(d, to_whole - static_cast<float>(plane_.first_column));
        const Floats to_direction = hn::Set(d, to_whole);
        const Ints whole_bits = hn::BitCast(di, to_direction);
        const Ints directions = hn::Set(di, static_cast<std::int32_t>(plane_.directions));
        for (std::size_t i = 0; i < vectors_; ++i) {
            const SpanLanes span = in_all_lanes(spans_[owners_[i]]);
            const Floats n = hn::Load(d, n_ + i * lanes), k = hn::Load(d, k_ + i * lanes), K = hn::Add(k, k_first);
            const Floats c0 = span.c0(K), c1 = span.c1(K, c0, plane_.fronts_only);
            const Ints column = hn::Sub(hn::BitCast(di, hn::Add(n, to_column)), whole_bits);
            const Ints direction = hn::Sub(hn::BitCast(di, hn::Add(k, to_direction)), whole_bits);
            hits_.add(SpanLanes::covers(n, c0, c1), span.depth(n, c0, span.slope(c0, c1)),
                      hn::Add(hn::Mul(column, directions), direction), static_cast<std::uint32_t>(first_) + owners_[i]);
        }
        vectors_ = 0;
    }

  private:
    const EpipolarPlane& plane_;
    std::span<const EpiSpan> spans_;
    std::size_t first_;
    Hits& hits_;
    std::size_t vectors_ = 0;
    HWY_ALIGN float n_[max_queued + 4 * max_vector], k_[max_queued + 4 * max_vector];
    std::uint32_t owners_[max_queued + 4 * max_vector];  // the span of each vector
};

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
