// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "hogel/export.h"

namespace hogel {

/// Communication between the processes (ranks) of one job, such as an MPI program. Derive from this class, and make the
/// library use it with a CommunicatorScope.
///
/// All ranks call the same functions with the same arguments. The work is divided as follows, and results have the same
/// bytes as those of a single process.
///
/// * Tiles of HDF5 light fields and holograms, whole photographs and whole patterns are handed out to idle ranks. All
///   ranks write into one HDF5 file.
/// * The root rank computes sums over tiles (compression, photographs from samples) in the order of the tiles, from the
///   messages of all ranks.
/// * Transforms of large fields are divided among the ranks, which exchange their parts.
/// * Every rank computes everything else. Only the root rank writes files of other kinds: see is_root_rank().
///
/// All ranks must have access to the folders of the files.
class HOGEL_API Communicator {
  public:
    virtual ~Communicator() = default;
    /// Returns the index of this process, from 0. Rank 0 is the root, which creates files and gives them their names.
    virtual std::size_t rank() const = 0;
    virtual std::size_t size() const = 0;
    bool is_root() const { return rank() == 0; }

    /// Returns the next tile index of a queue, below `tiles`, that no rank has received yet; none at the end of the
    /// queue. The first call with a queue number creates the queue. Thread-safe. Throws Error(cancelled) if a rank
    /// failed.
    /// @param ahead  number of tiles to hand out beyond those reported to pass(); the call waits until that permits one
    virtual std::optional<std::uint64_t> next_tile(std::uint64_t queue, std::uint64_t tiles,
                                                   std::uint64_t ahead = UINT64_MAX) = 0;
    /// Reports that the first `done` tiles of a queue need no more memory. Root rank only.
    virtual void pass(std::uint64_t queue, std::uint64_t done) = 0;

    /// Returns the sum of the numbers of all ranks. All ranks call it in the same order and wait for each other. If a
    /// rank has failed, it throws that rank's error in all others.
    virtual std::uint64_t sum(std::uint64_t number) = 0;
    /// Waits until all ranks have called it. Throws as sum() does.
    void barrier() { sum(0); }
    /// Waits as barrier() does, and returns the root rank's message in all ranks.
    std::string broadcast(const std::string& message);

    /// Sends bytes to the root rank, in order, without waiting. Other ranks only; thread-safe.
    virtual void send(std::uint64_t channel, std::string bytes) = 0;
    /// Sets the callback for all bytes sent to a channel, including bytes sent before this call. It runs on another
    /// thread. An empty callback closes the channel. Root rank only.
    virtual void listen(std::uint64_t channel, std::function<void(std::string bytes)> callback) = 0;

    /// Sends bytes to any other rank, in order, without waiting.
    virtual void send_to(std::size_t destination, std::string bytes) = 0;
    /// Waits for the next bytes that a rank sends with send_to(). Not thread-safe. Throws Error(cancelled) if a rank
    /// failed.
    virtual std::string receive_from(std::size_t source) = 0;

    /// Returns a number for a queue or channel. All ranks call it in the same order. Callers may use numbers below 2³².
    std::uint64_t next_number() { return numbers_++; }

  private:
    std::uint64_t numbers_ = std::uint64_t{1} << 32;
};

/// Makes this process a rank of a communicator while the object exists. Create it before any work begins. Throws
/// Error(usage) if there is a communicator already.
class HOGEL_API CommunicatorScope {
  public:
    explicit CommunicatorScope(Communicator& communicator);
    ~CommunicatorScope();
    CommunicatorScope(const CommunicatorScope&) = delete;
    CommunicatorScope& operator=(const CommunicatorScope&) = delete;
};

/// Returns the communicator of this process; null if it runs alone.
HOGEL_API Communicator* communicator();

/// Returns whether this process runs alone or is the root rank, which writes files that only one process may write.
/// Other ranks compute the same values and do not write them.
HOGEL_API bool is_root_rank();

}  // namespace hogel
