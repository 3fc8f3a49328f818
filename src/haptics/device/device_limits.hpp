// SPDX-License-Identifier: MIT
// What an arm's motors can and may do.
#pragma once

#include <span>
#include <string_view>

namespace tribo::haptics {

struct DeviceLimits {
    std::string_view name;              // as it is shown
    double max_force_n = 0;             // peak, at the nominal position
    double max_stiffness_n_per_mm = 0;  // that stays stable in a closed loop at 1 kHz
    double max_damping_n_s_per_mm = 0;  // the same
    double resolution_mm = 0;           // of its positions
};

// Arms by name. Force, stiffness and damping as CHAI3D 3.3.0 states them for its own device classes (the
// specifications in its files CPhantomDevice, CDeltaDevices and CHaplyDevice), converted from N/m and N s/m;
// resolutions as the makers' data sheets have them;
// the Inverse3's force is the clamp that NVIDIA's Isaac Lab uses for it, below the maker's figure.
std::span<const DeviceLimits> known_devices();

// The entry whose name stands in `model` (any case); for an unknown model the weakest arm of the table, so
// that nothing is driven harder than it may be. Never null.
const DeviceLimits& limits_of(std::string_view model);

// The simulated arms: no motors, so only the numbers are kept sane.
inline constexpr DeviceLimits kSimulatedLimits{"simulated", 20, 5, 0.03, 0};

}  // namespace tribo::haptics
