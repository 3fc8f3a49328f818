// SPDX-License-Identifier: MIT
#include "sound/place/head.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/math.hpp"

namespace tribo::sound {
namespace {

// The angle of the point (x, y) within 2e-8 (Abramowitz and Stegun 4.4.49), at a quarter of math::atan2's
// price.
double angle_of(double y, double x) {
    const double ax = std::abs(x), ay = std::abs(y), most = std::max(ax, ay);
    const double t = most > 0 ? std::min(ax, ay) / most : 0, s = t * t;
    // In pairs, so that no term waits for all before it.
    const double s2 = s * s, s4 = s2 * s2;
    const double low = (1 - 0.3333314528 * s) + s2 * (0.1999355085 - 0.1420889944 * s);
    const double high = (0.1065626393 - 0.0752896400 * s) + s2 * (0.0429096138 - 0.0161657367 * s);
    const double a = t * (low + s4 * (high + s4 * 0.0028662257));
    const double first = ay > ax ? math::kHalfPi - a : a;
    const double half = x < 0 ? math::kPi - first : first;
    return y < 0 ? -half : half;
}

}  // namespace

Head::Head(double sample_rate_hz, int taps) : sample_rate_hz_(sample_rate_hz), taps_(taps) {
    nodes_.resize(static_cast<std::size_t>(kRows * kColumns));
}

Vec3 Head::grid_direction(int row, int column) {
    double sine, cosine, up, across;
    math::sincos(math::kRadPerDeg * kStepDeg * column, sine, cosine);
    math::sincos(math::kRadPerDeg * (kStepDeg * row - 90), up, across);
    return {across * sine, across * cosine, up};
}

void Head::hear(Vec3 place, EarResponses& out, const EarKernels& kernels) const {
    hear(place, length(place), out, kernels);
}

void Head::hear(Vec3 d, double size, EarResponses& out, const EarKernels& kernels) const {
    const double inside = std::min(size, 1.0);
    if (size == 0) d = {0, 1, 0};  // the middle has no direction
    const double azimuth = angle_of(d.x, d.y) * (kColumns / math::kTwoPi);
    const double elevation =
        (angle_of(d.z, std::sqrt(d.x * d.x + d.y * d.y)) / math::kPi + 0.5) * (kRows - 1);
    const double column = std::floor(azimuth);
    const double row = std::clamp(std::floor(elevation), 0.0, kRows - 2.0);
    const double across = azimuth - column, up = elevation - row;
    const int c0 = (static_cast<int>(column) + kColumns) % kColumns, c1 = (c0 + 1) % kColumns;
    const int r0 = static_cast<int>(row);
    const EarResponses* corner[4] = {&node(r0, c0), &node(r0, c1), &node(r0 + 1, c0), &node(r0 + 1, c1)};
    const double weight[4] = {inside * (1 - across) * (1 - up), inside * across * (1 - up),
                              inside * (1 - across) * up, inside * across * up};
    const float w[5] = {static_cast<float>(weight[0]), static_cast<float>(weight[1]),
                        static_cast<float>(weight[2]), static_cast<float>(weight[3]),
                        static_cast<float>(1 - inside)};
    for (std::size_t ear = 0; ear < 2; ++ear) {
        const float* five[5] = {corner[0]->taps[ear].data(), corner[1]->taps[ear].data(),
                                corner[2]->taps[ear].data(), corner[3]->taps[ear].data(), everywhere_.data()};
        kernels.blend(five, w, taps_, out.taps[ear].data());
        out.delay_s[ear] = 0;
        for (int n = 0; n < 4; ++n) out.delay_s[ear] += weight[n] * corner[n]->delay_s[ear];
    }
}

void Head::finish() {
    for (const int row : {0, kRows - 1}) {
        EarResponses mean;
        for (int c = 0; c < kColumns; ++c) {
            for (std::size_t ear = 0; ear < 2; ++ear) {
                mean.delay_s[ear] += node(row, c).delay_s[ear] / kColumns;
                for (std::size_t k = 0; k < kHeadTaps; ++k)
                    mean.taps[ear][k] += node(row, c).taps[ear][k] * (1.0f / kColumns);
            }
        }
        for (int c = 0; c < kColumns; ++c) node(row, c) = mean;
    }
    // Means over the sphere: a row counts by the cosine of its elevation.
    double delay = 0, area = 0;
    MinimumPhase phase(sample_rate_hz_);
    const FourierTransform fourier(8);
    std::vector<double> power(fourier.size() / 2 + 1);
    std::vector<std::complex<double>> work(fourier.size());
    for (int r = 0; r < kRows; ++r) {
        const double share = math::cos(math::kRadPerDeg * (kStepDeg * r - 90));
        for (int c = 0; c < kColumns; ++c) {
            const EarResponses& n = node(r, c);
            delay += share * 0.5 * (n.delay_s[0] + n.delay_s[1]);
            area += share;
            // The sum of a transform's squares over both ears is that of left + i right, k and size - k.
            if (c % 2 != 0) continue;
            std::fill(work.begin(), work.end(), 0);
            for (std::size_t k = 0; k < kHeadTaps; ++k)
                work[k] = {static_cast<double>(n.taps[0][k]), static_cast<double>(n.taps[1][k])};
            fourier.forward(work);
            for (std::size_t k = 0; k < power.size(); ++k) {
                const std::complex<double> a = work[k], b = work[(work.size() - k) % work.size()];
                power[k] +=
                    share * 0.25 *
                    (a.real() * a.real() + a.imag() * a.imag() + b.real() * b.real() + b.imag() * b.imag());
            }
        }
    }
    delay /= area;
    for (EarResponses& n : nodes_) {
        for (double& d : n.delay_s) d -= delay;
    }
    // A source everywhere: the root of the mean power, of minimum phase.
    std::vector<std::complex<double>> everywhere(phase.bins());
    for (std::size_t k = 0; k < everywhere.size(); ++k) {
        const double place = static_cast<double>(k) * static_cast<double>(power.size() - 1) /
                             static_cast<double>(everywhere.size() - 1);
        const auto at = std::min(static_cast<std::size_t>(place), power.size() - 2);
        const double t = place - static_cast<double>(at);
        everywhere[k] = std::sqrt(2 * ((1 - t) * power[at] + t * power[at + 1]) / area);
    }
    everywhere_ = phase.split(everywhere, everywhere).taps[0];
    for (std::size_t k = static_cast<std::size_t>(taps_); k < kHeadTaps; ++k) everywhere_[k] = 0;
}

std::shared_ptr<const Head> Head::panning(double sample_rate_hz) {
    const auto head = std::shared_ptr<Head>(new Head(sample_rate_hz, 16));
    head->ears_apart_m_ = 0;
    for (int r = 0; r < kRows; ++r) {
        for (int c = 0; c < kColumns; ++c) {
            // The angle between the loudspeakers by how far to the side the source is.
            const double side = grid_direction(r, c).x;
            double left, right;
            math::sincos(0.25 * math::kPi * (1 - side), left, right);
            constexpr double kSqrt2 = 1.4142135623730951;
            head->node(r, c).taps[0][0] = static_cast<float>(kSqrt2 * left);
            head->node(r, c).taps[1][0] = static_cast<float>(kSqrt2 * right);
        }
    }
    head->finish();
    return head;
}

}  // namespace tribo::sound
