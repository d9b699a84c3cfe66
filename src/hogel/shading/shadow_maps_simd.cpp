// SPDX-License-Identifier: Apache-2.0
// Vector version of shadow_maps.cpp for every SIMD target.
#include <algorithm>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/shading/shadow_maps.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::shading::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<double>;
using IndexTag = hn::RebindToSigned<Tag>;
using HalfTag = hn::Rebind<float, Tag>;  // of the same length as Tag
using Doubles = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

constexpr std::size_t max_lanes = HWY_MAX_BYTES / 8;

HWY_INLINE Doubles clamp(Doubles v, Doubles low, Doubles high) { return hn::Min(hn::Max(v, low), high); }

// One lamp per lane; steps as in ShadowMap::visibility(). All functions are inline, to keep values in registers.

// Component along a face's axis, or along the first or second axis after it: pass x, y, z in rotated order.
struct FaceAxis {
    Mask is_y, is_z;

    HWY_INLINE Doubles operator()(Doubles if_x, Doubles if_y, Doubles if_z) const {
        return hn::IfThenElse(is_z, if_z, hn::IfThenElse(is_y, if_y, if_x));
    }
};

// Point on the maps of a vector of lamps.
struct Projected {
    Doubles x, y, z;  // relative to the lamp
    Doubles side, depth, face, column, row;
    FaceAxis along;
    Mask backwards,
        in_front;  // whether the face is on the negative side of its axis; whether the point is apart from the lamp
};

HWY_INLINE Projected project(const ShadowMaps::Table& table, hn::Vec<IndexTag> lamp, Vec3 point) {
    const Tag d;
    const Doubles zero = hn::Zero(d), one = hn::Set(d, 1.0), two = hn::Set(d, 2.0), half = hn::Set(d, 0.5);
    const auto gather = [&](const ShadowMaps::Table::Doubles& values)
                            HWY_ATTR { return hn::GatherIndex(d, values.data(), lamp); };
    Projected p;
    p.x = hn::Sub(hn::Set(d, point.x), gather(table.x));
    p.y = hn::Sub(hn::Set(d, point.y), gather(table.y));
    p.z = hn::Sub(hn::Set(d, point.z), gather(table.z));
    p.side = gather(table.side);
    const Doubles size_x = hn::Abs(p.x), size_y = hn::Abs(p.y), size_z = hn::Abs(p.z);
    const Mask over_x = hn::Lt(size_x, size_y);
    const Doubles larger = hn::IfThenElse(over_x, size_y, size_x);
    p.along.is_z = hn::Lt(larger, size_z);
    p.along.is_y = hn::AndNot(p.along.is_z, over_x);
    p.depth = p.along(size_x, size_y, size_z);
    p.backwards = hn::Lt(p.along(p.x, p.y, p.z), zero);
    p.face = hn::Add(p.along(zero, two, hn::Set(d, 4.0)), hn::IfThenElse(p.backwards, one, zero));
    const Doubles half_side = hn::Mul(half, p.side);
    const auto texel = [&](Doubles component) HWY_ATTR {
        return hn::Sub(hn::Mul(hn::Add(hn::Div(component, p.depth), one), half_side), half);
    };
    p.column = texel(p.along(p.y, p.z, p.x));
    p.row = texel(p.along(p.z, p.x, p.y));
    p.in_front = hn::Gt(p.depth, zero);
    return p;
}

// Columns and rows of the four texels around a point (integers).
struct TexelsAround {
    Doubles columns[2], rows[2];
    hn::Vec<HalfTag> right, down;  // weights of the second column and row
};

HWY_INLINE TexelsAround texels_around(const Projected& p) {
    const Tag d;
    const HalfTag df;
    const Doubles zero = hn::Zero(d), one = hn::Set(d, 1.0), last = hn::Sub(p.side, one);
    const Doubles column = hn::Floor(p.column), row = hn::Floor(p.row);
    return {{clamp(column, zero, last), clamp(hn::Add(column, one), zero, last)},
            {clamp(row, zero, last), clamp(hn::Add(row, one), zero, last)},
            hn::DemoteTo(df, hn::Sub(p.column, column)),
            hn::DemoteTo(df, hn::Sub(p.row, row))};
}

// Fetches the depths of the four texels, texels[2 · row + column][lane], before the first is used.
HWY_INLINE void fetch(const ShadowMaps::Table& table, const std::int64_t* lamps, const Projected& p,
                      const TexelsAround& around, float (*texels)[max_lanes]) {
    const Tag d;
    const IndexTag di;
    HWY_ALIGN std::int64_t indices[4][max_lanes];
    for (std::size_t k = 0; k < 4; ++k) {
        const Doubles in_row =
            hn::Add(hn::Mul(hn::Add(hn::Mul(p.face, p.side), around.rows[k / 2]), p.side), around.columns[k % 2]);
        hn::Store(hn::ConvertTo(di, hn::IfThenElseZero(p.in_front, in_row)), di, indices[k]);
    }
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
        const float* map = table.depth[static_cast<std::size_t>(lamps[i])];
        for (std::size_t k = 0; k < 4; ++k) texels[k][i] = map[indices[k][i]];
    }
}

// Compares each texel with the depth at which its ray meets the tangent plane, and interpolates the results.
HWY_INLINE hn::Vec<HalfTag> compare(const Projected& p, const TexelsAround& around, Vec3 normal,
                                    const float (*texels)[max_lanes]) {
    const Tag d;
    const HalfTag df;
    const Doubles zero = hn::Zero(d), one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
    const Doubles nx = hn::Set(d, normal.x), ny = hn::Set(d, normal.y), nz = hn::Set(d, normal.z);
    const Doubles width = hn::Div(hn::Mul(two, p.depth), p.side);
    const Doubles limit = hn::Add(p.depth, hn::Mul(hn::Set(d, ShadowMap::max_slope), width));
    const Doubles tolerance = hn::Mul(hn::Set(d, ShadowMap::bias), width);
    const Doubles height = hn::Add(hn::Add(hn::Mul(nx, p.x), hn::Mul(ny, p.y)), hn::Mul(nz, p.z));
    const Doubles per_side = hn::Div(one, p.side);
    const Doubles normal_along = p.along(nx, ny, nz);
    const Doubles fall = hn::IfThenElse(p.backwards, hn::Neg(normal_along), normal_along);
    const auto added = [&](Doubles component, Doubles position) HWY_ATTR {
        return hn::Mul(component, hn::Sub(hn::Mul(hn::Add(hn::Mul(two, position), one), per_side), one));
    };
    const Doubles along_columns = p.along(ny, nz, nx), along_rows = p.along(nz, nx, ny);
    const Doubles of_columns[2] = {added(along_columns, around.columns[0]), added(along_columns, around.columns[1])};
    const Doubles of_rows[2] = {added(along_rows, around.rows[0]), added(along_rows, around.rows[1])};
    const auto reached = [&](std::size_t i, std::size_t j) HWY_ATTR {
        const Doubles f = hn::Add(fall, hn::Add(of_columns[i], of_rows[j]));
        const Mask meets = hn::Gt(hn::Mul(f, height), zero);
        const Doubles plane = hn::IfThenElse(meets, hn::Div(height, f), limit);
        const Doubles depth = hn::PromoteTo(d, hn::Load(df, texels[2 * j + i]));
        const Mask arrives = hn::Ge(depth, hn::Sub(hn::Min(plane, limit), tolerance));
        return hn::DemoteTo(df, hn::IfThenElse(arrives, one, zero));
    };
    const auto between = [](auto a, auto b, auto part) HWY_ATTR { return hn::Add(a, hn::Mul(part, hn::Sub(b, a))); };
    return between(between(reached(0, 0), reached(1, 0), around.right),
                   between(reached(0, 1), reached(1, 1), around.right), around.down);
}

void Visibility(const ShadowMaps::Table& table, std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal,
                float* shares) {
    const Tag d;
    const IndexTag di;
    const HalfTag df;
    const std::size_t lanes = hn::Lanes(d);
    const Doubles zero = hn::Zero(d), one = hn::Set(d, 1.0);
    for (std::size_t begin = 0; begin < lamps.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, lamps.size() - begin);
        HWY_ALIGN std::int64_t numbers[max_lanes];
        for (std::size_t i = 0; i < lanes; ++i) numbers[i] = lamps[begin + std::min(i, count - 1)];
        const Projected projected = project(table, hn::Load(di, numbers), point);
        const TexelsAround around = texels_around(projected);
        HWY_ALIGN float texels[4][max_lanes] = {};
        fetch(table, numbers, projected, around, texels);
        const auto share = compare(projected, around, normal, texels);
        HWY_ALIGN float batch[max_lanes], in_front[max_lanes];
        hn::Store(share, df, batch);
        hn::Store(hn::DemoteTo(df, hn::IfThenElse(projected.in_front, one, zero)), df, in_front);
        for (std::size_t i = 0; i < count; ++i) shares[begin + i] = in_front[i] != 0 ? batch[i] : 1;
    }
}

}  // namespace hogel::shading::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::shading {

HWY_EXPORT(Visibility);

void ShadowMaps::visibility(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const {
    HWY_DYNAMIC_DISPATCH(Visibility)(table_, lamps, point, normal, shares);
    if (!any_needs_plain_) return;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        if (needs_plain_[lamps[i]]) shares[i] = maps_[lamps[i]].visibility(point, normal);
}

}  // namespace hogel::shading
#endif
