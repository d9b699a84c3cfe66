// SPDX-License-Identifier: Apache-2.0
// Vector version of gloss.cpp for every SIMD target.
#include <numbers>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/shading/gloss.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::shading::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

LightInLobe Gloss(const LampTable& lamps, const float* visibility, const GlossyPoint& point) {
    const hn::CappedTag<float, LampTable::block> d;
    using Floats = hn::Vec<decltype(d)>;
    const GlossyFloats surface(point);
    const Floats px = hn::Set(d, surface.px), py = hn::Set(d, surface.py), pz = hn::Set(d, surface.pz);
    const Floats nx = hn::Set(d, surface.nx), ny = hn::Set(d, surface.ny), nz = hn::Set(d, surface.nz);
    const Floats vx = hn::Set(d, surface.vx), vy = hn::Set(d, surface.vy), vz = hn::Set(d, surface.vz);
    const Floats cos_view = hn::Set(d, surface.cos_view), alpha2 = hn::Set(d, surface.alpha2),
                 less_alpha2 = hn::Set(d, surface.less_alpha2), masked_view = hn::Set(d, surface.masked_view);
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f);
    const Floats alpha2_per_2pi = hn::Set(d, surface.alpha2 * static_cast<float>(0.5 * std::numbers::inv_pi));
    const auto dot = [](Floats ax, Floats ay, Floats az, Floats bx, Floats by, Floats bz)
                         HWY_ATTR { return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz)); };
    GlossySums sums;
    for (std::size_t i = 0; i < lamps.size(); i += hn::Lanes(d)) {
        const auto load = [d, i](const LampTable::Numbers& numbers)
                              HWY_ATTR { return hn::Load(d, numbers.data() + i); };
        const Floats arriving = hn::LoadU(d, visibility + i), r = load(lamps.r), g = load(lamps.g), b = load(lamps.b);
        const auto above = [&](Floats intensity) HWY_ATTR { return hn::Gt(hn::Mul(arriving, intensity), zero); };
        const auto shines = hn::Or(above(r), hn::Or(above(g), above(b)));
        if (hn::AllFalse(d, shines)) continue;
        const Floats is_point = load(lamps.is_point);
        const Floats wx = hn::Sub(load(lamps.x), hn::Mul(is_point, px)),
                     wy = hn::Sub(load(lamps.y), hn::Mul(is_point, py)),
                     wz = hn::Sub(load(lamps.z), hn::Mul(is_point, pz));
        const Floats squared = dot(wx, wy, wz, wx, wy, wz);
        const Floats per_distance = hn::Div(one, hn::Sqrt(squared));
        const Floats cos_light = hn::Mul(dot(nx, ny, nz, wx, wy, wz), per_distance);
        const Floats towards = hn::Mul(dot(vx, vy, vz, wx, wy, wz), per_distance);
        const Floats half_squared = hn::Add(two, hn::Mul(two, towards));
        const auto visible_lanes = hn::And(hn::And(shines, hn::Gt(squared, zero)),
                                           hn::And(hn::Gt(cos_light, zero), hn::Gt(half_squared, zero)));
        if (hn::AllFalse(d, visible_lanes)) continue;
        const Floats per_between = hn::Div(one, hn::Sqrt(half_squared));
        const Floats cos_half = hn::Mul(hn::Add(cos_light, cos_view), per_between);
        const Floats view_half = hn::Mul(hn::Add(one, towards), per_between);
        const Floats spread = hn::Sub(one, hn::Mul(hn::Mul(cos_half, cos_half), less_alpha2));
        const Floats masked_light = hn::Sqrt(hn::Add(alpha2, hn::Mul(hn::Mul(less_alpha2, cos_light), cos_light)));
        const Floats visible = hn::Add(hn::Mul(cos_view, masked_light), hn::Mul(cos_light, masked_view));
        const Floats falloff = hn::IfThenElse(hn::Gt(is_point, zero), hn::Div(one, squared), one);
        const Floats peak =
            hn::Mul(hn::Mul(hn::Div(alpha2_per_2pi, hn::Mul(hn::Mul(spread, spread), visible)), cos_light),
                    hn::Mul(arriving, falloff));
        const Floats complement = hn::Sub(one, hn::Min(view_half, one)), complement2 = hn::Mul(complement, complement);
        const Floats at_grazing = hn::Mul(peak, hn::Mul(hn::Mul(complement2, complement2), complement)),
                     at_normal = hn::Sub(peak, at_grazing);
        const Floats intensity[3] = {r, g, b};
        for (std::size_t c = 0; c < 3; ++c)
            for (const auto& [part, value] : {std::pair{c, at_normal}, std::pair{3 + c, at_grazing}}) {
                float* sum = sums.values[part] + i % LampTable::block;
                hn::Store(hn::Add(hn::Load(d, sum), hn::IfThenElseZero(visible_lanes, hn::Mul(value, intensity[c]))), d,
                          sum);
            }
    }
    return sums.total();
}

}  // namespace hogel::shading::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::shading {
HOGEL_DISPATCH(gloss, Gloss);
}  // namespace hogel::shading
