// SPDX-License-Identifier: MIT
// The volume that a cutter sweeps along one elementary move, with its exact surface.
#pragma once

#include <memory>

#include "field/shape/shape.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// The cutting part is a cylinder of the cutter's radius, rounded at the bottom by its corner radius, from the
// tip up to `length_mm` (a flat cap, exact for moves across the axis). The surface of the sweep is exact, to
// rounding, for
//   - straight moves with one axis, in any direction to it (flat and ball in closed form; a ramping bull-nose
//     cutter by the same search), and
//   - arcs of at most half a turn about a line parallel to the axis, without rise.
// For pieces whose tip or axis runs along a quadratic, or whose axis turns, the nearest instant is found by
// search, to 0.1 um at the surface for pieces as motion::to_elementary cuts them, up to 30 degrees of turn
// and 10 mm of travel. The search itself is proven to 0.01 um (sweep_search.inl); the rest is for the
// quadratic that stands for an even turn. The cap of a curved sweep is the highest that the tool's top comes.
// Other moves are not elementary and must not come here.
std::unique_ptr<field::Shape> make_sweep(const Cutter& cutter, const motion::Move& elementary);

}  // namespace tribo::milling
