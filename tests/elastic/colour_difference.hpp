// SPDX-License-Identifier: MIT
// How different two colours look: CIEDE2000 (Sharma, Wu, Dalal 2005) and CIE76, of sRGB under D65. A
// difference of 1 is about what can just be seen.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace tribo::elastic {

using Lab = std::array<double, 3>;

inline Lab lab_of(const std::uint8_t* srgb) {
    const auto linear = [](std::uint8_t number) {
        const double c = number / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const double r = linear(srgb[0]), g = linear(srgb[1]), b = linear(srgb[2]);
    const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
    const double y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline double cie76(const Lab& p, const Lab& q) {
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

inline double ciede2000(const Lab& p, const Lab& q) {
    constexpr double kDegree = std::numbers::pi / 180;
    const auto chroma_weight = [](double c) {
        return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + 6103515625));
    };
    const double g = 0.5 * (1 - chroma_weight((std::hypot(p[1], p[2]) + std::hypot(q[1], q[2])) / 2));
    const double a1 = (1 + g) * p[1], a2 = (1 + g) * q[1];
    const double c1 = std::hypot(a1, p[2]), c2 = std::hypot(a2, q[2]);
    const auto hue = [&](double a, double b) {
        const double h = a == 0 && b == 0 ? 0 : std::atan2(b, a) / kDegree;
        return h < 0 ? h + 360 : h;
    };
    const double h1 = hue(a1, p[2]), h2 = hue(a2, q[2]);
    double turn = c1 * c2 == 0 ? 0 : h2 - h1;
    if (turn > 180) turn -= 360;
    if (turn < -180) turn += 360;
    double h = h1 + h2;
    if (c1 * c2 != 0) h = std::abs(h1 - h2) <= 180 ? h / 2 : (h < 360 ? h + 360 : h - 360) / 2;
    const double light = (p[0] + q[0]) / 2 - 50, c = (c1 + c2) / 2;
    const double t = 1 - 0.17 * std::cos((h - 30) * kDegree) + 0.24 * std::cos(2 * h * kDegree) +
                     0.32 * std::cos((3 * h + 6) * kDegree) - 0.2 * std::cos((4 * h - 63) * kDegree);
    const double dl = (q[0] - p[0]) / (1 + 0.015 * light * light / std::sqrt(20 + light * light));
    const double dc = (c2 - c1) / (1 + 0.045 * c);
    const double dh = 2 * std::sqrt(c1 * c2) * std::sin(turn / 2 * kDegree) / (1 + 0.015 * c * t);
    const double bend = 60 * std::exp(-((h - 275) / 25) * ((h - 275) / 25)) * kDegree;
    return std::sqrt(dl * dl + dc * dc + dh * dh - 2 * chroma_weight(c) * std::sin(bend) * dc * dh);
}

// Share of the pixels (RGBA) that differ by more than 1, by CIEDE2000.
inline double share_seen(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
    std::size_t seen = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) seen += ciede2000(lab_of(&a[i]), lab_of(&b[i])) > 1 ? 1 : 0;
    return 4.0 * static_cast<double>(seen) / static_cast<double>(a.size());
}

}  // namespace tribo::elastic
