// SPDX-License-Identifier: MIT
// The volume that a cutter sweeps along several moves, one after the other, as one shape.
#pragma once

#include <memory>
#include <vector>

#include "field/shape/shape.hpp"

namespace tribo::milling {

// Returns the union of sweeps of any kind, at least one.
std::unique_ptr<field::Shape> join_sweeps(std::vector<std::unique_ptr<const field::Shape>> sweeps);

}  // namespace tribo::milling
