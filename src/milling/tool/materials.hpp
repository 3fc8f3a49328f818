// SPDX-License-Identifier: MIT
// The library of materials: published cutting coefficients, each with where it comes from and how far to
// trust it. Published values for one alloy differ by a factor of two and more, so without a calibration of
// one's own no force is known better than the spread says.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "milling/tool/coefficients.hpp"

namespace tribo::milling {

enum class Confidence {
    published,    // read in a publication's table
    unconfirmed,  // public code or data without a traceable measurement
    suspect       // printed so, but at least one value looks wrong
};

struct Material {
    std::string name;    // what a job file says
    std::string what;    // alloy, tool, cooling
    std::string source;  // author or title, year, table
    std::string note;    // assumptions made here; may be empty
    Confidence confidence = Confidence::published;
    CuttingCoefficients coefficients;
    // Multiply a force by these for the band in which it may really lie.
    double spread_low = 0.5, spread_high = 2;
};

// All of them, in the order of the documentation.
std::vector<Material> materials();

// The material of that name; otherwise an error that names the nearest one.
Result<Material> find_material(std::string_view name);

std::string_view name_of(Confidence confidence);

}  // namespace tribo::milling
