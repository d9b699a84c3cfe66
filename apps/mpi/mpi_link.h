// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <list>
#include <mutex>
#include <vector>

#include "mpi/link.h"
#include "mpi/loss_watch.h"

namespace hogel::mpi {

/// Transport by MPI. Uses only non-blocking MPI calls, one at a time: blocking calls busy-wait and would take
/// processors from threads of the same machine.
class MpiLink final : public Link {
  public:
    /// Initialises MPI. Throws Error(not_built_in) if it does not support MPI_THREAD_SERIALIZED.
    MpiLink(int& argc, char**& argv);
    /// Finalises MPI when all messages have left, after 5 s at the latest.
    ~MpiLink() override;
    MpiLink(const MpiLink&) = delete;
    MpiLink& operator=(const MpiLink&) = delete;

    std::size_t rank() const override { return rank_; }
    std::size_t size() const override { return size_; }
    void send(std::size_t to, Kind kind, std::string bytes) override;
    std::optional<Message> receive(Kind kind) override;

    /// Returns this rank's number of threads: its processors divided by the number of ranks bound to the same ones.
    std::size_t threads() const { return threads_; }
    /// Returns the ranks on this machine, including this one.
    const std::vector<RankProcess>& on_this_machine() const { return on_this_machine_; }
    /// Ends all ranks immediately.
    [[noreturn]] void abort(int status);

  private:
    struct Sent {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    void release_sent();
    void recycle(std::string bytes);
    std::string buffer_of(std::size_t bytes);

    std::mutex mutex_;
    MPI_Comm communicator_ = MPI_COMM_NULL;
    std::size_t rank_ = 0, size_ = 1, threads_ = 1;
    std::vector<RankProcess> on_this_machine_;
    std::list<Sent> sent_;
    std::vector<std::string> spare_;
};

}  // namespace hogel::mpi
