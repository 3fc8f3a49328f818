// SPDX-License-Identifier: MIT
// Facts about a file in two forms: JSON for programs, aligned lines for people.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/mode_fit.hpp"
#include "job/job.hpp"
#include "material/material.hpp"
#include "motion/path/program.hpp"
#include "motion/path/summary.hpp"
#include "readers/mesh/model.hpp"
#include "readers/response/frequency_response.hpp"

namespace tribo::report {

struct Facts {
    std::string json;                                        // one object, "schema" and "kind" first
    std::vector<std::pair<std::string, std::string>> lines;  // name and text
    Warnings warnings;                                       // the same as in the JSON
};

// {kind: "program", moves, path_mm, rapid_mm, bounds_mm, tools, rotary, warnings, ...} of a program whose
// moves went through `meter`.
Facts describe(const motion::Program& program, const motion::ProgramMeter& meter, job::PathKind format,
               double rapid_mm_per_min = 10000);
// {kind: "model", triangles, area_mm2, bounds_mm, closed, pieces, holes, warnings, ...}
Facts describe(const readers::Model& model);
// {kind: "job", ...}. Facts of the named files are under "program" and "part". `moves`: the moves of its
// program, for {passes: {share, sidestep_mm, scallop_mm}} if its only cutter has parallel passes.
Facts describe(const job::Job& job, const Facts* program, const Facts* part,
               std::span<const motion::Move> moves = {});

// {kind: "material", stiffness_n_per_mm, viscosity_n_s_per_mm, width_mm, image, voices: [{speed_mm_per_s,
// ...}], ...}
Facts describe(const material::Material& material);

// {kind: "frequency response", what, points, band_hz, modes: [...], residual, warnings}. `warnings`: of
// reading and fitting. Without a fit the list of modes is empty, and its error is one of the warnings.
Facts describe(const readers::FrequencyResponse& response, const Result<dynamics::ModeFit>& fit,
               const Warnings& warnings);

// Returns the lines as text, with names padded to one width.
std::string aligned(const std::vector<std::pair<std::string, std::string>>& lines);

}  // namespace tribo::report
