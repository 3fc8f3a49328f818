// SPDX-License-Identifier: MIT
#include "readers/apt/reader.hpp"

#include <optional>
#include <string>
#include <utility>

#include "readers/apt/circles/arcs.hpp"
#include "readers/apt/clearance.hpp"
#include "readers/apt/cycle.hpp"
#include "readers/apt/lexer.hpp"
#include "readers/apt/passed.hpp"
#include "readers/apt/path.hpp"
#include "readers/apt/procedures.hpp"
#include "readers/apt/report.hpp"
#include "readers/apt/words.hpp"
#include "readers/control/refusals.hpp"

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
          path_(options, report_),
          arcs_(path_, report_) {}

    Result<motion::Program> read() {
        Statement statement;
        bool any = false;
        while (!ended_) {
            const auto found = lexer_.next(statement);
            if (found && !*found) break;
            any = true;
            const auto done = found ? unfold(statement) : std::unexpected(found.error());
            if (!done && !goes_on_after(done.error())) return std::unexpected(done.error());
        }
        if (auto ok = procedures_.finish(); !ok && !goes_on_after(ok.error()))
            return std::unexpected(ok.error());
        if (auto ok = arcs_.leave(); !ok && !goes_on_after(ok.error())) return std::unexpected(ok.error());
        if (const Error* first = first_refusal(options_.refusals)) return std::unexpected(*first);
        if (!any_known_) {
            if (auto ok = passed_.refuse_first(report_); !ok) return std::unexpected(ok.error());
        }
        if (!any) {
            return fail_at(options_.source_name, 0, 0, "no APT statement in this file",
                           "check that it is the right one");
        }
        arcs_.finish();
        passed_.warn(report_);
        if (ended_ && lexer_.rest().find_first_not_of(" \t\v\f\r\n\x1a") != std::string_view::npos) {
            report_.warn(statement.word.line, "what follows FINI is not read");
        }
        return path_.finish();
    }

  private:
    // Keeps a refusal where the caller wants them all. The reading goes on without the statement, from the
    // next point on.
    bool goes_on_after(const Error& error) {
        if (!keep_refusal(options_.refusals, error)) return false;
        arcs_.drop();
        path_.next_is_rapid = false;
        path_.set_place({});
        return true;
    }

    // Runs the statement, or those that a macro or a copy makes of it.
    Result<void> unfold(const Statement& statement) {
        const auto run_copy = [&](const Statement& one, const Frame& frame) -> Result<void> {
            if (auto done = move_copy(frame); !done) return done;
            return one.word.text.empty() || ended_ ? Result<void>{} : run(one);
        };
        return procedures_.take(statement, path_.settings.unit_mm, run_copy);
    }
    Result<void> move_copy(const Frame& frame) {
        if (frame.origin_mm == copy_.origin_mm && frame.x == copy_.x && frame.y == copy_.y) return {};
        if (auto done = arcs_.leave(); !done) return done;
        copy_ = frame;
        path_.frames.set_copy(frame);
        return {};
    }

    Result<void> run(const Statement& statement) {
        if (statement.is_text) {
            note_inserted_text(statement);
            return {};
        }
        if (statement.is_header) return header(statement);
        const Meaning meaning = meaning_of(statement.word.text);
        ended_ = meaning.action == Action::end;
        if (meaning.action != Action::go_to) {
            if (auto ok = arcs_.leave(); !ok) return ok;
        }
        if (auto done = run(statement, meaning); !done) return done;
        any_known_ = any_known_ || meaning.action != Action::unknown;
        return {};
    }

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
                path_.next_is_rapid = false;
                return set_feed(statement, path_.settings, report_);
            case Action::circle:
                return cycle_ ? refuse_in_cycle(statement) : arcs_.begin(statement);
            case Action::direction:
                return arcs_.set_direction(statement);
            case Action::surface:
                return arcs_.set_surface(statement);
            case Action::circle_catia:
                if (statement.items.empty() || statement.items[0].text.find('/') == std::string_view::npos)
                    return refuse_unread(statement, meaning);
                return cycle_ ? refuse_in_cycle(statement) : arcs_.go_forward(statement);
            case Action::arc_slope:
                return arcs_.set_slope(statement);
            case Action::cycle:
                return cycle(statement);
            case Action::clearance:
                return clearance_.set(statement, path_, report_);
            case Action::retract:
                path_.next_is_rapid = false;
                return clearance_.retract(statement, path_, report_);
            case Action::spindle:
                return set_spindle(statement, path_.settings, report_);
            case Action::load:
                return load_tool(statement, path_.settings, report_);
            case Action::tool_kind:
                note_tool_kind(statement, report_);
                return {};
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
            case Action::work_frame:
                return path_.frames.set_work_frame(statement, unit_mm, path_.any_points(), report_);
            case Action::transform:
                return path_.frames.set_transform(statement, unit_mm, report_);
            case Action::mode:
                return mode(statement);
            case Action::turn:
                return turn(statement, meaning);
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
            case Action::unknown:
                return passed_.add(statement.word, report_);
            case Action::unread:
                break;
        }
        return refuse_unread(statement, meaning);
    }

    std::unexpected<Error> refuse_unread(const Statement& statement, const Meaning& meaning) const {
        return report_.refuse(
            statement.word, quoted(statement.word.text) + " (" + std::string(meaning.what) + ") is not read",
            kPlainGoto);
    }
    // What Creo and CATIA write into comments.
    Result<void> header(const Statement& statement) {
        const std::string_view word = statement.word.text;
        if (matches(word, "CSYS") || matches(word, "CATIA0")) {
            if (auto ok = arcs_.leave(); !ok) return ok;
            if (statement.items.empty()) {
                report_.warn(statement.word.line,
                             "a coordinate system without its matrix: it is taken as none");
                return {};
            }
            return path_.frames.set_header_frame(statement, path_.settings.unit_mm, path_.any_points(),
                                                 report_);
        }
        if (matches(word, "CUTCOM_GEOMETRY_TYPE")) {
            on_contour_ = !statement.items.empty() && !matches(statement.items[0].text, "OUTPUT_ON_CENTER");
        }
        if (matches(word, "CUTTER")) {
            const auto set = set_cutter(statement, path_.settings, report_);
            if (!set) {
                report_.warn(statement.word.line,
                             "the cutter in the comment is not taken: " + set.error().cause);
            }
        }
        return {};
    }

    Result<void> from(const Statement& statement) {
        const auto pose = path_.read_pose(statement);
        if (!pose) return std::unexpected(pose.error());
        path_.set_place(*pose);
        return {};
    }

    Result<void> go_to(const Statement& statement) {
        const auto pose = path_.read_pose(statement);
        if (!pose) return std::unexpected(pose.error());
        if (cycle_) {
            path_.next_is_rapid = false;
            return drill(*cycle_, *pose, statement.word, path_, report_);
        }
        if (arcs_.on()) return arcs_.go(*pose, statement);
        return path_.go(*pose, path_.take_kind(), statement.word);
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
        return path_.go(end, path_.take_kind(), statement.word);
    }

    // The machine defines the home position, unless the statement gives it.
    Result<void> go_home(const Statement& statement) {
        path_.next_is_rapid = false;
        if (!statement.items.empty() && number_of(statement.items[0].text)) {
            const auto pose = path_.read_pose(statement);
            if (!pose) return std::unexpected(pose.error());
            return path_.go(*pose, motion::MoveKind::rapid, statement.word);
        }
        path_.leave_to_home(statement);
        return {};
    }

    Result<void> refuse_in_cycle(const Statement& statement) const {
        return report_.refuse(
            statement.word, "a circle while the CYCLE of line " + std::to_string(cycle_->at.line) + " is on",
            "write CYCLE/OFF before it");
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
            if (statement.items.size() == 1) {
                cycle_ = last_cycle_;
                return {};
            }
            change_words(statement, cycle_changes_);
        } else {
            cycle_words_ = statement;
            cycle_changes_.clear();
        }
        Statement whole = cycle_words_;
        whole.word = statement.word;
        whole.items.insert(whole.items.end(), cycle_changes_.begin(), cycle_changes_.end());
        const auto found = read_cycle(whole, path_, report_);
        if (!found) return std::unexpected(found.error());
        cycle_ = last_cycle_ = *found;
        return {};
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
        path_.next_is_rapid = true;
        return {};
    }

    Result<void> delay(const Statement& statement) {
        const auto& items = statement.items;
        const bool reversed = items.size() == 2 && matches(items[0].text, "REV");
        const bool in_turns = reversed || (items.size() == 2 && matches(items[1].text, "REV"));
        const bool in_seconds = items.size() == 1 || (items.size() == 2 && matches(items[1].text, "SEC"));
        if (!in_seconds && !in_turns) {
            return report_.refuse(statement.word, "DELAY without a single number",
                                  "write DELAY/ and the seconds");
        }
        const auto time = report_.number(items[reversed ? 1 : 0], kLimits.dwell);
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

    // MODE/INCR makes the points increments on some machines.
    Result<void> mode(const Statement& statement) {
        for (const Item& item : statement.items) {
            if (!matches(item.text, "INCR")) continue;
            return report_.refuse(item, "points as increments are not read", "write MODE/ABSOL, and points");
        }
        return {};
    }

    // A turn of the table by 0 moves nothing.
    Result<void> turn(const Statement& statement, const Meaning& meaning) const {
        bool any = false;
        for (const Item& item : statement.items) {
            const auto angle = number_of(item.text);
            if (angle && *angle != 0) return refuse_unread(statement, meaning);
            any = any || angle;
        }
        if (!any) return refuse_unread(statement, meaning);
        return {};
    }

    Result<void> compensation(const Statement& statement) {
        // Compensation of lengths: the tip does not move.
        for (const Item& item : statement.items) {
            if (matches(item.text, "OFF") || matches(item.text, "LENGTH") || matches(item.text, "ADJUST"))
                return {};
        }
        if (on_contour_) {
            return report_.refuse(statement.word, "CUTCOM where the points are those of the part's contour",
                                  "set the output point of the work center to the tool's centre in Creo");
        }
        if (report_.first(Note::compensation)) {
            report_.warn(
                statement.word.line,
                "CUTCOM: the points are taken as the path of the tool's centre, without a correction "
                "of its radius");
        }
        return {};
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

    Lexer lexer_;
    const AptOptions& options_;
    Report report_;
    Path path_;
    Arcs arcs_;
    Clearance clearance_;
    std::optional<Cycle> cycle_, last_cycle_;
    Statement cycle_words_;            // that described a cycle
    std::vector<Item> cycle_changes_;  // by CYCLE/ON since then
    bool on_contour_ = false;          // the header of Creo says so
    bool any_known_ = false;
    bool ended_ = false;  // by FINI
    PassedWords passed_;
    Procedures procedures_{report_, options_.max_statements};
    Frame copy_;  // in which the statement runs
};

}  // namespace
}  // namespace apt

Result<motion::Program> read_apt(std::string_view bytes, const AptOptions& options) {
    return apt::AptReader(bytes, options).read();
}

}  // namespace tribo::readers
