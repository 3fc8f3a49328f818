// SPDX-License-Identifier: MIT
#include "readers/control/contour.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::control {
namespace {

using gcode::Element;
using gcode::Point;

// Directions that differ by less than this count as one, rad.
constexpr double kStraightTurnRad = 1e-6;
constexpr double kSamePointMm = 1e-7;

Point moved(Point p, Point direction, double by) {
    return {p.u + by * direction.u, p.v + by * direction.v};
}
Point left_of(Point a) {
    return {-a.v, a.u};
}

Point turned_about(Point centre, Point p, double rad) {
    const double c = math::cos(rad), s = math::sin(rad), u = p.u - centre.u, v = p.v - centre.v;
    return {centre.u + c * u - s * v, centre.v + s * u + c * v};
}

Point flat(Vec3 p) {
    return {p.x, p.y};
}

}  // namespace

void Contour::open(Vec3 tip, int side, double radius_mm, bool has_entry) {
    *this = {};
    is_open_ = true;
    has_entry_ = has_entry;
    side_ = side;
    left_mm_ = side * radius_mm;
    start_ = tip;
    programmed_ = tip;
}

void Contour::approach(const ContourEndShape& shape, const ContourWords& words) {
    approach_ = shape;
    approach_words_ = words;
    programmed_ = shape.point;
}

void Contour::add(Vec3 to, const std::optional<motion::Arc>& arc, const ContourWords& words) {
    Piece piece;
    piece.element.start = flat(*programmed_);
    piece.element.end = flat(to);
    if (arc) {
        piece.element.centre = flat(arc->centre_mm);
        piece.element.turn_rad = arc->turn_rad * (arc->normal.z < 0 ? -1 : 1);
    }
    piece.from_z = programmed_->z;
    piece.to_z = to.z;
    piece.words = words;
    pieces_.push_back(piece);
    programmed_ = to;
}

void Contour::add_steps(const std::vector<ContourStep>& steps, double z, const ContourWords& words) {
    for (std::size_t i = 1; i < steps.size(); ++i) {
        const ContourStep& step = steps[i];
        add({step.to.x, step.to.y, z}, step.arc, words);
        const bool is_last = i + 1 == steps.size();
        if (step.corner_mm > 0 && !is_last)
            corner(step.corner_mm, step.is_chamfer, words, step.is_own_length);
    }
}

void Contour::corner(double size_mm, bool is_chamfer, const ContourWords& words, bool is_own_length) {
    Piece piece;
    piece.is_corner = true;
    piece.is_chamfer = is_chamfer;
    piece.is_own_length = is_own_length;
    piece.size_mm = size_mm;
    piece.words = words;
    pieces_.push_back(piece);
}

void Contour::depart(const ContourEndShape& shape, const ContourWords& words) {
    departure_ = shape;
    departure_words_ = words;
}

// Puts an element into each RND and CHF, and shortens its neighbours.
Result<Contour::Pieces> Contour::with_corners(const Path& path) const {
    Pieces done;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (!pieces_[i].is_corner) {
            done.push_back(pieces_[i]);
            continue;
        }
        Piece corner = pieces_[i];
        const char* name = corner.is_chamfer ? "CHF" : "RND";
        const bool has_both = !done.empty() && done.back().is_flat() && i + 1 < pieces_.size() &&
                              !pieces_[i + 1].is_corner && pieces_[i + 1].is_flat() &&
                              !(has_entry_ && done.size() == 1);
        if (!has_both) {
            return path.refuse(corner.words.place,
                               std::string(name) + " does not stand between two elements of a contour",
                               "write it between two path functions in one plane");
        }
        Piece& before = done.back();
        Piece next = pieces_[++i];
        const double turn =
            gcode::turn_between(before.element.end_direction(), next.element.start_direction());
        corner.from_z = corner.to_z = before.to_z;
        if (std::abs(turn) < kStraightTurnRad) {
            done.push_back(next);
            continue;
        }
        if (corner.is_own_length) corner.size_mm /= 2 * math::cos(turn / 2);
        const auto between = corner.is_chamfer
                                 ? gcode::chamfered(before.element, next.element, corner.size_mm)
                                 : gcode::rounded(before.element, next.element, corner.size_mm);
        if (!between) {
            return path.refuse(
                corner.words.place,
                std::string(name) + " of " + mm_text(corner.size_mm) +
                    " does not fit between the elements beside it",
                corner.is_chamfer ? "write it between two lines that are longer" : "take a smaller radius");
        }
        corner.element = *between;
        done.push_back(corner);
        done.push_back(next);
    }
    return done;
}

// Offsets the contour by the radius of the cutter. The way to the contour ends beside its first element,
// square to it. Outside corners are rounded, inside corners end where the offsets meet (TNC 640 manual,
// radius compensation).
Result<Contour::Pieces> Contour::offset(const Path& path, const Pieces& pieces) const {
    if (left_mm_ == 0) return pieces;
    Pieces done;
    const Piece* before = nullptr;
    std::size_t last = 0;
    const auto offset_of = [&](const Piece& piece) { return gcode::offset(piece.element, left_mm_); };
    const auto first = std::find_if(pieces.begin() + (has_entry_ ? 1 : 0), pieces.end(),
                                    [](const Piece& piece) { return piece.is_flat(); });
    const bool is_alone = first == pieces.end();
    Point at = flat(start_);
    if (const auto found =
            is_alone ? (has_entry_ ? offset_of(pieces[0]) : std::nullopt) : offset_of(*first)) {
        at = is_alone ? found->end : found->start;
    }
    std::size_t i = 0;
    if (has_entry_) {
        done.push_back(pieces[0]);
        done[0].element.end = at;
        i = 1;
    }
    for (; i < pieces.size(); ++i) {
        Piece piece = pieces[i];
        if (!piece.is_flat()) {
            piece.element.start = piece.element.end = at;
            done.push_back(piece);
            continue;
        }
        const auto beside = offset_of(piece);
        if (!beside) {
            return path.refuse(piece.words.place,
                               "the arc's radius " +
                                   mm_text(gcode::distance(piece.element.end, piece.element.centre)) +
                                   " is not larger than the cutter's, " + mm_text(std::abs(left_mm_)),
                               "take a smaller cutter or round the corner more");
        }
        piece.element = *beside;
        if (before == nullptr) {
            done.push_back(piece);
        } else if (auto joined = join(path, *before, pieces[i], piece, done, last); !joined) {
            return std::unexpected(joined.error());
        }
        before = &pieces[i];
        last = done.size() - 1;
        at = done.back().element.end;
    }
    return done;
}

// Joins the offset of the next element to the last one, done[last].
Result<void> Contour::join(const Path& path, const Piece& before, const Piece& next, Piece piece,
                           Pieces& done, std::size_t last) const {
    const double turn = gcode::turn_between(before.element.end_direction(), next.element.start_direction());
    const Point at = done[last].element.end;
    if (std::abs(turn) < kStraightTurnRad) {
        piece.element.set_start(at);
    } else if (left_mm_ * turn < 0) {
        Piece about = piece;
        about.to_z = about.from_z;
        about.element = {at, piece.element.start, next.element.start, turn};
        done.push_back(about);
    } else {
        const auto meets = gcode::meeting(done[last].element, piece.element);
        if (!meets) {
            return path.refuse(piece.words.place,
                               "the cutter of " + mm_text(2 * std::abs(left_mm_)) +
                                   " diameter does not fit into the inside corner at the start of this "
                                   "block without gouging line " +
                                   std::to_string(before.words.place.line) + " or this one",
                               "take a smaller cutter or leave out moves that are too short for it");
        }
        done[last].element.set_end(*meets);
        for (std::size_t k = last + 1; k < done.size(); ++k) {
            done[k].element.start = done[k].element.end = *meets;
        }
        piece.element.set_start(*meets);
    }
    done.push_back(piece);
    return {};
}

// Puts the way of APPR before the contour. R and LEN are those of the path of the tool's centre.
Result<Contour::Pieces> Contour::approached(const Path& path, Pieces pieces) const {
    if (!approach_) return pieces;
    const Place where = approach_words_.place;
    const auto first =
        std::find_if(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.is_flat(); });
    if (first == pieces.end()) {
        return path.refuse(where, "APPR without a contour element after it",
                           "write the first line or circle of the contour after it");
    }
    const Point a = first->element.start, t = first->element.start_direction(), from = flat(start_);
    const double aside = (from.u - a.u) * -t.v + (from.v - a.v) * t.u;
    const int side = side_ != 0 ? side_ : aside < 0 ? -1 : 1;
    const ContourEndShape& shape = *approach_;
    const bool is_arc = shape.shape == ContourEnd::circle || shape.shape == ContourEnd::line_circle;
    const int turns = shape.radius_mm < 0 ? -side : side;
    const Point centre = moved(a, left_of(t), side * shape.radius_mm);
    Point begin = a;
    if (shape.shape == ContourEnd::line_tangent) begin = moved(a, t, -shape.length_mm);
    if (shape.shape == ContourEnd::line_normal) begin = moved(a, left_of(t), side * shape.length_mm);
    if (shape.shape == ContourEnd::circle) begin = turned_about(centre, a, -turns * shape.turn_rad);
    if (shape.shape == ContourEnd::line_circle) {
        const double apart = gcode::distance(centre, from), radius = std::abs(shape.radius_mm);
        if (!(apart > radius + kSamePointMm)) {
            return path.refuse(where, "APPR LCT starts inside of its circle of " + mm_text(radius),
                               "start farther away or take a smaller R");
        }
        const double to_start = math::atan2(from.v - centre.v, from.u - centre.u);
        const double rad = to_start + turns * math::acos(radius / apart);
        begin = {centre.u + radius * math::cos(rad), centre.v + radius * math::sin(rad)};
    }
    Pieces done(2);
    done[0].words = approach_->way;
    done[0].element = {from, begin, {}, 0};
    done[0].from_z = done[0].to_z = start_.z;
    done[1].words = approach_->way;
    done[1].element = {begin, begin, {}, 0};
    done[1].to_z = approach_->point.z;
    Piece last;
    last.words = approach_words_;
    last.from_z = last.to_z = approach_->point.z;
    last.element = is_arc ? gcode::arc_about(centre, begin, a, turns) : Element{begin, a, {}, 0};
    if (shape.shape == ContourEnd::circle) last.element.turn_rad = turns * shape.turn_rad;
    done.push_back(last);
    done.insert(done.end(), pieces.begin(), pieces.end());
    return done;
}

Result<void> Contour::append_departure(const Path& path, Pieces& pieces) const {
    if (!departure_) return {};
    const Place where = departure_words_.place;
    const auto last =
        std::find_if(pieces.rbegin(), pieces.rend(), [](const Piece& piece) { return piece.is_flat(); });
    if (last == pieces.rend()) {
        return path.refuse(where, "DEP without a contour element before it",
                           "write the last line or circle of the contour before it");
    }
    const ContourEndShape& shape = *departure_;
    const Point e = last->element.end, t = last->element.end_direction(), to = flat(shape.point);
    const double aside = (to.u - e.u) * -t.v + (to.v - e.v) * t.u;
    const int side = side_ != 0 ? side_ : shape.shape == ContourEnd::line_circle && aside < 0 ? -1 : 1;
    const int turns = shape.radius_mm < 0 ? -side : side;
    const Point centre = moved(e, left_of(t), side * shape.radius_mm);
    Piece way;
    way.words = departure_words_;
    way.from_z = way.to_z = pieces.back().to_z;
    way.element = {e, e, {}, 0};
    if (shape.shape == ContourEnd::line_tangent) way.element.end = moved(e, t, shape.length_mm);
    if (shape.shape == ContourEnd::line_normal) {
        way.element.end = moved(e, left_of(t), side * shape.length_mm);
    }
    if (shape.shape == ContourEnd::circle) {
        way.element = {e, turned_about(centre, e, turns * shape.turn_rad), centre, turns * shape.turn_rad};
    }
    if (shape.shape == ContourEnd::line_circle) {
        const double apart = gcode::distance(centre, to), radius = std::abs(shape.radius_mm);
        if (!(apart > radius + kSamePointMm)) {
            return path.refuse(where, "DEP LCT ends inside of its circle of " + mm_text(radius),
                               "end farther away or take a smaller R");
        }
        const double rad = math::atan2(to.v - centre.v, to.u - centre.u) - turns * math::acos(radius / apart);
        way.element = gcode::arc_about(
            centre, e, {centre.u + radius * math::cos(rad), centre.v + radius * math::sin(rad)}, turns);
        pieces.push_back(way);
        way.element = {way.element.end, to, {}, 0};
    }
    pieces.push_back(way);
    way.element = {way.element.end, way.element.end, {}, 0};
    way.to_z = shape.point.z;
    pieces.push_back(way);
    return {};
}

Result<Contour::Pieces> Contour::work_out(const Path& path) const {
    auto pieces = with_corners(path);
    if (pieces) pieces = offset(path, *pieces);
    if (pieces) pieces = approached(path, *std::move(pieces));
    if (!pieces) return pieces;
    if (auto done = append_departure(path, *pieces); !done) return std::unexpected(done.error());
    return pieces;
}

Result<std::vector<gcode::Element>> Contour::elements(const Path& path) const {
    const auto pieces = with_corners(path);
    if (!pieces) return std::unexpected(pieces.error());
    std::vector<Element> flat_ones;
    for (const Piece& piece : *pieces) {
        if (piece.is_flat()) flat_ones.push_back(piece.element);
    }
    return flat_ones;
}

Result<Vec3> Contour::begin(const Path& path) const {
    const auto pieces = work_out(path);
    if (!pieces) return std::unexpected(pieces.error());
    const Point at = approach_ ? pieces->front().element.end : pieces->front().element.start;
    return Vec3{at.u, at.v, start_.z};
}

Result<void> Contour::run(Path& path) {
    is_open_ = false;
    const auto pieces = work_out(path);
    if (!pieces) return std::unexpected(pieces.error());
    const auto feed = path.feed_mm_per_min;
    const double spindle_rpm = path.spindle_rpm;
    const int tool = path.tool;
    Result<void> done;
    for (const Piece& piece : *pieces) {
        path.feed_mm_per_min = piece.words.feed_mm_per_min;
        path.spindle_rpm = piece.words.spindle_rpm;
        path.tool = piece.words.tool;
        std::optional<motion::Arc> arc;
        if (piece.element.is_arc()) {
            arc.emplace();
            arc->centre_mm = {piece.element.centre.u, piece.element.centre.v, path.tip().z};
            arc->normal = {0, 0, piece.element.turn_rad < 0 ? -1.0 : 1.0};
            arc->turn_rad = std::abs(piece.element.turn_rad);
        }
        const Vec3 to{piece.element.end.u, piece.element.end.v, piece.to_z};
        done = path.move(piece.words.rapid ? motion::MoveKind::rapid : motion::MoveKind::feed, to, arc,
                         path.rotary_rad(), piece.words.place);
        if (!done) break;
    }
    path.feed_mm_per_min = feed;
    path.spindle_rpm = spindle_rpm;
    path.tool = tool;
    pieces_.clear();
    if (left_mm_ == 0 || departure_) programmed_.reset();
    return done;
}

}  // namespace tribo::readers::control
