// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/arc_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/moves.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr char kCentreLetters[] = "IJK";
constexpr double kMostExtraTurns = 10'000;
// The rise of a turn (K of a G17 arc) may differ by this from that of the end point, units of the program:
// rounding to three decimals.
constexpr double kPitchTolerance = 0.002;
// Centre and radius of one arc agree within this, mm.
constexpr double kRadiusAgreesMm = 0.01;
// Two centres closer than this are one, mm.
constexpr double kSameCentreMm = 1e-6;
// Arcs within a quadrant may be longer by the rounding of their ends, rad.
constexpr double kQuadrantRad = 0.5 * math::kPi + 0.01;

class ArcReader {
  public:
    ArcReader(Command& command, State& state, Vec3 target, Output& output)
        : command_(command), state_(state), output_(output), axes_(axes_of(state.plane)) {
        ends_.plane = state.plane;
        ends_.clockwise = (state.motion == MotionMode::arc_clockwise) != state.frame.is_mirrored(state.plane);
        ends_.start_mm = state.tip_mm;
        ends_.end_mm = target;
    }

    Result<std::optional<motion::Arc>> read() {
        if (auto turns = read_turns(); !turns) return std::unexpected(turns.error());
        const auto scale = state_.frame.scale_in(state_.plane);
        if (!scale) {
            return output_.refuse(command_.line(), column_of_any(command_, "XYZIJKR"),
                                  "an arc is scaled differently along the axes of its plane (G51)",
                                  "write it as short lines, or take one scale");
        }
        scale_ = *scale;
        for (std::size_t i = 0; i < 3; ++i) {
            const Word* word = words_[i] = command_.use(kCentreLetters[axes_[i]]);
            if (word == nullptr) continue;
            if (auto good = check_length(*word); !good) return std::unexpected(good.error());
        }
        if (is_line()) {
            if (output_.first(Note::centres, 'L')) {
                output_.warn(command_.line(),
                             "an arc without centre or radius is a straight line on Fanuc controls, unless "
                             "their parameter 3403 says that it is an alarm");
            }
            return std::nullopt;
        }
        if (is_point()) {
            if (output_.first(Note::centres, 'P')) {
                output_.warn(command_.line(), "an arc that is no larger than a point moves nothing");
            }
            return std::nullopt;
        }
        auto arc = read_shape();
        if (!arc) {
            ends_.is_coarse = true;
            auto coarse = read_shape();
            if (!coarse) return std::unexpected(arc.error());
            arc = *coarse;
            if (output_.first(Note::coarse_arc)) {
                output_.warn(command_.line(),
                             "the radius of an arc differs at its start and end by the rounding of two "
                             "decimals (in inches three): taken as LinuxCNC takes it");
            }
        }
        if (auto good = check_pitch(*arc); !good) return std::unexpected(good.error());
        return *arc;
    }

  private:
    bool is_line() const {
        return output_.options.dialect == GcodeDialect::fanuc && words_[0] == nullptr &&
               words_[1] == nullptr && !command_.has('R') && !(ends_.start_mm == ends_.end_mm);
    }

    // Start, end and centre are one point: what is left of an arc too small for the decimals.
    bool is_point() const {
        if (words_[0] == nullptr || words_[1] == nullptr || command_.has('R')) return false;
        const Vec3 centre = state_.absolute_centres ? from_origin() : from_start();
        double off = distance(ends_.start_mm, ends_.end_mm);
        for (std::size_t i = 0; i < 2; ++i) {
            off = std::max(off, std::abs(centre[axes_[i]] - ends_.start_mm[axes_[i]]));
        }
        return off <= kSameCentreMm;
    }

    // Scaled as the path is.
    Result<void> check_length(const Word& word) const {
        return in_range(kLimits.coordinate, word.value * state_.unit_mm * scale_, command_, word, output_);
    }

    Result<void> read_turns() {
        const Word* turns = command_.use('P');
        if (turns == nullptr) return {};
        if (turns->value < 1 || turns->value > kMostExtraTurns || turns->value != std::floor(turns->value)) {
            return output_.refuse(command_.line(), turns->column,
                                  "the number of turns P is not a whole number above 0", "correct P");
        }
        ends_.extra_turns = static_cast<int>(turns->value) - 1;
        return {};
    }

    Result<motion::Arc> read_shape() {
        if (const Word* radius = command_.use('R')) return by_radius(*radius);
        const int given = (words_[0] != nullptr ? 1 : 0) + (words_[1] != nullptr ? 1 : 0);
        if (given == 0 || (given == 1 && state_.absolute_centres)) {
            return output_.refuse(command_.line(), given == 0 ? column_of_any(command_, "XYZ") : column(),
                                  given == 0 ? "an arc without centre or radius"
                                             : "an arc in absolute centres (G90.1) needs both " + letters(),
                                  "add " + letters() + (given == 0 ? ", or R" : ""));
        }
        if (state_.single_quadrant) return within_quadrant();
        if (state_.absolute_centres) return placed(about(from_origin()));
        return about_start(given == 2);
    }

    Result<motion::Arc> by_radius(const Word& radius) {
        if (auto good = check_length(radius); !good) return std::unexpected(good.error());
        auto arc = arc_of_radius(ends_, radius.value * state_.unit_mm * scale_);
        const bool has_centre = value(0) != 0 || value(1) != 0;
        if (has_centre && (!arc || !agrees(*arc))) {
            if (output_.options.dialect != GcodeDialect::fanuc) {
                return output_.refuse(command_.line(), radius.column, "the arc has a radius and a centre",
                                      "delete R, or " + letters());
            }
            if (output_.first(Note::centres, 'R')) {
                output_.warn(command_.line(), "an arc has a radius and another centre: the radius counts");
            }
        }
        if (arc) return arc;
        return output_.refuse(command_.line(), radius.column, arc.error().cause, arc.error().remedy);
    }

    bool agrees(const motion::Arc& arc) const {
        return in_plane(from_start(), arc.centre_mm) <= kRadiusAgreesMm;
    }

    // Centres count from the start, unless this arc shows that they cannot.
    Result<motion::Arc> about_start(bool has_both) {
        auto arc = about(from_start());
        // Rounded numbers show nothing about all others.
        if (state_.centres_stated || !has_both || ends_.is_coarse) return placed(std::move(arc));
        auto absolute = about(from_origin());
        if (arc) {
            if (!absolute) {
                state_.centres_stated = true;
            } else if (state_.ambiguous_arc_line == 0 &&
                       distance(arc->centre_mm, absolute->centre_mm) > kSameCentreMm) {
                state_.ambiguous_arc_line = command_.line();
            }
            return arc;
        }
        if (!absolute) return placed(std::move(arc));
        if (state_.ambiguous_arc_line != 0) {
            return output_.refuse(command_.line(), column(),
                                  "the centre of this arc fits only in absolute coordinates, that of line " +
                                      std::to_string(state_.ambiguous_arc_line) + " in both ways",
                                  "write G90.1 at the start of the program, or correct this centre");
        }
        state_.centres_stated = state_.absolute_centres = true;
        output_.warn(command_.line(),
                     "the centre of this arc fits only in absolute coordinates: all centres are read as "
                     "absolute, as after G90.1");
        return absolute;
    }

    // Returns the arc of at most a quarter turn whose centre has these distances from the start. Of several,
    // which only rounding makes possible, the one whose radius differs least is meant.
    Result<motion::Arc> within_quadrant() {
        std::optional<motion::Arc> found;
        double least_mm = std::numeric_limits<double>::infinity();
        for (const double first : {1.0, -1.0}) {
            for (const double second : {1.0, -1.0}) {
                Vec3 offset_mm;
                offset_mm[axes_[0]] = first * std::abs(value(0)) * state_.unit_mm;
                offset_mm[axes_[1]] = second * std::abs(value(1)) * state_.unit_mm;
                const auto arc = about(ends_.start_mm + state_.frame.placed_offset(offset_mm));
                if (!arc || arc->turn_rad > kQuadrantRad) continue;
                const double off_mm = std::abs(in_plane(arc->centre_mm, ends_.start_mm) -
                                               in_plane(arc->centre_mm, ends_.end_mm));
                if (off_mm >= least_mm) continue;
                least_mm = off_mm;
                found = *arc;
            }
        }
        if (!found) {
            return output_.refuse(command_.line(), column(),
                                  "no arc within a quadrant (G74) has its centre at these distances",
                                  "correct " + letters() + ", or write the arc with signs and without G74");
        }
        if (output_.first(Note::centres, 'Q')) {
            output_.warn(command_.line(),
                         "G74: arcs are read as staying within a quadrant, " + letters() + " without signs");
        }
        return *found;
    }

    // K of a G17 arc may say how far one turn rises.
    Result<void> check_pitch(const motion::Arc& arc) {
        const Word* word = words_[2];
        if (word == nullptr || word->value == 0) return {};
        const double turns = arc.turn_rad / math::kTwoPi;
        const double rise = std::abs(ends_.end_mm[axes_[2]] - ends_.start_mm[axes_[2]]) / state_.unit_mm;
        if (rise > 0 && std::abs(std::abs(word->value) * turns - rise) <= kPitchTolerance * (1 + turns)) {
            if (output_.first(Note::pitch)) {
                output_.warn(command_.line(),
                             std::string(1, word->letter) +
                                 " is taken as the rise of a turn, which the end point says too");
            }
            return {};
        }
        return output_.refuse(command_.line(), word->column,
                              std::string("an arc in this plane has no use for ") + word->letter,
                              "select the plane with G17, G18 or G19, or delete the word");
    }

    double in_plane(Vec3 a, Vec3 b) const {
        return math::hypot(a[axes_[0]] - b[axes_[0]], a[axes_[1]] - b[axes_[1]]);
    }
    double value(std::size_t i) const { return words_[i] == nullptr ? 0 : words_[i]->value; }
    Vec3 offset() const {
        Vec3 offset_mm;
        offset_mm[axes_[0]] = value(0) * state_.unit_mm;
        offset_mm[axes_[1]] = value(1) * state_.unit_mm;
        return offset_mm;
    }
    Vec3 from_start() const { return ends_.start_mm + state_.frame.placed_offset(offset()); }
    Vec3 from_origin() const { return state_.origin_mm() + state_.frame.placed(offset()); }
    Result<motion::Arc> about(Vec3 centre_mm) const {
        return arc_about_centre(ends_, centre_mm, state_.unit_mm);
    }
    std::string letters() const {
        return std::string(1, kCentreLetters[axes_[0]]) + " and " + kCentreLetters[axes_[1]];
    }
    int column() const {
        int first = 0;
        for (std::size_t i = 0; i < 2; ++i) {
            if (words_[i] != nullptr && (first == 0 || words_[i]->column < first)) first = words_[i]->column;
        }
        return first;
    }
    Result<motion::Arc> placed(Result<motion::Arc> arc) const {
        if (arc) return arc;
        return output_.refuse(command_.line(), column(), arc.error().cause, arc.error().remedy);
    }

    Command& command_;
    State& state_;
    Output& output_;
    std::array<int, 3> axes_;
    ArcEnds ends_;
    double scale_ = 1;                    // of lengths in the plane
    std::array<const Word*, 3> words_{};  // centre words in the plane, and the one along its normal
};

}  // namespace

Result<std::optional<motion::Arc>> arc_of(Command& command, State& state, Vec3 target, Output& output) {
    return ArcReader(command, state, target, output).read();
}

}  // namespace tribo::readers::gcode
