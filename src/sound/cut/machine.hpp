// SPDX-License-Identifier: MIT
// Machines by name: what becomes of a cutting force before it is heard, and what the spindle sounds like on
// its own.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "sound/cut/body.hpp"

namespace tribo::sound {

// A tone that stands at `order` times the spindle's speed: 1 its imbalance, whole multiples motor and teeth
// of gears, others the balls of its bearings. `level` counts against the other lines.
struct SpindleLine {
    double order = 0;  // 0: none
    double level = 0;  // of the amplitude
};

// A spindle that turns: lines that follow its speed, and pink noise through the broad resonances of its
// housing, which stay where they are. RMS pressure at 1 m is pa (speed / rpm)^exponent, up to
// four times that speed.
struct SpindleSound {
    static constexpr std::size_t kLines = 8;
    double pa = 0, rpm = 6000, exponent = 1;
    double tonal = 0.3;  // share of the power that is lines, 0 ... 1
    std::array<SpindleLine, kLines> lines{};
    Body housing{};
};

struct Machine {
    std::string_view name = "none", what = "force and vibration alone";
    Body radiation{};        // of a force times kPascalPerNewton
    double tool_gain = 1;    // of the tool's own modes
    double sound_share = 0;  // of the cutting power that leaves as noise, through `radiation`
    SpindleSound spindle{};
};

// "none" comes first. Levels and spectra are set by what such machines are known for; of "mill" the radiation
// is fitted to third octaves of end milling in steel on a vertical machining centre (docs/sound.md), the rest
// is not measured.
std::span<const Machine> machines();
}  // namespace tribo::sound
