// SPDX-License-Identifier: MIT
#include "app/run/program.hpp"

#include <chrono>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "places.hpp"

namespace tribo::test {

namespace {

int start(std::vector<std::string> arguments, const std::string& folder, const Scratch& scratch) {
    const std::string out = scratch / "out", err = scratch / "err";
    std::vector<char*> argv;
    std::string name = TRIBO_PROGRAM;
    argv.push_back(name.data());
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child != 0) return child;
    const auto redirect = [](const char* path, int flags, int to) { ::dup2(::open(path, flags, 0600), to); };
    redirect("/dev/null", O_RDONLY, 0);
    redirect(out.c_str(), O_WRONLY | O_CREAT, 1);
    redirect(err.c_str(), O_WRONLY | O_CREAT, 2);
    if (::chdir(folder.c_str()) == 0) ::execv(name.c_str(), argv.data());
    ::_exit(126);
}

Outcome end_of(int child, const Scratch& scratch) {
    int status = 0;
    struct rusage usage = {};
    ::wait4(child, &status, 0, &usage);
    Outcome outcome;
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    outcome.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    outcome.peak_mb = static_cast<double>(usage.ru_maxrss) / 1000;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = scratch.get("out");
    outcome.err = scratch.get("err");
    return outcome;
}

}  // namespace

Outcome run_tribo(const std::vector<std::string>& arguments, const std::string& folder,
                  int interrupt_after_ms, int signal) {
    const Scratch scratch;
    const int child = start(arguments, folder, scratch);
    if (interrupt_after_ms > 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(interrupt_after_ms));
        ::kill(child, signal);
    }
    return end_of(child, scratch);
}

RunningTribo::RunningTribo(std::vector<std::string> arguments, const std::string& folder)
    : pid_(start(std::move(arguments), folder, scratch_)) {}

RunningTribo::~RunningTribo() {
    if (pid_ > 0) stop(SIGKILL);
}

std::string RunningTribo::out_with(const std::string& mark) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    std::string out;
    while (std::chrono::steady_clock::now() < end) {
        out = scratch_.get("out");
        if (out.find(mark) != std::string::npos) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return out;
}

Outcome RunningTribo::stop(int signal) {
    ::kill(pid_, signal);
    return end_of(std::exchange(pid_, -1), scratch_);
}

}  // namespace tribo::test
