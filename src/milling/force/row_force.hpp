// SPDX-License-Identifier: MIT
// The force of a row of a cut over a turn of the spindle, on the tool, in the tool frame of the row, and its
// thickest chip. Computed once, used by all senses.
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::milling {

struct RowForce {
    ForcePeaks peaks;
    double edge_torque_nmm = 0;       // mean, of the edge coefficient kte alone
    double chip_mm = 0;               // the thickest (milling/engagement/chip.hpp)
    contact::ForceSpectrum spectrum;  // without harmonics if no sink takes rows
};

}  // namespace tribo::milling
