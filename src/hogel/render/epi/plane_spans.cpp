// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/plane_spans.h"

#include <algorithm>
#include <limits>

#include "hogel/render/sample_store.h"

namespace hogel::render::epi {
namespace {

RadianceFrom radiance_from(const ShadedScene& scene, std::uint32_t triangle) {
    if (!scene.needs_samples(triangle)) return RadianceFrom::ends;
    if (!scene.radiance_cache || scene.triangles[triangle].texture != ShadedScene::no_texture)
        return RadianceFrom::samples;
    const shading::LightGrid& grid = scene.radiance_cache->grid(triangle);
    return grid.points && grid.is_radiance ? RadianceFrom::cache : RadianceFrom::samples;
}

}  // namespace

RadianceTable::RadianceTable(const ShadedScene& scene, const TriangleClusters& clusters, std::size_t channels)
    : uses_knots(scene.lighting || !scene.textures.empty()), background{0, 0, 1, 0, {}, {}} {
    const Rgb sky = scene.background;
    const float values[] = {channels == 1 ? luminance(sky) : sky.r, sky.g, sky.b,
                            std::numeric_limits<float>::infinity()};
    std::ranges::copy(values, background.value0);
    if (!uses_knots) return;
    for (const std::uint32_t triangle : clusters.triangles) from.push_back(radiance_from(scene, triangle));
}

PlaneSpans::PlaneSpans(const ShadedScene& scene, const TriangleClusters& clusters, const RadianceTable& table)
    : scene_(scene), clusters_(clusters), table_(table) {}

void PlaneSpans::clear() {
    reserve(1);
    spans_[0] = {};
    values_[0] = table_.background;
    count_ = 1;
    if (table_.uses_knots) shaded_.clear(table_.background);
}

void PlaneSpans::add(std::span<const std::uint32_t> slots, const CutPlane& plane) {
    const std::size_t first = count_;
    reserve(first + slots.size());
    count_ += slots.size();
    set_up_spans(clusters_, slots, plane, &spans_[first], &values_[first],
                 table_.uses_knots ? &origins_[first] : nullptr);
    if (!table_.uses_knots) return;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const RadianceFrom from = table_.from[slots[i]];
        if (from == RadianceFrom::ends) {
            shaded_.add_between_ends(values_[first + i]);
            continue;
        }
        shaded_.add(values_[first + i], from);
        if (from == RadianceFrom::cache) __builtin_prefetch(&scene_.radiance_cache->grid(origins_[first + i].triangle));
    }
}

void PlaneSpans::reserve(std::size_t count) {
    if (count <= spans_.size()) return;
    const std::size_t size = std::max(count, 2 * spans_.size());
    spans_.resize(size);
    values_.resize(size);
    if (table_.uses_knots) origins_.resize(size);
}

}  // namespace hogel::render::epi
