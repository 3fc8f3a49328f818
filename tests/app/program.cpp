// SPDX-License-Identifier: MIT
#include "app/program.hpp"

#include <chrono>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace tribo::test {

Outcome run_tribo(const std::vector<std::string>& arguments, const std::string& folder,
                  int interrupt_after_ms, int signal) {
    const Scratch scratch;  // output goes to files: no pipe can fill up
    const std::string out = scratch / "out", err = scratch / "err";
    std::vector<char*> argv;
    std::string name = TRIBO_PROGRAM;
    std::vector<std::string> copies = arguments;
    argv.push_back(name.data());
    for (std::string& argument : copies) argv.push_back(argument.data());
    argv.push_back(nullptr);

    const pid_t child = ::fork();
    if (child == 0) {
        const auto redirect = [](const char* path, int flags, int to) {
            ::dup2(::open(path, flags, 0600), to);
        };
        redirect("/dev/null", O_RDONLY, 0);
        redirect(out.c_str(), O_WRONLY | O_CREAT, 1);
        redirect(err.c_str(), O_WRONLY | O_CREAT, 2);
        if (::chdir(folder.c_str()) == 0) ::execv(name.c_str(), argv.data());
        ::_exit(126);
    }
    if (interrupt_after_ms > 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(interrupt_after_ms));
        ::kill(child, signal);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = scratch.get("out");
    outcome.err = scratch.get("err");
    return outcome;
}

}  // namespace tribo::test
