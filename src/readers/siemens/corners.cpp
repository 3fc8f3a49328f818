// SPDX-License-Identifier: MIT
// Contours: radius compensation G41 and G42, and the corners RND, RNDM, CHF and CHR. They wait until what
// follows is known. A corner that no element of the plane follows is left out, as the control does.
#include <cmath>

#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {

control::ContourWords Interpreter::contour_words(bool rapid) const {
    return {rapid, path_.feed_mm_per_min, path_.spindle_rpm, path_.tool, place(1)};
}

// Closes the contour or the spline: the moves that wait are known now.
Result<void> Interpreter::close_contour() {
    if (!contour_.is_open()) return close_spline();
    contour_.drop_corner();
    const motion::WorkFrame frame = path_.frame;
    const auto [u, v, w] = axes();
    const std::array<Vec3, 3> directions{frame.x, frame.y, frame.z};
    path_.frame = {frame.origin_mm, directions[static_cast<std::size_t>(u)],
                   directions[static_cast<std::size_t>(v)], directions[static_cast<std::size_t>(w)]};
    auto done = contour_.run(path_);
    path_.frame = frame;
    return done;
}

// Returns true if the contour keeps the move until it knows what follows.
Result<bool> Interpreter::add_to_contour(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc) {
    const bool rapid = is_rapid(words);
    const Vec3 from_in_plane = to_plane(here()), to_in_plane = to_plane(to);
    const bool is_flat = arc || from_in_plane.x != to_in_plane.x || from_in_plane.y != to_in_plane.y;
    const Place where = place(words.first_column);
    const double scale = std::abs(scale_[axes()[0]]);
    const bool has_chamfer = words.chamfer || words.chamfer_leg;
    const double chamfer = words.chamfer_leg.value_or(words.chamfer.value_or(0)) * unit_mm_ * scale;
    const double rounding = words.rounding ? *words.rounding * unit_mm_ * scale
                            : has_chamfer  ? 0
                                           : modal_rounding_mm_ * scale;
    const bool has_corner = !rapid && is_flat && (rounding > 0 || chamfer > 0);
    for (const double size : {chamfer, rounding}) {
        if (auto good = path_.in_range(kLimits.coordinate, size, where); !good)
            return std::unexpected(good.error());
        if (size < 0) return path_.refuse(where, "a corner of negative size", "correct RND, CHF or CHR");
    }
    const bool by_length = words.chamfer && !words.chamfer_leg;
    const Vec3 normal = arc ? to_plane(arc->normal) : Vec3{0, 0, 1};
    const bool lies_in_plane = std::abs(std::abs(normal.z) - 1) <= 1e-12;
    if (captured_ && lies_in_plane) {
        if (!is_flat && !captured_->empty()) return true;
        captured_->push_back({to_in_plane, arc, 0, rounding == 0, by_length});
        if (has_corner) captured_->back().corner_mm = rounding > 0 ? rounding : chamfer;
        if (arc) captured_->back().arc->centre_mm = to_plane(arc->centre_mm);
        if (arc) captured_->back().arc->normal = normal;
        return true;
    }
    const bool was_open = contour_.is_open();
    if (!captured_ && !was_open && (side_ == 0 ? !has_corner : !is_flat)) return false;
    if (was_open && !is_flat) {
        contour_.drop_corner();  // the control leaves it out
        if (side_ == 0) {
            if (auto done = close_contour(); !done) return std::unexpected(done.error());
            contour_.leave();
            return false;
        }
    }
    if (turns_) {
        if (side_ != 0) {
            return path_.refuse(where, "the tool turns within radius compensation, which has no plane then",
                                "write G40 before it");
        }
        if (auto done = close_contour(); !done) return std::unexpected(done.error());
        return false;
    }
    if (!lies_in_plane) {
        return path_.refuse(where, "a circle outside of the plane within a contour is not read",
                            "write it with G40, and without RND and CHF");
    }
    if (contour_.size() >= path_.options.max_moves) {
        return path_.refuse(where, "the contour has too many elements", "write G40 between its parts");
    }
    check_start(rapid);
    if (!rapid && !path_.feed_mm_per_min) return path_.refuse(where, "a feed move before any F", "write F");
    if (!was_open) {
        const int side = scale_[axes()[0]] * scale_[axes()[1]] < 0 ? -side_ : side_;
        if (side != 0 && arc) {
            return path_.refuse(where, "radius compensation begins with a circle",
                                "write G41 or G42 beside a line before it");
        }
        double radius_mm = 0;
        if (side != 0) {
            const auto known = cutter_radius(where, "radius compensation");
            if (!known) return std::unexpected(known.error());
            radius_mm = *known + contour_offset_mm_ * scale;
        }
        contour_.open(to_plane(path_.tip()), side, radius_mm, side != 0);
    }
    std::optional<motion::Arc> flat = arc;
    if (flat) {
        flat->centre_mm = to_plane(arc->centre_mm);
        flat->normal = {0, 0, normal.z < 0 ? -1.0 : 1.0};
    }
    contour_.add(to_in_plane, flat, contour_words(rapid));
    if (has_corner) {
        contour_.corner(rounding > 0 ? rounding : chamfer, rounding == 0, contour_words(false), by_length);
    } else if (side_ == 0) {
        if (auto done = close_contour(); !done) return std::unexpected(done.error());
        contour_.leave();
    }
    return true;
}

// The radius of the tool; 0 with a warning where nothing states it.
Result<double> Interpreter::cutter_radius(Place where, const char* what) {
    const auto radius = path_.tool_radius_mm(unit_mm_);
    if (!radius) {
        if (path_.first(kNoRadius)) {
            path_.warn(where.line, std::string(what) + ", but " +
                                       path_.notes.no_diameter_text(path_.tool, "radius") +
                                       ": the programmed path is taken for that of its centre; give the "
                                       "tool to the job");
        }
        return 0.0;
    }
    if (!kLimits.offset_diameter.range.contains(2 * *radius)) {
        return path_.refuse(where, out_of_range(kLimits.offset_diameter, 2 * *radius),
                            "correct the radius of the tool");
    }
    return *radius;
}

}  // namespace tribo::readers::siemens
