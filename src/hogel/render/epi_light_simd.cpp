// The vector twin of epi_light.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_light_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>

#include "hogel/render/epi_light_internal.h"
#include "hogel/render/sample_store_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A single lane holds no four values.
void ShadeLit(const EpipolarPlane& plane, std::span<const StripShades> strips, std::span<const StripLight> lights,
              const SampleSource& samples, const ShadedPlane& out) {
    shade_lit_plain(plane, strips, lights, samples, out);
}
#else
using Four = hn::Full128<float>;
using FloatTag = hn::ScalableTag<float>;

constexpr std::size_t block = 64;  // samples at once

// The light of four points around a place, and a zero.
HWY_INLINE hn::Vec<Four> light_of_points(const StripLight& light, float part, std::size_t strip,
                                         const SampleSource& samples) {
    const Four d;
    const hn::Full128<std::uint64_t> d64;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    // Lane 0: towards the side opposite the corner, lane 1: along the row. LightGrid::along and LightGrid::Place.
    const auto ends = hn::Load(d, light.place), axes = hn::Load(d, light.scale);
    const auto place = hn::Add(ends, hn::Mul(hn::Set(d, part), hn::Shuffle1032(ends)));
    const auto row_width = hn::Max(hn::Broadcast<0>(place), hn::Set(d, 1e-30f));
    const auto in_row = hn::IfThenElse(hn::FirstN(d, 1), place, hn::Div(place, row_width));
    const auto parts = hn::Min(hn::Max(in_row, zero), one);
    const auto at = hn::Sub(hn::Mul(parts, axes), hn::Set(d, LightGrid::inset + 0.5f));
    const auto to_whole = hn::Set(d, LightGrid::to_whole);
    const auto rounded = hn::Add(hn::Min(hn::Max(at, hn::Set(d, -0.25f)), hn::Shuffle1032(axes)), to_whole);
    const auto beyond = hn::Add(hn::Sub(at, hn::Sub(rounded, to_whole)), half);
    const std::uint64_t nodes = hn::GetLane(hn::BitCast(d64, rounded));
    const auto row = static_cast<std::uint32_t>(nodes) & LightGrid::node_bits;
    const auto column = static_cast<std::uint32_t>(nodes >> 32) & LightGrid::node_bits;

    const std::uint32_t* upper = light.points + std::uint64_t{row} * light.down + std::uint64_t{column} * light.right;
    const std::uint32_t* lower = upper + light.down;
    hn::Vec<Four> corner[4];
    if (LightGrid::are_made(upper, upper + light.right, lower, lower + light.right)) {
        // The word that says so is −0 as a float.
        const auto load = [d](const std::uint32_t* point)
                              HWY_ATTR { return hn::Load(d, reinterpret_cast<const float*>(point)); };
        corner[0] = load(upper);
        corner[1] = load(upper + light.right);
        corner[2] = load(lower);
        corner[3] = load(lower + light.right);
    } else {
        const LightCache::Corners made = samples.corners(strip, row, column);
        for (std::size_t k = 0; k < 4; ++k) corner[k] = hn::LoadU(d, made[k].data());
    }
    const auto right = hn::Broadcast<1>(beyond), down = hn::Broadcast<0>(beyond);
    const auto between = [](hn::Vec<Four> v, hn::Vec<Four> w, hn::Vec<Four> to_w)
                             HWY_ATTR { return hn::Add(v, hn::Mul(to_w, hn::Sub(w, v))); };
    return hn::Max(between(between(corner[0], corner[1], right), between(corner[2], corner[3], right), down), zero);
}

// Sample (column, k) of a plane, which sees a strip.
HWY_INLINE hn::Vec<Four> lit_sample(const StripShades& strip, const StripLight& light, std::size_t number, float n,
                                    float K, std::size_t column, std::size_t k, const SampleSource& samples,
                                    const ShadedPlane& out) {
    const Four d;
    const float part = part_of_strip(strip, n, K);
    const bool colour = out.values[1] != nullptr;
    if (light.points && colour && !out.values[3]) return light_of_points(light, part, number, samples);

    const auto ends = hn::Add(hn::LoadU(d, strip.value0), hn::Mul(hn::Set(d, part), hn::LoadU(d, strip.difference)));
    if (light.from == StripLight::From::ends) return ends;
    HWY_ALIGN float value[4];
    Rgb radiance;
    if (light.points) {
        hn::Store(light_of_points(light, part, number, samples), d, value);
        radiance = {value[0], value[1], value[2]};
    } else {
        radiance = samples.radiance(number, part, column, k);
    }
    hn::Store(ends, d, value);
    value[0] = colour ? radiance.r : luminance(radiance);
    value[1] = radiance.g;
    value[2] = radiance.b;
    return hn::Load(d, value);
}

void ShadeLit(const EpipolarPlane& plane, std::span<const StripShades> strips, std::span<const StripLight> lights,
              const SampleSource& samples, const ShadedPlane& out) {
    const FloatTag d;
    const Four d4;
    const bool aligned = plane.directions % hn::Lanes(d) == 0 && out.begins_at_multiples(hn::Lanes(d));
    const auto background = hn::LoadU(d4, strips[EpipolarPlane::nobody].value0);
    HWY_ALIGN float values[block][4];
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t first = 0; first < plane.directions; first += block) {
            const std::size_t count = std::min(block, plane.directions - first);
            std::uint64_t* words = plane.words + column * plane.directions + first;
            const float n = static_cast<float>(plane.first_column) + static_cast<float>(column);
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t number = words[i] & 0xffffffff;
                const float K = plane.first_direction + static_cast<float>(first + i);
                hn::Store(number == EpipolarPlane::nobody ? background
                                                          : lit_sample(strips[number], lights[number], number, n, K,
                                                                       column, first + i, samples, out),
                          d4, values[i]);
            }
            std::fill(words, words + count, EpipolarPlane::nothing);
            float* to[4];
            for (int i = 0; i < 4; ++i)
                to[i] = out.values[i] ? out.values[i] + column * out.strides[i] + first : nullptr;
            std::size_t i = 0;
            for (; aligned && i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
                hn::Vec<FloatTag> lanes[4];
                hn::LoadInterleaved4(d, values[i], lanes[0], lanes[1], lanes[2], lanes[3]);
                // Past the caches: nobody reads a sample soon after.
                for (int v = 0; v < 4; ++v)
                    if (to[v]) hn::Stream(lanes[v], d, to[v] + i);
            }
            for (; i < count; ++i)
                for (int v = 0; v < 4; ++v)
                    if (to[v]) to[v][i] = values[i][v];
        }
    hwy::FlushStream();
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(ShadeLit);

void shade_lit(const EpipolarPlane& plane, std::span<const StripShades> strips, std::span<const StripLight> lights,
               const SampleSource& samples, const ShadedPlane& out) {
    HWY_DYNAMIC_DISPATCH(ShadeLit)(plane, strips, lights, samples, out);
}

}  // namespace hogel
#endif
