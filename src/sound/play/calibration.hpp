// SPDX-License-Identifier: MIT
// From newtons to pascals to samples: every level of the sound hangs on these numbers. None of them is
// measured on a machine; they are set so that a cut is about as loud as cuts are, and they are the same for
// every file. Slotting aluminium 7075-T6 2 mm deep with D12, two flutes and 0.1 mm per tooth: harmonics of
// 126 N RMS, 90 dB SPL at 1 m, 18 dB (its peaks 15 dB) below full scale.
#pragma once

namespace tribo::sound {

// Sound pressure at 1 m per newton of a harmonic of the in-plane force, where no machine stands between
// (machine.hpp: what table, column and part make of it).
inline constexpr double kPascalPerNewton = 0.005;

// RMS sound pressure at 1 m of a thousand chips of 1 mm^3 a second (chip_noise.hpp): the scalar of the
// paper's A2. The slot above at 6000 rpm, 200 chips of 2.4 mm^3 a second: 76 dB SPL.
inline constexpr double kChipPascal = 0.15;

// Share of the cutting power that leaves a machine as sound: between a millionth of quiet ones and a ten
// thousandth of loud ones. 3.6 kW in steel make 1.1 Pa at 1 m, 95 dB SPL.
inline constexpr double kSoundShare = 1e-5;
// Impedance of air, N s/m^3: a source of W watts makes sqrt(W kAirImpedance / (4 pi)) Pa at 1 m.
inline constexpr double kAirImpedance = 413;

// The pressure that is sample value 1: harmonics of the force that add up to 1000 N; a sine that just
// reaches it has 105 dB SPL.
inline constexpr double kFullScalePascal = 5;

// Nearer than this pressure does not grow, where nothing else is asked for (the listener would stand inside
// the machine). In m.
inline constexpr double kReferenceDistance = 1, kLeastReferenceDistance = 0.05;

}  // namespace tribo::sound
