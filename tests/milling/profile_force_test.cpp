// SPDX-License-Identifier: MIT
// Forces of cutters with a profile against thin slices of their drawings (Altintas 2012, 2.8, with the angle
// of the envelope of each slice), and the work of the spindle against the chips.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "milling/any_profile.hpp"
#include "milling/engagement/engagement_probe.hpp"
#include "milling/force/force.hpp"
#include "milling/tool/tooth_phases.hpp"

namespace tribo::milling {
namespace {

const CuttingCoefficients kMetal{.ktc = 800, .krc = 250, .kac = 120, .kte = 20, .kre = 15, .kae = 5};

double radius_at(const Cutter& c, double z) {
    return drawn_point(c, 0, z).radius_mm;
}

struct Slice {
    double z, r, slope, dz;  // slope dr / dz
};
// Slices between the joints of the drawing, so that none reaches over a level part; finer to the joints,
// where an arc may become level.
std::vector<Slice> slices(const Cutter& c, double z0, double z1, int count) {
    std::vector<double> joints{z0, z1};
    for (const auto& vertex : c.profile)
        if (vertex.z_mm > z0 && vertex.z_mm < z1) joints.push_back(vertex.z_mm);
    std::ranges::sort(joints);
    std::vector<Slice> all;
    for (std::size_t joint = 0; joint + 1 < joints.size(); ++joint) {
        const double low = joints[joint], size = joints[joint + 1] - low;
        const int parts = std::max(100, static_cast<int>(count * size / (z1 - z0)));
        const auto height = [&](int n) { return low + 0.5 * size * (1 - std::cos(math::kPi * n / parts)); };
        for (int n = 0; n < parts && size > 1e-9; ++n) {
            const double a = height(n), dz = height(n + 1) - a, z = a + 0.5 * dz;
            all.push_back({z, radius_at(c, z),
                           (radius_at(c, z + 0.4999 * dz) - radius_at(c, z - 0.4999 * dz)) / (0.9998 * dz),
                           dz});
        }
    }
    return all;
}

// The force of all teeth at a spindle angle, slice by slice.
contact::ToolForce by_slices(const Cutter& c, const std::vector<Slice>& all, const EngagementBand& band,
                             const ToolTravel& feed, double theta) {
    contact::ToolForce sum;
    const double leading =
        c.helix_deg < 0 ? -1 : 1;  // the end of a left-hand edge that leads is the upper one
    for (const double phase : tooth_phases_rad(c)) {
        for (const Slice& s : all) {
            double phi = std::fmod(theta + phase - c.lag_rad(s.z), 2 * math::kPi);
            if (phi < 0) phi += 2 * math::kPi;
            if (phi < band.entry_rad || phi > band.exit_rad) continue;
            // Outward normal (1, -slope) / size; per slice the edge is size * dz long.
            const double size = std::sqrt(1 + s.slope * s.slope), sine = 1 / size, cosine = s.slope / size;
            const double h = feed.across_mm * sine * std::sin(phi) + feed.down_mm * cosine;
            if (h <= 0) continue;
            const double db = size * s.dz;
            const double t = (kMetal.ktc * h + kMetal.kte) * db, r = (kMetal.krc * h + kMetal.kre) * db,
                         a = leading * (kMetal.kac * h + kMetal.kae) * db;
            // r against the normal, a along the meridian to the tip.
            const double inward = r * sine + a * cosine, up = r * cosine - a * sine;
            sum.force_n += Vec3{-t * std::cos(phi) - inward * std::sin(phi),
                                t * std::sin(phi) - inward * std::cos(phi), up};
            sum.torque_nmm += t * s.r;
        }
    }
    return sum;
}

// The heights of a drawing with a lateral edge: all but level parts.
EngagementBand some_band(const Cutter& c) {
    const double top = std::min(c.length_mm, 1.3 * c.diameter_mm);
    const double z0 = drawn(0, 0.4) * top, entry = drawn(0, 2.5);
    return {z0, z0 + drawn(0.2, 0.6) * top, entry, entry + drawn(0.5, 3)};
}

void force_is_that_of_slices(const Cutter& c, int count) {
    const EngagementBand band = some_band(c);
    const ToolTravel feed{.across_mm = drawn(0.02, 0.1),
                          .down_mm = *rc::gen::inRange(0, 2) * drawn(0.005, 0.02)};
    ForceModel model(c, kMetal);
    Engagement engagement;
    engagement.bands = {band};
    model.engage(engagement, feed);
    const auto all = slices(c, band.z0_mm, band.z1_mm, count);
    double largest = 0, off = 0;
    for (int n = 0; n < 3; ++n) {
        const double theta = 0.9 * n + 0.1;
        const contact::ToolForce a = model.at(theta), b = by_slices(c, all, band, feed, theta);
        largest = std::max(largest, length(b.force_n));
        off = std::max(
            {off, length(a.force_n - b.force_n), std::abs(a.torque_nmm - b.torque_nmm) / c.radius_mm()});
    }
    // A straight edge enters all at once, at an angle that slices meet exactly as well.
    // Where a piece enters, the slices tell its end to one of them.
    double slice_n = 0;
    for (const Slice& one : all)
        slice_n = std::max(slice_n, std::sqrt(1 + one.slope * one.slope) * one.dz *
                                        (kMetal.ktc * (feed.across_mm + feed.down_mm) + kMetal.kte));
    if (off > 0.005 * largest + 0.1 + 2 * slice_n)
        RC_FAIL(std::string(kCutterKindWords[static_cast<std::size_t>(c.kind)]) + " off by " +
                std::to_string(off) + " of " + std::to_string(largest) + " N");
}

RC_GTEST_PROP(ProfileForce, of_a_taper_is_that_of_thin_slices, ()) {
    Cutter c = any_profile(CutterKind::taper);
    c.helix_deg = drawn(-40, 40);
    c.flutes = *rc::gen::inRange(1, 5);
    force_is_that_of_slices(c, 4000);
}

RC_GTEST_PROP(ProfileForce, of_every_kind_is_that_of_thin_slices, ()) {
    Cutter c = any_profile();
    c.helix_deg = drawn(-40, 40);
    force_is_that_of_slices(c, 1000);
}

// The mean torque of the shear coefficient alone is ktc times the volume of the chips of a turn, over 2 pi.
RC_GTEST_PROP(ProfileForce, does_the_work_of_its_chips, ()) {
    Cutter c = any_profile();
    c.helix_deg = drawn(-40, 40);
    c.flutes = *rc::gen::inRange(1, 5);
    if (*rc::gen::inRange(0, 3) == 0) c.runout_mm = drawn(0, 0.02);
    const bool turns = *rc::gen::inRange(0, 3) == 0;
    const ToolTravel feed{drawn(0, 0.1), drawn(-0.02, 0.05), turns ? drawn(-1e-3, 1e-3) : 0,
                          turns ? drawn(-1e-3, 1e-3) : 0};
    Engagement engagement;
    engagement.bands = {some_band(c)};
    const double entry = drawn(0, 3);
    const bool up = *rc::gen::inRange(0, 2) == 0;
    engagement.bottom = {{0.2 * c.radius_mm(), 0.7 * c.radius_mm(), entry, entry + 2, 0.3, up}};
    ForceModel model(c, {.ktc = 1000});
    model.engage(engagement, feed);
    const double turn_mm3 = chip_mm3(c, engagement, static_cast<double>(c.flutes) * feed);
    const double work = model.mean().torque_nmm * 2 * math::kPi;
    // Where the tool rises, little is cut of what its travels across and along the axis would cut alone.
    const auto flutes = static_cast<double>(c.flutes);
    const double size_mm3 = chip_mm3(c, engagement, flutes * ToolTravel{feed.across_mm}) +
                            chip_mm3(c, engagement, flutes * ToolTravel{0, std::abs(feed.down_mm)});
    RC_ASSERT(std::abs(work - 1000 * turn_mm3) < 0.005 * 1000 * std::max(turn_mm3, size_mm3) + 0.01);
}

// The spectrum is that of the force over a turn: its parts add up to it away from the jumps of the edges.
RC_GTEST_PROP(ProfileForce, spectrum_is_that_of_the_force_over_a_turn, ()) {
    Cutter c = any_profile();
    c.helix_deg = drawn(10, 40);
    c.flutes = 2;
    Engagement engagement;
    engagement.bands = {some_band(c)};
    const ToolTravel feed{.across_mm = 0.05};
    ForceModel model(c, kMetal);
    model.engage(engagement, feed);
    contact::ForceSpectrum spectrum;
    model.spectrum(4, spectrum);
    if (spectrum.harmonics.empty()) return;
    // Harmonics of the force at 2,048 places of a tooth period.
    constexpr int kPlaces = 2048;
    const double period = math::kPi;
    for (const int order : {0, 1, 3}) {
        double re = 0, im = 0, size = 0;
        for (int n = 0; n < kPlaces; ++n) {
            const double theta = period * (n + 0.5) / kPlaces, fx = model.at(theta).force_n.x;
            re += fx * std::cos(2 * order * theta) / kPlaces;
            im -= fx * std::sin(2 * order * theta) / kPlaces;
            size += std::abs(fx) / kPlaces;
        }
        const auto& h = spectrum.harmonics[static_cast<std::size_t>(order)].x;
        RC_ASSERT(std::abs(h.real() - re) < 0.003 * size + 1e-3);
        RC_ASSERT(std::abs(h.imag() - im) < 0.003 * size + 1e-3);
    }
}

RC_GTEST_PROP(ProfileForce, peaks_are_those_of_the_force_over_a_turn, ()) {
    Cutter c = any_profile();
    c.helix_deg = drawn(5, 40);
    Engagement engagement;
    engagement.bands = {some_band(c)};
    ForceModel model(c, kMetal);
    model.engage(engagement, {.across_mm = 0.05, .down_mm = 0.01});
    const ForcePeaks peaks = model.peaks();
    double most = 0;
    for (int n = 0; n < 1500; ++n) most = std::max(most, length(model.at(2 * math::kPi * n / 1500).force_n));
    RC_ASSERT(std::abs(peaks.peak_force_n - most) < 0.004 * most + 1e-3);
}

}  // namespace
}  // namespace tribo::milling
