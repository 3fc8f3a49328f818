// SPDX-License-Identifier: MIT
// The properties of a friction sound beyond coloured Gaussian noise: slow variation of the band levels along
// the path (weave, holes, a patchy surface), and single grains under the finger. Both are functions of
// distance, so they are faster if the finger is faster. Plain data.
#pragma once

#include <vector>

namespace tribo::noise {

// Grains: impulses that excite the resonances of the material.
struct GrainModel {
    double per_mm = 0;   // mean count per millimetre; 0: none
    double share = 0;    // of the power at the learned speed, 0 ... 1
    double scatter = 1;  // of the distances between grains: deviation over mean, 0 (even) ... 1 (random)
    // Amplitudes, signed, ascending; all are equally frequent.
    std::vector<double> sizes;
    // Contribution of a grain of size 1 to the driving noise, per sample at the rate of the model; sum of
    // squares 1.
    std::vector<double> shape;

    friend bool operator==(const GrainModel&, const GrainModel&) = default;
};

// A level process: Gaussian numbers g with a given correlation over distance, mapped to dB by a table.
struct TextureModel {
    // Limits between neighbouring bands; ascending, below half the sample rate of the model. There is one
    // band more than limits.
    std::vector<double> crossovers_hz;
    // For each band the level in dB at g = -4, -3.5 ... 4, linear between. The mean power over g is 1.
    std::vector<std::vector<double>> levels_db;
    // Share of g that all bands have in common, 0 ... 1. The rest is independent in each band.
    double coherence = 1;
    // g is a sum of processes. Each has exponential memory over one of these lengths, and a share of the
    // variance (sum of shares 1).
    std::vector<double> lengths_mm, weights;
    GrainModel grains;

    friend bool operator==(const TextureModel&, const TextureModel&) = default;
};

inline constexpr int kMostBands = 8;
inline constexpr int kMostLengths = 4;
inline constexpr int kLevelSteps = 17;    // entries of a table
inline constexpr double kLevelReach = 4;  // g runs from -4 to 4
inline constexpr int kMostGrainSizes = 65;
inline constexpr int kLongestGrain = 64;  // samples

// Shifts each table so that its mean power over a Gaussian g is 1.
void normalize(TextureModel& texture);

}  // namespace tribo::noise
