// SPDX-License-Identifier: MIT
#include "session/live/live_cut.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {
namespace {

// Rows in one slice of a pass: about three milliseconds on one thread. In cases, a row is as much work as
// there are cases.
constexpr std::size_t kRowsPerSlice = 256;
// Known rows whose changed forces are computed at one time, from the clock on.
constexpr std::size_t kFreshAtOnce = 1024;
// Rows in one frame, and frames at one time: a viewer can process them without a stutter.
constexpr std::size_t kRowsPerFrame = 4096, kMostFrames = 2;

// Returns the data of a row that the sound needs, with its spectrum.
protocol::LiveSoundPiece live_sound_piece(const milling::CutRow& row, const contact::ForceSpectrum& spectrum,
                                          int edges, const CutChange& change) {
    protocol::LiveSoundPiece piece;
    piece.t_s = row.start_s;
    piece.duration_s = static_cast<float>(row.duration_s());
    for (int axis = 0; axis < 3; ++axis)
        piece.tip_mm[static_cast<std::size_t>(axis)] = static_cast<float>(row.pose.tip_mm[axis]);
    piece.spindle_angle_rad = static_cast<float>(std::fmod(changed_phase_rad(row, change), math::kTwoPi));
    piece.spindle_rad_per_s = static_cast<float>(change.speed_factor * row.spindle_rpm / 60 * math::kTwoPi);
    piece.pace = static_cast<float>(change.feed_factor);
    piece.chip_mm3_per_s = static_cast<float>(change.feed_factor * row.chip_mm3_per_s());
    piece.order_step = spectrum.order_step;
    for (const contact::ForceHarmonic& h : spectrum.harmonics)
        piece.harmonics.push_back(
            {std::complex<float>(h.x), std::complex<float>(h.y), std::complex<float>(h.z)});
    piece.edges = edges;
    piece.mean_torque_nmm = static_cast<float>(mean_force(spectrum).torque_nmm);
    return piece;
}

// Returns the cut of a row as a vibration needs it.
protocol::LiveTeeth live_teeth(const milling::CutRow& row, const MillSetup& setup, const CutChange& change) {
    protocol::LiveTeeth teeth;
    teeth.cutter = static_cast<std::uint32_t>(row.cutter);
    teeth.feed = to_float(row.pose.frame.x);
    teeth.head = to_float(head_frame(row, setup).x);
    teeth.axis = to_float(row.pose.frame.z);
    const milling::ToolTravel travel = change.chip_factor() * row.feed;
    teeth.across_mm = static_cast<float>(travel.across_mm);
    teeth.down_mm = static_cast<float>(travel.down_mm);
    teeth.turn_x_rad = static_cast<float>(travel.turn_x_rad);
    teeth.turn_y_rad = static_cast<float>(travel.turn_y_rad);
    for (const milling::EngagementBand& band : with_fewer_bands(row.engagement.bands, kRowBands))
        teeth.bands.push_back({static_cast<float>(band.z0_mm), static_cast<float>(band.z1_mm),
                               static_cast<float>(band.entry_rad), static_cast<float>(band.exit_rad)});
    return teeth;
}

}  // namespace

void LiveCut::begin(const MillSetup& setup, bool bends) {
    setup_ = &setup;
    bends_ = bends;
    use_cases();
    record_ = {};
    rows_.clear();
    states_.clear();
    sound_.pieces.clear();
    sent_ = fresh_ = heard_ = hear_next_ = hear_end_ = known_ = 0;
    anew_ = outdated_ = passing_ = false;
    times_anew_ = 0;
}

void LiveCut::add(const milling::CutRow& row, const milling::RowForce& force) {
    const milling::EngagementHull hull = milling::hull(row.engagement);
    protocol::LiveRow told;
    told.t_s = row.start_s;
    told.end_s = row.end_s;
    told.tip_mm = row.pose.tip_mm;
    told.axis = row.pose.frame.z;
    told.cutter = static_cast<std::uint32_t>(row.cutter);
    told.entry_rad = hull.entry_rad;
    told.exit_rad = hull.exit_rad;
    told.axial_depth_mm = hull.axial_depth_mm;
    told.line = static_cast<std::uint32_t>(row.line);
    rows_.push_back(told);
    const double before = states_.empty() ? 0 : states_.back().removed_mm3;
    states_.push_back({{}, before + row.removed_mm3});
    record_.add(row);
    if (!change_.none() || cases_ || fresh_ + 1 < rows_.size()) return;
    set_force(fresh_++, force, change_);
}

std::size_t LiveCut::row_at(double t_s) const {
    const auto after = std::upper_bound(rows_.begin(), rows_.end(), t_s,
                                        [](double t, const protocol::LiveRow& row) { return t < row.t_s; });
    return after == rows_.begin() ? 0 : static_cast<std::size_t>(after - rows_.begin()) - 1;
}

std::optional<std::size_t> LiveCut::row_cut_at(double t_s) const {
    if (rows_.empty() || t_s < rows_.front().t_s) return std::nullopt;
    const std::size_t row = row_at(t_s);
    return t_s <= rows_[row].end_s ? std::optional(row) : std::nullopt;
}

void LiveCut::set_change(const CutChange& change, double clock_s) {
    change_ = change;
    use_cases();
    clock_row_ = row_at(clock_s);
    fresh_ = std::min(fresh_, clock_row_);
    known_ = rows_.size();
    hear_from(clock_s);
    outdated_ = !rows_.empty();
}

void LiveCut::hear_from(double t_s) {
    sound_.pieces.clear();
    const std::size_t row = row_at(t_s);
    hear_next_ = row + (!rows_.empty() && rows_[row].end_s <= t_s ? 1 : 0);
    heard_ = hear_end_ = rows_.size();
}

void LiveCut::hear_to(double t_s) {
    std::size_t last = hear_next_;
    while (last < hear_end_ && rows_[last].t_s < t_s) ++last;
    if (last == hear_next_) return;
    compute(hear_next_, last, change_, hear_next_);
    hear_next_ = last;
}

void LiveCut::compute_new() {
    if (fresh_ == rows_.size()) return;
    // Rows far ahead of the clock wait.
    const std::size_t last = fresh_ < known_ ? std::min(fresh_ + kFreshAtOnce, known_) : rows_.size();
    compute(fresh_, last, change_, heard_);
    fresh_ = last;
}

void LiveCut::compute_slice() {
    if (!passing_) {
        if (!outdated_ || rest_s_ > 0) return;
        outdated_ = false;
        passing_ = true;
        pass_next_ = 0;
        pass_end_ = clock_row_;
        pass_change_ = change_;
    }
    const std::size_t slice = std::max<std::size_t>(1, kRowsPerSlice / (1 + pass_change_.uncertain_cases));
    const std::size_t last = std::min(pass_next_ + slice, pass_end_);
    compute(pass_next_, last, pass_change_, last);
    pass_next_ = last;
    if (pass_next_ < pass_end_) return;
    passing_ = false;
    rest_s_ = kRestS;
    sent_ = 0;
    anew_ = true;
    ++times_anew_;
}

void LiveCut::compute(std::size_t first, std::size_t last, const CutChange& change, std::size_t first_heard) {
    const auto forces = changed_forces(record_.rows().subspan(first, last - first), *setup_, change,
                                       std::max(first, first_heard) - first, parallel_);
    for (std::size_t n = first; n < last; ++n) {
        set_force(n, forces[n - first], change);
        set_band(n, forces[n - first].peaks, change);
    }
}

void LiveCut::use_cases() {
    cases_.reset();
    if (change_.uncertain_cases > 0) cases_.emplace(*setup_, change_.uncertain_cases, parallel_, change_);
}

void LiveCut::set_band(std::size_t n, const milling::ForcePeaks& peaks, const CutChange& change) {
    rows_[n].force_low_factor = rows_[n].force_high_factor = 0;
    if (!cases_ || !(peaks.peak_force_n > 0)) return;
    cases_->peaks(changed_row(record_.rows()[n], change), peaks);
    const sweep::Band band = cases_->peak_force_n();
    rows_[n].force_low_factor = band.low / peaks.peak_force_n;
    rows_[n].force_high_factor = band.high / peaks.peak_force_n;
}

// Sets the values that depend on the force of a row. The row gets sound only if there is a spectrum.
void LiveCut::set_force(std::size_t n, const milling::RowForce& force, const CutChange& change) {
    const milling::CutRow& cut = record_.rows()[n];
    protocol::LiveRow& row = rows_[n];
    states_[n].force_n = cut.pose.frame.in_stock(force.peaks.mean_n);
    row.mean_force_n = length(states_[n].force_n);
    row.peak_force_n = force.peaks.peak_force_n;
    row.mean_torque_nm = 1e-3 * force.peaks.mean_torque_nmm;
    row.spindle_rpm = change.speed_factor * cut.spindle_rpm;
    row.feed_per_tooth_mm = change.chip_factor() * cut.feed.across_mm;
    const milling::Cutter& cutter = setup_->cutters[cut.cutter];
    row.chip_mm = force.chip_mm;
    row.chip_verdict = static_cast<std::uint32_t>(milling::chip_verdict(force.chip_mm, cutter));
    if (force.spectrum.empty()) return;
    sound_.pieces.push_back(live_sound_piece(cut, force.spectrum, cutter.flutes, change));
    if (bends_) sound_.pieces.back().teeth = live_teeth(cut, *setup_, change);
}

void LiveCut::describe(protocol::LiveState& s) const {
    if (rows_.empty() || s.t_s < rows_.front().t_s) return;
    const std::size_t row = row_at(s.t_s);
    s.removed_mm3 = states_[row].removed_mm3;
    if (s.t_s > rows_[row].end_s) return;
    const milling::CutRow& cut = record_.rows()[row];
    s.cutting = true;
    s.force_n = states_[row].force_n;
    s.peak_force_n = rows_[row].peak_force_n;
    s.mean_torque_nm = rows_[row].mean_torque_nm;
    const double written_rad_per_s = change_.angle_factor() * cut.spindle_rad_per_s();
    s.spindle_angle_rad = changed_phase_rad(cut, change_) + written_rad_per_s * (s.t_s - cut.start_s);
}

void LiveCut::show_rows(const protocol::FrameSink& frames) {
    std::vector<std::uint8_t> frame;
    const auto [low, high] = force_band(*setup_, change_);
    for (std::size_t n = 0; n < kMostFrames && sent_ < fresh_; ++n) {
        const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(sent_);
        const std::size_t now = std::min(kRowsPerFrame, fresh_ - sent_);
        protocol::write_frame(
            protocol::LiveRows{
                std::exchange(anew_, false), {first, first + static_cast<std::ptrdiff_t>(now)}, low, high},
            frame);
        frames(frame);
        sent_ += now;
    }
}

protocol::LiveSoundPieces LiveCut::take_sound() {
    return std::exchange(sound_, {});
}

}  // namespace tribo::session
