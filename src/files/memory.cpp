// SPDX-License-Identifier: MIT
#include "files/memory.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <sys/resource.h>

#include "files/files.hpp"

namespace tribo::files {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kFallbackBytes = std::uint64_t{2} << 30;  // if the system does not state its memory
constexpr std::uint64_t kSystemFileBytes = std::uint64_t{1} << 20;

// Returns the number at the start of `text`, after blanks; kNoLimit if there is none ("max").
std::uint64_t leading_number(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    std::uint64_t value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    return parsed.ec == std::errc() ? value : kNoLimit;
}

std::uint64_t number_in_file(const std::string& path) {
    const FileResult<std::string> text = first_bytes(path, kSystemFileBytes);
    return text ? leading_number(*text) : kNoLimit;
}

// Returns the smallest limit from a group up to the root of its hierarchy.
std::uint64_t group_limit(const std::string& hierarchy, std::string group, const char* file) {
    std::uint64_t limit = number_in_file(hierarchy + "/" + file);
    while (!group.empty() && group != "/") {
        limit = std::min(limit, number_in_file(hierarchy + group + "/" + file));
        group.resize(std::min(group.rfind('/'), group.size()));
    }
    return limit;
}

// Lines of /proc/self/cgroup: `0::/path` (version 2) or `N:controllers:/path` (version 1).
std::uint64_t control_group_limit(const std::string& root) {
    const FileResult<std::string> text = first_bytes(root + "/proc/self/cgroup", kSystemFileBytes);
    if (!text) return kNoLimit;
    std::uint64_t limit = kNoLimit;
    std::string_view rest = *text;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        const std::size_t first = line.find(':');
        const std::size_t second = first == line.npos ? line.npos : line.find(':', first + 1);
        if (second == line.npos) continue;
        const std::string_view controllers = line.substr(first + 1, second - first - 1);
        const std::string group(line.substr(second + 1));
        if (controllers.empty())
            limit = std::min(limit, group_limit(root + "/sys/fs/cgroup", group, "memory.max"));
        if (controllers == "memory") {
            limit =
                std::min(limit, group_limit(root + "/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
        }
    }
    return limit;
}

std::uint64_t machine_memory(const std::string& root) {
    const FileResult<std::string> text = first_bytes(root + "/proc/meminfo", kSystemFileBytes);
    const std::size_t at = text ? text->find("MemTotal:") : std::string::npos;
    if (at == std::string::npos) return kNoLimit;
    const std::uint64_t kilobytes = leading_number(std::string_view(*text).substr(at + 9));
    return kilobytes == kNoLimit ? kNoLimit : kilobytes * 1024;
}

}  // namespace

std::uint64_t available_memory_bytes(const std::string& root) {
    const std::uint64_t bytes = std::min(machine_memory(root), control_group_limit(root));
    return bytes == kNoLimit ? 0 : bytes;
}

std::uint64_t peak_memory_bytes() {
    struct rusage usage = {};
    if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t default_memory_budget_bytes() {
    const std::uint64_t bytes = available_memory_bytes();
    return (bytes == 0 ? kFallbackBytes : bytes) / 2;
}

}  // namespace tribo::files
