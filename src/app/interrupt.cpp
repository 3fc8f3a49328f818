// SPDX-License-Identifier: MIT
#include "app/interrupt.hpp"

#include <signal.h>

namespace tribo::app {
namespace {

std::atomic<bool> flag{false};
std::atomic<int> signal_number{SIGINT};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "only lock-free atomics may be touched in a signal handler");

void raise_flag(int number) {
    signal_number = number;
    flag = true;
}

}  // namespace

void catch_signals() {
    struct sigaction action = {};
    action.sa_handler = raise_flag;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before = {};
        // If the program was started with ignored signals (in the background), it keeps ignoring them.
        if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        ::sigaction(number, &action, nullptr);
    }
    ::signal(SIGPIPE, SIG_IGN);
    ::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& interrupted() {
    return flag;
}

int interrupted_exit_code() {
    return 128 + signal_number;
}

}  // namespace tribo::app
