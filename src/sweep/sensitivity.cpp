// SPDX-License-Identifier: MIT
#include "sweep/sensitivity.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tribo::sweep {

Sensitivity::Sensitivity(std::size_t inputs) : sums_(inputs) {}

void Sensitivity::add(std::span<const double> block) {
    assert(block.size() == sums_.size() + 2);
    if (std::ranges::any_of(block, [](double result) { return !std::isfinite(result); })) return;
    if (blocks_++ == 0) origin_ = block[0];
    const double a = block[0] - origin_, b = block[1] - origin_;
    sum_ += a + b;
    squares_ += a * a + b * b;
    for (std::size_t n = 0; n < sums_.size(); ++n) {
        const double mixed = block[n + 2] - origin_;
        sums_[n].first += b * (mixed - a);
        sums_[n].total += 0.5 * (a - mixed) * (a - mixed);
    }
}

double Sensitivity::mean() const {
    return blocks_ == 0 ? std::nan("") : origin_ + sum_ / (2 * static_cast<double>(blocks_));
}

double Sensitivity::variance() const {
    if (blocks_ == 0) return std::nan("");
    const double count = 2 * static_cast<double>(blocks_), off = sum_ / count;
    return std::max(0.0, squares_ / count - off * off);
}

std::vector<SobolIndex> Sensitivity::indices() const {
    std::vector<SobolIndex> indices(sums_.size());
    const double all = variance();
    constexpr double kRounding = 1e-24;
    if (!(all > kRounding * mean() * mean())) return indices;
    const double per = 1 / (static_cast<double>(blocks_) * all);
    for (std::size_t n = 0; n < indices.size(); ++n)
        indices[n] = {per * sums_[n].first, per * sums_[n].total};
    return indices;
}

}  // namespace tribo::sweep
