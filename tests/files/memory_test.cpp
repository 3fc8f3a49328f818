// SPDX-License-Identifier: MIT
#include "files/memory.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <vector>

#include "files/files.hpp"
#include "files/scratch.hpp"

namespace tribo::files {
namespace {

using test::Scratch;

TEST(AvailableMemory, is_the_machines_where_no_group_limits_it) {
    const Scratch root;
    root.put("proc/meminfo", "MemTotal:       16384 kB\nMemFree: 1 kB\n");
    EXPECT_EQ(available_memory_bytes(root.path()), 16384u * 1024);
    root.put("proc/self/cgroup", "0::/user.slice/run\n");
    root.put("sys/fs/cgroup/user.slice/memory.max", "max\n");
    EXPECT_EQ(available_memory_bytes(root.path()), 16384u * 1024);
}

TEST(AvailableMemory, is_the_least_limit_on_the_way_to_the_root_of_the_groups) {
    const Scratch root;
    root.put("proc/meminfo", "MemTotal: 16384 kB\n");
    root.put("proc/self/cgroup", "0::/user.slice/run\n");
    root.put("sys/fs/cgroup/user.slice/run/memory.max", "9000000\n");
    root.put("sys/fs/cgroup/user.slice/memory.max", "5000000\n");
    EXPECT_EQ(available_memory_bytes(root.path()), 5000000u);
    root.put("sys/fs/cgroup/memory.max", "4000000\n");
    EXPECT_EQ(available_memory_bytes(root.path()), 4000000u);
}

TEST(AvailableMemory, is_found_in_files_that_no_run_is_made_of) {
    const Scratch root;
    root.put("proc/meminfo", "MemTotal: 16384 kB\n");
    EXPECT_EQ(available_memory_bytes(root.path()), 16384u * 1024);
    EXPECT_FALSE(was_read(root.path() + "/proc/meminfo"));
}

TEST(AvailableMemory, obeys_groups_of_version_one) {
    const Scratch root;
    root.put("proc/meminfo", "MemTotal: 16384 kB\n");
    root.put("proc/self/cgroup", "5:cpu,cpuacct:/x\n4:memory:/job\nmalformed\n");
    root.put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    root.put("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "3000000\n");
    EXPECT_EQ(available_memory_bytes(root.path()), 3000000u);
}

TEST(AvailableMemory, is_zero_where_nothing_tells) {
    const Scratch root;
    EXPECT_EQ(available_memory_bytes(root.path()), 0u);
}

TEST(AvailableMemory, of_this_machine_is_plausible) {
    EXPECT_GT(available_memory_bytes(), std::uint64_t{100} << 20);
    EXPECT_EQ(default_memory_budget_bytes(), available_memory_bytes() / 2);
}

TEST(PeakMemory, grows_by_what_is_taken) {
    constexpr std::size_t kTaken = std::size_t{100} << 20;
    const std::uint64_t before = peak_memory_bytes();
    std::vector<char> block(kTaken);
    for (std::size_t i = 0; i < kTaken; i += 512) static_cast<volatile char*>(block.data())[i] = 1;
    const std::uint64_t after = peak_memory_bytes();
    EXPECT_GE(after, kTaken);
    EXPECT_GE(after, before);
}

}  // namespace
}  // namespace tribo::files
