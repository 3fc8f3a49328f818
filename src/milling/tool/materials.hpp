// SPDX-License-Identifier: MIT
// Library of workpiece materials: published cutting coefficients with source and confidence. Published values
// for one alloy differ by a factor of two and more. Without your own calibration the spread is the error of
// every force.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "milling/tool/coefficients.hpp"

namespace tribo::milling {

enum class Confidence {
    published,    // from a table in a publication
    unconfirmed,  // public code or data without a traceable measurement
    suspect       // published, but at least one value looks wrong
};

struct WorkpieceMaterial {
    std::string name;    // as in a job file
    std::string what;    // alloy, tool, cooling
    std::string source;  // author or title, year, table
    std::string note;    // assumptions made here; may be empty
    Confidence confidence = Confidence::published;
    CuttingCoefficients coefficients;
    // Factors on a force: the band in which the true force lies.
    double spread_low = 0.5, spread_high = 2;
};

// Returns all of them, in the order of the documentation.
std::vector<WorkpieceMaterial> materials();

// Returns the material of this name. The error names the nearest known name.
Result<WorkpieceMaterial> find_material(std::string_view name);

std::string_view name_of(Confidence confidence);

}  // namespace tribo::milling
