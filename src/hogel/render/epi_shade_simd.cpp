// The vector twins of epi_kernels.cpp that turn what is seen into values, compiled for every instruction set and chosen
// when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_shade_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <cstddef>

#include "hogel/render/epi_kernels_internal.h"
#include "hogel/render/epi_samples_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void Shade(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    shade_plain(plane, strips, out);
}
#else
// Of samples that all show one strip.
HWY_INLINE void shade_one(const StripShades& strip, Floats n, Floats K, Floats (&values)[4]) {
    const FloatTag d;
    const Floats part = parts_of_one(strip, n, K);
    for (int i = 0; i < 4; ++i)
        values[i] = hn::Add(hn::Set(d, strip.value0[i]), hn::Mul(part, hn::Set(d, strip.difference[i])));
}

// Of samples that show different ones.
HWY_INLINE void shade_several(const std::uint64_t* words, const StripShades* strips, Floats n, Floats K,
                              Floats (&values)[4]) {
    const float* from[hn::MaxLanes(FloatTag())];
    for (std::size_t i = 0; i < hn::MaxLanes(FloatTag()); ++i) from[i] = &strips[words[i] & 0xffffffff].x0;
    const auto load = [&](std::size_t first, std::size_t behind) HWY_ATTR { return load_blocks(from + first, behind); };
    const Floats part = parts_of_several(from, n, K);
    constexpr std::size_t value0 = offsetof(StripShades, value0) / sizeof(float),
                          difference = offsetof(StripShades, difference) / sizeof(float);
    values[0] = hn::Add(load(0, value0), hn::Mul(hn::Broadcast<0>(part), load(0, difference)));
    values[1] = hn::Add(load(1, value0), hn::Mul(hn::Broadcast<1>(part), load(1, difference)));
    values[2] = hn::Add(load(2, value0), hn::Mul(hn::Broadcast<2>(part), load(2, difference)));
    values[3] = hn::Add(load(3, value0), hn::Mul(hn::Broadcast<3>(part), load(3, difference)));
    transpose(values);
}

// A vector of samples of a plane. (Lambdas are not inlined where they are called twice.)
struct ShadeStrips {
    const StripShades* strips;
    float first_column, first_direction;

    HWY_INLINE void operator()(const std::uint64_t* words, std::size_t column, std::size_t k,
                               Floats (&values)[4]) const {
        const FloatTag d;
        const NumberTag du;
        const Floats n = hn::Set(d, first_column + static_cast<float>(column));
        const Floats K = hn::Iota(d, first_direction + static_cast<float>(k));
        const auto first = static_cast<std::uint32_t>(words[0]);
        if (!hn::AllTrue(du, hn::Eq(numbers_of(words), hn::Set(du, first))))
            shade_several(words, strips, n, K, values);
        else if (first != EpipolarPlane::nobody)
            shade_one(strips[first], n, K, values);
        else
            for (int i = 0; i < 4; ++i) values[i] = hn::Set(d, strips[EpipolarPlane::nobody].value0[i]);
    }
};

void Shade(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    shade_vectors(plane, out,
                  ShadeStrips{strips.data(), static_cast<float>(plane.first_column), plane.first_direction});
}
#endif

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
