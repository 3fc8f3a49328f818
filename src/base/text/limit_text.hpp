// SPDX-License-Identifier: MIT
// What messages say about a number outside its range (base/limits.hpp). Any thread; allocates.
#pragma once

#include <string>

#include "base/limits.hpp"

namespace tribo {

// A number as people write it: 1000000, not 1e+06.
std::string plain_number(double value);

// The cause: "the feed of 1e+300 mm/min is out of range".
std::string out_of_range(const Limit& limit, double value);
// The remedy: "keep the feed within 0.001 to 1000000 mm/min".
std::string range_remedy(const Limit& limit);

}  // namespace tribo
