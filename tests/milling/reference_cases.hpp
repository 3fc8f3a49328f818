// SPDX-License-Identifier: MIT
// Four cuts whose forces are known from the analytic integrals and from 4,000 slices of the edge at 1,440
// spindle angles.
#pragma once

#include <vector>

#include "force_reference.hpp"

namespace reference {

struct Case {
    const char* name;
    Cut cut;
    // Over the 1,440 angles, N and N m.
    double x[2], y[2], z[2], max_xy, max_torque_nm;
    Vec3 mean;
};

inline std::vector<Case> cases() {
    const milling::CuttingCoefficients t6{767.01, 168.8, 222, 27.7, 26.6, 0.7};
    const milling::CuttingCoefficients hss{951.365, 262.597, 323.33, 11.115, 11.314, 1.105};
    const auto cut = [](const milling::CuttingCoefficients& k, double diameter, int flutes, double depth,
                        double feed, double entry_deg, double exit_deg) {
        Cut c;
        c.cutter.diameter_mm = diameter;
        c.cutter.flutes = flutes;
        c.cutter.helix_deg = 30;
        c.k = k;
        c.engagement.bands.push_back({0, depth, rad(entry_deg), rad(exit_deg)});
        c.feed.across_mm = feed;
        return c;
    };
    return {
        {"V1 slot",
         cut(t6, 12, 2, 2, 0.10, 0, 180),
         {-171.1, 80.0},
         {-48.7, 218.4},
         {-45.7, -3.5},
         225.6,
         1.251,
         {-50.75, 111.97, -29.67}},
        {"V2 half up",
         cut(t6, 12, 4, 5, 0.05, 0, 90),
         {-304.7, -192.3},
         {-89.8, 270.1},
         {-56.9, -16.7},
         362.9,
         1.938,
         {-254.98, 85.95, -38.83}},
        {"V3 half down",
         cut(t6, 12, 4, 5, 0.05, 90, 180),
         {-91.3, 141.4},
         {184.1, 353.6},
         {-56.8, -16.6},
         363.2,
         1.937,
         {43.44, 282.15, -38.83}},
        {"V4 quarter down",
         cut(hss, 19.05, 4, 10, 0.08, 120, 180),
         {18.0, 293.6},
         {17.4, 605.3},
         {-183.5, -3.0},
         660.6,
         5.892,
         {165.89, 296.70, -89.70}},
    };
}

}  // namespace reference
