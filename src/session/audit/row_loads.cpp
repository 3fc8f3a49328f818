// SPDX-License-Identifier: MIT
#include "session/audit/row_loads.hpp"

#include <cmath>
#include <utility>

#include "milling/engagement/load_height.hpp"

namespace tribo::session {

LoadModel::LoadModel(const MillSetup& setup, CutLimits limits)
    : limits_(std::move(limits)), force_low_(setup.force_low_factor), force_high_(setup.force_high_factor) {
    for (const milling::Cutter& cutter : setup.cutters) beams_.push_back(dynamics::tool_beam(cutter));
}

RowLoads LoadModel::loads(const milling::CutRow& row, const milling::ForcePeaks& peaks,
                          double chip_mm) const {
    constexpr double kMetres = 1e-3;
    const ToolLimits& limits = limits_.of_cutter[row.cutter];
    const dynamics::BendingByForce bending =
        dynamics::bending_by_force(beams_[row.cutter], milling::load_height_mm(row.engagement));
    RowLoads loads;
    const auto set = [&](LoadKind kind, double value, double limit) {
        loads.value[index_of(kind)] = value;
        if (limit > 0) loads.ratio[index_of(kind)] = value / limit;
    };
    const auto limit_of = [&](LoadKind kind) { return limits.of(kind) ? limits.of(kind)->value : 0; };
    double torque_nm = limit_of(LoadKind::torque), power_w = limit_of(LoadKind::power);
    if (!limits_.spindle.empty()) {
        const job::SpindlePoint spindle = spindle_at(limits_.spindle, row.spindle_rpm);
        torque_nm = spindle.torque_nm;
        power_w = spindle.power_w;
    }
    set(LoadKind::force, peaks.peak_force_n, limit_of(LoadKind::force));
    set(LoadKind::torque, kMetres * std::abs(peaks.peak_torque_nmm), torque_nm);
    set(LoadKind::power, kMetres * peaks.mean_torque_nmm * row.spindle_rad_per_s(), power_w);
    set(LoadKind::stress, bending.stress_per_mm2 * peaks.peak_xy_n, limit_of(LoadKind::stress));
    set(LoadKind::deflection, bending.yield_mm * peaks.peak_xy_n, limit_of(LoadKind::deflection));
    set(LoadKind::chip, chip_mm, limit_of(LoadKind::chip));
    return loads;
}

void LoadModel::add_multiplier(std::size_t cutter, double multiplier, RowLoads& loads) const {
    const std::optional<CutLimit>& limit = limits_.of_cutter[cutter].of(LoadKind::multiplier);
    loads.value[index_of(LoadKind::multiplier)] = multiplier;
    if (limit) loads.ratio[index_of(LoadKind::multiplier)] = multiplier / limit->value;
}

RatioBand LoadModel::band(std::size_t cutter, LoadKind kind, double ratio) const {
    if (!follows_force(kind)) return with_limit(cutter, kind, {ratio, ratio, ratio});
    return with_limit(cutter, kind, {force_low_ * ratio, ratio, force_high_ * ratio});
}

RatioBand LoadModel::with_limit(std::size_t cutter, LoadKind kind, RatioBand ratio) const {
    const std::optional<CutLimit>& limit = limits_.of_cutter[cutter].of(kind);
    if (limit && limit->value > 0) {
        ratio.low *= limit->value / limit->high;
        ratio.high *= limit->value / limit->low;
    }
    return ratio;
}

}  // namespace tribo::session
