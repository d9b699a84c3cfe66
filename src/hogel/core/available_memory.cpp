// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace hogel::core {
namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

// Returns the number after a key in a file, or `otherwise`.
double number_after(const fs::path& path, const std::string& key, double otherwise) {
    std::ifstream file(path);
    double number = 0;
    for (std::string word; file >> word;)
        if (word == key) return file >> number ? number : otherwise;
    return otherwise;
}

// Returns the number at the beginning of a file; unlimited if there is none, as in "max".
double number_in(const fs::path& path) {
    std::ifstream file(path);
    double number = 0;
    return file >> number ? number : unlimited;
}

// Returns the remainder of a limit of this process, bytes.
double remaining_limit(__rlimit_resource resource, double pages) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
    const double used = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
    return std::max(static_cast<double>(limit.rlim_cur) - used, 0.0);
}

double remaining_limits(const fs::path& root) {
    std::ifstream file(root / "proc/self/statm");
    double size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
    file >> size >> resident >> shared >> text >> library >> data;
    return std::min(remaining_limit(RLIMIT_AS, size), remaining_limit(RLIMIT_DATA, data));
}

// File names of a control group version.
struct GroupFiles {
    const char *limit, *usage, *reclaimable;
};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles version_2{"memory.max", "memory.current", "inactive_file"};

// Returns the remainder of a group and its ancestors, bytes. Unused cached file pages count as free. A process in a
// container may see its own group as the outermost one.
double remaining_groups(const fs::path& outermost, const fs::path& group, const GroupFiles& files) {
    double remaining = unlimited;
    for (fs::path ancestor = group;; ancestor = ancestor.parent_path()) {
        const fs::path folder = outermost / ancestor;
        if (const double limit = number_in(folder / files.limit); limit < unlimited) {
            const double used =
                number_in(folder / files.usage) - number_after(folder / "memory.stat", files.reclaimable, 0);
            if (used < unlimited) remaining = std::min(remaining, std::max(limit - std::max(used, 0.0), 0.0));
        }
        if (ancestor.empty()) return remaining;
    }
}

double remaining_control_groups(const fs::path& root) {
    std::ifstream file(root / "proc/self/cgroup");
    double remaining = unlimited;
    for (std::string line; std::getline(file, line);) {
        // NUMBER:CONTROLLERS:/PATH; version 2 has the number 0 and no list of controllers.
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const fs::path group = fs::path(line.substr(second + 1)).relative_path();
        if (controllers.empty())
            remaining = std::min(remaining, remaining_groups(root / "sys/fs/cgroup", group, version_2));
        else if (("," + controllers + ",").find(",memory,") != std::string::npos)
            remaining = std::min(remaining, remaining_groups(root / "sys/fs/cgroup/memory", group, version_1));
    }
    return remaining;
}

}  // namespace

double available_memory(const fs::path& root) {
    const double machine = 1024 * number_after(root / "proc/meminfo", "MemAvailable:", unlimited);
    return std::min({machine, remaining_limits(root), remaining_control_groups(root)});
}

}  // namespace hogel::core
