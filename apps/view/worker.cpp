// SPDX-License-Identifier: Apache-2.0
#include "view/worker.h"

#include <algorithm>
#include <utility>

namespace hogel::view {

Worker::Worker() : thread_([this](std::stop_token end) { run(end); }) {}

Worker::~Worker() {
    thread_.request_stop();
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    stop_.request_stop();
}

void Worker::put(std::uint64_t client, Job job) {
    const std::lock_guard lock(mutex_);
    if (running_ == client && !running_ends_first_) stop_.request_stop();
    const auto found = std::ranges::find(waiting_, client, &Waiting::client);
    if (found != waiting_.end())
        found->job = std::move(job);
    else
        waiting_.push_back({client, std::move(job)});
    changed_.notify_one();
}

void Worker::drop(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    std::erase_if(waiting_, [&](const Waiting& each) { return each.client == client; });
    if (running_ == client) stop_.request_stop();
}

std::optional<Worker::Waiting> Worker::next(std::stop_token end) {
    std::unique_lock lock(mutex_);
    running_.reset();
    if (!changed_.wait(lock, end, [&] { return !waiting_.empty(); }) || end.stop_requested()) return {};
    Waiting first = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    running_ = first.client;
    running_ends_first_ = first.job.ends_first;
    stop_ = std::stop_source();
    return first;
}

void Worker::run(std::stop_token end) {
    while (std::optional<Waiting> job = next(end)) {
        std::stop_token stop;
        {
            const std::lock_guard lock(mutex_);
            stop = stop_.get_token();
        }
        job->job.work(stop);
    }
}

}  // namespace hogel::view
