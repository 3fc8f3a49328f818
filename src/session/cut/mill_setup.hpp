// SPDX-License-Identifier: MIT
// Makes a runnable setup from a loaded job: tools, moves, speeds, times and stock.
#pragma once

#include <cstdint>

#include "job/loader.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/program.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

struct MillOptions {
    std::optional<double> cell_mm;  // absent: default_cell_mm()
    std::optional<double> until_s;
    // Largest length of a move; longer moves are split, for a view of the part in between. Absent: no limit.
    std::optional<double> longest_piece_mm{};
    // Memory for the moves, bytes; 0: only the limit of every program, readers::kMostMoves.
    std::uint64_t memory_bytes = 0;
};

// Default grid spacing: 1/400 of the longest edge of the blank, but at most 1/4 of the smallest cutter
// radius and 1/3 of the thickness of the blank, within 0.02 mm to 1 mm.
double default_cell_mm(const job::LoadedJob& loaded, const Box3& blank_mm);

// The material of the job: from the library, or with coefficients and spread of the job file.
Result<milling::WorkpieceMaterial> job_material(const job::Job& job);

// The part of prepare_mill() that needs no stock: moves, cutters, speeds and times, without a grid
// spacing and without modes.
Result<MillSetup> prepare_moves(const job::Job& job, const motion::Program& program,
                                const MillOptions& options, Warnings& warnings);

// Refuses a job that cannot run (no spindle speed, a tool without a match, rotary words without a machine,
// too many moves after they are split), with the line of the program, and everything that stock_of() refuses.
// Assumptions are added to `warnings`.
Result<MillSetup> prepare_mill(const job::LoadedJob& loaded, const MillOptions& options, Warnings& warnings);

}  // namespace tribo::session
