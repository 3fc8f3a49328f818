// SPDX-License-Identifier: MIT
#include "readers/rewrite/unrolled.hpp"

#include <cmath>
#include <span>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "motion/path/path.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

// All digits, without an exponent, which G-code does not have. A size below 1e-12 is 0.
std::string word_number(double value) {
    constexpr double kNothing = 1e-12;
    if (std::abs(value) < kNothing) return "0";
    const std::string text = format_decimal(value);
    const std::size_t e = text.find('e');
    if (e == text.npos) return text;
    const std::string sign = value < 0 ? "-" : "";
    std::string digits;
    int point = 0;  // digits before the point
    for (const char c : text.substr(0, e)) {
        if (c == '.') point = static_cast<int>(digits.size());
        if (is_digit(c)) digits += c;
    }
    if (point == 0) point = static_cast<int>(digits.size());
    int shift = 0;
    for (const char c : text.substr(e + 1))
        if (is_digit(c)) shift = 10 * shift + (c - '0');
    point += text[e + 1] == '-' ? -shift : shift;
    if (point <= 0) return sign + "0." + std::string(static_cast<std::size_t>(-point), '0') + digits;
    const auto whole = static_cast<std::size_t>(point);
    if (digits.size() <= whole) return sign + digits + std::string(whole - digits.size(), '0');
    return sign + digits.substr(0, whole) + "." + digits.substr(whole);
}

// Rounding of a long program moves its places by less.
constexpr double kSamePlaceMm = 1e-6;

class Unroller {
  public:
    Unroller(const motion::Program& program, const UnrollOptions& options)
        : program_(program), options_(options) {}

    Result<std::string> write() {
        out_ = "G21 G90 G94 G17\n";
        for (const motion::Move& move : program_.moves) {
            if (auto good = check(move); !good) return std::unexpected(good.error());
            write_tool(move);
            if (!at_) {
                at_ = move.start.tip_mm;
                block("G0 X" + word_number(at_->x) + " Y" + word_number(at_->y) + " Z" + word_number(at_->z));
            }
            if (move.kind == motion::MoveKind::feed && !move.arc &&
                motion::path_length_mm(move) > options_.longest_mm) {
                for (const motion::Move& piece : motion::in_pieces(move, options_.longest_mm))
                    write_move(piece);
            } else {
                write_move(move);
            }
        }
        return out_ + "M30\n";
    }

  private:
    Result<void> check(const motion::Move& move) const {
        const auto refuse = [&](const char* cause) {
            return fail_at(program_.source, move.line, 0,
                           std::string("this move cannot be written as plain G-code: ") + cause,
                           "let the CAM system write the program with lines and arcs alone");
        };
        // The way over such a place keeps the tool off the part: it cannot be left out.
        if (at_ && distance(*at_, move.start.tip_mm) > kSamePlaceMm)
            return fail_at(program_.source, move.line, 0,
                           "before this move the program goes to a place that only the machine knows, which "
                           "the written-out program would leave out",
                           "write that place with G0 in the frame of the part");
        const Vec3 up{0, 0, 1};
        if (!(move.start.axis == up) || !(move.end.axis == up)) return refuse("its tool is tilted");
        if (move.quadratic) return refuse("it is a curve, and no arc");
        if (!move.arc) return {};
        const Vec3& n = move.arc->normal;
        if (!(std::abs(n.x) == 1 || std::abs(n.y) == 1 || std::abs(n.z) == 1))
            return refuse("its arc lies in no plane of the axes");
        gcode::ArcEnds ends;
        ends.plane = n.z != 0 ? gcode::Plane::xy : n.y != 0 ? gcode::Plane::zx : gcode::Plane::yz;
        ends.start_mm = move.start.tip_mm;
        ends.end_mm = move.end.tip_mm;
        if (!gcode::arc_about_centre(ends, move.arc->centre_mm, 1))
            return refuse("its arc misses its end by more than a program in millimetres may");
        if (std::abs(move.arc->turn_rad) > math::kTwoPi * (1 + 1e-9) &&
            options_.dialect == GcodeDialect::fanuc)
            return refuse("it is a helix of more than a turn");
        return {};
    }

    void block(const std::string& text) { out_ += text + "\n"; }

    void write_tool(const motion::Move& move) {
        if (move.tool > 0 && move.tool != tool_) block("T" + std::to_string(tool_ = move.tool) + " M6");
        if (move.spindle_rpm > 0 && move.spindle_rpm != rpm_)
            block("S" + word_number(rpm_ = move.spindle_rpm) + " M3");
    }

    std::string feed_of(const motion::Move& move) {
        if (move.kind != motion::MoveKind::feed) return "";
        const double feed =
            move.duration_s > 0 ? 60 * motion::path_length_mm(move) / move.duration_s : move.feed_mm_per_min;
        if (feed == feed_) return "";
        return " F" + word_number(feed_ = feed);
    }

    void write_move(const motion::Move& move) {
        if (move.kind == motion::MoveKind::dwell) {
            const bool fanuc = options_.dialect == GcodeDialect::fanuc;  // milliseconds there
            return block("G4 P" + word_number(fanuc ? std::round(1e3 * move.duration_s) : move.duration_s));
        }
        std::string words;
        const Vec3 &from = move.start.tip_mm, &to = move.end.tip_mm;
        for (int axis = 0; axis < 3; ++axis)
            if (to[axis] != from[axis] || to[axis] != (*at_)[axis] || move.arc)
                words += std::string(" ") + "XYZ"[axis] + word_number(to[axis]);
        at_ = to;
        if (!move.arc) {
            if (words.empty()) return;
            return block((move.kind == motion::MoveKind::rapid ? "G0" : "G1") + words + feed_of(move));
        }
        const Vec3& n = move.arc->normal;
        const int normal = n.x != 0 ? 0 : n.y != 0 ? 1 : 2;
        constexpr const char* kPlanes[] = {"G19", "G18", "G17"};
        if (normal != normal_) block(kPlanes[normal_ = normal]);
        const bool clockwise = (n[normal] < 0) != (move.arc->turn_rad < 0);
        const Vec3 centre = move.arc->centre_mm - from;
        for (int axis = 0; axis < 3; ++axis)
            if (axis != normal) words += std::string(" ") + "IJK"[axis] + word_number(centre[axis]);
        const int turns = static_cast<int>(std::ceil(std::abs(move.arc->turn_rad) / math::kTwoPi - 1e-9));
        if (turns > 1) words += " P" + std::to_string(turns);
        block((clockwise ? "G2" : "G3") + words + feed_of(move));
    }

    const motion::Program& program_;
    const UnrollOptions& options_;
    std::string out_;
    std::optional<Vec3> at_;  // none before the first move
    int tool_ = 0, normal_ = 2;
    double rpm_ = 0, feed_ = 0;
};

}  // namespace

Result<std::string> unrolled_gcode(const motion::Program& program, const UnrollOptions& options) {
    return Unroller(program, options).write();
}

}  // namespace tribo::readers
