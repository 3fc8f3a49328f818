// SPDX-License-Identifier: MIT
#include "readers/apt/settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "readers/text/length_unit.hpp"
#include "readers/tools/declared_tool.hpp"

namespace tribo::readers::apt {
namespace {

// Largest difference between CUTTER/ and the tool described by its diameter and corner, mm or degrees.
constexpr double kCutterTolerance = 1e-3;

constexpr std::array kFeedUnits{
    FeedUnit{"MMPM", 1, false},   FeedUnit{"MMPR", 1, true},     FeedUnit{"IPM", 25.4, false},
    FeedUnit{"IPR", 25.4, true},  FeedUnit{"FPM", 304.8, false}, FeedUnit{"FPR", 304.8, true},
    FeedUnit{"PERMIN", 0, false}, FeedUnit{"PERREV", 0, true},   FeedUnit{"MMPMIN", 1, false},
    FeedUnit{"MMPREV", 1, true},  FeedUnit{"INPM", 25.4, false}, FeedUnit{"INPR", 25.4, true},
};

struct Unit {
    std::string_view word;
    double mm;
};
constexpr std::array kUnits{
    Unit{"MM", 1},     Unit{"MILLIMETERS", 1}, Unit{"MILLIMETRES", 1}, Unit{"MILLIMETER", 1},
    Unit{"METRIC", 1}, Unit{"CM", 10},         Unit{"INCHES", 25.4},   Unit{"INCH", 25.4},
    Unit{"IN", 25.4},  Unit{"ENGLISH", 25.4},
};

template <class List>
const auto* entry_of(const List& list, std::string_view word) {
    const auto found = std::ranges::find_if(list, [&](const auto& e) { return matches(word, e.word); });
    return found == list.end() ? nullptr : &*found;
}

// Words of SPINDL that change no speed. Some have a number after them.
bool is_word_of_spindle(std::string_view text) {
    constexpr std::array words{"RPM", "LOCK", "NEUTRL", "LOW", "MEDIUM", "HIGH", "REV", "AUTO"};
    return std::ranges::any_of(words, [&](const char* word) { return matches(text, word); });
}
bool is_value_of_spindle(std::string_view text) {
    constexpr std::array words{"RANGE", "MAXRPM", "ORIENT", "RADIUS"};
    return std::ranges::any_of(words, [&](const char* word) { return matches(text, word); });
}

}  // namespace

const FeedUnit* feed_unit(std::string_view word) {
    return entry_of(kFeedUnits, word);
}

Result<Feed> feed_of(const Item& at, double value, bool per_turn, const Report& report) {
    const Limit& limit = per_turn ? kLimits.feed_per_turn : kLimits.feed;
    if (limit.range.contains(value)) return Feed{value, per_turn};
    return report.refuse(at, out_of_range(limit, value), range_remedy(limit));
}

Result<void> set_units(const Statement& statement, Settings& settings, Report& report) {
    const Item& item = statement.items.empty() ? statement.word : statement.items.front();
    const Unit* unit = entry_of(kUnits, item.text);
    if (!unit) {
        return report.refuse(item, "units that are neither MM nor INCHES", "write UNITS/MM or UNITS/INCHES");
    }
    settings.unit_mm = unit->mm;
    settings.unit_stated = true;
    return {};
}

Result<void> set_feed(const Statement& statement, Settings& settings, Report& report) {
    std::optional<double> value;
    const Item* written = nullptr;
    double scale = settings.unit_mm;
    bool per_turn = false, inverse = false;
    for (const Item& item : statement.items) {
        if (inverse && (matches(item.text, "AUTO") || matches(item.text, "ON") || matches(item.text, "OFF")))
            continue;
        if (const FeedUnit* unit = feed_unit(item.text)) {
            if (unit->mm > 0) scale = unit->mm;
            per_turn = unit->per_turn;
            if (unit->mm > 25 && !settings.unit_stated && settings.unit_mm == 1 &&
                report.first(Note::inch_feeds)) {
                report.warn(item.line,
                            "a feed in inches or feet, and no UNITS: write UNITS/INCHES at the start if the "
                            "points are inches too");
            }
        } else if (matches(item.text, "INVERS") || matches(item.text, "INVERSE")) {
            inverse = true;
        } else if (matches(item.text, "FPT") || matches(item.text, "IPT") || matches(item.text, "MMPT")) {
            return report.refuse(item, "a feed per tooth, and APT does not say how many teeth",
                                 "write it per turn or per minute");
        } else {
            const auto speed = report.number(item);
            if (!speed) return std::unexpected(speed.error());
            if (value) return report.refuse(item, "a second feed rate", "give one number and its unit");
            value = *speed;
            written = &item;
        }
    }
    if (inverse && value) {
        return report.refuse(statement.word, "a feed in inverse time is not read",
                             "write FEDRAT with a speed; the post makes inverse time of it");
    }
    if (inverse) return {};
    if (!value) return report.refuse(statement.word, "FEDRAT without a number", "write FEDRAT/100,MMPM");
    const auto feed = feed_of(*written, *value * scale, per_turn, report);
    if (!feed) return std::unexpected(feed.error());
    settings.feed = *feed;
    return {};
}

Result<void> set_spindle(const Statement& statement, Settings& settings, Report& report) {
    constexpr double mm_per_foot = 304.8, mm_per_metre = 1000;
    double surface_mm = 0;  // mm in one unit of the surface speed; 0: the speed is in rpm
    bool any = false;
    for (std::size_t i = 0; i < statement.items.size(); ++i) {
        const Item& item = statement.items[i];
        if (matches(item.text, "OFF")) {
            settings.spindle_stopped = true;
        } else if (is_value_of_spindle(item.text)) {
            ++i;
        } else if (matches(item.text, "SFM")) {
            surface_mm = mm_per_foot;
        } else if (matches(item.text, "SMM")) {
            surface_mm = mm_per_metre;
        } else if (matches(item.text, "ON") || matches(item.text, "CLW")) {
            settings.spindle_stopped = false;
        } else if (matches(item.text, "CCLW")) {
            settings.spindle_stopped = false;
            if (report.first(Note::spindle_backwards)) {
                report.warn(item.line, "the spindle turns backwards (CCLW): taken as a cut all the same");
            }
        } else if (!is_word_of_spindle(item.text)) {
            const auto speed = report.number(item);
            if (!speed) return std::unexpected(speed.error());
            any = true;
            settings.spindle_rpm = *speed;
            settings.spindle_stands = *speed == 0;
            settings.spindle_stopped = false;
        }
    }
    if (!any) return {};
    if (surface_mm != 0 && settings.diameter_mm == 0) {
        return report.refuse(statement.word, "a surface speed with the cutter's diameter unknown",
                             "add CUTTER before it, or write RPM");
    }
    if (surface_mm != 0) settings.spindle_rpm *= surface_mm / (math::kPi * settings.diameter_mm);
    if (settings.spindle_rpm != 0 && !kLimits.spindle_speed.range.contains(settings.spindle_rpm)) {
        return report.refuse(statement.word, out_of_range(kLimits.spindle_speed, settings.spindle_rpm),
                             range_remedy(kLimits.spindle_speed));
    }
    return {};
}

Result<void> load_tool(const Statement& statement, Settings& settings, Report& report) {
    std::size_t place = 0;
    if (matches(statement.word.text, "LOAD")) {
        if (statement.items.empty() || !matches(statement.items.front().text, "TOOL")) {
            return report.refuse(statement.word, "LOAD of something that is not a tool",
                                 "write LOAD/TOOL, and its number");
        }
        place = 1;
    }
    if (statement.items.size() <= place) {
        return report.refuse(statement.word, "no tool number", "write LOADTL/ and the number");
    }
    const Item& item = statement.items[place];
    if (!item.text.empty() && !number_of(item.text)) {
        settings.tool = 0;
        if (report.first(Note::tool_name)) {
            report.warn(item.line,
                        quoted(item.text) + " names a tool: tools without a number count as tool 0");
        }
        return {};
    }
    const auto tool =
        number_of(item.text) == 0.0 ? Result<double>(0) : report.number(item, kLimits.tool_number);
    if (!tool) return std::unexpected(tool.error());
    if (*tool != std::floor(*tool)) {
        return report.refuse(item, "the tool number is not a whole number", "correct it");
    }
    settings.tool = static_cast<int>(*tool);
    return {};
}

void note_tool_kind(const Statement& statement, Report& report) {
    const bool turns =
        std::ranges::any_of(statement.items, [](const Item& item) { return matches(item.text, "TURN"); });
    if (turns && report.first(Note::turning)) {
        report.warn(statement.word.line, "a turning tool: its path is taken as that of a mill");
    }
}

// The seven numbers of CUTTER: diameter, corner radius, its centre from the axis and above the tip, the angle
// of the bottom to the plane normal to the axis, that of the flank to the axis, and the height.
Result<void> define_cutter(const std::array<double, 7>& value, std::size_t first, const Statement& statement,
                           Settings& settings, Report& report) {
    const auto [d, r, e, f, bottom_deg, flank_deg, height] = value;
    if (!(d > 0)) return report.refuse(statement.items[first], "a cutter without a diameter", "correct it");
    if (const double mm = d * settings.unit_mm; !kLimits.cutter_diameter.range.contains(mm)) {
        return report.refuse(statement.items[first], out_of_range(kLimits.cutter_diameter, mm),
                             range_remedy(kLimits.cutter_diameter));
    }
    if (r < 0 || 2 * r > d + kCutterTolerance) {
        return report.refuse(statement.items[first + 1], "a corner radius that does not fit the diameter",
                             "correct it");
    }
    const auto differs = [](double a, double b) { return std::abs(a - b) > kCutterTolerance; };
    const bool is_mill =
        !differs(e, 0.5 * d - r) && !differs(f, r) && !differs(bottom_deg, 0) && !differs(flank_deg, 0);
    settings.cutter = motion::DeclaredTool{0, d * settings.unit_mm, std::min(r, 0.5 * d) * settings.unit_mm,
                                           statement.word.line};
    // The angles of APT: of the bottom to the plane normal to the axis, of the flank to the axis.
    const bool is_point = !differs(r, 0) && bottom_deg > 0 && !differs(flank_deg, 0) && !differs(e, 0.5 * d);
    const bool is_cone = !differs(bottom_deg, 0) && flank_deg > 0 && height > 0;
    std::string remark;
    ToolSizes sizes{.diameter_mm = settings.cutter->diameter_mm, .corner_mm = settings.cutter->corner_mm};
    if (is_point) {
        sizes.shape = ToolShape::drill;
        sizes.point_deg = 180 - 2 * bottom_deg;
    } else if (is_cone) {
        sizes.shape = ToolShape::taper;
        sizes.taper_deg = flank_deg;
        sizes.edge_mm = height * settings.unit_mm;
    }
    const bool is_shaped = (is_point || is_cone) && set_shape(*settings.cutter, sizes, remark);
    if (!is_mill && (!is_shaped || !remark.empty()) && report.first(Note::cutter_shape)) {
        report.warn(statement.word.line,
                    std::string(statement.word.text) +
                        " describes a cone or a barrel: only its diameter and corner radius are taken");
    }
    settings.diameter_mm = settings.cutter->diameter_mm;
    return {};
}

Result<void> set_cutter(const Statement& statement, Settings& settings, Report& report) {
    // CUTTER/DISPLY, CUTTER/READ: how the cutter is shown, or a file with it.
    if (!statement.items.empty() && !number_of(statement.items[0].text) &&
        is_letter(statement.items[0].text.empty() ? ' ' : statement.items[0].text[0])) {
        if (report.first(Note::cutter_shape)) {
            report.warn(statement.word.line, "CUTTER without numbers: no cutter is taken from it");
        }
        return {};
    }
    std::array<double, 7> value{};
    const std::size_t count = statement.items.size();
    if (count < 1 || count > value.size()) {
        return report.refuse(statement.word, "CUTTER with " + std::to_string(count) + " numbers",
                             "write CUTTER/diameter,corner radius");
    }
    for (std::size_t i = 0; i < count; ++i) {
        const auto read = report.number(statement.items[i], kLimits.coordinate);
        if (!read) return std::unexpected(read.error());
        value[i] = *read;
    }
    if (count < 3) value[2] = 0.5 * value[0] - value[1];
    if (count < 4) value[3] = value[1];
    return define_cutter(value, 0, statement, settings, report);
}

Result<void> set_tool_data(const Statement& statement, Settings& settings, Report& report) {
    settings.is_nx = true;
    const auto& items = statement.items;
    const auto first =
        std::ranges::find_if(items, [](const Item& item) { return number_of(item.text).has_value(); });
    const std::size_t at = static_cast<std::size_t>(first - items.begin());
    if (at == 0 || first == items.end()) {
        return report.refuse(statement.word, "TLDATA without a kind and a diameter",
                             "write TLDATA/MILL, diameter and corner radius");
    }
    // Diameter, corner radius, length; of mills the angles of side and tip, of drills that of the point.
    std::array<double, 5> value{};
    for (std::size_t i = 0; i < value.size() && at + i < items.size(); ++i) {
        if (!number_of(items[at + i].text)) break;
        const auto read = report.number(items[at + i], kLimits.coordinate);
        if (!read) return std::unexpected(read.error());
        value[i] = *read;
    }
    const bool is_mill = matches(items[0].text, "MILL"), is_drill = matches(items[0].text, "DRILL");
    if (!is_mill && !is_drill && report.first(Note::cutter_shape)) {
        report.warn(statement.word.line,
                    "TLDATA describes another tool than a mill or a drill: only its diameter is taken");
    }
    const double diameter = value[0], corner = is_mill ? value[1] : 0;
    std::array<double, 7> cutter{diameter, corner, 0.5 * diameter - corner, corner, 0, 0, value[2]};
    if (is_mill) {
        cutter[4] = value[4];
        cutter[5] = value[3];
    } else if (is_drill && value[3] > 0) {
        cutter[4] = 90 - value[3] / 2;
    }
    return define_cutter(cutter, at, statement, settings, report);
}

}  // namespace tribo::readers::apt
