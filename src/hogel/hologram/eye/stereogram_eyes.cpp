// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/eye/stereogram_eyes.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hogel/core/parallel.h"
#include "hogel/core/pieces.h"
#include "hogel/core/shared_order.h"
#include "hogel/core/speeds.h"
#include "hogel/core/steps.h"
#include "hogel/core/unequal_parts.h"

namespace hogel::hologram::eye {
namespace {

using Complex = std::complex<float>;

// From a part to the next one along an axis whose light does not meet its own: nodes reach at most eight beyond either
// end of a hogel, or of its window, which has at least one to a hogel.
constexpr std::size_t parts_apart(std::size_t side, std::size_t overlap) {
    return (side + overlap - 1 + std::size_t{2} * 8 + side - 1) / side;
}

// Eyes that see several colours of the same hogels, part by part, so that these may share rays.
class StereogramEyes final : public optics::EyeDrawing {
  public:
    StereogramEyes(std::vector<std::unique_ptr<ColourEyes>> colours, const HogelRange& range)
        : colours_(std::move(colours)), range_(range) {}

    const optics::narrow_band::BandGrid& band(std::size_t eye) const override { return eye_band(eye).grid(); }

    optics::PackedBands draw(std::size_t first_look, std::size_t looks, const Progress& progress) const override {
        const ColourEyes::Looks some{first_look, looks};
        if (Team* const team = core::team_of_several()) {
            const auto of_first = [&](std::size_t process) { return core::LineRange{0, process == 0 ? looks : 0}; };
            return draw_in_rows(*team, first_look, looks, of_first, progress);
        }
        optics::PackedBands bands = dark_bands(looks, {0, range_.nt});
        draw_into(bands, some, parts({0, part_rows()}), 0, progress);
        return bands;
    }

    bool has_rows() const override { return true; }

    optics::PackedBands draw_in_rows(Team& team, std::size_t first_look, std::size_t looks,
                                     const optics::WantedLooks& wanted, const Progress& progress) const override {
        // The light of a part reaches into the parts below it, so that the last ones above the own rows are drawn, too.
        const core::LineRange own = own_part_rows(team.rank(), team.size());
        const std::size_t above = own.count > 0 ? std::min(own.first, parts_apart(part_down, overlap()) - 1) : 0;
        const core::LineRange drawn{own.first - above, own.count + above};
        const std::size_t t0 = std::min(drawn.first * part_down, range_.nt),
                          t1 = std::min(drawn.end() * part_down, range_.nt);
        optics::PackedBands mine = dark_bands(looks, {t0, t1 - t0});
        draw_into(mine, {first_look, looks}, parts(drawn), t0, progress);
        return exchange(team, mine, t0, wanted);
    }

  private:
    std::size_t each() const { return colours_.front()->eyes().size(); }
    const EyeBand& eye_band(std::size_t eye) const { return colours_[eye / each()]->eyes()[eye % each()]; }

    std::size_t overlap() const { return colours_.front()->overlap(); }
    std::size_t part_rows() const { return (range_.nt + part_down - 1) / part_down; }

    // The rows of parts whose place in the bands belongs to a process. All but the first draw others, too.
    core::LineRange own_part_rows(std::size_t process, std::size_t processes) const {
        const std::size_t all = part_rows(), more = parts_apart(part_down, overlap()) - 1;
        const std::vector<double> parts = core::first_parts(processes);
        std::size_t first = 0, end = 0;
        for (std::size_t p = 0; p <= process; ++p) {
            first = end;
            const std::size_t drawn = core::lines_in_parts(parts, p, all + (processes - 1) * more).end();
            end = std::clamp(drawn - std::min(drawn, p * more), first, all);
        }
        return {first, end - first};
    }

    // The first row of an eye's band that belongs to a row of parts, or to none.
    std::size_t band_row(std::size_t part_row, std::size_t eye) const {
        return part_row < part_rows() ? part_row * part_down * eye_band(eye).per_hogel() : band(eye).plane.height;
    }

    // Bands of some rows of hogels.
    optics::PackedBands dark_bands(std::size_t looks, const core::LineRange& hogels) const {
        optics::PackedBands bands;
        for (std::size_t eye = 0; eye < colours_.size() * each(); ++eye) {
            const std::size_t rows = hogels.count > 0 ? eye_band(eye).samples(hogels.count) : 0;
            bands.push_back(optics::PackedBand::dark(looks, rows, band(eye).plane.width));
        }
        return bands;
    }

    // Gives all processes what each has drawn of the looks that they want, and frees it.
    // @param t0  the row of hogels where the bands begin
    optics::PackedBands exchange(Team& team, optics::PackedBands& mine, std::size_t t0,
                                 const optics::WantedLooks& wanted) const {
        std::size_t most = 0;
        for (std::size_t process = 0; process < team.size(); ++process) most = std::max(most, wanted(process).count);
        const core::LineRange own = wanted(team.rank());
        optics::PackedBands bands(mine.size());
        for (std::size_t eye = 0; eye < mine.size(); ++eye) {
            const auto rows_of = [&](std::size_t process) {
                const core::LineRange rows = own_part_rows(process, team.size());
                const std::size_t first = band_row(rows.first, eye);
                return core::LineRange{first, band_row(rows.end(), eye) - first};
            };
            const core::LineRange rows = rows_of(team.rank());
            const std::size_t first = rows.first - std::min(rows.first, t0 * eye_band(eye).per_hogel());
            const auto own_rows = [&](std::size_t look) {
                return rows.count > 0 ? mine[eye][look].rows(first, first + rows.count)
                                      : std::span<math::PackedComplex>();
            };
            bands[eye] = optics::PackedBand::unset(own.count, band(eye).plane.height, band(eye).plane.width);
            // One look of each process at a time, so that few messages are under way.
            for (std::size_t i = 0; i < most; ++i) {
                for (std::size_t process = 0; process < team.size(); ++process)
                    if (const core::LineRange looks = wanted(process); process != team.rank() && i < looks.count)
                        core::send_in_pieces<math::PackedComplex>(team, process, own_rows(looks.first + i));
                for (std::size_t process = 0; i < own.count && process < team.size(); ++process) {
                    const core::LineRange theirs = rows_of(process);
                    const auto to = bands[eye][i].rows(theirs.first, theirs.end());
                    if (process == team.rank())
                        std::ranges::copy(own_rows(own.first + i), to.begin());
                    else
                        core::receive_in_pieces(team, process, to);
                }
            }
            mine[eye].clear();
        }
        return bands;
    }

    // Adds the light of parts to bands whose first row is that of the row t0 of hogels.
    void draw_into(optics::PackedBands& bands, const ColourEyes::Looks& looks,
                   const std::vector<std::vector<HogelPart>>& sets, std::size_t t0, const Progress& progress) const {
        core::Steps steps(progress, count_of(sets));
        for (const auto& set : sets)
            core::parallel_for(set.size(), [&](std::size_t i) {
                const HogelPart& part = set[i];
                for (std::size_t c = 0; c < colours_.size(); ++c) {
                    auto scratch = colours_[c]->scratch();
                    colours_[c]->draw(part, looks, *scratch);
                    colours_[c]->add(*scratch, {part.s, part.t - t0, part.ns, part.nt},
                                     std::span(bands).subspan(c * each(), each()));
                }
                steps.report_one();
            });
    }

    static std::size_t count_of(const std::vector<std::vector<HogelPart>>& sets) {
        return std::accumulate(sets.begin(), sets.end(), std::size_t{0},
                               [](std::size_t sum, const auto& set) { return sum + set.size(); });
    }

    // Some rows of parts, in sets of which no two parts meet, so that threads may add them in any order: every second
    // part along an axis, or every third, is a set.
    std::vector<std::vector<HogelPart>> parts(const core::LineRange& rows) const {
        const std::size_t apart_x = parts_apart(part_across, overlap()), apart_y = parts_apart(part_down, overlap());
        std::vector<std::vector<HogelPart>> sets(apart_x * apart_y);
        for (std::size_t row = rows.first; row < rows.end(); ++row)
            for (std::size_t s = 0, t = row * part_down; s < range_.ns; s += part_across)
                sets[row % apart_y * apart_x + s / part_across % apart_x].push_back(
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
