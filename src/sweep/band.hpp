// SPDX-License-Identifier: MIT
// What many equally likely values say together.
#pragma once

#include <algorithm>
#include <cassert>
#include <span>

namespace tribo::sweep {

// 5 %, 50 % and 95 % of the values are smaller: 9 of 10 lie between `low` and `high`.
struct Band {
    double low = 0, median = 0, high = 0;
};

// Changes the order of the values. There must be some.
inline Band band_of(std::span<double> values) {
    assert(!values.empty());
    const auto at = [&](double below) {
        const auto n = static_cast<std::ptrdiff_t>(below * static_cast<double>(values.size() - 1) + 0.5);
        std::nth_element(values.begin(), values.begin() + n, values.end());
        return values[static_cast<std::size_t>(n)];
    };
    return {at(0.05), at(0.5), at(0.95)};
}

}  // namespace tribo::sweep
