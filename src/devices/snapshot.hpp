// SPDX-License-Identifier: MIT
// The newest state from one thread to another without a lock: the writer never waits, the reader never waits,
// and nobody sees half of anything.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace tribo::devices {

// Three copies of T: one is the writer's, one the reader's, one changes hands. What T owns is freed by the
// writer alone, when it fills a copy anew: a servo may read tables that a slower thread rebuilds.
template <class T>
class Snapshot {
  public:
    Snapshot() = default;
    explicit Snapshot(const T& first) : copies_{first, first, first} {}

    // The writer's copy, to be filled; publish() hands it over.
    T& back() noexcept { return copies_[back_]; }
    void publish() noexcept {
        back_ =
            middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
    }
    void publish(const T& value) {
        back() = value;
        publish();
    }

    // The reader's copy, the newest there is. Real-time safe.
    const T& read() noexcept {
        if (middle_.load(std::memory_order_relaxed) & kFresh)
            front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
        return copies_[front_];
    }

  private:
    static constexpr std::uint8_t kIndex = 3, kFresh = 4;
    std::array<T, 3> copies_{};
    std::uint8_t back_ = 0, front_ = 2;
    std::atomic<std::uint8_t> middle_{1};
};

}  // namespace tribo::devices
