// SPDX-License-Identifier: MIT
#include "readers/apt/circles/catia_circle.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "base/math.hpp"

namespace tribo::readers::apt {
namespace {

// Cosine of the largest angle between directions that count as one.
constexpr double kAligned = 0.99;
// Least part of the direction at the start that leads along the circle.
constexpr double kLeastAlong = 0.1;
// A start on the plane of the end is not the end, rad.
constexpr double kShortestTurnRad = 1e-6;

// (CIRCLE/x,y,z,r): its word and its numbers.
struct Geometry {
    std::string_view word;
    Statement numbers;
};

struct Geometries {
    std::vector<Geometry> list;
    int crossing = 1;  // of ON,n,INTOF
};

std::unexpected<Error> refuse_catia_form(const Statement& statement, const Report& report) {
    return report.refuse(statement.word, "a circle of CATIA in a form that is not known",
                         "write TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z)");
}

// Takes brackets and geometry words off the items.
Result<Geometries> geometries(const Statement& statement, const Report& report) {
    Geometries out;
    bool inside = false;
    for (Item item : statement.items) {
        if (const std::size_t slash = item.text.find('/'); slash != std::string_view::npos) {
            std::string_view word = trimmed(item.text.substr(0, slash));
            if (word.starts_with('(')) word = trimmed(word.substr(1));
            const std::string_view first = trimmed(item.text.substr(slash + 1));
            item.column += static_cast<int>(first.data() - item.text.data());
            item.text = first;
            out.list.push_back({word, {}});
            out.list.back().numbers.word = statement.word;
            inside = true;
        }
        bool closes = false;
        while (item.text.ends_with(')')) {
            closes = true;
            item.text = trimmed(item.text.substr(0, item.text.size() - 1));
        }
        const bool joins = matches(item.text, "ON") || matches(item.text, "INTOF");
        if (joins) {
            inside = false;
        } else if (inside) {
            if (!matches(item.text, "CANON")) out.list.back().numbers.items.push_back(item);
        } else if (matches(item.text, "1") || matches(item.text, "2")) {
            out.crossing = item.text[0] - '0';
        } else {
            return refuse_catia_form(statement, report);
        }
        if (closes) inside = false;
    }
    return out;
}

// The circle without its axis; `axis` where it is written.
Result<Circle> read_base(const Geometry& from, std::optional<Vec3>& axis, const Path& path, Report& report) {
    const std::size_t count = from.numbers.items.size();
    const bool is_cylinder = matches(from.word, "CYLNDR");
    if ((!is_cylinder && !matches(from.word, "CIRCLE")) || (count != 7 && (is_cylinder || count != 4)))
        return refuse_catia_form(from.numbers, report);
    const auto centre = path.read_point(from.numbers, 0);
    if (!centre) return std::unexpected(centre.error());
    const Item& last = from.numbers.items.back();
    const auto radius = report.number(last, lengths(path.settings.unit_mm));
    if (!radius) return std::unexpected(radius.error());
    const Frame& frame = path.frames.to_program();
    if (count == 7) {
        const auto direction = path.read_direction(from.numbers, 3);
        if (!direction) return std::unexpected(direction.error());
        axis = frame.turn(*direction);
    }
    Circle circle;
    circle.at = from.numbers.word;
    circle.centre_mm = frame.point(*centre);
    circle.radius_mm = *radius * path.settings.unit_mm;
    if (circle.radius_mm <= kOnCircleMm)
        return report.refuse(last, "a circle without a radius", "correct the circle or its points");
    return circle;
}

// The n-th point of the circle, from its start on, where normal . p = distance.
Result<Vec3> crossing(const Circle& circle, Vec3 start_mm, Vec3 normal, double distance_mm, int n,
                      const Report& report) {
    const Vec3 from = start_mm - circle.centre_mm;
    const double height = dot(from, circle.normal);
    const Vec3 u = from - height * circle.normal, v = cross(circle.normal, u);
    const double a = dot(normal, u), b = dot(normal, v), reach = math::hypot(a, b);
    const double rest = distance_mm - dot(normal, circle.centre_mm + height * circle.normal);
    if (!(std::abs(rest) <= reach) || reach < kOnCircleMm * 1e-3)
        return report.refuse(circle.at, "the plane at the end does not cross the circle",
                             "correct the circle or the plane");
    const double middle = math::atan2(b, a), half = math::acos(rest / reach);
    double near = middle - half, far = middle + half;
    for (double* turn : {&near, &far}) {
        while (*turn <= kShortestTurnRad) *turn += math::kTwoPi;
        while (*turn > math::kTwoPi + kShortestTurnRad) *turn -= math::kTwoPi;
    }
    if (near > far) std::swap(near, far);
    const double turn = n == 1 ? near : far;
    return circle.centre_mm + height * circle.normal + math::cos(turn) * u + math::sin(turn) * v;
}

Result<Vec3> read_end(const Geometry& from, const Circle& circle, int n, const Path& path, Report& report) {
    const auto& items = from.numbers.items;
    const Frame& frame = path.frames.to_program();
    const bool is_line = matches(from.word, "LINE") && items.size() == 6;
    if (is_line || (matches(from.word, "POINT") && items.size() == 3)) {
        const auto end = path.read_point(from.numbers, is_line ? 3 : 0);
        if (!end) return std::unexpected(end.error());
        return frame.point(*end);
    }
    if (!matches(from.word, "PLANE") || items.size() != 4) return refuse_catia_form(from.numbers, report);
    const auto direction = path.read_direction(from.numbers, 0);
    if (!direction) return std::unexpected(direction.error());
    const auto distance = report.number(items[3], kLimits.coordinate, path.settings.unit_mm);
    if (!distance) return std::unexpected(distance.error());
    const Vec3 normal = frame.turn(*direction);
    return crossing(circle, path.place()->tip_mm, normal,
                    *distance * path.settings.unit_mm + dot(normal, frame.origin_mm), n, report);
}

}  // namespace

Result<CatiaCircle> read_catia_circle(const Statement& statement, Vec3 forward,
                                      const std::optional<Vec3>& surface, const Path& path, Report& report) {
    const auto parts = geometries(statement, report);
    if (!parts) return std::unexpected(parts.error());
    if (parts->list.size() != 2) return refuse_catia_form(statement, report);
    std::optional<Vec3> axis;
    const auto base = read_base(parts->list[0], axis, path, report);
    if (!base) return std::unexpected(base.error());
    CatiaCircle out{*base, {}};
    const Vec3 start = path.place()->tip_mm, from = start - base->centre_mm;
    const Vec3 about = normalized(cross(from, forward), Vec3{});
    const Vec3 tool = path.place()->axis;
    if (!axis) axis = surface;
    if (!axis) axis = std::abs(dot(about, tool)) >= kAligned ? tool : about;
    // The arc leaves the start along `forward`, in either direction about its axis.
    const Vec3 radial = normalized(from - dot(from, *axis) * *axis, Vec3{});
    const double along = dot(cross(*axis, radial), forward);
    if (std::abs(along) < kLeastAlong) {
        return report.refuse(statement.word, "INDIRV does not lead along the circle about its axis",
                             "let the CAM system write CIRCLE or straight moves");
    }
    out.circle.normal = along > 0 ? *axis : -*axis;
    const auto end = read_end(parts->list[1], out.circle, parts->crossing, path, report);
    if (!end) return std::unexpected(end.error());
    out.end_mm = *end;
    return out;
}

Result<Vec3> read_plane_normal(const Statement& statement, const Path& path, Report& report) {
    const auto parts = geometries(statement, report);
    if (!parts) return std::unexpected(parts.error());
    if (parts->list.size() != 1 || !matches(parts->list[0].word, "PLANE") ||
        parts->list[0].numbers.items.size() != 4) {
        return report.refuse(statement.word, "PSIS with a surface that is not written as a plane",
                             "let the CAM system write the path as GOTO with tool axes");
    }
    return path.read_direction(parts->list[0].numbers, 0);
}

}  // namespace tribo::readers::apt
