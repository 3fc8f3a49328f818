// SPDX-License-Identifier: MIT
// Limits of the motors of an arm.
#pragma once

#include <span>
#include <string_view>

namespace tribo::haptics {

struct DeviceLimits {
    std::string_view name;              // for display
    double max_force_n = 0;             // peak, at the nominal position
    double max_stiffness_n_per_mm = 0;  // stable in a closed loop at 1 kHz
    double max_damping_n_s_per_mm = 0;  // the same
    double resolution_mm = 0;           // of its positions
    double scale = 1;                   // millimetres of these per millimetre of the hand
};

// The same for positions that are so many times those of the hand. A force stays as it is, so that a spring
// of the stock is so many times as stiff to the hand.
DeviceLimits scaled(DeviceLimits of_hand, double scale);

// Arms by name. Force, stiffness and damping are those of CHAI3D 3.3.0 (the specifications in its files
// CPhantomDevice, CDeltaDevices and CHaplyDevice), converted from N/m and N s/m. Resolutions are from the
// data sheets. The force of the Inverse3 is the clamp of NVIDIA's Isaac Lab, below the value of the
// manufacturer.
//
// Returns the entry whose name is contained in `model` (case is ignored). An unknown model gets the limits of
// the weakest arm.
const DeviceLimits& limits_of(std::string_view model);

// Limits of simulated arms. They have no motors; the limits only keep the values reasonable.
inline constexpr DeviceLimits kSimulatedLimits{"simulated", 20, 5, 0.03, 0},
    kPlaybackLimits{"playback", 20, 5, 0.03, 0};

}  // namespace tribo::haptics
