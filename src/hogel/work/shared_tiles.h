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

/// The tiles that a team's queue hands out to this process. Thread-safe.
class TileQueue {
  public:
    TileQueue(Communicator& communicator, std::uint64_t queue, std::size_t tiles)
        : communicator_(communicator), queue_(queue), tiles_(tiles) {}
    /// The next tile, or nothing if all are handed out. Throws Error(cancelled) if another process has failed.
    std::optional<std::size_t> next();
    /// The fraction of all tiles that some process has been given, as far as this one knows.
    double handed_out() const { return static_cast<double>(last_.load()) / static_cast<double>(tiles_); }

  private:
    Communicator& communicator_;
    std::uint64_t queue_;
    std::size_t tiles_;
    std::mutex mutex_;
    std::atomic<std::size_t> last_{0};
};

/// Implemented by a sink that the processes of a team may fill together.
class SharedSink {
  public:
    virtual ~SharedSink() = default;
    /// The queue of its tiles, or null if this process writes them all. Called once.
    virtual std::unique_ptr<TileQueue> share_tiles(std::size_t tiles) = 0;
};

/// Calls body(tile) on all threads for every tile in [0, tiles) or, where a sink is shared, for those that are handed
/// to this process, and reports progress after each.
/// @param shared  null if all tiles are this process's
void for_each_tile(std::size_t tiles, SharedSink* shared, const Progress& progress,
                   const std::function<void(std::size_t tile)>& body);

}  // namespace hogel::work
