// SPDX-License-Identifier: MIT
// OpenVDB doing the same straight cuts: the difference of narrow-band level sets (Museth 2013), 3 voxels to
// either side.
#pragma once

#include <optional>

#include "cuts.hpp"

namespace tribo::bench {

bool has_openvdb();

struct PeerCarving {
    double us_per_mm = 0;     // median over passes after the first, making the sweeps' level sets included
    double bytes_per_mm = 0;  // growth of the stock's grid
};

// On one thread. Straight moves of a flat cutter across its axis only. Nothing where OpenVDB is not
// installed.
std::optional<PeerCarving> openvdb_carve(const Cuts& cuts, double cell_mm);

}  // namespace tribo::bench
