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

/// What a process says when all of them meet, and what the first one answers when all have spoken.
struct Report {
    bool failed = false;
    int status = 0;  ///< exit status
    ErrorCode code = ErrorCode::cancelled;
    std::uint64_t number = 0;  ///< their sum in the answer
    std::string text;          ///< what is printed
};

/// A team over a link. A thread of the first process has the queues and answers; a thread of each other one hears when
/// work is to stop.
class RankCommunicator final : public Communicator {
  public:
    /// @param threads  of this process, by which work is divided at first
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
    void send_to(std::size_t process, std::string bytes) override;
    std::string receive_from(std::size_t process) override;

    /// A stop of any process is requested from the sources of all.
    void stop_with(std::stop_source stop);
    /// At the end of the work, well or not: what all processes together come to, the failure of the first that has
    /// failed. Nothing if others do not come within `patience` after this one has failed.
    /// @param silent  called once with the processes that did not answer within a third of a second after this one has
    ///                failed: in the first process all of those, in others the first one
    std::optional<Report> settle(Report own, std::chrono::seconds patience,
                                 const std::function<void(const std::vector<std::size_t>&)>& silent = {});

  private:
    // Consecutive tiles; none if `count` is 0.
    struct Tiles {
        std::uint64_t first = 0, count = 0;
    };
    // Those of a queue that this process has not begun.
    struct OwnTiles {
        Tiles here;
        bool over = false;  // no more will come
    };
    struct Queue {
        std::uint64_t next = 0, tiles = 0, done = 0;
    };
    struct Request {
        std::size_t from;
        std::uint64_t queue, tiles, ahead;
    };
    Report agree(Report own);
    void report(Report own);
    std::optional<Report> verdict(std::optional<std::chrono::milliseconds> patience);
    std::vector<std::size_t> silent_ones();
    bool is_to_stop();
    bool serve();
    bool serve_first();
    void take_report(std::size_t from, Report report);
    void stop_all();
    void stop_here();
    std::optional<Tiles> take_tiles(const Request& request);
    void answer_requests();
    void ask(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead);
    Tiles next_tiles(std::uint64_t queue, std::uint64_t tiles, std::uint64_t ahead);

    Link& link_;
    std::mutex mutex_;  // of the members up to the listeners
    std::condition_variable concluded_;
    std::condition_variable passed_;
    std::map<std::uint64_t, Queue> queues_;
    std::list<Request> requests_;  // that wait until tiles may be handed out
    std::vector<std::optional<Report>> reports_;
    std::optional<Report> verdict_;
    std::stop_source stop_;
    bool stop_sent_ = false;
    std::atomic<bool> stopping_ = false;
    std::optional<Report> failure_;  // once known
    bool has_reported_ = false;      // and did not wait for the answer
    std::mutex asking_;              // of the next three
    std::map<std::uint64_t, OwnTiles> own_;
    std::set<std::uint64_t> asked_;           // queues of whose tiles the first process was asked
    std::map<std::uint64_t, Tiles> answers_;  // that came and were not waited for
    std::mutex listening_;
    std::map<std::uint64_t, std::function<void(std::string)>> listeners_;  // null: ended
    std::map<std::uint64_t, std::list<std::string>> early_;                // what came before a channel's listener
    std::map<std::size_t, std::list<std::string>> direct_;  // what came of a process before it was waited for
    std::jthread server_;
};

}  // namespace hogel::mpi
