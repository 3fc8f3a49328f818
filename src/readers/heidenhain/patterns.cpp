// SPDX-License-Identifier: MIT
// Patterns of points at which a cycle runs: PATTERN DEF, cycles 220 and 221.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kMostPoints = 10'000;

bool runs_at_points(int cycle) {
    return is_old_cycle(cycle) || (cycle >= 200 && cycle < 300);
}

}  // namespace

// A point of the program in the frame; z is added to the surface.
Vec3 Interpreter::in_frame(double x, double y, double z) const {
    const auto placed = [&](double mm, int k) {
        return (scale_centre_mm_[k] + (mm - scale_centre_mm_[k]) * scale_[k]) * mirror_[k];
    };
    return {placed(x, 0), placed(y, 1), z};
}

// PATTERN DEF POS1 (X+25 Y+33.5 Z+0) POS2 (...), ROW, PAT, FRAME, CIRC, PITCHCIRC.
Result<void> Interpreter::define_pattern(LineReader& in) {
    if (!in.take("DEF")) return in.refuse(in.column(), "PATTERN without DEF", "write PATTERN DEF");
    pattern_.clear();
    std::optional<LineReader> reader(in);
    std::string kind;  // empty: outside of parentheses
    std::map<std::string, double> words;
    for (;;) {
        if (reader->at_end()) {
            const auto more = goes_on();
            if (!more) return std::unexpected(more.error());
            if (!*more) break;
            reader.emplace(line_, source_name_, parameters_);
            continue;
        }
        const int column = reader->column();
        if (reader->take(')')) {
            if (auto done = add_pattern(kind, words, column); !done) return done;
            kind.clear();
            words.clear();
            continue;
        }
        if (reader->take('(')) continue;
        const auto item = reader->item();
        if (!item) return std::unexpected(item.error());
        if (kind.empty()) {
            kind = (*item)->name;
        } else {
            words[(*item)->name] = (*item)->value.value_or(0);
        }
    }
    if (!kind.empty()) {
        return path_.refuse(place(line_.column), "a pattern has no ')'", "close the parenthesis");
    }
    return {};
}

Result<void> Interpreter::add_pattern(const std::string& kind, const std::map<std::string, double>& words,
                                      int column) {
    const auto word = [&](const char* name) {
        const auto found = words.find(name);
        return found == words.end() ? 0.0 : found->second;
    };
    const auto mm = [&](const char* name) { return word(name) * unit_mm_; };
    for (const auto& [name, value] : words) {
        if (auto good = path_.in_range(kLimits.coordinate, value, place(column)); !good) return good;
    }
    const bool is_line = kind == "ROW", is_circle = kind == "CIRC" || kind == "PITCHCIRC";
    double columns = 1, rows = 1;
    if (is_line || is_circle) columns = word("NUM");
    if (kind == "PAT" || kind == "FRAME") columns = word("NUMX"), rows = word("NUMY");
    if (kind != "POS" && kind != "PAT" && kind != "FRAME" && !is_line && !is_circle) {
        return path_.refuse(place(column), "the pattern '" + kind + "' is not known",
                            "write POS, ROW, PAT, FRAME, CIRC or PITCHCIRC");
    }
    if (!(columns >= 1) || !(rows >= 1) || columns > kMostPoints || rows > kMostPoints ||
        columns * rows + static_cast<double>(pattern_.size()) > kMostPoints) {
        return path_.refuse(place(column), "the pattern has no points, or more than 10000",
                            "correct its numbers");
    }
    const int across = static_cast<int>(columns), along = static_cast<int>(rows);
    if (is_circle) {
        const double step = kind == "CIRC" ? 360.0 / across : word("STEP");
        for (int i = 0; i < across; ++i) {
            const double rad = (word("START") + i * step) * math::kRadPerDeg, radius = mm("D") / 2;
            pattern_.push_back(
                in_frame(mm("X") + radius * math::cos(rad), mm("Y") + radius * math::sin(rad), mm("Z")));
        }
        return {};
    }
    // ROT turns the whole, ROTX and ROTY one direction of it.
    const double turn = word("ROT") * math::kRadPerDeg;
    const double x_rad = turn + word("ROTX") * math::kRadPerDeg;
    const double y_rad = turn + word("ROTY") * math::kRadPerDeg;
    const double dx = is_line ? mm("D") : mm("DX"), dy = mm("DY");
    for (int j = 0; j < along; ++j) {
        for (int k = 0; k < across; ++k) {
            const int i = j % 2 == 0 ? k : across - 1 - k;  // back and forth
            if (kind == "FRAME" && i > 0 && i < across - 1 && j > 0 && j < along - 1) continue;
            pattern_.push_back(in_frame(mm("X") + i * dx * math::cos(x_rad) - j * dy * math::sin(y_rad),
                                        mm("Y") + i * dx * math::sin(x_rad) + j * dy * math::cos(y_rad),
                                        mm("Z")));
        }
    }
    return {};
}

// 220: points on a circle. 221: points on lines. They run the cycle defined before, at once.
Result<void> Interpreter::run_point_pattern(const Cycle& pattern) {
    if (!runs_at_points(cycle_.number)) {
        return path_.refuse(pattern.place, "a pattern without a cycle before it",
                            "write the drilling cycle before it");
    }
    for (const int q : {200, 203, 204}) {
        if (pattern.q.contains(q)) cycle_.q[q] = pattern.at(q);
    }
    const double columns = pattern.at(pattern.number == 220 ? 241 : 242);
    const double rows = pattern.number == 220 ? 1 : pattern.at(243);
    if (!(columns >= 1) || !(rows >= 1) || columns > kMostPoints || rows > kMostPoints ||
        columns * rows > kMostPoints) {
        return path_.refuse(pattern.place, "the pattern has no points, or more than 10000",
                            "correct its numbers");
    }
    std::vector<Vec3> points;
    const int across = static_cast<int>(columns), along = static_cast<int>(rows);
    if (pattern.number == 220) {
        double step = pattern.at(247);
        if (step == 0) {  // from the stopping angle; a full circle has its first point once
            const double span = pattern.at(246) - pattern.at(245);
            step = std::abs(span) >= 360 || across == 1 ? span / across : span / (across - 1);
        }
        for (int i = 0; i < across; ++i) {
            const double rad = (pattern.at(245) + i * step) * math::kRadPerDeg, radius = pattern.at(244) / 2;
            points.push_back(in_frame(pattern.at(216) + radius * math::cos(rad),
                                      pattern.at(217) + radius * math::sin(rad), 0));
        }
    } else {
        const double rad = pattern.at(224) * math::kRadPerDeg, c = math::cos(rad), s = math::sin(rad);
        for (int j = 0; j < along; ++j) {
            for (int k = 0; k < across; ++k) {
                const double x = (j % 2 == 0 ? k : across - 1 - k) * pattern.at(237), y = j * pattern.at(238);
                points.push_back(
                    in_frame(pattern.at(225) + x * c - y * s, pattern.at(226) + x * s + y * c, 0));
            }
        }
    }
    return run_at(points, pattern.place);
}

// Runs the cycle at points; between them the tool moves above the second clearance.
Result<void> Interpreter::run_at(const std::vector<Vec3>& points, Place where) {
    if (!runs_at_points(cycle_.number)) {
        return path_.refuse(where, "a pattern without a cycle before it",
                            "write the drilling cycle before it");
    }
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    const double surface = cycle_.at(203);
    if (is_lost() && !points.empty()) {  // the tool comes from above the first point
        const double above = surface + points[0].z + std::max(cycle_.at(200), cycle_.at(204));
        path_.put({points[0].x, points[0].y, above}, {Known::yes, Known::yes, Known::yes}, line_.number);
    }
    assume_start();
    for (const Vec3 point : points) {
        cycle_.q[203] = surface + point.z;
        const double above = surface + point.z + std::max(cycle_.at(200), cycle_.at(204));
        auto done = path_.tip().z < above ? go_to_height(above, kRapid) : Result<void>{};
        if (done) done = go_to_place(point.x, point.y, kRapid);
        if (done && is_old_cycle(cycle_.number))
            done = go_to_height(surface + point.z + cycle_.at(200), kRapid);
        if (done) done = run_cycle(where);
        cycle_.q[203] = surface;
        if (!done) return done;
    }
    return {};
}

}  // namespace tribo::readers::heidenhain
