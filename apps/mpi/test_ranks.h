// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "mpi/rank_communicator.h"

namespace hogel::mpi {

/// Links between threads of this process, for tests.
class Post {
  public:
    explicit Post(std::size_t size) : size_(size) {}

    class Box final : public Link {
      public:
        Box(Post& post, std::size_t rank) : post_(post), rank_(rank) {}
        std::size_t rank() const override { return rank_; }
        std::size_t size() const override { return post_.size_; }
        void send(std::size_t to, Kind kind, std::string bytes) override {
            const std::lock_guard lock(post_.mutex_);
            post_.boxes_[{to, kind}].push_back({rank_, std::move(bytes)});
        }
        std::optional<Message> receive(Kind kind) override {
            const std::lock_guard lock(post_.mutex_);
            std::deque<Message>& box = post_.boxes_[{rank_, kind}];
            if (box.empty()) return std::nullopt;
            Message message = std::move(box.front());
            box.pop_front();
            return message;
        }

      private:
        Post& post_;
        std::size_t rank_;
    };

  private:
    std::size_t size_;
    std::mutex mutex_;
    std::map<std::pair<std::size_t, Kind>, std::deque<Message>> boxes_;
};

/// Runs work(communicator) on `size` ranks, each a thread. The communicators end together, as after MPI_Finalize().
template <class Work>
void run_ranks(std::size_t size, const Work& work) {
    Post post(size);
    std::vector<std::unique_ptr<Post::Box>> boxes;
    std::vector<std::unique_ptr<RankCommunicator>> communicators;
    for (std::size_t rank = 0; rank < size; ++rank) boxes.push_back(std::make_unique<Post::Box>(post, rank));
    for (const auto& box : boxes) communicators.push_back(std::make_unique<RankCommunicator>(*box));
    std::vector<std::jthread> ranks;
    for (const auto& communicator : communicators) ranks.emplace_back([&] { work(*communicator); });
    ranks.clear();
}

// Time after which a waiting test fails: a hang on any machine.
inline constexpr std::chrono::seconds patience{60};

// Waits until `test` returns true. Returns false after `patience`.
bool comes_true(const auto& test) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!test()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

}  // namespace hogel::mpi
