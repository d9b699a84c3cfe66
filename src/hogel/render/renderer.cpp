// SPDX-License-Identifier: Apache-2.0
#include "hogel/renderer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "hogel/render/baselines/mvr.h"
#include "hogel/render/baselines/oblique.h"
#include "hogel/render/baselines/raytrace.h"
#include "hogel/render/baselines/zbuffer.h"
#include "hogel/render/epi/epi.h"
#include "hogel/render/layers.h"
#include "hogel/render/projected.h"
#include "hogel/render/thesis_renderers.h"

namespace hogel {
namespace {

// Adapts a source that is not a Renderer by making a new one for each scene.
class RemadeRenderer final : public Renderer {
  public:
    RemadeRenderer(const RendererInfo& info, const LightFieldGrid& grid, std::unique_ptr<LightFieldSource> source)
        : info_(info), grid_(grid), source_(std::move(source)) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    View<const float, 5> in_memory() const override { return source_->in_memory(); }
    void read(LightFieldTile& tile) const override { source_->read(tile); }
    void set_scene(std::shared_ptr<const ShadedScene> scene) override { source_ = info_.make(std::move(scene), grid_); }

  private:
    const RendererInfo& info_;  // references to rows of a table stay valid
    LightFieldGrid grid_;
    std::unique_ptr<LightFieldSource> source_;
};

// Returns text that names a renderer and lists the renderers that have the capability that it lacks.
std::string only(const RendererInfo& info, bool RendererInfo::*takes) {
    std::vector<std::string> others;
    for (const RendererInfo& other : renderers().rows())
        if (other.*takes) others.push_back(other.name);
    return fmt::format("the renderer '{}' (but not {})", info.name, fmt::join(others, ", "));
}

std::unique_ptr<Renderer> make_as_it_is(const RendererInfo& info, std::shared_ptr<const ShadedScene> scene,
                                        const LightFieldGrid& grid) {
    std::unique_ptr<LightFieldSource> source = info.make(std::move(scene), grid);
    if (auto* renderer = dynamic_cast<Renderer*>(source.get())) {
        source.release();
        return std::unique_ptr<Renderer>(renderer);
    }
    return std::make_unique<RemadeRenderer>(info, grid, std::move(source));
}

}  // namespace

Table<RendererInfo>& renderers() {
    using namespace render::baselines;
    static Table<RendererInfo> table(
        "renderer",
        [] {
            std::vector<RendererInfo> rows{render::epi::epi_renderer(), raytrace_renderer(), zbuffer_renderer(),
                                           oblique_renderer(), mvr_renderer()};
            for (RendererInfo& row : render::thesis_renderers()) rows.push_back(std::move(row));
            return rows;
        }(),
        "algorithm");
    return table;
}

std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                        const LightFieldGrid& grid) {
    validate(grid, ErrorCode::usage, "light field to render");
    const RendererInfo& info = renderers().find(name);
    if (grid.focal_plane() && !info.takes_focal_plane) {
        const std::string needs = only(info, &RendererInfo::takes_focal_plane);
        return render::with_layers(render::unprojected(make_as_it_is(info, render::projected_scene(scene, grid, needs),
                                                                     render::projected_grid(grid)),
                                                       grid, needs),
                                   scene);
    }
    if (grid.has_frequencies() && !info.takes_frequencies)
        require_perspective(grid, ErrorCode::usage, only(info, &RendererInfo::takes_frequencies));
    return render::with_layers(make_as_it_is(info, scene, grid), scene);
}

}  // namespace hogel
