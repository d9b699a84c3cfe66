// The vector twin of farthest_plain in epi_kernels.cpp, compiled for every instruction set and chosen when first
// called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_occlusion_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>

#include "hogel/render/epi_kernels_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

HWY_EXPORT(Farthest);

void farthest(const EpipolarPlane& plane, std::span<std::uint32_t> cells) {
    HWY_DYNAMIC_DISPATCH(Farthest)(plane, cells);
}

}  // namespace hogel
#endif
