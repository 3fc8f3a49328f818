// SPDX-License-Identifier: MIT
// `tribo press`: the elastic image under a stroke, as frames.
#pragma once

#include <string>

#include "elastic/pressure.hpp"

namespace tribo::app {

struct PressCall {
    std::string material, stroke, out;
    int size_px = 512;
    double radius_mm = 6;
    double fps = 60;
    elastic::ContactShape contact = elastic::ContactShape::area;
    bool heights = false, as_published = false;
    int threads = 0;  // 0: all processors
};

// Returns the exit code.
int press(const PressCall& call);

}  // namespace tribo::app
