// SPDX-License-Identifier: MIT
// Hands things from one thread to one other: the newest state of something, or the use of something. A taker
// never waits.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace tribo {

// The giver owns the items that it posts, except while the taker holds them; the taker reports its progress.
// Both sides are lock-free with one atomic operation per call. Each side calls at any time, from its own
// single thread.
template <class T>
class HandOver {
  public:
    // Giver: posts `item` and returns the item that was not taken yet (null: it was taken).
    T* post(T* item) { return fresh_.exchange(item, std::memory_order_acq_rel); }
    // Giver: returns the progress of the taker. Everything that the taker did with released items before is
    // visible.
    std::uint64_t progress() const { return progress_.load(std::memory_order_acquire); }

    // Taker: returns the newest item since the last call, or null.
    T* take() { return fresh_.exchange(nullptr, std::memory_order_acq_rel); }
    // Taker: reports that it no longer uses anything with a number below this.
    void reached(std::uint64_t number) { progress_.store(number, std::memory_order_release); }

  private:
    std::atomic<T*> fresh_{nullptr};
    std::atomic<std::uint64_t> progress_{0};
};

// The newest state, copied, so that no reader sees a half-written one. There are three copies of T: one for
// the writer, one for the reader, one in transit. Only the writer frees what T owns, when it fills a copy
// again: a servo may read tables that a slower thread rebuilds.
template <class T>
class Snapshot {
  public:
    Snapshot() = default;
    explicit Snapshot(const T& first) : copies_{first, first, first} {}

    // The writer's copy, to be filled. publish() hands it over.
    T& back() noexcept { return copies_[back_]; }
    void publish() noexcept {
        back_ =
            middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
    }
    void publish(const T& value) {
        back() = value;
        publish();
    }

    // Returns the reader's copy, the newest state. Real-time safe.
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

// An object that its owner may take away while another thread uses it from time to time, each time briefly.
template <class T>
class Loan {
  public:
    // Owner: lends this from now on (null: nothing). Returns once the other thread has left the item that was
    // lent before: waits at most for one use.
    void lend(T* item) noexcept {
        item_.store(item);
        while (in_use_.load()) {
        }
    }

    // The other thread: holds the item, if there is one, as long as this object lives. Real-time safe.
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
