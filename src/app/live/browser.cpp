// SPDX-License-Identifier: MIT
#include "app/live/browser.hpp"

#include <cstdio>
#include <fcntl.h>
#include <optional>
#include <signal.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "app/live/opening_page.hpp"

namespace tribo::app {
namespace {

// Without a screen xdg-open would start a text browser in this terminal.
bool has_screen() {
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
        const std::string_view text(*entry);
        for (const std::string_view name : {"DISPLAY=", "WAYLAND_DISPLAY="}) {
            if (text.starts_with(name) && text.size() > name.size()) return true;
        }
    }
    return false;
}

void say_by_hand() {
    std::fprintf(stderr, "no browser could be opened; open the address by hand\n");
}

}  // namespace

void open_browser(const std::string& url, bool secret) {
    if (!has_screen()) return say_by_hand();
    const std::optional<std::string> place = secret ? write_opening_page(url) : url;
    if (!place) return say_by_hand();
    posix_spawn_file_actions_t quiet;
    ::posix_spawn_file_actions_init(&quiet);
    ::posix_spawn_file_actions_addopen(&quiet, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", O_WRONLY, 0);
    // In a separate process group: Ctrl-C ends the engine, not the browser. The engine blocks the signals
    // that it waits for; the browser must not.
    posix_spawnattr_t apart;
    ::posix_spawnattr_init(&apart);
    ::posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    sigset_t none;
    sigemptyset(&none);
    ::posix_spawnattr_setsigmask(&apart, &none);
    std::string program = "xdg-open", argument = *place;
    char* const arguments[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    const int failed = ::posix_spawnp(&child, program.c_str(), &quiet, &apart, arguments, environ);
    ::posix_spawn_file_actions_destroy(&quiet);
    ::posix_spawnattr_destroy(&apart);
    if (failed != 0) return say_by_hand();
    std::thread([child] {
        int status = 0;
        if (::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) != 0)
            say_by_hand();
    }).detach();
}

}  // namespace tribo::app
