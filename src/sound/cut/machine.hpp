// SPDX-License-Identifier: MIT
// Machines by name: their radiation of a cutting force, and the sound of their spindle.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "sound/cut/body.hpp"

namespace tribo::sound {

// A tone at `order` times the spindle speed. Order 1 is the imbalance; integer orders are motor and gear
// teeth; other orders are the balls of the bearings. `level` is relative to the other lines.
struct SpindleLine {
    double order = 0;  // 0: none
    double level = 0;  // of the amplitude
};

// Sound of a turning spindle: lines that follow its speed, and pink noise through the fixed broad resonances
// of its housing. The RMS pressure at 1 m is pa (speed / rpm)^exponent, up to four times rpm.
struct SpindleSound {
    static constexpr std::size_t kLines = 8;
    double pa = 0, rpm = 6000, exponent = 1;
    double tonal = 0.3;  // share of the power in lines, 0 ... 1
    std::array<SpindleLine, kLines> lines{};
    Body housing{};
};

struct Machine {
    std::string_view name = "none", what = "force and vibration alone";
    Body radiation{};        // of a force times kPascalPerNewton
    double tool_gain = 1;    // gain of the modes of the tool
    double sound_share = 0;  // share of the cutting power that becomes noise, through `radiation`
    SpindleSound spindle{};
};

// "none" comes first. The radiation of "mill" is fitted to measured third octaves of end milling in steel on
// a vertical machining centre (docs/sound.md). All other levels and spectra are typical, not measured.
std::span<const Machine> machines();
}  // namespace tribo::sound
