// SPDX-License-Identifier: Apache-2.0
#include "hogel/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "hogel/core/object_pool.h"
#include "hogel/error.h"
#include "hogel/render/cell_sums.h"

namespace hogel {
namespace {

class Averaged final : public LightFieldSource {
  public:
    Averaged(std::shared_ptr<const LightFieldSource> fine, const LightFieldGrid& grid, const SamplesPerRay& samples)
        : fine_(std::move(fine)), grid_(grid), samples_(samples) {
        const HogelRange preferred = fine_->preferred_tile();
        block_ = {0, 0, std::clamp<std::size_t>(preferred.ns / samples.hogel, 1, grid.hogels_s),
                  std::clamp<std::size_t>(preferred.nt / samples.hogel, 1, grid.hogels_t)};
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return fine_->has_depth(); }
    HogelRange preferred_tile() const override { return block_; }

    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        for (std::size_t t = 0; t < range.nt; t += block_.nt)
            for (std::size_t s = 0; s < range.ns; s += block_.ns)
                read_block(tile, s, t, std::min(block_.ns, range.ns - s), std::min(block_.nt, range.nt - t));
    }

  private:
    // Reads the block of ns × nt hogels that begins at (s, t) of the tile.
    void read_block(LightFieldTile& tile, std::size_t s, std::size_t t, std::size_t ns, std::size_t nt) const {
        const std::size_t n = samples_.hogel;
        const double weight = 1 / static_cast<double>(samples_.count());
        const bool with_depth = tile.depth.size() > 0;
        auto memory = memory_.take();
        LightFieldTile& fine = *memory;
        if (fine.range.ns != n * ns || fine.range.nt != n * nt || (fine.depth.size() > 0) != with_depth)
            fine = LightFieldTile(fine_->grid(), {0, 0, n * ns, n * nt}, with_depth);
        fine.range = {n * (tile.range.s0 + s), n * (tile.range.t0 + t), n * ns, n * nt};
        fine_->read(fine);
        Array<double, 2> sums({grid_.directions_v, grid_.directions_u});
        for (std::size_t j = 0; j < nt; ++j)
            for (std::size_t i = 0; i < ns; ++i) {
                for (std::size_t c = 0; c < grid_.channels; ++c) {
                    sum_up(fine, c, j, i, sums);
                    float* out = &tile.radiance(c, t + j, s + i, 0, 0);
                    for (const double sum : sums.elements()) *out++ = static_cast<float>(sum * weight);
                }
                for (std::size_t v = 0; with_depth && v < grid_.directions_v; ++v)
                    min_depths(fine, j, i, v, &tile.depth(t + j, s + i, v, 0));
            }
    }

    // Computes the sums of a channel of hogel (j, i) of the block.
    void sum_up(const LightFieldTile& fine, std::size_t channel, std::size_t j, std::size_t i,
                View<double, 2> sums) const {
        std::fill_n(sums.data(), grid_.directions(), 0.0);
        const Shape<2> shape{grid_.directions_v * samples_.direction, grid_.directions_u * samples_.direction};
        for_hogels(j, i, [&](std::size_t fine_t, std::size_t fine_s) {
            render::add_cells({&fine.radiance(channel, fine_t, fine_s, 0, 0), shape}, samples_.direction, sums);
        });
    }

    void min_depths(const LightFieldTile& fine, std::size_t j, std::size_t i, std::size_t v, float* out) const {
        const std::size_t n = samples_.direction;
        std::fill_n(out, grid_.directions_u, std::numeric_limits<float>::infinity());
        for_hogels(j, i, [&](std::size_t fine_t, std::size_t fine_s) {
            for (std::size_t fine_v = v * n; fine_v < (v + 1) * n; ++fine_v) {
                const float* in = &fine.depth(fine_t, fine_s, fine_v, 0);
                for (std::size_t k = 0; k < grid_.directions_u * n; ++k) out[k / n] = std::min(out[k / n], in[k]);
            }
        });
    }

    // Visits the fine hogels in the cell of hogel (j, i), in a fixed order.
    template <class Visit>
    void for_hogels(std::size_t j, std::size_t i, const Visit& visit) const {
        for (std::size_t fine_t = j * samples_.hogel; fine_t < (j + 1) * samples_.hogel; ++fine_t)
            for (std::size_t fine_s = i * samples_.hogel; fine_s < (i + 1) * samples_.hogel; ++fine_s)
                visit(fine_t, fine_s);
    }

    std::shared_ptr<const LightFieldSource> fine_;
    LightFieldGrid grid_;
    SamplesPerRay samples_;
    HogelRange block_;
    // Reused for all blocks; each block overwrites all of it.
    mutable core::ObjectPool<LightFieldTile> memory_;
};

class AveragedRenderer final : public Renderer {
  public:
    AveragedRenderer(std::shared_ptr<Renderer> fine, const LightFieldGrid& grid, const SamplesPerRay& samples)
        : fine_(std::move(fine)), averaged_(fine_, grid, samples) {}

    const LightFieldGrid& grid() const override { return averaged_.grid(); }
    bool has_depth() const override { return averaged_.has_depth(); }
    HogelRange preferred_tile() const override { return averaged_.preferred_tile(); }
    void read(LightFieldTile& tile) const override { averaged_.read(tile); }
    void set_scene(std::shared_ptr<const ShadedScene> scene) override { fine_->set_scene(std::move(scene)); }

  private:
    std::shared_ptr<Renderer> fine_;
    Averaged averaged_;
};

}  // namespace

LightFieldGrid finer(const LightFieldGrid& grid, const SamplesPerRay& samples) {
    constexpr std::size_t max_factor = 64;
    if (samples.hogel < 1 || samples.direction < 1 || samples.hogel > max_factor || samples.direction > max_factor)
        throw Error(ErrorCode::usage, "samples",
                    fmt::format("{}x{} samples a ray; expected 1 to {} along a hogel and along a "
                                "direction's cell",
                                samples.hogel, samples.direction, max_factor));
    LightFieldGrid fine = grid;
    fine.hogels_s *= samples.hogel;
    fine.hogels_t *= samples.hogel;
    fine.pitch /= static_cast<double>(samples.hogel);
    fine.directions_u *= samples.direction;
    fine.directions_v *= samples.direction;
    validate(fine, ErrorCode::usage, "samples of the rays of a light field");
    return fine;
}

std::unique_ptr<LightFieldSource> average(std::shared_ptr<const LightFieldSource> fine, const LightFieldGrid& grid,
                                          const SamplesPerRay& samples) {
    if (fine->grid() != finer(grid, samples))
        throw Error(ErrorCode::usage,
                    fmt::format("the light field to average does not have {}x{} samples for each ray of the result",
                                samples.hogel, samples.direction));
    return std::make_unique<Averaged>(std::move(fine), grid, samples);
}

std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                        const LightFieldGrid& grid, const SamplesPerRay& samples) {
    validate(grid, ErrorCode::usage, "light field to render");
    std::unique_ptr<Renderer> fine = make_renderer(name, std::move(scene), finer(grid, samples));
    if (samples.count() == 1) return fine;
    return std::make_unique<AveragedRenderer>(std::move(fine), grid, samples);
}

}  // namespace hogel
