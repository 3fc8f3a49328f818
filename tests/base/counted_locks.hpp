// SPDX-License-Identifier: MIT
// Counts the mutexes that a test program locks. Defines pthread_mutex_lock: one source of a program includes
// it, after base/counted_allocations.hpp.
#pragma once

#include <atomic>
#include <dlfcn.h>
#include <pthread.h>

namespace tribo::test {
inline std::atomic<long> locks{0};
}

#ifndef TRIBO_NOT_COUNTED
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
    using Lock = int (*)(pthread_mutex_t*);
    static const Lock real = reinterpret_cast<Lock>(::dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    ++tribo::test::locks;
    return real(mutex);
}
#endif
