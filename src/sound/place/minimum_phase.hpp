// SPDX-License-Identifier: MIT
// Splits a head response into a short minimum-phase filter and a delay. Nothing else of the response is
// audible (Kulkarni, Isabelle, Colburn 1999).
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "sound/place/ear_kernels.hpp"

namespace tribo::sound {

// Discrete Fourier transform of 2^log2_size values, in place; the inverse divides by the size. The same bits
// on every machine.
class FourierTransform {
  public:
    explicit FourierTransform(int log2_size);
    std::size_t size() const { return reversed_.size(); }
    void forward(std::span<std::complex<double>> x) const;
    void inverse(std::span<std::complex<double>> x) const;

  private:
    // Of the angle 2 pi k / (2 half), at [half + k]: one row behind the other for each size of butterflies.
    std::vector<double> cosine_, sine_;
    std::vector<std::size_t> reversed_;
};

// Weights of the values at -1, 0, 1 and 2 for the cubic through them at 0 <= t <= 1.
std::array<double, 4> cubic_weights(double t);

using HeadTaps = std::array<float, kHeadTaps>;

// The responses of both ears to one direction.
struct EarResponses {
    std::array<HeadTaps, 2> taps{};       // left, right
    std::array<double, 2> delay_s{0, 0};  // in addition to the filter; may be negative
};

// Spectra have the bins of the transform below, from 0 to half the sample rate.
class MinimumPhase {
  public:
    explicit MinimumPhase(double sample_rate_hz);

    std::size_t bins() const { return fourier_.size() / 2 + 1; }
    double bin_hz() const { return sample_rate_hz_ / static_cast<double>(fourier_.size()); }

    // Makes a filter from the magnitude of each spectrum (bins() values, any phase). Filters are cut to
    // kHeadTaps; their total level and their level at 1 kHz are kept. The delay is the lag of the spectrum
    // behind its filter from 300 to 1500 Hz, where ears compare phases. Both delays together keep the
    // interaural delay: the peak of the cross-correlation of the ears in this band.
    EarResponses split(std::span<const std::complex<double>> left,
                       std::span<const std::complex<double>> right);
    // The filters alone.
    std::array<HeadTaps, 2> filters(std::span<const std::complex<double>> left,
                                    std::span<const std::complex<double>> right);

  private:
    using Taps = std::array<double, kHeadTaps>;
    std::array<Taps, 2> shorten(std::span<const std::complex<double>> left,
                                std::span<const std::complex<double>> right);
    static std::array<HeadTaps, 2> rounded(const std::array<Taps, 2>& taps);
    std::complex<double> response(const Taps& taps, double hz) const;
    void keep_level(std::span<const std::complex<double>> spectrum, Taps& taps) const;
    double delay_behind(std::span<const std::complex<double>> spectrum, const Taps& taps) const;
    void keep_arrival_offset(std::span<const std::complex<double>> left,
                             std::span<const std::complex<double>> right, const std::array<Taps, 2>& taps,
                             std::array<double, 2>& delay_s) const;
    std::size_t first_compared() const;
    std::size_t last_compared() const;

    double sample_rate_hz_;
    FourierTransform fourier_;
    std::vector<std::complex<double>> work_;
    // The ring that puts the level right: its fall, its wave, and its transform at its frequency and beyond.
    Taps ring_fall_{}, ring_cosine_{}, ring_sine_{};
    double ring_sum_ = 0;
    std::complex<double> ring_mirror_;
};

}  // namespace tribo::sound
