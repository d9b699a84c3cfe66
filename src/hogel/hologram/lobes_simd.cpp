// The vector twin of average_lobes_plain, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/hologram/lobes_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "hogel/hologram/lobes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void AverageLobes(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                  std::size_t row_length, bool of_roots, float* out) {
    const hn::CappedTag<float, hogels_at_once> d;
    const std::size_t lanes = hn::Lanes(d);
    for (const FrequencyGrid::Lobe& lobe : lobes) {
        const float* u = weights + lobe.weights;
        const float* v = u + lobe.nu;
        const float* first = rays + (lobe.v0 * row_length + lobe.u0) * hogels_at_once;
        for (std::size_t i = 0; i < hogels_at_once; i += lanes) {
            auto sum = hn::Zero(d);
            for (std::uint32_t l = 0; l < lobe.nv; ++l) {
                const float* row = first + l * row_length * hogels_at_once + i;
                auto line = hn::Zero(d);
                for (std::uint32_t k = 0; k < lobe.nu; ++k)
                    line = hn::MulAdd(hn::Set(d, u[k]), hn::LoadU(d, row + k * hogels_at_once), line);
                sum = hn::MulAdd(hn::Set(d, v[l]), line, sum);
            }
            const auto scale = hn::Set(d, lobe.scale);
            sum = of_roots ? hn::Mul(sum, hn::Sqrt(scale)) : hn::Sqrt(hn::Mul(hn::Max(sum, hn::Zero(d)), scale));
            hn::StoreU(sum, d, out + i);
        }
        out += hogels_at_once;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(AverageLobes);

void average_lobes(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                   std::size_t row_length, bool of_roots, float* out) {
    HWY_DYNAMIC_DISPATCH(AverageLobes)(lobes, weights, rays, row_length, of_roots, out);
}

}  // namespace hogel
#endif
