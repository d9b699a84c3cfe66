// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hogel/camera/rays/exposure.h"
#include "hogel/camera/rays/ray_blocks.h"
#include "hogel/core/half.h"
#include "hogel/core/stop_scope.h"
#include "hogel/image/film.h"
#include "hogel/photograph.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace camera::rays;

namespace {

// Directions per pass of a transpose: a cache line of floats.
constexpr std::size_t directions_per_pass = 16;

void store(const float* from, float* to, std::size_t n) { std::copy_n(from, n, to); }
void store(const float* from, std::uint16_t* to, std::size_t n) { core::to_half(from, to, n); }

// Transposes the hogels of one row and channel: [s][direction] to [direction][s], `stride` samples apart.
template <class Sample>
void transpose(View<const float, 2> hogels, Sample* to, std::size_t stride) {
    const std::size_t count = hogels.extent(0), directions = hogels.extent(1);
    std::vector<float> transposed(directions_per_pass * count);
    for (std::size_t first = 0; first < directions; first += directions_per_pass) {
        const std::size_t batch = std::min(directions_per_pass, directions - first);
        for (std::size_t s = 0; s < count; ++s)
            for (std::size_t i = 0; i < batch; ++i) transposed[i * count + s] = hogels(s, first + i);
        for (std::size_t i = 0; i < batch; ++i) store(&transposed[i * count], to + (first + i) * stride, count);
    }
}

// Returns [v][u][c][t][s].
template <class Sample>
std::vector<Sample, CacheLineAllocator<Sample>> views_of(const LightFieldSource& source, const Progress& progress) {
    const LightFieldGrid& grid = source.grid();
    const std::size_t view = grid.channels * grid.hogels(), directions = grid.directions();
    std::vector<Sample, CacheLineAllocator<Sample>> samples(view * directions);
    const auto store_block = [&](const HogelBlock& block) {
        work::parallel_for(block.range.nt * grid.channels, [&](std::size_t i) {
            const std::size_t t = i / grid.channels, c = i % grid.channels;
            const View<const float, 2> hogels(block.radiance + c * block.channel + t * block.row,
                                              {block.range.ns, directions});
            const std::size_t row = (c * grid.hogels_t + block.range.t0 + t) * grid.hogels_s;
            transpose(hogels, samples.data() + row + block.range.s0, view);
        });
    };
    const HogelRange tile = source.preferred_tile();
    const std::size_t across = (grid.hogels_s + tile.ns - 1) / tile.ns, down = (grid.hogels_t + tile.nt - 1) / tile.nt;
    work::local_ordered_reduce<LoadedHogels>(
        across * down, thread_count(),
        [&](std::size_t i) {
            const std::size_t s = i % across * tile.ns, t = i / across * tile.nt;
            return load_hogels(source,
                               {s, t, std::min(tile.ns, grid.hogels_s - s), std::min(tile.nt, grid.hogels_t - t)});
        },
        [&](std::size_t i, LoadedHogels& loaded) {
            store_block(loaded.block);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(across * down));
        });
    return samples;
}

}  // namespace

struct RayPhotographer::State {
    LightFieldGrid grid;
    Provenance provenance;
    // Exactly one of these is in use.
    std::optional<LightField> light_field;
    std::vector<float, CacheLineAllocator<float>> floats;
    std::vector<std::uint16_t, CacheLineAllocator<std::uint16_t>> halves;
};

RayPhotographer::RayPhotographer(LightField light_field, const RayPhotographerOptions& options,
                                 const Progress& progress)
    : state_(std::make_unique<State>(State{light_field.grid(), light_field.provenance(), {}, {}, {}})) {
    const core::StopScope scope(progress);
    const LightFieldSource& front = light_field.front();
    if (light_field.has_sides() || !is_separable(front.grid())) {
        state_->light_field = std::move(light_field);
        return;
    }
    const double samples = front.grid().samples(), memory = static_cast<double>(options.memory);
    if (samples * sizeof(std::uint16_t) > memory)
        throw Error(ErrorCode::usage,
                    fmt::format("a light field of {:.3g} samples takes {:.3g} GB as halves, and {:.3g} "
                                "GB of memory are allowed",
                                samples, 1e-9 * samples * sizeof(std::uint16_t), 1e-9 * memory));
    if (samples * sizeof(float) <= memory)
        state_->floats = views_of<float>(front, progress);
    else
        state_->halves = views_of<std::uint16_t>(front, progress);
}

RayPhotographer::~RayPhotographer() = default;
RayPhotographer::RayPhotographer(RayPhotographer&&) noexcept = default;
RayPhotographer& RayPhotographer::operator=(RayPhotographer&&) noexcept = default;

Image RayPhotographer::photograph(const Camera& camera, const RayCamera& model, const Progress& progress) {
    Image picture;
    photograph_into(camera, model, picture, progress);
    return picture;
}

void RayPhotographer::photograph_into(const Camera& camera, const RayCamera& model, Image& picture,
                                      const Progress& progress) {
    const State& state = *state_;
    const core::StopScope scope(progress);
    if (state.light_field)
        return hogel::photograph_into(*state.light_field, std::span(&camera, 1), model, std::span(&picture, 1),
                                      progress);
    require_ray_camera(camera);
    Exposure exposure({state.grid}, camera, std::max<std::size_t>(model.pupil_samples, 1));
    image::load_film(std::span(&camera, 1), state.grid.channels, state.provenance, std::span(&picture, 1));
    const std::vector<Block> list = blocks(state.grid);
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (state.halves.empty())
            exposure.add(Views<float>{state.floats.data()}, list[i].hogels, list[i].cells);
        else
            exposure.add(Views<std::uint16_t>{state.halves.data()}, list[i].hogels, list[i].cells);
        progress.report(static_cast<double>(i + 1) / static_cast<double>(list.size()));
    }
    exposure.develop(picture);
}

}  // namespace hogel
