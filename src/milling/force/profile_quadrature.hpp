// SPDX-License-Identifier: MIT
// Gauss-Legendre points along the rounded part of the profile. There the integrals of radial and axial force
// are not elementary because of sin kappa.
#pragma once

#include <algorithm>
#include <cmath>

#include "milling/engagement/engaged_edges.hpp"

namespace tribo::milling {

struct GaussRule {
    int points;
    double x[6], weight[6];  // on [-1, 1]
};

// Abramowitz and Stegun, table 25.4.
inline constexpr GaussRule kGauss2{
    2, {-0.57735026918962576451, 0.57735026918962576451, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0}};
inline constexpr GaussRule kGauss3{
    3,
    {-0.77459666924148337704, 0, 0.77459666924148337704, 0, 0, 0},
    {0.55555555555555555556, 0.88888888888888888889, 0.55555555555555555556, 0, 0, 0}};
inline constexpr GaussRule kGauss6{6,
                                   {-0.93246951420315202781, -0.66120938646626451366, -0.23861918608319690863,
                                    0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781},
                                   {0.17132449237917034504, 0.36076157304813860757, 0.46791393457269104739,
                                    0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504}};

// Calls visit(lag, load) at each point, with the lag behind the tip, rad (negative on a left-hand helix), and
// the load times the length of profile of the point: N and N mm. The variable is u = sqrt(z / 2r) = sin(kappa
// / 2). It is smooth down to the tip and needs no trigonometry: sin kappa = 2 u sqrt(1 - u^2), cos kappa = 1
// - 2 u^2, db = r dkappa = 2 r du / sqrt(1 - u^2). Real-time safe.
template <class Visit>
void visit_profile(const EngagedEdges& tool, const Chip& chip, double z0_mm, double z1_mm,
                   const GaussRule& rule, Visit&& visit) {
    const auto scaled = [&](const ProfilePoint& at, double length) {
        EdgeLoad load = edge_load(tool.coefficients(), chip, at);
        for (TurnLaw* law : {&load.t, &load.r, &load.a, &load.m}) {
            law->sine *= length;
            law->cosine *= length;
            law->constant *= length;
        }
        visit(at.height_mm * tool.lag_per_mm(), load);
    };
    if (!tool.profile().parts().empty()) {
        const CutterProfile::Part& part =
            tool.profile().parts()[tool.profile().lateral_part(0.5 * (z0_mm + z1_mm))];
        const double s0 = part.at_height(z0_mm), s1 = part.at_height(z1_mm);
        for (int i = 0; i < rule.points; ++i)
            scaled(part.at(0.5 * (s0 + s1) + 0.5 * (s1 - s0) * rule.x[i]), 0.5 * (s1 - s0) * rule.weight[i]);
        return;
    }
    const double corner = tool.corner_mm(), core = tool.radius_mm() - corner;
    const double u0 = std::sqrt(z0_mm / (2 * corner)), u1 = std::sqrt(z1_mm / (2 * corner));
    const double middle = 0.5 * (u0 + u1), half = 0.5 * (u1 - u0);
    for (int i = 0; i < rule.points; ++i) {
        const double u = middle + half * rule.x[i], root = std::sqrt(1 - u * u);
        const double sin_kappa = 2 * u * root, cos_kappa = 1 - 2 * u * u;
        const double length = 2 * corner * half * rule.weight[i] / root;
        const double height = 2 * corner * u * u;
        scaled({core + corner * sin_kappa, height, sin_kappa, cos_kappa}, length);
    }
}

// Limits of the step of sin(kappa / 2) and of the turn of the factor of the load. Within them three points
// are accurate to 1e-7 of the force, two points to 1e-6.
inline constexpr double kThreePointProfile = 0.2, kThreePointRad = 0.5;
inline constexpr double kTwoPointProfile = 0.05, kTwoPointRad = 0.2;

// Returns the step of sin(kappa / 2) between two heights; on a profile half of the turn, which is more.
inline double profile_step(const EngagedEdges& tool, double z0_mm, double z1_mm) {
    if (!tool.profile().parts().empty()) {
        const CutterProfile::Part& part =
            tool.profile().parts()[tool.profile().lateral_part(0.5 * (z0_mm + z1_mm))];
        const double size = part.at_height(z1_mm) - part.at_height(z0_mm);
        return part.element.is_arc() ? 0.5 * size / std::abs(part.element.radius_mm) : 0;
    }
    return std::sqrt(z1_mm / (2 * tool.corner_mm())) - std::sqrt(z0_mm / (2 * tool.corner_mm()));
}

inline const GaussRule& profile_rule(const EngagedEdges& tool, double z0_mm, double z1_mm, double turn_rad) {
    const double span = profile_step(tool, z0_mm, z1_mm);
    if (span < kTwoPointProfile && turn_rad < kTwoPointRad) return kGauss2;
    return span < kThreePointProfile && turn_rad < kThreePointRad ? kGauss3 : kGauss6;
}

}  // namespace tribo::milling
