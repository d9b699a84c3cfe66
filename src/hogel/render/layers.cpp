// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/layers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/projected.h"
#include "hogel/render/span.h"

namespace hogel::render {
namespace {

// Point of a layer that a ray meets in front of all opaque surfaces.
struct Crossing {
    std::size_t sample;  // index (t, s, u) in a row of directions
    double depth;
    std::uint32_t triangle;
    std::array<float, 3> weights;
    float opacity;

    friend bool operator<(const Crossing& a, const Crossing& b) {
        if (a.sample != b.sample) return a.sample < b.sample;
        return a.depth != b.depth ? a.depth < b.depth : a.triangle < b.triangle;
    }
};

// Minimum opacity that counts as 0.5: alpha is a rounded sum of products of floats.
constexpr float half_opaque = 0.5f - 1.0f / 1024;
// Transmittance below which further layers are not evaluated.
constexpr float dark = 1e-4f;

// Layers of a scene, and their geometry with parallel rays in each direction (projected for a focal plane).
class Layers {
  public:
    Layers(std::shared_ptr<const ShadedScene> layers, const LightFieldGrid& grid) : scene_(std::move(layers)) {
        if (const auto* plane = grid.focal_plane()) {
            focal_ = plane->depth;
            geometry_ = projected_scene(scene_, grid, "a surface with a mask or alpha");
        } else {
            geometry_ = scene_;
        }
        triangles_ = triangles_with_area(*geometry_);
    }

    const ShadedScene& scene() const { return *scene_; }
    const ShadedScene& geometry() const { return *geometry_; }
    const std::vector<std::uint32_t>& triangles() const { return triangles_; }

    // Converts a hit's depth and weights to the scene itself: P/w = Σ b′_i P_i/w_i, so that b_i = w b′_i/w_i.
    Crossing crossing(std::uint32_t triangle, const ObliqueTriangle::Hit& hit) const {
        std::array<double, 3> weights = hit.weights;
        double depth = hit.depth;
        if (focal_) {
            double sum = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                weights[i] /= 1 + scene_->positions[scene_->triangles[triangle].vertices[i]].z / *focal_;
                sum += weights[i];
            }
            for (double& weight : weights) weight /= sum;
            depth /= 1 + depth / *focal_;
        }
        return {0,
                depth,
                triangle,
                {static_cast<float>(weights[0]), static_cast<float>(weights[1]), static_cast<float>(weights[2])},
                0};
    }

  private:
    std::shared_ptr<const ShadedScene> scene_, geometry_;
    std::optional<double> focal_;
    std::vector<std::uint32_t> triangles_;
};

// Draws layers over one tile, one row of directions after the other.
class LayerTile {
  public:
    LayerTile(const Layers& layers, const LightFieldGrid& grid, LightFieldTile& tile)
        : layers_(layers),
          grid_(grid),
          parallel_(grid.focal_plane() ? projected_grid(grid) : grid),
          range_(tile.range),
          tile_(tile) {}

    void draw() {
        for (std::size_t v = 0; v < grid_.directions_v; ++v) {
            core::throw_if_stopped();
            crossings_.clear();
            for (const std::uint32_t triangle : layers_.triangles()) find(triangle, v);
            std::sort(crossings_.begin(), crossings_.end());
            for (std::size_t first = 0; first < crossings_.size();) first = blend(first, v);
        }
    }

  private:
    static bool is_ray(const LightFieldGrid& grid, std::size_t v, std::size_t u) {
        const Vec3 d = grid.direction_of(grid.u(static_cast<double>(u)), grid.v(static_cast<double>(v)));
        return d.z != 0 && std::isfinite(d.z);  // the corners of a frequency grid are evanescent
    }
    ObliqueTriangle along(std::uint32_t triangle, std::size_t v, std::size_t u) const {
        return {layers_.geometry(), triangle, parallel_, static_cast<double>(u), static_cast<double>(v)};
    }
    Span rows(const ObliqueTriangle& a, const ObliqueTriangle& b) const {
        const auto [low_a, high_a] = std::ranges::minmax(a.t());
        const auto [low_b, high_b] = std::ranges::minmax(b.t());
        const double top = grid_.t(static_cast<double>(range_.t0));
        return samples_between((top - std::max(high_a, high_b)) / grid_.pitch,
                               (top - std::min(low_a, low_b)) / grid_.pitch, range_.nt);
    }
    Span columns(const ObliqueTriangle& triangle) const {
        const auto [low, high] = std::ranges::minmax(triangle.s());
        const double left = grid_.s(static_cast<double>(range_.s0));
        return samples_between((low - left) / grid_.pitch, (high - left) / grid_.pitch, range_.ns);
    }

    // Finds the crossings of one triangle. The projection of a corner moves monotonically along a row of directions, so
    // the two ends of the row bound the rows of hogels that see the triangle.
    void find(std::uint32_t index, std::size_t v) {
        const std::size_t last = grid_.directions_u - 1;
        if (!grid_.has_frequencies()) {
            const Span range = rows(along(index, v, 0), along(index, v, last));
            if (range.first == range.end) return;
        }
        for (std::size_t u = 0; u <= last; ++u) {
            if (!is_ray(parallel_, v, u)) continue;
            const ObliqueTriangle triangle = along(index, v, u);
            const Span in_rows = rows(triangle, triangle), in_columns = columns(triangle);
            for (std::size_t t = in_rows.first; t < in_rows.end; ++t)
                for (std::size_t s = in_columns.first; s < in_columns.end; ++s) cross(index, triangle, t, s, v, u);
        }
    }

    void cross(std::uint32_t index, const ObliqueTriangle& triangle, std::size_t t, std::size_t s, std::size_t v,
               std::size_t u) {
        const ObliqueTriangle::Hit hit =
            triangle.at(grid_.s(static_cast<double>(range_.s0 + s)), grid_.t(static_cast<double>(range_.t0 + t)));
        if (!hit) return;
        Crossing crossing = layers_.crossing(index, hit);
        if (!(static_cast<float>(crossing.depth) < tile_.depth(t, s, v, u))) return;
        const auto [b0, b1, b2] = crossing.weights;
        crossing.opacity = opacity_at(layers_.scene(), index, b0, b1, b2, view(crossing.depth, t, s, v, u));
        if (!(crossing.opacity > 0)) return;
        crossing.sample = (t * range_.ns + s) * grid_.directions_u + u;
        crossings_.push_back(crossing);
    }

    ViewSample view(double depth, std::size_t t, std::size_t s, std::size_t v, std::size_t u) const {
        const LightFieldGrid grid =
            grid_.of_hogel(static_cast<double>(range_.s0 + s), static_cast<double>(range_.t0 + t));
        return view_sample(grid, grid.u(static_cast<double>(u)), grid.v(static_cast<double>(v)), depth);
    }

    // Blends the crossings of one sample, from `first`, over the opaque surface. Returns the next sample's first
    // crossing.
    std::size_t blend(std::size_t first, std::size_t v) {
        const std::size_t sample = crossings_[first].sample, u = sample % grid_.directions_u,
                          s = sample / grid_.directions_u % range_.ns, t = sample / grid_.directions_u / range_.ns;
        Rgb radiance{0, 0, 0};
        float transmittance = 1;
        bool has_depth = false;
        std::size_t i = first;
        for (; i < crossings_.size() && crossings_[i].sample == sample; ++i) {
            if (transmittance < dark) continue;
            const Crossing& crossing = crossings_[i];
            const auto [b0, b1, b2] = crossing.weights;
            radiance += transmittance * crossing.opacity *
                        radiance_at(layers_.scene(), crossing.triangle, b0, b1, b2, view(crossing.depth, t, s, v, u));
            transmittance *= 1 - crossing.opacity;
            if (!has_depth && crossing.opacity >= half_opaque) {
                tile_.depth(t, s, v, u) = static_cast<float>(crossing.depth);
                has_depth = true;
            }
        }
        if (transmittance < dark) transmittance = 0;
        const std::array<float, 3> values{radiance.r, radiance.g, radiance.b};
        const std::size_t channels = tile_.radiance.extent(0);
        for (std::size_t c = 0; c < channels; ++c) {
            float& value = tile_.radiance(c, t, s, v, u);
            value = (channels == 3 ? values[c] : luminance(radiance)) + transmittance * value;
        }
        return i;
    }

    const Layers& layers_;
    const LightFieldGrid& grid_;
    LightFieldGrid parallel_;  // in which the rays of one direction are parallel
    HogelRange range_;
    LightFieldTile& tile_;
    std::vector<Crossing> crossings_;
};

class LayeredRenderer final : public Renderer {
  public:
    LayeredRenderer(std::unique_ptr<Renderer> opaque, const std::shared_ptr<const ShadedScene>& scene)
        : opaque_(std::move(opaque)) {
        set_layers(*scene);
    }

    const Renderer& opaque() const { return *opaque_; }
    const LightFieldGrid& grid() const override { return opaque_->grid(); }
    bool has_depth() const override { return opaque_->has_depth(); }
    HogelRange preferred_tile() const override { return opaque_->preferred_tile(); }
    View<const float, 5> in_memory() const override { return layers_ ? View<const float, 5>{} : opaque_->in_memory(); }

    void read(LightFieldTile& tile) const override {
        if (!layers_ || tile.depth.size() > 0) {
            opaque_->read(tile);
            if (layers_) LayerTile(*layers_, grid(), tile).draw();
            return;
        }
        LightFieldTile deep(grid(), tile.range, true);
        std::swap(deep.radiance, tile.radiance);
        opaque_->read(deep);
        LayerTile(*layers_, grid(), deep).draw();
        std::swap(deep.radiance, tile.radiance);
    }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        opaque_->set_scene(scene);
        set_layers(*scene);
    }

  private:
    void set_layers(const ShadedScene& scene) {
        layers_.reset();
        if (scene.layers) layers_.emplace(scene.layers, grid());
    }

    std::unique_ptr<Renderer> opaque_;
    std::optional<Layers> layers_;
};

}  // namespace

std::unique_ptr<Renderer> with_layers(std::unique_ptr<Renderer> opaque,
                                      const std::shared_ptr<const ShadedScene>& scene) {
    return std::make_unique<LayeredRenderer>(std::move(opaque), scene);
}

const LightFieldSource& without_layers(const LightFieldSource& renderer) {
    const auto* layered = dynamic_cast<const LayeredRenderer*>(&renderer);
    return layered ? layered->opaque() : renderer;
}

}  // namespace hogel::render
