// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/eye/stereogram_eyes.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

#include "hogel/core/parallel.h"
#include "hogel/core/shared_order.h"

namespace hogel::hologram::eye {
namespace {

using Complex = std::complex<float>;

// From a part to the next one along an axis whose light does not meet its own: nodes reach at most eight beyond either
// end of a hogel, or of its window, which has at least one to a hogel.
constexpr std::size_t parts_apart(std::size_t side, std::size_t overlap) {
    return (side + overlap - 1 + std::size_t{2} * 8 + side - 1) / side;
}

core::Sent<EyeBands> sent_bands() {
    return {[](core::MessageWriter& to, const EyeBands& eyes) {
                std::size_t bytes = sizeof(std::size_t);
                for (const auto& looks : eyes)
                    for (const auto& look : looks) bytes += look.size() * sizeof(Complex) + 4 * sizeof(std::size_t);
                to.reserve(bytes);
                to.put(eyes.size());
                for (const auto& looks : eyes) {
                    to.put(looks.size());
                    for (const auto& look : looks) to.put(look);
                }
            },
            [](core::MessageReader& from) {
                EyeBands eyes(from.get<std::size_t>());
                for (auto& looks : eyes) {
                    looks.resize(from.get<std::size_t>());
                    for (auto& look : looks) look = from.get_array<Complex, 2>();
                }
                return eyes;
            }};
}

// Eyes that see several colours of the same hogels, part by part, so that these may share rays.
class StereogramEyes final : public optics::EyeDrawing {
  public:
    StereogramEyes(std::vector<std::unique_ptr<ColourEyes>> colours, const HogelRange& range)
        : colours_(std::move(colours)), range_(range) {}

    const optics::narrow_band::BandGrid& band(std::size_t eye) const override { return eye_band(eye).grid(); }

    optics::PackedBands draw(std::size_t first_look, std::size_t looks, const Progress& progress) const override {
        const std::size_t each = colours_.front()->eyes().size(), eyes = colours_.size() * each;
        // The system clears their pages, half a gigabyte for many looks, on all threads.
        optics::PackedBands bands(eyes, std::vector<optics::PackedBand>(looks));
        core::parallel_for(eyes * looks, [&](std::size_t i) {
            const Grid& plane = band(i / looks).plane;
            bands[i / looks][i % looks] = optics::PackedBand(plane.height, plane.width);
        });
        // Parts of the hogels, so that those of each set do not meet and threads may add them in any order.
        const std::vector<std::vector<HogelPart>> sets = parts();
        const std::size_t count = std::accumulate(sets.begin(), sets.end(), std::size_t{0},
                                                  [](std::size_t sum, const auto& set) { return sum + set.size(); });
        const auto report = [&](std::size_t done) {
            progress.report(static_cast<double>(done) / static_cast<double>(count));
        };
        const ColourEyes::Looks some{first_look, looks};
        if (core::team_of_several() != nullptr) {
            std::vector<HogelPart> all_parts;
            for (const auto& set : sets) all_parts.insert(all_parts.end(), set.begin(), set.end());
            core::shared_ordered<EyeBands>(
                count, core::default_in_flight(), sent_bands(),
                [&](std::size_t i) {
                    EyeBands all;
                    for (const auto& colour : colours_) {
                        auto scratch = colour->scratch();
                        colour->draw(all_parts[i], some, *scratch);
                        for (auto& light : colour->light(all_parts[i], *scratch)) all.push_back(std::move(light));
                    }
                    return all;
                },
                [&](std::size_t i, const EyeBands& all) {
                    for (std::size_t eye = 0; eye < eyes; ++eye) {
                        const std::size_t per_hogel = eye_band(eye).per_hogel();
                        for (std::size_t look = 0; look < looks; ++look)
                            bands[eye][look].add(all[eye][look], all_parts[i].t * per_hogel,
                                                 all_parts[i].s * per_hogel);
                    }
                    report(i + 1);
                });
            return bands;
        }
        std::mutex mutex;
        std::size_t done = 0;
        for (const auto& set : sets)
            core::parallel_for(set.size(), [&](std::size_t i) {
                for (std::size_t c = 0; c < colours_.size(); ++c) {
                    auto scratch = colours_[c]->scratch();
                    colours_[c]->draw(set[i], some, *scratch);
                    colours_[c]->add(*scratch, set[i], std::span(bands).subspan(c * each, each));
                }
                const std::lock_guard lock(mutex);
                report(++done);
            });
        return bands;
    }

  private:
    const EyeBand& eye_band(std::size_t eye) const {
        const std::size_t each = colours_.front()->eyes().size();
        return colours_[eye / each]->eyes()[eye % each];
    }

    // Every second part along an axis, or every third, is a set.
    std::vector<std::vector<HogelPart>> parts() const {
        const std::size_t overlap = colours_.front()->overlap();
        const std::size_t apart_x = parts_apart(part_across, overlap), apart_y = parts_apart(part_down, overlap);
        std::vector<std::vector<HogelPart>> sets(apart_x * apart_y);
        for (std::size_t t = 0; t < range_.nt; t += part_down)
            for (std::size_t s = 0; s < range_.ns; s += part_across)
                sets[t / part_down % apart_y * apart_x + s / part_across % apart_x].push_back(
                    {s, t, std::min(part_across, range_.ns - s), std::min(part_down, range_.nt - t)});
        return sets;
    }

    std::vector<std::unique_ptr<ColourEyes>> colours_;
    HogelRange range_;
};

}  // namespace

std::unique_ptr<optics::EyeDrawing> make_stereogram_eyes(std::span<const Hogels> colours, const HogelRange& range,
                                                         std::span<const optics::Eye> eyes) {
    std::vector<std::unique_ptr<ColourEyes>> all;
    for (const Hogels& hogels : colours) {
        std::vector<EyeBand> bands = EyeBand::of(hogels, range, eyes);
        if (bands.empty()) return nullptr;
        all.push_back(std::make_unique<ColourEyes>(hogels, range, std::move(bands)));
    }
    return std::make_unique<StereogramEyes>(std::move(all), range);
}

}  // namespace hogel::hologram::eye
