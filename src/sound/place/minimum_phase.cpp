// SPDX-License-Identifier: MIT
#include "sound/place/minimum_phase.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "sound/place/complex.hpp"

namespace tribo::sound {
namespace {

// Notches deeper than this below the loudest frequency are filled: their logarithm would ring.
constexpr double kDeepestNotch = 1e-4;
// The last taps fade out over this many.
constexpr int kFadeTaps = 24;
// Levels are compared at this frequency, and put right by a ring that falls to 1/e in so many taps.
constexpr double kLevelHz = 1000, kRingTaps = 24;

Complex conjugate(Complex a) {
    return {a.real(), -a.imag()};
}

// A product of one spectrum and the other's conjugate, at an angular frequency.
struct Cross {
    double w;
    Complex c;
};

// What two spectra have in common when one is shifted by t against the other.
double alike(const std::vector<Cross>& cross, double t) {
    double sum = 0;
    for (const auto& [w, c] : cross) {
        double sine, cosine;
        math::sincos(w * t, sine, cosine);
        sum += c.real() * cosine + c.imag() * sine;
    }
    return sum;
}

// The peak that is reached from t uphill, within 10 ns.
double peak_near(const std::vector<Cross>& cross, double t) {
    double best = alike(cross, t);
    for (double step = 32e-6; step > 1e-8;) {
        const double before = alike(cross, t - step), after = alike(cross, t + step);
        if (best < before || best < after) {
            t += before > after ? -step : step;
            best = std::max(before, after);
        } else {
            step /= 2;
        }
    }
    return t;
}

}  // namespace

std::array<double, 4> cubic_weights(double t) {
    return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
            (t + 1) * t * (t - 1) / 6};
}

FourierTransform::FourierTransform(int log2_size) {
    assert(log2_size >= 1 && log2_size <= 20);
    const std::size_t size = std::size_t{1} << log2_size;
    cosine_.resize(size);
    sine_.resize(size);
    reversed_.assign(size, 0);
    for (std::size_t half = 1; half < size; half *= 2) {
        for (std::size_t k = 0; k < half; ++k) {
            const double turn = math::kTwoPi * static_cast<double>(k) / static_cast<double>(2 * half);
            math::sincos(turn, sine_[half + k], cosine_[half + k]);
        }
    }
    for (std::size_t k = 0; k < size; ++k) {
        for (int b = 0; b < log2_size; ++b) reversed_[k] |= (k >> b & 1) << (log2_size - 1 - b);
    }
}

void FourierTransform::forward(std::span<Complex> x) const {
    assert(x.size() == size());
    // Real and imaginary parts apart: several butterflies at once.
    std::vector<double> re(size()), im(size());
    for (std::size_t k = 0; k < size(); ++k) {
        re[k] = x[reversed_[k]].real();
        im[k] = x[reversed_[k]].imag();
    }
    for (std::size_t half = 1; half < size(); half *= 2) {
        const double* cosine = cosine_.data() + half;
        const double* sine = sine_.data() + half;
        for (std::size_t block = 0; block < size(); block += 2 * half) {
            double *re_a = re.data() + block, *re_b = re_a + half;
            double *im_a = im.data() + block, *im_b = im_a + half;
            for (std::size_t k = 0; k < half; ++k) {
                const double re_turned = cosine[k] * re_b[k] + sine[k] * im_b[k];
                const double im_turned = cosine[k] * im_b[k] - sine[k] * re_b[k];
                re_b[k] = re_a[k] - re_turned;
                im_b[k] = im_a[k] - im_turned;
                re_a[k] += re_turned;
                im_a[k] += im_turned;
            }
        }
    }
    for (std::size_t k = 0; k < size(); ++k) x[k] = {re[k], im[k]};
}

void FourierTransform::inverse(std::span<Complex> x) const {
    const double scale = 1 / static_cast<double>(size());
    for (Complex& v : x) v = {v.real(), -v.imag()};
    forward(x);
    for (Complex& v : x) v = {scale * v.real(), -scale * v.imag()};
}

// Bins of 23 Hz at 48 kHz, and as fine at any rate.
MinimumPhase::MinimumPhase(double sample_rate_hz)
    : sample_rate_hz_(sample_rate_hz),
      fourier_(sample_rate_hz > 96000   ? 13
               : sample_rate_hz > 48000 ? 12
                                        : 11) {
    work_.resize(fourier_.size());
    for (std::size_t k = 0; k < kHeadTaps; ++k) {
        ring_sum_ += ring_fall_[k] = math::exp(-static_cast<double>(k) / kRingTaps);
        math::sincos(math::kTwoPi * kLevelHz / sample_rate_hz_ * static_cast<double>(k), ring_sine_[k],
                     ring_cosine_[k]);
    }
    ring_mirror_ = response(ring_fall_, 2 * kLevelHz);
}

// By the cepstrum (Oppenheim and Schafer, Discrete-Time Signal Processing, section 13.3): the logarithm of
// the magnitude is the real part of the logarithm of a causal, invertible response; its negative times fold
// onto the positive ones. Left and right go as real and imaginary part through every transform.
std::array<MinimumPhase::Taps, 2> MinimumPhase::shorten(std::span<const Complex> left,
                                                        std::span<const Complex> right) {
    assert(left.size() == bins() && right.size() == bins());
    const std::size_t n = fourier_.size(), half = n / 2;
    double loudest[2] = {1e-300, 1e-300};
    for (std::size_t k = 0; k <= half; ++k) {
        loudest[0] = std::max(loudest[0], squared(left[k]));
        loudest[1] = std::max(loudest[1], squared(right[k]));
    }
    const auto level = [&](Complex v, double most) {
        return 0.5 * math::log(std::max(squared(v), kDeepestNotch * kDeepestNotch * most));
    };
    for (std::size_t k = 0; k <= half; ++k) {
        work_[k] = {level(left[k], loudest[0]), level(right[k], loudest[1])};
        if (k > 0 && k < half) work_[n - k] = work_[k];
    }
    fourier_.inverse(work_);
    for (std::size_t k = 1; k < half; ++k) work_[k] = {2 * work_[k].real(), 2 * work_[k].imag()};
    for (std::size_t k = half + 1; k < n; ++k) work_[k] = 0;
    fourier_.forward(work_);

    // Back from the logarithms, ear by ear, and as one transform again.
    for (std::size_t k = 0; k <= half; ++k) {
        const Complex a = work_[k], b = work_[k == 0 ? 0 : n - k];
        const Complex log_left{0.5 * (a.real() + b.real()), 0.5 * (a.imag() - b.imag())};
        const Complex log_right{0.5 * (a.imag() + b.imag()), 0.5 * (b.real() - a.real())};
        Complex h[2];
        for (int ear = 0; ear < 2; ++ear) {
            const Complex l = ear == 0 ? log_left : log_right;
            double sine, cosine;
            math::sincos(l.imag(), sine, cosine);
            const double size = math::exp(l.real());
            h[ear] = {size * cosine, size * sine};
        }
        work_[k] = {h[0].real() - h[1].imag(), h[0].imag() + h[1].real()};
        if (k > 0 && k < half) work_[n - k] = {h[0].real() + h[1].imag(), h[1].real() - h[0].imag()};
    }
    fourier_.inverse(work_);

    std::array<Taps, 2> both;
    for (std::size_t ear = 0; ear < 2; ++ear) {
        const auto spectrum = ear == 0 ? left : right;
        double whole = 0, kept = 0;
        Taps& taps = both[ear];
        for (std::size_t k = 0; k < n; ++k) {
            const double v = ear == 0 ? work_[k].real() : work_[k].imag();
            whole += v * v;
            if (k >= kHeadTaps) continue;
            const double after = static_cast<double>(k) - (kHeadTaps - kFadeTaps);
            taps[k] = after <= 0 ? v : v * (0.5 + 0.5 * math::cos(math::kPi * after / kFadeTaps));
            kept += taps[k] * taps[k];
        }
        // What was cut off is missing in the level; each correction disturbs the other a little.
        for (int round = 0; round < 3 && kept > 0; ++round) {
            const double gain = std::sqrt(whole / kept);
            for (double& v : taps) v *= gain;
            keep_level(spectrum, taps);
            kept = 0;
            for (const double v : taps) kept += v * v;
        }
    }
    return both;
}

std::array<HeadTaps, 2> MinimumPhase::filters(std::span<const Complex> left, std::span<const Complex> right) {
    return rounded(shorten(left, right));
}

EarResponses MinimumPhase::split(std::span<const Complex> left, std::span<const Complex> right) {
    const std::array<Taps, 2> taps = shorten(left, right);
    EarResponses out{rounded(taps), {delay_behind(left, taps[0]), delay_behind(right, taps[1])}};
    keep_arrival_offset(left, right, taps, out.delay_s);
    return out;
}

std::array<HeadTaps, 2> MinimumPhase::rounded(const std::array<Taps, 2>& taps) {
    std::array<HeadTaps, 2> out;
    for (std::size_t ear = 0; ear < 2; ++ear) {
        for (std::size_t k = 0; k < kHeadTaps; ++k) out[ear][k] = static_cast<float>(taps[ear][k]);
    }
    return out;
}

Complex MinimumPhase::response(const Taps& taps, double hz) const {
    double sine, cosine;
    math::sincos(math::kTwoPi * hz / sample_rate_hz_, sine, cosine);
    const Complex turn{cosine, -sine};
    Complex sum = 0;
    for (std::size_t k = kHeadTaps; k-- > 0;) sum = product(sum, turn) + taps[k];
    return sum;
}

// 128 taps see 375 Hz as one; at 1 kHz, where levels are compared, they are put right by a short ring of that
// frequency, in phase with what is there.
void MinimumPhase::keep_level(std::span<const Complex> spectrum, Taps& taps) const {
    const double place = kLevelHz / bin_hz(), share = place - std::floor(place);
    const auto at = static_cast<std::size_t>(place);
    // A line between two bins would miss a notch by some tenths of a decibel.
    const std::array<double, 4> weight = cubic_weights(share);
    double power = 0;
    for (std::size_t n = 0; n < 4; ++n) power += weight[n] * squared(spectrum[at + n - 1]);
    const double wanted = std::sqrt(std::max(power, 0.0));
    const Complex is = response(taps, kLevelHz);
    const double size = std::sqrt(squared(is));
    if (!(size > 0)) return;
    const double more = std::clamp(wanted / size, 0.5, 2.0) - 1;
    const Complex missing{more * is.real(), more * is.imag()};
    // ring(k) = e^(-k / kRingTaps) Re(a e^(i w k)) has the transform (a sum e^(-k/r) + conj(a) mirror) / 2.
    Complex a{2 * missing.real() / ring_sum_, 2 * missing.imag() / ring_sum_};
    for (int round = 0; round < 8; ++round) {
        const Complex m = product({a.real(), -a.imag()}, ring_mirror_);
        a = {(2 * missing.real() - m.real()) / ring_sum_, (2 * missing.imag() - m.imag()) / ring_sum_};
    }
    for (std::size_t k = 0; k < kHeadTaps; ++k)
        taps[k] += ring_fall_[k] * (a.real() * ring_cosine_[k] - a.imag() * ring_sine_[k]);
}

// Where ears compare phases.
std::size_t MinimumPhase::first_compared() const {
    return static_cast<std::size_t>(300 / bin_hz()) + 1;
}
std::size_t MinimumPhase::last_compared() const {
    return static_cast<std::size_t>(1500 / bin_hz());
}

// The delay that makes filter and spectrum most alike, as their magnitudes are alike: the highest of all
// peaks is the right one.
double MinimumPhase::delay_behind(std::span<const Complex> spectrum, const Taps& taps) const {
    constexpr double kReach = 1e-3, kStep = 1e-4;
    std::vector<Cross> cross;
    for (std::size_t k = first_compared(); k <= last_compared(); ++k) {
        const double hz = bin_hz() * static_cast<double>(k);
        cross.push_back({math::kTwoPi * hz, product(conjugate(spectrum[k]), response(taps, hz))});
    }
    double best = 0, most = alike(cross, 0);
    for (double t = -kReach; t < kReach; t += kStep) {
        const double here = alike(cross, t);
        if (!(here > most)) continue;
        best = t;
        most = here;
    }
    return peak_near(cross, best);
}

// Each ear's own best delay leaves an offset between the ears that is some microseconds off where the cut
// filters differ from the spectra. Both cross-correlations are laid with their peaks upon each other.
void MinimumPhase::keep_arrival_offset(std::span<const Complex> left, std::span<const Complex> right,
                                       const std::array<Taps, 2>& taps,
                                       std::array<double, 2>& delay_s) const {
    const double offset = delay_s[1] - delay_s[0];
    std::vector<Cross> wanted, found;
    for (std::size_t k = first_compared(); k <= last_compared(); ++k) {
        const double hz = bin_hz() * static_cast<double>(k), w = math::kTwoPi * hz;
        wanted.push_back({w, product(left[k], conjugate(right[k]))});
        found.push_back({w, product(response(taps[0], hz), conjugate(response(taps[1], hz)))});
    }
    const double apart = peak_near(found, 0);
    const double off = peak_near(wanted, offset + apart) - (offset + apart);
    constexpr double kMostOff = 100e-6;  // more is no peak of the same wave
    if (!(std::abs(off) < kMostOff)) return;
    delay_s[0] -= 0.5 * off;
    delay_s[1] += 0.5 * off;
}

}  // namespace tribo::sound
