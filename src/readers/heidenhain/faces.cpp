// SPDX-License-Identifier: MIT
// Faces that are milled line by line: cycles 230 to 233. TNC 640 and TNC 410 manuals, multipass and face
// milling.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/control/face.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kMostLines = 10'000;

}  // namespace

bool Interpreter::is_face(int number) {
    return number >= 230 && number <= 233;
}

// Q367 of cycle 233: where the tool stands at the call: in the middle, or in a corner from the lower left one
// on. Without it: at the corner from which the sides count.
Vec3 Interpreter::corner_of_face(double length, double width) const {
    Vec3 corner = path_.tip();
    switch (static_cast<int>(std::clamp(cycle_.at(367, -1), -1.0, 5.0))) {
        case 0:
            return corner - Vec3{length / 2, width / 2, 0};
        case 2:
            return corner - Vec3{length, 0, 0};
        case 3:
            return corner - Vec3{length, width, 0};
        case 4:
            return corner - Vec3{0, width, 0};
        default:
            return corner;
    }
}

// 232 and 233: Q389 says how the lines follow each other.
Result<control::Face> Interpreter::face_of_cycle(double radius) {
    const bool is_new = cycle_.number == 233;
    for (const int limit : {347, 348, 349}) {
        if (cycle_.at(limit) == 0) continue;
        return path_.refuse(cycle_.place, "cycle 233 between walls (Q347 to Q349) is not read",
                            "write 0 there, or let the CAM system write the path");
    }
    control::Face face;
    const double top = cycle_.at(227), clearance = cycle_.at(200);
    face.depths = {top + std::max(clearance, cycle_.at(204)), top, top + clearance, cycle_.at(386)};
    face.length = cycle_.at(218);
    face.width = cycle_.at(219);
    face.corner = is_new ? corner_of_face(face.length, face.width) : Vec3{cycle_.at(225), cycle_.at(226), 0};
    face.along_width = is_new && cycle_.at(350) == 2;
    const int way = static_cast<int>(std::clamp(cycle_.at(389), 0.0, 5.0));
    const bool at_edge = way == 1 || way == 3;
    if (way == 2 || way == 3) face.way = control::FaceWay::one_way;
    if (is_new && way == 4) face.way = control::FaceWay::spiral;
    face.start_over = radius + cycle_.at(357);
    face.over = at_edge ? 0 : face.start_over;
    face.step = std::abs(cycle_.at(370, 1)) * radius;
    face.infeed = std::abs(cycle_.at(202));
    face.lift = clearance;
    face.feed = cycle_.at(207);
    face.finish_feed = cycle_feed(385).value_or(face.feed);
    face.between = way == 1 ? std::optional(face.feed) : cycle_feed(253);
    const double allowance = std::max(cycle_.at(369), 0.0);
    const int operation = is_new ? static_cast<int>(std::clamp(cycle_.at(215), 0.0, 9.0)) : 0;
    if (operation == 1) face.depths.bottom += allowance;
    if (operation == 0) face.left = std::min(allowance, top - cycle_.at(386));
    if (operation >= 2) face.left = top - cycle_.at(386);
    return face;
}

// 230: Q240 lines in one plane, beyond the edges by the tool's radius.
control::Face Interpreter::old_face_of_cycle(double radius) const {
    control::Face face;
    const double top = cycle_.at(227);
    const double clearance = top + cycle_.at(200);
    face.depths = {clearance, std::max(clearance, top + 1), clearance, top};  // no infeed: one pass
    face.corner = {cycle_.at(225), cycle_.at(226), 0};
    face.length = cycle_.at(218);
    face.width = cycle_.at(219);
    face.over = face.start_over = radius;
    face.lines = std::floor(std::max(cycle_.at(240), 0.0));
    face.feed = cycle_.at(207);
    face.between = cycle_feed(209);
    return face;
}

Result<void> Interpreter::mill_face() {
    const std::string name = "cycle " + std::to_string(cycle_.number);
    if (auto good = path_.in_range(kLimits.feed, std::min(cycle_.at(207), kFastFeed), cycle_.place); !good)
        return good;
    const double radius = cutter_radius();
    if (path_.first(kFaceWay)) {
        path_.warn(cycle_.place.line,
                   "where the lines of " + name + " lie is the control's own: evenly over the face is taken");
    }
    if (cycle_.number == 231) return mill_ruled_face(2 * radius);
    const auto face = cycle_.number == 230 ? old_face_of_cycle(radius) : face_of_cycle(radius);
    if (!face) return std::unexpected(face.error());
    const double count = control::line_count(*face);
    if (!(count >= 1) || !(count <= kMostLines) || face->length == 0 || face->width == 0) {
        return path_.refuse(cycle_.place, name + " needs no lines, or more than 10000",
                            "correct its heights, sides and infeeds");
    }
    return control::mill_face(*face, path_.tip(), mover());
}

// 231: lines from the edge between the points 1 and 4 to that between 2 and 3; back above the face, by the
// tool's diameter.
Result<void> Interpreter::mill_ruled_face(double diameter) {
    const auto point = [&](int q) { return Vec3{cycle_.at(q), cycle_.at(q + 1), cycle_.at(q + 2)}; };
    const Vec3 first = point(225), second = point(228), third = point(231), fourth = point(234);
    const double lines = std::floor(cycle_.at(240));
    if (!(lines >= 1) || !(lines <= kMostLines)) {
        return path_.refuse(cycle_.place, "cycle 231 has no number of lines from 1 to 10000", "correct Q240");
    }
    const auto go = mover();
    const double above = std::max({first.z, second.z, third.z, fourth.z}) + diameter;
    auto done = path_.tip().z < above ? go_to_height(above, kRapid) : Result<void>{};
    for (double line = 0; done && line < lines; ++line) {
        const double t = lines > 1 ? line / (lines - 1) : 0;
        const Vec3 from = lerp(first, fourth, t), to = lerp(second, third, t);
        const Vec3 tip = path_.tip();
        if (line > 0) done = go({tip.x, tip.y, tip.z + diameter}, {}, {});
        if (done && line > 0) done = go({from.x, from.y, std::max(from.z + diameter, path_.tip().z)}, {}, {});
        if (done && line == 0) done = go({from.x, from.y, tip.z}, {}, {});
        if (done) done = go(from, cycle_.at(207), {});
        if (done) done = go(to, cycle_.at(207), {});
    }
    return done ? go_to_height(above, kRapid) : done;
}

}  // namespace tribo::readers::heidenhain
