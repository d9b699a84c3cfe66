// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/hogel_band_source.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "hogel/camera/hogel_spectra/hogel_band_renderer.h"
#include "hogel/resources.h"
#include "hogel/work/lru_cache.h"
#include "hogel/work/parallel.h"
#include "hogel/work/steps.h"

namespace hogel::camera::hogel_spectra {
namespace {

using Complex = std::complex<float>;

// Returns the chunks, along an axis, from one to the next that does not overlap it. Nodes extend at most eight beyond
// either end of a hogel or of its window, which has at least one node per hogel.
constexpr std::size_t chunk_stride(std::size_t side, std::size_t overlap) {
    return (side + overlap - 1 + std::size_t{2} * 8 + side - 1) / side;
}

// Source of the bands of several colours of the same hogels. Colours share rays, because it renders them chunk by
// chunk.
class HogelBandSource final : public camera::PupilBandSource {
  public:
    HogelBandSource(std::vector<std::unique_ptr<HogelBandRenderer>> colours, const HogelRange& range)
        : colours_(std::move(colours)), range_(range) {}

    const camera::narrow_band::BandGrid& band(std::size_t index) const override { return pupil_band(index).grid(); }

    camera::PackedBands synthesize(std::size_t first_look, std::size_t looks, const Progress& progress) const override {
        const HogelBandRenderer::Looks range_of_looks{first_look, looks};
        camera::PackedBands bands;
        for (std::size_t index = 0; index < colours_.size() * bands_per_colour(); ++index) {
            const Grid& plane = band(index).plane;
            bands.push_back(camera::PackedBand::dark(looks, plane.height, plane.width));
        }
        const std::vector<std::vector<HogelChunk>> sets = chunk_sets();
        work::Steps steps(progress, total_size(sets));
        for (const auto& set : sets)
            work::parallel_for(set.size(), [&](std::size_t i) {
                for (std::size_t c = 0; c < colours_.size(); ++c) {
                    auto scratch = colours_[c]->scratch();
                    colours_[c]->render(set[i], range_of_looks, *scratch);
                    colours_[c]->add(*scratch, set[i],
                                     std::span(bands).subspan(c * bands_per_colour(), bands_per_colour()));
                }
                steps.report_one();
            });
        return bands;
    }

  private:
    std::size_t bands_per_colour() const { return colours_.front()->bands().size(); }
    const PupilBand& pupil_band(std::size_t index) const {
        return colours_[index / bands_per_colour()]->bands()[index % bands_per_colour()];
    }

    static std::size_t total_size(const std::vector<std::vector<HogelChunk>>& sets) {
        return std::accumulate(sets.begin(), sets.end(), std::size_t{0},
                               [](std::size_t sum, const auto& set) { return sum + set.size(); });
    }

    // Returns sets of chunks without overlaps, which threads may add in any order: every second or third along an axis.
    std::vector<std::vector<HogelChunk>> chunk_sets() const {
        const std::size_t overlap = colours_.front()->overlap();
        const std::size_t stride_x = chunk_stride(chunk_width, overlap), stride_y = chunk_stride(chunk_height, overlap);
        std::vector<std::vector<HogelChunk>> sets(stride_x * stride_y);
        for (std::size_t row = 0, t = 0; t < range_.nt; ++row, t += chunk_height)
            for (std::size_t s = 0; s < range_.ns; s += chunk_width)
                sets[row % stride_y * stride_x + s / chunk_width % stride_x].push_back(
                    {s, t, std::min(chunk_width, range_.ns - s), std::min(chunk_height, range_.nt - t)});
        return sets;
    }

    std::vector<std::unique_ptr<HogelBandRenderer>> colours_;
    HogelRange range_;
};

std::unique_ptr<PupilBandSource> make_hogel_bands(std::span<const Hogels> colours, const Region& part,
                                                  std::span<const Viewpoint> viewpoints) {
    const HogelRange range = colours.front().range_of(part);
    std::vector<std::unique_ptr<HogelBandRenderer>> renderers;
    for (const Hogels& hogels : colours) {
        std::vector<PupilBand> bands = PupilBand::create(hogels, range, viewpoints);
        if (bands.empty()) return nullptr;
        renderers.push_back(std::make_unique<HogelBandRenderer>(hogels, range, std::move(bands)));
    }
    return std::make_unique<HogelBandSource>(std::move(renderers), range);
}

// Rays of blocks of hogels, which the colours need one after the other.
using SharedRays = work::LruCache<std::array<std::size_t, 4>, std::vector<LightFieldTile>>;
constexpr double max_shared_bytes = 512.0 * (1 << 20);

bool have_same_rays(const Hogels& a, const Hogels& b) {
    return a.rays && b.rays && a.columns == b.columns && a.rows == b.rows && a.rays->with_depth == b.rays->with_depth &&
           std::ranges::equal(a.rays->faces, b.rays->faces);
}

// Makes hogels prepare from shared rays.
void share_rays(const std::shared_ptr<SharedRays>& shared, Hogels& hogels) {
    hogels.prepare = [shared, rays = *hogels.rays](const HogelRange& range, View<float, 2> prepared) {
        const auto tiles = shared->get({range.s0, range.t0, range.ns, range.nt}, [&] {
            auto loaded = std::make_shared<std::vector<LightFieldTile>>();
            rays.read(range, *loaded);
            return std::shared_ptr<const std::vector<LightFieldTile>>(std::move(loaded));
        });
        rays.prepare(*tiles, prepared);
    };
}

}  // namespace

std::unique_ptr<PupilBandSource> make_hogel_band_source(const stereogram::Stereogram& hologram, const Region& part,
                                                        std::span<const Viewpoint> viewpoints,
                                                        const WaveCache* wave_cache) {
    const Hogels hogels{hologram.hogels(), wave_cache};
    if (hogels.waves == nullptr) return nullptr;
    return make_hogel_bands({&hogels, 1}, part, viewpoints);
}

std::unique_ptr<PupilBandSource> make_hogel_band_source_of_colours(
    std::span<const stereogram::Stereogram* const> colours, const Region& part, std::span<const Viewpoint> viewpoints) {
    std::vector<Hogels> renderers;
    for (const stereogram::Stereogram* colour : colours) {
        renderers.push_back({colour->hogels(), nullptr});
        if (!have_same_rays(renderers.back(), renderers.front())) return nullptr;
    }
    // Blocks of the chunks of all threads.
    const std::size_t blocks = thread_count() * (chunk_height / tile_side + 2);
    const double bytes = static_cast<double>(blocks * chunk_width * tile_side * renderers.front().rays->bytes_a_hogel);
    if (bytes > max_shared_bytes) return nullptr;
    const auto shared = std::make_shared<SharedRays>(blocks);
    for (Hogels& hogels : renderers) share_rays(shared, hogels);
    return make_hogel_bands(renderers, part, viewpoints);
}

}  // namespace hogel::camera::hogel_spectra
