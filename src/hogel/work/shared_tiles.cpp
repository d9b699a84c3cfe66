// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/shared_tiles.h"

#include "hogel/work/parallel.h"

namespace hogel::work {

std::optional<std::size_t> TileQueue::next() {
    const std::lock_guard lock(mutex_);
    const std::optional<std::uint64_t> tile = communicator_.next_tile(queue_, tiles_);
    last_ = tile ? *tile + 1 : tiles_;
    return tile;
}

void for_each_tile(std::size_t tiles, SharedSink* shared, const Progress& progress,
                   const std::function<void(std::size_t tile)>& body) {
    const std::unique_ptr<TileQueue> queue = shared != nullptr ? shared->share_tiles(tiles) : nullptr;
    std::mutex reporting;
    std::size_t done = 0;
    progress.report(0);
    // With a queue every iteration requests a tile: loops inside the body then find the same threads as without one.
    // Iterations for tiles of other ranks find the queue empty.
    parallel_for(tiles, [&](std::size_t iteration) {
        const std::optional<std::size_t> tile = queue ? queue->next() : iteration;
        if (!tile) return;
        body(*tile);
        const std::lock_guard lock(reporting);
        ++done;
        progress.report(queue ? queue->handed_out() : static_cast<double>(done) / static_cast<double>(tiles));
    });
}

}  // namespace hogel::work
