// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/shared_looks.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "hogel/core/alone.h"
#include "hogel/core/parallel.h"
#include "hogel/core/pieces.h"
#include "hogel/core/shared_order.h"
#include "hogel/core/speeds.h"
#include "hogel/core/unequal_parts.h"

namespace hogel::optics {
namespace {

// Looks for each process where each of them prepares all hogels, which takes as long as one or two looks.
constexpr std::size_t min_looks_alone = 4;

// Bytes of looks that are exposed on films of their own.
constexpr std::size_t max_ahead = std::size_t{256} << 20;

// As many looks for each process as it is fast, and at least one.
std::vector<core::LineRange> looks_of_processes(const Team& team, std::size_t looks) {
    const std::vector<double> speeds = core::parts_by_speed(team.size());
    std::vector<core::LineRange> all, equal;
    for (std::size_t process = 0; process < team.size(); ++process) {
        all.push_back(core::lines_in_parts(speeds, process, looks));
        equal.push_back(core::lines_of(process, team.size(), looks, 1));
    }
    return std::ranges::all_of(all, &core::LineRange::count) ? all : equal;
}

}  // namespace

SharedLooks::SharedLooks(const EyeDrawing& drawing, std::size_t looks, std::size_t at_once, bool can_be_so)
    : drawing_(drawing), looks_(looks), own_{0, looks} {
    Team* const all = core::team_of_several();
    if (all == nullptr || !can_be_so || (core::result_log() != nullptr && !drawing.has_rows())) return;
    if (looks < (drawing.has_rows() ? 1 : min_looks_alone) * all->size()) return;
    // The own looks, and the own rows of all looks.
    looks_of_ = looks_of_processes(*all, looks);
    const std::size_t most = std::ranges::max_element(looks_of_, {}, &core::LineRange::count)->count;
    if ((drawing.has_rows() ? 2 : 1) * most > at_once) return;
    team_ = all;
    own_ = looks_of_[all->rank()];
}

PackedBands SharedLooks::drawn(std::size_t first, std::size_t count, const Progress& progress) const {
    if (!is_shared()) return drawing_.draw(first, count, progress);
    if (!drawing_.has_rows()) {
        const core::AloneScope alone;
        return drawing_.draw(first, count, progress);
    }
    return drawing_.draw_in_rows(
        *team_, 0, looks_, [&](std::size_t process) { return looks_of_[process]; }, progress);
}

void SharedLooks::receive(std::size_t process, Array<float, 2>& film) const {
    core::receive_in_pieces(*team_, process, film.elements());
}

void SharedLooks::expose(const film::Film& film, std::span<const film::PupilWave> looks, const Camera& camera,
                         Array<float, 2>& intensity) const {
    std::size_t ahead = 0;
    if (is_shared() && !team_->is_first()) {
        // Instead of waiting for the film of those before: looks on films of their own, which are added one by one, as
        // exposing the film would do.
        ahead = std::min(looks.size(), std::max<std::size_t>(1, max_ahead / (sizeof(float) * intensity.size())));
        std::vector<Array<float, 2>> own(ahead);
        for (Array<float, 2>& each : own) each = film.unexposed();
        film.expose(looks.first(ahead), camera, own);
        receive(team_->rank() - 1, intensity);
        core::parallel_for(intensity.extent(0), [&](std::size_t row) {
            const std::span<float> to = intensity[row].elements();
            for (const Array<float, 2>& each : own)
                std::ranges::transform(to, each[row].elements(), to.begin(), std::plus<>());
        });
    }
    film.expose(looks.subspan(ahead), camera, intensity);
    if (is_shared()) core::send_in_pieces<float>(*team_, (team_->rank() + 1) % team_->size(), intensity.elements());
}

void SharedLooks::finish(Array<float, 2>& film) const {
    if (is_shared() && team_->is_first()) receive(team_->size() - 1, film);
}

}  // namespace hogel::optics
