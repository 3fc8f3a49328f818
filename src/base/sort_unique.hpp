// SPDX-License-Identifier: MIT
// Sorts a list and drops what is in it twice.
#pragma once

#include <algorithm>
#include <vector>

namespace tribo {

template <class T>
void sort_unique(std::vector<T>& all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
}

}  // namespace tribo
