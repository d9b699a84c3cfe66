// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/shared_looks.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "hogel/core/alone.h"
#include "hogel/core/shared_order.h"
#include "hogel/error.h"

namespace hogel::optics {
namespace {

// Looks for each process where each of them prepares all hogels, which takes as long as one or two looks.
constexpr std::size_t min_looks_alone = 4;

// Floats of a message: a MiB, because the memory of larger ones is new each time.
constexpr std::size_t piece = std::size_t{1} << 18;

}  // namespace

SharedLooks::SharedLooks(const EyeDrawing& drawing, std::size_t looks, std::size_t at_once, bool can_be_so)
    : drawing_(drawing), looks_(looks), own_{0, looks} {
    Team* const all = core::team_of_several();
    if (all == nullptr || !can_be_so || (core::result_log() != nullptr && !drawing.has_rows())) return;
    if (looks < (drawing.has_rows() ? 1 : min_looks_alone) * all->size()) return;
    // The own looks, and the own rows of all looks.
    const std::size_t own = (looks + all->size() - 1) / all->size();
    if ((drawing.has_rows() ? 2 : 1) * own > at_once) return;
    team_ = all;
    own_ = core::own_lines(all, looks);
}

PackedBands SharedLooks::drawn(std::size_t first, std::size_t count, const Progress& progress) const {
    if (!is_shared()) return drawing_.draw(first, count, progress);
    if (!drawing_.has_rows()) {
        const core::AloneScope alone;
        return drawing_.draw(first, count, progress);
    }
    return drawing_.draw_in_rows(
        *team_, 0, looks_, [&](std::size_t process) { return core::lines_of(process, team_->size(), looks_, 1); },
        progress);
}

void SharedLooks::receive(std::size_t process, Array<float, 2>& film) const {
    for (std::size_t first = 0; first < film.size(); first += piece) {
        const std::string bytes = team_->receive_from(process);
        if (bytes.size() != std::min(piece, film.size() - first) * sizeof(float))
            throw Error(ErrorCode::internal, "a film from another process has another size than expected");
        std::memcpy(film.data() + first, bytes.data(), bytes.size());
    }
}

void SharedLooks::take(Array<float, 2>& film) const {
    if (is_shared() && !team_->is_first()) receive(team_->rank() - 1, film);
}

void SharedLooks::hand_on(const Array<float, 2>& film) const {
    if (!is_shared()) return;
    for (std::size_t first = 0; first < film.size(); first += piece)
        team_->send_to((team_->rank() + 1) % team_->size(), {reinterpret_cast<const char*>(film.data() + first),
                                                             std::min(piece, film.size() - first) * sizeof(float)});
}

void SharedLooks::finish(Array<float, 2>& film) const {
    if (is_shared() && team_->is_first()) receive(team_->size() - 1, film);
}

}  // namespace hogel::optics
