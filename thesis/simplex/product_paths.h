// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace hogel::simplex {

/// Corner of the product of two simplices: one corner of each.
struct ProductCorner {
    std::size_t first = 0, second = 0;
};

/// Returns the decomposition of an (m, n)-simploid, the product of an m-simplex and an n-simplex, into (m +
/// n)-simplices: one for each path from its corner (0, 0) to its corner (m, n) along edges that increase one of the two
/// labels by one. These are the tables of [K] fig. 5.17 to 5.20. Two simploids that share a face divide it in the same
/// way if they label its corners in the same order. `Corners` = m + n + 1; the result holds (m + n)!/(m! n!) simplices.
/// Source: [K] 5.6.1.
template <std::size_t Corners>
std::span<const std::array<ProductCorner, Corners>> product_paths(std::size_t m);

template <std::size_t Corners>
struct ProductPathTable {
    static constexpr std::size_t max_paths = 6;  // 4!/(2! 2!), in four dimensions
    static_assert(Corners <= 5);

    std::array<std::array<ProductCorner, Corners>, max_paths> paths{};
    std::size_t count = 0;

    constexpr explicit ProductPathTable(std::size_t m) {
        // Bit i of `steps` is set if step i increases the first label.
        for (std::size_t steps = 0; steps < std::size_t{1} << (Corners - 1); ++steps) {
            std::array<ProductCorner, Corners> path{};
            for (std::size_t i = 0; i + 1 < Corners; ++i) {
                const bool first = (steps >> i & 1) != 0;
                path[i + 1] = {path[i].first + (first ? 1 : 0), path[i].second + (first ? 0 : 1)};
            }
            if (path.back().first == m) paths[count++] = path;
        }
    }
};

template <std::size_t Corners>
constexpr auto product_path_tables = []<std::size_t... m>(std::index_sequence<m...>) {
    return std::array{ProductPathTable<Corners>(m)...};
}
(std::make_index_sequence<Corners>());

template <std::size_t Corners>
std::span<const std::array<ProductCorner, Corners>> product_paths(std::size_t m) {
    const ProductPathTable<Corners>& table = product_path_tables<Corners>[m];
    return {table.paths.data(), table.count};
}

}  // namespace hogel::simplex
