// SPDX-License-Identifier: MIT
#include "child.hpp"

#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness.hpp"

namespace tribo::bench {
namespace {

// The first `most` of the processors that this process may use.
void keep_to_processors(int most) {
    cpu_set_t allowed, chosen;
    CPU_ZERO(&chosen);
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
    for (int n = 0; n < CPU_SETSIZE && CPU_COUNT(&chosen) < most; ++n) {
        if (CPU_ISSET(n, &allowed)) CPU_SET(n, &chosen);
    }
    sched_setaffinity(0, sizeof chosen, &chosen);
}

}  // namespace

std::optional<Cost> run(const std::string& program, const std::vector<std::string>& arguments,
                        const std::string& log) {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const double start = wall_s();
    const pid_t child = fork();
    if (child == 0) {
        keep_to_processors(2);
        const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
        execv(program.c_str(), argv.data());
        std::perror(program.c_str());
        _exit(127);
    }
    int status = 0;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        return {};
    }
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return Cost{wall_s() - start, seconds(used.ru_utime) + seconds(used.ru_stime),
                static_cast<double>(used.ru_maxrss) * 1024e-6};
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tribo-bench-XXXXXX").string();
    if (mkdtemp(name.data())) path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace tribo::bench
