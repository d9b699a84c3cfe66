// SPDX-License-Identifier: Apache-2.0
#include "view/worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <string>

namespace hogel::view {
namespace {

using namespace std::chrono_literals;

// A job that runs until it is stopped or let go.
struct Gate {
    std::promise<void> began;
    std::atomic<bool> open = false, stopped = false;

    Worker::Job job(bool ends_first) {
        return {[this](std::stop_token stop) {
                    began.set_value();
                    while (!open && !stop.stop_requested()) std::this_thread::sleep_for(1ms);
                    stopped = stop.stop_requested();
                },
                ends_first};
    }
};

// Waits until all jobs before it are done.
void drain(Worker& worker, std::uint64_t client) {
    std::promise<void> done;
    worker.put(client, {[&](std::stop_token) { done.set_value(); }, true});
    ASSERT_EQ(done.get_future().wait_for(30s), std::future_status::ready);
}

TEST(Worker, a_newer_job_stops_one_at_rest) {
    Gate gate;
    Worker worker;
    worker.put(1, gate.job(false));
    gate.began.get_future().wait();
    drain(worker, 1);
    EXPECT_TRUE(gate.stopped);
}

TEST(Worker, one_in_motion_ends_first) {
    Gate gate;
    Worker worker;
    worker.put(1, gate.job(true));
    gate.began.get_future().wait();
    std::promise<void> done;
    worker.put(1, {[&](std::stop_token) { done.set_value(); }, true});
    EXPECT_EQ(done.get_future().wait_for(20ms), std::future_status::timeout);
    gate.open = true;
    drain(worker, 2);
    EXPECT_FALSE(gate.stopped);
}

TEST(Worker, of_each_client_the_newest_waits_and_clients_take_turns) {
    Gate gate;
    std::string order;
    {
        Worker worker;
        worker.put(9, gate.job(true));
        gate.began.get_future().wait();
        for (const char letter : {'a', 'b', 'c'})
            for (const std::uint64_t client : {1, 2})
                worker.put(
                    client,
                    {[&order, letter, client](std::stop_token) { order += letter + std::to_string(client); }, true});
        gate.open = true;
        drain(worker, 3);
    }
    EXPECT_EQ(order, "c1c2");
}

TEST(Worker, another_client_stops_nothing) {
    Gate gate;
    Worker worker;
    worker.put(1, gate.job(false));
    gate.began.get_future().wait();
    worker.put(2, {[](std::stop_token) {}, false});
    std::this_thread::sleep_for(20ms);
    EXPECT_FALSE(gate.stopped);
    gate.open = true;
    drain(worker, 2);
    EXPECT_FALSE(gate.stopped);
}

TEST(Worker, a_client_that_is_gone_is_stopped_and_forgotten) {
    Gate gate;
    std::atomic<bool> ran = false;
    Worker worker;
    worker.put(1, gate.job(true));
    gate.began.get_future().wait();
    worker.put(1, {[&](std::stop_token) { ran = true; }, true});
    worker.drop(1);
    drain(worker, 2);
    EXPECT_TRUE(gate.stopped);
    EXPECT_FALSE(ran);
}

TEST(Worker, its_end_stops_what_runs_and_forgets_what_waits) {
    Gate gate;
    std::atomic<bool> ran = false;
    {
        Worker worker;
        worker.put(1, gate.job(true));
        gate.began.get_future().wait();
        worker.put(2, {[&](std::stop_token) { ran = true; }, true});
    }
    EXPECT_TRUE(gate.stopped);
    EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace hogel::view
