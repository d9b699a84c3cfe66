// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/available_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <string>

namespace hogel::core {
namespace {

namespace fs = std::filesystem;

class AvailableMemory : public testing::Test {
  protected:
    AvailableMemory() { put("proc/meminfo", "MemTotal: 9000 kB\nMemAvailable: 8000 kB\n"); }
    ~AvailableMemory() override { fs::remove_all(root_); }

    void put(const fs::path& name, const std::string& text) const {
        fs::create_directories((root_ / name).parent_path());
        std::ofstream(root_ / name) << text;
    }
    double available() const { return available_memory(root_); }

    fs::path root_ = fs::path(testing::TempDir()) / ("hogel_memory_" + std::to_string(::getpid()));
};

TEST_F(AvailableMemory, is_that_of_the_machine) { EXPECT_EQ(available(), 8000 * 1024); }

TEST_F(AvailableMemory, is_unlimited_where_the_system_says_nothing) {
    fs::remove_all(root_);
    EXPECT_EQ(available(), std::numeric_limits<double>::infinity());
}

TEST_F(AvailableMemory, is_the_least_that_groups_of_version_2_leave) {
    put("proc/self/cgroup", "0::/outer/inner\n");
    const fs::path groups = "sys/fs/cgroup";
    put(groups / "outer/inner/memory.max", "max\n");
    put(groups / "outer/inner/memory.current", "5000\n");
    EXPECT_EQ(available(), 8000 * 1024);
    put(groups / "outer/memory.max", "100000\n");
    put(groups / "outer/memory.current", "70000\n");
    EXPECT_EQ(available(), 30000);
    put(groups / "outer/memory.stat", "anon 40000\ninactive_file 20000\nactive_file 1\n");
    EXPECT_EQ(available(), 50000);
    put(groups / "outer/inner/memory.max", "6000\n");
    EXPECT_EQ(available(), 1000);
    put(groups / "outer/inner/memory.current", "7000\n");
    EXPECT_EQ(available(), 0);
}

TEST_F(AvailableMemory, is_the_least_that_groups_of_version_1_leave) {
    put("proc/self/cgroup", "9:name=systemd:/\n4:cpu,memory:/job\n0::/\n");
    const fs::path groups = "sys/fs/cgroup/memory";
    put(groups / "memory.limit_in_bytes", "9223372036854771712\n");
    put(groups / "memory.usage_in_bytes", "500000\n");
    EXPECT_EQ(available(), 8000 * 1024);
    put(groups / "job/memory.limit_in_bytes", "90000\n");
    put(groups / "job/memory.usage_in_bytes", "50000\n");
    put(groups / "job/memory.stat", "inactive_file 1\ntotal_inactive_file 10000\n");
    EXPECT_EQ(available(), 50000);
}

TEST_F(AvailableMemory, in_a_container_is_that_of_the_outermost_group_that_shows) {
    put("proc/self/cgroup", "0::/elsewhere/job\n");
    put("sys/fs/cgroup/memory.max", "3000\n");
    put("sys/fs/cgroup/memory.current", "1000\n");
    EXPECT_EQ(available(), 2000);
}

TEST_F(AvailableMemory, is_what_limits_of_the_process_leave) {
    put("proc/self/statm", "1000 800 100 10 0 600 0\n");
    const double page = static_cast<double>(sysconf(_SC_PAGESIZE));
    const auto below = [&](__rlimit_resource resource, double left) {
        const pid_t child = fork();
        if (child == 0) {
            rlimit limit{};
            getrlimit(resource, &limit);
            limit.rlim_cur = rlim_t{1} << 40;
            setrlimit(resource, &limit);
            put("proc/meminfo", "MemAvailable: 99999999999 kB\n");
            _exit(available() == left ? 0 : 1);
        }
        int status = -1;
        waitpid(child, &status, 0);
        return status == 0;
    };
    EXPECT_TRUE(below(RLIMIT_AS, (1ll << 40) - 1000 * page));
    EXPECT_TRUE(below(RLIMIT_DATA, (1ll << 40) - 600 * page));
}

TEST(AvailableMemoryOfThisMachine, is_positive_and_finite) {
    EXPECT_GT(available_memory(), 0);
    EXPECT_LT(available_memory(), 1e15);
}

}  // namespace
}  // namespace hogel::core
