// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/hogel_order.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace hogel::codec::format {
namespace {

// The level of each of n places in a row: of the ends and the middle one, then that of the halving that reaches it.
std::vector<int> halving_levels(std::size_t n) {
    std::vector<int> levels(n, 1);
    levels[(n - 1) / 2] = 0;
    if (n < 3) return levels;
    std::vector<std::size_t> ends{0, (n - 1) / 2, n - 1};
    for (int level = 2;; ++level) {
        std::vector<std::size_t> next;
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            next.push_back(ends[k]);
            if (ends[k + 1] - ends[k] < 2) continue;
            const std::size_t middle = (ends[k] + ends[k + 1]) / 2;
            levels[middle] = level;
            next.push_back(middle);
        }
        next.push_back(ends.back());
        if (next.size() == ends.size()) return levels;
        ends = std::move(next);
    }
}

// The nearest ones on each side, in the order in which they are.
std::vector<HogelOrder::Reference> nearest(std::vector<HogelOrder::Reference> references, std::size_t a_side) {
    const auto side = [](const HogelOrder::Reference& r) {
        return (r.dt != 0 ? 2u : 0u) + (r.ds + r.dt > 0 ? 1u : 0u);
    };
    std::array<std::vector<int>, 4> distances;
    for (const HogelOrder::Reference& r : references) distances[side(r)].push_back(std::abs(r.ds + r.dt));
    std::array<int, 4> farthest;
    for (std::size_t k = 0; k < 4; ++k) {
        std::ranges::sort(distances[k]);
        farthest[k] = distances[k].empty() ? 0 : distances[k][std::min(a_side, distances[k].size()) - 1];
    }
    std::erase_if(references,
                  [&](const HogelOrder::Reference& r) { return std::abs(r.ds + r.dt) > farthest[side(r)]; });
    return references;
}

}  // namespace

int HogelOrder::levels(std::size_t columns, std::size_t rows) {
    return 1 + std::ranges::max(halving_levels(std::max(columns, rows)));
}

HogelOrder::HogelOrder(std::size_t columns, std::size_t rows, std::size_t references_a_side,
                       std::size_t tellers_a_side) {
    const std::vector<int> of_column = halving_levels(columns), of_row = halving_levels(rows);
    std::vector<std::vector<std::size_t>> in_row(rows), in_column(columns);  // places in the order
    const auto distance = [](std::size_t from, std::size_t to) {
        return static_cast<int>(to) - static_cast<int>(from);
    };
    const auto add = [&](std::size_t s, std::size_t t, int level) {
        std::vector<Reference> earlier;
        for (const std::size_t k : in_row[t]) earlier.push_back({k, distance(s, hogels_[k].s), 0});
        for (const std::size_t k : in_column[s]) earlier.push_back({k, 0, distance(t, hogels_[k].t)});
        hogels_.push_back(
            {s, t, level, waves_.size() - 1, nearest(earlier, references_a_side), nearest(earlier, tellers_a_side)});
    };
    // Hogels of a wave do not refer to each other, so they count as coded only when the wave is complete.
    const auto end_wave = [&] {
        for (std::size_t k = waves_.back(); k < hogels_.size(); ++k) {
            in_row[hogels_[k].t].push_back(k);
            in_column[hogels_[k].s].push_back(k);
        }
    };
    waves_of_levels_.push_back(0);
    waves_.push_back(0);
    add((columns - 1) / 2, (rows - 1) / 2, 0);
    end_wave();
    for (int level = 1; level < levels(columns, rows); ++level) {
        waves_of_levels_.push_back(waves_.size());
        for (const bool both : {false, true}) {  // new in one direction; then in both, between those
            waves_.push_back(hogels_.size());
            for (std::size_t t = 0; t < rows; ++t)
                for (std::size_t s = 0; s < columns; ++s)
                    if (std::max(of_column[s], of_row[t]) == level && (of_column[s] == of_row[t]) == both)
                        add(s, t, level);
            end_wave();
        }
    }
    waves_of_levels_.push_back(waves_.size());
    waves_.push_back(hogels_.size());
}

}  // namespace hogel::codec::format
