// SPDX-License-Identifier: MIT
// CYCLE62 and CYCLE72: the tool follows a contour that a program, or the lines between two labels, describes.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr double kMostPasses = 10'000;

std::string in_upper_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), to_upper);
    return text;
}

int digit_of(double number, int place) {
    return static_cast<int>(std::clamp(number, 0.0, 99999.0)) / place % 10;
}

// The straight line, quarter or half circle that AS1 and AS2 choose.
control::ContourEndShape end_shape(int kind, double size_mm, Vec3 point, const control::ContourWords& way) {
    control::ContourEndShape shape;
    shape.shape = kind == 1 ? control::ContourEnd::line_tangent : control::ContourEnd::circle;
    shape.length_mm = shape.radius_mm = size_mm;
    shape.turn_rad = kind == 3 ? math::kPi : math::kHalfPi;
    shape.point = point;
    shape.way = way;
    return shape;
}

}  // namespace

// CYCLE62(NAME, TYPE, LAB1, LAB2): a contour of the milling cycle that follows; several add up.
Result<void> Interpreter::choose_contour(const Call& call) {
    if (contours_are_used_) chosen_contours_.clear();
    contours_are_used_ = false;
    const int kind = digit_of(call.at(1), 1);
    ContourName chosen{kind == 2 ? "" : call.text(0), "", ""};
    if (kind >= 2) {
        chosen.begin = in_upper_case(call.text(2));
        chosen.end = in_upper_case(call.text(3));
    }
    chosen_contours_.push_back(chosen);
    return {};
}

// The contour of a name: a program, two labels with a colon between them, or what the control's own editor
// writes behind the program between E_LAB_A_NAME and E_LAB_E_NAME.
Interpreter::ContourName Interpreter::contour_named(const std::string& text) const {
    if (text.empty()) return chosen_contours_.empty() ? ContourName{} : chosen_contours_.back();
    const std::size_t colon = text.find(':');
    if (colon != std::string::npos) {
        return {"", in_upper_case(std::string(trimmed(text.substr(0, colon)))),
                in_upper_case(std::string(trimmed(text.substr(colon + 1))))};
    }
    return {text, "", ""};
}

// Runs the blocks of the contour, and keeps their elements instead of moving. Returns false if the contour is
// a program that is not at hand.
Result<bool> Interpreter::capture_contour(const ContourName& name, const Call& call) {
    const Place where{call.line, call.column};
    Call described;
    described.name = program_name(name.program);
    described.line = call.line;
    described.column = call.column;
    std::string first = name.begin, last = name.end;
    const Unit* unit = name.program.empty() ? unit_ : text_.unit_named(described.name);
    const bool is_own = unit == nullptr && first.empty() &&
                        text_.place_of("E_LAB_A_" + described.name, at_, Text::Way::both, *unit_);
    if (is_own) {
        first = "E_LAB_A_" + described.name;
        last = "E_LAB_E_" + described.name;
        unit = unit_;
    }
    if (unit == nullptr) {
        if (auto done = leave_out_program(described); !done) return std::unexpected(done.error());
        return false;
    }
    if (name.program.empty() && first.empty())
        return path_.refuse(where, call.name + " without a contour", "write its name, or CYCLE62 before it");
    const auto feed = path_.feed_mm_per_min;
    const Motion function = motion_;
    const bool incremental = incremental_;
    const int side = side_;
    const Vec3 tangent = tangent_;
    side_ = 0;
    captured_.emplace();
    Result<void> done;
    if (first.empty()) {
        done = run_unit(*unit, described);
    } else {
        done = run_between(first, last, *unit, where);
    }
    path_.feed_mm_per_min = feed;
    motion_ = function;
    incremental_ = incremental;
    side_ = side;
    tangent_ = tangent;
    if (!done) {
        captured_.reset();
        return std::unexpected(done.error());
    }
    return true;
}

// Runs the lines from one label to another.
Result<void> Interpreter::run_between(const std::string& first, const std::string& last, const Unit& unit,
                                      Place where) {
    const auto begin = text_.place_of(first, unit.begin, Text::Way::both, unit);
    const auto end = text_.place_of(last, unit.begin, Text::Way::both, unit);
    if (!begin || !end || *end < *begin)
        return path_.refuse(where, "the labels of the contour are not in this program", "correct them");
    if (depth_ >= kDeepestCall)
        return path_.refuse(where, "contours call each other too deeply", "correct the calls");
    const std::size_t back = at_;
    ++depth_;
    auto done = run_lines(*begin, *end + 1);
    --depth_;
    at_ = back;
    jumped_ = returned_ = false;
    return done;
}

// CYCLE72(KNAME, RTP, RFP, SDIS, DP, MID, FAL, FALD, FFP1, FFD, VARI, RL, AS1, LP1, FF3, AS2, LP2, ...):
// along the contour, depth by depth, with lines or circles to it and from it in the plane.
Result<void> Interpreter::mill_contour(const Call& named) {
    const Place where{named.line, named.column};
    contours_are_used_ = true;
    Call call = named;
    if (!call.given.empty()) call.given.erase(call.given.begin());
    const auto ready = prepare_cycle(call);
    if (!ready) return std::unexpected(ready.error());
    if (!*ready) return {};
    const auto [u, v, w] = axes();
    if (std::abs(scale_[u]) != std::abs(scale_[v]) || scale_[u] * scale_[v] < 0) {
        return path_.refuse(where, "CYCLE72 in a mirrored or unevenly scaled frame",
                            "end SCALE and MIRROR before it");
    }
    auto depths = depths_of(call, kNoParameter, 21);
    if (!depths) return std::unexpected(depths.error());
    const auto feed = cycle_feed(call, 7), plunge = cycle_feed(call, 8);
    if (!feed) return std::unexpected(feed.error());
    if (!plunge) return std::unexpected(plunge.error());
    const double scale = std::abs(scale_[u]) * unit_mm_;
    const bool finishes = digit_of(call.at(9), 1) == 2;
    const int rl = static_cast<int>(std::clamp(call.at(10), 0.0, 99.0));
    ContourPass pass;
    pass.side = rl == 41 ? 1 : rl == 42 ? -1 : 0;
    if (!finishes) depths->bottom += std::abs(call.at(6)) * scale;
    const double height = depths->top - depths->bottom, infeed = std::abs(call.at(4)) * scale;
    const double passes = infeed > 0 ? std::max(1.0, std::ceil(height / infeed - 1e-9)) : 1;
    if (!(height > 0) || !(passes <= kMostPasses))
        return path_.refuse(where, "CYCLE72 needs no passes, or more than 10000", "correct its infeeds");
    for (const auto& [kind, size] : {std::pair{11u, 12u}, {14u, 15u}}) {
        const int shape = digit_of(call.at(kind), 1);
        if (shape >= 1 && shape <= 3 && (pass.side != 0 || shape == 1) &&
            std::abs(call.at(size)) * scale <= 1e6)
            continue;
        return path_.refuse(where, "CYCLE72 without a known way to its contour",
                            "write 1, 2 or 3 for AS1 and AS2; without compensation 1");
    }
    double radius = 0;
    if (pass.side != 0) {
        const auto known = cutter_radius(where, "CYCLE72");
        if (!known) return std::unexpected(known.error());
        radius = *known + (finishes ? 0 : std::abs(call.at(5)) * scale);
    }
    pass.radius = radius;
    pass.begin_kind = digit_of(call.at(11), 1);
    pass.begin_size = std::abs(call.at(12)) * scale;
    pass.end_kind = digit_of(call.at(14), 1);
    pass.end_size = std::abs(call.at(15)) * scale;
    pass.feed = *feed;
    pass.plunge = *plunge;
    if (digit_of(call.at(9), 10) == 1) {
        const auto between = cycle_feed(call, 13);
        if (!between) return std::unexpected(between.error());
        pass.between = *between;
    }
    if ((digit_of(call.at(11), 10) != 0 || digit_of(call.at(14), 10) != 0) &&
        passed_over_.insert("AS1").second)
        path_.warn(line_number(), "the ways to and from the contour of CYCLE72 are taken in the plane");
    const auto captured = capture_contour(contour_named(named.text(0)), named);
    if (!captured) return std::unexpected(captured.error());
    if (!*captured) return {};
    pass.steps = *std::move(captured_);
    captured_.reset();
    if (pass.steps.size() < 2)
        return path_.refuse(where, "the contour of CYCLE72 has no elements",
                            "write a start and a line or circle");
    check_start(false);
    const Vec3 now = to_plane(path_.tip());
    if (auto done = mill_to({now.x, now.y, depths->back}, {}, {}); !done) return done;
    for (double k = 1; k <= passes; ++k) {
        pass.z = depths->top - height * k / passes;
        if (auto done = run_contour_pass(pass, *depths); !done) return done;
        const int back = digit_of(call.at(9), 100);
        const double step = depths->near - depths->top;
        const double lift = k == passes || back == 0 ? depths->back
                            : back == 1              ? depths->near
                            : back == 2              ? pass.z + step
                                                     : pass.z;
        const Vec3 end = to_plane(path_.tip());
        if (lift > end.z) {
            if (auto done = mill_to({end.x, end.y, lift}, {}, {}); !done) return done;
        }
    }
    return {};
}

Result<void> Interpreter::run_contour_pass(const ContourPass& pass, const Depths& depths) {
    const auto modal = path_.feed_mm_per_min;
    path_.feed_mm_per_min = pass.feed;
    const control::ContourWords words = contour_words(false);
    const auto at_depth = [&](Vec3 p) { return Vec3{p.x, p.y, pass.z}; };
    const auto fill = [&] {
        contour_.open(to_plane(path_.tip()), pass.side, pass.radius, false);
        contour_.approach(end_shape(pass.begin_kind, pass.begin_size, at_depth(pass.steps[0].to), words),
                          words);
        contour_.add_steps(pass.steps, pass.z, words);
        contour_.depart(end_shape(pass.end_kind, pass.end_size, at_depth(pass.steps.back().to), words),
                        words);
    };
    fill();
    const auto begin = contour_.begin(path_);
    if (!begin) return std::unexpected(begin.error());
    const double height = to_plane(path_.tip()).z;
    if (auto done = mill_to({begin->x, begin->y, height}, pass.between, {}); !done) return done;
    if (height > depths.near) {
        if (auto done = mill_to({begin->x, begin->y, depths.near}, {}, {}); !done) return done;
    }
    if (auto done = mill_to({begin->x, begin->y, pass.z}, pass.plunge, {}); !done) return done;
    fill();
    auto done = close_contour();
    contour_.leave();
    path_.feed_mm_per_min = modal;
    return done;
}

}  // namespace tribo::readers::siemens
