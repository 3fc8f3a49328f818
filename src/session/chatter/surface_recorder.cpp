// SPDX-License-Identifier: MIT
#include "session/chatter/surface_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math.hpp"
#include "dynamics/step/cubic_weights.hpp"
#include "dynamics/step/spindle_turn.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/cutter_profile.hpp"
#include "milling/tool/tooth_phases.hpp"

namespace tribo::session {
namespace {

// From one height to the next: the phase of the fastest mode, the angle of a rounded profile, the length of
// the profile; and the number of heights in a band.
constexpr double kPhaseStepRad = 0.8, kKappaStepRad = 0.3, kLongestMm = 2;
constexpr int kMostHeights = 16;
// A band whose end is nearer to the end of a cut makes the surface there.
constexpr double kAtEndRad = 1e-3;
// Traces whose ends are nearer continue each other.
constexpr double kJoinMm = 0.1;
// Beyond a passage, so that rounding does not find it again.
constexpr double kBeyondRad = 1e-9;
// Of a row, to each side: the feed's direction at a place.
constexpr double kDirectionShare = 0.02;

}  // namespace

SurfaceRecorder::SurfaceRecorder(const MillSetup& setup) : setup_(setup), schedule_(schedule_of(setup)) {
    for (const auto& modes : setup.modes_of_cutter)
        for (const dynamics::Mode& mode : modes)
            fastest_rad_per_s_ = std::max(fastest_rad_per_s_, math::kTwoPi * mode.frequency_hz);
    for (const milling::Cutter& cutter : setup.cutters)
        phases_rad_.push_back(milling::tooth_phases_rad(cutter));
}

double SurfaceRecorder::estimated_bytes(const MillSetup& setup) {
    constexpr double kMarkBytes = 65, kMarksPerTooth = 4;
    double teeth = 0;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        if (setup.moves[n].kind != motion::MoveKind::feed) continue;
        const motion::MoveTiming& timing = setup.schedule->moves[n];
        teeth += (timing.end_s - timing.start_s) * setup.rpm_of_move[n] / 60 *
                 setup.cutters[setup.cutter_of_move[n]].flutes;
    }
    return kMarkBytes * std::min(kMarksPerTooth * teeth, static_cast<double>(kMostMarks));
}

Warning SurfaceRecorder::full_warning(const std::string& program_file, int line) {
    return {program_file, line,
            "from here on no marks of teeth are kept: there are " + std::to_string(kMostMarks) + " before"};
}

SurfaceRecorder::Place SurfaceRecorder::place(const milling::CutRow& row, double t_s) const {
    const double step_s = kDirectionShare * row.duration_s();
    const auto pose = [&](double at_s) { return motion::pose_at_time(setup_.moves, *schedule_, at_s); };
    const motion::ToolPose here = pose(t_s);
    const Vec3 way =
        pose(std::min(t_s + step_s, row.end_s)).tip_mm - pose(std::max(t_s - step_s, row.start_s)).tip_mm;
    return {here.tip_mm, milling::tool_frame(here.axis, way, row.pose.frame.x)};
}

// Where short moves share the row, their corners cut into each other: the middle of the longest one.
double SurfaceRecorder::inner_s(const milling::CutRow& row) const {
    double middle_s = 0.5 * (row.start_s + row.end_s), longest_s = 0;
    const std::vector<motion::MoveTiming>& moves = schedule_->moves;
    for (std::size_t n = schedule_->move_at(row.start_s); n < moves.size(); ++n) {
        const double from_s = std::max(row.start_s, moves[n].start_s),
                     to_s = std::min(row.end_s, moves[n].end_s);
        if (moves[n].start_s >= row.end_s) break;
        if (to_s - from_s <= longest_s) continue;
        longest_s = to_s - from_s;
        middle_s = 0.5 * (from_s + to_s);
    }
    return middle_s;
}

void SurfaceRecorder::begin(const milling::CutRow& row, std::span<const milling::EngagementBand> bands,
                            const milling::ToolFrame& frame, double rotation_rad, double t_s) {
    count_ = 0;
    if (full_at_line_) return;
    if (record_.marks.size() >= kMostMarks) {
        full_at_line_ = row.line;
        return;
    }
    cutter_ = row.cutter;
    feed_rad_ = math::atan2(dot(row.pose.frame.x, frame.y), dot(row.pose.frame.x, frame.x));
    row_rad_ = row.spindle_rad_per_s() * row.duration_s();
    begin_rad_ = rotation_rad - row.spindle_rad_per_s() * (t_s - row.start_s);
    const std::array<Place, 3> places{place(row, row.start_s), place(row, inner_s(row)),
                                      place(row, row.end_s)};
    for (const milling::EngagementBand& band : bands) watch(row, band, places);
    next_rad_ = std::numeric_limits<double>::max();
    // The samples that wait for their successors belong to this row too.
    const double after = samples_ == 4 ? last_[2].rotation_rad : rotation_rad;
    for (std::size_t n = 0; n < count_; ++n) {
        find_next(watches_[n], after);
        next_rad_ = std::min(next_rad_, watches_[n].next_rad);
    }
}

// Adds a watch for each height of a band that makes a surface.
void SurfaceRecorder::watch(const milling::CutRow& row, const milling::EngagementBand& band,
                            const std::array<Place, 3>& places) {
    const milling::Cutter& cutter = setup_.cutters[row.cutter];
    const milling::CutterProfile profile(cutter);
    const double from = profile.at_height(band.z0_mm), size = profile.at_height(band.z1_mm) - from;
    if (!(size > 0)) return;
    const double corner = cutter.corner_radius_mm();
    const double lag = std::abs(cutter.lag_rad(band.z1_mm) - cutter.lag_rad(band.z0_mm));
    double heights =
        std::max(size / kLongestMm, lag * fastest_rad_per_s_ / (row.spindle_rad_per_s() * kPhaseStepRad));
    if (band.z0_mm < corner) heights = std::max(heights, size / (corner * kKappaStepRad));
    const int count = std::clamp(static_cast<int>(std::ceil(heights)), 1, kMostHeights);
    for (int n = 0; n < 2 * count; ++n) {
        const int side = n % 2, height = n / 2;
        const milling::ProfilePoint at = profile.at(from + size * (height + 0.5) / count);
        const milling::TurnWindow cut = milling::window_above(milling::normal_travel(row.feed, at), 0);
        if (cut.empty()) continue;
        // The end of a window may lie in the second turn, as the band is in the first.
        const double end_rad = side == 0 ? cut.from_rad : cut.to_rad;
        const double off =
            std::remainder((side == 0 ? band.entry_rad : band.exit_rad) - end_rad, math::kTwoPi);
        if (std::abs(off) > kAtEndRad) continue;
        if (count_ == watches_.size()) watches_.emplace_back();
        Watch& w = watches_[count_++];
        w.side = side;
        w.height_mm = at.height_mm;
        w.angle_rad = end_rad - feed_rad_ + cutter.lag_rad(at.height_mm);
        double sine, cosine;
        math::sincos(end_rad - feed_rad_, sine, cosine);
        w.normal = {at.sin_kappa * sine, at.sin_kappa * cosine, -at.cos_kappa};
        math::sincos(end_rad, sine, cosine);
        const auto on_surface = [&](const Place& p) {
            return p.tip_mm + p.frame.in_stock({at.radius_mm * sine, at.radius_mm * cosine, at.height_mm});
        };
        w.trace = {};
        w.trace.from_mm = on_surface(places[0]);
        w.trace.inner_mm = on_surface(places[1]);
        w.trace.to_mm = on_surface(places[2]);
        w.trace.normal =
            -row.pose.frame.in_stock({at.sin_kappa * sine, at.sin_kappa * cosine, -at.cos_kappa});
        w.trace.arc_mm = at.radius_mm / std::max(at.sin_kappa, 1e-6);
        w.trace.width_mm = size / count;
        w.trace.start_s = row.start_s;
        w.trace.end_s = row.end_s;
        w.trace.line = row.line;
        w.marks.clear();
    }
}

void SurfaceRecorder::find_next(Watch& w, double after_rad) const {
    double least = std::numeric_limits<double>::max();
    const std::vector<double>& phases = phases_rad_[cutter_];
    for (std::size_t tooth = 0; tooth < phases.size(); ++tooth) {
        const double ahead = dynamics::in_turn(w.angle_rad - phases[tooth] - after_rad);
        if (ahead >= least) continue;
        least = ahead;
        w.next_tooth = tooth;
    }
    w.next_rad = after_rad + least;
}

void SurfaceRecorder::add(double rotation_rad, Vec3 displacement_mm) {
    std::shift_left(last_.begin(), last_.end(), 1);
    last_[3] = {rotation_rad, displacement_mm};
    if (samples_ < 4) ++samples_;
    if (samples_ < 4 || count_ == 0 || next_rad_ > last_[2].rotation_rad) return;
    next_rad_ = std::numeric_limits<double>::max();
    for (std::size_t n = 0; n < count_; ++n) {
        Watch& w = watches_[n];
        while (w.next_rad <= last_[2].rotation_rad) {
            mark(w, displacement_at(w.next_rad));
            find_next(w, w.next_rad + kBeyondRad);
        }
        next_rad_ = std::min(next_rad_, w.next_rad);
    }
}

void SurfaceRecorder::add_steady(const milling::CutRow& row, double period_rad,
                                 const Displacement& displacement_mm) {
    begin(row, row.engagement.bands, row.pose.frame, row.phase_rad, row.start_s);
    const double lasts_rad = std::min(row_rad_, period_rad);
    const double from_rad = begin_rad_ + 0.5 * (row_rad_ - lasts_rad);
    for (std::size_t n = 0; n < count_; ++n) {
        Watch& w = watches_[n];
        for (find_next(w, from_rad); w.next_rad < from_rad + lasts_rad; find_next(w, w.next_rad + kBeyondRad))
            mark(w, displacement_mm(w.next_rad, w.height_mm));
    }
    end();
}

// By a cubic through the samples.
Vec3 SurfaceRecorder::displacement_at(double rotation_rad) const {
    const double t = (rotation_rad - last_[1].rotation_rad) / (last_[2].rotation_rad - last_[1].rotation_rad);
    const std::array<double, 4> weights = dynamics::cubic_weights(t);
    Vec3 displacement{};
    for (std::size_t k = 0; k < 4; ++k) displacement += weights[k] * last_[k].displacement_mm;
    return displacement;
}

void SurfaceRecorder::mark(Watch& w, Vec3 displacement_mm) {
    double displaced = -dot(displacement_mm, w.normal);
    const milling::Cutter& cutter = setup_.cutters[cutter_];
    if (cutter.runout_mm != 0) {
        double farthest = -cutter.runout_mm, own = 0;
        const std::vector<double>& phases = phases_rad_[cutter_];
        for (std::size_t tooth = 0; tooth < phases.size(); ++tooth) {
            const double radius = cutter.runout_mm * math::cos(cutter.runout_deg * math::kRadPerDeg -
                                                               phases[tooth] + cutter.lag_rad(w.height_mm));
            farthest = std::max(farthest, radius);
            if (tooth == w.next_tooth) own = radius;
        }
        displaced += (farthest - own) * length(Vec3{w.normal.x, w.normal.y, 0});
    }
    const double at = std::clamp((w.next_rad - begin_rad_) / row_rad_, 0.0, 1.0);
    w.marks.push_back({static_cast<float>(at), static_cast<float>(displaced), 0});
}

bool SurfaceRecorder::continues(const Watch& w, const Watch& before) const {
    return w.side == before.side && before.trace.count > 0 &&
           distance(w.trace.from_mm, before.trace.to_mm) < kJoinMm;
}

void SurfaceRecorder::end() {
    for (std::size_t n = 0; n < count_; ++n) {
        Watch& w = watches_[n];
        if (w.marks.empty()) continue;
        double least = std::numeric_limits<double>::max();
        for (std::size_t m = 0; m < count_before_; ++m) {
            const Watch& b = before_[m];
            const double apart = std::abs(w.height_mm - b.height_mm);
            if (!continues(w, b) || apart >= least) continue;
            least = apart;
            w.trace.before = b.recorded_as;
        }
        w.trace.first = record_.marks.size();
        w.trace.count = w.marks.size();
        record_.marks.insert(record_.marks.end(), w.marks.begin(), w.marks.end());
        w.recorded_as = static_cast<std::uint32_t>(record_.traces.size());
        record_.traces.push_back(w.trace);
    }
    std::swap(watches_, before_);
    count_before_ = std::exchange(count_, 0);
}

void SurfaceRecorder::interrupt() {
    samples_ = 0;
    count_before_ = 0;
}

}  // namespace tribo::session
