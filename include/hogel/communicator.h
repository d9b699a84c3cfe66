// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "hogel/export.h"

namespace hogel {

/// Several processes that do one work together, as the ranks of an MPI program do. Each of them calls the same
/// functions with the same arguments. The light fields and holograms that they write to HDF5 files are then one file,
/// whose tiles are handed out to whoever is free, and so are whole photographs and patterns; sums over tiles
/// (compression, the narrow camera) are made by the first process of what all send it, in the order of the tiles; large
/// fields are transformed in parts that the processes exchange; and everything else is computed by each of them.
/// Results have the same bytes as those of a single process. Files of other kinds are written by the first process
/// alone: see is_root_rank(). All processes must see the folders of the files.
///
/// A program derives the messages of its processes from this class, and a CommunicatorScope makes the library use them.
class HOGEL_API Communicator {
  public:
    virtual ~Communicator() = default;
    /// The number of this process, from 0. The first one lays files out and gives them their names.
    virtual std::size_t rank() const = 0;
    virtual std::size_t size() const = 0;
    bool is_root() const { return rank() == 0; }

    /// The next of the `tiles` tiles of a queue, which no process has been given yet; none at its end. Queues begin
    /// with the first call for their number. Called from any thread. Throws Error(cancelled) if a process has failed.
    /// @param ahead  how many tiles beyond those that pass() has been told of are handed out; the call waits for more
    virtual std::optional<std::uint64_t> next_tile(std::uint64_t queue, std::uint64_t tiles,
                                                   std::uint64_t ahead = UINT64_MAX) = 0;
    /// In the first process: the first `done` tiles of a queue need no more memory.
    virtual void pass(std::uint64_t queue, std::uint64_t done) = 0;

    /// The sum of the numbers of all processes, which call it in the same order and wait for each other. If one of them
    /// has failed instead, it throws that process's error in all others.
    virtual std::uint64_t sum(std::uint64_t number) = 0;
    /// Waits until all processes have come here, as sum() does.
    void meet() { sum(0); }
    /// meet(), and then what the first process has given, in all processes.
    std::string share(const std::string& of_first);

    /// Sends bytes to the first process, in order, without waiting. Called from any thread of the others.
    virtual void send(std::uint64_t channel, std::string bytes) = 0;
    /// In the first process: what is called, on another thread, with all that is sent to a channel, also before this
    /// call; nothing to call ends the channel.
    virtual void listen(std::uint64_t channel, std::function<void(std::string bytes)> take) = 0;

    /// Sends bytes to any other process, in order, without waiting.
    virtual void send_to(std::size_t process, std::string bytes) = 0;
    /// Waits for the next bytes that a process has sent so. For one thread. Throws Error(cancelled) if a process has
    /// failed.
    virtual std::string receive_from(std::size_t process) = 0;

    /// A number for a queue or channel of work that all processes do, which call this in the same order. Those below
    /// 2³² are the caller's own.
    std::uint64_t next_number() { return numbers_++; }

  private:
    std::uint64_t numbers_ = std::uint64_t{1} << 32;
};

/// While this object exists, this process is one of a team. To be made before any work begins.
class HOGEL_API CommunicatorScope {
  public:
    explicit CommunicatorScope(Communicator& communicator);
    ~CommunicatorScope();
    CommunicatorScope(const CommunicatorScope&) = delete;
    CommunicatorScope& operator=(const CommunicatorScope&) = delete;
};

/// The team of this process; null if it is alone.
HOGEL_API Communicator* communicator();

/// Whether this process is alone or the first of a team: the one that writes files of which each is written by one
/// process. Others compute the same and leave it at that.
HOGEL_API bool is_root_rank();

}  // namespace hogel
