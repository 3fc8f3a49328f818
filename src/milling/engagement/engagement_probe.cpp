// SPDX-License-Identifier: MIT
#include "milling/engagement/engagement_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

// An engaged stretch is first divided at these shares of its length, with one circle in the middle of each
// part. The parts near its ends are short, because the arcs often change there. Bottom and cylinder need
// fewer parts, because their circles are more alike.
constexpr std::array kCornerParts{0.0, 0.05, 0.35, 0.65, 0.95, 1.0};
constexpr std::array kStraightParts{0.0, 0.1, 0.9, 1.0};
// Largest number of circles of one part.
constexpr std::size_t kMostLevels = 56;
// Splitting stops when no circle may change the area of the chips by more than this share of the known area.
// Areas below kLeastArea (in R^2) are ignored.
constexpr double kAreaShare = 0.004, kLeastArea = 1e-4;
// Arcs on the cylinder that differ by less form one band, rad.
constexpr double kAlikeRad = 2e-3;

// Returns the integral of the law over the rotation.
double integral(const TurnLaw& law, double from, double to) {
    double sin0, cos0, sin1, cos1;
    math::sincos(from, sin0, cos0);
    math::sincos(to, sin1, cos1);
    return law.sine * (cos0 - cos1) + law.cosine * (sin1 - sin0) + law.constant * (to - from);
}

// Returns where the radius passes a value on a part, from a place inside to one outside of it.
double s_at_radius(const CutterProfile::Part& part, double inside, double outside, double radius_mm) {
    for (int n = 0; n < 50; ++n) {
        const double middle = 0.5 * (inside + outside);
        (part.at(middle).radius_mm < radius_mm ? inside : outside) = middle;
    }
    return outside;
}

double fastest(const TurnLaw& law) {
    return math::hypot(law.sine, law.cosine) + law.constant;
}

}  // namespace

EngagementProbe::EngagementProbe(const Cutter& cutter)
    : profile_(cutter),
      scout_(cutter),
      radius_mm_(cutter.radius_mm()),
      core_mm_(0.5 * cutter.core_mm),
      length_mm_(cutter.length_mm) {
    levels_.reserve(kMostLevels + 2);
    arcs_.reserve(4 * kMostLevels);
    stretches_.reserve(64);
}

bool EngagementProbe::clip_heights(const field::CarvedView& stock, const CutPose& pose, double& low,
                                   double& high) const {
    const Box3 blank = stock.field().blank().bounds_mm();
    low = 0;
    high = length_mm_;
    for (int axis = 0; axis < 3; ++axis) {
        const double u = pose.frame.z[axis];
        const double reach = radius_mm_ * std::sqrt(std::max(0.0, 1 - u * u));
        const double from = blank.min[axis] - reach - pose.tip_mm[axis];
        const double to = blank.max[axis] + reach - pose.tip_mm[axis];
        if (std::abs(u) < 1e-12) {
            if (from > 0 || to < 0) return false;
            continue;
        }
        low = std::max(low, std::min(from / u, to / u));
        high = std::min(high, std::max(from / u, to / u));
    }
    return high > low;
}

EngagementProbe::Level EngagementProbe::look(double s0, double s1, const field::CarvedView& stock,
                                             const CutPose& pose) {
    Level level;
    level.s0 = s0;
    level.s = 0.5 * (s0 + s1);
    level.s1 = s1;
    level.at = profile_.at(level.s);
    level.first = arcs_.size();
    level.window = moving_outward(pose, level.at, length_mm_);
    if (level.window.empty()) return level;
    const TurnLaw law = normal_travel(pose.travel, level.at);
    level.speed = fastest(law);
    const double r = level.at.radius_mm;
    const AxisCircle circle{pose.on_axis(level.at.height_mm), r * pose.frame.x, r * pose.frame.y, r};
    material_arcs(stock, circle, level.window.from_rad, level.window.to_rad, arcs_);
    level.count = arcs_.size() - level.first;
    for (std::size_t n = level.first; n < arcs_.size(); ++n) {
        level.width_rad += arcs_[n].to_rad - arcs_[n].from_rad;
        level.flow += r * integral(law, arcs_[n].from_rad, arcs_[n].to_rad);
    }
    return level;
}

void EngagementProbe::start(double s0, double s1, const field::CarvedView& stock, const CutPose& pose) {
    stretches_.clear();
    scout_.look(stock, pose, s0, s1, stretches_);
    const bool corner = profile_.is_round(s0);
    const std::span<const double> parts =
        corner ? std::span<const double>(kCornerParts) : std::span<const double>(kStraightParts);
    for (const MeridianStretch& stretch : stretches_) {
        if (!stretch.engaged) {
            Level& level = levels_.emplace_back();
            level.s0 = stretch.s0_mm;
            level.s1 = stretch.s1_mm;
            level.s = 0.5 * (level.s0 + level.s1);
            level.first = arcs_.size();
            continue;
        }
        const double size = stretch.s1_mm - stretch.s0_mm;
        for (std::size_t n = 0; n + 1 < parts.size(); ++n) {
            levels_.push_back(
                look(stretch.s0_mm + size * parts[n], stretch.s0_mm + size * parts[n + 1], stock, pose));
        }
    }
    for (std::size_t n = 0; n + 1 < levels_.size(); ++n) {
        Level &a = levels_[n], &b = levels_[n + 1];
        if (a.step_above || b.step_below) continue;
        if (a.count > 0 && b.count == 0) find_step(a, b, stock, pose);
        if (a.count == 0 && b.count > 0) find_step(b, a, stock, pose);
    }
}

// Searches the end of the contact between a circle with contact and the next circle without, along three
// meridians. If the end is at one height, as at the top of a blank, no more circles are needed.
void EngagementProbe::find_step(Level& seen, Level& empty, const field::CarvedView& stock,
                                const CutPose& pose) const {
    // Share of the distance between the two circles.
    constexpr int kHalvings = 9;
    constexpr double kAlike = 0.01;
    const auto end = arcs_.begin() + static_cast<std::ptrdiff_t>(seen.first + seen.count);
    const MaterialArc& arc = *std::max_element(end - static_cast<std::ptrdiff_t>(seen.count), end,
                                               [](const MaterialArc& a, const MaterialArc& b) {
                                                   return a.to_rad - a.from_rad < b.to_rad - b.from_rad;
                                               });
    const double way = empty.s - seen.s;
    double nearest = 1, farthest = 0;
    for (const double share : {0.5, 0.2, 0.8}) {
        double sine, cosine;
        math::sincos(arc.from_rad + share * (arc.to_rad - arc.from_rad), sine, cosine);
        const Vec3 out = sine * pose.frame.x + cosine * pose.frame.y;
        double in = 0, beyond = 1;
        for (int n = 0; n < kHalvings; ++n) {
            const double middle = 0.5 * (in + beyond);
            const ProfilePoint at = profile_.at(seen.s + middle * way);
            const bool material = stock.is_material(pose.on_axis(at.height_mm) + at.radius_mm * out, kSkin);
            (material ? in : beyond) = middle;
        }
        nearest = std::min(nearest, 0.5 * (in + beyond));
        farthest = std::max(farthest, 0.5 * (in + beyond));
        if (farthest - nearest > kAlike) return;
    }
    const double at = seen.s + 0.5 * (nearest + farthest) * way;
    if (way > 0) {
        seen.s1 = empty.s0 = at;
        seen.step_above = empty.step_below = true;
    } else {
        seen.s0 = empty.s1 = at;
        seen.step_below = empty.step_above = true;
    }
    empty.s = 0.5 * (empty.s0 + empty.s1);
}

// Returns the largest expected error of the swept area between two circles.
double EngagementProbe::error_between(const Level& a, const Level& b) const {
    // Shares of the difference between the two: if the same arcs continue, if an arc begins, if an arc ends.
    constexpr double kBend = 0.06, kBegin = 0.3, kEnd = 0.3;
    const double apart = b.s - a.s, radius = std::max(a.at.radius_mm, b.at.radius_mm);
    const double speed = std::max(a.speed, b.speed);
    if ((a.count == 0 && b.count == 0) || a.step_above || b.step_below) return 0;
    const double change = std::abs(a.flow - b.flow);
    if (a.count == 0 || b.count == 0) return kEnd * apart * change;
    if (a.count != b.count) {
        constexpr double kAnotherArc = 0.1;  // rad
        return kBegin * apart * (change + kAnotherArc * radius * speed);
    }
    constexpr double kStep = 0.5;  // rad
    const double jump = std::abs(a.width_rad - b.width_rad);
    return (jump < kStep ? kBend : kEnd) * apart * change;
}

double EngagementProbe::judge() {
    double area = 0;
    for (Level& level : levels_) {
        level.error = 0;
        area += (level.s1 - level.s0) * level.flow;
    }
    for (std::size_t n = 0; n + 1 < levels_.size(); ++n) {
        Level &a = levels_[n], &b = levels_[n + 1];
        const double error = error_between(a, b);
        Level& larger = a.s1 - a.s0 >= b.s1 - b.s0 ? a : b;
        larger.error = std::max(larger.error, error);
    }
    return area;
}

double EngagementProbe::refine(const field::CarvedView& stock, const CutPose& pose, double known_area) {
    double speed = 0;
    for (const Level& level : levels_) speed = std::max(speed, level.speed);
    const double least = kLeastArea * radius_mm_ * radius_mm_ * speed;
    double area = judge();
    while (!levels_.empty() && levels_.size() < kMostLevels) {
        const double most = std::max(kAreaShare * (known_area + area), least);
        const auto worst = std::max_element(levels_.begin(), levels_.end(),
                                            [](const Level& a, const Level& b) { return a.error < b.error; });
        if (worst == levels_.end() || worst->error <= most) break;
        // In thirds: the middle one keeps its circle if that lies in it.
        const Level whole = *worst;
        const double third = (whole.s1 - whole.s0) / 3, s0 = whole.s0 + third, s1 = whole.s1 - third;
        const auto at = worst - levels_.begin();
        if (whole.s > s0 && whole.s < s1) {
            worst->s0 = s0;
            worst->s1 = s1;
            worst->step_below = worst->step_above = false;
        } else {
            *worst = look(s0, s1, stock, pose);
        }
        levels_.insert(levels_.begin() + at, look(whole.s0, s0, stock, pose))->step_below = whole.step_below;
        levels_.insert(levels_.begin() + at + 2, look(s1, whole.s1, stock, pose))->step_above =
            whole.step_above;
        area = judge();
    }
    return area;
}

// An arc that ends nearer than this to the end of the window ends with the window, rad.
constexpr double kSide = 0.01;
bool EngagementProbe::starts_with_window(const Level& level, const MaterialArc& arc) const {
    return arc.from_rad - level.window.from_rad < kSide;
}
bool EngagementProbe::ends_with_window(const Level& level, const MaterialArc& arc) const {
    return level.window.to_rad - arc.to_rad < kSide;
}

// A border of an arc over the stretch of a level: its mean, and its slope per mm of meridian.
struct EngagementProbe::BorderRun {
    double mean, slope;
};

// Computes the run of a border from the same border on the levels below and above. The bend of the three
// corrects the mean. The slope is the harmonic mean of both sides; it is 0 if one side rises and the other
// falls.
EngagementProbe::BorderRun EngagementProbe::run_of(double low, double middle, double high, double from_below,
                                                   double to_above, double size) {
    const auto step = [](double from, double to) {  // the rotations may lie whole turns apart
        return to - from - math::kTwoPi * std::floor((to - from) / math::kTwoPi + 0.5);
    };
    const double before = step(low, middle) / from_below, after = step(middle, high) / to_above;
    const double mean = middle + size * size / (12 * (from_below + to_above)) * (after - before);
    return {mean, before * after > 0 ? 2 * before * after / (before + after) : 0};
}

// Adds the last arc of a contact that gets narrower from `inner` on and ends at `end` or before. Where two
// smooth surfaces separate, the square of the width falls linearly.
void EngagementProbe::add_closing_arc(const Level& level, const Level& inner, double end, std::size_t number,
                                      const CutPose& pose, Engagement& out) const {
    const MaterialArc &arc = arcs_[level.first + number], &before = arcs_[inner.first + number];
    const double width = arc.to_rad - arc.from_rad, wider = before.to_rad - before.from_rad;
    // A smaller fall counts as no fall.
    constexpr double kLevelRad = 1e-4;
    if (!(width < wider - kLevelRad)) {
        add_band(level, arc, level.s0, level.s1, arc, pose, out);
        return;
    }
    const double fall = (wider * wider - width * width) / std::abs(level.s - inner.s);  // per mm
    const double way = end > level.s ? 1 : -1;
    const double half = way > 0 ? level.s1 - level.s : level.s - level.s0;
    const double begin = way > 0 ? level.s0 - level.s : level.s - level.s1;
    // If the contact is still open at `end`, it ends with a step somewhere in between.
    const double closed = width * width / fall;
    const double reach = closed < std::abs(end - level.s) ? closed : half;
    const bool at_start = starts_with_window(level, arc), at_end = ends_with_window(level, arc);
    const auto cubed = [&](double x) {  // cube of the width at x, x towards the end
        const double square = std::max(width * width - fall * x, 0.0);
        return square * std::sqrt(square);
    };
    constexpr int kPieces = 2;
    for (int piece = 0; piece < kPieces; ++piece) {
        const int n = way > 0 ? piece : kPieces - 1 - piece;  // in the order of the meridian
        const double x0 = begin + (reach - begin) * n / kPieces;
        const double x1 = begin + (reach - begin) * (n + 1) / kPieces;
        const double mean = std::min((cubed(x0) - cubed(x1)) / (1.5 * fall * (x1 - x0)), wider);
        const double share = at_start == at_end ? 0.5 : at_start ? 0 : 1;  // of the lost width, at the start
        const double from = arc.from_rad + share * (width - mean);
        const double a = level.s + way * x0, b = level.s + way * x1;
        add_band(level, arc, std::min(a, b), std::max(a, b), {from, from + mean}, pose, out);
    }
}

void EngagementProbe::add_arc(std::size_t index, std::size_t number, const CutPose& pose,
                              Engagement& out) const {
    const Level& level = levels_[index];
    const MaterialArc& arc = arcs_[level.first + number];
    const Level* below = index > 0 ? &levels_[index - 1] : nullptr;
    const Level* above = index + 1 < levels_.size() ? &levels_[index + 1] : nullptr;
    const auto alike = [&](const Level* other) { return other && other->count == level.count; };
    const auto none = [](const Level* other) { return !other || other->count == 0; };
    if (alike(below) && none(above) && !level.step_above) {
        add_closing_arc(level, *below, above ? above->s : level.s1, number, pose, out);
        return;
    }
    if (alike(above) && none(below) && !level.step_below) {
        add_closing_arc(level, *above, below ? below->s : level.s0, number, pose, out);
        return;
    }
    if (!alike(below) || !alike(above)) {
        add_band(level, arc, level.s0, level.s1, arc, pose, out);
        return;
    }
    const MaterialArc &a = arcs_[below->first + number], &b = arcs_[above->first + number];
    const double from_below = level.s - below->s, to_above = above->s - level.s;
    const double size = level.s1 - level.s0;
    const BorderRun from = run_of(a.from_rad, arc.from_rad, b.from_rad, from_below, to_above, size);
    const BorderRun to = run_of(a.to_rad, arc.to_rad, b.to_rad, from_below, to_above, size);
    // A border that is not level is approximated by steps of this size.
    constexpr double kStepRad = 0.15;
    constexpr double kMostSteps = 3;
    const double skew = size * std::max(std::abs(from.slope), std::abs(to.slope));
    const int steps = static_cast<int>(std::clamp(std::ceil(skew / kStepRad), 1.0, kMostSteps));
    for (int n = 0; n < steps; ++n) {
        const double s0 = level.s0 + size * n / steps, s1 = level.s0 + size * (n + 1) / steps;
        const double x = 0.5 * (s0 + s1) - level.s;
        add_band(level, arc, s0, s1, {from.mean + from.slope * x, to.mean + to.slope * x}, pose, out);
    }
}

// Adds a band from s0 to s1 for the arc `seen` of the level. If `seen` ends with the window, the band extends
// as far as the window does anywhere on it: the force computation knows where each edge moves outward.
void EngagementProbe::add_band(const Level& level, const MaterialArc& seen, double s0, double s1,
                               MaterialArc arc, const CutPose& pose, Engagement& out) const {
    if (!(s1 > s0)) return;
    TurnWindow wide = level.window;
    for (const double s : {s0, s1}) {
        const TurnWindow w = window_above(normal_travel(pose.travel, profile_.at(s)), 0);
        if (w.empty()) continue;
        const double turn = math::kTwoPi * std::floor((w.from_rad - wide.from_rad) / math::kTwoPi + 0.5);
        wide.from_rad = std::min(wide.from_rad, w.from_rad - turn);
        wide.to_rad = std::max(wide.to_rad, w.to_rad - turn);
    }
    wide.to_rad = std::min(wide.to_rad, wide.from_rad + math::kTwoPi);
    if (starts_with_window(level, seen)) arc.from_rad = wide.from_rad;
    if (ends_with_window(level, seen)) arc.to_rad = wide.to_rad;
    for (const double turn : {-math::kTwoPi, 0.0, math::kTwoPi}) {
        const double from = std::max(arc.from_rad + turn, 0.0);
        const double to = std::min(arc.to_rad + turn, math::kTwoPi);
        if (!(to > from)) continue;
        if (profile_.is_level(level.s)) {
            const ProfilePoint a = profile_.at(s0), b = profile_.at(s1);
            out.bottom.push_back({std::min(a.radius_mm, b.radius_mm), std::max(a.radius_mm, b.radius_mm),
                                  from, to, level.at.height_mm, level.at.cos_kappa < 0});
            continue;
        }
        const double z0 = profile_.at(s0).height_mm, z1 = profile_.at(s1).height_mm;
        if (!joined_below(out.bands, s0, {z0, z1, from, to})) out.bands.push_back({z0, z1, from, to});
    }
}

// Extends the band right below on the cylinder if the borders of both are alike.
bool EngagementProbe::joined_below(std::vector<EngagementBand>& bands, double s0,
                                   const EngagementBand& band) const {
    if (!profile_.is_straight(s0)) return false;
    for (std::size_t n = bands.size(); n-- > 0;) {
        EngagementBand& below = bands[n];
        if (below.z1_mm != band.z0_mm || std::abs(below.entry_rad - band.entry_rad) >= kAlikeRad ||
            std::abs(below.exit_rad - band.exit_rad) >= kAlikeRad)
            continue;
        const double share = (band.z1_mm - band.z0_mm) / (band.z1_mm - below.z0_mm);
        below.entry_rad += share * (band.entry_rad - below.entry_rad);
        below.exit_rad += share * (band.exit_rad - below.exit_rad);
        below.z1_mm = band.z1_mm;
        return true;
    }
    return false;
}

void EngagementProbe::add_bands(const CutPose& pose, Engagement& out) const {
    for (std::size_t index = 0; index < levels_.size(); ++index) {
        for (std::size_t n = 0; n < levels_[index].count; ++n) add_arc(index, n, pose, out);
    }
}

// The lateral parts first, then the level ones.
template <class Look>
void EngagementProbe::each_part_of_profile(const CutPose& pose, double low, double high, Look look) const {
    const ToolTravel& travel = pose.travel;
    for (const bool level : {false, true}) {
        for (const CutterProfile::Part& part : profile_.parts()) {
            const double z0 = std::max(low, part.element.from.z), z1 = std::min(high, part.element.to.z);
            if (part.is_level() != level || z0 > z1 || (z0 == z1 && !level)) continue;
            const double down = part.faces_up() ? -travel.down_mm : travel.down_mm;
            if (level && !(down > 0) && !travel.turns()) continue;
            double s0 = level ? part.s0 : part.at_height(z0), s1 = level ? part.s1 : part.at_height(z1);
            // Within the core nothing cuts.
            const double r0 = part.at(s0).radius_mm, r1 = part.at(s1).radius_mm;
            if (in_core_ ? std::min(r0, r1) >= core_mm_ : std::max(r0, r1) <= core_mm_) continue;
            const auto end_at_core = [&](double& s, double r, double opposite) {
                if (in_core_ && r >= core_mm_) s = s_at_radius(part, opposite, s, core_mm_);
                if (!in_core_ && r < core_mm_) s = s_at_radius(part, s, opposite, core_mm_);
            };
            end_at_core(s0, r0, s1);
            end_at_core(s1, r1, s0);
            if (s1 > s0) look(s0, s1);
        }
    }
}

template <class Look>
void EngagementProbe::each_part(const field::CarvedView& stock, const CutPose& pose, Look look) const {
    double low, high;
    if (!clip_heights(stock, pose, low, high)) return;
    if (!profile_.parts().empty()) {
        each_part_of_profile(pose, low, high, look);
        return;
    }
    const double bottom = profile_.bottom_end(), core = std::min(core_mm_, bottom);
    const bool bottom_moves = low <= 0 && (pose.travel.down_mm > 0 || pose.travel.turns());
    if (in_core_) {
        if (bottom_moves && core > 0) look(0, core);
        return;
    }
    const double s0 = profile_.at_height(low), s1 = profile_.at_height(high);
    const double corner = std::clamp(profile_.corner_end(), s0, s1);
    if (corner > s0) look(s0, corner);
    if (s1 > corner) look(corner, s1);
    if (bottom_moves && bottom > core_mm_) look(core_mm_, bottom);
}

void EngagementProbe::measure(const field::CarvedView& stock, const CutPose& pose, Engagement& out) {
    out.clear();
    levels_.clear();
    arcs_.clear();
    double lateral = 0;
    const auto finish = [&] {
        lateral = refine(stock, pose, lateral);
        add_bands(pose, out);
        levels_.clear();
        arcs_.clear();
    };
    each_part(stock, pose, [&](double s0, double s1) {
        // The bottom is refined alone, after the lateral area is known; so is each part of a profile.
        if (profile_.is_level(s0) || !profile_.parts().empty()) finish();
        start(s0, s1, stock, pose);
    });
    finish();
}

void EngagementProbe::measure_core(const field::CarvedView& stock, const CutPose& pose, Engagement& out) {
    in_core_ = true;
    measure(stock, pose, out);
    in_core_ = false;
}

bool EngagementProbe::touches(const field::CarvedView& stock, const CutPose& pose) {
    stretches_.clear();
    each_part(stock, pose, [&](double s0, double s1) { scout_.look(stock, pose, s0, s1, stretches_); });
    return std::any_of(stretches_.begin(), stretches_.end(),
                       [](const MeridianStretch& stretch) { return stretch.engaged; });
}

bool EngagementProbe::touches(const field::CarvedView& stock, const CutPose& pose,
                              const Engagement& near_by) {
    const auto is_in_material = [&](const ProfilePoint& at, double entry, double exit) {
        const double r = at.radius_mm;
        const AxisCircle circle{pose.on_axis(at.height_mm), r * pose.frame.x, r * pose.frame.y, r};
        return stock.is_material(circle.at(0.5 * (entry + exit)), kSkin);
    };
    for (const EngagementBand& b : near_by.bands) {
        const ProfilePoint at = profile_.at(profile_.at_height(0.5 * (b.z0_mm + b.z1_mm)));
        if (is_in_material(at, b.entry_rad, b.exit_rad)) return true;
    }
    for (const BottomBand& b : near_by.bottom)
        if (is_in_material(point_of(b, 0.5 * (b.r0_mm + b.r1_mm)), b.entry_rad, b.exit_rad)) return true;
    return touches(stock, pose);
}

double chip_mm3(const Cutter& cutter, const Engagement& engagement, const ToolTravel& travel) {
    const CutterProfile profile(cutter);
    // Gauss-Legendre along the meridian, closed form over the rotation.
    constexpr double kPlace[3] = {-0.77459666924148337704, 0, 0.77459666924148337704};
    constexpr double kWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double volume = 0;
    const auto add_piece = [&](const auto& point_at, double s0, double s1, double entry, double exit) {
        for (int n = 0; n < 3; ++n) {
            const ProfilePoint at = point_at(0.5 * (s0 + s1) + 0.5 * (s1 - s0) * kPlace[n]);
            const TurnLaw law = normal_travel(travel, at);
            const TurnWindow window = window_above(law, 0);
            const double weight = kWeight[n] * (s1 - s0) * at.radius_mm;
            for (int turn = -1; turn <= 1; ++turn) {
                const double from = std::max(entry, window.from_rad + turn * math::kTwoPi);
                const double to = std::min(exit, window.to_rad + turn * math::kTwoPi);
                if (!(to > from)) continue;
                volume += weight * integral(law, from, to);
            }
        }
    };
    // Where the axis turns, the window in which an edge moves outward has kinks along the meridian. So it is
    // cut into pieces, into few where it is short.
    constexpr int kArcPieces = 48;
    constexpr double kPieceOfRadius = 0.04;
    const int kinked = travel.turns() ? 6 : 1;
    const auto add_along = [&](const auto& point_at, double s0, double s1, double entry, double exit,
                               int most_pieces) {
        const double needed = std::ceil((s1 - s0) / (kPieceOfRadius * cutter.radius_mm()));
        const int pieces = std::max(1, static_cast<int>(std::min<double>(most_pieces, needed)));
        for (int n = 0; n < pieces && s1 > s0; ++n)
            add_piece(point_at, s0 + (s1 - s0) * n / pieces, s0 + (s1 - s0) * (n + 1) / pieces, entry, exit);
    };
    const auto add = [&](double s0, double s1, double entry, double exit) {
        add_along([&](double s) { return profile.at(s); }, s0, s1, entry, exit, kinked);
    };
    for (const BottomBand& b : engagement.bottom)
        add_along([&](double r) { return point_of(b, r); }, b.r0_mm, b.r1_mm, b.entry_rad, b.exit_rad,
                  kinked);
    for (const EngagementBand& b : engagement.bands) {
        if (!profile.parts().empty()) {
            profile.over_parts(b.z0_mm, b.z1_mm, [&](const CutterProfile::Part& part, double z0, double z1) {
                // On an arc the window has kinks where the tool moves along its axis, too.
                const bool arc = part.element.is_arc() && (travel.down_mm != 0 || travel.turns());
                add_along([&](double s) { return part.at(s); }, part.at_height(z0), part.at_height(z1),
                          b.entry_rad, b.exit_rad, arc ? kArcPieces : kinked);
            });
            continue;
        }
        const double s0 = profile.at_height(b.z0_mm), s1 = profile.at_height(b.z1_mm);
        const double middle = std::clamp(profile.corner_end(), s0, s1);
        add(s0, middle, b.entry_rad, b.exit_rad);
        add(middle, s1, b.entry_rad, b.exit_rad);
    }
    return volume;
}

}  // namespace tribo::milling
