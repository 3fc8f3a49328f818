/* SPDX-License-Identifier: MIT
 * A force of one's own for `tribo feel --source plugin.so`: three C functions that a shared library exports.
 * docs/feel.md has a whole one in ten lines. Lengths in mm, speeds in mm/s, forces in N on the hand, times in s;
 * axes are the stock's.
 */
#ifndef TRIBO_FORCE_PLUGIN_H
#define TRIBO_FORCE_PLUGIN_H

#ifdef __cplusplus
extern "C" {
#endif

/* Rises when a struct or a function below changes its meaning; fields are only ever added at a struct's end. */
#define TRIBO_FORCE_PLUGIN_VERSION 1

/* The hand in this tick, and what Tribo would let it feel. */
struct tribo_hand {
    double now_s, tick_s;         /* since the stroke's start; since the last call */
    double position_mm[3];        /* of the probe */
    double velocity_mm_per_s[3];
    double stylus[3];             /* unit, from the probe's tip to the hand */
    unsigned buttons;             /* a bit each */
    int touching;                 /* the probe touches the part, or the cut is felt */
    double contact_n[3];          /* of the surface and its friction */
    double driven_n[3];           /* of the cut */
};

/* What the hand is to feel. All zero when the function is called. */
struct tribo_force {
    double contact_n[3]; /* of things that the hand presses: kept passive, never gives back more than it took */
    double driven_n[3];  /* of things that move by themselves */
    int touching;        /* something pushes at all */
};

/* Before the first tick, with the version that the caller speaks. A state for the other two; NULL: the version
 * is not understood, or the library cannot start. */
void* tribo_force_open(int version, double rate_hz);
/* Each tick, on the servo's thread: no allocation, lock, file or wait; at most a tenth of tick_s. */
void tribo_force_render(void* state, const struct tribo_hand* hand, struct tribo_force* force);
/* After the last tick. */
void tribo_force_close(void* state);

#ifdef __cplusplus
}
#endif

#endif
