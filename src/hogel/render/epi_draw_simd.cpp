// The vector twins of epi_kernels.cpp that find what is seen, compiled for every instruction set and chosen when first
// called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_draw_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "hogel/render/epi_kernels_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;

// The truth of up to 64 lanes as bits.
template <class D, class M>
HWY_INLINE std::uint64_t bits_of(D d, M mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    std::uint64_t bits = 0;
    for (std::size_t byte = 0; 8 * byte < hn::Lanes(d); ++byte) bits |= std::uint64_t{bytes[byte]} << 8 * byte;
    return bits;
}

std::uint64_t Crossing(const ClusterCorners& corners, double row, double slope) {
    const hn::ScalableTag<double> d;
    const auto rows = hn::Set(d, row), slopes = hn::Set(d, slope), zero = hn::Zero(d);
    std::uint64_t crossed = 0;
    for (std::size_t i = 0; i < cluster_size; i += hn::Lanes(d)) {
        const auto below = [&](int corner) HWY_ATTR {
            const auto y = hn::Load(d, corners.y[corner] + i), z = hn::Load(d, corners.z[corner] + i);
            return hn::Lt(hn::Sub(hn::Sub(y, hn::Mul(slopes, z)), rows), zero);
        };
        const auto first = below(0), second = below(1), third = below(2);
        crossed |= bits_of(d, hn::Or(hn::Xor(first, second), hn::Xor(second, third))) << i;
    }
    return crossed;
}

// Where points (x, z) of strips are seen in direction K.
HWY_INLINE Floats c_of(Floats x, Floats z, Floats K) { return hn::Sub(x, hn::Mul(K, z)); }

HWY_INLINE Ints ordered_bits_of(Floats z) {
    const IntTag di;
    const Ints bits = hn::BitCast(di, z);
    return hn::Xor(bits, hn::Or(hn::BroadcastSignBit(bits), hn::Set(di, std::numeric_limits<std::int32_t>::min())));
}

// How many hits or candidates are kept before they are worked off, and what a vector may write beyond them.
constexpr std::size_t most_waiting = 256, vector_room = HWY_MAX_BYTES / 4;

// Hits whose words lie anywhere. They are kept first, for a loop over the few hits of a vector at a time would end
// where no processor expects it.
class Hits {
  public:
    explicit Hits(const EpipolarPlane& plane) : words_(plane.words) {}

    // The lanes that are hits; `offsets` are those of the words.
    HWY_INLINE void add(FloatMask hit, Floats z, Ints offsets, Ints numbers) {
        const IntTag di;
        const auto mask = hn::RebindMask(di, hit);
        hn::StoreU(hn::Compress(ordered_bits_of(z), mask), di, depths_ + count_);
        hn::StoreU(hn::Compress(offsets, mask), di, offsets_ + count_);
        hn::StoreU(hn::Compress(numbers, mask), di, numbers_ + count_);
        count_ += hn::CountTrue(FloatTag(), hit);
        if (count_ >= most_waiting) draw();
    }

    void draw() {
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint64_t& word = words_[offsets_[i]];
            const std::uint64_t seen =
                std::uint64_t{static_cast<std::uint32_t>(depths_[i])} << 32 | static_cast<std::uint32_t>(numbers_[i]);
            word = seen < word ? seen : word;
        }
        count_ = 0;
    }

  private:
    std::uint64_t* words_;
    std::size_t count_ = 0;
    HWY_ALIGN std::int32_t depths_[most_waiting + vector_room], offsets_[most_waiting + vector_room],
        numbers_[most_waiting + vector_room];
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
            Floats x0, z0, x1, z1;
            hn::LoadInterleaved4(d, ends_[i], x0, z0, x1, z1);
            const Floats n = hn::Load(d, n_ + i), k = hn::Load(d, k_ + i), K = hn::Add(k, k_first);
            const Floats c0 = c_of(x0, z0, K), c1 = c_of(x1, z1, K);
            const FloatMask hit = hn::And(hn::Ge(k, hn::Zero(d)), hn::Xor(hn::Lt(c0, n), hn::Lt(c1, n)));
            const Floats z = hn::Add(z0, hn::Mul(hn::Sub(n, c0), hn::Div(hn::Sub(z1, z0), hn::Sub(c1, c0))));
            const Ints column = hn::ConvertTo(di, hn::Sub(n, n_first));
            hits_.add(hit, z, hn::Add(hn::Mul(column, directions), hn::ConvertTo(di, k)),
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

// What the loops below need to know of a strip and the plane that it is drawn into.
struct Drawing {
    const Strip& strip;
    std::uint32_t index, number;
    const EpipolarPlane& plane;
    Hits& hits;
    Candidates& candidates;
    float n_first, n_last, k_first, k_last;  // of the plane
};

#if HWY_TARGET != HWY_SCALAR
// One direction a lane, and a column at a time, of which the lanes lie side by side: those that are not hits keep what
// they have, even if they lie beyond the plane's directions.
void along_rows(const Drawing& on, float K_begin, float K_end) {
    const FloatTag d;
    const IntTag di;
    const hn::ScalableTag<std::uint64_t> d64;
    const hn::Half<NumberTag> du_half;
    const Floats x0 = hn::Set(d, on.strip.x0), x1 = hn::Set(d, on.strip.x1), z0 = hn::Set(d, on.strip.z0),
                 z1 = hn::Set(d, on.strip.z1), dz = hn::Sub(z1, z0);
    const Floats one = hn::Set(d, 1.0f), far = hn::Set(d, std::numeric_limits<float>::infinity());
    const Floats n_first = hn::Set(d, on.n_first), n_last = hn::Set(d, on.n_last);
    const Ints nothing = hn::Set(di, -1);
    const auto number = hn::Set(d64, on.number);
    const std::size_t half = hn::Lanes(d64);
    for (float begin = K_begin; begin <= K_end; begin += static_cast<float>(hn::Lanes(d))) {
        const Floats K = hn::Iota(d, begin);
        const Floats c0 = c_of(x0, z0, K), c1 = c_of(x1, z1, K), slope = hn::Div(dz, hn::Sub(c1, c0));
        const Floats from = hn::Max(n_first, hn::Add(hn::Floor(hn::Min(c0, c1)), one));
        const Floats to = hn::Min(n_last, hn::Floor(hn::Max(c0, c1)));
        const FloatMask any = hn::And(hn::Le(from, to), hn::Le(K, hn::Set(d, K_end)));
        if (hn::AllFalse(d, any)) continue;
        const Floats first = hn::IfThenElse(any, from, far), last = hn::IfThenElse(any, to, hn::Neg(far));
        const float n_end = hn::GetLane(hn::MaxOfLanes(d, last));
        float n = hn::GetLane(hn::MinOfLanes(d, first));
        std::uint64_t* words = on.plane.words + static_cast<std::size_t>(n - on.n_first) * on.plane.directions +
                               static_cast<std::size_t>(begin - on.k_first);
        for (; n <= n_end; n += 1, words += on.plane.directions) {
            const Floats ns = hn::Set(d, n);
            const auto hit = hn::RebindMask(di, hn::And(hn::Le(first, ns), hn::Le(ns, last)));
            const Ints ordered = ordered_bits_of(hn::Add(z0, hn::Mul(hn::Sub(ns, c0), slope)));
            const auto depths = hn::BitCast(NumberTag(), hn::IfThenElse(hit, ordered, nothing));
            const auto low = hn::Or(hn::ShiftLeft<32>(hn::PromoteTo(d64, hn::LowerHalf(du_half, depths))), number);
            const auto high = hn::Or(hn::ShiftLeft<32>(hn::PromoteTo(d64, hn::UpperHalf(du_half, depths))), number);
            hn::StoreU(hn::Min(low, hn::LoadU(d64, words)), d64, words);
            hn::StoreU(hn::Min(high, hn::LoadU(d64, words + half)), d64, words + half);
        }
    }
}
#endif

// One direction a lane: all columns between c_0 and c_1 are hits.
void along_directions(const Drawing& on, float K_begin, float K_end) {
    const FloatTag d;
    const IntTag di;
    const Ints number = hn::Set(di, static_cast<std::int32_t>(on.number));
    const Floats x0 = hn::Set(d, on.strip.x0), x1 = hn::Set(d, on.strip.x1), z0 = hn::Set(d, on.strip.z0),
                 z1 = hn::Set(d, on.strip.z1), dz = hn::Sub(z1, z0);
    const Floats one = hn::Set(d, 1.0f), n_first = hn::Set(d, on.n_first), n_last = hn::Set(d, on.n_last);
    const Floats none = hn::Set(d, on.n_first - 1), K_last = hn::Set(d, K_end), k_first = hn::Set(d, on.k_first);
    const Ints directions = hn::Set(di, static_cast<std::int32_t>(on.plane.directions));
    for (float begin = K_begin; begin <= K_end; begin += static_cast<float>(hn::Lanes(d))) {
        const Floats K = hn::Iota(d, begin);
        const Floats c0 = c_of(x0, z0, K), c1 = c_of(x1, z1, K), slope = hn::Div(dz, hn::Sub(c1, c0));
        const Floats end = hn::IfThenElse(hn::Le(K, K_last), hn::Min(n_last, hn::Floor(hn::Max(c0, c1))), none);
        const Ints k = hn::ConvertTo(di, hn::Sub(K, k_first));
        Floats n = hn::Max(n_first, hn::Add(hn::Floor(hn::Min(c0, c1)), one));
        for (FloatMask hit = hn::Le(n, end); !hn::AllFalse(d, hit); hit = hn::Le(n, end)) {
            const Ints column = hn::ConvertTo(di, hn::Sub(n, n_first));
            on.hits.add(hit, hn::Add(z0, hn::Mul(hn::Sub(n, c0), slope)), hn::Add(hn::Mul(column, directions), k),
                        number);
            n = hn::Add(n, one);
        }
    }
}

// One column a lane: candidates are the directions from K_0 to K_1, the ends' own, and a margin to either side.
void along_columns(const Drawing& on, float n_begin, float n_end, float per_z0, float per_z1, float margin) {
    const FloatTag d;
    const Floats x0 = hn::Set(d, on.strip.x0), x1 = hn::Set(d, on.strip.x1);
    const Floats steep0 = hn::Set(d, per_z0), steep1 = hn::Set(d, per_z1), margins = hn::Set(d, margin);
    const Floats one = hn::Set(d, 1.0f), k_first = hn::Set(d, on.k_first);
    const Floats k_last = hn::Set(d, on.k_last - on.k_first), none = hn::Set(d, -1.0f), columns_end = hn::Set(d, n_end);
    for (float begin = n_begin; begin <= n_end; begin += static_cast<float>(hn::Lanes(d))) {
        const Floats n = hn::Iota(d, begin);
        const Floats K0 = hn::Mul(hn::Sub(x0, n), steep0), K1 = hn::Mul(hn::Sub(x1, n), steep1);
        const Floats low = hn::Sub(hn::Sub(hn::Min(K0, K1), margins), k_first);
        const Floats high = hn::Sub(hn::Add(hn::Max(K0, K1), margins), k_first);
        const Floats end = hn::IfThenElse(hn::Le(n, columns_end), hn::Min(k_last, high), none);
        Floats k = hn::Max(hn::Zero(d), hn::Ceil(low));
        FloatMask candidate = hn::Le(k, end);
        do {
            on.candidates.add(candidate, n, k, on.index);
            k = hn::Add(k, one);
            candidate = hn::Le(k, end);
        } while (!hn::AllFalse(d, candidate));
    }
}

// In about processor cycles: a vector of directions or columns, candidates in it, a hit that is put in its place by
// itself, a column of directions at once.
constexpr float cost_of_vector = 20, cost_of_candidates = 12, cost_of_hit = 3, cost_of_row = 8;

// Bounds what a strip can cover, and goes over it in the way that takes least.
void draw_strip(const Drawing& on) {
    const auto [x0, z0, x1, z1] = on.strip;
    // c is linear in K: these bound the columns that see the strip.
    const auto [low, high] =
        std::minmax({x0 - on.k_first * z0, x0 - on.k_last * z0, x1 - on.k_first * z1, x1 - on.k_last * z1});
    if (!(high >= on.n_first && low < on.n_last)) return;
    const float n_begin = std::max(on.n_first, std::floor(low)), n_end = std::min(on.n_last, std::floor(high));

    // Column n sees p in direction (x_p − n) / z_p. If both ends lie on one side of the hologram, the directions that
    // see the strip lie between; else outside, up to infinity.
    const float per_z0 = 1 / z0, per_z1 = 1 / z1;
    const float steepest = std::max(std::abs(per_z0), std::abs(per_z1));
    // Many times the rounding of these directions and of c.
    const float margin =
        0.01f + 1e-6f * (std::max(std::abs(on.n_first), std::abs(on.n_last)) + on.k_last) * (1 + steepest);
    if ((z0 > 0) != (z1 > 0) || !(margin < 0.5f)) return along_directions(on, on.k_first, on.k_last);
    const auto [K_low, K_high] =
        std::minmax({(x0 - n_begin) * per_z0, (x0 - n_end) * per_z0, (x1 - n_begin) * per_z1, (x1 - n_end) * per_z1});
    // Directions are whole steps from the first one.
    const float K_begin = on.k_first + std::max(0.0f, std::ceil(K_low - margin - on.k_first));
    const float K_end = std::min(on.k_last, K_high + margin);
    if (!(K_begin <= K_end)) return;

    const auto lanes = static_cast<float>(hn::Lanes(FloatTag()));
    const float K_vectors = (K_end - K_begin) / lanes + 1, n_vectors = (n_end - n_begin) / lanes + 1;
    const float columns_across = std::abs((x1 - x0) - 0.5f * (K_begin + K_end) * (z1 - z0));
    const float hits = cost_of_hit * columns_across * (K_end - K_begin + 1);
    const float by_directions = K_vectors * (cost_of_vector + cost_of_candidates * (columns_across + 1)) + hits;
    const float by_columns = n_vectors * (cost_of_vector + cost_of_candidates * (columns_across * steepest + 1)) + hits;
#if HWY_TARGET != HWY_SCALAR
    const float rows = columns_across + lanes * std::max(std::abs(z0), std::abs(z1)) + 1;
    const float by_rows = K_vectors * (2 * cost_of_vector + cost_of_row * rows);
    if (by_rows < by_directions && by_rows < by_columns) return along_rows(on, K_begin, K_end);
#endif
    if (by_columns < by_directions)
        along_columns(on, n_begin, n_end, per_z0, per_z1, margin);
    else
        along_directions(on, K_begin, K_end);
}

void Draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane) {
    const auto n_first = static_cast<float>(plane.first_column);
    const float n_last = n_first + static_cast<float>(plane.columns) - 1;
    const float k_last = plane.first_direction + static_cast<float>(plane.directions) - 1;
    Hits hits(plane);
    Candidates candidates(plane, strips, first, hits);
    for (std::size_t i = 0; i < strips.size(); ++i)
        draw_strip({strips[i], static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(first + i), plane, hits,
                    candidates, n_first, n_last, plane.first_direction, k_last});
    candidates.draw();
    hits.draw();
}

void Farthest(const EpipolarPlane& plane, std::span<std::uint32_t> cells) {
    const hn::ScalableTag<std::uint64_t> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t cell = 0;
    for (std::size_t c0 = 0; c0 < plane.columns; c0 += cell_columns)
        for (std::size_t k0 = 0; k0 < plane.directions; k0 += cell_directions, ++cell) {
            const std::size_t c1 = std::min(c0 + cell_columns, plane.columns);
            const std::size_t k1 = std::min(k0 + cell_directions, plane.directions);
            auto most = hn::Zero(d);
            std::uint64_t rest = 0;
            for (std::size_t column = c0; column < c1; ++column) {
                const std::uint64_t* row = plane.words + column * plane.directions;
                std::size_t k = k0;
                for (; k + lanes <= k1; k += lanes) most = hn::Max(most, hn::LoadU(d, row + k));
                for (; k < k1; ++k) rest = std::max(rest, row[k]);
            }
            HWY_ALIGN std::uint64_t lane[HWY_MAX_BYTES / 8];
            hn::Store(most, d, lane);
            for (std::size_t i = 0; i < lanes; ++i) rest = std::max(rest, lane[i]);
            cells[cell] = static_cast<std::uint32_t>(rest >> 32);
        }
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(Crossing);
HWY_EXPORT(Draw);
HWY_EXPORT(Farthest);

std::uint64_t crossing(const ClusterCorners& corners, double row, double slope) {
    return HWY_DYNAMIC_DISPATCH(Crossing)(corners, row, slope);
}

void draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane) {
    HWY_DYNAMIC_DISPATCH(Draw)(strips, first, plane);
}

void farthest(const EpipolarPlane& plane, std::span<std::uint32_t> cells) {
    HWY_DYNAMIC_DISPATCH(Farthest)(plane, cells);
}

std::vector<std::int64_t> kernel_targets() { return hwy::SupportedAndGeneratedTargets(); }

void use_kernel_target(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace hogel
#endif
