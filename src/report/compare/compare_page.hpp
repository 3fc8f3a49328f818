// SPDX-License-Identifier: MIT
// compare.html: one file that opens offline and shows two runs, A and B, side by side: totals with their
// differences, both parts coloured by the distance between them, values along the cut, and both sounds. Views
// and plots share a camera and a place in the program. Text and script are in page/.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"
#include "report/html_parts.hpp"
#include "report/report_html.hpp"
#include "report/report_part.hpp"

namespace tribo::report {

struct ComparedTotal {
    std::string name, unit;        // unit: may be empty
    std::optional<double> a, b;    // absent: not known
    std::string place_a, place_b;  // of the value; may be empty
};

// A run at one place of the cut. A value of NaN is not known.
struct ComparedMoment {
    double t_s = 0;
    int line = 0;
    Vec3 tip_mm;
    std::vector<double> values;  // one per lane
};

struct ComparedStep {
    double at = 0, width = 0;  // along the common axis
    std::optional<ComparedMoment> a, b;
};

struct ComparedLane {
    std::string name, unit;
};

struct ComparedSide {
    std::string name, what;          // file; kind of run, tool, material
    std::string picture_png;         // bytes of a PNG; empty: no part
    std::optional<ReportPart> part;  // coloured by the difference
    std::optional<ReportSound> sound;
};

struct ComparePage {
    std::string version, verdict;  // the latter a sentence or two
    ComparedSide a, b;
    std::vector<std::string> notices;     // other set-ups, missing files
    std::vector<std::string> part_facts;  // sentences about the difference of the parts
    std::vector<std::string> warnings;
    std::vector<ComparedTotal> totals;
    std::vector<ComparedLane> lanes;
    std::vector<ComparedStep> steps;  // in the order of the axis
    std::string axis;                 // "time of A, s"
    std::string joined;               // a sentence: how the two cuts are joined
    std::vector<HtmlTable> tables;
};

// Joins neighbouring steps until there are at most `most`: a value is then the largest of its steps, the
// place that of the largest value of the first lane.
std::vector<ComparedStep> thin_steps(std::vector<ComparedStep> steps, std::size_t most);

// Returns the whole page.
std::string compare_page(const ComparePage& page);

}  // namespace tribo::report
