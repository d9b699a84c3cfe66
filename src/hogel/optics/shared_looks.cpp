// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/shared_looks.h"

#include "hogel/core/alone.h"
#include "hogel/core/pieces.h"
#include "hogel/core/shared_order.h"

namespace hogel::optics {
namespace {

// Looks for each process where each of them prepares all hogels, which takes as long as one or two looks.
constexpr std::size_t min_looks_alone = 4;

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
    core::receive_in_pieces(*team_, process, film.elements());
}

void SharedLooks::take(Array<float, 2>& film) const {
    if (is_shared() && !team_->is_first()) receive(team_->rank() - 1, film);
}

void SharedLooks::hand_on(const Array<float, 2>& film) const {
    if (is_shared()) core::send_in_pieces<float>(*team_, (team_->rank() + 1) % team_->size(), film.elements());
}

void SharedLooks::finish(Array<float, 2>& film) const {
    if (is_shared() && team_->is_first()) receive(team_->size() - 1, film);
}

}  // namespace hogel::optics
