// SPDX-License-Identifier: MIT
// The volume that a cutter with a profile sweeps along one elementary move.
//
// Level moves (straight or along an arc, across the axis) come nearest where the axis does, because the
// profile never hangs back: the distance is that of the profile, exact. On all other moves the least distance
// over the travel is searched for each zone of the cutter (convex_zones.hpp) by branch and bound: with
// |q''| <= bend for the point q as the tool sees it, the distance g(t) = F(q(t)) to a convex zone satisfies
//     g(s) >= g(t) + g'(t) (s - t) - bend (s - t)^2 / 2,
// and two such parabolas bound it between two instants. Ramps and plunges have bend 0. In front of a concave
// arc |q'|^2 times its bend is added. The search ends
// kProvenMm below the surface; beyond it only the side is exact. The cutter ends flat at length_mm at every
// instant: what stands above it stays, for the shank to collide with.
#pragma once

#include <memory>

#include "field/shape/shape.hpp"
#include "milling/tool/convex_zones.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// Largest error of the search at the surface, mm.
inline constexpr double kProvenMm = 1e-5;

std::unique_ptr<field::Shape> make_profile_sweep(std::shared_ptr<const ConvexZones> zones,
                                                 const motion::Move& elementary);

}  // namespace tribo::milling
