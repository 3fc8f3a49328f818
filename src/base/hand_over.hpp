// SPDX-License-Identifier: MIT
// The newest of something from one thread to one other, neither of which ever waits.
#pragma once

#include <atomic>
#include <cstdint>

namespace tribo {

// The giver owns what it posts, until the taker has it and again once the taker has let go: the taker counts
// how far it has come. Both sides are lock-free with one atomic operation a call and may call at any time,
// each from its one thread.
template <class T>
class HandOver {
  public:
    // Giver: puts `item` there in place of what was not taken yet, which comes back (null: it was taken).
    T* post(T* item) { return fresh_.exchange(item, std::memory_order_acq_rel); }
    // Giver: how far the taker has come; what it let go of before is visible.
    std::uint64_t progress() const { return progress_.load(std::memory_order_acquire); }

    // Taker: the newest that was posted since it last took something, or null.
    T* take() { return fresh_.exchange(nullptr, std::memory_order_acq_rel); }
    // Taker: everything that the giver numbered below is no longer looked at.
    void reached(std::uint64_t number) { progress_.store(number, std::memory_order_release); }

  private:
    std::atomic<T*> fresh_{nullptr};
    std::atomic<std::uint64_t> progress_{0};
};

}  // namespace tribo
