// SPDX-License-Identifier: MIT
// From one thread to one other: the newest of something, or the use of something. A taker never waits.
#pragma once

#include <array>
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

// The newest state, copied: nobody sees half of anything. Three copies of T: one is the writer's, one the
// reader's, one changes hands. What T owns is freed by the writer alone, when it fills a copy anew: a servo
// may read tables that a slower thread rebuilds.
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

// Something that its owner may take away again while another thread uses it now and then, for a short time.
template <class T>
class Loan {
  public:
    // Owner: from now on this is lent (null: nothing). Comes back once the other thread has left what was
    // lent before: waits as long as one use takes.
    void lend(T* item) noexcept {
        item_.store(item);
        while (in_use_.load()) {
        }
    }

    // The other thread: holds the item, if there is one, as long as this lives. Real-time safe.
    class Use {
      public:
        explicit Use(Loan& loan) noexcept : loan_(loan) {
            loan_.in_use_.store(true);
            item_ = loan_.item_.load();
        }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;
        ~Use() { loan_.in_use_.store(false); }
        T* get() const noexcept { return item_; }

      private:
        Loan& loan_;
        T* item_;
    };

  private:
    std::atomic<T*> item_{nullptr};
    std::atomic<bool> in_use_{false};
};

}  // namespace tribo
