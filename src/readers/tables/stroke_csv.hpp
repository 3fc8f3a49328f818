// SPDX-License-Identifier: MIT
// Strokes: the motion of a hand or finger over time, as comma-separated text whose header names the columns.
//
//   a probe in space          t_s,x_mm,y_mm,z_mm
//   a finger on a surface     t_s,x_mm,y_mm,force_n
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"

namespace tribo::readers {

struct ProbePoint {
    double t_s = 0;
    Vec3 position_mm;  // stock frame

    bool operator==(const ProbePoint&) const = default;
};

struct FingerPoint {
    double t_s = 0;
    double x_mm = 0, y_mm = 0;
    double force_n = 0;  // into the surface; contact while > 0

    bool operator==(const FingerPoint&) const = default;
};

struct StrokeOptions {
    std::string source_name;              // used in messages
    std::size_t max_points = 10'000'000;  // more are refused
};

// Each function reads its four columns, in any order. Other columns are ignored, so that a trace or a device
// log can be read as a stroke. Blank lines and lines that start with '#' are skipped. Times are >= 0 and
// increase from line to line. Values are linear between two points. At least two points. Linear in the bytes.
Result<std::vector<ProbePoint>> read_probe_stroke(std::string_view bytes, const StrokeOptions& options = {});
Result<std::vector<FingerPoint>> read_finger_stroke(std::string_view bytes,
                                                    const StrokeOptions& options = {});

// Write tables that the readers read back to the same points.
std::string write_probe_stroke(const std::vector<ProbePoint>& points);
std::string write_finger_stroke(const std::vector<FingerPoint>& points);

}  // namespace tribo::readers
