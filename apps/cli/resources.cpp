// SPDX-License-Identifier: Apache-2.0
#include "resources.h"

#include <malloc.h>
#include <time.h>

#include <fstream>
#include <limits>
#include <string>

namespace hogel::cli {
namespace {

// The value of a line "name: number kB" of a file in /proc.
double kilobytes(const char* path, const std::string& name) {
    std::ifstream file(path);
    for (std::string word; file >> word;)
        if (word == name + ":") {
            double value = 0;
            file >> value;
            return 1024 * value;
        }
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double memory_held() { return kilobytes("/proc/self/status", "VmRSS"); }

double max_memory_held() { return kilobytes("/proc/self/status", "VmHWM"); }

double forget_most_memory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    return memory_held();
}

double memory_available() { return kilobytes("/proc/meminfo", "MemAvailable"); }

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace hogel::cli
