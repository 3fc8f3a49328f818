// SPDX-License-Identifier: MIT
#include "readers/apt/reader.hpp"

#include <optional>
#include <utility>

#include "readers/apt/circle.hpp"
#include "readers/apt/cycle.hpp"
#include "readers/apt/lexer.hpp"
#include "readers/apt/path.hpp"
#include "readers/apt/report.hpp"
#include "readers/apt/words.hpp"

namespace tribo::readers {
namespace apt {
namespace {

constexpr const char* kPlainGoto = "let the CAM system write it as GOTO with tool axes";

class AptReader {
  public:
    AptReader(std::string_view bytes, const AptOptions& options)
        : lexer_(bytes, options.source_name),
          options_(options),
          report_(options.source_name),
          path_(options, report_) {}

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
            if (meaning.action != Action::go_to) {
                if (auto ok = leave_circle(); !ok) return std::unexpected(ok.error());
            }
            if (auto done = run(statement, meaning); !done) return std::unexpected(done.error());
        }
        if (auto ok = leave_circle(); !ok) return std::unexpected(ok.error());
        if (!any) {
            return fail_at(options_.source_name, 0, 0, "no APT statement in this file",
                           "check that it is the right one");
        }
        if (circle_) report_.warn(circle_->at.line, "a circle without a point that ends it was left out");
        if (ended && lexer_.rest().find_first_not_of(" \t\v\f\r\n") != std::string_view::npos) {
            report_.warn(statement.word.line, "what follows FINI is not read");
        }
        return path_.finish();
    }

  private:
    Result<void> run(const Statement& statement, const Meaning& meaning) {
        const double unit_mm = path_.settings.unit_mm;
        switch (meaning.action) {
            case Action::go_to:
                return go_to(statement);
            case Action::go_by:
                return go_by(statement);
            case Action::go_home:
                return go_home(statement);
            case Action::from:
                return from(statement);
            case Action::rapid:
                return rapid(statement);
            case Action::feed:
                next_is_rapid_ = false;
                return set_feed(statement, path_.settings, report_);
            case Action::circle:
                return circle(statement);
            case Action::direction:
                return direction(statement);
            case Action::circle_catia:
                return circle_catia(statement);
            case Action::cycle:
                return cycle(statement);
            case Action::clearance:
                return clearance(statement);
            case Action::retract:
                return retract(statement);
            case Action::spindle:
                return set_spindle(statement, path_.settings, report_);
            case Action::load:
                return load_tool(statement, path_.settings, report_);
            case Action::cutter:
                return set_cutter(statement, path_.settings, report_);
            case Action::tool_data:
                return set_tool_data(statement, path_.settings, report_);
            case Action::units:
                return set_units(statement, path_.settings, report_);
            case Action::multi_axis:
                return multi_axis(statement);
            case Action::tool_axis:
                return tool_axis(statement);
            case Action::machine_frame:
                return path_.frames.set_machine_frame(statement, unit_mm, path_.any_points(), report_);
            case Action::frame:
                return path_.frames.set_frame(statement, unit_mm, report_);
            case Action::frame_type:
                return path_.frames.set_frame_type(statement, report_);
            case Action::translation:
                return path_.frames.set_translation(statement, unit_mm, report_);
            case Action::origin:
                return path_.frames.set_origin(statement, report_);
            case Action::delay:
                return delay(statement);
            case Action::compensation:
                return compensation(statement);
            case Action::machine_code:
                note_machine_text(statement);
                return {};
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
        return report_.refuse(word, quoted(word.text) + " (" + std::string(meaning.what) + ") is not read",
                              kPlainGoto);
    }

    Result<void> from(const Statement& statement) {
        const auto pose = path_.read_pose(statement, 0, statement.items.size());
        if (!pose) return std::unexpected(pose.error());
        path_.set_place(*pose);
        return {};
    }

    motion::MoveKind take_kind() {
        return std::exchange(next_is_rapid_, false) ? motion::MoveKind::rapid : motion::MoveKind::feed;
    }

    Result<void> go_to(const Statement& statement) {
        const auto pose = path_.read_pose(statement, 0, statement.items.size());
        if (!pose) return std::unexpected(pose.error());
        if (cycle_) {
            next_is_rapid_ = false;
            return drill(*cycle_, *pose, statement.word, path_, report_);
        }
        if (circle_) return go_round(*pose, statement);
        return path_.go(*pose, take_kind(), statement.word);
    }

    Result<void> go_by(const Statement& statement) {
        if (!path_.place()) {
            return report_.refuse(statement.word, "GODLTA before any point", "add FROM or GOTO before it");
        }
        motion::ToolPose end = *path_.place();
        const std::size_t count = statement.items.size();
        if (count == 1) {
            const auto along = report_.number(statement.items[0], kLimits.coordinate, path_.settings.unit_mm);
            if (!along) return std::unexpected(along.error());
            end.tip_mm += *along * path_.settings.unit_mm * end.axis;
        } else if (count == 3) {
            const auto by = path_.read_point(statement, 0);
            if (!by) return std::unexpected(by.error());
            end.tip_mm += path_.frames.to_program().turn(*by);
        } else {
            return report_.refuse(statement.word, "GODLTA has " + std::to_string(count) + " numbers",
                                  "write dx,dy,dz, or one along the tool axis");
        }
        return path_.go(end, take_kind(), statement.word);
    }

    // The machine defines the home position, unless the statement gives it.
    Result<void> go_home(const Statement& statement) {
        next_is_rapid_ = false;
        if (!statement.items.empty() && number_of(statement.items[0].text)) {
            const auto pose = path_.read_pose(statement, 0, statement.items.size());
            if (!pose) return std::unexpected(pose.error());
            return path_.go(*pose, motion::MoveKind::rapid, statement.word);
        }
        if (report_.first(Note::home)) {
            report_.warn(statement.word.line,
                         "GOHOME leads where only the machine knows: the path ends there and goes on at the "
                         "next point");
        }
        path_.set_place({});
        return {};
    }

    Result<void> circle(const Statement& statement) {
        if (cycle_) return refuse_in_cycle(statement);
        auto found = read_circle(statement, path_, report_);
        if (!found) return std::unexpected(found.error());
        if (!path_.place()) return refuse_without_start(statement);
        circle_ = *std::move(found);
        circle_used_ = circle_held_ = false;
        return {};
    }

    Result<void> go_round(const motion::ToolPose& end, const Statement& statement) {
        const Vec3 start = path_.place()->tip_mm;
        if (circle_held_) {
            // The start was repeated before points along the circle.
            if (end.tip_mm == start || !is_on(*circle_, end.tip_mm)) {
                if (auto ok = leave_circle(); !ok) return ok;
                return path_.go(end, take_kind(), statement.word);
            }
            circle_held_ = false;
        } else if (!circle_used_ && end.tip_mm == start && !circle_->turn_rad) {
            circle_held_ = true;
            circle_end_ = statement.word;
            return {};
        }
        if (circle_used_ && (end.tip_mm == start || !is_on(*circle_, end.tip_mm))) {
            circle_.reset();
            return path_.go(end, take_kind(), statement.word);
        }
        const auto arc = arc_to(*circle_, start, end.tip_mm, statement.word, report_);
        if (!arc) return std::unexpected(arc.error());
        circle_used_ = true;
        circle_->turn_rad.reset();
        circle_->more_turns = 0;
        return path_.go(end, take_kind(), statement.word, *arc);
    }

    // Called at a statement other than GOTO: ends a finished circle; a circle whose end is its start becomes
    // a full turn.
    Result<void> leave_circle() {
        if (std::exchange(circle_held_, false)) {
            const motion::ToolPose end = *path_.place();
            const auto arc = arc_to(*circle_, end.tip_mm, end.tip_mm, circle_end_, report_);
            if (!arc) return std::unexpected(arc.error());
            if (report_.first(Note::full_circle)) {
                report_.warn(circle_end_.line, "a circle that ends where it starts is taken as a full turn");
            }
            circle_.reset();
            return path_.go(end, take_kind(), circle_end_, *arc);
        }
        if (circle_used_) circle_.reset();
        circle_used_ = false;
        return {};
    }

    Result<void> direction(const Statement& statement) {
        if (statement.items.size() != 3) {
            return report_.refuse(statement.word, "INDIRV without a direction", "write INDIRV/i,j,k");
        }
        const auto found = path_.read_direction(statement, 0);
        if (!found) return std::unexpected(found.error());
        forward_ = *found;
        return {};
    }

    Result<void> circle_catia(const Statement& statement) {
        if (cycle_) return refuse_in_cycle(statement);
        if (!path_.place()) return refuse_without_start(statement);
        if (!forward_) {
            return report_.refuse(statement.word, "a circle of CATIA without INDIRV before it",
                                  "add the direction in which it starts");
        }
        const auto found =
            read_catia_circle(statement, *std::exchange(forward_, std::nullopt), path_, report_);
        if (!found) return std::unexpected(found.error());
        const auto arc = arc_to(found->circle, path_.place()->tip_mm, found->end_mm, statement.word, report_);
        if (!arc) return std::unexpected(arc.error());
        return path_.go({found->end_mm, path_.place()->axis}, take_kind(), statement.word, *arc);
    }

    std::unexpected<Error> refuse_in_cycle(const Statement& statement) const {
        return report_.refuse(
            statement.word, "a circle while the CYCLE of line " + std::to_string(cycle_->at.line) + " is on",
            "write CYCLE/OFF before it");
    }
    std::unexpected<Error> refuse_without_start(const Statement& statement) const {
        return report_.refuse(statement.word, "a circle before any point", "add FROM or GOTO before it");
    }

    Result<void> cycle(const Statement& statement) {
        const std::string_view how = statement.items.empty() ? "" : statement.items[0].text;
        if (matches(how, "INIT")) return {};
        if (matches(how, "OFF") || matches(how, "NOMORE")) {
            cycle_.reset();
            return {};
        }
        if (matches(how, "ON")) {
            if (!last_cycle_) {
                return report_.refuse(statement.word, "CYCLE/ON before any cycle was described",
                                      "describe one: CYCLE/DRILL,FEDTO,10,MMPM,100,RAPTO,2");
            }
            cycle_ = last_cycle_;
            return {};
        }
        const auto found = read_cycle(statement, path_, report_);
        if (!found) return std::unexpected(found.error());
        cycle_ = last_cycle_ = *found;
        return {};
    }

    // CLEARP/z, CLEARP/XYPLAN,z, CLEARP/a,b,c,d (a x + b y + c z = d) or CLEARP/OFF
    Result<void> clearance(const Statement& statement) {
        const auto& items = statement.items;
        if (!items.empty() && matches(items[0].text, "OFF")) {
            clear_plane_.reset();
            return {};
        }
        constexpr std::string_view planes[] = {"YZPLAN", "ZXPLAN", "XYPLAN"};
        Plane plane;
        std::size_t height = 0;
        if (items.size() == 4) {
            const auto normal = path_.read_direction(statement, 0);
            if (!normal) return std::unexpected(normal.error());
            plane.normal = *normal;
            height = 3;
        } else if (items.size() == 2) {
            int k = 0;
            while (k < 3 && !matches(items[0].text, planes[k])) ++k;
            if (k == 3)
                return report_.refuse(items[0], quoted(items[0].text) + " is no plane", "write XYPLAN");
            plane.normal = {};
            plane.normal[k] = 1;
            height = 1;
        } else if (items.size() != 1) {
            return report_.refuse(statement.word, "CLEARP without a plane", "write CLEARP/XYPLAN,z");
        }
        const auto value = report_.number(items[height], kLimits.coordinate, path_.settings.unit_mm);
        if (!value) return std::unexpected(value.error());
        const Frame& frame = path_.frames.to_program();
        plane.distance_mm = *value * path_.settings.unit_mm;
        plane.normal = frame.turn(plane.normal);
        plane.distance_mm += dot(plane.normal, frame.origin_mm);
        clear_plane_ = plane;
        return {};
    }

    // Moves along the tool axis up to the clearance plane; no move if the tool is already beyond it.
    Result<void> retract(const Statement& statement) {
        if (!statement.items.empty() && !matches(statement.items[0].text, "ON")) {
            return report_.refuse(statement.items[0], "RETRCT with conditions is not read", kPlainGoto);
        }
        if (!path_.place()) return {};
        if (!clear_plane_) {
            return report_.refuse(statement.word, "RETRCT without a clearance plane",
                                  "write CLEARP/XYPLAN,z before it");
        }
        motion::ToolPose end = *path_.place();
        const double rise = dot(end.axis, clear_plane_->normal);
        const double gap = clear_plane_->distance_mm - dot(end.tip_mm, clear_plane_->normal);
        if (rise < 1e-3) {
            return report_.refuse(statement.word, "the tool axis does not lead to the clearance plane",
                                  "correct CLEARP");
        }
        next_is_rapid_ = false;
        if (gap <= 0) return {};
        end.tip_mm += gap / rise * end.axis;
        return path_.go(end, motion::MoveKind::rapid, statement.word);
    }

    // The speed in RAPID/MMPM,8000 is ignored: the machine defines the rapid speed.
    Result<void> rapid(const Statement& statement) {
        for (const Item& item : statement.items) {
            const bool is_speed = matches(item.text, "IPM") || matches(item.text, "MMPM") ||
                                  matches(item.text, "PERMIN") || number_of(item.text);
            if (!is_speed) {
                return report_.refuse(item, "RAPID with conditions is not read", kPlainGoto);
            }
        }
        if (!statement.items.empty() && report_.first(Note::rapid_speed)) {
            report_.warn(statement.word.line, "the speed of RAPID is not used: rapids run at the machine's");
        }
        next_is_rapid_ = true;
        return {};
    }

    Result<void> delay(const Statement& statement) {
        const auto& items = statement.items;
        const bool in_turns = items.size() == 2 && matches(items[1].text, "REV");
        if (items.size() != 1 && !in_turns) {
            return report_.refuse(statement.word, "DELAY without a single number",
                                  "write DELAY/ and the seconds");
        }
        const auto time = report_.number(items.front(), kLimits.dwell);
        if (!time) return std::unexpected(time.error());
        if (!in_turns) return path_.dwell(*time, statement.word);
        if (path_.settings.spindle_rpm == 0) {
            return report_.refuse(items[1], "a dwell in turns with the spindle speed unknown",
                                  "add SPINDL with a speed before it");
        }
        return path_.dwell(*time * 60 / path_.settings.spindle_rpm, statement.word);
    }

    Result<void> multi_axis(const Statement& statement) {
        if (statement.items.empty() || matches(statement.items.front().text, "ON")) return {};
        if (!matches(statement.items.front().text, "OFF")) {
            return report_.refuse(statement.items.front(), "MULTAX is neither ON nor OFF",
                                  "write one of the two");
        }
        path_.axis = {0, 0, 1};
        return {};
    }

    Result<void> tool_axis(const Statement& statement) {
        if (statement.items.size() != 3) {
            return report_.refuse(statement.word, "TLAXIS without a direction", "write TLAXIS/i,j,k");
        }
        const auto axis = path_.read_direction(statement, 0);
        if (!axis) return std::unexpected(axis.error());
        path_.axis = *axis;
        return {};
    }

    Result<void> compensation(const Statement& statement) {
        // Compensation of lengths: the tip does not move.
        for (const Item& item : statement.items) {
            if (matches(item.text, "OFF") || matches(item.text, "LENGTH") || matches(item.text, "ADJUST"))
                return {};
        }
        return report_.refuse(statement.word, "CUTCOM (cutter radius compensation) is not read",
                              "let the CAM system write the path of the tool itself");
    }

    void note_inserted_text(const Statement& statement) {
        if (matches(statement.word.text, "INSERT")) note_machine_text(statement);
    }
    void note_machine_text(const Statement& statement) {
        if (!report_.first(Note::inserted_text)) return;
        std::string word(statement.word.text);
        for (char& c : word) c = to_upper(c);
        report_.warn(statement.word.line, word + " hands text to the machine, which is not read");
    }

    // In the frame of the program: normal . p = distance.
    struct Plane {
        Vec3 normal{0, 0, 1};
        double distance_mm = 0;
    };

    Lexer lexer_;
    const AptOptions& options_;
    Report report_;
    Path path_;
    bool next_is_rapid_ = false;
    std::optional<Circle> circle_;  // ends at the next GOTO; later GOTOs may continue along it
    bool circle_used_ = false;
    bool circle_held_ = false;  // its end is its start: a full turn, unless points along it follow
    Item circle_end_;
    std::optional<Vec3> forward_;  // of INDIRV
    std::optional<Cycle> cycle_, last_cycle_;
    std::optional<Plane> clear_plane_;
};

}  // namespace
}  // namespace apt

Result<motion::Program> read_apt(std::string_view bytes, const AptOptions& options) {
    return apt::AptReader(bytes, options).read();
}

}  // namespace tribo::readers
