// SPDX-License-Identifier: MIT
#include "session/cut/mill_session.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "base/math.hpp"
#include "milling/engagement/joined_moves.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/path.hpp"

namespace tribo::session {
namespace {

// Moves offered to the cut at once. The cut takes as many of them as it can process together.
constexpr std::size_t kOfferedMoves = 64;
// Shapes carved again at once.
constexpr std::size_t kShapesAtOnce = 64;
// Number of force models, so that several threads have their own.
constexpr std::size_t kTasks = 32;
// With a smaller share of the blank left the stock is searched for material: the volumes are rounded.
constexpr double kLittleLeft = 1e-3;
// Less deep material is the rounding of faces that a tool has met.
constexpr float kDeepMm = 1e-4F;

bool has_material(const field::CarvedField& stock, field::BrickCoord at) {
    const field::BrickRef ref = stock.ref(at);
    if (ref == field::kAir) return false;
    if (ref == field::kUntouched && stock.blank().distance_mm(stock.centre(at)) > stock.brick_radius_mm())
        return false;
    std::array<float, field::kLatticeNodes> distance_mm;
    stock.sample_nodes(at, distance_mm.data());
    return std::ranges::any_of(distance_mm, [](float d) { return d < -kDeepMm; });
}

bool has_material(const field::CarvedField& stock) {
    const field::BrickCoord size = stock.size();
    for (int k = 0; k < size.k; ++k) {
        for (int j = 0; j < size.j; ++j) {
            for (int i = 0; i < size.i; ++i)
                if (has_material(stock, {i, j, k})) return true;
        }
    }
    return false;
}

}  // namespace

std::shared_ptr<const motion::Schedule> schedule_of(const MillSetup& setup) {
    if (setup.schedule) return setup.schedule;
    return std::make_shared<const motion::Schedule>(*motion::schedule(setup.moves, setup.timing));
}

std::vector<char> joins_of(const MillSetup& setup) {
    const auto schedule = schedule_of(setup);
    milling::JoinedMoves joined;
    std::vector<char> joins;
    joins.reserve(setup.moves.size());
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const motion::MoveTiming& timing = schedule->moves[n];
        joins.push_back(setup.join_moves && joined.add(setup.moves[n], setup.cutters[setup.cutter_of_move[n]],
                                                       setup.rpm_of_move[n], timing.end_s - timing.start_s));
    }
    return joins;
}

class MillSession::Run {
  public:
    Run(MillSetup setup, ParallelFor parallel, const std::function<bool(double fraction)>& progress)
        : setup_(std::move(setup)),
          parallel_(std::move(parallel)),
          schedule_(schedule_of(setup_)),
          stock_(std::move(setup_.blank), setup_.cell_mm, parallel_),
          machining_(stock_, setup_.cutters, setup_.fixtures, {}, parallel_) {
        for (auto& share : models_) {
            for (const milling::Cutter& cutter : setup_.cutters)
                share.emplace_back(cutter, setup_.coefficients);
        }
        stopped_ = !carve(stock_, setup_.earlier, progress);
        removed_earlier_mm3_ = stock_.removed_mm3();
        pieces_ = earlier_pieces_ = static_cast<std::uint32_t>(stock_.shapes_carved());
        last_piece_of_move_.reserve(setup_.moves.size());
        end_s_ = std::min(schedule_->duration_s, setup_.until_s.value_or(schedule_->duration_s));
        cutting_at_.assign(setup_.cutters.size(), 0);
        setup_.schedule = schedule_;
        joins_ = joins_of(setup_);
    }

    bool run_to(double to_s, const MillSinks& sinks) {
        if (stopped_) return false;
        limit_s_ = std::min(to_s, end_s_);
        if (!carve_again(sinks)) return false;
        while (next_move_ < setup_.moves.size() && now_s_ < limit_s_) {
            cut();
            if (states_) states_->offer(stock_, carved_moves_);
            evaluate(static_cast<bool>(sinks.row));
            for (std::size_t n = 0; n < row_count_; ++n) finish_row(rows_[n], forces_[n], sinks);
            if (sinks.progress && !sinks.progress(end_s_ > 0 ? std::min(1.0, now_s_ / end_s_) : 1))
                return false;
        }
        finish();
        return true;
    }

    void keep_states(std::size_t most_bytes, std::uint64_t spacing) {
        assert(next_move_ == 0);
        states_.emplace(stock_, most_bytes, spacing);
    }

    void set_back(double t_s) {
        assert(states_);
        restore(moves_begun(t_s));
    }

    double milled_s() const {
        if (carved_moves_ == next_move_) return now_s_;
        return carved_moves_ > 0 ? schedule_->moves[carved_moves_ - 1].end_s : 0;
    }

    MillSetup setup_;
    ParallelFor parallel_;
    std::shared_ptr<const motion::Schedule> schedule_;
    field::CarvedField stock_;
    MillTotals totals_;
    double end_s_ = 0, now_s_ = 0;
    double removed_earlier_mm3_ = 0;  // by jobs before this one
    bool stopped_ = false;            // during the carving of their cuts
    std::optional<KeptStates> states_;
    std::uint32_t earlier_pieces_ = 0;
    std::vector<std::uint32_t> last_piece_of_move_;  // of the milled moves

  private:
    // Number of the milled moves that begin before `t_s`.
    std::size_t moves_begun(double t_s) const {
        const auto& moves = schedule_->moves;
        const auto end = moves.begin() + static_cast<std::ptrdiff_t>(next_move_);
        return static_cast<std::size_t>(
            std::ranges::lower_bound(moves.begin(), end, t_s, {}, &motion::MoveTiming::start_s) -
            moves.begin());
    }
    // Number of pieces that the first milled moves made, those of earlier jobs included.
    std::uint32_t pieces_of(std::size_t moves) const {
        return moves == 0 ? earlier_pieces_ : last_piece_of_move_[moves - 1];
    }

    void restore(std::size_t moves) {
        carved_moves_ = states_->last(moves);
        states_->restore(stock_, carved_moves_);
    }

    // Carves moves that were milled before, up to the limit.
    bool carve_again(const MillSinks& sinks) {
        if (carved_moves_ == next_move_) return true;
        std::size_t due = moves_begun(limit_s_);
        while (due < next_move_ && joins_[due]) ++due;  // a pass is carved as a whole
        if (states_->last(due) > carved_moves_) restore(due);
        while (carved_moves_ < due) {
            const std::uint32_t carved = pieces_of(carved_moves_);
            while (carved_moves_ < due &&
                   (pieces_of(carved_moves_) < carved + kShapesAtOnce || joins_[carved_moves_]))
                ++carved_moves_;
            stock_.carve_again(pieces_of(carved_moves_) - carved);
            states_->offer(stock_, carved_moves_);
            if (sinks.progress && !sinks.progress(std::min(1.0, milled_s() / end_s_))) return false;
        }
        return true;
    }

    // Offers the next moves to the cut, up to the end of time, and books the moves that it took.
    void cut() {
        steps_.clear();
        std::size_t n = next_move_;
        for (; n < setup_.moves.size(); ++n) {
            const motion::MoveTiming& timing = schedule_->moves[n];
            const bool enough = steps_.size() >= kOfferedMoves || timing.start_s >= limit_s_;
            if (n > next_move_ && (joins_[n] ? timing.start_s >= end_s_ : enough)) break;
            const motion::Move* move = &setup_.moves[n];
            if (timing.end_s > end_s_) {
                const double length = motion::path_length_mm(*move);
                last_share_ = timing.path_fraction(end_s_);
                last_move_ =
                    motion::first_part(*move, motion::parameter_at_length(*move, last_share_ * length));
                move = &last_move_;
            }
            steps_.push_back({move, setup_.cutter_of_move[n], joins_[n] != 0});
        }
        const std::size_t count = machining_.run(steps_, machined_);
        for (const milling::Collision& c : machined_.collisions) {
            const std::size_t index = next_move_ + c.step;
            const double start = schedule_->moves[index].start_s;
            const double end = std::min(schedule_->moves[index].end_s, end_s_);
            add_collision({c.kind, setup_.moves[index].line, start + c.at * (end - start), c.tip_mm});
        }
        row_count_ = 0;
        std::size_t row = 0;
        for (std::size_t step = 0, last; step < count; step = last) {
            for (last = step + 1; last < count && steps_[last].joins;) ++last;
            const std::size_t first = row;
            while (row < machined_.row_count && machined_.rows[row].step == step) ++row;
            finish_pass(step, last, first, row);
        }
        for (std::size_t n = 0; n < count; ++n) {
            if (steps_[n].move->is_place() && machined_.removed_mm3[n] > 0) {
                if (totals_.stood_in_mm3 == 0) totals_.stood_in_line = steps_[n].move->line;
                totals_.stood_in_mm3 += machined_.removed_mm3[n];
            }
            if (machined_.begins_piece[n]) ++pieces_;
            last_piece_of_move_.push_back(pieces_);
        }
        assert(pieces_ == stock_.shapes_carved());
        next_move_ += count;
        carved_moves_ = next_move_;
    }

    // What one pass removes and its rows do not show. The rounding of the grid is left out.
    void find_unseen(std::size_t step, std::size_t last_step, std::span<const milling::CutRow> rows) {
        constexpr double kMuch = 0.1, kRoughCells = 100;
        double lost = 0, shown = 0;
        for (std::size_t n = step; n < last_step; ++n) {
            if (steps_[n].move->kind == motion::MoveKind::feed) lost += machined_.removed_mm3[n];
        }
        for (const milling::CutRow& row : rows) shown += row.removed_mm3;
        const double unseen = lost - shown, cell = stock_.cell_mm();
        if (unseen < kMuch * lost || unseen < kRoughCells * cell * cell * cell) return;
        totals_.unseen_mm3 += unseen;
        if (unseen <= totals_.most_unseen_mm3) return;
        totals_.most_unseen_mm3 = unseen;
        totals_.unseen_line = steps_[step].move->line;
    }

    // Finishes the steps of one pass and its machined rows, in the order of time.
    void finish_pass(std::size_t step, std::size_t last_step, std::size_t first, std::size_t last) {
        const std::size_t move = next_move_ + step;
        const double start = schedule_->moves[move].start_s;
        const double end = std::min(schedule_->moves[next_move_ + last_step - 1].end_s, end_s_);
        const double rpm = setup_.rpm_of_move[move];
        const auto rows = std::span(machined_.rows).subspan(first, last - first);
        const bool cuts =
            std::ranges::any_of(rows, [](const milling::CutRow& row) { return !row.engagement.empty(); });
        for (std::size_t n = step; n < last_step; ++n) {
            if (steps_[n].move->kind != motion::MoveKind::feed) continue;
            totals_.path_mm += motion::path_length_mm(*steps_[n].move);
            totals_.fed_mm3 += machined_.removed_mm3[n];
            if (cuts || machined_.removed_mm3[n] == 0) continue;
            if (totals_.edgeless_mm3 == 0) totals_.edgeless_line = steps_[n].move->line;
            totals_.edgeless_mm3 += machined_.removed_mm3[n];
        }
        find_unseen(step, last_step, rows);
        std::size_t at = step;  // step of the current row
        double begun_mm = 0, travelled = 0, row_start = start;
        for (std::size_t n = first; n < last; ++n) {
            milling::CutRow& cut = machined_.rows[n];
            const std::size_t begins_at = at;
            travelled += cut.length_mm;
            for (; at + 1 < last_step; ++at) {
                const double length = motion::path_length_mm(*steps_[at].move);
                if (travelled < begun_mm + length * (1 - 1e-9)) break;
                begun_mm += length;
            }
            const double row_end = time_on_s(at, travelled - begun_mm, cut.to);
            if (!cut.engagement.empty())
                add_row(next_move_ + begins_at, steps_[step].cutter, cut, row_start, row_end, rpm, start);
            row_start = row_end;
        }
        angle_rad_ += rpm / 60 * math::kTwoPi * (end - start);
        const double turns = std::floor(angle_rad_ / math::kTwoPi);
        angle_rad_ -= math::kTwoPi * turns;
        turns_ += turns;
        now_s_ = end;
    }

    // Returns the time at which the tip has moved `way_mm` on the step. On a step without a path: the time at
    // which `share` of it is done.
    double time_on_s(std::size_t step, double way_mm, double share) const {
        const milling::Step& s = steps_[step];
        const motion::MoveTiming& timing = schedule_->moves[next_move_ + step];
        const double length = motion::path_length_mm(*s.move), end = std::min(timing.end_s, end_s_);
        if (!(length > 0)) return timing.start_s + (end - timing.start_s) * share;
        return timing.time_at_s((s.move == &last_move_ ? last_share_ : 1) *
                                std::clamp(way_mm / length, 0.0, 1.0));
    }

    void add_row(std::size_t move, std::size_t cutter, milling::CutRow& cut, double start, double end,
                 double rpm, double move_start) {
        if (rows_.size() == row_count_) {
            rows_.emplace_back();
            forces_.emplace_back();
        }
        milling::CutRow& row = rows_[row_count_++];
        std::swap(row, cut);  // both keep their allocated memory
        row.line = setup_.moves[move].line;
        row.cutter = cutter;
        row.start_s = start;
        row.end_s = end;
        row.spindle_rpm = rpm;
        row.phase_turns = turns_;
        row.phase_rad = angle_rad_ + rpm / 60 * math::kTwoPi * (start - move_start);
        const double teeth = (end - start) * rpm / 60 * setup_.cutters[cutter].flutes;
        row.feed = (teeth > 0 ? 1 / teeth : 0) * row.pose.travel;
        if (!setup_.engagement) {
            row.feed = row.reconciled * row.feed;
        } else {
            row.reconciled = 1;
            row.engagement.clear();
            row.engagement.bands.push_back({0, setup_.engagement->axial_depth_mm,
                                            setup_.engagement->entry_rad, setup_.engagement->exit_rad});
        }
    }

    // Spectra are not needed without a receiver of rows.
    void evaluate(bool spectra) {
        parallel_(kTasks, [&](std::size_t share) {
            const std::size_t from = row_count_ * share / kTasks, to = row_count_ * (share + 1) / kTasks;
            for (std::size_t n = from; n < to; ++n) {
                const milling::CutRow& row = rows_[n];
                milling::RowForce& force = forces_[n];
                milling::ForceModel& model = models_[share][row.cutter];
                model.engage(row.engagement, row.feed);
                if (spectra) model.spectrum(setup_.harmonics, force.spectrum);
                force.peaks = model.peaks();
                force.edge_torque_nmm = model.edges().mean_edge_torque_nmm();
                force.chip_mm =
                    milling::thickest_chip_mm(row.engagement, row.feed, setup_.cutters[row.cutter]);
            }
        });
    }

    void finish_row(const milling::CutRow& row, const milling::RowForce& force, const MillSinks& sinks) {
        const double seconds = row.duration_s();
        const milling::ForcePeaks& p = force.peaks;
        totals_.add(row, p);
        cutting_at_[row.cutter] += seconds;
        const double turned_rad = row.spindle_rad_per_s() * seconds;
        totals_.work_j += 1e-3 * p.mean_torque_nmm * turned_rad;
        totals_.shear_work_j += 1e-3 * (p.mean_torque_nmm - force.edge_torque_nmm) * turned_rad;
        totals_.chip_mm3 += row.chip_mm3;
        totals_.core_mm3 += row.core_mm3;
        if (row.core_mm3 > totals_.most_core_mm3) {
            totals_.most_core_mm3 = row.core_mm3;
            totals_.core_line = row.line;
        }
        ++totals_.rows;
        totals_.chips.add(row, force.chip_mm, setup_.cutters[row.cutter]);
        if (sinks.row) sinks.row(row, force);
    }

    void add_collision(const MillCollision& c) {
        const bool known =
            std::any_of(totals_.collisions.begin(), totals_.collisions.end(),
                        [&](const MillCollision& k) { return k.line == c.line && k.kind == c.kind; });
        if (!known) totals_.collisions.push_back(c);
    }

    void finish() {
        totals_.duration_s = end_s_;
        totals_.removed_mm3 = stock_.removed_mm3() - removed_earlier_mm3_;
        // Where nothing is left the sums differ by their rounding.
        totals_.remaining_mm3 = std::max(0.0, setup_.blank_volume_mm3 - stock_.removed_mm3());
        totals_.is_stock_gone =
            totals_.remaining_mm3 < kLittleLeft * setup_.blank_volume_mm3 && !has_material(stock_);
        if (totals_.fed_mm3 > 0 && !setup_.engagement)
            totals_.energy_balance =
                totals_.shear_work_j / (1e-3 * setup_.coefficients.ktc * totals_.fed_mm3);
        const auto longest = std::max_element(cutting_at_.begin(), cutting_at_.end()) - cutting_at_.begin();
        for (std::size_t n = 0; n < setup_.moves.size(); ++n) {
            if (setup_.moves[n].kind == motion::MoveKind::feed &&
                setup_.cutter_of_move[n] == static_cast<std::size_t>(longest)) {
                totals_.tooth_passing_hz =
                    setup_.rpm_of_move[n] / 60 * setup_.cutters[static_cast<std::size_t>(longest)].flutes;
                break;
            }
        }
    }

    milling::Machining machining_;
    std::array<std::vector<milling::ForceModel>, kTasks> models_;
    std::vector<milling::Step> steps_;
    milling::Machined machined_;
    std::vector<milling::CutRow> rows_;      // of the last moves; only the first row_count_ are valid
    std::vector<milling::RowForce> forces_;  // one per row
    std::size_t row_count_ = 0;
    motion::Move last_move_;          // shortened by the end of time
    double last_share_ = 1;           // of its path
    std::vector<double> cutting_at_;  // seconds by cutter
    std::vector<char> joins_;         // per move: shares a row with the move before
    std::size_t next_move_ = 0;
    std::size_t carved_moves_ = 0;  // fewer than next_move_ after set_back()
    std::uint32_t pieces_ = 0;      // made so far, those of earlier jobs included
    double limit_s_ = 0, angle_rad_ = 0, turns_ = 0;
};

MillSession::MillSession(MillSetup setup, ParallelFor parallel,
                         const std::function<bool(double fraction)>& progress)
    : run_(std::make_unique<Run>(std::move(setup), std::move(parallel), progress)) {}
MillSession::~MillSession() = default;

bool MillSession::run(const MillSinks& sinks) {
    return run_->run_to(run_->end_s_, sinks);
}
bool MillSession::run_to(double t_s, const MillSinks& sinks) {
    return run_->run_to(t_s, sinks);
}
double MillSession::milled_s() const {
    return run_->milled_s();
}
double MillSession::known_s() const {
    return run_->now_s_;
}
void MillSession::keep_states(std::size_t most_bytes, std::uint64_t spacing) {
    run_->keep_states(most_bytes, spacing);
}
void MillSession::set_back(double t_s) {
    run_->set_back(t_s);
}
const KeptStates* MillSession::kept_states() const {
    return run_->states_ ? &*run_->states_ : nullptr;
}
double MillSession::duration_s() const {
    return run_->end_s_;
}
const motion::Schedule& MillSession::schedule() const {
    return *run_->schedule_;
}
const field::CarvedField& MillSession::stock() const {
    return run_->stock_;
}
std::optional<std::size_t> MillSession::move_at(Vec3 surface_mm) const {
    // Where a cut ends at a face of the blank, both are as near.
    constexpr double kSkin = 1e-5;
    std::uint32_t piece = run_->stock_.sample(surface_mm).piece;
    if (piece == 0) piece = run_->stock_.emptied_by(surface_mm, kSkin);
    if (piece <= run_->earlier_pieces_) return std::nullopt;
    const auto& pieces = run_->last_piece_of_move_;
    const auto [first, last] = std::ranges::equal_range(pieces, piece);
    std::optional<std::size_t> made;
    double nearest = std::numeric_limits<double>::infinity();
    for (auto at = first; at != last; ++at) {
        const auto n = static_cast<std::size_t>(at - pieces.begin());
        const motion::Move& move = run_->setup_.moves[n];
        if (move.kind == motion::MoveKind::dwell) continue;
        const milling::Cutter& cutter = run_->setup_.cutters[run_->setup_.cutter_of_move[n]];
        const double d = milling::make_sweep(cutter, move)->distance_mm(surface_mm);
        if (d < nearest) nearest = d, made = n;
    }
    return made;
}
std::unique_ptr<field::FieldReader> MillSession::read_stock() {
    return std::make_unique<field::FieldReader>(run_->stock_);
}
const MillTotals& MillSession::totals() const {
    return run_->totals_;
}
const MillSetup& MillSession::setup() const {
    return run_->setup_;
}
MillSetup MillSession::release_setup() {
    run_->setup_.blank = run_->stock_.release_blank();
    return std::move(run_->setup_);
}

}  // namespace tribo::session
