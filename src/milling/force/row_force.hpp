// SPDX-License-Identifier: MIT
// The force of a row of a cut over a turn of the spindle, on the tool, in the row's tool frame, and its
// thickest chip: worked out once, and shown by every sense.
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::milling {

struct RowForce {
    ForcePeaks peaks;
    double edge_torque_nmm = 0;       // mean, of the edge coefficient kte alone
    double chip_mm = 0;               // the thickest (milling/engagement/chip.hpp)
    contact::ForceSpectrum spectrum;  // without harmonics where no sink takes rows
};

}  // namespace tribo::milling
