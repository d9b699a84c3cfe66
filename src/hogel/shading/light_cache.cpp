#include "hogel/shading/light_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>

namespace hogel {
namespace {

constexpr std::uint32_t made = 1;
constexpr double most_cells = 1 << 30;  // along a side, so that their numbers fit

// The outermost points lie this part of a cell within the triangle: just at its corners and sides it touches others,
// and shadows of what touches say little about what is around. Four points on a small triangle are about where Gauss
// puts them.
constexpr float inset = 0.25f;

double cells(double side, double spacing) { return std::max(1.0, std::ceil(side / spacing)); }

float node(std::size_t i, std::uint32_t count) {
    return (static_cast<float>(i) + inset) / (static_cast<float>(count) + 2 * inset);
}

// A place from 0 to 1 along a side as the node before it and how far it is on from there in steps: from −inset on the
// first stretch to 1 + inset on the last.
struct Place {
    std::uint32_t node;
    float beyond;

    Place(float part, std::uint32_t cells) {
        const float at = part * (static_cast<float>(cells) + 2 * inset) - inset;
        node = std::min(static_cast<std::uint32_t>(std::max(at, 0.0f)), cells - 1);
        beyond = at - static_cast<float>(node);
    }
};

std::uint32_t load(const std::uint32_t& word) {
    return std::atomic_ref(const_cast<std::uint32_t&>(word)).load(std::memory_order_relaxed);
}

}  // namespace

std::size_t LightCache::words_of(SampleLighting::Size size) { return 1 + size.any + (size.shares + 3) / 4; }

LightCache::LightCache(const ShadedScene& scene, std::span<const float> spacing, double most_bytes)
    : grids_(scene.triangles.size()) {
    for (std::size_t i = 0; i < grids_.size(); ++i) {
        const SampleLighting::Size size = scene.lighting->size_of_light(scene.triangles[i].mesh);
        if (size.sum() == 0 || !(spacing[i] > 0)) continue;
        const auto& vertices = scene.triangles[i].vertices;
        std::array<double, 3> side;  // opposite of each corner
        for (std::size_t k = 0; k < 3; ++k)
            side[k] = length(scene.positions[vertices[(k + 1) % 3]] - scene.positions[vertices[(k + 2) % 3]]);
        const auto corner = static_cast<std::size_t>(std::ranges::min_element(side) - side.begin());
        const double rows = cells(*std::ranges::max_element(side), spacing[i]);
        const double columns = cells(side[corner], spacing[i]);
        const double words = (rows + 1) * (columns + 1) * static_cast<double>(words_of(size));
        if (!(rows < most_cells && columns < most_cells && bytes() + words * sizeof(std::uint32_t) <= most_bytes)) {
            ++without_room_;
            continue;
        }
        grids_[i] = {words_, static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(columns),
                     static_cast<std::uint32_t>(corner)};
        words_ += static_cast<std::uint64_t>(words);
    }
    points_.reset(static_cast<std::uint32_t*>(std::calloc(words_ + 1, sizeof(std::uint32_t))));
    if (!points_) throw std::bad_alloc();
}

bool LightCache::read(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                      std::span<float> light) const {
    const Grid& grid = grids_[index];
    if (grid.rows == 0) return false;
    const SampleLighting::Size size = scene.lighting->size_of_light(scene.triangles[index].mesh);
    // How far from the corner towards the side opposite, and how far along that.
    const float towards = std::clamp(1 - weights[grid.corner], 0.0f, 1.0f);
    const float last = weights[(grid.corner + 2) % 3];
    const float along = towards > 0 ? std::clamp(last / towards, 0.0f, 1.0f) : 0.0f;
    const Place row(towards, grid.rows), column(along, grid.columns);
    const float down = row.beyond, right = column.beyond;
    const std::array<const std::uint32_t*, 4> points{
        point(scene, index, row.node, column.node, size), point(scene, index, row.node, column.node + 1, size),
        point(scene, index, row.node + 1, column.node, size), point(scene, index, row.node + 1, column.node + 1, size)};
    const std::array<float, 4> parts{(1 - down) * (1 - right), (1 - down) * right, down * (1 - right), down * right};
    std::ranges::fill(light, 0.0f);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t* word = points[k] + 1;
        for (std::size_t i = 0; i < size.any; ++i) light[i] += parts[k] * std::bit_cast<float>(load(*word++));
        const float part = parts[k] / 255;
        for (std::size_t i = 0; i < size.shares; i += 4) {
            std::uint32_t four = load(*word++);
            for (std::size_t j = i; j < std::min(i + 4, size.shares); ++j, four >>= 8)
                light[size.any + j] += part * static_cast<float>(four & 255);
        }
    }
    for (float& value : light.first(size.any)) value = std::max(value, 0.0f);
    for (float& value : light.subspan(size.any)) value = std::clamp(value, 0.0f, 1.0f);
    return true;
}

const std::uint32_t* LightCache::point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                                       SampleLighting::Size size) const {
    const Grid& grid = grids_[index];
    const std::size_t number = row * (std::size_t{grid.columns} + 1) + column;
    std::uint32_t* words = points_.get() + grid.first + number * words_of(size);
    if (std::atomic_ref(*words).load(std::memory_order_acquire) != made)
        make_point(scene, index, row, column, size, words);
    return words;
}

void LightCache::make_point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                            SampleLighting::Size size, std::uint32_t* words) const {
    const Grid& grid = grids_[index];
    const float towards = node(row, grid.rows), along = node(column, grid.columns);
    std::array<float, 3> weights;
    weights[grid.corner] = 1 - towards;
    weights[(grid.corner + 1) % 3] = towards * (1 - along);
    weights[(grid.corner + 2) % 3] = towards * along;
    std::vector<float> light(size.sum());
    scene.lighting->light_on(scene, index, weights, light);
    auto put = [word = words + 1](std::uint32_t value) mutable {
        std::atomic_ref(*word++).store(value, std::memory_order_relaxed);
    };
    for (std::size_t i = 0; i < size.any; ++i) put(std::bit_cast<std::uint32_t>(light[i]));
    for (std::size_t i = 0; i < size.shares; i += 4) {
        std::uint32_t four = 0;
        for (std::size_t j = i; j < std::min(i + 4, size.shares); ++j)
            four |= static_cast<std::uint32_t>(std::lround(255 * std::clamp(light[size.any + j], 0.0f, 1.0f)))
                    << 8 * (j - i);
        put(four);
    }
    std::atomic_ref(*words).store(made, std::memory_order_release);
    points_made_.fetch_add(1, std::memory_order_relaxed);
}

void cache_light(ShadedScene& scene, std::span<const float> spacing, double most_bytes) {
    if (scene.lighting) scene.light_cache = std::make_shared<LightCache>(scene, spacing, most_bytes);
}

}  // namespace hogel
