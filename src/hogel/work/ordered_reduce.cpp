// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/ordered_reduce.h"

#include "hogel/core/stop_scope.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace hogel::work {
namespace {

// Interval at which the root checks for a stop request while it waits for results of other ranks.
constexpr std::chrono::milliseconds between_looks{20};

}  // namespace

// A rank holds several tiles, because a request takes a tenth of the time of a small tile.
std::size_t tiles_in_flight(std::size_t in_flight) { return 4 * in_flight; }

namespace {

// Queue of results on the root, and the thread that merges them in order.
class Merger {
  public:
    Merger(Communicator& communicator, std::uint64_t queue, std::size_t n,
           const std::function<void(std::size_t, std::string_view)>& merge)
        : communicator_(communicator), queue_(queue), n_(n), merge_(merge) {
        communicator_.listen(queue_, [this](std::string bytes) {
            if (bytes.empty()) return open();
            const std::uint64_t i = take_last_number(bytes);
            if (const bool is_last = take_last_number(bytes) != 0; !is_last)
                parts_[i] += bytes;
            else if (const auto part = parts_.extract(i))
                put(i, std::move(part.mapped()) + bytes);
            else
                put(i, std::move(bytes));
        });
        thread_ = std::jthread([this] { run(); });
    }
    ~Merger() {
        end();
        thread_.join();
        communicator_.listen(queue_, {});
    }
    Merger(const Merger&) = delete;
    Merger& operator=(const Merger&) = delete;

    void put(std::size_t i, std::string bytes) {
        const std::lock_guard lock(mutex_);
        results_.emplace(i, std::move(bytes));
        changed_.notify_all();
    }

    // Releases threads that wait for tiles although results are missing: a rank has failed.
    void open() { communicator_.pass(queue_, n_); }

    // Rethrows an exception of the merge.
    void check() {
        const std::lock_guard lock(mutex_);
        if (failure_) std::rethrow_exception(failure_);
    }

    // Waits until all results are merged.
    void finish() {
        std::unique_lock lock(mutex_);
        while (!changed_.wait_for(lock, between_looks, [&] { return merged_ == n_ || failure_; })) {
            lock.unlock();
            core::throw_if_stopped();
            lock.lock();
        }
        if (failure_) std::rethrow_exception(failure_);
    }

  private:
    void end() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }

    void run() {
        try {
            for (std::size_t i = 0; i < n_; ++i) {
                std::unique_lock lock(mutex_);
                changed_.wait(lock, [&] { return closed_ || results_.contains(i); });
                if (closed_) return;
                const std::string bytes = std::move(results_.extract(i).mapped());
                lock.unlock();
                merge_(i, bytes);
                communicator_.pass(queue_, i + 1);
                lock.lock();
                merged_ = i + 1;
                changed_.notify_all();
            }
        } catch (...) {
            {
                const std::lock_guard lock(mutex_);
                failure_ = std::current_exception();
                changed_.notify_all();
            }
            open();
        }
    }

    Communicator& communicator_;
    std::uint64_t queue_;
    std::size_t n_;
    const std::function<void(std::size_t, std::string_view)>& merge_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::size_t, std::string> parts_;  // received parts of incomplete results
    std::map<std::size_t, std::string> results_;
    std::size_t merged_ = 0;
    bool closed_ = false;
    std::exception_ptr failure_;
    std::jthread thread_;
};

}  // namespace

namespace {

// Sends result i to the root.
void send_result(Communicator& communicator, std::uint64_t channel, std::size_t i, std::string bytes,
                 std::size_t max_message) {
    const auto send = [&](std::string part, bool is_last) {
        append_number(part, is_last ? 1 : 0);
        append_number(part, i);
        communicator.send(channel, std::move(part));
    };
    std::size_t first = 0;
    for (; bytes.size() - first > max_message; first += max_message) send(bytes.substr(first, max_message), false);
    send(first == 0 ? std::move(bytes) : bytes.substr(first), true);
}

}  // namespace

void ordered_reduce_in_ranks(Communicator& communicator, std::size_t n, std::size_t in_flight,
                             const std::function<std::string(std::size_t)>& body,
                             const std::function<void(std::size_t, std::string_view)>& merge, std::size_t max_message) {
    const bool one_by_one = in_flight == 1;
    const std::uint64_t queue = communicator.next_number();
    const std::uint64_t window = one_by_one ? n : tiles_in_flight(in_flight) * communicator.size();
    std::optional<Merger> merger;
    if (communicator.is_root()) merger.emplace(communicator, queue, n, merge);
    const auto compute_next = [&](std::size_t) {
        if (merger) merger->check();
        const std::optional<std::uint64_t> i = communicator.next_tile(queue, n, window);
        if (!i) return;
        try {
            std::string bytes = body(*i);
            merger ? merger->put(*i, std::move(bytes))
                   : send_result(communicator, queue, *i, std::move(bytes), max_message);
        } catch (...) {
            merger ? merger->open() : communicator.send(queue, "");
            throw;
        }
    };
    if (one_by_one)
        for (std::size_t i = 0; i < n; ++i) compute_next(i);
    else
        parallel_for(n, compute_next);
    if (merger) merger->finish();
}

void ordered_reduce_bytes(std::size_t n, std::size_t in_flight, const std::function<std::string(std::size_t)>& body,
                          const std::function<void(std::size_t, std::string_view)>& merge, DoneBy by) {
    Communicator* const current = communicator_of_several();
    ResultLog* const log = result_log();
    std::size_t kept = log != nullptr ? log->begin(n, merge) : 0;
    if (log != nullptr && current != nullptr) kept = current->sum(kept);  // only the root knows the number
    const auto rest = [&](std::size_t i) { return body(kept + i); };
    const auto merge_rest = [&](std::size_t i, std::string_view bytes) {
        merge(kept + i, bytes);
        if (log != nullptr) log->keep(bytes);
    };
    if (current != nullptr && by == DoneBy::one_rank)
        return ordered_reduce_in_ranks(*current, n - kept, in_flight, rest, merge_rest);
    if (in_flight > 1)
        return local_ordered_reduce<std::string>(
            n - kept, in_flight, rest, [&](std::size_t i, const std::string& bytes) { merge_rest(i, bytes); });
    for (std::size_t i = 0; i < n - kept; ++i) {
        core::throw_if_stopped();
        merge_rest(i, rest(i));
    }
}

}  // namespace hogel::work
