// SPDX-License-Identifier: MIT
#include "readers/apt/circles/circle.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::apt {
namespace {

// Ends closer than this count as one point, mm.
constexpr double kSamePointMm = 1e-6;
// Largest difference between a stated turn and the turn of the points.
constexpr double kTurnToleranceRad = 0.02;
constexpr double kMostTurns = 10'000;
constexpr std::size_t kItemsOfNx = 11;

constexpr const char* kCorrect = "correct the circle or its points";

double distance_from_axis(const Circle& circle, Vec3 p) {
    const Vec3 from_centre = p - circle.centre_mm;
    return length(from_centre - dot(from_centre, circle.normal) * circle.normal);
}

// Returns the index of the first item equal to the word; the number of items if there is none.
std::size_t find_word(const Statement& statement, std::string_view word) {
    std::size_t i = 0;
    while (i < statement.items.size() && !matches(statement.items[i].text, word)) ++i;
    return i;
}

std::unexpected<Error> refuse_form(const Statement& statement, const Report& report) {
    return report.refuse(statement.word, quoted(statement.word.text) + " without centre, axis and radius",
                         "write x,y,z,i,j,k,r");
}

Result<void> read_rest(const Statement& statement, std::size_t from, Circle& circle, const Report& report) {
    for (std::size_t i = from; i < statement.items.size(); ++i) {
        const Item& item = statement.items[i];
        const bool angle = matches(item.text, "ANGLE"), times = matches(item.text, "TIMES");
        // NX appends tolerances and the shape of the tool, as numbers and single letters.
        if (!angle && !times) {
            if (item.text.size() == 1 || number_of(item.text)) continue;
            return report.refuse(item, quoted(item.text) + " is not known here", "delete it");
        }
        if (++i == statement.items.size()) return report.refuse(item, "a number is missing", "write it");
        const auto value = report.number(
            statement.items[i], Range{angle ? -360 * kMostTurns : 1, angle ? 360 * kMostTurns : kMostTurns});
        if (!value) return std::unexpected(value.error());
        if (angle) circle.turn_rad = *value * math::kRadPerDeg;
        if (times) circle.more_turns = std::floor(*value) - 1;
    }
    return {};
}

}  // namespace

Result<Circle> read_circle(const Statement& statement, Path& path, Report& report) {
    const std::size_t count = statement.items.size();
    std::size_t centre = 0, axis = 3, radius = 6, rest = 7;
    if (find_word(statement, "CENTER") < count) {
        centre = find_word(statement, "CENTER") + 1;
        axis = find_word(statement, "AXIS") + 1;
        radius = find_word(statement, "RADIUS") + 1;
        rest = std::max({centre + 3, axis + 3, radius + 1});
    }
    // Without a radius the circle leads through the place of the tool.
    const bool is_through_tool = count == 6 && path.place();
    if (centre + 3 > count || axis + 3 > count || (radius + 1 > count && !is_through_tool))
        return refuse_form(statement, report);
    Circle circle;
    circle.at = statement.word;
    const auto point = path.read_point(statement, centre);
    if (!point) return std::unexpected(point.error());
    const auto direction = path.read_direction(statement, axis);
    if (!direction) return std::unexpected(direction.error());
    const Frame& frame = path.frames.to_program();
    circle.centre_mm = frame.point(*point);
    circle.normal = normalized(frame.turn(*direction));
    // NX turns the other way, as its arcs between tangent lines show.
    if (path.settings.is_nx && count >= kItemsOfNx) circle.normal = -circle.normal;
    if (is_through_tool) {
        circle.radius_mm = distance_from_axis(circle, path.place()->tip_mm);
    } else {
        const auto r = report.number(statement.items[radius], lengths(path.settings.unit_mm));
        if (!r) return std::unexpected(r.error());
        circle.radius_mm = *r * path.settings.unit_mm;
    }
    if (circle.radius_mm <= kOnCircleMm) {
        return report.refuse(is_through_tool ? statement.word : statement.items[radius],
                             "a circle without a radius", kCorrect);
    }
    if (auto ok = read_rest(statement, rest, circle, report); !ok) return std::unexpected(ok.error());
    return circle;
}

bool is_on(const Circle& circle, Vec3 tip_mm) {
    return std::abs(distance_from_axis(circle, tip_mm) - circle.radius_mm) <= kOnCircleMm;
}

Result<motion::Arc> arc_to(const Circle& circle, Vec3 start_mm, Vec3 end_mm, const Item& at,
                           const Report& report) {
    for (const bool is_end : {false, true}) {
        const Vec3 p = is_end ? end_mm : start_mm;
        if (is_on(circle, p)) continue;
        return report.refuse(at,
                             std::string("the tool ") + (is_end ? "ends " : "starts ") +
                                 mm_text(distance_from_axis(circle, p)) +
                                 " from the axis of its circle of radius " + mm_text(circle.radius_mm),
                             kCorrect);
    }
    const Vec3 n = circle.normal;
    const Vec3 a = start_mm - circle.centre_mm, b = end_mm - circle.centre_mm;
    const Vec3 from = a - dot(a, n) * n, to = b - dot(b, n) * n;
    double turn = distance(from, to) <= kSamePointMm ? math::kTwoPi
                                                     : math::atan2(dot(n, cross(from, to)), dot(from, to));
    if (turn <= 0) turn += math::kTwoPi;
    if (circle.turn_rad) {
        const double stated = std::abs(*circle.turn_rad), other = math::kTwoPi - turn;
        const auto fits = [&](double base) {
            const double turns = std::round((stated - base) / math::kTwoPi);
            return turns >= 0 && std::abs(stated - base - turns * math::kTwoPi) <= kTurnToleranceRad;
        };
        const auto whole = [&](double base) {
            return base + math::kTwoPi * std::round((stated - base) / math::kTwoPi);
        };
        const bool forward = fits(turn), backward = fits(other);
        if (!forward && !backward) {
            return report.refuse(circle.at,
                                 "the circle states a turn of " + short_decimal(stated * math::kDegPerRad) +
                                     " degrees where its points make " +
                                     short_decimal(turn * math::kDegPerRad),
                                 kCorrect);
        }
        turn = forward ? whole(turn) : -whole(other);
    }
    turn += (turn < 0 ? -1 : 1) * circle.more_turns * math::kTwoPi;
    return motion::Arc{circle.centre_mm, turn < 0 ? -n : n, std::abs(turn)};
}

}  // namespace tribo::readers::apt
