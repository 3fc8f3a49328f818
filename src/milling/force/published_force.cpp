// SPDX-License-Identifier: MIT
#include "milling/force/published_force.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "milling/force/piece_force.hpp"

namespace tribo::milling {

Result<PublishedCut> published_cut(const Cutter& cutter, const CuttingCoefficients& coefficients,
                                   double feed_per_tooth_mm) {
    if (cutter.kind != CutterKind::flat) {
        return fail("the published force is for flat end mills",
                    "use a flat cutter or leave --as-published out");
    }
    if (cutter.helix_deg <= 0) {
        return fail("the published force divides by tan(helix), which is 0 for straight flutes",
                    "give helix_deg above 0 or leave --as-published out");
    }
    const double helix = cutter.helix_deg * math::kRadPerDeg;
    return PublishedCut{.radius_mm = cutter.radius_mm(),
                        .feed_per_tooth_mm = feed_per_tooth_mm,
                        .helix_rad = helix,
                        .kt_n_per_mm2 = coefficients.ktc,
                        .eta_r = coefficients.krc * math::cos(helix) / coefficients.ktc};
}

// Legend: K11 = K33 = K_t / (2 tan beta), K13 = K31 = eta_r K_t / (2 sin beta), K22 = K_t, all times R f.
Vec3 published_force(PublishedForm form, const PublishedCut& cut, std::span<const FluteSpan> flutes) {
    Vec3 sums;  // sums over the flutes of the brackets of equations 3, 4 and 5
    for (const FluteSpan& flute : flutes) {
        double sin1, cos1, sin2, cos2;
        math::sincos(flute.entry_rad, sin1, cos1);
        math::sincos(flute.exit_rad, sin2, cos2);
        sums.x += 2 * (sin2 * sin2 - sin1 * sin1);  // cos 2 ent - cos 2 ext
        sums.y += cos1 - cos2;
        sums.z += 2 * (flute.exit_rad - flute.entry_rad) + 2 * (sin1 * cos1 - sin2 * cos2);
    }
    const double rf = cut.radius_mm * cut.feed_per_tooth_mm, tan_beta = math::tan(cut.helix_rad);
    const double k11 = rf * cut.kt_n_per_mm2 / (2 * tan_beta), k22 = rf * cut.kt_n_per_mm2;
    const double k13 = rf * cut.eta_r * cut.kt_n_per_mm2 / (2 * math::sin(cut.helix_rad));
    if (form == PublishedForm::printed) {
        const Vec3 a{rf / (4 * tan_beta) * sums.x, rf * sums.y, rf / (4 * tan_beta) * sums.z};
        return {k11 * a.x + k13 * a.z, k22 * a.y, k13 * a.x + k11 * a.z};
    }
    const Vec3 a{0.5 * sums.x, sums.y, 0.5 * sums.z};
    return {-k11 * a.x - k13 * a.z, k22 * a.y, -k13 * a.x + k11 * a.z};
}

Vec3 published_force_at(PublishedForm form, const PublishedCut& cut, const EngagedEdges& edges,
                        double theta_rad) {
    Vec3 sum;
    const double period = edges.period_rad();
    for (const EngagedEdge& edge : edges.edges()) {
        const ToothRange teeth = teeth_within(edge, theta_rad, period);
        for (int n = teeth.first; n <= teeth.last; ++n) {
            const double tip = theta_rad + edge.phase_rad + n * period;
            const FluteSpan span{std::max(tip - edge.lag1_rad, edge.entry_rad),
                                 std::min(tip - edge.lag0_rad, edge.exit_rad)};
            if (span.exit_rad > span.entry_rad) sum += published_force(form, cut, {&span, 1});
        }
    }
    return {sum.x, sum.z, sum.y};
}

ForcePeaks published_peaks(PublishedForm form, const PublishedCut& cut, const EngagedEdges& edges) {
    constexpr int kSamples = 1440;
    ForcePeaks peaks;
    for (int i = 0; i < kSamples; ++i) {
        const Vec3 f = published_force_at(form, cut, edges, edges.period_rad() * i / kSamples);
        peaks.mean_n += f / kSamples;
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(f[axis]) > std::abs(peaks.peak_n[axis])) peaks.peak_n[axis] = f[axis];
        }
        peaks.peak_xy_n = std::max(peaks.peak_xy_n, std::sqrt(f.x * f.x + f.y * f.y));
        peaks.peak_force_n = std::max(peaks.peak_force_n, length(f));
    }
    return peaks;
}

}  // namespace tribo::milling
