// SPDX-License-Identifier: Apache-2.0
#include "bench/measure.h"

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <string>

#include "bench/session.h"

namespace hogel::bench {
namespace {

double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Returns the value of a line "name: number kB" of /proc/self/status, in bytes.
double status_bytes(const std::string& name) {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;)
        if (word == name + ":") {
            double value = 0;
            file >> value;
            return 1024 * value;
        }
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double processor_seconds() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

Times time_of(const std::function<void()>& work) {
    const auto began = std::chrono::steady_clock::now();
    const double processor = processor_seconds();
    work();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(),
            processor_seconds() - processor};
}

Times median_time_of(const std::function<void()>& work, std::size_t rounds) {
    std::vector<double> wall, processor;
    for (std::size_t i = 0; i < rounds; ++i) {
        stop_if_interrupted();
        const Times times = time_of(work);
        wall.push_back(times.wall);
        processor.push_back(times.processor);
    }
    return {median(wall), median(processor)};
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

double memory_held() { return status_bytes("VmRSS"); }

double max_memory_held() { return status_bytes("VmHWM"); }

double reset_max_memory_held() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // resets VmHWM
    return memory_held();
}

}  // namespace hogel::bench
