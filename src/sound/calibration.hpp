// SPDX-License-Identifier: MIT
// From newtons to pascals to samples: every level of the sound hangs on these four numbers. None of them is
// measured on a machine; they are set so that a cut is about as loud as cuts are, and they are the same for
// every file. Slotting aluminium 7075-T6 2 mm deep with D12, two flutes and 0.1 mm per tooth: harmonics of
// 126 N RMS, 90 dB SPL at 1 m, 18 dB (its peaks 15 dB) below full scale.
#pragma once

namespace tribo::sound {

// Sound pressure at 1 m per newton of a harmonic of the in-plane force. The same at every frequency: what
// table, column and part amplify is not modelled.
inline constexpr double kPascalPerNewton = 0.005;

// RMS sound pressure of the chip noise at 1 m, per mm^3 of material removed in a second (feed x area): the
// scalar of the paper's A2. The slot above at 6000 rpm, 480 mm^3/s: 74 dB SPL, 16 dB under its partials.
inline constexpr double kPascalPerMm3PerS = 2e-4;

// The pressure that is sample value 1: harmonics of the force that add up to 1000 N; a sine that just
// reaches it has 105 dB SPL.
inline constexpr double kFullScalePascal = 5;

// Nearer than this pressure does not grow, where nothing else is asked for (the listener would stand inside
// the machine). In m.
inline constexpr double kReferenceDistance = 1, kLeastReferenceDistance = 0.05;

}  // namespace tribo::sound
