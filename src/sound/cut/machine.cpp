// SPDX-License-Identifier: MIT
#include "sound/cut/machine.hpp"

#include "sound/play/calibration.hpp"

namespace tribo::sound {
namespace {

// Nothing radiates much that is small against the wave (the ends of each set), large plates do in broad
// humps.
constexpr Body body(double direct, std::array<BodyMode, Body::kModes> modes) {
    return {direct, modes};
}

// Ball bearings of spindles have about 20 balls: their cage passes at 0.42, outer and inner race at 8.4 and
// 11.6 orders (from the geometry: Harris, Rolling Bearing Analysis, "ball pass frequencies").
constexpr double kCage = 0.42, kOuterRace = 8.4, kInnerRace = 11.6;

const Machine kMachines[] = {
    {},
    {.name = "mill",
     .what = "vertical machining centre",
     .radiation = body(0, {{{60, 0.5, -0.107},
                            {410, 0.3, 0.181},
                            {750, 0.25, 0.155},
                            {1120, 0.25, 0.059},
                            {1600, 0.4, 0.203},
                            {6000, 0.35, -0.128}}}),
     .tool_gain = 0.2,
     .sound_share = kSoundShare,
     .spindle =
         {.pa = 0.05,
          .rpm = 6000,
          .exponent = 1.2,
          .tonal = 0.25,
          .lines =
              {{{1, 1}, {2, 0.5}, {4, 0.6}, {8, 0.3}, {kOuterRace, 0.35}, {kInnerRace, 0.25}, {24, 0.2}}},
          .housing = body(0, {{{120, 0.5, 0.8}, {320, 0.3, -1}, {900, 0.4, 0.6}, {2600, 0.5, -0.35}}})}},
    {.name = "high-speed",
     .what = "motor spindle in a closed cabin, up to 40,000 rpm",
     .radiation = body(0, {{{180, 0.5, -0.05},
                            {700, 0.3, 0.08},
                            {1500, 0.3, 0.09},
                            {2900, 0.3, -0.14},
                            {5200, 0.3, 0.12},
                            {9000, 0.4, -0.06}}}),
     .tool_gain = 0.12,
     .sound_share = 0.5 * kSoundShare,
     .spindle =
         {.pa = 0.06,
          .rpm = 24000,
          .exponent = 1.5,
          .tonal = 0.6,
          .lines =
              {{{1, 0.6}, {2, 1}, {4, 0.8}, {6, 0.3}, {kCage, 0.1}, {kOuterRace, 0.3}, {kInnerRace, 0.2}}},
          .housing = body(0, {{{400, 0.4, 0.5}, {1800, 0.3, 1}, {4200, 0.3, -0.8}}})}},
    {.name = "router",
     .what = "hobby gantry with a brushed trim router",
     .radiation = body(0, {{{140, 0.4, -0.1},
                            {300, 0.2, 0.2},
                            {620, 0.25, 0.16},
                            {1500, 0.35, -0.14},
                            {3600, 0.4, 0.16},
                            {8000, 0.4, -0.08}}}),
     .tool_gain = 0.16,
     .sound_share = 3 * kSoundShare,
     // A fan of nine blades, a commutator of 22 bars.
     .spindle = {.pa = 0.3,
                 .rpm = 20000,
                 .exponent = 2,
                 .tonal = 0.35,
                 .lines = {{{1, 1}, {2, 0.4}, {3, 0.2}, {9, 0.8}, {18, 0.3}, {22, 0.5}}},
                 .housing = body(0, {{{500, 0.5, 0.4}, {2200, 0.4, 1}, {5500, 0.4, -0.9}}})}},
    {.name = "knee-mill",
     .what = "manual knee mill with belts and gears",
     .radiation = body(0, {{{90, 0.4, -0.08},
                            {260, 0.25, 0.12},
                            {560, 0.25, 0.13},
                            {950, 0.25, -0.13},
                            {2200, 0.4, 0.09},
                            {5000, 0.4, -0.06}}}),
     .tool_gain = 0.13,
     .sound_share = 1.5 * kSoundShare,
     // Gears of 27 teeth, and a belt that runs slower than the spindle.
     .spindle =
         {.pa = 0.09,
          .rpm = 2000,
          .exponent = 0.8,
          .tonal = 0.5,
          .lines = {{{0.31, 0.5}, {0.62, 0.4}, {1, 0.7}, {2, 0.3}, {27, 1}, {54, 0.5}, {26, 0.2}, {28, 0.2}}},
          .housing = body(0, {{{100, 0.3, 1}, {420, 0.3, -0.9}, {1300, 0.4, 0.4}}})}},
};

}  // namespace

std::span<const Machine> machines() {
    return kMachines;
}

}  // namespace tribo::sound
