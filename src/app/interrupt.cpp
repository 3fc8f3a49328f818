// SPDX-License-Identifier: MIT
#include "app/interrupt.hpp"

#include <cerrno>
#include <ctime>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <unistd.h>

#include "files/unfinished.hpp"

namespace tribo::app {
namespace {

// How long the run has for an end of its own.
constexpr long kPatienceNs = 700'000'000;
constexpr long kNsPerS = 1'000'000'000;

std::atomic<bool> flag{false};
std::atomic<int> first_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "only lock-free atomics may be touched in a signal handler");
sem_t signals;

void raise_flag(int number) {
    const int error_number = errno;
    int none = 0;
    first_signal.compare_exchange_strong(none, number);
    flag = true;
    ::sem_post(&signals);
    errno = error_number;
}

void* end_after_signal(void*) {
    while (::sem_wait(&signals) != 0) {
    }
    timespec until = {};
    ::clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += kPatienceNs;
    until.tv_sec += until.tv_nsec / kNsPerS;
    until.tv_nsec %= kNsPerS;
    while (::sem_clockwait(&signals, CLOCK_MONOTONIC, &until) != 0 && errno == EINTR) {
    }
    files::remove_unfinished();
    ::_exit(interrupted_exit_code());
}

}  // namespace

void catch_signals() {
    ::sem_init(&signals, 0, 0);
    pthread_t thread;
    // Where the system gives no thread, the flag alone ends the run.
    if (::pthread_create(&thread, nullptr, end_after_signal, nullptr) == 0) ::pthread_detach(thread);
    struct sigaction action = {};
    action.sa_handler = raise_flag;
    // A read that a signal breaks off would be reported as a fault of the file.
    action.sa_flags = SA_RESTART;
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
    return 128 + first_signal;
}

}  // namespace tribo::app
