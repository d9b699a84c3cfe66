// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "hogel/communicator.h"
#include "hogel/progress.h"

namespace hogel::work {

/// Tiles that a communicator's queue hands out to this rank. Thread-safe.
class TileQueue {
  public:
    TileQueue(Communicator& communicator, std::uint64_t queue, std::size_t tiles)
        : communicator_(communicator), queue_(queue), tiles_(tiles) {}
    /// Returns the next tile, or nothing if no tile is left. Throws Error(cancelled) if another rank has failed.
    std::optional<std::size_t> next();
    /// Returns the fraction of all tiles handed out to any rank, as known to this rank.
    double handed_out() const { return static_cast<double>(last_.load()) / static_cast<double>(tiles_); }

  private:
    Communicator& communicator_;
    std::uint64_t queue_;
    std::size_t tiles_;
    std::mutex mutex_;
    std::atomic<std::size_t> last_{0};
};

/// A sink that several ranks can fill together.
class SharedSink {
  public:
    virtual ~SharedSink() = default;
    /// Returns the queue of the tiles, or null if this rank writes all tiles. Called once.
    virtual std::unique_ptr<TileQueue> share_tiles(std::size_t tiles) = 0;
};

/// Calls body(tile) for every tile in [0, tiles) on all threads, and reports progress after each. With a shared sink,
/// handles only the tiles that the queue hands out to this rank.
/// @param shared  null if this rank handles all tiles
void for_each_tile(std::size_t tiles, SharedSink* shared, const Progress& progress,
                   const std::function<void(std::size_t tile)>& body);

}  // namespace hogel::work
