// SPDX-License-Identifier: MIT
// Cutting force straight from its definition, by quadrature split at every jump: the independent computation
// that the closed forms are held against. Nothing of the engine's formulas is used.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "contact/force_spectrum.hpp"
#include "milling/engagement/engaged_edges.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"

namespace reference {

using tribo::Vec3;
using tribo::contact::ToolForce;
namespace milling = tribo::milling;

inline constexpr double kPi = std::numbers::pi;
inline double rad(double degrees) {
    return degrees * kPi / 180;
}

struct Cut {
    milling::Cutter cutter;
    milling::CuttingCoefficients k;
    milling::Engagement engagement;
    milling::ToolTravel feed;
};

// The engine's pieces of that cut.
inline milling::EngagedEdges engaged(const Cut& c) {
    milling::EngagedEdges edges(c.cutter, c.k);
    edges.engage(c.engagement, c.feed);
    return edges;
}

// A place on the edge: its radius and height, and the angle kappa of the envelope there.
struct Place {
    double r, z, kappa;
};
inline Vec3 normal_at(double phi, double kappa) {
    return {std::sin(kappa) * std::sin(phi), std::sin(kappa) * std::cos(phi), -std::cos(kappa)};
}
// Where a rigid motion over one tooth takes the place: the tip's travel, and the turn of the axis (0, 0, 1)
// by the vector (turn_x, turn_y, 0) crossed with the place's position.
inline Vec3 travel_of(const Cut& c, double phi, const Place& p) {
    const Vec3 turn = cross(Vec3{0, 0, 1}, {c.feed.turn_x_rad, c.feed.turn_y_rad, 0});
    const Vec3 position{p.r * std::sin(phi), p.r * std::cos(phi), p.z};
    return Vec3{c.feed.across_mm, 0, -c.feed.down_mm} + cross(turn, position);
}

// Chip thickness along the outward normal for a rotation, a place and a tooth at a lag.
inline double plain_chip(const Cut& c, double phi, const Place& p, int, double) {
    return dot(travel_of(c, phi, p), normal_at(phi, p.kappa));
}

// With run-out and uneven pitch: against the deepest surface that the last 1..N teeth left, looked up in the
// history of where each of them was.
inline double worn_chip(const Cut& c, double phi, const Place& p, int tooth, double lag) {
    const int n = c.cutter.flutes;
    std::vector<double> angle(1, 0.0);
    for (int j = 0; j < n; ++j) {
        angle.push_back(angle.back() + rad(c.cutter.pitch_deg.empty()
                                               ? 360.0 / n
                                               : c.cutter.pitch_deg[static_cast<std::size_t>(j)]));
    }
    const double each = dot(travel_of(c, phi, p), normal_at(phi, p.kappa));
    const auto out = [&](int j) {
        return c.cutter.runout_mm * std::sin(p.kappa) *
               std::cos(rad(c.cutter.runout_deg) - angle[static_cast<std::size_t>(j)] + lag);
    };
    double least = 1e300;
    for (int back = 1; back <= n; ++back) {
        const int ahead = (tooth + back) % n;
        double between = angle[static_cast<std::size_t>(ahead)] - angle[static_cast<std::size_t>(tooth)];
        if (between <= 1e-12) between += 2 * kPi;
        const double turns = between / (2 * kPi) * n;  // in mean tooth periods
        least = std::min(least, turns * each + out(tooth) - out(ahead));
    }
    return least;
}

// Force on the tool and torque per mm of profile. Along the edge the force points to the end that leads: to
// the tip on a right-hand helix, to the shank on a left-hand one, outward on the bottom.
template <class ChipLaw>
ToolForce per_mm(const Cut& c, double phi, const Place& p, int tooth, double lag, ChipLaw chip) {
    const double h = chip(c, phi, p, tooth, lag);
    if (h <= 0) return {};
    const double kappa = p.kappa, ft = c.k.ktc * h + c.k.kte, fr = c.k.krc * h + c.k.kre,
                 fa = c.k.kac * h + c.k.kae;
    const Vec3 radial{std::sin(phi), std::cos(phi), 0}, up{0, 0, 1};
    const Vec3 motion{std::cos(phi), -std::sin(phi), 0};
    const Vec3 normal = std::sin(kappa) * radial - std::cos(kappa) * up;
    const Vec3 meridian = std::cos(kappa) * radial + std::sin(kappa) * up;
    const bool bottom = p.z == 0 && kappa == 0;
    const double leading = bottom || c.cutter.helix_deg < 0 ? 1 : -1;
    return {-ft * motion - fr * normal + leading * fa * meridian, ft * p.r};
}

inline constexpr std::array<double, 4> kNodes{0.18343464249564980494, 0.52553240991632898582,
                                              0.79666647741362673959, 0.96028985649753623168};
inline constexpr std::array<double, 4> kWeights{0.36268378337836198297, 0.31370664587788728734,
                                                0.22238103445337447054, 0.10122853629037625915};

// Composite eight-point Gauss-Legendre; f(x, weight).
template <class F>
void quadrature(double from, double to, int panels, F f) {
    for (int p = 0; p < panels; ++p) {
        const double a = from + (to - from) * p / panels, b = from + (to - from) * (p + 1) / panels;
        for (std::size_t i = 0; i < 4; ++i) {
            for (const double side : {-1.0, 1.0}) {
                f(0.5 * (a + b) + 0.5 * (b - a) * side * kNodes[i], 0.5 * (b - a) * kWeights[i]);
            }
        }
    }
}

// Visits the profile between two heights: f(place, length of profile that the point stands for).
template <class F>
void profile(const milling::Cutter& cutter, double z0, double z1, int panels, F f) {
    const double r = cutter.corner_radius_mm(), middle = std::clamp(r, z0, z1);
    if (middle > z0) {
        const auto kappa_at = [&](double z) { return std::acos(std::clamp(1 - z / r, -1.0, 1.0)); };
        quadrature(kappa_at(z0), kappa_at(middle), panels, [&](double kappa, double w) {
            f(Place{cutter.radius_mm() - r + r * std::sin(kappa), r * (1 - std::cos(kappa)), kappa}, w * r);
        });
    }
    if (z1 > middle) {
        quadrature(middle, z1, panels,
                   [&](double z, double w) { f(Place{cutter.radius_mm(), z, kPi / 2}, w); });
    }
}

inline double tooth_angle(const milling::Cutter& cutter, int tooth) {
    double angle = 0;
    for (int j = 0; j < tooth; ++j) {
        angle += rad(cutter.pitch_deg.empty() ? 360.0 / cutter.flutes
                                              : cutter.pitch_deg[static_cast<std::size_t>(j)]);
    }
    return angle;
}

// The window's borders and, between them, where the chip of this point starts and stops.
template <class ChipLaw>
std::vector<double> chip_borders(const Cut& c, double from, double to, const Place& p, int tooth, double lag,
                                 ChipLaw chip) {
    std::vector<double> borders{from};
    constexpr int kSteps = 60;
    const auto cuts = [&](double phi) { return chip(c, phi, p, tooth, lag) > 0; };
    double before = from;
    for (int i = 1; i <= kSteps; ++i) {
        const double phi = from + (to - from) * i / kSteps;
        if (cuts(phi) != cuts(before)) {
            double a = before, b = phi;
            for (int n = 0; n < 60; ++n) {
                const double m = 0.5 * (a + b);
                (cuts(m) == cuts(a) ? a : b) = m;
            }
            borders.push_back(0.5 * (a + b));
        }
        before = phi;
    }
    borders.push_back(to);
    return borders;
}

inline void add(ToolForce& sum, double weight, const ToolForce& f) {
    sum.force_n += weight * f.force_n;
    sum.torque_nmm += weight * f.torque_nmm;
}

// The force at a spindle angle: along every tooth, split where it crosses a border of a window.
template <class ChipLaw>
ToolForce force_at(const Cut& c, double theta, int panels, ChipLaw chip) {
    ToolForce sum;
    const double lag_per_mm = std::tan(rad(c.cutter.helix_deg)) / c.cutter.radius_mm();
    for (int j = 0; j < c.cutter.flutes; ++j) {
        const double tip = theta + tooth_angle(c.cutter, j);
        for (const milling::EngagementBand& band : c.engagement.bands) {
            std::vector<double> cuts{band.z0_mm, band.z1_mm};
            if (lag_per_mm != 0) {
                for (const double border : {band.entry_rad, band.exit_rad, 0.0, kPi}) {
                    for (int turn = -8; turn <= 8; ++turn) {
                        const double z = (tip - border - 2 * kPi * turn) / lag_per_mm;
                        if (z > band.z0_mm && z < band.z1_mm) cuts.push_back(z);
                    }
                }
            }
            std::sort(cuts.begin(), cuts.end());
            for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
                const double middle = tip - lag_per_mm * 0.5 * (cuts[i] + cuts[i + 1]);
                const double turned = middle - 2 * kPi * std::floor(middle / (2 * kPi));
                if (turned < band.entry_rad || turned > band.exit_rad) continue;
                profile(c.cutter, cuts[i], cuts[i + 1], panels, [&](const Place& p, double length) {
                    const double lag = lag_per_mm * p.z;
                    add(sum, length, per_mm(c, tip - lag, p, j, lag, chip));
                });
            }
        }
        const double turned = tip - 2 * kPi * std::floor(tip / (2 * kPi));
        for (const milling::BottomBand& band : c.engagement.bottom) {
            if (turned < band.entry_rad || turned > band.exit_rad) continue;
            quadrature(band.r0_mm, band.r1_mm, 16 * panels,
                       [&](double r, double w) { add(sum, w, per_mm(c, tip, Place{r, 0, 0}, j, 0, chip)); });
        }
    }
    return sum;
}
inline ToolForce force_at(const Cut& c, double theta, int panels = 4) {
    return force_at(c, theta, panels, plain_chip);
}

// Harmonic m of the spindle's frequency: over teeth, profile and window, where a point passes the rotation
// phi at theta = phi + lag - tooth angle.
template <class ChipLaw>
tribo::contact::ForceHarmonic harmonic(const Cut& c, int m, int panels_z, int panels_phi, ChipLaw chip) {
    tribo::contact::ForceHarmonic sum;
    const double lag_per_mm = std::tan(rad(c.cutter.helix_deg)) / c.cutter.radius_mm();
    for (int j = 0; j < c.cutter.flutes; ++j) {
        const auto over_turn = [&](const Place& p, double lag, double length, double entry, double exit) {
            const std::vector<double> borders = chip_borders(c, entry, exit, p, j, lag, chip);
            for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
                quadrature(borders[i], borders[i + 1], panels_phi, [&](double phi, double w) {
                    const ToolForce f = per_mm(c, phi, p, j, lag, chip);
                    const std::complex<double> turn =
                        std::polar(w * length / (2 * kPi), -m * (phi + lag - tooth_angle(c.cutter, j)));
                    sum.x += turn * f.force_n.x;
                    sum.y += turn * f.force_n.y;
                    sum.z += turn * f.force_n.z;
                    sum.torque += turn * f.torque_nmm;
                });
            }
        };
        for (const milling::EngagementBand& band : c.engagement.bands) {
            profile(c.cutter, band.z0_mm, band.z1_mm, panels_z, [&](const Place& p, double length) {
                over_turn(p, lag_per_mm * p.z, length, band.entry_rad, band.exit_rad);
            });
        }
        for (const milling::BottomBand& band : c.engagement.bottom) {
            quadrature(band.r0_mm, band.r1_mm, panels_z, [&](double r, double w) {
                over_turn(Place{r, 0, 0}, 0, w, band.entry_rad, band.exit_rad);
            });
        }
    }
    return sum;
}
inline tribo::contact::ForceHarmonic harmonic(const Cut& c, int m, int panels_z, int panels_phi) {
    return harmonic(c, m, panels_z, panels_phi, plain_chip);
}

// Largest difference of the force's components, N, or of the torque over the radius.
inline double difference(const ToolForce& a, const ToolForce& b, double radius) {
    const Vec3 d = a.force_n - b.force_n;
    return std::max(
        {std::abs(d.x), std::abs(d.y), std::abs(d.z), std::abs(a.torque_nmm - b.torque_nmm) / radius});
}
inline double difference(const tribo::contact::ForceHarmonic& a, const tribo::contact::ForceHarmonic& b,
                         double radius) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z),
                     std::abs(a.torque - b.torque) / radius});
}
inline double size(const ToolForce& f, double radius) {
    return difference(f, ToolForce{}, radius);
}

}  // namespace reference
