// SPDX-License-Identifier: MIT
#include "readers/control/refusals.hpp"

#include <algorithm>

namespace tribo::readers {

bool keep_refusal(std::vector<Error>* refusals, const Error& error) {
    if (refusals == nullptr) return false;
    const bool is_new =
        std::ranges::none_of(*refusals, [&](const Error& other) { return other.cause == error.cause; });
    if (is_new) refusals->push_back(error);
    return refusals->size() < kMostRefusals;
}

const Error* first_refusal(const std::vector<Error>* refusals) {
    return refusals == nullptr || refusals->empty() ? nullptr : &refusals->front();
}

}  // namespace tribo::readers
