// SPDX-License-Identifier: MIT
#include "devices/servo/duration_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::devices {

// Returns the largest duration in the bucket.
std::uint64_t DurationHistogram::end_of(std::uint32_t bucket) {
    if (bucket < kPerOctave) return bucket;
    const std::uint32_t octave = bucket / kPerOctave;
    return ((std::uint64_t{kPerOctave} + bucket % kPerOctave + 1) << (octave - 1)) - 1;
}

std::uint64_t DurationHistogram::quantile_ns(double q) const {
    const auto wanted = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count())));
    std::uint64_t seen = 0;
    for (std::uint32_t bucket = 0; bucket < counts_.size(); ++bucket) {
        seen += counts_[bucket].load(std::memory_order_relaxed);
        if (seen >= std::max<std::uint64_t>(wanted, 1)) return std::min(end_of(bucket), max_ns());
    }
    return max_ns();
}

std::uint64_t DurationHistogram::count_above(std::uint64_t ns) const {
    std::uint64_t sum = 0;
    for (std::uint32_t bucket = bucket_of(ns) + 1; bucket < counts_.size(); ++bucket)
        sum += counts_[bucket].load(std::memory_order_relaxed);
    return sum;
}

}  // namespace tribo::devices
