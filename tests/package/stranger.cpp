// SPDX-License-Identifier: MIT
// The mean force of a slot, by a program that knows Tribo only as installed: a room and its headers.
#include <cmath>
#include <cstdio>

#include "base/math.hpp"
#include "milling/force/force.hpp"
#include "milling/tool/materials.hpp"

int main() {
    const auto material = tribo::milling::find_material("al7075-t6");
    if (!material) return 2;
    tribo::milling::Cutter cutter;
    cutter.diameter_mm = 12;
    tribo::milling::Engagement slot;
    slot.bands.push_back({0, 2, 0, tribo::math::kPi});
    tribo::milling::ForceModel model(cutter, material->coefficients);
    model.engage(slot, {0.1, 0});
    const auto mean = model.mean().force_n;
    std::printf("%.2f %.2f %.2f N\n", mean.x, mean.y, mean.z);
    // The closed form (docs/printed-model.md has the conventions).
    return std::abs(mean.x + 50.75) < 0.05 && std::abs(mean.y - 111.97) < 0.05 &&
                   std::abs(mean.z + 29.67) < 0.05
               ? 0
               : 1;
}
