// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <list>
#include <mutex>
#include <vector>

#include "mpi/link.h"
#include "mpi/loss_watch.h"

namespace hogel::mpi {

/// Messages by MPI. Only calls that never wait are made, one at a time: those that wait keep a processor busy, which
/// threads of the same machine could use.
class MpiLink final : public Link {
  public:
    /// Starts MPI. Throws Error(not_built_in) if it has no support for threads that call it one at a time.
    MpiLink(int& argc, char**& argv);
    /// Ends MPI when all messages have left.
    ~MpiLink() override;
    MpiLink(const MpiLink&) = delete;
    MpiLink& operator=(const MpiLink&) = delete;

    std::size_t rank() const override { return rank_; }
    std::size_t size() const override { return size_; }
    void send(std::size_t to, Kind kind, std::string bytes) override;
    std::optional<Message> receive(Kind kind) override;

    /// The threads of this process if the processes of a machine share the processors that they may run on.
    std::size_t threads() const { return threads_; }
    /// The ranks whose processes are on this machine, this one's among them.
    const std::vector<RankProcess>& on_this_machine() const { return on_this_machine_; }
    /// Ends all processes at once.
    [[noreturn]] void abort(int status);

  private:
    struct Sent {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    void forget_what_has_left();
    void keep_memory(std::string bytes);
    std::string room_for(std::size_t bytes);

    std::mutex mutex_;
    MPI_Comm all_ = MPI_COMM_NULL;
    std::size_t rank_ = 0, size_ = 1, threads_ = 1;
    std::vector<RankProcess> on_this_machine_;
    std::list<Sent> sent_;
    std::vector<std::string> spare_;
};

}  // namespace hogel::mpi
