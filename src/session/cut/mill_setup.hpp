// SPDX-License-Identifier: MIT
// From a loaded job to a setup that can run: which tool cuts where, how fast, in which pieces, out of what.
#pragma once

#include "job/loader.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/program.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

struct MillOptions {
    std::optional<double> cell_mm;  // absent: default_cell_mm()
    std::optional<double> until_s;
    // Moves are cut into pieces of at most this length, for who wants to see the part in between; absent: as
    // long as they are.
    std::optional<double> longest_piece_mm{};
};

// The grid that shows a blank well at little cost: a four-hundredth of its longest edge, but at least four
// cells across the smallest cutter's radius, within 0.02 mm to 1 mm.
double default_cell_mm(const job::Job& job, const Box3& blank_mm);

// The material of the job: from the library, or its own coefficients with no spread but their own.
Result<milling::WorkpieceMaterial> job_material(const job::Job& job);

// The part of prepare_mill() that needs no stock: moves, cutters, speeds and times. Without a grid.
Result<MillSetup> prepare_moves(const job::Job& job, const motion::Program& program,
                                const MillOptions& options, Warnings& warnings);

// Refuses what cannot run (no spindle speed, a tool without a match, rotary words without a machine), with
// the program's line, and what stock_of() refuses; `warnings` gains what was assumed.
Result<MillSetup> prepare_mill(const job::LoadedJob& loaded, const MillOptions& options, Warnings& warnings);

}  // namespace tribo::session
