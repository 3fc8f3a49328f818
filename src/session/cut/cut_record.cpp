// SPDX-License-Identifier: MIT
#include "session/cut/cut_record.hpp"

#include <cmath>

#include "base/hash.hpp"
#include "base/math.hpp"
#include "milling/force/force.hpp"
#include "session/cut/pose_hash.hpp"

namespace tribo::session {
namespace {

// Number of shares of the work. Each share has its own force models.
constexpr std::size_t kShares = 8;

}  // namespace

std::vector<milling::Cutter> changed_cutters(const MillSetup& setup, const CutChange& change) {
    std::vector<milling::Cutter> cutters = setup.cutters;
    if (change.helix_deg) {
        for (milling::Cutter& cutter : cutters) cutter.helix_deg = *change.helix_deg;
    }
    return cutters;
}

ForceBand force_band(const MillSetup& setup, const CutChange& change) {
    if (change.coefficients) return {change.force_low_factor, change.force_high_factor};
    return {setup.force_low_factor, setup.force_high_factor};
}

milling::CutRow changed_row(milling::CutRow row, const CutChange& change) {
    row.spindle_rpm *= change.speed_factor;
    row.feed = change.chip_factor() * row.feed;
    return row;
}

double changed_phase_rad(const milling::CutRow& row, const CutChange& change) {
    const double factor = change.angle_factor();
    if (factor == 1) return row.phase_rad;
    const double turns = factor * (row.phase_turns + row.phase_rad / math::kTwoPi);
    return math::kTwoPi * (turns - std::floor(turns));
}

namespace {

// Calls visit(n, row, engaged model) for the rows, distributed over the threads.
template <class Visit>
void each_engaged(std::span<const milling::CutRow> rows, const MillSetup& setup, const CutChange& change,
                  const ParallelFor& parallel, const Visit& visit) {
    const std::vector<milling::Cutter> cutters = changed_cutters(setup, change);
    const milling::CuttingCoefficients coefficients = change.coefficients.value_or(setup.coefficients);
    parallel(kShares, [&](std::size_t share) {
        std::vector<milling::ForceModel> models;
        models.reserve(cutters.size());
        for (const milling::Cutter& cutter : cutters) models.emplace_back(cutter, coefficients);
        const std::size_t last = rows.size() * (share + 1) / kShares;
        for (std::size_t n = rows.size() * share / kShares; n < last; ++n) {
            const milling::CutRow& row = rows[n];
            milling::ForceModel& model = models[row.cutter];
            model.engage(row.engagement, change.chip_factor() * row.feed);
            visit(n, row, model);
        }
    });
}

}  // namespace

std::vector<contact::ForceStretch> force_stretches(std::span<const milling::CutRow> rows,
                                                   const MillSetup& setup, const CutChange& change,
                                                   const ParallelFor& parallel) {
    const double per_second = 1 / change.feed_factor;
    std::vector<contact::ForceStretch> out(rows.size());
    const auto visit = [&](std::size_t n, const milling::CutRow& row, milling::ForceModel& model) {
        contact::ForceStretch& s = out[n];
        model.spectrum(setup.harmonics, s.spectrum);
        s.start_s = per_second * row.start_s;
        s.end_s = per_second * row.end_s;
        s.rate_rad_per_s = change.speed_factor * row.spindle_rpm / 60 * math::kTwoPi;
        s.phase_rad = changed_phase_rad(row, change);
        s.x = row.pose.frame.x;
        s.y = row.pose.frame.y;
        s.z = row.pose.frame.z;
    };
    each_engaged(rows, setup, change, parallel, visit);
    return out;
}

std::vector<milling::RowForce> changed_forces(std::span<const milling::CutRow> rows, const MillSetup& setup,
                                              const CutChange& change, std::size_t spectra_from,
                                              const ParallelFor& parallel) {
    std::vector<milling::RowForce> out(rows.size());
    const auto visit = [&](std::size_t n, const milling::CutRow& row, milling::ForceModel& model) {
        out[n].peaks = model.peaks();
        out[n].edge_torque_nmm = model.edges().mean_edge_torque_nmm();
        out[n].chip_mm = milling::thickest_chip_mm(row.engagement, change.chip_factor() * row.feed,
                                                   setup.cutters[row.cutter]);
        if (n >= spectra_from) model.spectrum(setup.harmonics, out[n].spectrum);
    };
    each_engaged(rows, setup, change, parallel, visit);
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
        for (const milling::ProfileVertex& v : c.profile) {
            for (const double value : {v.r_mm, v.z_mm, v.bulge}) hash.add(value);
        }
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
        hash.add(hash_of_cutters(cuts.cutters));
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
