// SPDX-License-Identifier: MIT
#include "session/cut/speed_warnings.hpp"

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "motion/path/path.hpp"

namespace tribo::session {
namespace {

// Feed per tooth over the diameter. Makers' tables end at about 1 mm for a high-feed cutter of 16 mm, 6 %.
constexpr double kMostFeedShare = 0.1;
// Speed of the rim, m/min. High-speed milling of aluminium ends near it (Schulz and Moriwaki 1992).
constexpr double kMostCuttingSpeed = 10'000;

// The worst move over a limit, and the number of lines over it.
struct Worst {
    double value = 0;  // of the limit
    std::size_t move = 0, lines = 0;
    int last_line = -1;

    void add(double over, std::size_t n, int line) {
        if (!(over > 1)) return;
        if (line != last_line) ++lines;
        last_line = line;
        if (over > value) {
            value = over;
            move = n;
        }
    }
    std::string others() const {
        return lines > 1 ? " (and " + std::to_string(lines - 1) + " more lines)" : "";
    }
};

std::string three_digits(double value) {
    return format_digits(value, 3);
}

double feed_mm_per_min(const motion::Move& move) {
    return move.duration_s > 0 ? 60 * motion::path_length_mm(move) / move.duration_s : move.feed_mm_per_min;
}

}  // namespace

Warnings speed_warnings(const MillSetup& setup, const std::string& program) {
    Worst feed, speed;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const motion::Move& move = setup.moves[n];
        if (move.kind != motion::MoveKind::feed) continue;
        const milling::Cutter& cutter = setup.cutters[setup.cutter_of_move[n]];
        const double rpm = setup.rpm_of_move[n];
        const double most_per_min = kMostFeedShare * cutter.diameter_mm * rpm * cutter.flutes;
        feed.add(feed_mm_per_min(move) / most_per_min, n, move.line);
        speed.add(1e-3 * math::kPi * cutter.diameter_mm * rpm / kMostCuttingSpeed, n, move.line);
    }
    Warnings warnings;
    if (feed.lines > 0) {
        const motion::Move& move = setup.moves[feed.move];
        const milling::Cutter& cutter = setup.cutters[setup.cutter_of_move[feed.move]];
        const double rpm = setup.rpm_of_move[feed.move], mm_per_min = feed_mm_per_min(move);
        warnings.push_back({program, move.line,
                            three_digits(mm_per_min) + " mm/min at " + three_digits(rpm) + " rpm are " +
                                three_digits(mm_per_min / (rpm * cutter.flutes)) +
                                " mm per tooth for a cutter of " + format_decimal(cutter.diameter_mm) +
                                " mm" + feed.others() +
                                ": no cutter takes more than a tenth of its diameter; check F and S"});
    }
    if (speed.lines > 0) {
        const motion::Move& move = setup.moves[speed.move];
        const milling::Cutter& cutter = setup.cutters[setup.cutter_of_move[speed.move]];
        warnings.push_back({program, move.line,
                            three_digits(setup.rpm_of_move[speed.move]) +
                                " rpm move the rim of a cutter of " + format_decimal(cutter.diameter_mm) +
                                " mm at " + three_digits(speed.value * kMostCuttingSpeed) + " m/min" +
                                speed.others() + ": no tool stands more than about 10000; check S"});
    }
    return warnings;
}

}  // namespace tribo::session
