// SPDX-License-Identifier: MIT
#include "session/cut/cut_record.hpp"

#include <cmath>

#include "base/hash.hpp"
#include "base/math.hpp"
#include "milling/force/force.hpp"

namespace tribo::session {
namespace {

// Shares of the work, each with force models of its own.
constexpr std::size_t kShares = 8;

void add(Hash& hash, const motion::ToolPose& pose) {
    hash.add(pose.tip_mm);
    hash.add(pose.axis);
}

}  // namespace

void CutRecord::add(const MillRow& row) {
    stretches_.push_back({row.values.t_s, row.end_s, row.spindle_angle_rad, row.spindle_turns,
                          row.values.spindle_rpm, row.values.tip_mm, row.frame, row.feed, row.cutter,
                          row.engagement, row.chip_mm3_per_s});
}

double changed_phase_rad(const CutStretch& stretch, const CutChange& change) {
    const double factor = change.angle_factor();
    if (factor == 1) return stretch.phase_rad;
    const double turns = factor * (stretch.turns + stretch.phase_rad / math::kTwoPi);
    return math::kTwoPi * (turns - std::floor(turns));
}

namespace {

// Calls visit(n, stretch, engaged model) for the stretches, shared among threads.
template <class Visit>
void each_engaged(std::span<const CutStretch> stretches, const MillSetup& setup, const CutChange& change,
                  const ParallelFor& parallel, const Visit& visit) {
    std::vector<milling::Cutter> cutters = setup.cutters;
    if (change.helix_deg) {
        for (milling::Cutter& cutter : cutters) cutter.helix_deg = *change.helix_deg;
    }
    const milling::CuttingCoefficients coefficients = change.coefficients.value_or(setup.coefficients);
    parallel(kShares, [&](std::size_t share) {
        std::vector<milling::ForceModel> models;
        for (const milling::Cutter& cutter : cutters) models.emplace_back(cutter, coefficients);
        const std::size_t last = stretches.size() * (share + 1) / kShares;
        for (std::size_t n = stretches.size() * share / kShares; n < last; ++n) {
            const CutStretch& s = stretches[n];
            milling::ForceModel& model = models[s.cutter];
            model.engage(s.engagement, change.chip_factor() * s.feed);
            visit(n, s, model);
        }
    });
}

}  // namespace

std::vector<contact::ForceStretch> force_stretches(std::span<const CutStretch> stretches,
                                                   const MillSetup& setup, const CutChange& change,
                                                   const ParallelFor& parallel) {
    const double per_second = 1 / change.feed_factor;
    std::vector<contact::ForceStretch> out(stretches.size());
    const auto visit = [&](std::size_t n, const CutStretch& row, milling::ForceModel& model) {
        contact::ForceStretch& s = out[n];
        model.spectrum(setup.harmonics, s.spectrum);
        s.start_s = per_second * row.start_s;
        s.end_s = per_second * row.end_s;
        s.rate_rad_per_s = change.speed_factor * row.spindle_rpm / 60 * math::kTwoPi;
        s.phase_rad = changed_phase_rad(row, change);
        s.x = row.frame.x;
        s.y = row.frame.y;
        s.z = row.frame.z;
    };
    each_engaged(stretches, setup, change, parallel, visit);
    return out;
}

std::vector<StretchForce> stretch_forces(const CutRecord& record, const MillSetup& setup,
                                         const CutChange& change, std::size_t first,
                                         const ParallelFor& parallel) {
    std::vector<StretchForce> out(record.stretches().size() - first);
    const auto visit = [&](std::size_t n, const CutStretch& row, milling::ForceModel& model) {
        const milling::ForcePeaks peaks = model.peaks();
        const milling::ToolFrame& f = row.frame;
        out[n] = {peaks.mean_n.x * f.x + peaks.mean_n.y * f.y + peaks.mean_n.z * f.z, peaks.peak_force_n,
                  1e-3 * peaks.mean_torque_nmm};
    };
    each_engaged(record.stretches().subspan(first), setup, change, parallel, visit);
    return out;
}

std::vector<contact::ForceSpectrum> stretch_spectra(const CutRecord& record, const MillSetup& setup,
                                                    const CutChange& change, std::size_t first,
                                                    std::size_t count) {
    std::vector<contact::ForceSpectrum> out(count);
    const auto visit = [&](std::size_t n, const CutStretch&, milling::ForceModel& model) {
        model.spectrum(setup.harmonics, out[n]);
    };
    each_engaged(record.stretches().subspan(first, count), setup, change, serial_for, visit);
    return out;
}

std::uint64_t bake_key(const MillSetup& setup, const contact::ForceTableOptions& options) {
    Hash hash;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const motion::Move& m = setup.moves[n];
        hash.add(static_cast<int>(m.kind));
        add(hash, m.start);
        add(hash, m.end);
        if (m.arc) {
            hash.add(m.arc->centre_mm);
            hash.add(m.arc->normal);
            hash.add(m.arc->turn_rad);
        }
        if (m.quadratic) {
            hash.add(m.quadratic->tip_control_mm);
            hash.add(m.quadratic->axis_control);
        }
        hash.add(m.feed_mm_per_min);
        hash.add(m.duration_s);
        hash.add(setup.rpm_of_move[n]);
        hash.add(setup.cutter_of_move[n]);
    }
    for (const milling::Cutter& c : setup.cutters) {
        hash.add(static_cast<int>(c.kind));
        hash.add(c.flutes);
        for (const double v :
             {c.diameter_mm, c.corner_mm, c.helix_deg, c.length_mm, c.runout_mm, c.runout_deg})
            hash.add(v);
        hash.add(c.pitch_deg);
    }
    const milling::CuttingCoefficients& k = setup.coefficients;
    for (const double v : {k.ktc, k.krc, k.kac, k.kte, k.kre, k.kae}) hash.add(v);
    if (setup.blank) {
        const Box3 box = setup.blank->bounds_mm();
        hash.add(box.min);
        hash.add(box.max);
    }
    hash.add(setup.blank_volume_mm3);
    for (const EarlierCuts& cuts : setup.earlier) {
        hash.add(hash_of_moves(cuts));
        hash.add(hash_of_cutters(cuts));
    }
    if (setup.engagement) {
        hash.add(setup.engagement->entry_rad);
        hash.add(setup.engagement->exit_rad);
        hash.add(setup.engagement->axial_depth_mm);
    }
    const motion::TimingOptions& t = setup.timing;
    for (const double v : {t.rapid_mm_per_min, t.acceleration_mm_per_s2, t.max_axis_rad_per_s,
                           t.corner_deviation_mm, t.stop_rad, setup.cell_mm, setup.until_s.value_or(-1)})
        hash.add(v);
    hash.add(setup.harmonics);
    const contact::JndProfile& p = options.profile;
    for (const double v : {p.force_magnitude, p.force_direction_rad, p.vibration_amplitude, p.force_floor_n,
                           p.vibration_floor_n, options.hand_per_tool, options.fastest_hz, options.most_jnd})
        hash.add(v);
    return hash.value();
}

}  // namespace tribo::session
