// SPDX-License-Identifier: MIT
// Contours: radius compensation RL and RR, the corners RND and CHF, APPR and DEP.
#include <cmath>

#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kMostTurnDeg = 360;

}  // namespace

ContourWords Interpreter::contour_words(bool rapid) const {
    return {rapid, path_.feed_mm_per_min, path_.spindle_rpm, path_.tool, place(line_.column)};
}

// RL, RR and R0 of the block. They stay in force.
Result<void> Interpreter::choose_side(const Words& words) {
    if (!words.side) return {};
    const int side = mirror_.x * mirror_.y < 0 ? -*words.side : *words.side;
    if (side != side_) {
        if (auto done = close_contour(); !done) return done;
    }
    side_ = side;
    return {};
}

// Closes the contour: the moves that wait are known now.
Result<void> Interpreter::close_contour() {
    return contour_.is_open() ? contour_.run(path_) : Result<void>{};
}

// True if the next block that moves is RND or CHF.
bool Interpreter::corner_follows() const {
    if (corner_next_) return *corner_next_;
    for (std::size_t i = at_ + 1; i < lines_.size(); ++i) {
        const Line line = line_at(i);
        if (line.text.empty() || line.text[0] == '*') continue;
        LineReader in(line, source_name_, parameters_);
        return in.take("RND") || in.take("CHF");
    }
    return false;
}

// Returns true if the contour keeps the move until it knows what follows.
Result<bool> Interpreter::add_to_contour(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc,
                                         bool turns) {
    if (auto done = choose_side(words); !done) return std::unexpected(done.error());
    const Vec3 from = here();
    const bool is_flat = arc || to.x != from.x || to.y != from.y;
    const Place where = place(words.first_column);
    const bool was_open = contour_.is_open();
    if (!was_open) {
        const bool corner_next = is_flat && corner_follows();
        if (side_ == 0 ? !corner_next : !is_flat) return false;
    }
    if (turns) {
        return path_.refuse(where, "rotary axes turn within a contour, which has no plane then",
                            "write R0 before it");
    }
    if (arc && std::abs(arc->normal.z) != 1) {
        return path_.refuse(where, "a circle outside the plane X Y within a contour is not read",
                            "write it with R0, and without RND and CHF");
    }
    if (contour_.size() >= path_.options.max_moves) {
        return path_.refuse(where, "the contour has too many elements", "write R0 between its parts");
    }
    if (auto done = check_start(words.fast); !done) return std::unexpected(done.error());
    if (!words.fast && !path_.feed_mm_per_min) {
        return path_.refuse(where, "a feed move before any F", "write F, or FMAX for a rapid");
    }
    if (!was_open) {
        if (side_ != 0 && arc) {
            if (follows_refusal()) return false;
            return path_.refuse(where, "radius compensation begins with a circle",
                                "write RL or RR in a line before it, or in APPR");
        }
        double radius_mm = 0;
        if (side_ != 0) {
            const auto known = compensation_radius(where);
            if (!known) return std::unexpected(known.error());
            radius_mm = *known;
        }
        contour_.open(path_.tip(), side_, radius_mm, side_ != 0);
    }
    contour_.add(to, arc, contour_words(words.fast));
    if (side_ == 0 && (words.fast || !contour_.has_approach()) && !corner_follows()) {
        if (auto done = contour_.run(path_); !done) return std::unexpected(done.error());
    }
    return true;
}

// The radius of the tool with DR; 0 with a warning where nothing states it.
Result<double> Interpreter::compensation_radius(Place where) {
    const auto radius = path_.tool_radius_mm(unit_mm_);
    if (!radius) {
        if (path_.first(kNoRadius)) {
            path_.warn(where.line,
                       "radius compensation, but " + path_.notes.no_diameter_text(path_.tool, "radius") +
                           ": the programmed path is taken for that of its centre; give the tool to the "
                           "job or write TOOL DEF with R");
        }
        return 0.0;
    }
    const double whole = *radius + tool_oversize_mm_;
    if (!kLimits.offset_diameter.range.contains(2 * whole)) {
        return path_.refuse(where, out_of_range(kLimits.offset_diameter, 2 * whole),
                            "correct the radius of the tool, or DR");
    }
    return whole;
}

// RND R5 and CHF 5, between two elements of a contour.
Result<void> Interpreter::corner(LineReader& in, bool is_chamfer) {
    const auto words = read_words(in, is_chamfer ? "CHF" : "RND");
    if (!words) return std::unexpected(words.error());
    const auto size = is_chamfer ? words->length : words->radius;
    if (!size || !(*size >= 0)) {
        return in.refuse(words->first_column,
                         is_chamfer ? "CHF without its length" : "RND without a radius R",
                         is_chamfer ? "write CHF 2" : "write RND R5");
    }
    if (auto good = in.in_range(kLimits.coordinate, *size, words->first_column); !good) return good;
    if (!free_) return add_corner(*words, is_chamfer);
    free_->blocks.push_back(
        {line_, *words, is_chamfer ? FreeBlock::Kind::chamfer : FreeBlock::Kind::rounding});
    return {};
}

Result<void> Interpreter::add_corner(const Words& words, bool is_chamfer) {
    if (captured_ && !captured_->steps.empty()) {
        captured_->steps.back().corner_mm = *(is_chamfer ? words.length : words.radius);
        captured_->steps.back().is_chamfer = is_chamfer;
        return {};
    }
    if (!contour_.is_open()) {
        return path_.refuse(place(words.first_column),
                            std::string(is_chamfer ? "CHF" : "RND") + " without a path function before it",
                            "write it between two elements of a contour");
    }
    const auto modal = path_.feed_mm_per_min;
    if (auto done = apply_feed(words); !done) return done;
    const double size = *(is_chamfer ? words.length : words.radius);
    if (size > 0) contour_.corner(size, is_chamfer, contour_words(false));
    path_.feed_mm_per_min = modal;  // the feed of a corner is its own
    return miscellaneous(words);
}

// APPR LT X+10 Y+20 LEN15 RL F100, and with P the point in polar coordinates.
Result<void> Interpreter::approach(LineReader& in) {
    const int column = in.column();
    ContourEndShape shape;
    bool polar = false;
    if (auto done = contour_end(in, shape.shape, polar); !done) return done;
    const auto words = read_words(in, "APPR");
    if (!words) return std::unexpected(words.error());
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    const auto has = has_start(*words, polar);
    if (!has) return std::unexpected(has.error());
    if (!*has) return {};
    shape.way = contour_words(last_was_rapid_);
    if (auto done = apply_feed(*words); !done) return done;
    if (auto done = contour_end_sizes(*words, column, shape); !done) return done;
    if (shape.shape == ContourEnd::line_circle) shape.way = contour_words(words->fast);
    if (auto done = check_start(words->fast); !done) return done;
    for (const ContourWords& part : {shape.way, contour_words(words->fast)}) {
        if (!part.rapid && !part.feed_mm_per_min) {
            return in.refuse(column, "a feed move before any F", "write F in APPR or before it");
        }
    }
    const auto to = polar ? polar_target(*words) : target(*words);
    if (!to) return std::unexpected(to.error());
    if (auto done = choose_side(*words); !done) return done;
    double radius_mm = 0;
    if (side_ != 0) {
        const auto known = compensation_radius(place(column));
        if (!known) return std::unexpected(known.error());
        radius_mm = *known;
    }
    shape.point = *to;
    contour_.open(path_.tip(), side_, radius_mm, false);
    contour_.approach(shape, contour_words(words->fast));
    last_was_rapid_ = words->fast;
    return miscellaneous(*words);
}

// DEP LT LEN10 F500, DEP LCT X+10 Y+12 R+8.
Result<void> Interpreter::depart(LineReader& in) {
    const int column = in.column();
    ContourEndShape shape;
    bool polar = false;
    if (auto done = contour_end(in, shape.shape, polar); !done) return done;
    const auto words = read_words(in, "DEP");
    if (!words) return std::unexpected(words.error());
    if (!contour_.is_open()) {
        return in.refuse(column, "DEP without a contour before it",
                         "begin the contour with APPR, or with RL or RR in a line");
    }
    if (auto done = apply_feed(*words); !done) return done;
    if (auto done = contour_end_sizes(*words, column, shape); !done) return done;
    const auto to = polar ? polar_target(*words) : target(*words);
    if (!to) return std::unexpected(to.error());
    shape.point = *to;
    contour_.depart(shape, contour_words(words->fast));
    if (auto done = contour_.run(path_); !done) return done;
    side_ = 0;
    last_was_rapid_ = words->fast;
    return miscellaneous(*words);
}

Result<void> Interpreter::contour_end(LineReader& in, ContourEnd& shape, bool& polar) {
    constexpr struct {
        std::string_view word;
        ContourEnd shape;
    } shapes[] = {{"LT", ContourEnd::line_tangent},
                  {"LN", ContourEnd::line_normal},
                  {"CT", ContourEnd::circle},
                  {"LCT", ContourEnd::line_circle}};
    for (const auto& known : shapes) {
        const std::string with_pole = "P" + std::string(known.word);
        polar = in.take(with_pole);
        if (!polar && !in.take(known.word)) continue;
        shape = known.shape;
        return {};
    }
    return in.refuse(in.column(), "APPR or DEP without a known shape", "write LT, LN, CT or LCT after it");
}

Result<void> Interpreter::contour_end_sizes(const Words& words, int column, ContourEndShape& shape) {
    const bool is_arc = shape.shape == ContourEnd::circle || shape.shape == ContourEnd::line_circle;
    if (is_arc ? !words.radius || *words.radius == 0 : !words.length || !(*words.length >= 0)) {
        return path_.refuse(place(column),
                            is_arc ? "APPR or DEP without a radius R" : "APPR or DEP without LEN",
                            is_arc ? "write for example R+5" : "write for example LEN10");
    }
    const double size = is_arc ? *words.radius : *words.length;
    if (auto good = path_.in_range(kLimits.coordinate, size, place(column)); !good) return good;
    (is_arc ? shape.radius_mm : shape.length_mm) = size;
    if (shape.shape != ContourEnd::circle) return {};
    if (!words.angle || !(*words.angle > 0) || *words.angle > kMostTurnDeg) {
        return path_.refuse(place(column), "APPR CT or DEP CT without an angle CCA of 0 to 360 degrees",
                            "write for example CCA90");
    }
    shape.turn_rad = *words.angle * math::kRadPerDeg;
    return {};
}

}  // namespace tribo::readers::heidenhain
