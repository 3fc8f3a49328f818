// SPDX-License-Identifier: MIT
// Estimates the memory of a run from its moves, before it starts.
#pragma once

#include <functional>
#include <optional>

#include "session/cut/mill_setup.hpp"

namespace tribo::session {

// Follows the program with the tool over a coarse grid. It marks the cells that become empty and the cells
// that keep a piece of surface. The cells are as large as the bricks of the field. If that needs more than
// kMostTests tests, the cells are larger and the number of bricks follows from the area. The constructor
// takes some tens of milliseconds at most; the functions then accept any spacing of the grid.
class MemoryEstimate {
  public:
    static constexpr double kMostTests = 2e6;

    // `cell_mm`: the spacing for which the estimate is most accurate.
    MemoryEstimate(const MillSetup& setup, double cell_mm);

    // Bytes of the session after the run: blank and fixtures, moves, sweeps and field.
    double session_bytes(double cell_mm) const;
    // Additional bytes of the states that a session keeps to go back to (KeptStates), at most.
    double states_bytes(double cell_mm) const;
    // Additional bytes of field::contour, with its mesh.
    double mesh_bytes(double cell_mm) const;
    // Vertices of that mesh.
    double vertices(double cell_mm) const;

    // Upper limit of bricks with own nodes; bricks that differ from the blank.
    double cut_bricks(double cell_mm) const;
    double touched_bricks(double cell_mm) const;

  private:
    Box3 blank_;
    double coarse_mm_ = 1;
    double surface_cells_ = 0, touched_cells_ = 0;
    double moves_ = 0, curved_moves_ = 0, joined_parts_ = 0, solid_bytes_ = 0;
};

// A run over the memory budget, and a grid with which it fits.
struct MemoryShortage {
    double need_bytes = 0;
    std::optional<double>
        fitting_cell_mm;     // finest tried spacing that fits; absent: no spacing below the blank size fits
    double least_bytes = 0;  // at the coarsest tried spacing
};

// `bytes_at` gives the bytes of the run at a spacing. No value if the run fits at the spacing of the setup.
std::optional<MemoryShortage> memory_shortage(
    const MillSetup& setup, double budget_bytes,
    const std::function<double(const MemoryEstimate& estimate, double cell_mm)>& bytes_at);

}  // namespace tribo::session
