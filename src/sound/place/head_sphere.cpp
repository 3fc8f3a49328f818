// SPDX-License-Identifier: MIT
// The pressure on a rigid sphere in a plane wave.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "base/math.hpp"
#include "sound/place/complex.hpp"
#include "sound/place/head.hpp"

namespace tribo::sound {
namespace {

constexpr double kEarsBehindRad = 10 * math::kRadPerDeg;
constexpr int kAngleStepDeg = 2, kAngles = 180 / kAngleStepDeg + 1;
constexpr double kRearDb = -8, kRearHz = 3000;

Complex inverse(Complex a) {
    const double s = a.real() * a.real() + a.imag() * a.imag();
    return {a.real() / s, -a.imag() / s};
}

// p(mu, theta) = (i / mu^2) sum (-i)^m (2 m + 1) P_m(cos theta) / h'_m(mu), mu = 2 pi f radius / c, theta the
// angle between ear and source, h_m the spherical Hankel function of the first kind (time e^{-i w t}); over
// the pressure that the wave would have at the centre without the sphere. Gives it for all angles, for the
// time e^{+i w t} of the Fourier transform.
class SphereWave {
  public:
    SphereWave() {
        for (int a = 0; a < kAngles; ++a) {
            const double x = math::cos(math::kRadPerDeg * kAngleStepDeg * a);
            double before = 1, here = x;  // P_0, P_1
            for (int m = 0; m < kOrders; ++m) {
                legendre_[static_cast<std::size_t>(m)][static_cast<std::size_t>(a)] = before;
                const double next = ((2 * m + 3) * x * here - (m + 1) * before) / (m + 2);
                before = here;
                here = next;
            }
        }
    }
    void at(double mu, std::vector<Complex>& pressure) const {
        pressure.assign(kAngles, Complex{mu == 0 ? 1.0 : 0.0, 0});
        if (mu == 0) return;
        double sine, cosine;
        math::sincos(mu, sine, cosine);
        // h_-1 = e^{i mu} / mu, h_0 = -i h_-1; upwards h_m+1 = (2 m + 1) / mu h_m - h_m-1.
        Complex before{cosine / mu, sine / mu}, here{sine / mu, -cosine / mu};
        Complex power{0, 1 / (mu * mu)};  // i (-i)^m / mu^2
        for (int m = 0; m < kOrders; ++m) {
            const double up = (m + 1) / mu;
            const Complex slope{before.real() - up * here.real(), before.imag() - up * here.imag()};
            const Complex term = product(power, inverse(slope));
            const Complex scaled{(2 * m + 1) * term.real(), (2 * m + 1) * term.imag()};
            for (std::size_t a = 0; a < kAngles; ++a) {
                const double p = legendre_[static_cast<std::size_t>(m)][a];
                pressure[a] = {pressure[a].real() + p * scaled.real(),
                               pressure[a].imag() + p * scaled.imag()};
            }
            if (m > mu && std::abs(scaled.real()) + std::abs(scaled.imag()) < 1e-10) break;
            power = {power.imag(), -power.real()};
            const double two = (2 * m + 1) / mu;
            const Complex next{two * here.real() - before.real(), two * here.imag() - before.imag()};
            before = here;
            here = next;
        }
        for (Complex& p : pressure) p = {p.real(), -p.imag()};
    }

  private:
    static constexpr int kOrders = 200;
    std::array<std::array<double, kAngles>, kOrders> legendre_;
};

// What an outer ear takes from behind: a shelf of first order, (1 + g s) / (1 + s), s = i f / kRearHz, by the
// bilinear transform; g = kRearDb straight behind, fading towards the front.
void shade_rear(Vec3 direction, double sample_rate_hz, HeadTaps& taps) {
    const double rear = 0.5 * (1 - direction.y);
    const double g = math::pow(10, kRearDb / 20 * rear * rear);
    const double s = 1 / math::tan(math::kPi * kRearHz / sample_rate_hz);
    const double b0 = (1 + g * s) / (1 + s), b1 = (1 - g * s) / (1 + s), a1 = (1 - s) / (1 + s);
    double x1 = 0, y1 = 0;
    for (float& t : taps) {
        const auto x = static_cast<double>(t);
        y1 = b0 * x + b1 * x1 - a1 * y1;
        x1 = x;
        t = static_cast<float>(y1);
    }
}

}  // namespace

std::shared_ptr<const Head> Head::sphere(double sample_rate_hz) {
    MinimumPhase phase(sample_rate_hz);
    const auto wave = std::make_unique<SphereWave>();
    std::vector<std::vector<Complex>> spectra(kAngles, std::vector<Complex>(phase.bins()));
    std::vector<Complex> pressure;
    for (std::size_t k = 0; k < phase.bins(); ++k) {
        // Beyond 24 kHz nobody hears and the series is long: held.
        const double hz = std::min(phase.bin_hz() * static_cast<double>(k), 24000.0);
        wave->at(math::kTwoPi * hz * kHeadRadius / kSoundSpeed, pressure);
        for (std::size_t a = 0; a < kAngles; ++a) spectra[a][k] = pressure[a];
    }
    std::vector<EarResponses> by_angle;
    for (std::size_t a = 0; a < kAngles; ++a) by_angle.push_back(phase.split(spectra[a], spectra[a]));

    const auto head = std::shared_ptr<Head>(new Head(sample_rate_hz, kHeadTaps));
    const double side = math::cos(kEarsBehindRad), back = -math::sin(kEarsBehindRad);
    for (int r = 0; r < kRows; ++r) {
        for (int c = 0; c < kColumns; ++c) {
            const Vec3 d = grid_direction(r, c);
            for (std::size_t ear = 0; ear < 2; ++ear) {
                const double towards = (ear == 0 ? -side : side) * d.x + back * d.y;
                const double angle =
                    math::acos(std::clamp(towards, -1.0, 1.0)) * math::kDegPerRad / kAngleStepDeg;
                const auto a =
                    std::min(static_cast<std::size_t>(angle), static_cast<std::size_t>(kAngles - 2));
                const double t = angle - static_cast<double>(a);
                HeadTaps& taps = head->node(r, c).taps[ear];
                for (std::size_t k = 0; k < kHeadTaps; ++k) {
                    taps[k] = static_cast<float>((1 - t) * static_cast<double>(by_angle[a].taps[0][k]) +
                                                 t * static_cast<double>(by_angle[a + 1].taps[0][k]));
                }
                head->node(r, c).delay_s[ear] =
                    (1 - t) * by_angle[a].delay_s[0] + t * by_angle[a + 1].delay_s[0];
                shade_rear(d, sample_rate_hz, taps);
            }
        }
    }
    head->finish();
    return head;
}

}  // namespace tribo::sound
