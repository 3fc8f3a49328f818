// SPDX-License-Identifier: MIT
// OpenVDB doing the same straight cuts: the difference of narrow-band level sets (Museth 2013), 3 voxels to
// either side.
#pragma once

#include <optional>

#include "cuts.hpp"

namespace tribo::bench {

bool has_openvdb();

// Time per mm of cut, median over the passes after the first, making the sweeps' level sets included. No
// memory figure: this grid holds the blank's surface from the start, which the cuts then take away, so its
// growth says nothing.
// On one thread. Straight moves of a flat cutter across its axis only. Nothing where OpenVDB is not
// installed.
std::optional<double> openvdb_us_per_mm(const Cuts& cuts, double cell_mm);

}  // namespace tribo::bench
