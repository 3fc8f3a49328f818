// SPDX-License-Identifier: MIT
#include "app/exit.hpp"

#include <algorithm>
#include <cstdio>

namespace tribo::app {

int report(const Error& error) {
    std::fprintf(stderr, "%s\n", error.text().c_str());
    return kWrongInput;
}

int report(const FileFailure& failure) {
    report(static_cast<const Error&>(failure));
    return failure.fault == FileFault::system ? kRefused : kWrongInput;
}

void report(const Warnings& warnings, std::size_t most) {
    for (std::size_t i = 0; i < std::min(most, warnings.size()); ++i) {
        std::fprintf(stderr, "%s\n", warnings[i].message().c_str());
    }
    if (warnings.size() > most) std::fprintf(stderr, "and %zu more warnings\n", warnings.size() - most);
}

}  // namespace tribo::app
