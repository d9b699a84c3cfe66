// SPDX-License-Identifier: Apache-2.0
// What epi_draw_simd.cpp does with samples that strips cover, or may cover; included after hwy/highway.h, once for
// every instruction set.
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
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector of directions is in one cell.
using FloatTag = hn::CappedTag<float, cell_directions>;
using IntTag = hn::RebindToSigned<FloatTag>;
using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;

// A strip in all lanes, or a strip a lane (Strip, epi_kernels_internal.h). Where its ends are seen in direction K, and
// from there whether column n sees it, and how far.
struct StripLanes {
    Floats x0, z0, x1, z1;

    HWY_INLINE Floats c0(Floats K) const { return hn::Sub(x0, hn::Mul(K, z0)); }
    HWY_INLINE Floats c1(Floats K) const { return hn::Sub(x1, hn::Mul(K, z1)); }
    // The same so that nothing lies between the two where the back is seen and fronts alone are wanted.
    HWY_INLINE Floats c1(Floats K, Floats c0, bool fronts_only) const {
        return fronts_only ? hn::Max(c0, c1(K)) : c1(K);
    }
    static HWY_INLINE FloatMask covers(Floats n, Floats c0, Floats c1) { return hn::Xor(hn::Lt(c0, n), hn::Lt(c1, n)); }
    // Depth from column to column.
    HWY_INLINE Floats slope(Floats c0, Floats c1) const { return hn::Div(hn::Sub(z1, z0), hn::Sub(c1, c0)); }
    HWY_INLINE Floats depth(Floats n, Floats c0, Floats of_slope) const {
        return hn::Add(z0, hn::Mul(hn::Sub(n, c0), of_slope));
    }
};

HWY_INLINE StripLanes in_all_lanes(const Strip& strip) {
    const FloatTag d;
    return {hn::Set(d, strip.x0), hn::Set(d, strip.z0), hn::Set(d, strip.x1), hn::Set(d, strip.z1)};
}

HWY_INLINE StripLanes strip_a_lane(const float* strips) {
    StripLanes lanes;
    hn::LoadInterleaved4(FloatTag(), strips, lanes.x0, lanes.z0, lanes.x1, lanes.z1);
    return lanes;
}

HWY_INLINE Ints ordered_bits_of(Floats z) {
    const IntTag di;
    const Ints bits = hn::BitCast(di, z);
    return hn::Xor(bits, hn::Or(hn::BroadcastSignBit(bits), hn::Set(di, std::numeric_limits<std::int32_t>::min())));
}

// How many hits or candidates are kept before they are worked off, and what a vector may write beyond them.
constexpr std::size_t max_waiting = 1024, vector_room = HWY_MAX_BYTES / 4;

// Hits whose words lie anywhere. They are kept first, for a loop over the few hits of a vector at a time would end
// where no processor expects it.
class Hits {
  public:
    explicit Hits(const EpipolarPlane& plane) : words_(plane.words) {}

    // The lanes that are hits of a strip; `offsets` are those of the words.
    HWY_INLINE void add(FloatMask hit, Floats z, Ints offsets, std::uint32_t number) {
        const IntTag di;
        const auto mask = hn::RebindMask(di, hit);
        const Ints depths = hn::Compress(ordered_bits_of(z), mask);
        static_assert(std::endian::native == std::endian::little, "a word's lower half comes first");
        hn::StoreInterleaved2(hn::Set(di, static_cast<std::int32_t>(number)), depths, di, seen_[count_]);
        hn::StoreU(hn::Compress(offsets, mask), di, offsets_ + count_);
        count_ += hn::CountTrue(FloatTag(), hit);
        if (count_ >= max_waiting) draw();
    }

    HWY_NOINLINE void draw() {
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint64_t& word = words_[offsets_[i]];
            std::uint64_t seen;
            std::memcpy(&seen, seen_[i], sizeof(seen));
            word = seen < word ? seen : word;
        }
        count_ = 0;
    }

  private:
    std::uint64_t* words_;
    std::size_t count_ = 0;
    HWY_ALIGN std::int32_t offsets_[max_waiting + vector_room];
    HWY_ALIGN std::int32_t seen_[max_waiting + vector_room][2];  // as words
};

// Samples that thin strips may cover. They are found for many strips before the first is tested: what is tested does
// not have to wait for what is found, and where a strip has more or fewer of them than the processor guessed, it has
// other work. Those of a strip fill vectors, whichever columns they are from.
class Candidates {
  public:
    Candidates(const EpipolarPlane& plane, std::span<const Strip> strips, std::size_t first, Hits& hits)
        : plane_(plane), strips_(strips), first_(first), hits_(hits) {}

    // Where those of another strip begin.
    HWY_INLINE std::size_t begin() const { return vectors_ * hn::Lanes(FloatTag()); }

    // Puts the lanes whose directions k are not behind `end`, in columns n, at `count`, and returns how many there are.
    HWY_INLINE std::size_t add(Floats n, Floats k, Floats end, std::size_t count) {
        const FloatTag d;
        const FloatMask candidate = hn::Le(k, end);
        hn::StoreU(hn::Compress(n, candidate), d, n_ + count);
        hn::StoreU(hn::Compress(k, candidate), d, k_ + count);
        return hn::CountTrue(d, candidate);
    }

    // All up to `count` that have been added since begin() are of this strip.
    HWY_INLINE void end(std::uint32_t strip, std::size_t count) {
        const FloatTag d;
        const NumberTag du;
        const std::size_t lanes = hn::Lanes(d), vectors = (count + lanes - 1) / lanes;
        // What fills up the last vector is no sample.
        hn::StoreU(hn::Set(d, std::numeric_limits<float>::quiet_NaN()), d, k_ + count);
        for (std::size_t i = vectors_; i < vectors; i += lanes) hn::StoreU(hn::Set(du, strip), du, of_ + i);
        vectors_ = vectors;
    }

    // Whether they must be drawn before there are more.
    static HWY_INLINE bool is_full(std::size_t count) { return count >= max_waiting; }

    HWY_NOINLINE void draw() {
        const FloatTag d;
        const IntTag di;
        const std::size_t lanes = hn::Lanes(d);
        const Floats k_first = hn::Set(d, plane_.first_direction);
        // Whole numbers below 2²³ are the last bits of their sum with it.
        constexpr float to_whole = 1 << 23;
        const Floats to_column = hn::Set(d, to_whole - static_cast<float>(plane_.first_column));
        const Floats to_direction = hn::Set(d, to_whole);
        const Ints others = hn::BitCast(di, to_direction);
        const Ints directions = hn::Set(di, static_cast<std::int32_t>(plane_.directions));
        for (std::size_t i = 0; i < vectors_; ++i) {
            const StripLanes strip = in_all_lanes(strips_[of_[i]]);
            const Floats n = hn::Load(d, n_ + i * lanes), k = hn::Load(d, k_ + i * lanes), K = hn::Add(k, k_first);
            const Floats c0 = strip.c0(K), c1 = strip.c1(K, c0, plane_.fronts_only);
            const Ints column = hn::Sub(hn::BitCast(di, hn::Add(n, to_column)), others);
            const Ints direction = hn::Sub(hn::BitCast(di, hn::Add(k, to_direction)), others);
            hits_.add(StripLanes::covers(n, c0, c1), strip.depth(n, c0, strip.slope(c0, c1)),
                      hn::Add(hn::Mul(column, directions), direction), static_cast<std::uint32_t>(first_) + of_[i]);
        }
        vectors_ = 0;
    }

  private:
    const EpipolarPlane& plane_;
    std::span<const Strip> strips_;
    std::size_t first_;
    Hits& hits_;
    std::size_t vectors_ = 0;
    HWY_ALIGN float n_[max_waiting + 4 * vector_room], k_[max_waiting + 4 * vector_room];
    std::uint32_t of_[max_waiting + 4 * vector_room];
};

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();
#endif
