// SPDX-License-Identifier: MIT
#include "readers/nci/reader.hpp"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/math.hpp"
#include "readers/apt/circles/circle.hpp"
#include "readers/apt/path.hpp"
#include "readers/apt/report.hpp"
#include "readers/apt/settings.hpp"
#include "readers/control/refusals.hpp"
#include "readers/nci/hole.hpp"
#include "readers/nci/records.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace nci {
namespace {

using apt::Item;
using apt::Note;
using apt::Statement;

// Entries of two matrices that differ by less are the same system.
constexpr double kSameEntry = 1e-6;
// Of a feed: as before, and rapid.
constexpr double kFeedAsBefore = -1, kFeedRapid = -2;

class NciReader {
  public:
    NciReader(std::string_view bytes, const AptOptions& options)
        : records_(bytes, options.source_name),
          options_(options),
          report_(options.source_name),
          path_(options, report_) {}

    Result<motion::Program> read() {
        Statement record;
        bool any = false;
        while (!ended_) {
            const auto found = records_.next(record);
            if (found && !*found) break;
            any = true;
            const auto done = found ? run(record) : std::unexpected(found.error());
            if (!done && !goes_on_after(done.error())) return std::unexpected(done.error());
        }
        if (const Error* first = first_refusal(options_.refusals)) return std::unexpected(*first);
        if (!any) {
            return fail_at(options_.source_name, 0, 0, "no NCI record in this file",
                           "check that it is the right one");
        }
        for (const auto& [code, line] : passed_) {
            report_.warn(line, "records " + std::to_string(code) + " are not known: they are passed over");
        }
        motion::Program program = path_.finish();
        program.dialect = "Mastercam NCI";
        return program;
    }

  private:
    bool goes_on_after(const Error& error) {
        if (!keep_refusal(options_.refusals, error)) return false;
        path_.set_place({});
        return true;
    }

    Result<void> run(const Statement& record) {
        const int code = records_.code();
        switch (code) {
            case 0:
            case 1:
                return line(record);
            case 2:
            case 3:
                return arc(record);
            case 4:
                return dwell(record);
            case 11:
                return five_axis(record);
            case 80:
                hole_.reset();
                return {};
            case 81:
                return first_hole(record);
            case 100:
                return next_hole(record);
            case 1000:
            case 1001:
            case 1002:
                return change_tool(record);
            case 1003:
                ended_ = true;
                return {};
            case 1013:
                return set_cutter(record);
            case 1014:
            case 1027:
                return set_system(record);
            case 1018:
            case 1019:
                return report_.refuse(record.word,
                                      "a subprogram (record " + std::to_string(code) + ") is not read",
                                      "let Mastercam write the moves of the operation without subprograms");
            default:
                return pass(record);
        }
    }

    // Settings of the post, comments, parameters of tools and operations move no tool.
    Result<void> pass(const Statement& record) {
        static const std::set<int> known{1004, 1005, 1006, 1007, 1008, 1010, 1011, 1012,
                                         1015, 1016, 1017, 1020, 1025, 1026, 1050, 1051};
        const int code = records_.code();
        if (code < 1000) {
            return report_.refuse(record.word,
                                  "record " + std::to_string(code) + " is not known, and may move the tool",
                                  "let Mastercam write the operation as points, lines and arcs");
        }
        constexpr std::size_t most_named = 20;
        if (code < 10'000 && !known.contains(code) && passed_.size() < most_named)
            passed_.try_emplace(code, record.word.line);
        return {};
    }

    Result<void> expect(const Statement& record, std::size_t least) const {
        if (record.items.size() >= least) return {};
        return report_.refuse(record.word,
                              "record " + std::to_string(records_.code()) + " has " +
                                  std::to_string(record.items.size()) + " values, and needs " +
                                  std::to_string(least),
                              "check that the file is NCI text and whole");
    }

    void note_unit(const Statement& record) {
        if (!report_.first(Note::unit)) return;
        report_.warn(record.word.line,
                     "an NCI file states no unit: " + std::string(plural(options_.default_unit)) +
                         " are taken; a job says otherwise with unit_mm = 25.4 beside the program");
    }

    // 41 and 42 leave the compensation to the control.
    Result<void> note_compensation(const Item& item) {
        const auto side = report_.number(item);
        if (!side) return std::unexpected(side.error());
        if ((*side == 41 || *side == 42) && report_.first(Note::compensation)) {
            report_.warn(item.line,
                         "compensation in the control: the points are taken as the path of the tool's "
                         "centre, without a correction of its radius");
        }
        return {};
    }

    // The kind of a move by its feed, which holds from here on.
    Result<motion::MoveKind> take_feed(const Item& item) {
        const auto feed = report_.number(item);
        if (!feed) return std::unexpected(feed.error());
        if (*feed == kFeedRapid) return motion::MoveKind::rapid;
        if (*feed == kFeedAsBefore) return motion::MoveKind::feed;
        const auto checked = apt::feed_of(item, *feed * path_.settings.unit_mm, false, report_);
        if (!checked) return std::unexpected(checked.error());
        path_.settings.feed = *checked;
        return motion::MoveKind::feed;
    }

    // compensation, x, y, z, feed, flags
    Result<void> line(const Statement& record) {
        if (auto ok = expect(record, 5); !ok) return ok;
        note_unit(record);
        hole_.reset();
        if (auto ok = note_compensation(record.items[0]); !ok) return ok;
        const auto point = path_.read_point(record, 1);
        if (!point) return std::unexpected(point.error());
        // The feed of a rapid is no feed that holds.
        if (records_.code() == 0) return path_.go({*point, {0, 0, 1}}, motion::MoveKind::rapid, record.word);
        const auto kind = take_feed(record.items[4]);
        if (!kind) return std::unexpected(kind.error());
        return path_.go({*point, {0, 0, 1}}, *kind, record.word);
    }

    // plane, compensation, end and centre in the plane, the end along its normal, feed, flags. The first two
    // stand in either order: a plane is 0 (XY), 1 (YZ) or 2 (XZ), and the others are 0 or 40 and on.
    Result<void> arc(const Statement& record) {
        if (auto ok = expect(record, 8); !ok) return ok;
        note_unit(record);
        hole_.reset();
        const auto& items = record.items;
        const auto first = report_.number(items[0]), second = report_.number(items[1]);
        if (!first) return std::unexpected(first.error());
        if (!second) return std::unexpected(second.error());
        const bool plane_is_first = *first < 40 && *first != 0;
        const double plane = plane_is_first ? *first : *second < 40 ? *second : 0;
        if (plane != 0 && plane != 1 && plane != 2)
            return report_.refuse(items[plane_is_first ? 0 : 1], "an arc in no plane",
                                  "write 0 (XY), 1 (YZ) or 2 (XZ)");
        for (const std::size_t i : {0U, 1U}) {
            if (auto ok = note_compensation(items[i]); !ok) return ok;
        }
        if (!path_.place())
            return report_.refuse(record.word, "an arc before any point", "add one before it");
        const auto kind = take_feed(items[7]);
        if (!kind) return std::unexpected(kind.error());
        return go_round(record, static_cast<int>(plane), *kind);
    }

    Result<void> go_round(const Statement& record, int plane, motion::MoveKind kind) {
        // Axes of the plane and its normal: XY, YZ, XZ.
        constexpr std::array<std::array<int, 3>, 3> axes{{{0, 1, 2}, {1, 2, 0}, {0, 2, 1}}};
        const auto [u, v, w] = axes[static_cast<std::size_t>(plane)];
        const auto in_plane = path_.read_point(record, 2), rest = path_.read_point(record, 4);
        if (!in_plane) return std::unexpected(in_plane.error());
        if (!rest) return std::unexpected(rest.error());
        const Vec3 start = path_.place()->tip_mm;
        apt::Circle circle;
        circle.at = record.word;
        Vec3 end;
        end[u] = in_plane->x;
        end[v] = in_plane->y;
        end[w] = circle.centre_mm[w] = rest->z;
        circle.centre_mm[u] = rest->x;
        circle.centre_mm[v] = rest->y;
        circle.normal[w] = records_.code() == 3 ? 1 : -1;
        circle.radius_mm = math::hypot(end[u] - circle.centre_mm[u], end[v] - circle.centre_mm[v]);
        if (circle.radius_mm <= apt::kOnCircleMm)
            return report_.refuse(record.word, "an arc whose end is its centre", "correct the record");
        const auto found = apt::arc_to(circle, start, end, record.word, report_);
        if (!found) return std::unexpected(found.error());
        if (plane == 2 && report_.first(Note::arc_slope)) {
            report_.warn(record.word.line,
                         "arcs in XZ are taken as G2 and G3 of G18: record 2 is clockwise seen from +Y");
        }
        return path_.go({end, {0, 0, 1}}, kind, record.word, *found);
    }

    // x, y, z, a point up the tool's axis, feed, flags, the normal of the surface
    Result<void> five_axis(const Statement& record) {
        if (auto ok = expect(record, 7); !ok) return ok;
        note_unit(record);
        hole_.reset();
        const auto point = path_.read_point(record, 0), above = path_.read_point(record, 3);
        if (!point) return std::unexpected(point.error());
        if (!above) return std::unexpected(above.error());
        if (distance(*point, *above) < kShortestAxisMm)
            return report_.refuse(record.items[3], "the two points of the tool's axis are one",
                                  "correct the record");
        if (is_tilted_)
            return report_.refuse(record.word, "a five-axis point in a tilted tool plane is not read",
                                  "set the tool plane of the operation to the top of the work system");
        const auto kind = take_feed(record.items[6]);
        if (!kind) return std::unexpected(kind.error());
        return path_.go({*point, normalized(*above - *point)}, *kind, record.word);
    }

    // seconds, spindle speed
    Result<void> dwell(const Statement& record) {
        if (auto ok = expect(record, 1); !ok) return ok;
        const auto time = report_.number(record.items[0], kLimits.dwell);
        if (!time) return std::unexpected(time.error());
        if (record.items.size() > 1) {
            if (auto ok = set_speed(record.items[1]); !ok) return ok;
        }
        return path_.dwell(*time, record.word);
    }

    // 0 leaves the speed as it is; a negative one turns the other way.
    Result<void> set_speed(const Item& item) {
        const auto speed = report_.number(item);
        if (!speed) return std::unexpected(speed.error());
        if (*speed == 0) return {};
        const std::string rpm = short_decimal(std::abs(*speed));
        Statement spindle;
        spindle.word = item;
        spindle.items = {{rpm, item.line, item.column},
                         {*speed < 0 ? "CCLW" : "CLW", item.line, item.column}};
        return apt::set_spindle(spindle, path_.settings, report_);
    }

    Result<void> first_hole(const Statement& record) {
        if (auto ok = expect(record, Hole::kValues); !ok) return ok;
        note_unit(record);
        auto hole = read_hole(record, path_, report_);
        if (!hole) return std::unexpected(hole.error());
        hole_ = *std::move(hole);
        return drill(*hole_, record.word, path_, report_);
    }

    Result<void> next_hole(const Statement& record) {
        if (auto ok = expect(record, Hole::kValuesOfNext); !ok) return ok;
        if (!hole_)
            return report_.refuse(record.word, "a further hole without a first one",
                                  "add a record 81 before it");
        if (auto ok = read_next_hole(record, *hole_, path_, report_); !ok) return ok;
        return drill(*hole_, record.word, path_, report_);
    }

    // program, block, step, tool, its offsets of radius and length, plane, spindle speed, feed, ...
    Result<void> change_tool(const Statement& record) {
        hole_.reset();
        if (auto ok = expect(record, 8); !ok) return ok;
        if (records_.code() != 1000) {
            Statement load;
            load.word = record.items[3];
            load.word.text = "LOADTL";
            load.items = {record.items[3]};
            if (auto ok = apt::load_tool(load, path_.settings, report_); !ok) return ok;
        }
        return set_speed(record.items[7]);
    }

    // direction of the compensation, diameter, corner radius
    Result<void> set_cutter(const Statement& record) {
        if (auto ok = expect(record, 3); !ok) return ok;
        const auto diameter = report_.number(record.items[1]);
        if (!diameter) return std::unexpected(diameter.error());
        if (*diameter == 0) return {};
        Statement cutter;
        cutter.word = record.word;
        cutter.items = {record.items[1], record.items[2]};
        return apt::set_cutter(cutter, path_.settings, report_);
    }

    // Three rows of three; a work system has its origin after them.
    Result<void> set_system(const Statement& record) {
        const bool is_work_system = records_.code() == 1027;
        const std::size_t count = is_work_system ? 12 : 9;
        if (auto ok = expect(record, count); !ok) return ok;
        std::array<double, 12> matrix{};
        for (std::size_t i = 0; i < count; ++i) {
            const auto entry = report_.number(record.items[i], kLimits.coordinate);
            if (!entry) return std::unexpected(entry.error());
            matrix[i] = *entry;
        }
        std::optional<std::array<double, 12>>& first = is_work_system ? work_system_ : tool_plane_;
        if (!first) first = matrix;
        for (std::size_t i = 0; i < count; ++i) {
            if (std::abs(matrix[i] - (*first)[i]) <= kSameEntry) continue;
            return report_.refuse(record.items[i],
                                  is_work_system ? "a second work system (record 1027) is not read"
                                                 : "a second tool plane (record 1014) is not read",
                                  "write a file for each, or let Mastercam write five-axis points");
        }
        constexpr std::array<double, 9> upright{1, 0, 0, 0, 1, 0, 0, 0, 1};
        bool tilts = false;
        for (std::size_t i = 0; i < upright.size(); ++i)
            tilts = tilts || std::abs(matrix[i] - upright[i]) > kSameEntry;
        if (tilts && report_.first(Note::second_frame)) {
            report_.warn(record.word.line, "a turned system (record " + std::to_string(records_.code()) +
                                               "): the stock stands in the system of the points");
        }
        if (!is_work_system) is_tilted_ = tilts;
        return {};
    }

    static constexpr double kShortestAxisMm = 1e-6;

    Records records_;
    const AptOptions& options_;
    apt::Report report_;
    apt::Path path_;
    std::optional<Hole> hole_;  // the cycle in force
    std::optional<std::array<double, 12>> tool_plane_, work_system_;
    bool is_tilted_ = false;
    bool ended_ = false;
    std::map<int, int> passed_;  // first lines of the records that are not known
};

}  // namespace
}  // namespace nci

Result<motion::Program> read_nci(std::string_view bytes, const AptOptions& options) {
    return nci::NciReader(bytes, options).read();
}

}  // namespace tribo::readers
