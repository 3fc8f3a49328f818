// SPDX-License-Identifier: MIT
#include "app/interrupt.hpp"

#include <cerrno>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include "files/unfinished.hpp"

namespace tribo::app {
namespace {

// How long the run has for an end of its own.
constexpr timespec kPatience{0, 700'000'000};

std::atomic<bool> flag{false};
std::atomic<int> first_signal{0};
sigset_t watched;

void* end_after_signal(void*) {
    int number = 0;
    while (::sigwait(&watched, &number) != 0) {
    }
    first_signal = number;
    flag = true;
    while (::sigtimedwait(&watched, nullptr, &kPatience) < 0 && errno == EINTR) {
    }
    files::remove_unfinished();
    ::_exit(interrupted_exit_code());
}

}  // namespace

void catch_signals() {
    sigemptyset(&watched);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before = {};
        // If the program was started with ignored signals (in the background), it keeps ignoring them.
        if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        sigaddset(&watched, number);
    }
    // Blocked here, they are blocked in all later threads, and no call is broken off by them.
    ::pthread_sigmask(SIG_BLOCK, &watched, nullptr);
    pthread_t thread;
    if (::pthread_create(&thread, nullptr, end_after_signal, nullptr) == 0) {
        ::pthread_detach(thread);
    } else {
        // Where the system gives no thread, a signal ends the run at once.
        ::pthread_sigmask(SIG_UNBLOCK, &watched, nullptr);
    }
    ::signal(SIGPIPE, SIG_IGN);
    ::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& interrupted() {
    return flag;
}

int interrupted_exit_code() {
    return 128 + first_signal;
}

}  // namespace tribo::app
