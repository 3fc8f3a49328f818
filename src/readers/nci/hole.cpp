// SPDX-License-Identifier: MIT
#include "readers/nci/hole.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "base/math.hpp"

namespace tribo::readers::nci {
namespace {

using apt::Cycle;

// The heights of an upright hole and its points may differ by this much, mm: the rounding of three decimals
// of an inch.
constexpr double kSameHeightMm = 0.03;
constexpr double kMostPecks = 10'000;

// Drill, peck, chip break, tap, bore 1 (out at feed), bore 2 (out at rapid), fine bore, in the order of the
// operation's list. Those after them are the post's own.
constexpr std::array kWays{Cycle::Way::through, Cycle::Way::peck,    Cycle::Way::chip,   Cycle::Way::bore,
                           Cycle::Way::bore,    Cycle::Way::through, Cycle::Way::through};

// Where the values of a place stand in a record.
struct Places {
    std::size_t bottom, start_height, feed_height, dwell, feed, start, exchanged;
};
constexpr Places kFirst{1, 10, 11, 4, 5, 14, 18}, kNext{1, 4, 5, 6, 7, 8, 12};

Result<void> read_place(const apt::Statement& record, const Places& places, Hole& hole, const apt::Path& path,
                        apt::Report& report) {
    const auto& items = record.items;
    auto bottom = path.read_point(record, places.bottom), start = path.read_point(record, places.start);
    if (!bottom) return std::unexpected(bottom.error());
    if (!start) return std::unexpected(start.error());
    if (items.size() > places.exchanged && items[places.exchanged].text == "1") std::swap(*bottom, *start);
    std::array<double, 2> height{};  // of the start, of the place where the feed begins
    for (std::size_t i = 0; i < 2; ++i) {
        const auto read = report.number(items[i == 0 ? places.start_height : places.feed_height],
                                        kLimits.coordinate, path.settings.unit_mm);
        if (!read) return std::unexpected(read.error());
        height[i] = *read * path.settings.unit_mm;
    }
    const Vec3 up = *start - *bottom;
    const double whole = length(up), rapid = height[0] - height[1];
    if (whole < kSameHeightMm || rapid < 0 || rapid >= whole)
        return report.refuse(record.word, "a hole whose feed does not begin between its start and its bottom",
                             "correct its heights, or let Mastercam write the hole as lines");
    const bool is_upright = math::hypot(up.x, up.y) <= kSameHeightMm && up.z > 0;
    if (is_upright && std::abs(start->z - height[0]) > kSameHeightMm)
        return report.refuse(record.word, "the height of the start is not that of its point",
                             "let Mastercam write the hole as lines");
    const Vec3 axis = normalized(up);
    hole.point = {*start - rapid * axis, axis};
    hole.cycle.clearance_mm = 0;
    hole.cycle.retract_mm = rapid;
    hole.cycle.depth_mm = whole - rapid;
    const auto dwell = report.number(items[places.dwell], kLimits.dwell);
    if (!dwell) return std::unexpected(dwell.error());
    hole.cycle.dwell_s = *dwell;
    const auto value = report.number(items[places.feed]);
    if (!value) return std::unexpected(value.error());
    if (*value <= 0) return {};
    const auto feed = apt::feed_of(items[places.feed], *value * path.settings.unit_mm, false, report);
    if (!feed) return std::unexpected(feed.error());
    hole.cycle.feed = *feed;
    return {};
}

// The pecks and the way back that breaks a chip.
Result<void> read_pecks(const apt::Statement& record, Cycle& cycle, const apt::Path& path,
                        apt::Report& report) {
    const double unit_mm = path.settings.unit_mm;
    const std::array<std::pair<std::size_t, double*>, 3> values{
        {{6, &cycle.first_peck_mm}, {7, &cycle.peck_mm}, {9, &cycle.chip_mm}}};
    for (const auto& [place, value] : values) {
        const auto read = report.number(record.items[place], apt::lengths(unit_mm));
        if (!read) return std::unexpected(read.error());
        *value = *read * unit_mm;
    }
    if (cycle.first_peck_mm == 0) cycle.first_peck_mm = cycle.peck_mm;
    if (cycle.peck_mm == 0) cycle.peck_mm = cycle.first_peck_mm;
    if (cycle.peck_mm > 0) return {};
    report.warn(record.word.line, "a cycle with pecks that states none: the hole is made in one go");
    cycle.way = Cycle::Way::through;
    return {};
}

Result<void> check_pecks(const apt::Statement& record, const Cycle& cycle, const apt::Report& report) {
    if (cycle.peck_mm == 0 || cycle.depth_mm / cycle.peck_mm <= kMostPecks) return {};
    return report.refuse(record.word, "more than 10000 pecks for one hole", "correct the peck");
}

}  // namespace

Result<Hole> read_hole(const apt::Statement& record, const apt::Path& path, apt::Report& report) {
    const auto kind = report.number(record.items[0]);
    if (!kind) return std::unexpected(kind.error());
    if (!(*kind >= 0 && *kind < static_cast<double>(kWays.size())) || *kind != std::floor(*kind))
        return report.refuse(
            record.items[0],
            "a cycle of its own (" + apt::quoted(record.items[0].text) + "): the post says how it moves",
            "let Mastercam write the hole as lines");
    Hole hole;
    hole.cycle.at = record.word;
    hole.cycle.way = kWays[static_cast<std::size_t>(*kind)];
    if (hole.cycle.way == Cycle::Way::peck || hole.cycle.way == Cycle::Way::chip) {
        if (auto ok = read_pecks(record, hole.cycle, path, report); !ok) return std::unexpected(ok.error());
    }
    if (auto ok = read_place(record, kFirst, hole, path, report); !ok) return std::unexpected(ok.error());
    if (auto ok = check_pecks(record, hole.cycle, report); !ok) return std::unexpected(ok.error());
    return hole;
}

Result<void> read_next_hole(const apt::Statement& record, Hole& hole, const apt::Path& path,
                            apt::Report& report) {
    if (auto ok = read_place(record, kNext, hole, path, report); !ok) return ok;
    return check_pecks(record, hole.cycle, report);
}

Result<void> drill(const Hole& hole, const apt::Item& at, apt::Path& path, apt::Report& report) {
    return apt::drill(hole.cycle, hole.point, at, path, report);
}

}  // namespace tribo::readers::nci
