// SPDX-License-Identifier: MIT
// Sizes that a text names by a number or a letter: twist drills (ASME B94.11M), threads by number (ASME
// B1.1), threads of pipes (ISO 228-1, ASME B1.20.1). Any thread.
#pragma once

#include <array>

namespace tribo::readers {

inline constexpr int kGauges = 60;

// Diameter of the drill of a wire gauge, 1 to kGauges, in inches.
constexpr double gauge_drill_in(int gauge) {
    constexpr std::array<double, kGauges> inches{
        0.2280, 0.2210, 0.2130, 0.2090, 0.2055, 0.2040, 0.2010, 0.1990, 0.1960, 0.1935, 0.1910, 0.1890,
        0.1850, 0.1820, 0.1800, 0.1770, 0.1730, 0.1695, 0.1660, 0.1610, 0.1590, 0.1570, 0.1540, 0.1520,
        0.1495, 0.1470, 0.1440, 0.1405, 0.1360, 0.1285, 0.1200, 0.1160, 0.1130, 0.1110, 0.1100, 0.1065,
        0.1040, 0.1015, 0.0995, 0.0980, 0.0960, 0.0935, 0.0890, 0.0860, 0.0820, 0.0810, 0.0785, 0.0760,
        0.0730, 0.0700, 0.0670, 0.0635, 0.0595, 0.0550, 0.0520, 0.0465, 0.0430, 0.0420, 0.0410, 0.0400};
    return inches[static_cast<std::size_t>(gauge - 1)];
}

// The same of a letter, A to Z.
constexpr double letter_drill_in(char letter) {
    constexpr std::array<double, 26> inches{0.2340, 0.2380, 0.2420, 0.2460, 0.2500, 0.2570, 0.2610,
                                            0.2660, 0.2720, 0.2770, 0.2810, 0.2900, 0.2950, 0.3020,
                                            0.3160, 0.3230, 0.3320, 0.3390, 0.3480, 0.3580, 0.3680,
                                            0.3770, 0.3860, 0.3970, 0.4040, 0.4130};
    return inches[static_cast<std::size_t>(letter - 'A')];
}

// Outside diameter of a thread by number, 0 to kLargestThread, in inches.
inline constexpr double kLargestThread = 14;
constexpr double numbered_thread_in(double number) {
    return (60 + 13 * number) / 1000;
}

// The same of a pipe's thread by its nominal size; 0: none of 1/8 to 1 inch.
constexpr double pipe_thread_mm(double nominal_in, bool is_taper) {
    struct Pipe {
        double inch, parallel_mm, taper_mm;
    };
    constexpr std::array pipes{Pipe{0.125, 9.728, 10.287},  Pipe{0.25, 13.157, 13.716},
                               Pipe{0.375, 16.662, 17.145}, Pipe{0.5, 20.955, 21.336},
                               Pipe{0.75, 26.441, 26.670},  Pipe{1, 33.249, 33.401}};
    for (const Pipe& pipe : pipes) {
        if (nominal_in == pipe.inch) return is_taper ? pipe.taper_mm : pipe.parallel_mm;
    }
    return 0;
}

}  // namespace tribo::readers
