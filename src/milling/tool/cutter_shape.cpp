// SPDX-License-Identifier: MIT
#include "milling/tool/cutter_shape.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "milling/tool/convex_zones.hpp"
#include "milling/tool/turned_profile.hpp"

namespace tribo::milling {
namespace {

const double kUsualLengthMm = Cutter().length_mm;
// A normal may hang back, or a height fall, by this much: it is rounding of a drawing.
constexpr double kSlack = 1e-6;
// Of a length that follows from others, in a message.
constexpr int kShownDigits = 6;

std::unexpected<Error> refuse_shape(std::string_view key, const std::string& cause,
                                    const std::string& remedy) {
    return fail("cutter " + std::string(key) + " " + cause, remedy);
}

std::string_view word(const Cutter& c) {
    return kCutterKindWords[static_cast<std::size_t>(c.kind)];
}

Result<void> require(const Cutter& c, std::string_view key, double value, const char* example) {
    if (value > 0) return {};
    return refuse_shape(key, "of a " + std::string(word(c)) + " is missing",
                        "add " + std::string(key) + " = " + example);
}

// Returns the bulge of the arc over which the normal turns from a to b, by less than half a turn.
double bulge_between(PlanePoint a, PlanePoint b) {
    const double half = cross(a, b) / (1 + dot(a, b));  // tan(angle / 2)
    return half / (1 + std::sqrt(1 + half * half));
}

PlanePoint normal_of_cone(double angle_rad) {
    double sine, cosine;
    math::sincos(angle_rad, sine, cosine);
    return {cosine, -sine};
}

constexpr PlanePoint kDown{0, -1};

void add(Cutter& c, PlanePoint at, double bulge = 0) {
    c.profile.push_back({at.r, at.z, bulge});
}

// A tip of diameter tip_mm rounded with corner_mm, and a cone of this half angle up to the diameter.
Result<void> make_cone(Cutter& c, double angle_rad) {
    const PlanePoint normal = normal_of_cone(angle_rad);
    const double slope = -normal.z / normal.r;  // dr / dz
    const double corner = c.corner_mm;
    if (c.tip_mm == 0 && c.kind == CutterKind::taper) {
        // The cone ends at length_mm with the diameter.
        const double length = c.length_mm > 0 ? c.length_mm : kUsualLengthMm;
        const double centre = c.radius_mm() - corner * normal.r - (length - corner * (1 + normal.z)) * slope;
        if (!(centre >= 0))
            return refuse_shape("taper_deg",
                                "is too steep: " + format_digits(length, kShownDigits) +
                                    " mm below its diameter of " + plain_number(c.diameter_mm) +
                                    " mm nothing is left of the tip",
                                "give tip_mm, the diameter of the tip, or a shorter length_mm");
        c.tip_mm = 2 * (centre + corner);
    }
    if (c.tip_mm == 0) c.tip_mm = 2 * corner;
    const double centre = 0.5 * c.tip_mm - corner;
    if (!(centre >= 0))
        return refuse_shape(
            "corner_mm", "is larger than half of the tip of " + format_digits(c.tip_mm, kShownDigits) + " mm",
            "half of tip_mm makes a ball");
    const PlanePoint cone{centre + corner * normal.r, corner * (1 + normal.z)};
    if (!(c.tip_mm < c.diameter_mm && cone.r < c.radius_mm()))
        return refuse_shape("tip_mm",
                            "of " + format_digits(c.tip_mm, kShownDigits) +
                                " mm leaves no cone below a diameter of " + plain_number(c.diameter_mm) +
                                " mm",
                            "diameter_mm is the largest diameter that cuts, tip_mm that of the tip");
    add(c, {centre, 0}, corner > 0 ? bulge_between(kDown, normal) : 0);
    if (corner > 0) add(c, cone);
    const double top = cone.z + (c.radius_mm() - cone.r) / slope;
    if (c.length_mm == 0) c.length_mm = std::max(kUsualLengthMm, top);
    if (top > c.length_mm * (1 + kSlack))
        return refuse_shape("length_mm",
                            "ends below the diameter: the cone is " + plain_number(c.diameter_mm) +
                                " mm wide only " + format_digits(top, kShownDigits) + " mm above the tip",
                            "give length_mm of the whole edge, or the diameter_mm that it really ends with");
    add(c, {c.radius_mm(), std::min(top, c.length_mm)});
    return {};
}

Result<void> make_dovetail(Cutter& c) {
    if (auto done = require(c, "taper_deg", c.taper_deg, "30, the angle of its side to the axis"); !done)
        return done;
    if (auto done = require(c, "height_mm", c.height_mm, "4, the height of its edges"); !done) return done;
    const PlanePoint up = normal_of_cone(c.taper_deg * math::kRadPerDeg), normal{up.r, -up.z};
    const double corner = c.corner_mm, centre = c.radius_mm() - corner;
    if (!(centre >= 0))
        return refuse_shape("corner_mm", "is larger than the radius", "give the radius of its corner");
    const PlanePoint cone{centre + corner * normal.r, corner * (1 + normal.z)};
    const double top = cone.r - (c.height_mm - cone.z) * normal.z / normal.r;
    if (!(c.height_mm > cone.z && top > 0))
        return refuse_shape("height_mm",
                            "does not fit the angle: the side would end at a radius of " +
                                format_digits(top, kShownDigits) + " mm",
                            "a dovetail narrows to its neck: give a lower height_mm or a smaller taper_deg");
    add(c, {centre, 0}, corner > 0 ? bulge_between(kDown, normal) : 0);
    if (corner > 0) add(c, cone);
    add(c, {top, c.height_mm});
    return {};
}

Result<void> make_lens(Cutter& c) {
    if (auto done = require(c, "side_mm", c.side_mm, "20, the radius of its bottom"); !done) return done;
    const double corner = c.corner_mm, inner = c.radius_mm() - corner, arc = c.side_mm - corner;
    if (!(inner >= 0 && arc > inner))
        return refuse_shape("side_mm",
                            "of a lens must be more than half of its diameter, and its corner less",
                            "give the radius of the arc about the axis");
    const PlanePoint centre{inner, c.side_mm - std::sqrt(arc * arc - inner * inner)};  // of the corner
    const PlanePoint normal = (1 / arc) * (centre - PlanePoint{0, c.side_mm});
    add(c, {0, 0}, bulge_between(kDown, normal));
    add(c, centre + corner * normal, corner > 0 ? bulge_between(normal, {1, 0}) : 0);
    if (corner > 0) add(c, {c.radius_mm(), centre.z});
    return {};
}

Result<void> make_barrel(Cutter& c) {
    if (auto done = require(c, "side_mm", c.side_mm, "50, the radius of its side"); !done) return done;
    if (c.length_mm == 0) c.length_mm = kUsualLengthMm;
    if (c.height_mm == 0) c.height_mm = 0.5 * c.length_mm;
    const double corner = c.corner_mm, side = c.side_mm, above = c.length_mm - c.height_mm;
    if (!(above >= 0))
        return refuse_shape("height_mm", "is above the end of the edges",
                            "give the height of the largest diameter");
    const PlanePoint centre{c.radius_mm() - side, c.height_mm};  // of the side
    // The corner touches the side's circle from within.
    const double reach = side - corner, low = corner - c.height_mm;
    const double bottom = reach > 0 ? centre.r + std::sqrt(std::max(reach * reach - low * low, 0.0)) : -1;
    const double top = centre.r + std::sqrt(std::max(side * side - above * above, 0.0));
    if (!(reach > std::abs(low) && low <= 0 && bottom >= 0 && side >= above && top > 0))
        return refuse_shape("side_mm", "of the barrel does not reach from the bottom to the end of its edges",
                            "give a larger side_mm, a shorter length_mm, or a smaller corner_mm");
    const PlanePoint normal = (1 / reach) * (PlanePoint{bottom, corner} - centre);
    const PlanePoint end = (1 / side) * (PlanePoint{top, c.length_mm} - centre);
    add(c, {bottom, 0}, corner > 0 ? bulge_between(kDown, normal) : bulge_between(normal, end));
    if (corner > 0) add(c, PlanePoint{bottom, corner} + corner * normal, bulge_between(normal, end));
    add(c, {top, c.length_mm});
    return {};
}

Result<void> require_neck(const Cutter& c) {
    if (auto done = require(c, "neck_mm", c.neck_mm, "3, the diameter at which its edges end"); !done)
        return done;
    if (c.neck_mm < c.diameter_mm) return {};
    return refuse_shape("neck_mm", "is not below the diameter",
                        "give the diameter of the neck above the edges");
}

Result<void> make_lollipop(Cutter& c) {
    if (auto done = require_neck(c); !done) return done;
    const double radius = c.radius_mm(), neck = 0.5 * c.neck_mm;
    const PlanePoint normal = (1 / radius) * PlanePoint{neck, std::sqrt(radius * radius - neck * neck)};
    add(c, {0, 0}, bulge_between(kDown, normal));
    add(c, {neck, radius * (1 + normal.z)});
    return {};
}

Result<void> make_thread(Cutter& c) {
    if (auto done = require_neck(c); !done) return done;
    const double neck = 0.5 * c.neck_mm;
    const double flank = (c.radius_mm() - neck) * math::tan(0.5 * c.point_deg * math::kRadPerDeg);
    add(c, {neck, 0});
    add(c, {c.radius_mm(), flank});
    if (c.tip_mm > 0) add(c, {c.radius_mm(), flank + c.tip_mm});
    add(c, {neck, 2 * flank + c.tip_mm});
    if (c.core_mm == 0) c.core_mm = c.neck_mm;
    return {};
}

Result<void> make_vertices(Cutter& c) {
    const double half_rad = 0.5 * c.point_deg * math::kRadPerDeg;
    switch (c.kind) {
        case CutterKind::taper:
            if (auto done = require(c, "taper_deg", c.taper_deg, "3, the angle of its side to the axis");
                !done)
                return done;
            return make_cone(c, c.taper_deg * math::kRadPerDeg);
        case CutterKind::v:
        case CutterKind::engraver:
            if (auto done = require(c, "point_deg", c.point_deg, "60, the full angle of its point"); !done)
                return done;
            return make_cone(c, half_rad);
        case CutterKind::drill:
        case CutterKind::chamfer:
        case CutterKind::countersink:
            return make_cone(c, half_rad);
        case CutterKind::dovetail:
            return make_dovetail(c);
        case CutterKind::lens:
            return make_lens(c);
        case CutterKind::barrel:
            return make_barrel(c);
        case CutterKind::lollipop:
            return make_lollipop(c);
        case CutterKind::thread:
            return make_thread(c);
        default:
            return {};
    }
}

// Sizes of kinds that need no key for them.
void fill_usual(Cutter& c) {
    if (c.point_deg != 0) return;
    if (c.kind == CutterKind::drill) c.point_deg = 118;
    if (c.kind == CutterKind::chamfer || c.kind == CutterKind::countersink) c.point_deg = 90;
    if (c.kind == CutterKind::thread) c.point_deg = 60;
}

Result<void> check_sizes(const Cutter& c) {
    const auto check_one = [&](std::string_view key, double value, const Limit& limit) -> Result<void> {
        if (value == 0 || limit.range.contains(value)) return {};
        return refuse_shape(key, "is " + plain_number(value), range_remedy(limit));
    };
    for (const ShapeKey& key : kShapeKeys)
        if (auto done = check_one(key.name, c.*key.value, key.limit); !done) return done;
    if (auto done = check_one("length_mm", c.length_mm, kLimits.cutting_length); !done) return done;
    if (!kLimits.cutter_diameter.range.contains(c.diameter_mm))
        return refuse_shape("diameter_mm", "is " + plain_number(c.diameter_mm),
                            range_remedy(kLimits.cutter_diameter));
    return {};
}

std::unexpected<Error> refuse_vertex(std::size_t n, const std::string& cause, const std::string& remedy) {
    return refuse_shape("profile", "has a vertex " + std::to_string(n + 1) + " " + cause, remedy);
}

}  // namespace

bool is_shape_key(CutterKind kind, std::string_view key) {
    using enum CutterKind;
    const auto one_of = [&](std::initializer_list<CutterKind> kinds) {
        return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    };
    if (key == "corner_mm") return one_of({bull, taper, v, engraver, dovetail, lens, barrel});
    if (key == "tip_mm") return one_of({taper, v, engraver, chamfer, countersink, thread});
    if (key == "point_deg") return one_of({v, engraver, drill, chamfer, countersink, thread});
    if (key == "taper_deg") return one_of({taper, dovetail});
    if (key == "side_mm") return one_of({lens, barrel});
    if (key == "height_mm") return one_of({dovetail, barrel});
    if (key == "neck_mm") return one_of({lollipop, thread});
    return false;
}

bool has_own_length(CutterKind kind) {
    return kind == CutterKind::dovetail || kind == CutterKind::lollipop || kind == CutterKind::thread;
}

double usual_helix_deg(CutterKind kind) {
    switch (kind) {
        case CutterKind::v:
        case CutterKind::chamfer:
        case CutterKind::countersink:
        case CutterKind::dovetail:
        case CutterKind::thread:
        case CutterKind::engraver:
            return 0;
        default:
            return Cutter{}.helix_deg;
    }
}

Result<void> make_profile(Cutter& c) {
    if (!c.has_profile()) return {};
    if (c.kind == CutterKind::profile) {
        if (c.length_mm == 0 && !c.profile.empty()) c.length_mm = c.profile.back().z_mm;
        if (auto done = check_profile(c); !done) return done;
        c.diameter_mm = 2 * largest_radius_mm(profile_elements(c));
        c.zones = std::make_shared<const ConvexZones>(c);
        return {};
    }
    c.profile.clear();
    fill_usual(c);
    if (auto done = check_sizes(c); !done) return done;
    if (auto done = make_vertices(c); !done) return done;
    if (has_own_length(c.kind)) c.length_mm = c.profile.back().z_mm;
    if (c.length_mm == 0) c.length_mm = std::max(kUsualLengthMm, c.profile.back().z_mm);
    if (auto done = check_profile(c); !done) return done;
    c.zones = std::make_shared<const ConvexZones>(c);
    return {};
}

Result<void> check_profile(const Cutter& c) {
    const auto& vertices = c.profile;
    if (vertices.empty())
        return refuse_shape("profile", "is missing",
                            c.kind == CutterKind::profile
                                ? "add profile = [[r, z, bulge], ...], from the tip out and up"
                                : "make_profile() makes it from the sizes of the kind");
    if (vertices.size() > kMostVertices)
        return refuse_shape("profile",
                            "has " + std::to_string(vertices.size()) + " vertices, more than " +
                                std::to_string(kMostVertices),
                            "join lines that differ little, and write rounded parts as arcs, with a bulge");
    for (std::size_t n = 0; n < vertices.size(); ++n) {
        const ProfileVertex& v = vertices[n];
        if (v.r_mm < 0)
            return refuse_vertex(n, "at a negative radius", "r is the distance from the axis, 0 or more");
        for (const auto& [value, limit] :
             {std::pair<double, const Limit&>{v.r_mm, kLimits.profile_coordinate},
              {v.z_mm, kLimits.profile_coordinate},
              {v.bulge, kLimits.bulge}}) {
            if (!limit.range.contains(value))
                return refuse_vertex(n,
                                     "with a " + std::string(limit.quantity) + " of " + plain_number(value),
                                     range_remedy(limit));
        }
        if (n == 0 && v.z_mm != 0)
            return refuse_vertex(n, "at z = " + plain_number(v.z_mm), "begin at the tip, z = 0");
        if (n > 0 && v.z_mm < vertices[n - 1].z_mm)
            return refuse_vertex(
                n, "below the one before it",
                "go from the tip up: a hollow bottom is drawn flat, with core_mm for its middle");
        if (n > 0 && std::abs(v.z_mm - vertices[n - 1].z_mm) < kSlack &&
            std::abs(v.r_mm - vertices[n - 1].r_mm) < kSlack)
            return refuse_vertex(n, "at the place of the one before it", "remove one of them");
    }
    if (!(vertices.back().r_mm > kSlack))
        return refuse_vertex(vertices.size() - 1, "on the axis",
                             "end the profile at the neck or shank that carries it");
    if (vertices.size() == 1 && !(c.length_mm > 0))
        return refuse_shape("profile", "has one vertex and no height",
                            "add the vertex at which the edges end");
    if (c.length_mm < vertices.back().z_mm)
        return refuse_shape(
            "length_mm",
            "ends below the profile's last vertex at " + plain_number(vertices.back().z_mm) + " mm",
            "leave length_mm out, or give the end of the cutting edges");
    const std::vector<ProfileElement> elements = profile_elements(c);
    for (std::size_t n = 0; n < elements.size(); ++n) {
        const ProfileElement& e = elements[n];
        const auto place = [&] {
            return "between (" + plain_number(e.from.r) + ", " + plain_number(e.from.z) + ") and (" +
                   plain_number(e.to.r) + ", " + plain_number(e.to.z) + ")";
        };
        if (!(e.from.r > kSlack) && !(e.to.r > kSlack))
            return refuse_shape("profile", "runs along the axis " + place(),
                                "remove one of the two vertices");
        if (e.from_normal.r < -kSlack || e.to_normal.r < -kSlack)
            return refuse_shape("profile", "has an arc " + place() + " that hangs back below its ends",
                                "split it where it is lowest or highest: a profile never goes down");
        if (e.radius_mm < 0 && e.from_normal.z > 0 && e.to_normal.z < 0 && !(e.centre.r + e.radius_mm > 0))
            return refuse_shape("profile", "crosses the axis " + place(),
                                "r is the distance from the axis, 0 or more");
        if (n > 0 && e.is_level() && elements[n - 1].is_level() &&
            dot(e.from_normal, elements[n - 1].to_normal) < 0)
            return refuse_shape("profile", "turns back on itself " + place(), "remove the vertex in between");
    }
    if (!(largest_radius_mm(elements) >= 0.5 * kLimits.cutter_diameter.range.min))
        return refuse_shape("profile", "is thinner than any cutter", range_remedy(kLimits.cutter_diameter));
    return {};
}

}  // namespace tribo::milling
