// SPDX-License-Identifier: MIT
// The common force record: cutting force over a spindle turn as complex harmonics of the spindle frequency
// (README, "One force spectrum"). The servo sums the harmonics that its rate can carry, sound plays those up
// to Nyquist, plots show the turn.
#pragma once

#include <complex>
#include <limits>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::contact {

// One complex coefficient per channel: force on the tool in the tool's frame (x along the feed, y to its
// left, z to the shank), N, and the torque of the spindle, N mm.
struct ForceHarmonic {
    std::complex<double> x, y, z, torque;
};

// F(theta) = harmonics[0] + 2 Re sum_{n >= 1} harmonics[n] e^{i n order_step theta}. theta is the spindle
// angle in rad: the rotation of the tip of flute 0, clockwise seen from the shank, from the y axis (left of
// the feed).
struct ForceSpectrum {
    int order_step = 1;                    // flutes for uniform pitch without run-out, else 1
    std::vector<ForceHarmonic> harmonics;  // [0] is the mean, real; empty: no contact

    int order(std::size_t n) const { return order_step * static_cast<int>(n); }
    bool empty() const { return harmonics.empty(); }
};

struct ToolForce {
    Vec3 force_n;  // in the tool's frame
    double torque_nmm = 0;
};

inline ToolForce mean_force(const ForceSpectrum& s) {
    if (s.empty()) return {};
    const ForceHarmonic& m = s.harmonics[0];
    return {{m.x.real(), m.y.real(), m.z.real()}, m.torque.real()};
}

// Returns the sum at spindle angle theta over the orders up to `highest_order` (multiples of the spindle
// frequency; a servo passes the highest one that its rate can carry). Real-time safe.
ToolForce evaluate(const ForceSpectrum& spectrum, double theta_rad,
                   int highest_order = std::numeric_limits<int>::max());

}  // namespace tribo::contact
