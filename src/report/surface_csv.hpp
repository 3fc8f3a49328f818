// SPDX-License-Identifier: MIT
// surface.csv: what the teeth of a vibrating tool left on the part (docs/results.md).
#pragma once

#include <string>

#include "surface/form_error.hpp"

namespace tribo::report {

// The names of the columns and a line end.
std::string surface_csv_header();

// Appends a line for each mark of a trace. Decimals: time, positions and errors 6, normal 4.
void append_surface_rows(std::string& csv, const surface::ToothTrace& trace,
                         const surface::ToothTraces& traces);

}  // namespace tribo::report
