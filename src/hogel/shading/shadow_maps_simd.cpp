// SPDX-License-Identifier: Apache-2.0
// The vector twin of shadow_maps.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/shading/shadow_maps_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>

#include "hogel/shading/shadow_maps.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::shading {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<double>;
using IndexTag = hn::RebindToSigned<Tag>;
using HalfTag = hn::Rebind<float, Tag>;  // as many floats
using Doubles = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

constexpr std::size_t max_lanes = HWY_MAX_BYTES / 8;

// As std::clamp.
HWY_INLINE Doubles clamp(Doubles v, Doubles low, Doubles high) { return hn::Min(hn::Max(v, low), high); }

// A lamp a lane: ShadowMap::lit, step by step.
void Lit(const ShadowMaps::Table& table, std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) {
    const Tag d;
    const IndexTag di;
    const HalfTag df;
    const std::size_t lanes = hn::Lanes(d);
    const Doubles zero = hn::Zero(d), one = hn::Set(d, 1.0), two = hn::Set(d, 2.0), half = hn::Set(d, 0.5);
    const Doubles nx = hn::Set(d, normal.x), ny = hn::Set(d, normal.y), nz = hn::Set(d, normal.z);
    for (std::size_t begin = 0; begin < lamps.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, lamps.size() - begin);
        HWY_ALIGN std::int64_t numbers[max_lanes];
        for (std::size_t i = 0; i < lanes; ++i) numbers[i] = lamps[begin + std::min(i, count - 1)];
        const auto lamp = hn::Load(di, numbers);
        const auto of = [&](const ShadowMaps::Table::Doubles& values)
                            HWY_ATTR { return hn::GatherIndex(d, values.data(), lamp); };
        const Doubles x = hn::Sub(hn::Set(d, point.x), of(table.x)), y = hn::Sub(hn::Set(d, point.y), of(table.y)),
                      z = hn::Sub(hn::Set(d, point.z), of(table.z)), side = of(table.side);
        // The face, and what lies along its axis and the two after it.
        const Doubles size_x = hn::Abs(x), size_y = hn::Abs(y), size_z = hn::Abs(z);
        const Mask over_x = hn::Lt(size_x, size_y);
        const Doubles larger = hn::IfThenElse(over_x, size_y, size_x);
        const Mask is_z = hn::Lt(larger, size_z), is_y = hn::AndNot(is_z, over_x);
        const auto along = [&](Doubles if_x, Doubles if_y, Doubles if_z)
                               HWY_ATTR { return hn::IfThenElse(is_z, if_z, hn::IfThenElse(is_y, if_y, if_x)); };
        const Doubles depth = along(size_x, size_y, size_z);
        const Mask backwards = hn::Lt(along(x, y, z), zero);
        const Doubles face = hn::Add(along(zero, two, hn::Set(d, 4.0)), hn::IfThenElse(backwards, one, zero));
        const Doubles half_side = hn::Mul(half, side);
        const auto texel = [&](Doubles component) HWY_ATTR {
            return hn::Sub(hn::Mul(hn::Add(hn::Div(component, depth), one), half_side), half);
        };
        const Doubles column = texel(along(y, z, x)), row = texel(along(z, x, y));
        const Mask there = hn::Gt(depth, zero);

        const Doubles width = hn::Div(hn::Mul(two, depth), side);
        const Doubles limit = hn::Add(depth, hn::Mul(hn::Set(d, ShadowMap::steepest), width));
        const Doubles nearest = hn::Mul(hn::Set(d, ShadowMap::bias), width);
        const Doubles height = hn::Add(hn::Add(hn::Mul(nx, x), hn::Mul(ny, y)), hn::Mul(nz, z));
        const Doubles last = hn::Sub(side, one), per_side = hn::Div(one, side);
        const Doubles whole_column = hn::Floor(column), whole_row = hn::Floor(row);
        const Doubles columns[2] = {clamp(whole_column, zero, last), clamp(hn::Add(whole_column, one), zero, last)};
        const Doubles rows[2] = {clamp(whole_row, zero, last), clamp(hn::Add(whole_row, one), zero, last)};
        const Doubles normal_along = along(nx, ny, nz);
        const Doubles fall = hn::IfThenElse(backwards, hn::Neg(normal_along), normal_along);
        const auto added = [&](Doubles component, Doubles at) HWY_ATTR {
            return hn::Mul(component, hn::Sub(hn::Mul(hn::Add(hn::Mul(two, at), one), per_side), one));
        };
        const Doubles along_columns = along(ny, nz, nx), along_rows = along(nz, nx, ny);
        const Doubles of_columns[2] = {added(along_columns, columns[0]), added(along_columns, columns[1])};
        const Doubles of_rows[2] = {added(along_rows, rows[0]), added(along_rows, rows[1])};

        // All texels are fetched before one is looked at.
        HWY_ALIGN std::int64_t places[4][max_lanes];
        HWY_ALIGN float texels[4][max_lanes] = {};
        for (std::size_t k = 0; k < 4; ++k) {
            const Doubles in_row = hn::Add(hn::Mul(hn::Add(hn::Mul(face, side), rows[k / 2]), side), columns[k % 2]);
            hn::Store(hn::ConvertTo(di, hn::IfThenElseZero(there, in_row)), di, places[k]);
        }
        for (std::size_t i = 0; i < lanes; ++i) {
            const float* map = table.depth[static_cast<std::size_t>(numbers[i])];
            for (std::size_t k = 0; k < 4; ++k) texels[k][i] = map[places[k][i]];
        }
        const auto compare = [&](std::size_t i, std::size_t j) HWY_ATTR {
            const Doubles f = hn::Add(fall, hn::Add(of_columns[i], of_rows[j]));
            const Mask meets = hn::Gt(hn::Mul(f, height), zero);
            const Doubles plane = hn::IfThenElse(meets, hn::Div(height, f), limit);
            const Doubles seen = hn::PromoteTo(d, hn::Load(df, texels[2 * j + i]));
            const Mask reached = hn::Ge(seen, hn::Sub(hn::Min(plane, limit), nearest));
            return hn::DemoteTo(df, hn::IfThenElse(reached, one, zero));
        };
        const auto right = hn::DemoteTo(df, hn::Sub(column, whole_column)),
                   down = hn::DemoteTo(df, hn::Sub(row, whole_row));
        const auto between = [](auto a, auto b, auto part)
                                 HWY_ATTR { return hn::Add(a, hn::Mul(part, hn::Sub(b, a))); };
        const auto share =
            between(between(compare(0, 0), compare(1, 0), right), between(compare(0, 1), compare(1, 1), right), down);
        HWY_ALIGN float some[max_lanes], lit[max_lanes];
        hn::Store(share, df, some);
        hn::Store(hn::DemoteTo(df, hn::IfThenElse(there, one, zero)), df, lit);
        for (std::size_t i = 0; i < count; ++i) shares[begin + i] = lit[i] != 0 ? some[i] : 1;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel::shading
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::shading {

HWY_EXPORT(Lit);

void ShadowMaps::lit(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const {
    HWY_DYNAMIC_DISPATCH(Lit)(table_, lamps, point, normal, shares);
    if (!any_other_) return;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        if (other_[lamps[i]]) shares[i] = maps_[lamps[i]].lit(point, normal);
}

}  // namespace hogel::shading
#endif
