// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/hogel_order.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace hogel::codec::format {
namespace {

// Returns the layer of each of n positions in a row: 0 in the middle, 1 at the ends, then the index of the halving
// that reaches it.
std::vector<int> halving_layers(std::size_t n) {
    std::vector<int> layers(n, 1);
    layers[(n - 1) / 2] = 0;
    if (n < 3) return layers;
    std::vector<std::size_t> ends{0, (n - 1) / 2, n - 1};
    for (int layer = 2;; ++layer) {
        std::vector<std::size_t> next;
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            next.push_back(ends[k]);
            if (ends[k + 1] - ends[k] < 2) continue;
            const std::size_t middle = (ends[k] + ends[k + 1]) / 2;
            layers[middle] = layer;
            next.push_back(middle);
        }
        next.push_back(ends.back());
        if (next.size() == ends.size()) return layers;
        ends = std::move(next);
    }
}

// Returns the nearest references on each side, in the given order.
std::vector<HogelOrder::Reference> nearest(std::vector<HogelOrder::Reference> references, std::size_t per_side) {
    const auto side = [](const HogelOrder::Reference& r) {
        return (r.dt != 0 ? 2u : 0u) + (r.ds + r.dt > 0 ? 1u : 0u);
    };
    std::array<std::vector<int>, 4> distances;
    for (const HogelOrder::Reference& r : references) distances[side(r)].push_back(std::abs(r.ds + r.dt));
    std::array<int, 4> max_distance;
    for (std::size_t k = 0; k < 4; ++k) {
        std::ranges::sort(distances[k]);
        max_distance[k] = distances[k].empty() ? 0 : distances[k][std::min(per_side, distances[k].size()) - 1];
    }
    std::erase_if(references,
                  [&](const HogelOrder::Reference& r) { return std::abs(r.ds + r.dt) > max_distance[side(r)]; });
    return references;
}

}  // namespace

int HogelOrder::layers(std::size_t columns, std::size_t rows) {
    return 1 + std::ranges::max(halving_layers(std::max(columns, rows)));
}

HogelOrder::HogelOrder(std::size_t columns, std::size_t rows, std::size_t references_per_side,
                       std::size_t context_references_per_side) {
    const std::vector<int> of_column = halving_layers(columns), of_row = halving_layers(rows);
    std::vector<std::vector<std::size_t>> in_row(rows), in_column(columns);  // indices of the hogels ordered so far
    const auto distance = [](std::size_t from, std::size_t to) {
        return static_cast<int>(to) - static_cast<int>(from);
    };
    const auto add = [&](std::size_t s, std::size_t t, int layer) {
        std::vector<Reference> earlier;
        for (const std::size_t k : in_row[t]) earlier.push_back({k, distance(s, hogels_[k].s), 0});
        for (const std::size_t k : in_column[s]) earlier.push_back({k, 0, distance(t, hogels_[k].t)});
        hogels_.push_back({s, t, layer, wavefronts_.size() - 1, nearest(earlier, references_per_side),
                           nearest(earlier, context_references_per_side)});
    };
    // Hogels refer only to complete wavefronts.
    const auto end_wavefront = [&] {
        for (std::size_t k = wavefronts_.back(); k < hogels_.size(); ++k) {
            in_row[hogels_[k].t].push_back(k);
            in_column[hogels_[k].s].push_back(k);
        }
    };
    wavefronts_of_layers_.push_back(0);
    wavefronts_.push_back(0);
    add((columns - 1) / 2, (rows - 1) / 2, 0);
    end_wavefront();
    for (int layer = 1; layer < layers(columns, rows); ++layer) {
        wavefronts_of_layers_.push_back(wavefronts_.size());
        // First the hogels between coded ones of their row or column, then those between the former in both directions.
        for (const bool both : {false, true}) {
            wavefronts_.push_back(hogels_.size());
            for (std::size_t t = 0; t < rows; ++t)
                for (std::size_t s = 0; s < columns; ++s)
                    if (std::max(of_column[s], of_row[t]) == layer && (of_column[s] == of_row[t]) == both)
                        add(s, t, layer);
            end_wavefront();
        }
    }
    wavefronts_of_layers_.push_back(wavefronts_.size());
    wavefronts_.push_back(hogels_.size());
}

}  // namespace hogel::codec::format
