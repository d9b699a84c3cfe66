// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstring>

#include "bench/measure.h"
#include "bench/render/render.h"
#include "hogel/core/half.h"
#include "hogel/renderer.h"
#include "hogel/resources.h"
#include "hogel/units.h"

namespace hogel::bench {
namespace {

// Rounds samples to half floats, as a file does, and keeps only a checksum, independent of tiles and threads.
class ConsumingSink final : public LightFieldSink {
  public:
    explicit ConsumingSink(const LightFieldGrid& grid) : grid_(grid) {}

    bool wants_depth() const override { return false; }

    void write(const LightFieldTile& tile) override {
        std::vector<std::uint16_t> halves(grid_.directions());
        std::uint64_t sum = 0;
        for (std::size_t c = 0; c < grid_.channels; ++c)
            for (std::size_t t = 0; t < tile.range.nt; ++t)
                for (std::size_t s = 0; s < tile.range.ns; ++s) {
                    core::to_half(&tile.radiance(c, t, s, 0, 0), halves.data(), halves.size());
                    const std::size_t index =
                        (c * grid_.hogels_t + tile.range.t0 + t) * grid_.hogels_s + tile.range.s0 + s;
                    sum += (2 * index + 1) * digest(halves);
                }
        sum_ += sum;
    }

    std::uint64_t sum() const { return sum_; }

  private:
    // Computes FNV-1a by words, in four independent chains so that the processor overlaps their multiplications.
    static std::uint64_t digest(const std::vector<std::uint16_t>& halves) {
        constexpr std::uint64_t prime = 0x100000001b3, basis = 0xcbf29ce484222325;
        std::array<std::uint64_t, 4> chains{basis, basis + 1, basis + 2, basis + 3};
        std::size_t i = 0;
        for (; i + 16 <= halves.size(); i += 16)
            for (std::size_t k = 0; k < 4; ++k) {
                std::uint64_t word = 0;
                std::memcpy(&word, halves.data() + i + 4 * k, sizeof(word));
                chains[k] = std::rotl((chains[k] ^ word) * prime, 29);
            }
        for (; i < halves.size(); ++i) chains[0] = std::rotl((chains[0] ^ halves[i]) * prime, 29);
        std::uint64_t hash = 0;
        for (const std::uint64_t chain : chains) hash = std::rotl((hash ^ chain) * prime, 29);
        return hash;
    }

    LightFieldGrid grid_;
    std::atomic<std::uint64_t> sum_{0};
};

}  // namespace

void measure_stream(const RenderOptions& options, const Session& session) {
    LightFieldOptions light_field = options.light_field(render_defaults.stream_hogels, render_defaults.many_directions);
    const std::vector<std::string> scenes =
        options.scenes.empty() ? std::vector<std::string>{"pumpkin"} : options.scenes;
    const std::string algorithm = options.algorithm();
    const LightFieldGrid grid = light_field.grid();
    const double bytes = grid.samples() * sizeof(std::uint16_t);
    fmt::print(
        "{}x{} hogels of {}x{} directions, half floats in {} channels, {}; {} threads.\n\n"
        "| `{}` | seconds | million samples a second | most memory | sum |\n|---|---|---|---|---|\n",
        grid.hogels_s, grid.hogels_t, grid.directions_u, grid.directions_v, grid.channels, format_bytes(bytes),
        thread_count(), algorithm);
    for (const std::string& name : scenes) {
        light_field.shading = options.shading_of(name);
        const auto source = make_renderer(algorithm, bench_scene(session, name, light_field), grid);
        ConsumingSink sink(grid);
        reset_max_memory_held();
        const Times times = time_of([&] { copy(*source, sink, until_interrupted()); });
        fmt::print("| {} | {:.1f} | {:.4g} | {} | {:016x} |\n", name, times.wall,
                   1e-6 * grid.samples() / static_cast<double>(grid.channels) / times.wall,
                   format_bytes(max_memory_held()), sink.sum());
        std::fflush(stdout);
    }
}

}  // namespace hogel::bench
