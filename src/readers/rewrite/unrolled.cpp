// SPDX-License-Identifier: MIT
#include "readers/rewrite/unrolled.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <optional>

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

// An arc about an axis of the coordinates.
struct PlaneArc {
    int normal = 2;  // number of the axis
    bool clockwise = false;
    Vec3 centre_mm;
    double turn_rad = 0;  // > 0
};

// What a block says; one kind of block for each language.
class BlockWriter {
  public:
    virtual ~BlockWriter() = default;
    virtual void begin() = 0;
    virtual void end() = 0;
    // Loads the cutter with this number (absent: the one before stays) and starts the spindle (0: as before).
    virtual void start(std::optional<int> tool, double spindle_rpm) = 0;
    virtual void dwell(double seconds) = 0;
    // `axes`: to be written. `feed_mm_per_min`: absent where the feed holds on.
    virtual void line(bool is_rapid, Vec3 to_mm, const std::array<bool, 3>& axes,
                      std::optional<double> feed_mm_per_min) = 0;
    virtual void arc(const PlaneArc& arc, Vec3 from_mm, Vec3 to_mm,
                     std::optional<double> feed_mm_per_min) = 0;
    // Why this language has no word for it; empty: it has.
    virtual std::string_view lacks(const PlaneArc& arc) const = 0;

    std::string text;

  protected:
    static int turns_of(const PlaneArc& arc) {
        return static_cast<int>(std::ceil(arc.turn_rad / math::kTwoPi - 1e-9));
    }
};

// DIN 66025: G-code of LinuxCNC, of Fanuc, and of Siemens.
class IsoWriter final : public BlockWriter {
  public:
    explicit IsoWriter(const UnrollOptions& options)
        : siemens_(options.language == FeedLanguage::siemens),
          fanuc_(!siemens_ && options.dialect == GcodeDialect::fanuc) {}

    void begin() override { block(siemens_ ? "G710 G90 G94 G17" : "G21 G90 G94 G17"); }
    void end() override { block("M30"); }
    void start(std::optional<int> tool, double rpm) override {
        if (tool) block("T" + std::to_string(*tool) + " M6");
        if (rpm > 0) block("S" + word_number(rpm) + " M3");
    }
    void dwell(double seconds) override {
        if (siemens_) return block("G4 F" + word_number(seconds));
        block("G4 P" + word_number(fanuc_ ? std::round(1e3 * seconds) : seconds));
    }
    void line(bool is_rapid, Vec3 to, const std::array<bool, 3>& axes, std::optional<double> feed) override {
        std::string words = is_rapid ? "G0" : "G1";
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (axes[axis]) words += word("XYZ"[axis], to[static_cast<int>(axis)]);
        block(words + feed_word(feed));
    }
    void arc(const PlaneArc& arc, Vec3 from, Vec3 to, std::optional<double> feed) override {
        constexpr const char* kPlanes[] = {"G19", "G18", "G17"};
        if (arc.normal != normal_) block(kPlanes[normal_ = arc.normal]);
        std::string words = arc.clockwise ? "G2" : "G3";
        for (int axis = 0; axis < 3; ++axis) words += word("XYZ"[axis], to[axis]);
        for (int axis = 0; axis < 3; ++axis)
            if (axis != arc.normal) words += word("IJK"[axis], arc.centre_mm[axis] - from[axis]);
        const int turns = turns_of(arc);
        if (turns > 1)
            words += siemens_ ? " TURN=" + std::to_string(turns - 1) : " P" + std::to_string(turns);
        block(words + feed_word(feed));
    }
    std::string_view lacks(const PlaneArc& arc) const override {
        return fanuc_ && turns_of(arc) > 1 ? "it is a helix of more than a turn" : "";
    }

  private:
    void block(const std::string& words) { text += words + "\n"; }
    static std::string word(char letter, double value) {
        return std::string(" ") + letter + word_number(value);
    }
    static std::string feed_word(std::optional<double> feed) { return feed ? word('F', *feed) : ""; }

    bool siemens_, fanuc_;
    int normal_ = 2;
};

// Klartext of Heidenhain.
class KlartextWriter final : public BlockWriter {
  public:
    void begin() override { block("BEGIN PGM PLAIN MM"); }
    void end() override {
        block("M30");
        block("END PGM PLAIN MM");
    }
    void start(std::optional<int> tool, double rpm) override {
        block("TOOL CALL" + (tool ? " " + std::to_string(*tool) : std::string()) + " Z" +
              (rpm > 0 ? " S" + word_number(rpm) : ""));
        if (rpm > 0) block("M3");
    }
    void dwell(double seconds) override {
        block("CYCL DEF 9.0 DWELL TIME");
        block("CYCL DEF 9.1 DWELL " + word_number(seconds));
    }
    void line(bool is_rapid, Vec3 to, const std::array<bool, 3>& axes, std::optional<double> feed) override {
        std::string words = "L";
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (axes[axis]) words += place("XYZ"[axis], to[static_cast<int>(axis)]);
        block(words + " R0" + (is_rapid ? " FMAX" : feed_word(feed)));
    }
    void arc(const PlaneArc& arc, Vec3 from, Vec3 to, std::optional<double> feed) override {
        block("CC" + place('X', arc.centre_mm.x) + place('Y', arc.centre_mm.y));
        const std::string direction = arc.clockwise ? " DR-" : " DR+";
        if (from.z == to.z && turns_of(arc) == 1)
            return block("C" + place('X', to.x) + place('Y', to.y) + direction + " R0" + feed_word(feed));
        const double degrees = (arc.clockwise ? -1 : 1) * arc.turn_rad * math::kDegPerRad;
        block("CP IPA" + signed_number(degrees) + place('Z', to.z) + direction + " R0" + feed_word(feed));
    }
    std::string_view lacks(const PlaneArc& arc) const override {
        return arc.normal == 2 ? "" : "its arc does not lie in the plane of x and y";
    }

  private:
    void block(const std::string& words) { text += std::to_string(number_++) + " " + words + "\n"; }
    static std::string signed_number(double value) {
        const std::string number = word_number(value);
        return number.front() == '-' ? number : "+" + number;
    }
    static std::string place(char letter, double value) {
        return std::string(" ") + letter + signed_number(value);
    }
    static std::string feed_word(std::optional<double> feed) { return feed ? " F" + word_number(*feed) : ""; }

    int number_ = 0;
};

std::unique_ptr<BlockWriter> writer_for(const UnrollOptions& options) {
    if (options.language == FeedLanguage::heidenhain) return std::make_unique<KlartextWriter>();
    return std::make_unique<IsoWriter>(options);
}

class Unroller {
  public:
    Unroller(const motion::Program& program, const UnrollOptions& options)
        : program_(program), options_(options), writer_(writer_for(options)) {}

    Result<std::string> write() {
        writer_->begin();
        for (const motion::Move& move : program_.moves) {
            if (auto good = check(move); !good) return std::unexpected(good.error());
            write_tool(move);
            if (!at_) {
                at_ = move.start.tip_mm;
                writer_->line(true, *at_, {true, true, true}, {});
            }
            if (move.kind == motion::MoveKind::feed && !move.arc &&
                motion::path_length_mm(move) > options_.longest_mm) {
                for (const motion::Move& piece : motion::in_pieces(move, options_.longest_mm))
                    write_move(piece);
            } else {
                write_move(move);
            }
        }
        writer_->end();
        return std::move(writer_->text);
    }

  private:
    Result<void> check(const motion::Move& move) const {
        const auto refuse = [&](std::string_view cause) {
            return fail_at(program_.source, move.line, 0,
                           "this move cannot be written in plain words: " + std::string(cause),
                           "let the CAM system write the program with lines and arcs alone");
        };
        // The way over such a place keeps the tool off the part: it cannot be left out.
        if (at_ && distance(*at_, move.start.tip_mm) > kSamePlaceMm)
            return fail_at(program_.source, move.line, 0,
                           "before this move the program goes to a place that only the machine knows, which "
                           "the written-out program would leave out",
                           "write that place with a rapid move in the frame of the part");
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
        const std::string_view lacking = writer_->lacks(plane_arc(*move.arc));
        if (!lacking.empty()) return refuse(lacking);
        return {};
    }

    static PlaneArc plane_arc(const motion::Arc& arc) {
        const Vec3& n = arc.normal;
        const int normal = n.x != 0 ? 0 : n.y != 0 ? 1 : 2;
        return {normal, (n[normal] < 0) != (arc.turn_rad < 0), arc.centre_mm, std::abs(arc.turn_rad)};
    }

    void write_tool(const motion::Move& move) {
        std::optional<int> tool;
        if (move.tool > 0 && move.tool != tool_) tool = tool_ = move.tool;
        const bool turns = move.spindle_rpm > 0 && (move.spindle_rpm != rpm_ || tool);
        if (turns) rpm_ = move.spindle_rpm;
        if (tool || turns) writer_->start(tool, turns ? rpm_ : 0);
    }

    std::optional<double> new_feed(const motion::Move& move) {
        const double feed =
            move.duration_s > 0 ? 60 * motion::path_length_mm(move) / move.duration_s : move.feed_mm_per_min;
        if (feed == feed_) return {};
        return feed_ = feed;
    }

    void write_move(const motion::Move& move) {
        if (move.kind == motion::MoveKind::dwell) return writer_->dwell(move.duration_s);
        const Vec3 from = move.start.tip_mm, to = move.end.tip_mm, at = *at_;
        at_ = to;
        if (move.arc) return writer_->arc(plane_arc(*move.arc), from, to, new_feed(move));
        std::array<bool, 3> axes{};
        for (int axis = 0; axis < 3; ++axis)
            axes[static_cast<std::size_t>(axis)] = to[axis] != from[axis] || to[axis] != at[axis];
        if (!(axes[0] || axes[1] || axes[2])) return;
        const bool is_rapid = move.kind == motion::MoveKind::rapid;
        writer_->line(is_rapid, to, axes, is_rapid ? std::nullopt : new_feed(move));
    }

    const motion::Program& program_;
    const UnrollOptions& options_;
    std::unique_ptr<BlockWriter> writer_;
    std::optional<Vec3> at_;  // none before the first move
    int tool_ = 0;
    double rpm_ = 0, feed_ = 0;
};

}  // namespace

Result<std::string> unrolled_program(const motion::Program& program, const UnrollOptions& options) {
    return Unroller(program, options).write();
}

}  // namespace tribo::readers
