// SPDX-License-Identifier: MIT
// Which function of a Universal File is the response that is asked for, and in which unit. Private to
// readers/response/.
#pragma once

#include <string>
#include <vector>

#include "readers/response/frequency_response.hpp"
#include "readers/response/universal_file.hpp"

namespace tribo::readers {

struct ChosenResponse {
    const UniversalFunction* function = nullptr;
    ResponseUnit unit;
    double sign = 1;  // -1: sensor and force point against each other
    std::string description;
};

// As read_frequency_response() says. Refuses a file without a frequency response over a force, one of an
// unknown unit, and several responses of which none is a driving point.
Result<ChosenResponse> choose_response(const std::vector<UniversalFunction>& functions,
                                       const ResponseOptions& options, Warnings& warnings);

}  // namespace tribo::readers
