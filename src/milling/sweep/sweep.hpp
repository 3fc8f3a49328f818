// SPDX-License-Identifier: MIT
// The volume that a cutter sweeps along one elementary move, with its exact surface.
#pragma once

#include <memory>
#include <span>

#include "field/shape/shape.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// Returns the sweep of one elementary move. The cutting part is a cylinder of the cutter's radius from the
// tip up to `length_mm`, rounded at the bottom by its corner radius, with a flat top. The surface of the
// sweep is exact, to rounding, for
//   - straight moves with one axis, in any direction to it (flat and ball in closed form; a ramping
//     bull-nose cutter, and above the top of any cutter, by the search below), and
//   - arcs of at most half a turn about a line parallel to the axis, without rise.
// If tip or axis runs along a quadratic, or if the axis turns, the nearest instant is found by search (on a
// piece of a helix, for flat and ball, by the zero of a convex function: upright_curve.hpp). The error at the
// surface is at most 0.1 um for pieces as motion::to_elementary cuts them, up to 30 degrees of turn and 10 mm
// of travel. The search itself is proven to 0.01 um (sweep_search.inl); the rest is the error of the
// quadratic that approximates an even turn. A cutter with a profile (profile_sweep.hpp) is the union of its
// convex zones; the error includes 0.03 um of tangents in place of a hollow arc. Other moves are not
// elementary; do not pass them here.
std::unique_ptr<field::Shape> make_sweep(const Cutter& cutter, const motion::Move& elementary);

// Returns the union of the sweeps of moves that join (joined_moves.hpp), at least one: each begins where the
// one before it ends, and all go nearly the same way. A field stores, prunes and asks one shape in place of
// many.
std::unique_ptr<field::Shape> make_sweep(const Cutter& cutter, std::span<const motion::Move* const> moves);

}  // namespace tribo::milling
