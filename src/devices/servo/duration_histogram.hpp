// SPDX-License-Identifier: MIT
// Histogram of tick durations, from 1 ns to 15 minutes, with a bucket width of at most 1/64 of the duration.
// One thread records (real-time safe); any thread may read at the same time.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>

namespace tribo::devices {

class DurationHistogram {
  public:
    void record(std::uint64_t ns) noexcept {
        auto& bucket = counts_[bucket_of(ns)];
        bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        count_.store(count_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        if (ns > max_.load(std::memory_order_relaxed)) max_.store(ns, std::memory_order_relaxed);
    }
    std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
    std::uint64_t max_ns() const { return max_.load(std::memory_order_relaxed); }
    // The quantile `q` (0..1), rounded up to the end of its bucket.
    std::uint64_t quantile_ns(double q) const;
    // Number of durations above `ns`, to within a bucket.
    std::uint64_t count_above(std::uint64_t ns) const;

  private:
    // One bucket per nanosecond below 64 ns; 64 buckets per octave above.
    static constexpr int kBits = 6;
    static constexpr std::uint32_t kPerOctave = 1U << kBits;
    static constexpr int kOctaves = 34;
    static std::uint32_t bucket_of(std::uint64_t ns) {
        if (ns < kPerOctave) return static_cast<std::uint32_t>(ns);
        const auto octave = static_cast<int>(std::bit_width(ns)) - kBits;  // >= 1
        if (octave > kOctaves) return kOctaves * kPerOctave + kPerOctave - 1;
        return static_cast<std::uint32_t>(octave) * kPerOctave +
               static_cast<std::uint32_t>((ns >> (octave - 1)) - kPerOctave);
    }
    static std::uint64_t end_of(std::uint32_t bucket);

    std::array<std::atomic<std::uint64_t>, (kOctaves + 1) * kPerOctave> counts_{};
    std::atomic<std::uint64_t> count_{0}, max_{0};
};

}  // namespace tribo::devices
