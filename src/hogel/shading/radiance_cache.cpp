// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/radiance_cache.h"

#include <cmath>
#include <new>

namespace hogel::shading {
namespace {

// States of a point besides LightGrid::filled.
constexpr std::uint32_t empty = 0, being_filled = 1;
constexpr double max_cells = LightGrid::node_bits;  // along a side

// Returns the number of cells along a side; the outermost points are inset from its ends.
double cells(double side, double spacing) {
    if (side <= spacing) return 0;
    return std::max(1.0, std::ceil(side / spacing - 2 * LightGrid::inset));
}

// Returns the coordinate, 0 to 1, of point i along an axis of `count` cells.
float node(std::size_t i, std::uint32_t count) {
    if (count == 0) return 0.5f;
    return (static_cast<float>(i) + LightGrid::inset) / (static_cast<float>(count) + 2 * LightGrid::inset);
}

// Layout of a point: one word per value, the state after the third; four shares per word; padded to four words.
std::size_t word_of(std::size_t number) { return number + (number < 3 ? 0 : 1); }
std::size_t first_share(SampleLighting::Size size) { return std::max<std::size_t>(4, size.values + 1); }
std::size_t words_of(SampleLighting::Size size) { return (first_share(size) + (size.shares + 3) / 4 + 3) / 4 * 4; }

float share_of(std::uint32_t word, std::size_t number) { return static_cast<float>(word >> 8 * number & 255) / 255; }

float between(float a, float b, float fraction) { return a + fraction * (b - a); }

}  // namespace

RadianceCache::RadianceCache(const ShadedScene& scene, std::span<const float> spacing, double max_bytes)
    : grids_(scene.triangles.size()) {
    std::vector<std::uint64_t> first(grids_.size());
    for (std::size_t i = 0; i < grids_.size(); ++i) {
        const std::uint32_t mesh = scene.triangles[i].mesh;
        const SampleLighting::Size size = scene.lighting->size_of_light(mesh);
        if (size.sum() == 0 || !(spacing[i] > 0)) continue;
        const auto& vertices = scene.triangles[i].vertices;
        std::array<double, 3> side;  // length of the side opposite each corner
        for (std::size_t k = 0; k < 3; ++k)
            side[k] = length(scene.positions[vertices[(k + 1) % 3]] - scene.positions[vertices[(k + 2) % 3]]);
        const auto corner = static_cast<std::uint32_t>(std::ranges::min_element(side) - side.begin());
        const double rows = cells(*std::ranges::max_element(side), spacing[i]);
        const double columns = cells(side[corner], spacing[i]);
        const double words = (rows + 1) * (columns + 1) * static_cast<double>(words_of(size));
        if (!(rows < max_cells && columns < max_cells && bytes() + words * sizeof(std::uint32_t) <= max_bytes &&
              words < 0x1p31)) {
            ++uncached_triangles_;
            continue;
        }
        LightGrid& grid = grids_[i];
        grid.rows = static_cast<std::uint32_t>(rows);
        grid.columns = static_cast<std::uint32_t>(columns);
        grid.right = static_cast<std::uint32_t>(words_of(size));
        grid.down = grid.right * (grid.columns + 1);
        grid.corner = corner;
        grid.is_radiance = scene.lighting->light_is_radiance(mesh);
        first[i] = words_;
        words_ += static_cast<std::uint64_t>(words);
    }
    points_.reset(static_cast<std::uint32_t*>(std::calloc(words_ + 1, sizeof(std::uint32_t))));
    if (!points_) throw std::bad_alloc();
    for (std::size_t i = 0; i < grids_.size(); ++i)
        if (grids_[i].right > 0) grids_[i].points = points_.get() + first[i];
}

bool RadianceCache::read(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                         std::span<float> light) const {
    const LightGrid& grid = grids_[index];
    if (!grid.points) return false;
    const float towards = grid.towards(weights);
    const LightGrid::Cell row(towards, LightGrid::Axis(grid.rows));
    const LightGrid::Cell column(LightGrid::along(towards, grid.last(weights)), LightGrid::Axis(grid.columns));
    thread_local std::vector<std::uint32_t> scratch;
    const FourPoints points = four_points(scene, index, row.node, column.node, scratch);
    const auto interpolated = [&](auto value) {
        return between(between(value(points[0]), value(points[1]), column.fraction),
                       between(value(points[2]), value(points[3]), column.fraction), row.fraction);
    };
    const SampleLighting::Size size = scene.lighting->size_of_light(scene.triangles[index].mesh);
    for (std::size_t i = 0; i < size.values; ++i) {
        const std::size_t word = word_of(i);
        light[i] = std::max(interpolated([=](const auto* p) { return std::bit_cast<float>(p[word]); }), 0.0f);
    }
    for (std::size_t first = 0; first < size.shares; first += 4) {
        const std::size_t word = first_share(size) + first / 4, last = std::min(first + 4, size.shares);
        const std::uint32_t packed = points[0][word];
        // Usually all points have the same shares; they differ only at the edges of shadows.
        const bool same = packed == points[1][word] && packed == points[2][word] && packed == points[3][word];
        for (std::size_t i = first; i < last; ++i) {
            const auto share = [=](const std::uint32_t* p) { return share_of(p[word], i - first); };
            light[size.values + i] = same ? share(points[0]) : std::clamp(interpolated(share), 0.0f, 1.0f);
        }
    }
    return true;
}

RadianceCache::Corners RadianceCache::corners(const ShadedScene& scene, std::size_t index, std::size_t row,
                                              std::size_t column) const {
    std::vector<std::uint32_t> scratch;
    const FourPoints points = four_points(scene, index, row, column, scratch);
    Corners corners{};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 3; ++i) corners[k][i] = std::bit_cast<float>(points[k][i]);
    return corners;
}

RadianceCache::FourPoints RadianceCache::four_points(const ShadedScene& scene, std::size_t index, std::size_t row,
                                                     std::size_t column, std::vector<std::uint32_t>& scratch) const {
    const LightGrid& grid = grids_[index];
    const std::size_t next_row = std::min<std::size_t>(row + 1, grid.rows);
    const std::size_t next_column = std::min<std::size_t>(column + 1, grid.columns);
    FourPoints points;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t r = k < 2 ? row : next_row, c = k % 2 == 0 ? column : next_column;
        points[k] = grid.points + r * grid.down + c * grid.right;
        if (LightGrid::is_filled(points[k])) continue;
        if (scratch.size() < 4 * std::size_t{grid.right}) scratch.resize(4 * std::size_t{grid.right});
        std::uint32_t* local = scratch.data() + k * grid.right;
        compute_point(scene, index, r, c, local);
        // Only the first thread writes; all threads compute the same numbers.
        std::uint32_t* words = points_.get() + (points[k] - points_.get());
        std::uint32_t expected = empty;
        if (std::atomic_ref(words[3]).compare_exchange_strong(expected, being_filled, std::memory_order_relaxed)) {
            std::copy_n(local, 3, words);
            std::copy_n(local + 4, grid.right - 4, words + 4);
            std::atomic_ref(words[3]).store(LightGrid::filled, std::memory_order_release);
        }
        points[k] = local;
    }
    return points;
}

void RadianceCache::compute_point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                                  std::uint32_t* words) const {
    const LightGrid& grid = grids_[index];
    const SampleLighting::Size size = scene.lighting->size_of_light(scene.triangles[index].mesh);
    // A single row is at the centroid.
    const float towards = grid.rows == 0 ? 2.0f / 3 : node(row, grid.rows), along = node(column, grid.columns);
    std::array<float, 3> weights;
    weights[grid.corner] = 1 - towards;
    weights[(grid.corner + 1) % 3] = towards * (1 - along);
    weights[(grid.corner + 2) % 3] = towards * along;
    std::vector<float> light(size.sum());
    scene.lighting->light_on(scene, index, weights, light);
    std::fill_n(words, grid.right, 0);
    for (std::size_t i = 0; i < size.values; ++i) words[word_of(i)] = std::bit_cast<std::uint32_t>(light[i]);
    for (std::size_t i = 0; i < size.shares; ++i)
        words[first_share(size) + i / 4] |=
            static_cast<std::uint32_t>(std::lround(255 * std::clamp(light[size.values + i], 0.0f, 1.0f)))
            << 8 * (i % 4);
    points_filled_.fetch_add(1, std::memory_order_relaxed);
}

void add_radiance_cache(ShadedScene& scene, std::span<const float> spacing, double max_bytes) {
    if (scene.lighting) scene.radiance_cache = std::make_shared<RadianceCache>(scene, spacing, max_bytes);
}

}  // namespace hogel::shading
