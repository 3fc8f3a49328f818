// SPDX-License-Identifier: MIT
// What a friction sound is beyond coloured Gaussian noise: how the level of its bands wanders along the way
// (weave, holes, a patchy surface), and single grains that the finger runs over. Both are tied to distance,
// so they come faster as the finger moves faster. Plain data.
#pragma once

#include <vector>

namespace tribo::noise {

// Grains: impulses that excite the material's resonances.
struct GrainModel {
    double per_mm = 0;   // mean count on a millimetre of way; 0: none
    double share = 0;    // of the power at the learned speed, 0 ... 1
    double scatter = 1;  // of the distances between grains: deviation over mean, 0 (even) ... 1 (at random)
    // Amplitudes, signed, ascending; each comes as often as another.
    std::vector<double> sizes;
    // What a grain of size 1 adds to the driving noise, sample by sample at the model's rate; sum of
    // squares 1.
    std::vector<double> shape;

    friend bool operator==(const GrainModel&, const GrainModel&) = default;
};

// A level process: Gaussian numbers g of given correlation over distance, led through a table into dB.
struct TextureModel {
    // Where neighbouring bands part; ascending, below half the model's sample rate. n of them make n + 1
    // bands.
    std::vector<double> crossovers_hz;
    // For each band the level in dB at g = -4, -3.5 ... 4, linear between. The mean power over g is 1.
    std::vector<std::vector<double>> levels_db;
    // Share of g that all bands have in common, 0 ... 1; the rest is each band's own.
    double coherence = 1;
    // g is the sum of processes that forget exponentially over these distances, with these shares of the
    // variance (sum 1).
    std::vector<double> lengths_mm, weights;
    GrainModel grains;

    friend bool operator==(const TextureModel&, const TextureModel&) = default;
};

inline constexpr int kMostBands = 8;
inline constexpr int kMostLengths = 4;
inline constexpr int kLevelSteps = 17;    // of a table
inline constexpr double kLevelReach = 4;  // g runs from -4 to 4
inline constexpr int kMostGrainSizes = 65;
inline constexpr int kLongestGrain = 64;  // samples

// Shifts every table so that the mean power over a Gaussian g is 1.
void normalize(TextureModel& texture);

}  // namespace tribo::noise
