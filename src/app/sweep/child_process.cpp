// SPDX-License-Identifier: MIT
#include "app/sweep/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace tribo::app {

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        signal(SIGTERM);
        wait();
    }
    close_input();
    if (output_ >= 0) ::close(output_);
}

int ChildProcess::start(const std::string& program, std::vector<std::string> arguments, bool joined) {
    std::array<int, 2> in{-1, -1}, out{-1, -1};
    if (::pipe2(in.data(), O_CLOEXEC) != 0) return errno;
    if (::pipe2(out.data(), O_CLOEXEC) != 0) {
        const int error = errno;
        ::close(in[0]);
        ::close(in[1]);
        return error;
    }
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    if (joined) ::posix_spawn_file_actions_adddup2(&actions, out[1], STDERR_FILENO);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const int error = ::posix_spawnp(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(in[0]);
    ::close(out[1]);
    input_ = in[1];
    output_ = out[0];
    if (error != 0) pid_ = 0;
    return error;
}

void ChildProcess::write(std::string_view bytes) const {
    while (!bytes.empty()) {
        const ssize_t written = ::write(input_, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) return;
        if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

bool ChildProcess::read(std::string& bytes) const {
    std::array<char, 4096> some;
    for (;;) {
        const ssize_t size = ::read(output_, some.data(), some.size());
        if (size < 0 && errno == EINTR) continue;
        if (size <= 0) return false;
        bytes.append(some.data(), static_cast<std::size_t>(size));
        return true;
    }
}

int ChildProcess::wait() {
    close_input();
    int status = 0;
    while (pid_ > 0 && ::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = 0;
    return status;
}

void ChildProcess::signal(int number) const {
    if (pid_ > 0) ::kill(pid_, number);
}

void ChildProcess::close_input() {
    if (input_ >= 0) ::close(input_);
    input_ = -1;
}

}  // namespace tribo::app
