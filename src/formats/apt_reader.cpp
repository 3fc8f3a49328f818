// SPDX-License-Identifier: MIT
#include "formats/apt_reader.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "formats/apt_lexer.hpp"
#include "formats/apt_report.hpp"
#include "formats/apt_settings.hpp"
#include "formats/apt_words.hpp"
#include "formats/decimal_text.hpp"

namespace tribo::formats {
namespace apt {
namespace {

constexpr double kLongestDwellS = 86'400;
constexpr std::size_t kMostCutters = 1000;  // each new one is compared with all
constexpr double kShortestAxis = 1e-6, kLongestAxis = 1e6;

constexpr const char* kPlainGoto = "let the CAM system write it as GOTO with tool axes";

class Reader {
  public:
    Reader(std::string_view bytes, const AptOptions& options)
        : lexer_(bytes, options.source_name), options_(options), report_(options.source_name) {
        settings_.unit_mm = mm_per(options.default_unit);
        program_.source = options.source_name;
    }

    Result<motion::Program> read() {
        Statement statement;
        bool any = false, ended = false;
        while (!ended) {
            const auto found = lexer_.next(statement);
            if (!found) return std::unexpected(found.error());
            if (!*found) break;
            any = true;
            if (statement.is_text) {
                note_inserted_text(statement);
                continue;
            }
            const Meaning meaning = meaning_of(statement.word.text);
            ended = meaning.action == Action::end;
            if (auto done = run(statement, meaning); !done) return std::unexpected(done.error());
        }
        if (!any) {
            return fail_at(options_.source_name, 0, 0, "no APT statement in this file",
                           "check that it is the right one");
        }
        if (ended && lexer_.rest().find_first_not_of(" \t\v\f\r\n") != std::string_view::npos) {
            report_.warn(statement.word.line, "what follows FINI is not read");
        }
        if (program_.moves.empty()) report_.warn(0, "the program moves no tool");
        program_.warnings = std::move(report_.warnings);
        return std::move(program_);
    }

  private:
    Result<void> run(const Statement& statement, const Meaning& meaning) {
        switch (meaning.action) {
            case Action::go_to:
                return go_to(statement);
            case Action::from:
                return from(statement);
            case Action::rapid:
                return rapid(statement);
            case Action::feed:
                next_is_rapid_ = false;
                return set_feed(statement, settings_, report_);
            case Action::spindle:
                return set_spindle(statement, settings_, report_);
            case Action::load:
                return load_tool(statement, settings_, report_);
            case Action::cutter:
                return set_cutter(statement, settings_, report_);
            case Action::units:
                return set_units(statement, settings_, report_);
            case Action::multi_axis:
                return multi_axis(statement);
            case Action::delay:
                return delay(statement);
            case Action::compensation:
                return compensation(statement);
            case Action::end:
            case Action::nothing:
                return {};
            case Action::unread:
                break;
        }
        const Item& word = statement.word;
        if (meaning.what.empty()) {
            return report_.refuse(
                word, "statement " + quoted(word.text) + " is not known",
                "check that the file is APT CLDATA; delete the line where it moves no tool");
        }
        return report_.refuse(
            word, quoted(word.text) + " (" + std::string(meaning.what) + ") is not read yet", kPlainGoto);
    }

    // The point of GOTO and FROM; without an axis of its own it has the one in force.
    Result<motion::ToolPose> pose_of(const Statement& statement) {
        const std::size_t count = statement.items.size();
        if (count != 3 && count != 6) {
            return report_.refuse(statement.word,
                                  quoted(statement.word.text) + " has " + std::to_string(count) + " numbers",
                                  "write x,y,z or x,y,z,i,j,k");
        }
        if (!settings_.unit_stated && report_.first(Note::unit)) {
            report_.warn(statement.word.line, "no UNITS before the first point: " +
                                                  std::string(plural(options_.default_unit)) + " are taken");
        }
        motion::ToolPose pose{{}, axis_};
        const double farthest = kLargestCoordinateMm / settings_.unit_mm;
        for (int axis = 0; axis < 3; ++axis) {
            const auto place =
                report_.number(statement.items[static_cast<std::size_t>(axis)], -farthest, farthest);
            if (!place) return std::unexpected(place.error());
            pose.tip_mm[axis] = *place * settings_.unit_mm;
        }
        if (count == 3) return pose;
        for (int axis = 0; axis < 3; ++axis) {
            const Item& item = statement.items[static_cast<std::size_t>(axis) + 3];
            const auto component = report_.number(item, -kLongestAxis, kLongestAxis);
            if (!component) return std::unexpected(component.error());
            pose.axis[axis] = *component;
        }
        if (length(pose.axis) < kShortestAxis) {
            return report_.refuse(statement.items[3], "the tool axis has no length",
                                  "give the direction from the tip to the shank");
        }
        pose.axis = normalized(pose.axis);
        return pose;
    }

    Result<void> from(const Statement& statement) {
        const auto pose = pose_of(statement);
        if (!pose) return std::unexpected(pose.error());
        place_ = *pose;
        axis_ = pose->axis;
        return {};
    }

    Result<void> go_to(const Statement& statement) {
        const auto pose = pose_of(statement);
        if (!pose) return std::unexpected(pose.error());
        if (auto declared = declare_cutter(); !declared) return declared;
        const bool is_rapid = std::exchange(next_is_rapid_, false);
        const auto start = std::exchange(place_, *pose);
        axis_ = pose->axis;
        if (!start || *start == *pose) return {};
        motion::Move move = new_move(is_rapid ? motion::MoveKind::rapid : motion::MoveKind::feed, statement);
        move.start = *start;
        if (!is_rapid) {
            const auto speed = feed_mm_per_min(statement);
            if (!speed) return std::unexpected(speed.error());
            move.feed_mm_per_min = *speed;
            if (settings_.spindle_stopped && report_.first(Note::spindle_off)) {
                report_.warn(move.line, "feed move with the spindle off: it is taken as running");
            }
        }
        return append(std::move(move));
    }

    // A move that stays where the tool is now.
    motion::Move new_move(motion::MoveKind kind, const Statement& statement) const {
        motion::Move move;
        move.kind = kind;
        move.start = move.end = *place_;
        move.spindle_rpm = settings_.spindle_rpm;
        move.tool = settings_.tool;
        move.line = statement.word.line;
        return move;
    }

    Result<void> append(motion::Move move) {
        if (program_.moves.size() >= options_.max_moves) {
            return fail_at(options_.source_name, move.line, 1,
                           "the program has more than " + std::to_string(options_.max_moves) + " moves",
                           "split it");
        }
        program_.moves.push_back(std::move(move));
        return {};
    }

    Result<double> feed_mm_per_min(const Statement& statement) {
        if (!settings_.feed) {
            const double given = options_.default_feed_mm_per_min;
            if (!(given > 0)) {
                return report_.refuse(statement.word, "a feed move before any FEDRAT",
                                      "add FEDRAT before it, or RAPID where it does not cut");
            }
            if (report_.first(Note::feed)) {
                report_.warn(statement.word.line,
                             "no feed rate so far: " + short_decimal(given) + " mm/min is taken");
            }
            return given;
        }
        if (!settings_.feed->per_turn) return settings_.feed->value;
        if (settings_.spindle_rpm == 0) {
            return report_.refuse(statement.word, "a feed per turn with the spindle speed unknown",
                                  "add SPINDL with a speed before it");
        }
        return settings_.feed->value * settings_.spindle_rpm;
    }

    Result<void> rapid(const Statement& statement) {
        if (!statement.items.empty()) {
            return report_.refuse(statement.items.front(), "RAPID with conditions is not read yet",
                                  kPlainGoto);
        }
        next_is_rapid_ = true;
        return {};
    }

    Result<void> delay(const Statement& statement) {
        if (statement.items.size() != 1) {
            return report_.refuse(statement.word, "DELAY without a single number",
                                  "write DELAY/ and the seconds");
        }
        const auto seconds = report_.number(statement.items.front(), 0, kLongestDwellS);
        if (!seconds) return std::unexpected(seconds.error());
        if (!place_ || *seconds == 0) return {};
        motion::Move move = new_move(motion::MoveKind::dwell, statement);
        move.duration_s = *seconds;
        return append(std::move(move));
    }

    Result<void> multi_axis(const Statement& statement) {
        if (statement.items.empty() || matches(statement.items.front().text, "ON")) return {};
        if (!matches(statement.items.front().text, "OFF")) {
            return report_.refuse(statement.items.front(), "MULTAX is neither ON nor OFF",
                                  "write one of the two");
        }
        axis_ = {0, 0, 1};
        return {};
    }

    Result<void> compensation(const Statement& statement) {
        if (!statement.items.empty() && matches(statement.items.front().text, "OFF")) return {};
        return report_.refuse(statement.word, "CUTCOM (cutter radius compensation) is not read yet",
                              "let the CAM system write the path of the tool itself");
    }

    // The last CUTTER belongs to the tool that is loaded by the time of the next point.
    Result<void> declare_cutter() {
        if (!settings_.cutter) return {};
        motion::DeclaredTool cutter = *std::exchange(settings_.cutter, std::nullopt);
        cutter.number = settings_.tool;
        const auto is_same = [&](const motion::DeclaredTool& tool) {
            return tool.number == cutter.number && tool.diameter_mm == cutter.diameter_mm &&
                   tool.corner_mm == cutter.corner_mm;
        };
        if (std::ranges::any_of(program_.tools, is_same)) return {};
        if (program_.tools.size() == kMostCutters) {
            return fail_at(options_.source_name, cutter.line, 1,
                           "more than " + std::to_string(kMostCutters) + " different cutters",
                           "split the program");
        }
        program_.tools.push_back(cutter);
        return {};
    }

    void note_inserted_text(const Statement& statement) {
        if (matches(statement.word.text, "INSERT") && report_.first(Note::inserted_text)) {
            report_.warn(statement.word.line, "INSERT hands text to the machine, which is not read");
        }
    }

    Lexer lexer_;
    const AptOptions& options_;
    Report report_;
    motion::Program program_;
    Settings settings_;
    Vec3 axis_{0, 0, 1};  // of the next point that gives none
    std::optional<motion::ToolPose> place_;
    bool next_is_rapid_ = false;
};

}  // namespace
}  // namespace apt

Result<motion::Program> read_apt(std::string_view bytes, const AptOptions& options) {
    return apt::Reader(bytes, options).read();
}

}  // namespace tribo::formats
