// SPDX-License-Identifier: MIT
#include "session/live/live_mill.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "base/math.hpp"
#include "motion/path/path.hpp"

namespace tribo::session {
namespace {

// Points along a curved move of the drawn path: one per millimetre, up to this number.
constexpr double kCurvePointMm = 1, kMostCurvePoints = 4;
// Rows in one frame: a viewer can process them without a stutter.
constexpr std::size_t kRowsPerFrame = 4096;
constexpr std::size_t kPiecesPerFrame = 64;
constexpr std::size_t kTrianglesPerFrame = 20'000;

protocol::LivePath path_of(const MillSession& session) {
    protocol::LivePath path;
    auto& points = path.points;
    const auto& moves = session.setup().moves;
    for (std::size_t n = 0; n < moves.size(); ++n) {
        const motion::Move& move = moves[n];
        if (move.kind == motion::MoveKind::dwell) continue;
        const motion::MoveTiming& timing = session.schedule().moves[n];
        const bool rapid = move.kind == motion::MoveKind::rapid;
        if (points.empty()) points.push_back({timing.start_s, move.start.tip_mm, rapid});
        const double wanted = std::ceil(motion::path_length_mm(move) / kCurvePointMm);
        const int count =
            move.arc || move.quadratic ? static_cast<int>(std::clamp(wanted, 1.0, kMostCurvePoints)) : 1;
        for (int k = 1; k <= count; ++k) {
            const double t = static_cast<double>(k) / count;
            points.push_back({timing.time_at_s(t), motion::pose_at(move, t).tip_mm, rapid});
        }
    }
    return path;
}

// Returns the box swept by the tool, up to its shank, between two times.
Box3 swept_box(const MillSession& session, double from_s, double to_s) {
    Box3 box;
    const MillSetup& setup = session.setup();
    const motion::Schedule& schedule = session.schedule();
    for (std::size_t n = schedule.move_at(from_s); n < setup.moves.size(); ++n) {
        if (schedule.moves[n].start_s >= to_s && n > schedule.move_at(from_s)) break;
        const motion::Move& move = setup.moves[n];
        const milling::Cutter& cutter = setup.cutters[setup.cutter_of_move[n]];
        Box3 path = motion::tip_bounds(move);
        for (const motion::ToolPose& pose : {move.start, move.end})
            path.include(pose.tip_mm + cutter.length_mm * pose.axis);
        box.include(path.inflated(cutter.radius_mm()));
    }
    return box;
}

protocol::LiveCutter live_cutter(const milling::Cutter& cutter) {
    protocol::LiveCutter told{
        cutter.number, cutter.flutes, cutter.radius_mm(), cutter.corner_radius_mm(), cutter.length_mm, {}};
    for (const milling::HolderStep& step : cutter.holder)
        told.holder.push_back({0.5 * step.diameter_mm, step.length_mm});
    return told;
}

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

}  // namespace

LiveMill::LiveMill(MakeSetup make_setup, ParallelFor parallel, LiveExtras extras)
    : make_setup_(std::move(make_setup)), parallel_(std::move(parallel)), extras_(std::move(extras)) {
    if (!extras_.designed) return;
    if (auto made = surface::DesignedSurface::make(*extras_.designed))
        compared_ = std::make_shared<const surface::DesignedSurface>(*std::move(made));
}

Result<std::unique_ptr<LiveMill>> LiveMill::create(MakeSetup make_setup, ParallelFor parallel,
                                                   LiveExtras extras) {
    std::unique_ptr<LiveMill> live(
        new LiveMill(std::move(make_setup), std::move(parallel), std::move(extras)));
    if (auto begun = live->begin(); !begun) return std::unexpected(begun.error());
    return live;
}

Result<void> LiveMill::begin() {
    auto setup = make_setup_();
    if (!setup && !session_) return std::unexpected(setup.error());
    input_error_ = setup ? std::nullopt : std::optional(setup.error());
    if (session_observer_) session_observer_(nullptr);
    picture_.reset();
    if (!setup) setup = session_->release_setup();
    session_.reset();  // before the next one: two of them need twice the memory
    session_ = std::make_unique<MillSession>(*std::move(setup), parallel_);
    picture_ = std::make_unique<PartPicture>(session_->stock(), parallel_, compared_);
    path_ = path_of(*session_);
    rows_.clear();
    row_states_.clear();
    record_ = {};
    sound_.pieces.clear();
    rows_sent_ = collisions_sent_ = 0;
    shown_s_ = 0;
    ++sessions_;
    begun_anew_ = true;
    set_back_ = false;
    if (session_observer_) session_observer_(session_.get());
    return {};
}

void LiveMill::set_session_observer(std::function<void(MillSession*)> observer) {
    session_observer_ = std::move(observer);
    if (session_observer_) session_observer_(session_.get());
}

void LiveMill::set_change(const CutChange& change) {
    change_ = change;
    // Rows before the clock are not heard any more.
    std::size_t heard = rows_.size();
    while (heard > 0 && rows_[heard - 1].end_s > clock_s_) --heard;
    sound_.pieces.clear();
    set_changed_forces(0, heard);
    rows_sent_ = 0;
    rows_anew_ = !rows_.empty();
    last_state_.clear();
}

void LiveMill::play(bool on) {
    if (on && clock_s_ >= duration_s()) set_clock(0);
    playing_ = on;
}

void LiveMill::set_speed(double seconds_per_second) {
    if (seconds_per_second > 0 && seconds_per_second <= kFastest) speed_ = seconds_per_second;
}

void LiveMill::set_clock(double t_s) {
    if (std::isnan(t_s)) return;
    clock_s_ = std::clamp(t_s, 0.0, duration_s());
    // Removed material does not come back: milling starts again.
    set_back_ = clock_s_ < session_->milled_s();
}

void LiveMill::add_row(const milling::CutRow& row) {
    const milling::EngagementHull hull = milling::hull(row.engagement);
    protocol::LiveRow told;
    told.t_s = row.start_s;
    told.end_s = row.end_s;
    told.tip_mm = row.pose.tip_mm;
    told.entry_rad = hull.entry_rad;
    told.exit_rad = hull.exit_rad;
    told.axial_depth_mm = hull.axial_depth_mm;
    told.line = static_cast<std::uint32_t>(row.line);
    rows_.push_back(told);
    const double before = row_states_.empty() ? 0 : row_states_.back().removed_mm3;
    row_states_.push_back({{}, before + row.removed_mm3});
    record_.add(row);
}

// Sets the values that depend on the force of a row. The row gets sound only if there is a spectrum.
void LiveMill::set_force(std::size_t n, const milling::RowForce& force) {
    const milling::CutRow& cut = record_.rows()[n];
    protocol::LiveRow& row = rows_[n];
    row_states_[n].force_n = cut.pose.frame.in_stock(force.peaks.mean_n);
    row.mean_force_n = length(row_states_[n].force_n);
    row.peak_force_n = force.peaks.peak_force_n;
    row.mean_torque_nm = 1e-3 * force.peaks.mean_torque_nmm;
    row.feed_per_tooth_mm = change_.chip_factor() * cut.feed.across_mm;
    const milling::Cutter& cutter = session_->setup().cutters[cut.cutter];
    row.chip_mm = force.chip_mm;
    row.chip_verdict = static_cast<std::uint32_t>(milling::chip_verdict(force.chip_mm, cutter));
    if (force.spectrum.empty()) return;
    sound_.pieces.push_back(live_sound_piece(cut, force.spectrum, cutter.flutes, change_));
}

void LiveMill::set_changed_forces(std::size_t first_row, std::size_t first_heard) {
    const auto forces = changed_forces(record_.rows().subspan(first_row), session_->setup(), change_,
                                       first_heard - first_row, parallel_);
    for (std::size_t n = first_row; n < rows_.size(); ++n) set_force(n, forces[n - first_row]);
}

void LiveMill::tick(double dt_s, const std::function<bool()>& has_time, const protocol::FrameSink& frames) {
    // With a session this cannot fail: it mills again what it milled before.
    if (set_back_) (void)begin();
    // The clock continues from the milled part.
    const double target = std::min(clock_s_ + pace() * dt_s, duration_s());
    const std::size_t rows_before = rows_.size();
    MillSinks sinks;
    sinks.row = [this](const milling::CutRow& row, const milling::RowForce& force) {
        add_row(row);
        if (change_.none()) set_force(rows_.size() - 1, force);
    };
    sinks.progress = [&](double) { return has_time(); };
    session_->run_to(target, sinks);
    if (!change_.none()) set_changed_forces(rows_before, rows_before);
    clock_s_ = playing_ ? std::min(target, std::max(clock_s_, session_->milled_s())) : clock_s_;
    if (clock_s_ >= duration_s()) playing_ = false;
    if (begun_anew_) {
        begun_anew_ = false;
        show_job(frames);
        show_part(picture_->all(), frames);
        // After the part, so that the first picture is not delayed on a slow connection.
        if (extras_.designed) show_designed(frames);
        protocol::write_frame(path_, frame_);
        frames(frame_);
        last_state_.clear();
    } else if (session_->milled_s() > shown_s_) {
        show_part(swept_box(*session_, shown_s_, session_->milled_s()), frames);
    }
    show_rows(frames);
    show_sound(frames);
    show_state(frames);
}

void LiveMill::show_job(const protocol::FrameSink& frames) {
    const MillSetup& setup = session_->setup();
    protocol::LiveJob job{duration_s(), setup.cell_mm,           session_->stock().blank().bounds_mm(),
                          {},           milling::kRubbingChipMm, milling::kOverloadShare};
    for (const milling::Cutter& cutter : setup.cutters) job.cutters.push_back(live_cutter(cutter));
    protocol::write_frame(job, frame_);
    frames(frame_);
    job::Listening listening = this->listening();
    protocol::write_frame(listening, frame_);
    frames(frame_);
    // In the precision of the frame, so that the sound has the same bits as in the page.
    if (sound_listener_ && protocol::read_frame(frame_, listening)) sound_listener_(listening);
}

job::Listening LiveMill::listening() const {
    if (extras_.listening) return *extras_.listening;
    job::Job job;
    job.cutters = {session_->setup().cutters.front()};
    return job::listening_to(job, session_->stock().blank().bounds_mm());
}

void LiveMill::show_designed(const protocol::FrameSink& frames) {
    const TriangleMesh& whole = *extras_.designed;
    for (std::size_t first = 0; first < whole.triangles.size(); first += kTrianglesPerFrame) {
        const std::size_t last = std::min(first + kTrianglesPerFrame, whole.triangles.size());
        protocol::LiveDesigned designed;
        TriangleMesh& piece = designed.mesh;
        std::map<std::uint32_t, std::uint32_t> kept;
        for (std::size_t n = first; n < last; ++n) {
            Triangle triangle;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t old = whole.triangles[n][corner];
                const auto [at, added] = kept.try_emplace(old, static_cast<std::uint32_t>(kept.size()));
                if (added) piece.positions.push_back(whole.positions[old]);
                triangle[corner] = at->second;
            }
            piece.triangles.push_back(triangle);
        }
        protocol::write_frame(designed, frame_);
        frames(frame_);
    }
}

void LiveMill::show_sound(const protocol::FrameSink& frames) {
    auto& all = sound_.pieces;
    for (std::size_t first = 0; first < all.size(); first += kPiecesPerFrame) {
        const std::size_t last = std::min(first + kPiecesPerFrame, all.size());
        protocol::LiveSoundPieces sound;
        sound.pieces.assign(std::move_iterator(all.begin() + static_cast<std::ptrdiff_t>(first)),
                            std::move_iterator(all.begin() + static_cast<std::ptrdiff_t>(last)));
        protocol::write_frame(sound, frame_);
        frames(frame_);
        if (sound_listener_) sound_listener_(std::move(sound));
    }
    all.clear();
}

void LiveMill::show_part(const Box3& box_mm, const protocol::FrameSink& frames) {
    picture_->update(box_mm, [&](ChunkCoord c, TriangleMesh mesh, std::vector<float> deviations_mm) {
        protocol::write_frame(
            protocol::LiveChunk{
                session_->milled_s(), {c.i, c.j, c.k}, std::move(mesh), std::move(deviations_mm)},
            frame_);
        frames(frame_);
    });
    shown_s_ = session_->milled_s();
}

void LiveMill::show_rows(const protocol::FrameSink& frames) {
    while (rows_sent_ < rows_.size()) {
        const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(rows_sent_);
        const std::size_t now = std::min(kRowsPerFrame, rows_.size() - rows_sent_);
        protocol::write_frame(protocol::LiveRows{std::exchange(rows_anew_, false),
                                                 {first, first + static_cast<std::ptrdiff_t>(now)}},
                              frame_);
        frames(frame_);
        rows_sent_ += now;
    }
    const auto& collisions = session_->totals().collisions;
    for (; collisions_sent_ < collisions.size(); ++collisions_sent_) {
        const MillCollision& c = collisions[collisions_sent_];
        protocol::write_frame(protocol::LiveCollision{c.t_s, static_cast<int>(c.kind), c.line, c.tip_mm},
                              frame_);
        frames(frame_);
    }
}

void LiveMill::show_state(const protocol::FrameSink& frames) {
    protocol::write_frame(state(), frame_);
    if (frame_ == last_state_) return;
    frames(frame_);
    std::swap(frame_, last_state_);
}

protocol::LiveState LiveMill::state() const {
    const MillSetup& setup = session_->setup();
    const motion::Schedule& schedule = session_->schedule();
    protocol::LiveState s;
    s.t_s = std::min(clock_s_, std::max(session_->milled_s(), 0.0));
    const std::size_t n = schedule.move_at(s.t_s);
    const motion::ToolPose tool = motion::pose_at_time(setup.moves, schedule, s.t_s);
    s.tip_mm = tool.tip_mm;
    s.axis = tool.axis;
    s.line = static_cast<std::uint32_t>(setup.moves[n].line);
    s.cutter = static_cast<std::uint32_t>(setup.cutter_of_move[n]);
    s.rapid = setup.moves[n].kind == motion::MoveKind::rapid;
    s.spindle_rpm = change_.speed_factor * setup.rpm_of_move[n];
    s.feed_mm_per_min = change_.feed_factor * 60 * schedule.moves[n].speed_mm_per_s(s.t_s);
    s.milled_s = session_->milled_s();
    s.speed = speed_;
    s.playing = playing_;
    const auto after = std::upper_bound(rows_.begin(), rows_.end(), s.t_s,
                                        [](double t, const protocol::LiveRow& row) { return t < row.t_s; });
    if (after == rows_.begin()) return s;
    const auto row = static_cast<std::size_t>(after - rows_.begin()) - 1;
    s.removed_mm3 = row_states_[row].removed_mm3;
    if (s.t_s > rows_[row].end_s) return s;
    const milling::CutRow& cut = record_.rows()[row];
    s.cutting = true;
    s.force_n = row_states_[row].force_n;
    s.peak_force_n = rows_[row].peak_force_n;
    s.mean_torque_nm = rows_[row].mean_torque_nm;
    const double written_rad_per_s = change_.angle_factor() * cut.spindle_rad_per_s();
    s.spindle_angle_rad = changed_phase_rad(cut, change_) + written_rad_per_s * (s.t_s - cut.start_s);
    return s;
}

}  // namespace tribo::session
