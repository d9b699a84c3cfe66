// SPDX-License-Identifier: Apache-2.0
// Compiled for every SIMD target; the first call selects the target. Plain version: OverlapAddHologram::add_plain().
#include "hogel/stereogram/windows/batch.h"

#include <cmath>

#include "hogel/core/random.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/stereogram/philox_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::stereogram::windows::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t width = WindowBatch::hogels;
using D = hn::CappedTag<float, width>;
using V = hn::Vec<D>;
#if HWY_TARGET == HWY_SCALAR
using Wide = hn::CappedTag<double, 1>;
#else
using Wide = hn::Repartition<double, D>;
#endif

// Computes the phases, in fractions of a cycle, and for random phases the columns and rows of points met by rays.
void PointsAndCycles(const WindowBatch::Shared& shared, const WindowDirection& direction,
                     const WindowBatch::Start& start, const float* depths, bool points, float* cycles,
                     std::int32_t* columns, std::int32_t* rows) {
    const Wide d;
    const hn::Rebind<float, Wide> narrow;
    const hn::Rebind<std::int32_t, Wide> integers;
    const auto first = hn::Set(d, direction.first_cycles);
    for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
        const auto depth = hn::PromoteTo(d, hn::LoadU(narrow, depths + i));
        auto phase = hn::MulAdd(depth, hn::Set(d, direction.cycles_per_depth), first);
        if (points) {
            const auto hogels = hn::Mul(depth, hn::Set(d, shared.hogels_a_metre));
            const auto s = hn::Iota(d, static_cast<double>(start.s + i)), t = hn::Set(d, static_cast<double>(start.t));
            const auto spacing = hn::Set(d, point_spacing), pitch = hn::Set(d, shared.pitch);
            const auto column =
                hn::Round(hn::Div(hn::MulAdd(hn::Set(d, static_cast<double>(direction.U)), hogels, s), spacing));
            const auto row =
                hn::Round(hn::Div(hn::NegMulAdd(hn::Set(d, static_cast<double>(direction.V)), hogels, t), spacing));
            const auto x = hn::Mul(hn::MulSub(column, spacing, s), pitch),
                       y = hn::Mul(hn::MulSub(row, spacing, t), pitch);
            const auto distance = hn::Sqrt(hn::MulAdd(y, y, hn::MulAdd(x, x, hn::Mul(depth, depth))));
            const auto path = hn::NegMulAdd(depth, hn::Set(d, shared.reference_cosine), hn::CopySign(distance, depth));
            phase = hn::MulAdd(path, hn::Set(d, shared.waves_a_metre), first);
            hn::StoreU(hn::DemoteTo(integers, column), integers, columns + i);
            hn::StoreU(hn::DemoteTo(integers, row), integers, rows + i);
        }
        hn::StoreU(hn::DemoteTo(narrow, hn::Sub(phase, hn::Round(phase))), narrow, cycles + i);
    }
}

// Stores amplitude · e^{2πi cycles}, by power series of sine and cosine for angles up to an eighth of a cycle.
HWY_INLINE void StoreWave(D d, V amplitude, V cycles, float* re, float* im) {
    const hn::RebindToSigned<D> integers;
    const auto quarters = hn::Round(hn::Mul(cycles, hn::Set(d, 4.0f)));
    const auto angle = hn::Mul(hn::NegMulAdd(quarters, hn::Set(d, 0.25f), cycles), hn::Set(d, 6.28318531f));
    const auto square = hn::Mul(angle, angle);
    auto sine = hn::MulAdd(square, hn::Set(d, -1.0f / 5040), hn::Set(d, 1.0f / 120));
    sine = hn::MulAdd(square, sine, hn::Set(d, -1.0f / 6));
    sine = hn::MulAdd(hn::Mul(square, sine), angle, angle);
    auto cosine = hn::MulAdd(square, hn::Set(d, 1.0f / 40320), hn::Set(d, -1.0f / 720));
    cosine = hn::MulAdd(square, cosine, hn::Set(d, 1.0f / 24));
    cosine = hn::MulAdd(square, cosine, hn::Set(d, -0.5f));
    cosine = hn::MulAdd(square, cosine, hn::Set(d, 1.0f));
    const auto quadrant = hn::ConvertTo(integers, quarters);
    const auto odd = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::And(quadrant, hn::Set(integers, 1)))));
    const auto sign_of = [&](auto number) {
        return hn::BitCast(d, hn::ShiftLeft<30>(hn::And(number, hn::Set(integers, 2))));
    };
    const auto c = hn::Xor(hn::IfThenElse(odd, sine, cosine), sign_of(hn::Add(quadrant, hn::Set(integers, 1))));
    const auto s = hn::Xor(hn::IfThenElse(odd, cosine, sine), sign_of(quadrant));
    hn::StoreU(hn::Mul(amplitude, c), d, re);
    hn::StoreU(hn::Mul(amplitude, s), d, im);
}

#if HWY_TARGET == HWY_SCALAR
void BackdropCycles(const WindowBatch::Start& start, std::uint32_t coefficient, float* cycles) {
    for (std::size_t i = 0; i < width; ++i)
        cycles[i] =
            static_cast<float>(core::philox({static_cast<std::uint32_t>(start.s + i),
                                             static_cast<std::uint32_t>(start.t), coefficient + 1, start.series},
                                            start.key)[0]) *
            0x1p-32f;
}
#else
// Random phases of rays that meet no surface: one Philox draw per hogel, in 64-bit lanes.
void BackdropCycles(const WindowBatch::Start& start, std::uint32_t coefficient, float* cycles) {
    const hn::CappedTag<std::uint64_t, width> d;
    const auto low = hn::Set(d, 0xffffffffu);
    HWY_ALIGN std::uint64_t drawn[width];
    for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
        auto c0 = hn::Iota(d, start.s + i), c1 = hn::Set(d, start.t), c2 = hn::Set(d, coefficient + std::uint64_t{1});
        auto c3 = hn::Set(d, start.series);
        stereogram::HWY_NAMESPACE::philox_lanes(d, c0, c1, c2, c3, start.key);
        hn::Store(hn::And(c0, low), d, drawn + i);
    }
    for (std::size_t i = 0; i < width; ++i)
        cycles[i] = static_cast<float>(static_cast<std::uint32_t>(drawn[i])) * 0x1p-32f;
}
#endif

// See surface_stretch().
HWY_INLINE V Stretch(D d, V z0, V z1, V z2, V depth, float slope) {
    const V before = hn::Sub(z1, z0), after = hn::Sub(z2, z1);
    const V smaller = hn::IfThenElse(hn::Lt(hn::Abs(before), hn::Abs(after)), before, after);
    const V stretch = hn::Div(hn::Mul(smaller, hn::Set(d, slope)), depth);
    const V clamped =
        hn::Min(hn::Max(stretch, hn::Set(d, WindowBrightness::min_stretch)), hn::Set(d, WindowBrightness::max_stretch));
    return hn::IfThenElseZero(hn::IsFinite(stretch), clamped);
}

// See WindowBrightness::on_slope().
HWY_INLINE V OnSlope(D d, const WindowBrightness& brightness, V factor, V stretch) {
    const V one = hn::Set(d, 1.0f);
    const V rho = hn::Min(hn::Mul(hn::Mul(factor, factor), hn::Set(d, brightness.isolated_share())), one);
    const V doubles = hn::NegMulAdd(hn::Set(d, 2.0f), hn::Min(stretch, hn::Zero(d)), one);
    const V energy = hn::MulAdd(rho, doubles, hn::Div(hn::Sub(one, rho), hn::Add(one, stretch)));
    return hn::Div(factor, hn::Sqrt(energy));
}

void FillWindows(const WindowBatch::Shared& shared, WindowBatch::Work& work, const WindowBatch::Start& start,
                 const WindowBatch::PointCycles& points) {
    const D d;
    const hn::RebindToSigned<D> integers;
    constexpr std::size_t last = WindowBrightness::steps - 1;
    const auto steps_a_metre = hn::Set(d, shared.brightness->steps_a_metre());
    HWY_ALIGN float cycles[width], random_cycles[width], amplitudes[width], finite_depths[width];
    HWY_ALIGN std::int32_t columns[width], rows[width];
    for (const WindowDirection& direction : *shared.directions) {
        const float* radiance = &work.radiance.data()[direction.ray * width];
        const float* depth = &work.depth.data()[direction.ray * width];
        bool any_light = false, all_finite = true;
        for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
            const auto light = hn::Mul(hn::LoadU(d, radiance + i), hn::Set(d, direction.share));
            const auto active = hn::Gt(light, hn::Zero(d));
            // Rays that meet no surface are a backdrop: on the plane if smooth, a distant surface if rough.
            auto ray_depth = hn::LoadU(d, depth + i);
            if (!points) ray_depth = hn::IfThenElseZero(hn::IsFinite(ray_depth), ray_depth);
            const auto finite = hn::IsFinite(ray_depth);
            any_light = any_light || !hn::AllFalse(d, active);
            all_finite = all_finite && hn::AllTrue(d, finite);
            const auto farthest = hn::Set(d, static_cast<float>(last));
            const auto position =
                hn::IfThenElse(finite, hn::Min(hn::Mul(hn::Abs(ray_depth), steps_a_metre), farthest), farthest);
            const auto step = hn::ConvertTo(integers, position);
            const auto one_axis = [&](const std::vector<float>& table, std::uint32_t first,
                                      const std::array<std::uint32_t, 3>& along, float slope) {
                const V z0 = hn::LoadU(d, work.depth.data() + along[0] * width + i),
                        z1 = hn::LoadU(d, work.depth.data() + along[1] * width + i),
                        z2 = hn::LoadU(d, work.depth.data() + along[2] * width + i);
                return OnSlope(d, *shared.brightness, hn::GatherIndex(d, table.data() + first, step),
                               Stretch(d, z0, z1, z2, ray_depth, slope));
            };
            const auto bright =
                hn::Mul(one_axis(shared.brightness->across(), direction.across, direction.along_u, direction.slope_u),
                        one_axis(shared.brightness->down(), direction.down, direction.along_v, direction.slope_v));
            hn::Store(hn::IfThenElseZero(active, hn::Mul(hn::Sqrt(light), bright)), d, amplitudes + i);
            hn::Store(hn::IfThenElseZero(finite, ray_depth), d, finite_depths + i);
        }
        float* re = &work.re.data()[direction.coefficient * width];
        float* im = &work.im.data()[direction.coefficient * width];
        if (!any_light) {
            for (std::size_t i = 0; i < width; ++i) re[i] = im[i] = 0;
            continue;
        }
        PointsAndCycles(shared, direction, start, finite_depths, bool(points), cycles, columns, rows);
        if (points) {
            points(columns, rows, random_cycles);
            for (std::size_t i = 0; i < width; i += hn::Lanes(d))
                hn::Store(hn::Add(hn::Load(d, cycles + i), hn::Load(d, random_cycles + i)), d, cycles + i);
        }
        if (points && !all_finite) {
            BackdropCycles(start, direction.coefficient, random_cycles);
            const V first = hn::Set(d, static_cast<float>(direction.first_cycles - std::round(direction.first_cycles)));
            for (std::size_t i = 0; i < width; i += hn::Lanes(d))
                hn::Store(hn::IfThenElse(hn::IsFinite(hn::LoadU(d, depth + i)), hn::Load(d, cycles + i),
                                         hn::Add(hn::Load(d, random_cycles + i), first)),
                          d, cycles + i);
        }
        for (std::size_t i = 0; i < width; i += hn::Lanes(d))
            StoreWave(d, hn::Load(d, amplitudes + i), hn::Load(d, cycles + i), re + i, im + i);
    }
}

// Three sums at once: Σ in[k] e^{2πi kx/n} for x, x + 1 and x + 2.
struct Three {
    V re0, im0, re1, im1, re2, im2;
};
template <class Offsets>
HWY_INLINE Three Sum3(D d, const float* in_re, const float* in_im, const float* roots_re, const float* roots_im,
                      std::size_t terms, const Offsets& offsets_of) {
    const V zero = hn::Zero(d);
    Three sum{zero, zero, zero, zero, zero, zero};
    for (std::size_t k = 0; k < terms; ++k) {
        const auto [input, root] = offsets_of(k);
        const V re = hn::LoadU(d, in_re + input), im = hn::LoadU(d, in_im + input);
        const auto add = [&](V& sum_re, V& sum_im, std::size_t i) {
            const V c = hn::Set(d, roots_re[root + i]), s = hn::Set(d, roots_im[root + i]);
            sum_re = hn::NegMulAdd(im, s, hn::MulAdd(re, c, sum_re));
            sum_im = hn::MulAdd(im, c, hn::MulAdd(re, s, sum_im));
        };
        add(sum.re0, sum.im0, 0);
        add(sum.re1, sum.im1, 1);
        add(sum.re2, sum.im2, 2);
    }
    return sum;
}

struct TermOffsets {
    std::size_t input, root;
};

// Transforms rows of directions to rows of samples.
void TransformRows(WindowBatch::Work& work) {
    const D d;
    const std::size_t n = work.side, padded = work.padded;
    for (const std::uint32_t row : work.rows)
        for (std::size_t x = 0; x < n; x += 3)
            for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
                const std::size_t from = row * n * width + i, to = (row * padded + x) * width + i;
                const Three sum = Sum3(d, work.re.data() + from, work.im.data() + from, work.roots_re.data() + x,
                                       work.roots_im.data() + x, n, [&](std::size_t k) {
                                           return TermOffsets{k * width, k * padded};
                                       });
                float *re = work.across_re.data() + to, *im = work.across_im.data() + to;
                hn::StoreU(sum.re0, d, re);
                hn::StoreU(sum.im0, d, im);
                hn::StoreU(sum.re1, d, re + width);
                hn::StoreU(sum.im1, d, im + width);
                hn::StoreU(sum.re2, d, re + 2 * width);
                hn::StoreU(sum.im2, d, im + 2 * width);
            }
}

// Transforms columns, multiplies them by the window and adds sample (p, q) of all windows at offsets[p] in row q.
void AddColumns(WindowBatch::Work& work, std::size_t q0, std::size_t q1, const std::size_t* offsets,
                std::size_t row_stride, float* sum_re, float* sum_im) {
    const D d;
    const std::size_t n = work.side, padded = work.padded;
    for (std::size_t p = 0; p < n; ++p)
        for (std::size_t q = q0 / 3 * 3; q < q1; q += 3)
            for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
                const std::size_t from = p * width + i;
                const Three sum =
                    Sum3(d, work.across_re.data() + from, work.across_im.data() + from, work.roots_re.data() + q,
                         work.roots_im.data() + q, work.rows.size(), [&](std::size_t k) {
                             return TermOffsets{work.rows[k] * padded * width, work.rows[k] * padded};
                         });
                const auto put = [&](V re, V im, std::size_t to_q) {
                    if (to_q < q0 || to_q >= q1) return;
                    const V weight = hn::Set(d, work.weights[to_q * n + p]);
                    float* to_re = sum_re + (to_q - q0) * row_stride + offsets[p] + i;
                    float* to_im = sum_im + (to_q - q0) * row_stride + offsets[p] + i;
                    hn::StoreU(hn::MulAdd(re, weight, hn::LoadU(d, to_re)), d, to_re);
                    hn::StoreU(hn::MulAdd(im, weight, hn::LoadU(d, to_im)), d, to_im);
                };
                put(sum.re0, sum.im0, q);
                put(sum.re1, sum.im1, q + 1);
                put(sum.re2, sum.im2, q + 2);
            }
}

}  // namespace hogel::stereogram::windows::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <numbers>

#include "hogel/stereogram/lobes.h"

namespace hogel::stereogram::windows {

HWY_EXPORT(FillWindows);
HWY_EXPORT(TransformRows);
HWY_EXPORT(AddColumns);

WindowBatch::WindowBatch(const Shared& shared) : shared_(shared) {
    const std::size_t n = shared.side;
    work_.side = n;
    work_.padded = (n + 2) / 3 * 3;
    work_.hop = shared.hop;
    std::uint32_t rays = 0;
    for (const WindowDirection& direction : *shared.directions) {
        rays = std::max({rays, direction.ray + 1, direction.along_u[2] + 1, direction.along_v[2] + 1});
        const auto row = static_cast<std::uint32_t>(direction.coefficient / n);
        if (std::ranges::find(work_.rows, row) == work_.rows.end()) work_.rows.push_back(row);
    }
    std::ranges::sort(work_.rows);
    const auto make = [](Array<float, 1>& array, std::size_t count) { array = Array<float, 1>({count * hogels}); };
    make(work_.radiance, rays);
    make(work_.depth, rays);
    make(work_.re, n * n);
    make(work_.im, n * n);
    make(work_.across_re, n * work_.padded);
    make(work_.across_im, n * work_.padded);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t x = 0; x < work_.padded; ++x) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(k * x % n) / static_cast<double>(n);
            work_.roots_re.push_back(static_cast<float>(std::cos(angle)));
            work_.roots_im.push_back(static_cast<float>(std::sin(angle)));
        }
    for (const float row : *shared.window)
        for (const float column : *shared.window) work_.weights.push_back(row * column);
}

bool WindowBatch::fill(const Start& start, const float* radiance, const float* depth, std::size_t count,
                       std::size_t rays, const PointCycles& points) {
    if (std::none_of(radiance, radiance + count * rays, [](float value) { return value > 0; })) return false;
    if (count < hogels) std::fill(work_.radiance.data(), work_.radiance.data() + work_.radiance.size(), 0.0f);
    const std::size_t used_rays = work_.radiance.size() / hogels;
    transpose(radiance, rays, count, used_rays, work_.radiance.data(), hogels);
    transpose(depth, rays, count, used_rays, work_.depth.data(), hogels);
    HWY_DYNAMIC_DISPATCH(FillWindows)(shared_, work_, start, points);
    HWY_DYNAMIC_DISPATCH(TransformRows)(work_);
    return true;
}

void WindowBatch::add(const Start& start, Sum& sum) {
    // The window's sample (p, q) is sample (s hop + p, t hop + q) of the sum.
    const std::size_t y = start.t * shared_.hop, end = sum.first_y + sum.height;
    const std::size_t q0 = y < sum.first_y ? sum.first_y - y : 0, q1 = y < end ? std::min(shared_.side, end - y) : 0;
    if (q0 >= q1) return;
    std::array<std::size_t, max_side> offsets;
    for (std::size_t p = 0; p < shared_.side; ++p)
        offsets[p] = (p % shared_.hop) * sum.length + start.s + p / shared_.hop - sum.first_x / shared_.hop;
    const std::size_t row_stride = shared_.hop * sum.length, first = (y + q0 - sum.first_y) * row_stride;
    HWY_DYNAMIC_DISPATCH(AddColumns)
    (work_, q0, q1, offsets.data(), row_stride, sum.re.data() + first, sum.im.data() + first);
}

}  // namespace hogel::stereogram::windows
#endif
