// SPDX-License-Identifier: MIT
// Calibration from newtons to pascals to samples. All levels depend on these constants, which are the same
// for every file. They are not measured on a machine; they give typical levels of cuts. Example: a slot 2 mm
// deep in aluminium 7075-T6 with D12, two flutes and 0.1 mm per tooth. Its harmonics of 126 N RMS give 90 dB
// SPL at 1 m, 18 dB (peaks 15 dB) below full scale.
#pragma once

namespace tribo::sound {

// Sound pressure at 1 m per newton of a harmonic of the in-plane force, without the resonances of a machine
// (machine.hpp).
inline constexpr double kPascalPerNewton = 0.005;

// RMS sound pressure at 1 m of a thousand chips of 1 mm^3 a second (chip_noise.hpp): the scalar of the
// paper's A2. The slot above at 6000 rpm, 200 chips of 2.4 mm^3 a second: 76 dB SPL.
inline constexpr double kChipPascal = 0.15;

// Share of the cutting power that becomes sound: 1e-6 for quiet machines to 1e-4 for loud ones. 3.6 kW in
// steel give 1.1 Pa at 1 m, 95 dB SPL.
inline constexpr double kSoundShare = 1e-5;
// Impedance of air, N s/m^3: a source of W watts makes sqrt(W kAirImpedance / (4 pi)) Pa at 1 m.
inline constexpr double kAirImpedance = 413;

// Pressure of sample value 1: harmonics of the force with a sum of 1000 N. A sine of this amplitude has 105
// dB SPL.
inline constexpr double kFullScalePascal = 5;

// Default reference distance in m: a nearer source gets no louder (the listener would be inside the machine).
inline constexpr double kReferenceDistance = 1, kLeastReferenceDistance = 0.05;

}  // namespace tribo::sound
