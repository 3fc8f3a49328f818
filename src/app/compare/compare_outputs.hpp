// SPDX-License-Identifier: MIT
// What `tribo compare` writes and prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/compare/compared_run.hpp"
#include "session/compare/compared_rows.hpp"
#include "surface/part_difference.hpp"

namespace tribo::app {

// True for the names of all files that a comparison may write.
bool is_compare_file(const std::string& name);

struct PartComparison {
    surface::VolumeDifference volumes;
    surface::SurfaceDifference surfaces;
    std::optional<report::ReportPart> a, b;  // for the page, coloured by the difference
};

struct Comparison {
    ComparedRun a, b;
    session::JoinedCuts cuts;
    std::optional<PartComparison> parts;  // absent: a part is not known
    std::vector<std::string> set_up;      // what differs of stock, cutters and moves, in sentences
};

// Measures the difference of both parts, if both are known.
std::optional<PartComparison> compare_parts(const ComparedRun& a, const ComparedRun& b,
                                            const ParallelFor& parallel);
// What the records of both runs say of their stock, cutters and moves.
std::vector<std::string> compare_set_up(const ComparedRun& a, const ComparedRun& b);

std::string compare_json(const Comparison& comparison);
std::string compare_csv(const Comparison& comparison);
// Takes the parts out of the comparison.
std::string compare_html(Comparison& comparison);
// For people.
void print(const Comparison& comparison);

}  // namespace tribo::app
