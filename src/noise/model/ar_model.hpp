// SPDX-License-Identifier: MIT
// Auto-regressive (all-pole) models of noise: x[n] = g e[n] - a_1 x[n-1] - ... - a_p x[n-p], e white.
//
// A model is kept as its reflection coefficients k_1 ... k_p (the lattice form): it is stable exactly when
// all lie inside (-1, 1), and with g^2 = product of (1 - k_m^2) its output has a mean square of 1. Level is
// kept apart. Double precision, allocates; not for the audio thread but where said. Source: Markel and Gray
// 1976, chapters 5 and 6 (step-up, step-down); Itakura 1975, Soong and Juang 1984 (line spectral
// frequencies).
#pragma once

#include <span>
#include <vector>

namespace tribo::noise {

// The most poles that a voice plays and a material file holds.
inline constexpr int kLargestOrder = 128;
// Reflection coefficients beyond this size ring for longer than any friction does (and than float carries).
inline constexpr double kLargestReflection = 0.999999;

struct ArModel {
    double sample_rate_hz = 48000;
    std::vector<double> reflection;  // each within +-kLargestReflection; none: white

    friend bool operator==(const ArModel&, const ArModel&) = default;
};

// a_1 ... a_p (step-up recursion).
std::vector<double> predictor_of(std::span<const double> reflection);
// The same into `predictor`, of the same length: real-time safe.
void predictor_of(std::span<const double> reflection, std::span<double> predictor);
// Back again (step-down recursion); a size of 1 or more means that the predictor is not stable. The span is
// used up: real-time safe.
void reflection_of(std::span<double> predictor, std::span<double> reflection);

// g^2 = product of (1 - k^2): the power of the innovation where the output's is 1.
double innovation_power(std::span<const double> reflection);

// Power density g^2 / |A|^2 at `hz`, relative to white noise of the same power: its mean over 0 ... half the
// rate is 1.
double power_at(const ArModel& model, double hz);

// Autocorrelation r_0 = 1, r_1 ... r_lags of the output.
std::vector<double> autocorrelation_of(std::span<const double> reflection, int lags);

// Angles w_1 < ... < w_p in (0, pi), rad per sample, at which the model's all-pass turns by whole multiples
// of pi: roots of A(z) +- z^-(p+1) A(1/z) by turns. Found by bisection of the phase, which is monotonic: none
// is missed however close two are.
std::vector<double> line_spectrum_of(std::span<const double> reflection);
// Predictor from ascending angles; `work` holds at least 2 (p + 2) numbers. Real-time safe.
void predictor_from_line_spectrum(std::span<const double> angles, std::span<double> predictor,
                                  std::span<double> work);

// The same spectrum in Hz at another sample rate, with as many poles. Below the old half rate it is kept;
// above it there is next to nothing. `power`: how much of the old power lies in the new band.
ArModel at_rate(const ArModel& model, double sample_rate_hz, double* power = nullptr);

}  // namespace tribo::noise
