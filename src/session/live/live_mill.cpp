// SPDX-License-Identifier: MIT
#include "session/live/live_mill.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "base/math.hpp"
#include "milling/tool/cutter_profile.hpp"
#include "motion/path/path.hpp"

namespace tribo::session {
namespace {

// Points along a curved move of the drawn path: one per millimetre, up to this number.
constexpr double kCurvePointMm = 1, kMostCurvePoints = 4;
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
        const auto line = static_cast<std::uint32_t>(move.line);
        if (points.empty()) points.push_back({timing.start_s, move.start.tip_mm, rapid, line});
        const double wanted = std::ceil(motion::path_length_mm(move) / kCurvePointMm);
        const int count =
            move.arc || move.quadratic ? static_cast<int>(std::clamp(wanted, 1.0, kMostCurvePoints)) : 1;
        for (int k = 1; k <= count; ++k) {
            const double t = static_cast<double>(k) / count;
            points.push_back({timing.time_at_s(t), motion::pose_at(move, t).tip_mm, rapid, line});
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
    for (const milling::HolderStep& step : cutter.steps())
        told.holder.push_back({0.5 * step.diameter_mm, step.length_mm});
    return told;
}

protocol::LiveOutline live_outline(const milling::Cutter& cutter) {
    constexpr double kStepRad = 0.15;
    protocol::LiveOutline outline;
    for (const milling::PlanePoint point : milling::profile_outline(cutter, kStepRad))
        outline.points.push_back({point.r, point.z});
    return outline;
}

}  // namespace

LiveMill::LiveMill(MakeInput make_input, ParallelFor parallel, std::function<bool()> files_changed)
    : make_input_(std::move(make_input)),
      files_changed_(std::move(files_changed)),
      parallel_(std::move(parallel)),
      cut_(parallel_) {}

Result<std::unique_ptr<LiveMill>> LiveMill::create(MakeInput make_input, ParallelFor parallel,
                                                   std::function<bool()> files_changed) {
    std::unique_ptr<LiveMill> live(
        new LiveMill(std::move(make_input), std::move(parallel), std::move(files_changed)));
    auto input = live->make_input_();
    assert(input);
    if (auto begun = live->begin(*std::move(input)); !begun) return std::unexpected(begun.error());
    return live;
}

// Begins a new session once the files are read, or goes back in this one.
void LiveMill::begin_again() {
    if (!reads_ && files_changed_ && !files_changed_()) return go_back();
    reads_ = true;
    auto input = make_input_();
    if (!input) return;
    reads_ = false;
    // With a session this cannot fail: it mills again what it milled before.
    [[maybe_unused]] const auto begun = begin(*std::move(input));
    clock_s_ = std::min(clock_s_, duration_s());
}

void LiveMill::go_back() {
    if (session_observer_) session_observer_(nullptr);
    session_->set_back(clock_s_);
    if (session_observer_) session_observer_(session_.get());
    picture_->mark(picture_->all());
    marked_s_ = session_->milled_s();
    last_state_.clear();
    set_back_ = false;
}

bool LiveMill::is_shown() const {
    return session_->milled_s() >= clock_s_ && !picture_->is_behind();
}

bool LiveMill::catches_up() const {
    return session_->milled_s() < std::min(clock_s_, session_->known_s());
}

Result<void> LiveMill::begin(Result<LiveInput> input) {
    if (!input && !session_) return std::unexpected(input.error());
    input_error_ = input ? std::nullopt : std::optional(input.error());
    if (session_observer_) session_observer_(nullptr);
    picture_.reset();
    chatter_.reset();
    if (input) take(std::move(input->extras));
    MillSetup setup = input ? std::move(input->setup) : session_->release_setup();
    session_.reset();  // before the next one: two of them need twice the memory
    session_ = std::make_unique<MillSession>(std::move(setup), parallel_);
    session_->keep_states();
    picture_ = std::make_unique<PartPicture>(session_->stock(), parallel_, compared_);
    path_ = path_of(*session_);
    const bool bends = !session_->setup().modes_of_cutter.empty();
    cut_.begin(session_->setup(), bends);
    if (bends) chatter_.emplace(session_->setup(), change());
    collisions_sent_ = 0;
    picture_->mark(picture_->all());
    marked_s_ = 0;
    designed_waits_ = extras_.designed != nullptr;
    ++sessions_;
    begun_anew_ = true;
    set_back_ = false;
    if (session_observer_) session_observer_(session_.get());
    return {};
}

void LiveMill::take(LiveExtras extras) {
    const bool same = extras.designed && extras_.designed &&
                      extras.designed->positions == extras_.designed->positions &&
                      extras.designed->triangles == extras_.designed->triangles;
    extras_ = std::move(extras);
    if (same) return;
    compared_ = nullptr;
    if (!extras_.designed) return;
    if (auto made = surface::DesignedSurface::make(*extras_.designed))
        compared_ = std::make_shared<const surface::DesignedSurface>(*std::move(made));
}

void LiveMill::set_session_observer(std::function<void(MillSession*)> observer) {
    session_observer_ = std::move(observer);
    if (session_observer_) session_observer_(session_.get());
}

void LiveMill::set_change(const CutChange& change) {
    const double t_s = state().t_s;
    cut_.set_change(change, t_s);
    if (chatter_) chatter_->set_change(change, cut_.row_at(t_s));
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
    // The files that are being read may make a longer program.
    clock_s_ = std::max(set_back_ ? t_s : std::min(t_s, duration_s()), 0.0);
    // Removed material does not come back: milling starts again.
    set_back_ = set_back_ || clock_s_ < session_->milled_s();
    jumped_ = true;
    cut_.hear_from(clock_s_);
}

void LiveMill::tick(double dt_s, const std::function<bool()>& has_time, const protocol::FrameSink& frames) {
    if (set_back_) begin_again();
    cut_.pass(dt_s);
    // The clock continues from the milled part. It waits for the files of a part that begins again.
    const double target = set_back_ ? clock_s_ : std::min(clock_s_ + pace() * dt_s, duration_s());
    const bool begins = std::exchange(begun_anew_, false);
    if (begins) show_job(frames);
    const bool waits = playing_ && picture_->is_behind() && !catches_up();
    if (waits) show_part(has_time, frames);
    if (!set_back_ && !(waits && picture_->is_behind())) mill(target, has_time);
    cut_.compute_new();
    cut_.hear_to(session_->milled_s());
    cut_.compute_slice();
    clock_s_ = playing_ ? std::min(target, std::max(clock_s_, session_->milled_s())) : clock_s_;
    if (!set_back_ && clock_s_ >= duration_s()) playing_ = false;
    // The picture stays as it was until the part has reached the clock.
    if (!catches_up()) show_part(has_time, frames);
    if (begins) {
        protocol::write_frame(path_, frame_);
        frames(frame_);
        last_state_.clear();
    }
    // After the part, so that the first picture is not delayed on a slow connection.
    if (!picture_->is_behind() && std::exchange(designed_waits_, false)) show_designed(frames);
    show_bending(frames);
    cut_.show_rows(frames);
    if (chatter_) {
        chatter_->compute(cut_, state().t_s, dt_s, has_time);
        chatter_->show(cut_, frames);
    }
    show_collisions(frames);
    show_sound(frames);
    if (!catches_up()) show_state(frames);
}

void LiveMill::mill(double target_s, const std::function<bool()>& has_time) {
    MillSinks sinks;
    sinks.row = [this](const milling::CutRow& row, const milling::RowForce& force) { cut_.add(row, force); };
    sinks.progress = [&](double) {
        cut_.compute_new();
        return has_time();
    };
    session_->run_to(target_s, sinks);
    if (session_->milled_s() <= marked_s_) return;
    picture_->mark(swept_box(*session_, marked_s_, session_->milled_s()));
    marked_s_ = session_->milled_s();
}

void LiveMill::show_job(const protocol::FrameSink& frames) {
    const MillSetup& setup = session_->setup();
    protocol::LiveJob job{duration_s(),
                          setup.cell_mm,
                          session_->stock().blank().bounds_mm(),
                          {},
                          milling::kRubbingChipMm,
                          milling::kOverloadShare,
                          {}};
    for (const milling::Cutter& cutter : setup.cutters) {
        job.cutters.push_back(live_cutter(cutter));
        job.outlines.push_back(live_outline(cutter));
    }
    protocol::write_frame(job, frame_);
    frames(frame_);
    if (!extras_.program.name.empty()) {
        protocol::write_frame(extras_.program, frame_);
        frames(frame_);
    }
    job::Listening listening = this->listening();
    protocol::write_frame(listening, frame_);
    frames(frame_);
    // In the precision of the frame, so that the sound has the same bits as in the page.
    if (sound_listener_ && protocol::read_frame(frame_, listening)) sound_listener_(listening);
    last_bending_.clear();
}

void LiveMill::show_bending(const protocol::FrameSink& frames) {
    if (!chatter_) return;
    protocol::LiveBending bending = chatter_->bending();
    protocol::write_frame(bending, frame_);
    if (frame_ == last_bending_) return;
    frames(frame_);
    last_bending_ = frame_;
    if (sound_listener_ && protocol::read_frame(frame_, bending)) sound_listener_(std::move(bending));
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
    auto all = cut_.take_sound().pieces;
    for (std::size_t first = 0; first < all.size(); first += kPiecesPerFrame) {
        const std::size_t last = std::min(first + kPiecesPerFrame, all.size());
        protocol::LiveSoundPieces sound;
        sound.pieces.assign(std::move_iterator(all.begin() + static_cast<std::ptrdiff_t>(first)),
                            std::move_iterator(all.begin() + static_cast<std::ptrdiff_t>(last)));
        protocol::write_frame(sound, frame_);
        frames(frame_);
        if (sound_listener_) sound_listener_(std::move(sound));
    }
}

void LiveMill::show_part(const std::function<bool()>& has_time, const protocol::FrameSink& frames) {
    const auto show = [&](ChunkCoord c, PartPicture::Piece piece) {
        protocol::write_frame(protocol::LiveChunk{session_->milled_s(),
                                                  {c.i, c.j, c.k},
                                                  std::move(piece.mesh),
                                                  std::move(piece.deviations_mm),
                                                  piece.on_blank,
                                                  piece.rough,
                                                  picture_->step_mm()},
                              frame_);
        frames(frame_);
    };
    picture_->update(has_time, show, jumped_);
    jumped_ = jumped_ && !is_shown();
}

void LiveMill::show_collisions(const protocol::FrameSink& frames) {
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
    s.spindle_rpm = change().speed_factor * setup.rpm_of_move[n];
    s.feed_mm_per_min = change().feed_factor * 60 * schedule.moves[n].speed_mm_per_s(s.t_s);
    s.milled_s = session_->known_s();
    s.speed = speed_;
    s.playing = playing_;
    cut_.describe(s);
    if (chatter_ && s.cutting) s.chatter = chatter_->now(cut_, s.t_s);
    return s;
}

}  // namespace tribo::session
