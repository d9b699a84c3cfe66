// The vector twins of epi_kernels.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_kernels_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "hogel/render/epi_kernels_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
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

// What the loops below need to know of a strip and the plane that it is drawn into.
struct Drawing {
    const Strip& strip;
    std::uint64_t number;
    const EpipolarPlane& plane;
    float n_first, n_last, k_first, k_last;  // of the plane
};

// Where point (x, z) of a strip is seen in direction K.
HWY_INLINE Floats c_of(Floats x, Floats z, Floats K) { return hn::Sub(x, hn::Mul(K, z)); }

// Puts a strip's number and its depths, part along it from z0 to z0 + dz, into the words at these offsets, where the
// lanes are hits.
HWY_INLINE void put(std::uint64_t* words, std::uint64_t number, Floats z0, Floats dz, FloatMask hit, Floats part,
                    Ints offset) {
    const FloatTag d;
    const IntTag di;
    const hn::RebindToUnsigned<FloatTag> du;
    const Ints bits = hn::BitCast(di, hn::Add(z0, hn::Mul(part, dz)));
    const Ints ordered =
        hn::Xor(bits, hn::Or(hn::BroadcastSignBit(bits), hn::Set(di, std::numeric_limits<std::int32_t>::min())));
    HWY_ALIGN std::uint32_t depths[HWY_MAX_BYTES / 4];
    HWY_ALIGN std::uint32_t offsets[HWY_MAX_BYTES / 4];
    const auto mask = hn::RebindMask(di, hit);
    hn::Store(hn::BitCast(du, hn::Compress(ordered, mask)), du, depths);
    hn::Store(hn::BitCast(du, hn::Compress(offset, mask)), du, offsets);
    const std::size_t hits = hn::CountTrue(d, hit);
    for (std::size_t i = 0; i < hits; ++i) {
        std::uint64_t& word = words[offsets[i]];
        const std::uint64_t seen = std::uint64_t{depths[i]} << 32 | number;
        if (seen < word) word = seen;
    }
}

// One direction a lane: all columns between c_0 and c_1 are hits.
void along_directions(const Drawing& on, float K_begin, float K_end) {
    const FloatTag d;
    const IntTag di;
    std::uint64_t* const words = on.plane.words;
    const std::uint64_t number = on.number;
    const Floats x0 = hn::Set(d, on.strip.x0), x1 = hn::Set(d, on.strip.x1), z0 = hn::Set(d, on.strip.z0),
                 z1 = hn::Set(d, on.strip.z1), dz = hn::Sub(z1, z0);
    const Floats one = hn::Set(d, 1.0f), n_first = hn::Set(d, on.n_first), n_last = hn::Set(d, on.n_last);
    const Floats none = hn::Set(d, on.n_first - 1), K_last = hn::Set(d, K_end), k_first = hn::Set(d, on.k_first);
    const Ints directions = hn::Set(di, static_cast<std::int32_t>(on.plane.directions));
    for (float begin = K_begin; begin <= K_end; begin += static_cast<float>(hn::Lanes(d))) {
        const Floats K = hn::Iota(d, begin);
        const Floats c0 = c_of(x0, z0, K), c1 = c_of(x1, z1, K), width = hn::Sub(c1, c0);
        const Floats end = hn::IfThenElse(hn::Le(K, K_last), hn::Min(n_last, hn::Floor(hn::Max(c0, c1))), none);
        const Ints k = hn::ConvertTo(di, hn::Sub(K, k_first));
        Floats n = hn::Max(n_first, hn::Add(hn::Floor(hn::Min(c0, c1)), one));
        for (FloatMask hit = hn::Le(n, end); !hn::AllFalse(d, hit); hit = hn::Le(n, end)) {
            const Ints column = hn::ConvertTo(di, hn::Sub(n, n_first));
            put(words, number, z0, dz, hit, hn::Div(hn::Sub(n, c0), width), hn::Add(hn::Mul(column, directions), k));
            n = hn::Add(n, one);
        }
    }
}

// One column a lane: candidates are the directions from K_0 to K_1, the ends' own, and a margin to either side.
void along_columns(const Drawing& on, float n_begin, float n_end, float per_z0, float per_z1, float margin) {
    const FloatTag d;
    const IntTag di;
    std::uint64_t* const words = on.plane.words;
    const std::uint64_t number = on.number;
    const Floats x0 = hn::Set(d, on.strip.x0), x1 = hn::Set(d, on.strip.x1), z0 = hn::Set(d, on.strip.z0),
                 z1 = hn::Set(d, on.strip.z1), dz = hn::Sub(z1, z0);
    const Floats steep0 = hn::Set(d, per_z0), steep1 = hn::Set(d, per_z1), margins = hn::Set(d, margin);
    const Floats one = hn::Set(d, 1.0f), n_first = hn::Set(d, on.n_first), k_first = hn::Set(d, on.k_first);
    const Floats k_last = hn::Set(d, on.k_last - on.k_first), none = hn::Set(d, -1.0f), columns_end = hn::Set(d, n_end);
    const Ints directions = hn::Set(di, static_cast<std::int32_t>(on.plane.directions));
    for (float begin = n_begin; begin <= n_end; begin += static_cast<float>(hn::Lanes(d))) {
        const Floats n = hn::Iota(d, begin);
        const Floats K0 = hn::Mul(hn::Sub(x0, n), steep0), K1 = hn::Mul(hn::Sub(x1, n), steep1);
        const Floats low = hn::Sub(hn::Sub(hn::Min(K0, K1), margins), k_first);
        const Floats high = hn::Sub(hn::Add(hn::Max(K0, K1), margins), k_first);
        const Floats end = hn::IfThenElse(hn::Le(n, columns_end), hn::Min(k_last, high), none);
        const Ints row = hn::Mul(hn::ConvertTo(di, hn::Sub(n, n_first)), directions);
        Floats k = hn::Max(hn::Zero(d), hn::Ceil(low));
        for (FloatMask candidate = hn::Le(k, end); !hn::AllFalse(d, candidate); candidate = hn::Le(k, end)) {
            const Floats K = hn::Add(k, k_first);
            const Floats c0 = c_of(x0, z0, K), c1 = c_of(x1, z1, K);
            const FloatMask hit = hn::And(candidate, hn::Xor(hn::Lt(c0, n), hn::Lt(c1, n)));
            put(words, number, z0, dz, hit, hn::Div(hn::Sub(n, c0), hn::Sub(c1, c0)),
                hn::Add(row, hn::ConvertTo(di, k)));
            k = hn::Add(k, one);
        }
    }
}

// Bounds what a strip can cover, and lays the lanes along the columns or along the directions, whichever takes fewer
// vectors.
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
    const float columns_across = std::abs((x1 - x0) - 0.5f * (K_begin + K_end) * (z1 - z0));
    const float along_n = std::ceil((n_end - n_begin + 1) / lanes) * (columns_across * steepest + 1);
    const float along_k = std::ceil((K_end - K_begin + 1) / lanes) * (columns_across + 1);
    if (along_n < along_k)
        along_columns(on, n_begin, n_end, per_z0, per_z1, margin);
    else
        along_directions(on, K_begin, K_end);
}

void Draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane) {
    const auto n_first = static_cast<float>(plane.first_column);
    const float n_last = n_first + static_cast<float>(plane.columns) - 1;
    const float k_last = plane.first_direction + static_cast<float>(plane.directions) - 1;
    for (std::size_t i = 0; i < strips.size(); ++i)
        draw_strip({strips[i], first + i, plane, n_first, n_last, plane.first_direction, k_last});
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

#if HWY_TARGET == HWY_SCALAR
// A single lane holds no four values.
void Shade(const EpipolarPlane& plane, std::span<const StripEnds> strips, const float (&background)[4],
           const ShadedPlane& out) {
    shade_plain(plane, strips, background, out);
}
#else
// Which of up to 64 words are not `nothing`.
HWY_INLINE std::uint64_t covered_words(const std::uint64_t* words, std::size_t count) {
    const hn::ScalableTag<std::uint64_t> d;
    const auto nothing = hn::Set(d, EpipolarPlane::nothing);
    std::uint64_t covered = 0;
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
        covered |= bits_of(d, hn::Ne(hn::LoadU(d, words + i), nothing)) << i;
    for (; i < count; ++i) covered |= std::uint64_t{words[i] != EpipolarPlane::nothing} << i;
    return covered;
}

// The values of the samples words[i] for the bits of `which`, each by itself.
HWY_INLINE void shade_each(const std::uint64_t* words, std::uint64_t which, std::span<const StripEnds> strips, double n,
                           double K, float (*samples)[4]) {
    const hn::Full128<float> d4;
    const hn::Full128<double> d2;
    for (; which != 0; which &= which - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(which));
        const StripEnds& strip = strips[words[i] & 0xffffffff];
        const auto c = hn::Sub(hn::LoadU(d2, &strip.x0),
                               hn::Mul(hn::Set(d2, K + static_cast<double>(i)), hn::LoadU(d2, &strip.z0)));
        const float part = part_of_strip(hn::GetLane(c), hn::GetLane(hn::Shuffle01(c)), n);
        const auto value0 = hn::LoadU(d4, strip.value0), value1 = hn::LoadU(d4, strip.value1);
        hn::Store(hn::Add(value0, hn::Mul(hn::Set(d4, part), hn::Sub(value1, value0))), d4, samples[i]);
    }
}

// Whether a vector of samples shows one and the same strip.
HWY_INLINE bool show_one_strip(const std::uint64_t* words) {
    const hn::ScalableTag<std::uint64_t> d;
    const auto number = hn::Set(d, 0xffffffff), first = hn::Set(d, words[0] & 0xffffffff);
    for (std::size_t i = 0; i < hn::Lanes(FloatTag()); i += hn::Lanes(d))
        if (!hn::AllTrue(d, hn::Eq(hn::And(hn::LoadU(d, words + i), number), first))) return false;
    return true;
}

// How far along a strip the directions K, K + 1, ... are: part_of_strip for half a vector of floats.
HWY_INLINE auto parts_of_strip(const StripEnds& strip, double n, double K) {
    const hn::ScalableTag<double> d;
    const auto Ks = hn::Iota(d, K), zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const auto c0 = hn::Sub(hn::Set(d, strip.x0), hn::Mul(Ks, hn::Set(d, strip.z0)));
    const auto c1 = hn::Sub(hn::Set(d, strip.x1), hn::Mul(Ks, hn::Set(d, strip.z1)));
    const auto part = hn::Div(hn::Sub(hn::Set(d, n), c0), hn::Sub(c1, c0));
    const auto positive = hn::IfThenElse(hn::Gt(part, zero), part, zero);
    return hn::DemoteTo(hn::Rebind<float, decltype(d)>(), hn::IfThenElse(hn::Lt(positive, one), positive, one));
}

// Shades up to 64 samples of a column from direction k on; `aligned` says that whole vectors fit the rows' places.
HWY_INLINE void shade_block(const EpipolarPlane& plane, std::span<const StripEnds> strips, const float (&background)[4],
                            const ShadedPlane& out, std::size_t column, std::size_t k, std::size_t count,
                            bool aligned) {
    const FloatTag d;
    const std::uint64_t* words = plane.words + column * plane.directions + k;
    const double n = plane.first_column + static_cast<double>(column);
    const double K = static_cast<double>(plane.first_direction) + static_cast<double>(k);

    HWY_ALIGN float samples[64][4];
    const std::uint64_t covered = covered_words(words, count);
    const auto shade_range = [&](std::size_t first, std::size_t number) {
        const auto behind = hn::LoadU(hn::Full128<float>(), background);
        for (std::size_t i = 0; i < number; ++i) hn::Store(behind, hn::Full128<float>(), samples[first + i]);
        const std::uint64_t range = (number < 64 ? (std::uint64_t{1} << number) - 1 : ~std::uint64_t{0}) << first;
        shade_each(words, covered & range, strips, n, K, samples);
    };

    if (!aligned) {
        if (covered != 0) shade_range(0, count);
        for (int i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < count && out.values[i]; ++j)
                out.values[i][column * out.strides[i] + k + j] = covered != 0 ? samples[j][i] : background[i];
        return;
    }
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t j = 0; j < count; j += lanes) {
        Floats values[4];
        const std::uint64_t range = ((std::uint64_t{1} << lanes) - 1) << j;
        if ((covered & range) == 0) {
            for (int i = 0; i < 4; ++i) values[i] = hn::Set(d, background[i]);
        } else if ((covered & range) == range && show_one_strip(words + j)) {
            // Large triangles: all lanes at once, by the operations of the plain kernel in its order.
            const StripEnds& strip = strips[words[j] & 0xffffffff];
            const double Kj = K + static_cast<double>(j);
            const std::size_t half = lanes / 2;
            const auto part =
                hn::Combine(d, parts_of_strip(strip, n, Kj + static_cast<double>(half)), parts_of_strip(strip, n, Kj));
            for (int i = 0; i < 4; ++i)
                values[i] =
                    hn::Add(hn::Set(d, strip.value0[i]), hn::Mul(part, hn::Set(d, strip.value1[i] - strip.value0[i])));
        } else {
            shade_range(j, lanes);
            hn::LoadInterleaved4(d, samples[j], values[0], values[1], values[2], values[3]);
        }
        for (int i = 0; i < 4; ++i)
            if (out.values[i])
                // Past the caches: nobody reads a sample soon after.
                hn::Stream(values[i], d, out.values[i] + column * out.strides[i] + k + j);
    }
}

void Shade(const EpipolarPlane& plane, std::span<const StripEnds> strips, const float (&background)[4],
           const ShadedPlane& out) {
    const std::size_t vector = hn::Lanes(FloatTag()) * sizeof(float);
    bool aligned = plane.directions * sizeof(float) % vector == 0;
    for (int i = 0; i < 4; ++i)
        aligned = aligned && reinterpret_cast<std::uintptr_t>(out.values[i]) % vector == 0 &&
                  out.strides[i] * sizeof(float) % vector == 0;
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; k += 64)
            shade_block(plane, strips, background, out, column, k, std::min<std::size_t>(64, plane.directions - k),
                        aligned);
    hwy::FlushStream();
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(Crossing);
HWY_EXPORT(Draw);
HWY_EXPORT(Farthest);
HWY_EXPORT(Shade);

std::uint64_t crossing(const ClusterCorners& corners, double row, double slope) {
    return HWY_DYNAMIC_DISPATCH(Crossing)(corners, row, slope);
}

void draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane) {
    HWY_DYNAMIC_DISPATCH(Draw)(strips, first, plane);
}

void farthest(const EpipolarPlane& plane, std::span<std::uint32_t> cells) {
    HWY_DYNAMIC_DISPATCH(Farthest)(plane, cells);
}

void shade(const EpipolarPlane& plane, std::span<const StripEnds> strips, const float (&background)[4],
           const ShadedPlane& out) {
    HWY_DYNAMIC_DISPATCH(Shade)(plane, strips, background, out);
}

std::vector<std::int64_t> kernel_targets() { return hwy::SupportedAndGeneratedTargets(); }

void use_kernel_target(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace hogel
#endif
