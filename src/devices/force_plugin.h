/* SPDX-License-Identifier: MIT
 * A force source of the user for `tribo feel --source plugin.so`: three C functions exported by a shared library.
 * docs/feel.md has a complete example in ten lines. Lengths in mm, speeds in mm/s, forces on the hand in N, times
 * in s; axes of the stock.
 */
#ifndef TRIBO_FORCE_PLUGIN_H
#define TRIBO_FORCE_PLUGIN_H

#ifdef __cplusplus
extern "C" {
#endif

/* Increases when the meaning of a struct or function changes. New fields are only added at the end of a struct. */
#define TRIBO_FORCE_PLUGIN_VERSION 1

/* The hand in this tick, and the force of Tribo on it. */
struct tribo_hand {
    double now_s, tick_s;         /* since the start of the stroke; since the last call */
    double position_mm[3];        /* of the probe */
    double velocity_mm_per_s[3];
    double stylus[3];             /* unit vector from the tip of the probe to the hand */
    unsigned buttons;             /* one bit each */
    int touching;                 /* the probe touches the part, or a cutting force acts */
    double contact_n[3];          /* of the surface and its friction */
    double driven_n[3];           /* of the cut */
};

/* The force on the hand. All zero when the function is called. */
struct tribo_force {
    double contact_n[3]; /* of objects pressed by the hand; kept passive: returns no more energy than it took */
    double driven_n[3];  /* of objects that move by themselves */
    int touching;        /* nonzero if any object pushes the hand */
};

/* Called before the first tick with the version of the caller. Returns a state for the other two functions, or NULL
 * if the version is not supported or the library cannot start. */
void* tribo_force_open(int version, double rate_hz);
/* Called at each tick on the servo thread: no allocation, lock, file or wait; at most a tenth of tick_s. */
void tribo_force_render(void* state, const struct tribo_hand* hand, struct tribo_force* force);
/* Called after the last tick. */
void tribo_force_close(void* state);

#ifdef __cplusplus
}
#endif

#endif
