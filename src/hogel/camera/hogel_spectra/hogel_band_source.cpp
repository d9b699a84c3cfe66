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

// From a part to the next one along an axis whose light does not meet its own: nodes reach at most eight beyond either
// end of a hogel, or of its window, which has at least one to a hogel.
constexpr std::size_t parts_apart(std::size_t side, std::size_t overlap) {
    return (side + overlap - 1 + std::size_t{2} * 8 + side - 1) / side;
}

// Eyes that see several colours of the same hogels, part by part, so that these may share rays.
class HogelBandSource final : public camera::PupilBandSource {
  public:
    HogelBandSource(std::vector<std::unique_ptr<HogelBandRenderer>> colours, const HogelRange& range)
        : colours_(std::move(colours)), range_(range) {}

    const camera::narrow_band::BandGrid& band(std::size_t eye) const override { return eye_band(eye).grid(); }

    camera::PackedBands draw(std::size_t first_look, std::size_t looks, const Progress& progress) const override {
        const HogelBandRenderer::Looks some{first_look, looks};
        camera::PackedBands bands;
        for (std::size_t eye = 0; eye < colours_.size() * each(); ++eye) {
            const Grid& plane = band(eye).plane;
            bands.push_back(camera::PackedBand::dark(looks, plane.height, plane.width));
        }
        const std::vector<std::vector<HogelPart>> sets = parts();
        work::Steps steps(progress, count_of(sets));
        for (const auto& set : sets)
            work::parallel_for(set.size(), [&](std::size_t i) {
                for (std::size_t c = 0; c < colours_.size(); ++c) {
                    auto scratch = colours_[c]->scratch();
                    colours_[c]->draw(set[i], some, *scratch);
                    colours_[c]->add(*scratch, set[i], std::span(bands).subspan(c * each(), each()));
                }
                steps.report_one();
            });
        return bands;
    }

  private:
    std::size_t each() const { return colours_.front()->eyes().size(); }
    const PupilBand& eye_band(std::size_t eye) const { return colours_[eye / each()]->eyes()[eye % each()]; }

    static std::size_t count_of(const std::vector<std::vector<HogelPart>>& sets) {
        return std::accumulate(sets.begin(), sets.end(), std::size_t{0},
                               [](std::size_t sum, const auto& set) { return sum + set.size(); });
    }

    // All parts, in sets of which no two parts meet, so that threads may add them in any order: every second part along
    // an axis, or every third, is a set.
    std::vector<std::vector<HogelPart>> parts() const {
        const std::size_t overlap = colours_.front()->overlap();
        const std::size_t apart_x = parts_apart(part_across, overlap), apart_y = parts_apart(part_down, overlap);
        std::vector<std::vector<HogelPart>> sets(apart_x * apart_y);
        for (std::size_t row = 0, t = 0; t < range_.nt; ++row, t += part_down)
            for (std::size_t s = 0; s < range_.ns; s += part_across)
                sets[row % apart_y * apart_x + s / part_across % apart_x].push_back(
                    {s, t, std::min(part_across, range_.ns - s), std::min(part_down, range_.nt - t)});
        return sets;
    }

    std::vector<std::unique_ptr<HogelBandRenderer>> colours_;
    HogelRange range_;
};

std::unique_ptr<PupilBandSource> make_hogel_bands(std::span<const Hogels> colours, const Region& part,
                                                  std::span<const Viewpoint> eyes) {
    const HogelRange range = colours.front().range_of(part);
    std::vector<std::unique_ptr<HogelBandRenderer>> all;
    for (const Hogels& hogels : colours) {
        std::vector<PupilBand> bands = PupilBand::of(hogels, range, eyes);
        if (bands.empty()) return nullptr;
        all.push_back(std::make_unique<HogelBandRenderer>(hogels, range, std::move(bands)));
    }
    return std::make_unique<HogelBandSource>(std::move(all), range);
}

// The rays of blocks of hogels, which several colours need one after the other.
using SharedRays = work::LruCache<std::array<std::size_t, 4>, std::vector<LightFieldTile>>;
constexpr double max_shared_bytes = 512.0 * (1 << 20);

// Whether hogels are made from the same rays.
bool have_same_rays(const Hogels& a, const Hogels& b) {
    return a.rays && b.rays && a.columns == b.columns && a.rows == b.rows && a.rays->with_depth == b.rays->with_depth &&
           std::ranges::equal(a.rays->faces, b.rays->faces);
}

// Lets hogels be prepared from shared rays.
void share_rays(const std::shared_ptr<SharedRays>& shared, Hogels& hogels) {
    hogels.prepare = [shared, rays = *hogels.rays](const HogelRange& range, View<float, 2> prepared) {
        const auto tiles = shared->get({range.s0, range.t0, range.ns, range.nt}, [&] {
            auto made = std::make_shared<std::vector<LightFieldTile>>();
            rays.read(range, *made);
            return std::shared_ptr<const std::vector<LightFieldTile>>(std::move(made));
        });
        rays.prepare(*tiles, prepared);
    };
}

}  // namespace

std::unique_ptr<PupilBandSource> make_hogel_band_source(const stereogram::Stereogram& hologram, const Region& part,
                                                        std::span<const Viewpoint> eyes, const KeptWaves* kept_waves) {
    const Hogels hogels{hologram.hogels(), kept_waves};
    if (hogels.waves == nullptr) return nullptr;
    return make_hogel_bands({&hogels, 1}, part, eyes);
}

std::unique_ptr<PupilBandSource> make_hogel_band_source_of_colours(
    std::span<const stereogram::Stereogram* const> colours, const Region& part, std::span<const Viewpoint> eyes) {
    std::vector<Hogels> all;
    for (const stereogram::Stereogram* colour : colours) {
        all.push_back({colour->hogels(), nullptr});
        if (!have_same_rays(all.back(), all.front())) return nullptr;
    }
    // The blocks of the parts that all threads draw.
    const std::size_t blocks = thread_count() * (part_down / tile_side + 2);
    const double bytes = static_cast<double>(blocks * part_across * tile_side * all.front().rays->bytes_a_hogel);
    if (bytes > max_shared_bytes) return nullptr;
    const auto shared = std::make_shared<SharedRays>(blocks);
    for (Hogels& hogels : all) share_rays(shared, hogels);
    return make_hogel_bands(all, part, eyes);
}

}  // namespace hogel::camera::hogel_spectra
