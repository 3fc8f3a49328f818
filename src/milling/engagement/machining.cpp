// SPDX-License-Identifier: MIT
#include "milling/engagement/machining.hpp"

#include <algorithm>
#include <cmath>

#include "field/shape/shape_overlap.hpp"
#include "milling/engagement/joined_moves.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/path.hpp"

namespace tribo::milling {
namespace {

// An overlap of shank or holder with the stock counts from this depth on, mm, because a shank as thick as its
// cutter slides along the wall that the cutter left. One with a fixture counts from where it is no rounding.
constexpr double kClearance = 0.05, kTouch = 0.002;
// A first contact is found to this fraction of its move.
constexpr double kContactFraction = 1.0 / 4096;
// Largest numbers of steps and rows that are processed together, and of earlier sweeps of the same run that
// may overlap one sweep. With more of them it is cheaper to carve them first.
constexpr std::size_t kMostSteps = 64, kMostRowsAtOnce = 256, kMostPending = 16;
// Rows are divided into this number of shares, each with its own probes.
constexpr std::size_t kShares = 48;
// The cutting part of a row in which contact begins or ends is divided into this number of rows.
constexpr int kTurnParts = 4;
// Margin around a sweep for the rounding of points on its border.
constexpr double kMargin = 1e-3;  // mm

// A rapid that removes less than this only brushed a surface that was cut before.
constexpr double kBrush = 1e-4;  // mm3

motion::Move raised(motion::Move move, double height) {
    move.start.tip_mm += height * move.start.axis;
    move.end.tip_mm += height * move.end.axis;
    if (move.quadratic) move.quadratic->tip_control_mm += height * move.quadratic->axis_control;
    if (move.arc) move.arc->centre_mm += height * move.start.axis;
    return move;
}

// True if the path bends more sharply than the cutter is wide: then earlier parts of the same move cut ahead
// of it.
bool meets_itself(const motion::Move& move, const Cutter& cutter) {
    constexpr double kSharp = 0.5;  // cutter's radius over the radius of the path
    return (move.arc || move.quadratic) && motion::max_curvature_per_mm(move) * cutter.radius_mm() > kSharp;
}

}  // namespace

const char* name(CollisionKind kind) {
    switch (kind) {
        case CollisionKind::rapid_through_stock:
            return "rapid-through-stock";
        case CollisionKind::shank:
            return "shank-in-stock";
        case CollisionKind::holder:
            return "holder-in-stock";
        case CollisionKind::tool_in_fixture:
            return "tool-in-fixture";
        case CollisionKind::holder_in_fixture:
            return "holder-in-fixture";
    }
    return "";
}

// One step of shank or holder: a cylinder whose lower end is `height_mm` above the tip.
struct Machining::Cylinder {
    CollisionKind in_stock;
    Cutter solid;
    double height_mm = 0;
};

// One step of the current run.
struct Machining::Sweep {
    Step step;
    const field::Shape* shape = nullptr;  // null for a dwell
    bool owns_shape = false;              // false: the shape of the step before is its shape, too
    Box3 bounds_mm;                       // of the shape
    // Of the first step of a pass: shapes of this run that may have cut here before the pass.
    std::vector<field::PendingShape> earlier;
    double from = 0, to = 1;  // fractions of the pass that it belongs to
    double contact = 0;       // of a rapid: fraction at which it first meets stock
    std::vector<Collision> collisions;

    bool is_rapid() const { return step.move->kind == motion::MoveKind::rapid; }
};

Machining::Machining(field::CarvedField& stock, std::span<const Cutter> cutters,
                     std::span<const std::unique_ptr<const field::Shape>> fixtures, MachiningOptions options,
                     ParallelFor parallel)
    : stock_(stock),
      cutters_(cutters),
      fixtures_(fixtures),
      options_(options),
      parallel_(std::move(parallel)),
      probes_(kShares) {
    for (const Cutter& cutter : cutters_) {
        for (auto& share : probes_) share.emplace_back(cutter);
        std::vector<HolderStep> steps = cutter.steps();
        if (steps.empty()) steps.push_back({cutter.top_diameter_mm(), 2 * cutter.length_mm});
        std::vector<Cylinder>& body = bodies_.emplace_back();
        double height = cutter.length_mm;
        for (const HolderStep& step : steps) {
            Cylinder& part = body.emplace_back();
            const bool shank = height < cutter.stickout_mm * (1 - 1e-9) ||
                               step.diameter_mm <= cutter.diameter_mm * (1 + 1e-9);
            part.in_stock = shank ? CollisionKind::shank : CollisionKind::holder;
            part.solid.kind = CutterKind::flat;
            part.solid.diameter_mm = step.diameter_mm;
            part.solid.length_mm = step.length_mm;
            part.height_mm = height;
            height += step.length_mm;
        }
    }
}

Machining::~Machining() = default;

std::size_t Machining::pass_end(std::size_t first) const {
    std::size_t end = first + 1;
    while (end < sweeps_.size() && sweeps_[end].step.joins) ++end;
    return end;
}

std::size_t Machining::shape_end(std::size_t first) const {
    std::size_t end = first + 1;
    while (end < sweeps_.size() && sweeps_[end].shape == sweeps_[first].shape) ++end;
    return end;
}

motion::ToolPose Machining::pose_at(std::size_t pass, double at) const {
    std::size_t n = pass;
    while (at > sweeps_[n].to && n + 1 < sweeps_.size()) ++n;
    const Sweep& sweep = sweeps_[n];
    return motion::pose_at(*sweep.step.move, (at - sweep.from) / (sweep.to - sweep.from));
}

double Machining::length_mm(std::size_t pass, double to) const {
    double sum = 0;
    for (std::size_t n = pass;; ++n) {
        const Sweep& sweep = sweeps_[n];
        if (to <= sweep.to) {
            return sum +
                   motion::path_length_mm(*sweep.step.move, (to - sweep.from) / (sweep.to - sweep.from));
        }
        sum += motion::path_length_mm(*sweep.step.move);
    }
}

// Returns the pose half way. `last_x` replaces the direction of travel if there is none across the axis;
// otherwise it is set to this direction.
CutPose Machining::pose_between(std::size_t pass, double from, double to, Vec3& last_x) const {
    const motion::ToolPose mid = pose_at(pass, 0.5 * (from + to));
    const motion::ToolPose first = pose_at(pass, from), last = pose_at(pass, to);
    const Vec3 travel = last.tip_mm - first.tip_mm, turn = last.axis - first.axis;
    CutPose pose{mid.tip_mm, tool_frame(mid.axis, travel, last_x), {}};
    last_x = pose.frame.x;
    pose.travel = {std::max(0.0, dot(travel, pose.frame.x)), -dot(travel, pose.frame.z),
                   dot(turn, pose.frame.x), dot(turn, pose.frame.y)};
    return pose;
}

void Machining::add_pass(std::size_t first, Machined& out) {
    const std::size_t end = pass_end(first);
    const Cutter& cutter = cutters_[sweeps_[first].step.cutter];
    double way = 0, path = 0;
    for (std::size_t n = first; n < end; ++n) {
        way += row_way_mm(*sweeps_[n].step.move, cutter);
        path += motion::path_length_mm(*sweeps_[n].step.move);
    }
    double from = 0, travelled = 0;
    for (std::size_t n = first; n < end; ++n) {
        travelled += motion::path_length_mm(*sweeps_[n].step.move);
        sweeps_[n].from = from;
        sweeps_[n].to = from = n + 1 < end ? travelled / path : 1;
    }
    const auto count = static_cast<std::size_t>(rows_of(way, cutter));
    if (out.rows.size() < out.row_count + count) out.rows.resize(out.row_count + count);
    travelled = 0;
    for (std::size_t n = 0; n < count; ++n) {
        CutRow& row = out.rows[out.row_count++];
        row.step = first;
        row.from = static_cast<double>(n) / static_cast<double>(count);
        row.to = static_cast<double>(n + 1) / static_cast<double>(count);
        const double so_far = length_mm(first, row.to);
        row.length_mm = so_far - travelled;
        travelled = so_far;
        row.pose = pose_between(first, row.from, row.to, last_x_);
    }
}

field::CarvedView Machining::before(const Sweep& sweep) const {
    return {stock_, sweep.earlier};
}

void Machining::measure_rows(std::size_t first, std::size_t last, std::vector<EngagementProbe>& probes,
                             Machined& out) const {
    for (std::size_t n = first; n < last; ++n) {
        CutRow& row = out.rows[n];
        const Sweep& sweep = sweeps_[row.step];
        const Cutter& cutter = cutters_[sweep.step.cutter];
        EngagementProbe& probe = probes[sweep.step.cutter];
        const auto measure = [&](const field::CarvedView& stock) {
            row.core_mm3 = 0;
            if (cutter.core_mm > 0) {
                probe.measure_core(stock, row.pose, row.engagement);
                row.core_mm3 = chip_mm3(cutter, row.engagement, row.pose.travel);
            }
            probe.measure(stock, row.pose, row.engagement);
        };
        if (row.from > 0 && sweep.to == 1 && meets_itself(*sweep.step.move, cutter)) {
            const auto gone = make_sweep(cutter, motion::first_part(*sweep.step.move, row.from));
            std::vector<field::PendingShape> earlier = sweep.earlier;
            earlier.push_back({gone.get(), gone->bounds_mm().inflated(kMargin)});
            measure({stock_, earlier});
        } else {
            measure(before(sweep));
        }
        row.chip_mm3 = chip_mm3(cutter, row.engagement, row.pose.travel);
    }
}

CutPose Machining::pose_at(const Turn& turn, double at) const {
    constexpr double kAround = 1e-4;  // fraction of the pass, for the direction of travel
    Vec3 x = turn.x;
    return pose_between(turn.step, std::max(at - kAround, 0.0), std::min(at + kAround, 1.0), x);
}

bool Machining::touches(const Turn& turn, double at, std::vector<EngagementProbe>& probes) const {
    const Sweep& sweep = sweeps_[turn.step];
    return probes[sweep.step.cutter].touches(before(sweep), pose_at(turn, at));
}

bool Machining::touches_at_end(const Turn& last, const Engagement& of_last_row) {
    const Sweep& sweep = sweeps_[last.step];
    return probes_.front()[sweep.step.cutter].touches(before(sweep), pose_at(last, 1), of_last_row);
}

// Finds the turns between rows. A row is represented by its middle. If one row cuts and the next does not,
// contact turned between their middles. Of two passes only the later one is divided, so that the result does
// not depend on the number of passes in a run. The end of a pass counts as one more middle: a plunge may
// begin to cut there, and leave the part.
void Machining::find_turns(const Machined& out) {
    turns_.clear();
    std::size_t row = 0;
    for (std::size_t step = 0, next_step; step < sweeps_.size(); step = next_step) {
        next_step = pass_end(step);
        const Sweep& sweep = sweeps_[step];
        // A different tool, or a jump of the tool, starts in the air, as after a rapid.
        const bool goes_on = sweep.step.cutter == end_.cutter &&
                             distance(sweep.step.move->start.tip_mm, end_.tip_mm) < kMargin;
        Turn last{step, {}, 0, 0, end_.in_cut && goes_on && !sweep.is_rapid()};
        const std::size_t first = row;
        for (; row < out.row_count && out.rows[row].step == step; ++row) {
            const CutRow& r = out.rows[row];
            Turn next{step, r.pose.frame.x, last.after, 0.5 * (r.from + r.to), !r.engagement.empty()};
            if (next.into != last.into) turns_.push_back(next);
            last = next;
        }
        if (row > first && touches_at_end(last, out.rows[row - 1].engagement) != last.into) {
            last = {step, last.x, last.after, 1, !last.into};
            turns_.push_back(last);
        }
        end_ = {last.into, sweep.step.cutter, sweeps_[next_step - 1].step.move->end.tip_mm};
    }
    parallel_(kShares, [&](std::size_t n) {
        constexpr int kHalvings = 9;
        for (std::size_t at = turns_.size() * n / kShares; at < turns_.size() * (n + 1) / kShares; ++at) {
            Turn& turn = turns_[at];
            for (int k = 0; k < kHalvings; ++k) {
                const double middle = 0.5 * (turn.before + turn.after);
                (touches(turn, middle, probes_[n]) == turn.into ? turn.after : turn.before) = middle;
            }
        }
    });
}

// Divides the rows in which contact turns at these places, and the cutting ones into parts.
void Machining::divide_rows_at_turns(Machined& out) {
    find_turns(out);
    if (turns_.empty()) return;
    divided_.clear();
    fresh_.clear();
    auto turn = turns_.begin();
    for (std::size_t n = 0; n < out.row_count; ++n) {
        CutRow& whole = out.rows[n];
        Vec3 x = whole.pose.frame.x;
        const auto add = [&](double from, double to, bool cuts) {
            const int parts = cuts ? kTurnParts : 1;
            for (int k = 0; k < parts && to > from; ++k) {
                fresh_.push_back(divided_.size());
                CutRow& part = divided_.emplace_back();
                part.step = whole.step;
                part.from = from + (to - from) * k / parts;
                part.to = from + (to - from) * (k + 1) / parts;
                part.length_mm = length_mm(part.step, part.to) - length_mm(part.step, part.from);
                part.pose = pose_between(part.step, part.from, part.to, x);
            }
        };
        double from = whole.from;
        bool is_divided = false, cuts = false;
        for (; turn != turns_.end() && turn->step == whole.step && turn->after <= whole.to; ++turn) {
            is_divided = true;
            // A part before contact that is no longer than the turn is known to belongs to the contact.
            constexpr double kShort = 3;
            if (turn->into && turn->after - from < kShort * (turn->after - turn->before)) {
                cuts = true;
                continue;
            }
            add(from, turn->after, !turn->into);
            from = turn->after;
            cuts = turn->into;
        }
        if (is_divided) {
            add(from, whole.to, cuts);
        } else {
            divided_.push_back(std::move(whole));
        }
    }
    out.rows.swap(divided_);
    out.row_count = out.rows.size();
    parallel_(kShares, [&](std::size_t n) {
        for (std::size_t at = fresh_.size() * n / kShares; at < fresh_.size() * (n + 1) / kShares; ++at)
            measure_rows(fresh_[at], fresh_[at] + 1, probes_[n], out);
    });
}

void Machining::find_contact(std::size_t number, Sweep& sweep) const {
    if (!stock_.blank().bounds_mm().overlaps(sweep.bounds_mm)) return;
    const motion::Move& move = *sweep.step.move;
    const double length = motion::path_length_mm(move);
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / options_.rapid_row_mm)));
    EngagementProbe probe(cutters_[sweep.step.cutter]);
    Engagement engagement;
    Vec3 x = any_perpendicular(move.start.axis);
    for (std::size_t n = 0; n < count; ++n) {
        const double from = static_cast<double>(n) / static_cast<double>(count);
        const double to = static_cast<double>(n + 1) / static_cast<double>(count);
        probe.measure(before(sweep), pose_between(number, from, to, x), engagement);
        if (engagement.empty()) continue;
        sweep.contact = from;
        return;
    }
}

Collision Machining::first_contact(CollisionKind kind, std::size_t begin, std::size_t end, Vec3 place,
                                   const std::function<bool(const motion::Move&)>& touches) const {
    const bool is_one = end == begin + 1;
    for (std::size_t step = begin; step < end; ++step) {
        const motion::Move& move = *sweeps_[step].step.move;
        // Most begin where the move before was in contact, too.
        if (touches(motion::first_part(move, kContactFraction))) return {step, kind, 0, move.start.tip_mm};
        if (!is_one && !touches(move)) continue;
        double free = kContactFraction, at = 1;
        while (at - free > kContactFraction) {
            const double middle = 0.5 * (free + at);
            (touches(motion::first_part(move, middle)) ? at : free) = middle;
        }
        return {step, kind, at, motion::pose_at(move, at).tip_mm};
    }
    // Only the common shape of joined steps touches, by less than its tolerance: where the tip is nearest.
    Collision best{begin, kind, 0, {}};
    double nearest = 1e300;
    for (std::size_t step = begin; step < end; ++step) {
        for (int n = 0; n <= 16; ++n) {
            const Vec3 tip = motion::pose_at(*sweeps_[step].step.move, n / 16.0).tip_mm;
            const double d = distance(tip, place);
            if (d < nearest) nearest = d, best = {step, kind, n / 16.0, tip};
        }
    }
    return best;
}

void Machining::find_collisions(std::size_t number, Sweep& sweep) const {
    const motion::Move& move = *sweep.step.move;
    // `solid_of` a move is swept by it, `overlap` of a solid is a place of it in the obstacle.
    const auto look = [&](CollisionKind kind, std::size_t end, const field::Shape& whole,
                          const auto& solid_of, const auto& overlap) {
        const std::optional<Vec3> place = overlap(whole);
        if (!place) return;
        const auto touches = [&](const motion::Move& part) { return overlap(*solid_of(part)).has_value(); };
        sweep.collisions.push_back(first_contact(kind, number, end, *place, touches));
    };
    const auto look_in_fixtures = [&](CollisionKind kind, std::size_t end, const field::Shape& whole,
                                      const auto& solid_of) {
        for (const auto& fixture : fixtures_) {
            look(kind, end, whole, solid_of,
                 [&](const field::Shape& solid) { return field::shared_place(solid, *fixture, kTouch); });
        }
    };
    if (sweep.owns_shape) {
        look_in_fixtures(
            CollisionKind::tool_in_fixture, shape_end(number), *sweep.shape,
            [&](const motion::Move& part) { return make_sweep(cutters_[sweep.step.cutter], part); });
    }
    for (const Cylinder& body : bodies_[sweep.step.cutter]) {
        const auto solid_of = [&](const motion::Move& part) {
            return make_sweep(body.solid, raised(part, body.height_mm));
        };
        const auto solid = solid_of(move);
        // The shank follows the cutter: the volume that this shape and those before it remove is not an
        // obstacle.
        std::vector<field::PendingShape> gone;
        const Box3 reach = solid->bounds_mm();
        for (std::size_t n = 0; n <= number; ++n) {
            if (sweeps_[n].owns_shape && sweeps_[n].bounds_mm.overlaps(reach))
                gone.push_back({sweeps_[n].shape, sweeps_[n].bounds_mm});
        }
        const field::CarvedView stock(stock_, gone);
        look(body.in_stock, number + 1, *solid, solid_of,
             [&](const field::Shape& shape) { return stock.overlap(shape, kClearance); });
        look_in_fixtures(CollisionKind::holder_in_fixture, number + 1, *solid, solid_of);
    }
}

bool Machining::add_sweeps(std::span<const Step> pass) {
    const std::size_t begin = sweeps_.size(), first_shape = shapes_.size();
    const Cutter& cutter = cutters_[pass.front().cutter];
    Box3 bounds;
    for (std::size_t n = 0, end; n < pass.size(); n = end) {
        std::vector<const motion::Move*> moves;
        for (end = n; end == n || (end < pass.size() && shares_sweep(*pass[end].move, cutter)); ++end)
            moves.push_back(pass[end].move);
        Sweep sweep;
        sweep.owns_shape = moves.front()->kind != motion::MoveKind::dwell;
        if (sweep.owns_shape) {
            shapes_.push_back(make_sweep(cutter, moves));
            sweep.shape = shapes_.back().get();
            sweep.bounds_mm = sweep.shape->bounds_mm().inflated(kMargin);
            bounds.include(sweep.bounds_mm);
        }
        for (; n < end; ++n) {
            sweep.step = pass[n];
            sweeps_.push_back(sweep);
            sweep.owns_shape = false;
        }
    }
    Sweep& first = sweeps_[begin];  // the rows of a pass are measured with its first step
    for (std::size_t n = 0; n < begin; ++n) {
        const Sweep& other = sweeps_[n];
        if (!other.owns_shape || !other.bounds_mm.overlaps(bounds)) continue;
        if (first.earlier.size() == kMostPending) {
            sweeps_.resize(begin);
            shapes_.resize(first_shape);
            return false;
        }
        first.earlier.push_back({other.shape, other.bounds_mm});
    }
    return true;
}

std::size_t Machining::run(std::span<const Step> steps, Machined& out) {
    sweeps_.clear();
    shapes_.clear();
    out.row_count = 0;
    out.collisions.clear();
    for (std::size_t n = 0, end; n < steps.size(); n = end) {
        if (sweeps_.size() >= kMostSteps || out.row_count >= kMostRowsAtOnce) break;
        for (end = n + 1; end < steps.size() && steps[end].joins;) ++end;
        if (!add_sweeps(steps.subspan(n, end - n))) break;
        if (steps[n].move->kind == motion::MoveKind::feed) add_pass(n, out);
    }
    // Rows in shares, then the checks of whole steps.
    const std::size_t count = sweeps_.size();
    parallel_(kShares + count, [&](std::size_t n) {
        if (n < kShares) {
            measure_rows(out.row_count * n / kShares, out.row_count * (n + 1) / kShares, probes_[n], out);
            return;
        }
        Sweep& sweep = sweeps_[n - kShares];
        if (!sweep.shape) return;
        if (sweep.is_rapid() && !sweep.step.move->is_place()) find_contact(n - kShares, sweep);
        if (options_.collisions) find_collisions(n - kShares, sweep);
    });
    divide_rows_at_turns(out);
    removed_.resize(shapes_.size());
    stock_.carve(shapes_, removed_);

    out.removed_mm3.assign(count, 0);
    out.begins_piece.assign(count, 0);
    std::size_t shape = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const Sweep& sweep = sweeps_[n];
        if (!sweep.shape) continue;
        out.begins_piece[n] = sweep.owns_shape;
        if (sweep.owns_shape) out.removed_mm3[n] = removed_[shape++];
        if (sweep.is_rapid() && !sweep.step.move->is_place() && out.removed_mm3[n] > kBrush) {
            out.collisions.push_back({n, CollisionKind::rapid_through_stock, sweep.contact,
                                      motion::pose_at(*sweep.step.move, sweep.contact).tip_mm});
        }
        out.collisions.insert(out.collisions.end(), sweep.collisions.begin(), sweep.collisions.end());
    }
    reconcile(out);
    return count;
}

// Reconciles the chips of each pass, and what the core moves into, with the volume that the stock lost. The
// grid knows the volume to some cells only. Therefore kRoughCells are added on both sides, so that the factor
// of a short pass tends to 1. A difference up to kSlack is attributed to the rounding of the grid. Each pass
// is reconciled separately, so that the result does not depend on the number of passes in a run.
void Machining::reconcile(Machined& out) const {
    constexpr double kRoughCells = 100;
    constexpr double kSlack = 0.005;
    // Beyond these limits the engagement missed the cut, and no factor can correct the force.
    constexpr double kLeast = 0.5, kMost = 2;
    const double cell = stock_.cell_mm(), rough = kRoughCells * cell * cell * cell;
    for (std::size_t first = 0; first < out.row_count;) {
        const std::size_t step = out.rows[first].step;
        std::size_t last = first;
        double swept = 0, lost = 0;
        for (std::size_t n = step; n < pass_end(step); ++n) lost += out.removed_mm3[n];
        for (; last < out.row_count && out.rows[last].step == step; ++last)
            swept += out.rows[last].chip_mm3 + out.rows[last].core_mm3;
        const double ratio = std::clamp((lost + rough) / (swept + rough), kLeast, kMost);
        const double off = std::max(std::abs(ratio - 1) - kSlack, 0.0);
        for (; first < last; ++first) {
            CutRow& row = out.rows[first];
            row.removed_mm3 = ratio * (row.chip_mm3 + row.core_mm3);
            row.reconciled = ratio > 1 ? 1 + off : 1 - off;
        }
    }
}

}  // namespace tribo::milling
