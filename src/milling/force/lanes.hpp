// SPDX-License-Identifier: MIT
// The four channels of a tool force in vector types of the compiler that every target supports in hardware.
#pragma once

#include "contact/force_spectrum.hpp"

namespace tribo::milling {

using Pair [[gnu::vector_size(16)]] = double;

// Force along x, y, z, N (or N per unit), and torque, N mm. Real-time safe.
struct Lanes {
    Pair xy{}, zt{};

    Lanes() = default;
    Lanes(Pair a, Pair b) : xy(a), zt(b) {}
    Lanes(double x, double y, double z, double torque) : xy{x, y}, zt{z, torque} {}
    explicit Lanes(const contact::ToolForce& f)
        : Lanes(f.force_n.x, f.force_n.y, f.force_n.z, f.torque_nmm) {}

    double operator[](int i) const { return i < 2 ? xy[i] : zt[i - 2]; }
    friend Lanes operator+(Lanes a, Lanes b) { return {a.xy + b.xy, a.zt + b.zt}; }
    friend Lanes operator-(Lanes a, Lanes b) { return {a.xy - b.xy, a.zt - b.zt}; }
    friend Lanes operator*(Lanes a, double s) { return {a.xy * s, a.zt * s}; }
    Lanes& operator+=(Lanes b) { return *this = *this + b; }
    Lanes& operator-=(Lanes b) { return *this = *this - b; }
};

}  // namespace tribo::milling
