/* SPDX-License-Identifier: MIT
 * The part as it is, and a magnet at (40, 30, 5) that pulls the hand within 10 mm. */
#include "devices/force_plugin.h"
static int state;
void* tribo_force_open(int version, double rate_hz) { return version == 1 && rate_hz > 0 ? &state : 0; }
void tribo_force_close(void* s) { (void)s; }
void tribo_force_render(void* s, const struct tribo_hand* hand, struct tribo_force* force) {
    const double magnet[3] = {40, 30, 5};
    double way[3], square = 0;
    for (int i = 0; i < 3; ++i) way[i] = magnet[i] - hand->position_mm[i];
    for (int i = 0; i < 3; ++i) square += way[i] * way[i];
    for (int i = 0; i < 3; ++i) force->driven_n[i] = hand->driven_n[i] + (square < 100 ? 0.1 * way[i] : 0);
    for (int i = 0; i < 3; ++i) force->contact_n[i] = hand->contact_n[i];
    force->touching = hand->touching;
    (void)s;
}
