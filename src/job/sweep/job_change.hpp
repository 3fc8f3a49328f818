// SPDX-License-Identifier: MIT
// A key of a job with another value than its file gives it. Plain data; any thread.
#pragma once

#include <string>
#include <variant>

namespace tribo::job {

struct JobChange {
    // Dotted, as in "process.spindle_rpm"; a number counts tables and elements of arrays from 1, as in
    // "cutter.2.diameter_mm" and "stock.box_mm.1.3". Of a single table the number may be left out.
    std::string key;
    std::variant<double, std::string, bool> value;
};

}  // namespace tribo::job
