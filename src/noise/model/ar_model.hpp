// SPDX-License-Identifier: MIT
// Auto-regressive (all-pole) models of noise: x[n] = g e[n] - a_1 x[n-1] - ... - a_p x[n-p], e white.
//
// A model is stored as its reflection coefficients k_1 ... k_p (lattice form). It is stable exactly if all
// are inside (-1, 1). With g^2 = product of (1 - k_m^2) its output has a mean square of 1; the level is
// stored separately. Double precision, allocates; for the audio thread only where stated. Sources: Markel and
// Gray 1976, chapters 5 and 6 (step-up, step-down); Itakura 1975, Soong and Juang 1984 (line spectral
// frequencies).
#pragma once

#include <span>
#include <vector>

namespace tribo::noise {

// Largest number of poles in a voice and in a material file.
inline constexpr int kLargestOrder = 128;
// The same at another sample rate (at_rate): what ModelNoise plays.
inline constexpr int kLargestPlayedOrder = 512;
// Larger reflection coefficients decay more slowly than any friction sound (and than float can represent).
inline constexpr double kLargestReflection = 0.999999;

struct ArModel {
    double sample_rate_hz = 48000;
    std::vector<double> reflection;  // each within +-kLargestReflection; empty: white noise

    friend bool operator==(const ArModel&, const ArModel&) = default;
};

// Returns a_1 ... a_p (step-up recursion).
std::vector<double> predictor_of(std::span<const double> reflection);
// The same into `predictor`, of the same length: real-time safe.
void predictor_of(std::span<const double> reflection, std::span<double> predictor);
// The inverse (step-down recursion). A result of absolute value 1 or more means that the predictor is not
// stable. Overwrites `predictor`; real-time safe.
void reflection_of(std::span<double> predictor, std::span<double> reflection);

// g^2 = product of (1 - k^2): the power of the innovation for an output of power 1.
double innovation_power(std::span<const double> reflection);

// Power density g^2 / |A|^2 at `hz`, relative to white noise of the same power. Its mean over 0 ... half the
// rate is 1.
double power_at(const ArModel& model, double hz);

// Autocorrelation r_0 = 1, r_1 ... r_lags of the output.
std::vector<double> autocorrelation_of(std::span<const double> reflection, int lags);

// Angles w_1 < ... < w_p in (0, pi), rad per sample, at which the phase of the all-pass is a multiple of pi:
// alternating roots of A(z) +- z^-(p+1) A(1/z). They are found by bisection of the monotonic phase, so that
// even close roots are not missed.
std::vector<double> line_spectrum_of(std::span<const double> reflection);
// Predictor from ascending angles. `work` has at least 2 (p + 2) numbers. Real-time safe.
void predictor_from_line_spectrum(std::span<const double> angles, std::span<double> predictor,
                                  std::span<double> work);

// Returns a model with the same spectrum in Hz at another sample rate. Below the old half rate the spectrum
// is kept; above it there is almost no power. Poles are spread over the whole band, so a wider band gets more
// of them, in proportion to its width, up to kLargestPlayedOrder. `power`: share of the old power in the new
// band.
ArModel at_rate(const ArModel& model, double sample_rate_hz, double* power = nullptr);

}  // namespace tribo::noise
