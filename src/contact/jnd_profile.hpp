// SPDX-License-Identifier: MIT
// Just noticeable differences (JND) of a person. They set the sampling of all perceptual tables.
// Weber fractions are differences relative to the value. Values below a floor count as the floor.
#pragma once

namespace tribo::contact {

struct JndProfile {
    // Size of a steady force, 2.5 to 10 N: about 7 % (Pang, Tan and Durlach 1991).
    double force_magnitude = 0.07;
    // Direction of a force with congruent vision: 18.4 degrees, rad; 25.6 by touch alone (Barbagli,
    // Salisbury, Ho, Spence and Tan 2006).
    double force_direction_rad = 18.4 * 0.017453292519943295;
    // Amplitude of a vibration: 0.20 at 125 Hz, where it is finest (Forta, Morioka and Griffin).
    double vibration_amplitude = 0.20;
    // Frequency of a vibration: 0.18 to 0.25 at the fingertip (Israr and Tan 2006).
    double vibration_frequency = 0.18;
    // Level of a sound: about 0.5 dB for noise and loud tones (Handbook for Sound Engineers, chapter 3).
    double sound_level_db = 0.5;
    // Pitch: a Weber fraction of 0.002 from 500 to 2000 Hz (Roederer).
    double pitch = 0.002;

    // Floors at the hand. Chosen, not measured: the smallest force that desktop arms render above their own
    // friction, and a fifth of it for
    // vibrations.
    double force_floor_n = 0.05;
    double vibration_floor_n = 0.01;
};

}  // namespace tribo::contact
