// SPDX-License-Identifier: MIT
#include "haptics/device/device_limits.hpp"

#include <algorithm>
#include <array>

namespace tribo::haptics {
namespace {

// Longer names before those that they contain.
constexpr std::array kDevices{
    DeviceLimits{"PHANToM Premium 3.0", 22, 1, 0.005, 0.02},
    DeviceLimits{"PHANToM Premium", 8.5, 0.8, 0.005, 0.03},
    DeviceLimits{"PHANToM Desktop", 7.9, 1, 0.005, 0.023},
    DeviceLimits{"PHANToM Omni", 3.3, 0.7, 0.005, 0.055},
    DeviceLimits{"Touch", 3.3, 0.4, 0.004, 0.055},
    DeviceLimits{"delta.3", 20, 5, 0.03, 0.01},
    DeviceLimits{"omega", 12, 5, 0.03, 0.01},
    DeviceLimits{"sigma.7", 12, 4, 0.03, 0.0015},
    DeviceLimits{"Falcon", 8, 3, 0.02, 0.06},
    DeviceLimits{"Inverse3", 2, 0.4, 0.002, 0.01},
    DeviceLimits{"Pantograph", 5, 0.3, 0.002, 0.01},
    kSimulatedLimits,
};

constexpr char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

const DeviceLimits& limits_of(std::string_view model) {
    for (const DeviceLimits& device : kDevices) {
        if (!std::ranges::search(model, device.name, {}, lower, lower).empty()) return device;
    }
    return *std::ranges::min_element(kDevices, {}, &DeviceLimits::max_force_n);
}

DeviceLimits scaled(DeviceLimits of_hand, double scale) {
    of_hand.max_stiffness_n_per_mm /= scale;
    of_hand.max_damping_n_s_per_mm /= scale;
    of_hand.resolution_mm *= scale;
    of_hand.scale *= scale;
    return of_hand;
}

}  // namespace tribo::haptics
