// SPDX-License-Identifier: MIT
// What a run will hold in memory, told from its moves before it starts.
#pragma once

#include <functional>
#include <optional>

#include "session/cut/mill_setup.hpp"

namespace tribo::session {

// Follows the program: the tool at poses along each move marks the cells of a coarse grid that it empties and
// those that keep a piece of its surface. The cells are as large as the field's bricks, or larger where that
// would cost more than kMostTests looks at cells; then bricks are counted by the area. Built in some ten
// milliseconds at most, and asked for any spacing of the grid after that.
class MemoryEstimate {
  public:
    static constexpr double kMostTests = 2e6;

    // `cell_mm`: the spacing at which it is to be good.
    MemoryEstimate(const MillSetup& setup, double cell_mm);

    // All bytes that the session holds at once when it has run: moves, sweeps and field.
    double session_bytes(double cell_mm) const;
    // What field::contour takes besides, its mesh included.
    double mesh_bytes(double cell_mm) const;
    // Vertices of that mesh.
    double vertices(double cell_mm) const;

    // Bricks with nodes of their own, at most, and bricks that are no longer as in the blank.
    double cut_bricks(double cell_mm) const;
    double touched_bricks(double cell_mm) const;

  private:
    Box3 blank_;
    double coarse_mm_ = 1;
    double surface_cells_ = 0, touched_cells_ = 0;
    double moves_ = 0, curved_moves_ = 0;
};

// A run that would take more than it may, and what to do about it.
struct MemoryShortage {
    double need_bytes = 0;
    std::optional<double>
        fitting_cell_mm;     // the finest tried at which it fits; absent: at none below the blank
    double least_bytes = 0;  // at the coarsest tried
};

// `bytes_at` gives all that the run holds at once at a spacing. None where it fits at the setup's own.
std::optional<MemoryShortage> memory_shortage(
    const MillSetup& setup, double budget_bytes,
    const std::function<double(const MemoryEstimate& estimate, double cell_mm)>& bytes_at);

}  // namespace tribo::session
