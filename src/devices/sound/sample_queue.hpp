// SPDX-License-Identifier: MIT
// Queue of stereo samples from the rendering thread to the playing thread.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <span>

namespace tribo::devices {

// One thread puts, one thread takes. Neither waits. Real-time safe.
class SampleQueue {
  public:
    static constexpr std::size_t kFrames = 4096;

    std::size_t frames() const noexcept {
        return written_.load(std::memory_order_acquire) - read_.load(std::memory_order_acquire);
    }

    // Stores as many frames as fit and returns their number.
    std::size_t put(std::span<const float> interleaved) noexcept {
        const std::size_t written = written_.load(std::memory_order_relaxed);
        const std::size_t room = kFrames - (written - read_.load(std::memory_order_acquire));
        const std::size_t count = std::min(interleaved.size() / 2, room);
        for (std::size_t n = 0; n < 2 * count; ++n) ring_[(2 * written + n) % ring_.size()] = interleaved[n];
        written_.store(written + count, std::memory_order_release);
        return count;
    }

    // Fills the whole buffer, with silence if the queue is empty.
    void take(std::span<float> interleaved) noexcept {
        const std::size_t read = read_.load(std::memory_order_relaxed);
        const std::size_t there = written_.load(std::memory_order_acquire) - read;
        const std::size_t count = std::min(interleaved.size() / 2, there);
        for (std::size_t n = 0; n < 2 * count; ++n) interleaved[n] = ring_[(2 * read + n) % ring_.size()];
        std::fill(interleaved.begin() + static_cast<std::ptrdiff_t>(2 * count), interleaved.end(), 0.0F);
        read_.store(read + count, std::memory_order_release);
    }

  private:
    std::array<float, 2 * kFrames> ring_{};
    std::atomic<std::size_t> written_{0}, read_{0};  // frames since the start
};

}  // namespace tribo::devices
