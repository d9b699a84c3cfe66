// The vector twins of epi_kernels.cpp that turn what is seen into values, compiled for every instruction set and chosen
// when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_shade_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "hogel/render/epi_kernels_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;

// So many samples of a column are taken at once that what is gathered has left the store buffers when it is read.
constexpr std::size_t run = 64;

// The strips of a run of samples, each of the three parts of StripShades side by side.
struct Gathered {
    HWY_ALIGN float places[run][4], values[run][4], differences[run][4];
};

// One strip in all lanes, or a strip a lane.
struct Lanes {
    Floats x0, z0, dx, dz, value0[4], difference[4];
};

HWY_INLINE void shade_lanes(const Lanes& strip, float n, float K, Floats (&values)[4]) {
    const FloatTag d;
    const Floats Ks = hn::Iota(d, K), zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Floats part = hn::Div(hn::Add(hn::Sub(hn::Set(d, n), strip.x0), hn::Mul(Ks, strip.z0)),
                                hn::Sub(strip.dx, hn::Mul(Ks, strip.dz)));
    const Floats positive = hn::IfThenElse(hn::Gt(part, zero), part, zero);
    const Floats inside = hn::IfThenElse(hn::Lt(positive, one), positive, one);
    for (int i = 0; i < 4; ++i) values[i] = hn::Add(strip.value0[i], hn::Mul(inside, strip.difference[i]));
}

HWY_INLINE Lanes one_strip(const StripShades& strip) {
    const FloatTag d;
    Lanes lanes{hn::Set(d, strip.x0), hn::Set(d, strip.z0), hn::Set(d, strip.dx), hn::Set(d, strip.dz), {}, {}};
    for (int i = 0; i < 4; ++i) {
        lanes.value0[i] = hn::Set(d, strip.value0[i]);
        lanes.difference[i] = hn::Set(d, strip.difference[i]);
    }
    return lanes;
}

HWY_INLINE Lanes gathered_strips(const Gathered& from, std::size_t first) {
    const FloatTag d;
    Lanes lanes;
    hn::LoadInterleaved4(d, from.places[first], lanes.x0, lanes.z0, lanes.dx, lanes.dz);
    hn::LoadInterleaved4(d, from.values[first], lanes.value0[0], lanes.value0[1], lanes.value0[2], lanes.value0[3]);
    hn::LoadInterleaved4(d, from.differences[first], lanes.difference[0], lanes.difference[1], lanes.difference[2],
                         lanes.difference[3]);
    return lanes;
}

// Copies the strips of a vector of samples that do not all show the same.
HWY_INLINE void gather(const std::uint32_t* numbers, std::size_t count, std::span<const StripShades> strips,
                       Gathered& to, std::size_t first) {
    for (std::size_t i = 0; i < count; ++i) {
        const StripShades& from = strips[numbers[i]];
        std::memcpy(to.places[first + i], &from.x0, sizeof(float[4]));
        std::memcpy(to.values[first + i], from.value0, sizeof(float[4]));
        std::memcpy(to.differences[first + i], from.difference, sizeof(float[4]));
    }
}

HWY_INLINE bool show_one_strip(const std::uint32_t* numbers) {
    const NumberTag du;
    return hn::AllTrue(du, hn::Eq(hn::Load(du, numbers), hn::Set(du, numbers[0])));
}

void Shade(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    const FloatTag d;
    const std::size_t lanes = hn::Lanes(d);
    const bool aligned = out.begins_at_multiples(lanes);
    const Lanes background = one_strip(strips[EpipolarPlane::nobody]);
    Gathered gathered;
    HWY_ALIGN std::uint32_t numbers[run];
    bool one[run];
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t begin = 0; begin < plane.directions; begin += run) {
            const std::size_t size = std::min(run, plane.directions - begin);
            std::uint64_t* words = plane.words + column * plane.directions + begin;
            for (std::size_t j = 0; j < size; ++j) numbers[j] = static_cast<std::uint32_t>(words[j]);
            std::fill(words, words + size, EpipolarPlane::nothing);
            std::fill(numbers + size, numbers + run, EpipolarPlane::nobody);
            for (std::size_t j = 0; j < size; j += lanes) {
                one[j] = show_one_strip(numbers + j);
                if (!one[j]) gather(numbers + j, lanes, strips, gathered, j);
            }
            const float n = static_cast<float>(plane.first_column) + static_cast<float>(column);
            for (std::size_t j = 0; j < size; j += lanes) {
                const float K = plane.first_direction + static_cast<float>(begin + j);
                Floats values[4];
                if (!one[j])
                    shade_lanes(gathered_strips(gathered, j), n, K, values);
                else if (numbers[j] == EpipolarPlane::nobody)
                    for (int i = 0; i < 4; ++i) values[i] = background.value0[i];
                else
                    shade_lanes(one_strip(strips[numbers[j]]), n, K, values);
                const std::size_t count = std::min(lanes, size - j);
                for (int i = 0; i < 4; ++i) {
                    if (!out.values[i]) continue;
                    float* to = out.values[i] + column * out.strides[i] + begin + j;
                    if (aligned && count == lanes) {
                        hn::Stream(values[i], d, to);  // past the caches: nobody reads a sample soon after
                    } else {
                        HWY_ALIGN float some[HWY_MAX_BYTES / 4];
                        hn::Store(values[i], d, some);
                        std::memcpy(to, some, count * sizeof(float));
                    }
                }
            }
        }
    hwy::FlushStream();
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(Shade);

void shade(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    HWY_DYNAMIC_DISPATCH(Shade)(plane, strips, out);
}

}  // namespace hogel
#endif
