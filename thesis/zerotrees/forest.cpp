// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/forest.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hogel/error.h"

namespace hogel::zerotrees {
namespace {

struct Side {
    std::size_t begin, extent;
    std::vector<std::size_t> parents;  // [position in the band]: position of the parent along the axis
};

// A band of one group of axes: one Side per axis.
struct GroupBand {
    std::vector<Side> sides;
    int depth;
    std::size_t parent;  // index of the parent band in the group; coarse samples are their own parent
};

// Returns the positions of the parents of a row of children: each parent has two children, the last one the remainder.
std::vector<std::size_t> halved(std::size_t children, std::size_t begin, std::size_t parents) {
    std::vector<std::size_t> positions(children);
    for (std::size_t i = 0; i < children; ++i) positions[i] = begin + std::min(i / 2, parents - 1);
    return positions;
}

std::vector<GroupBand> bands_of_group(const wavelets::Pyramid& pyramid, const wavelets::AxisGroup& group) {
    const std::size_t axes = group.axes.size();
    const auto extent = [&](std::size_t a, int level) { return pyramid.coarse_extent(group.axes[a], level); };
    // The orientation of a band is the set of axes, as bits, along which it has details. halving() returns the set of
    // axes that a level splits.
    const auto halving = [&](int level) {
        std::size_t set = 0;
        for (std::size_t a = 0; a < axes; ++a)
            if (level <= group.levels && extent(a, level - 1) > 1) set |= std::size_t{1} << a;
        return set;
    };
    std::vector<GroupBand> bands;
    GroupBand coarse{{}, 0, 0};
    for (std::size_t a = 0; a < axes; ++a) {
        const std::size_t n = extent(a, group.levels);
        Side side{0, n, {}};
        for (std::size_t i = 0; i < n; ++i) side.parents.push_back(i);
        coarse.sides.push_back(side);
    }
    bands.push_back(coarse);
    std::map<std::pair<int, std::size_t>, std::size_t> known;  // level and orientation -> band
    for (int level = group.levels; level >= 1; --level)
        for (std::size_t set = 1; set < std::size_t{1} << axes; ++set) {
            if ((set & halving(level)) != set) continue;
            const std::size_t above = set & halving(level + 1);
            const auto found = known.find({level + 1, above});
            const bool below_coarse = found == known.end();
            GroupBand band{{}, group.levels - level + 1, below_coarse ? 0 : found->second};
            for (std::size_t a = 0; a < axes; ++a) {
                const std::size_t bit = std::size_t{1} << a;
                const std::size_t coarse_count = extent(a, level);
                const std::size_t begin = set & bit ? coarse_count : 0;
                Side side{begin, set & bit ? extent(a, level - 1) - coarse_count : coarse_count, {}};
                const Side& parent = bands[band.parent].sides[a];
                if (below_coarse)
                    for (std::size_t i = 0; i < side.extent; ++i)
                        side.parents.push_back(std::min(i >> (group.levels - level), parent.extent - 1));
                else
                    side.parents = halved(side.extent, parent.begin, parent.extent);
                band.sides.push_back(std::move(side));
            }
            known[{level, set}] = bands.size();
            bands.push_back(std::move(band));
        }
    return bands;
}

}  // namespace

Forest::Forest(const wavelets::Pyramid& pyramid) : strides_(pyramid.strides()), size_(pyramid.size()) {
    const std::size_t rank = pyramid.shape().size();
    if (rank > 8) throw Error(ErrorCode::usage, fmt::format("zerotrees: {} dimensions, expected at most 8", rank));
    // Axes that belong to no group are treated as groups that are not split.
    std::vector<wavelets::AxisGroup> groups = pyramid.groups();
    for (std::size_t axis = 0; axis < rank; ++axis)
        if (std::none_of(groups.begin(), groups.end(), [&](const wavelets::AxisGroup& group) {
                return std::find(group.axes.begin(), group.axes.end(), axis) != group.axes.end();
            }))
            groups.push_back({{axis}, 0});
    std::vector<std::vector<GroupBand>> by_group;
    std::size_t combinations = 1;
    for (const wavelets::AxisGroup& group : groups) {
        by_group.push_back(bands_of_group(pyramid, group));
        combinations *= by_group.back().size();
        if (combinations > 100000)
            throw Error(ErrorCode::usage, "zerotrees: more than 100000 bands, expected fewer levels or fewer groups");
    }
    std::vector<std::size_t> parents(combinations, no_parent);
    std::vector<bool> has_children(combinations);
    for (std::size_t combination = 0; combination < combinations; ++combination) {
        Band band{std::vector<std::size_t>(rank), 0, std::vector<std::vector<std::size_t>>(rank), 0, true};
        std::size_t rest = combination, parent = 0, factor = 1;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const GroupBand& part = by_group[g][rest % by_group[g].size()];
            rest /= by_group[g].size();
            parent += factor * part.parent;
            factor *= by_group[g].size();
            band.depth += part.depth;
            for (std::size_t a = 0; a < groups[g].axes.size(); ++a) {
                const std::size_t axis = groups[g].axes[a];
                band.extent[axis] = part.sides[a].extent;
                band.origin += part.sides[a].begin * strides_[axis];
                for (std::size_t position : part.sides[a].parents)
                    band.parents[axis].push_back(position * strides_[axis]);
            }
        }
        if (band.depth > 0) has_children[parent] = true;
        bands_.push_back(std::move(band));
    }
    for (std::size_t combination = 0; combination < combinations; ++combination)
        bands_[combination].leaf = !has_children[combination];
    std::stable_sort(bands_.begin(), bands_.end(), [](const Band& a, const Band& b) { return a.depth < b.depth; });
}

}  // namespace hogel::zerotrees
