// SPDX-License-Identifier: MIT
// A force plugin that misbehaves: it throws at its start at a rate of 666 Hz and to the left of x = 0, and is
// no number above z = 0.
#include <limits>
#include <stdexcept>

#include "devices/force_plugin.h"

extern "C" {
void* tribo_force_open(int /*version*/, double rate_hz) {
    if (rate_hz == 666) throw std::runtime_error("no such rate");
    static int state;
    return &state;
}
void tribo_force_render(void* /*state*/, const tribo_hand* hand, tribo_force* force) {
    if (hand->position_mm[0] < 0) throw std::runtime_error("left");
    force->contact_n[0] = 1;
    if (hand->position_mm[2] > 0) force->contact_n[1] = std::numeric_limits<double>::quiet_NaN();
}
void tribo_force_close(void* /*state*/) {}
}
