// SPDX-License-Identifier: MIT
// Measured frequency responses: displacement over force, as CSV or out of a Universal File.
//
//   CSV                a header frequency_hz,re_mm_per_n,im_mm_per_n and a line per frequency
//   Universal File     dataset 58 as text, or 58b with binary numbers; dataset 164 for the units; others are
//                      passed over (University of Cincinnati SDRL, Universal File Formats)
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"

namespace tribo::readers {

// A unit of a response, with what it is in mm, s and N.
struct ResponseUnit {
    std::string_view name;  // "m/s2/N"
    int derivatives = 0;    // of the displacement: 0 receptance, 1 mobility, 2 accelerance
    double mm_per_n = 1;    // one unit, in mm, mm/s or mm/s2 per N
};
inline constexpr double kPoundForceN = 4.4482216152605, kGravityMmPerS2 = 9806.65;
inline constexpr std::array<ResponseUnit, 12> kResponseUnits{{{"mm/N", 0, 1},
                                                              {"m/N", 0, 1e3},
                                                              {"um/N", 0, 1e-3},
                                                              {"in/lbf", 0, 25.4 / kPoundForceN},
                                                              {"m/s/N", 1, 1e3},
                                                              {"mm/s/N", 1, 1},
                                                              {"in/s/lbf", 1, 25.4 / kPoundForceN},
                                                              {"m/s2/N", 2, 1e3},
                                                              {"mm/s2/N", 2, 1},
                                                              {"g/N", 2, kGravityMmPerS2},
                                                              {"in/s2/lbf", 2, 25.4 / kPoundForceN},
                                                              {"g/lbf", 2, kGravityMmPerS2 / kPoundForceN}}};

struct ResponseOptions {
    std::string source_name{};  // used in messages
    // Of the force, in the axes of the file: chooses among several responses.
    std::optional<Vec3> direction{};
    const ResponseUnit* unit = nullptr;  // in place of what a Universal File says; not for CSV
    std::size_t max_points = 1'000'000;  // more are refused
};

struct FrequencyResponse {
    std::vector<double> frequency_hz;                       // >= 0, rising; at least two
    std::vector<std::complex<double>> receptance_mm_per_n;  // at the same place; finite
    int derivatives = 0;                                    // of the displacement, that were measured
    std::string description;  // what was read: "CSV", "accelerance, dataset 58 ..."
    int line = 0;             // where it begins
    Warnings warnings;
};

// Whether the text may be a response: by the first column of its header, or by the beginning of a dataset.
bool looks_like_response(std::string_view bytes);

// Reads either format, told by the content. Of several responses of a Universal File it takes the driving
// point (response and force at the same place, in the same direction) whose direction is the one of the
// options, else the first driving point, else the only one. Velocity and acceleration are integrated. Each
// assumption is a warning. Linear in the bytes.
Result<FrequencyResponse> read_frequency_response(std::string_view bytes,
                                                  const ResponseOptions& options = {});

}  // namespace tribo::readers
