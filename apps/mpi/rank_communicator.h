// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "hogel/communicator.h"
#include "hogel/error.h"
#include "mpi/link.h"

namespace hogel::mpi {

/// Contribution of a rank to a barrier of all ranks, and the combined answer of the root.
struct Report {
    bool failed = false;
    int status = 0;  ///< exit status
    ErrorCode code = ErrorCode::cancelled;
    std::uint64_t number = 0;  ///< summed in the answer
    std::string text;          ///< message to print
};

/// Communicator over a Link. A thread of the root manages the queues and answers requests; a thread of each other rank
/// listens for stops.
class RankCommunicator final : public Communicator {
  public:
    explicit RankCommunicator(Link& link);
    ~RankCommunicator() override;
    RankCommunicator(const RankCommunicator&) = delete;
    RankCommunicator& operator=(const RankCommunicator&) = delete;

    std::size_t rank() const override { return link_.rank(); }
    std::size_t size() const override { return link_.size(); }
    std::optional<std::uint64_t> next_tile(std::uint64_t queue, std::uint64_t tiles,
                                           std::uint64_t ahead = UINT64_MAX) override;
    void pass(std::uint64_t queue, std::uint64_t done) override;
    std::uint64_t sum(std::uint64_t number) override;
    void send(std::uint64_t channel, std::string bytes) override;
    void listen(std::uint64_t channel, std::function<void(std::string bytes)> take) override;
    void send_to(std::size_t destination, std::string bytes) override;
    std::string receive_from(std::size_t source) override;

    /// Connects stop sources: a stop request on any rank is passed to the sources of all ranks.
    void stop_with(std::stop_source stop);
    /// Returns the combined outcome of all ranks at the end of the work: if one rank has failed, all ranks get its
    /// failure. A rank that has succeeded waits without limit. A rank that has failed waits 1/3 s, then `patience`, and
    /// then returns nothing.
    /// @param silent  called once by a rank that has failed, after the 1/3 s, unless its argument would be empty. On
    ///                the root it gets all ranks without a report; on another rank it gets {0}, unless the root has
    ///                told this rank to stop
    std::optional<Report> settle(Report local, std::chrono::seconds patience,
                                 const std::function<void(const std::vector<std::size_t>&)>& silent = {});

  private:
    // Range of tiles; empty if `count` is 0.
    struct Tiles {
        std::uint64_t first = 0, count = 0;
    };
    // Tiles of a queue that this rank has received but not begun.
    struct LocalTiles {
        Tiles range;
        bool finished = false;  // the queue is exhausted
    };
    struct Queue {
        std::uint64_t next = 0, tiles = 0, done = 0;
    };
    struct Request {
        std::size_t from;
        std::uint64_t queue, tiles, ahead;
    };
    Report agree(Report local);
    void report(Report local);
    std::optional<Report> wait_for_combined(std::optional<std::chrono::milliseconds> patience);
    std::vector<std::size_t> silent_ranks();
    bool is_stop_requested();
    bool serve();
    bool serve_root();
    void take_report(std::size_t from, Report report);
    void stop_all();
    void stop_local();
    std::optional<Tiles> take_tiles(const Request& request);
    void answer_requests();
    void request_tiles(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead);
    Tiles next_tiles(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead);

    Link& link_;
    std::mutex mutex_;  // guards the members down to stop_sent_
    std::condition_variable concluded_;
    std::condition_variable passed_;
    std::map<std::uint64_t, Queue> queues_;
    std::list<Request> requests_;  // waiting until tiles may be handed out
    std::vector<std::optional<Report>> reports_;
    std::optional<Report> combined_;
    std::stop_source stop_;
    bool stop_sent_ = false;
    std::atomic<bool> stopping_ = false;
    std::optional<Report> failure_;  // combined failure, once known
    bool has_reported_ = false;      // sent a report without waiting for the answer
    std::mutex tiles_mutex_;         // guards the next three
    std::map<std::uint64_t, LocalTiles> local_tiles_;
    std::set<std::uint64_t> requested_;       // queues with a pending request to the root
    std::map<std::uint64_t, Tiles> answers_;  // received for other queues
    std::mutex listeners_mutex_;
    std::map<std::uint64_t, std::function<void(std::string)>> listeners_;  // null: ended
    std::map<std::uint64_t, std::list<std::string>> unclaimed_;            // received before the channel had a listener
    std::map<std::size_t, std::list<std::string>> direct_;                 // received from each rank, not yet taken
    std::jthread server_;
};

}  // namespace hogel::mpi
