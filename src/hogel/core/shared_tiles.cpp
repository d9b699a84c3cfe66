// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/shared_tiles.h"

#include <algorithm>

#include "hogel/core/parallel.h"

namespace hogel::core {
namespace {

// The tiles for each process of which the end of the work consists.
constexpr std::size_t few_for_each = 4;

}  // namespace

std::optional<std::size_t> TileQueue::next() {
    const std::lock_guard lock(mutex_);
    if (here_.count == 0 && !over_) {
        here_ = team_.next_tiles(queue_, tiles_, ahead_);
        over_ = here_.count == 0;
        last_ = over_ ? tiles_ : std::min<std::size_t>(here_.first + here_.count, tiles_);
    }
    if (over_) return std::nullopt;
    // While the last tile is worked on, the next ones are under way; but not towards the end, where a process that is
    // at work would hold a tile that an idle one could take.
    if (--here_.count == 0 && tiles_ - last_ > few_for_each * team_.size()) team_.expect_tiles(queue_, tiles_, ahead_);
    return here_.first++;
}

void for_each_tile(std::size_t tiles, SharedSink* shared, const Progress& progress,
                   const std::function<void(std::size_t tile)>& body) {
    const std::unique_ptr<TileQueue> queue = shared != nullptr ? shared->share_tiles(tiles) : nullptr;
    std::mutex reporting;
    std::size_t done = 0;
    progress.report(0);
    // With a queue every turn of the loop asks for a tile, so that loops inside the body find the threads as they would
    // without one; the turns of tiles that other processes have find the queue empty.
    parallel_for(tiles, [&](std::size_t turn) {
        const std::optional<std::size_t> tile = queue ? queue->next() : turn;
        if (!tile) return;
        body(*tile);
        const std::lock_guard lock(reporting);
        ++done;
        progress.report(queue ? queue->handed_out() : static_cast<double>(done) / static_cast<double>(tiles));
    });
}

}  // namespace hogel::core
