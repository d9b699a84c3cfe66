// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/plane_drawer.h"

#include <algorithm>
#include <bit>

namespace hogel::render::epi {
namespace {

// Minimum number of triangles in a batch before it is set up.
constexpr std::size_t min_batch = 64;

// Prefetch distance of the footprints of boxes, in clusters.
constexpr std::size_t prefetch_distance = 8;

// Number of spans between updates of the hierarchical z, larger if a plane has many samples: a compromise between the
// cost of updates and of spans that are drawn unnecessarily. If spans cover many cells, it is updated as soon as the
// drawn cells would fill the plane.
constexpr std::size_t min_update_interval = 128, samples_per_update = 256;

}  // namespace

void PlaneDrawer::begin_row(const EpipolarPlane& plane, double shift, double z0) {
    footprints_.begin_row(clusters_.boxes, plane, shift, z0);
}

void PlaneDrawer::draw(const EpipolarPlane& plane, const CutPlane& cut, std::span<const CrossedTriangles> crossed) {
    depths_.clear(plane);
    spans_.clear();
    drawn_ = updated_ = spans_.count();
    update_interval_ = std::max(min_update_interval, plane.columns * plane.directions / samples_per_update);
    for (std::size_t i = 0; i < crossed.size(); ++i) {
        footprints_.prefetch(crossed[std::min(i + prefetch_distance, crossed.size() - 1)].cluster);
        if (depths_.occludes(footprints_, crossed[i].cluster, plane)) continue;
        prefetch(crossed[i]);
        if (batch_.size() < min_batch) continue;
        set_up_batch(cut);
        if (spans_.count() < drawn_ + min_update_interval) continue;
        draw_new(plane);
        update_depths(plane);
    }
    set_up_batch(cut);
    draw_new(plane);
}

// Adds triangles to the batch and prefetches them.
void PlaneDrawer::prefetch(const CrossedTriangles& crossed) {
    const std::size_t first = crossed.cluster * cluster_size;
    for (std::uint64_t remaining = crossed.triangles; remaining != 0; remaining &= remaining - 1) {
        const std::size_t slot = first + static_cast<std::size_t>(std::countr_zero(remaining));
        batch_.push_back(static_cast<std::uint32_t>(slot));
        const auto* lines = reinterpret_cast<const char*>(&clusters_.corners[slot]);
        __builtin_prefetch(lines);
        __builtin_prefetch(lines + 64);
    }
}

void PlaneDrawer::set_up_batch(const CutPlane& cut) {
    if (batch_.empty()) return;
    spans_.add(batch_, cut);
    batch_.clear();
}

void PlaneDrawer::draw_new(const EpipolarPlane& plane) {
    draw_spans(spans_.from(drawn_), drawn_, plane);
    drawn_ = spans_.count();
}

// Updates the hierarchical z if enough has been drawn since the last update.
void PlaneDrawer::update_depths(const EpipolarPlane& plane) {
    const bool many_spans = spans_.count() >= updated_ + update_interval_;
    const bool many_writes = plane.cells->writes >= plane.columns * DepthCells::rows(plane.directions);
    if (!many_spans && !many_writes) return;
    depths_.update(plane);
    updated_ = spans_.count();
    if (many_spans) update_interval_ += update_interval_ / 2;
}

}  // namespace hogel::render::epi
