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

#include "hogel/render/epi_kernels_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
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

// Which lanes are true, as bits.
HWY_INLINE std::uint64_t bits_of(hn::Mask<NumberTag> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(NumberTag(), mask, bytes);
    std::uint64_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits;
}

// How many hits or candidates are kept before they are worked off, and what a vector may write beyond them.
constexpr std::size_t most_waiting = 1024, vector_room = HWY_MAX_BYTES / 4;

// Hits whose words lie anywhere. They are kept first, for a loop over the few hits of a vector at a time would end
// where no processor expects it.
class Hits {
  public:
    explicit Hits(const EpipolarPlane& plane) : words_(plane.words) {}

    // The lanes that are hits; `offsets` are those of the words.
    HWY_INLINE void add(FloatMask hit, Floats z, Ints offsets, Ints numbers) {
        const IntTag di;
        add_compressed(hit, z, offsets, hn::Compress(numbers, hn::RebindMask(di, hit)));
    }

    // The same of a single strip.
    HWY_INLINE void add(FloatMask hit, Floats z, Ints offsets, std::uint32_t number) {
        add_compressed(hit, z, offsets, hn::Set(IntTag(), static_cast<std::int32_t>(number)));
    }

    void draw() {
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint64_t& word = words_[offsets_[i]];
            std::uint64_t seen;
            std::memcpy(&seen, seen_[i], sizeof(seen));
            word = seen < word ? seen : word;
        }
        count_ = 0;
    }

  private:
    HWY_INLINE void add_compressed(FloatMask hit, Floats z, Ints offsets, Ints numbers) {
        const IntTag di;
        const auto mask = hn::RebindMask(di, hit);
        const Ints depths = hn::Compress(ordered_bits_of(z), mask);
        static_assert(std::endian::native == std::endian::little, "a word's lower half comes first");
        hn::StoreInterleaved2(numbers, depths, di, seen_[count_]);
        hn::StoreU(hn::Compress(offsets, mask), di, offsets_ + count_);
        count_ += hn::CountTrue(FloatTag(), hit);
        if (count_ >= most_waiting) draw();
    }

    std::uint64_t* words_;
    std::size_t count_ = 0;
    HWY_ALIGN std::int32_t offsets_[most_waiting + vector_room];
    HWY_ALIGN std::int32_t seen_[most_waiting + vector_room][2];  // as words
};

// Samples that thin strips may cover, of many strips together, for each has few of a vector's.
class Candidates {
  public:
    Candidates(const EpipolarPlane& plane, std::span<const Strip> strips, std::size_t first, Hits& hits)
        : plane_(plane), strips_(strips), first_(first), hits_(hits) {}

    // The lanes that are candidates, in columns n and directions k.
    HWY_INLINE void add(FloatMask candidate, Floats n, Floats k, std::uint32_t strip) {
        const FloatTag d;
        hn::StoreU(hn::Compress(n, candidate), d, n_ + count_);
        hn::StoreU(hn::Compress(k, candidate), d, k_ + count_);
        hn::StoreU(hn::Set(NumberTag(), strip), NumberTag(), of_ + count_);
        count_ += hn::CountTrue(d, candidate);
        if (count_ >= most_waiting) draw();
    }

    void draw() {
        const FloatTag d;
        const IntTag di;
        const std::size_t lanes = hn::Lanes(d);
        if (count_ == 0) return;
        // What fills up the last vector is no sample.
        hn::StoreU(hn::Zero(NumberTag()), NumberTag(), of_ + count_);
        hn::StoreU(hn::Set(d, -1.0f), d, k_ + count_);
        hn::StoreU(hn::Zero(d), d, n_ + count_);
        for (std::size_t i = 0; i < count_ + lanes - 1; ++i) std::memcpy(ends_[i], &strips_[of_[i]], sizeof(Strip));
        const Floats k_first = hn::Set(d, plane_.first_direction);
        const Floats n_first = hn::Set(d, static_cast<float>(plane_.first_column));
        const Ints directions = hn::Set(di, static_cast<std::int32_t>(plane_.directions));
        for (std::size_t i = 0; i < count_; i += lanes) {
            const StripLanes strip = strip_a_lane(ends_[i]);
            const Floats n = hn::Load(d, n_ + i), k = hn::Load(d, k_ + i), K = hn::Add(k, k_first);
            const Floats c0 = strip.c0(K), c1 = strip.c1(K, c0, plane_.fronts_only);
            const FloatMask hit = hn::And(hn::Ge(k, hn::Zero(d)), StripLanes::covers(n, c0, c1));
            const Ints column = hn::ConvertTo(di, hn::Sub(n, n_first));
            hits_.add(hit, strip.depth(n, c0, strip.slope(c0, c1)),
                      hn::Add(hn::Mul(column, directions), hn::ConvertTo(di, k)),
                      hn::Add(hn::Load(di, reinterpret_cast<const std::int32_t*>(of_ + i)),
                              hn::Set(di, static_cast<std::int32_t>(first_))));
        }
        count_ = 0;
    }

  private:
    const EpipolarPlane& plane_;
    std::span<const Strip> strips_;
    std::size_t first_;
    Hits& hits_;
    std::size_t count_ = 0;
    HWY_ALIGN float n_[most_waiting + 2 * vector_room], k_[most_waiting + 2 * vector_room];
    HWY_ALIGN std::uint32_t of_[most_waiting + 2 * vector_room];
    HWY_ALIGN float ends_[most_waiting + 2 * vector_room][4];
};

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();
#endif
