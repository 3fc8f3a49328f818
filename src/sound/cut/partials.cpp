// SPDX-License-Identifier: MIT
#include "sound/cut/partials.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "sound/cut/smoothstep.hpp"

namespace tribo::sound {
namespace {

// Two frames: what SSE2, NEON and WebAssembly hold in a register.
using Lanes = double __attribute__((vector_size(16)));

void trim(Partials& p) {
    while (p.count > 0) {
        const auto last = static_cast<std::size_t>(p.count - 1);
        if (p.re[last] != 0 || p.im[last] != 0) break;
        --p.count;
    }
}

}  // namespace

double Partials::peak() const {
    double sum = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
        sum += std::sqrt(re[n] * re[n] + im[n] * im[n]);
    }
    return 2 * sum;
}

Partials mix(const Partials& a, const Partials& b, double t) {
    Partials m;
    m.count = std::max(a.count, b.count);
    for (std::size_t n = 0; n < static_cast<std::size_t>(m.count); ++n) {
        m.re[n] = a.re[n] + t * (b.re[n] - a.re[n]);
        m.im[n] = a.im[n] + t * (b.im[n] - a.im[n]);
    }
    trim(m);
    return m;
}

Partials in_plane_partials(const contact::ForceSpectrum& spectrum, double scale) {
    Partials p;
    if (spectrum.empty()) return p;
    p.count = static_cast<int>(std::min<std::size_t>(spectrum.harmonics.size() - 1, kMaxPartials));
    for (std::size_t n = 0; n < static_cast<std::size_t>(p.count); ++n) {
        const contact::ForceHarmonic& h = spectrum.harmonics[n + 1];
        const double re = h.x.real() + h.y.imag(), im = h.x.imag() - h.y.real();  // x - i y
        const double size = std::sqrt(h.x.real() * h.x.real() + h.x.imag() * h.x.imag() +
                                      h.y.real() * h.y.real() + h.y.imag() * h.y.imag());
        const double along = std::sqrt(re * re + im * im);
        p.re[n] = scale * (along > 0 ? size * (re / along) : size);
        p.im[n] = scale * (along > 0 ? size * (im / along) : 0);
    }
    trim(p);
    return p;
}

double audible_share(double frequency_hz, double sample_rate_hz) {
    constexpr double kFadeFrom = 0.9, kFadeTo = 0.98;  // of half the sample rate
    constexpr double kInfrasoundHz = 10, kSoundHz = 20;
    const double f = std::abs(frequency_hz);
    return smoothstep((kFadeTo - 2 * f / sample_rate_hz) / (kFadeTo - kFadeFrom)) *
           smoothstep((f - kInfrasoundHz) / (kSoundHz - kInfrasoundHz));
}

Partials audible(const Partials& partials, double fundamental_hz, double sample_rate_hz) {
    Partials a;
    a.count = partials.count;
    for (std::size_t n = 0; n < static_cast<std::size_t>(a.count); ++n) {
        const double share = audible_share(static_cast<double>(n + 1) * fundamental_hz, sample_rate_hz);
        a.re[n] = share * partials.re[n];
        a.im[n] = share * partials.im[n];
    }
    trim(a);
    return a;
}

void play(const Partials& before, const Partials& here, const Partials& after, const PhasePiece& phase,
          int step, Quantum& out) {
    constexpr int kAbreast = 4;
    constexpr double kPerFrame = 1.0 / kQuantumFrames;
    const auto count = static_cast<std::size_t>(std::max({before.count, here.count, after.count}));
    struct {
        Spline re{0, 0, 0}, im{0, 0, 0};
    } amplitude[kMaxPartials];
    for (std::size_t n = 0; n < count; ++n) {
        amplitude[n] = {{before.re[n], here.re[n], after.re[n]}, {before.im[n], here.im[n], after.im[n]}};
    }
    for (int j = 0; j < kQuantumFrames; j += kAbreast) {
        double sine[kAbreast], cosine[kAbreast];
        for (int k = 0; k < kAbreast; ++k) math::sincos(step * phase.at(j + k), sine[k], cosine[k]);
        const Lanes ur0{cosine[0], cosine[1]}, ur1{cosine[2], cosine[3]};
        const Lanes ui0{sine[0], sine[1]}, ui1{sine[2], sine[3]};
        const Lanes t0{j * kPerFrame, (j + 1) * kPerFrame}, t1{(j + 2) * kPerFrame, (j + 3) * kPerFrame};
        Lanes re0{0, 0}, re1{0, 0}, im0{0, 0}, im1{0, 0};
        for (std::size_t n = count; n-- > 0;) {
            const Spline &a = amplitude[n].re, &b = amplitude[n].im;
            const Lanes x0 = re0 + (a.b0 + t0 * (a.b1 + t0 * a.b2));
            const Lanes y0 = im0 + (b.b0 + t0 * (b.b1 + t0 * b.b2));
            const Lanes x1 = re1 + (a.b0 + t1 * (a.b1 + t1 * a.b2));
            const Lanes y1 = im1 + (b.b0 + t1 * (b.b1 + t1 * b.b2));
            re0 = ur0 * x0 - ui0 * y0;
            im0 = ur0 * y0 + ui0 * x0;
            re1 = ur1 * x1 - ui1 * y1;
            im1 = ur1 * y1 + ui1 * x1;
        }
        const auto first = static_cast<std::size_t>(j);
        out[first] = 2 * re0[0];
        out[first + 1] = 2 * re0[1];
        out[first + 2] = 2 * re1[0];
        out[first + 3] = 2 * re1[1];
    }
}

}  // namespace tribo::sound
