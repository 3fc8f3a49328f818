// SPDX-License-Identifier: MIT
#include "readers/tools/declared_tool.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "base/limits.hpp"
#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

// Point angles where a text names the shape alone, degrees: twist drills (DIN 1412), spot drills,
// countersinks and chamfer mills as most are sold.
constexpr double kDrillPoint = 118, kRightPoint = 90, kEngraverPoint = 60;
// The edge of a tapered mill without a stated length, in diameters of its tip.
constexpr double kTaperEdge = 3;
// A corner that exceeds the radius by less is rounding of the text, mm.
constexpr double kCornerSlack = 0.003;
// Z10 in the name of a drill is a size of its holder.
constexpr int kMostFlutesOfDrill = 4;

void add_remark(std::string& remark, const std::string& text) {
    remark += (remark.empty() ? "" : "; ") + text;
}

// Height of a cone over its diameters at the bottom and the top.
double cone_height(double tip_mm, double diameter_mm, double point_deg) {
    double sine = 0, cosine = 1;
    math::sincos(0.5 * point_deg * math::kRadPerDeg, sine, cosine);
    return 0.5 * (diameter_mm - tip_mm) * cosine / sine;
}

void flatten(ToolShape shape, const char* why, std::string& remark) {
    add_remark(remark,
               "the " + std::string(name_of(shape)) + " is milled as an end mill of its diameter: " + why);
}

void set_point(motion::DeclaredTool& tool, const char* kind, const ToolSizes& sizes, double assumed_deg,
               std::string& remark) {
    if (sizes.point_deg > 0 && !kLimits.point_angle.range.contains(sizes.point_deg)) {
        flatten(sizes.shape, "its angle is out of range", remark);
        return;
    }
    tool.kind = kind;
    tool.corner_mm = 0;
    tool.point_deg = sizes.point_deg > 0 ? sizes.point_deg : assumed_deg;
    if (sizes.tip_mm < sizes.diameter_mm) tool.tip_mm = sizes.tip_mm;
    // Edges that end within the cone belong to a cutter that ends there.
    if (tool.edge_mm < cone_height(tool.tip_mm, tool.diameter_mm, tool.point_deg)) tool.edge_mm = 0;
    if (!(sizes.point_deg > 0))
        add_remark(remark,
                   "no point angle is stated: " + short_decimal(assumed_deg) + " degrees are assumed");
}

// The stated diameter of a tapered mill is that of its tip; it is widest at the end of its edges.
void set_taper(motion::DeclaredTool& tool, const ToolSizes& sizes, std::string& remark) {
    if (!kLimits.taper_angle.range.contains(sizes.taper_deg)) {
        flatten(sizes.shape, sizes.taper_deg > 0 ? "its angle is out of range" : "no angle is stated",
                remark);
        return;
    }
    if (!(tool.edge_mm > 0)) tool.edge_mm = kTaperEdge * sizes.diameter_mm;
    double sine = 0, cosine = 1;
    math::sincos(sizes.taper_deg * math::kRadPerDeg, sine, cosine);
    const double widest_mm = sizes.diameter_mm + 2 * tool.edge_mm * sine / cosine;
    if (!kLimits.cutter_diameter.range.contains(widest_mm)) {
        flatten(sizes.shape, "it would be wider than any cutter", remark);
        return;
    }
    if (!(sizes.edge_mm > 0))
        add_remark(remark,
                   "no length of the edges is stated: " + short_decimal(tool.edge_mm) + " mm are assumed");
    tool.kind = "taper";
    tool.taper_deg = sizes.taper_deg;
    tool.tip_mm = sizes.diameter_mm;
    tool.diameter_mm = widest_mm;
}

void set_kind(motion::DeclaredTool& tool, const ToolSizes& sizes, std::string& remark) {
    constexpr const char* not_modelled = "its shape is not modelled";
    switch (sizes.shape) {
        case ToolShape::ball:
            tool.corner_mm = 0.5 * sizes.diameter_mm;
            break;
        case ToolShape::bull:
            if (sizes.corner_mm == 0)
                add_remark(remark, "its corner radius is 0 or not stated: its corner is taken as sharp");
            break;
        case ToolShape::taper:
            set_taper(tool, sizes, remark);
            break;
        case ToolShape::v:
            set_point(tool, "v", sizes, kRightPoint, remark);
            break;
        case ToolShape::chamfer:
            set_point(tool, "chamfer", sizes, kRightPoint, remark);
            break;
        case ToolShape::countersink:
            set_point(tool, "countersink", sizes, kRightPoint, remark);
            break;
        case ToolShape::drill:
            set_point(tool, "drill", sizes, kDrillPoint, remark);
            break;
        case ToolShape::spot_drill:
            set_point(tool, "drill", sizes, kRightPoint, remark);
            break;
        case ToolShape::centre_drill:
            set_point(tool, "drill", sizes, kDrillPoint, remark);
            add_remark(remark, "the pilot and the cone of the centre drill are taken as one drill point");
            break;
        case ToolShape::engraver:
            set_point(tool, "engraver", sizes, kEngraverPoint, remark);
            break;
        case ToolShape::dovetail:
            if (sizes.taper_deg > 0 && sizes.edge_mm > 0) {
                tool.kind = "dovetail";
                tool.taper_deg = sizes.taper_deg;
                tool.height_mm = sizes.edge_mm;
            } else {
                flatten(sizes.shape, "its angle and the length of its edges are not stated", remark);
            }
            break;
        case ToolShape::lollipop:
            if (sizes.neck_mm > 0) {
                tool.kind = "lollipop";
                tool.neck_mm = sizes.neck_mm;
            } else {
                tool.corner_mm = 0.5 * sizes.diameter_mm;
                add_remark(remark, "the lollipop mill is milled as a ball end mill: its neck is not stated");
            }
            break;
        case ToolShape::lens:
        case ToolShape::barrel:
            if (sizes.side_mm > 0) {
                tool.kind = sizes.shape == ToolShape::lens ? "lens" : "barrel";
                tool.side_mm = sizes.side_mm;
            } else {
                flatten(sizes.shape, "the radius of its side is not stated", remark);
            }
            break;
        case ToolShape::tap:
        case ToolShape::reamer:
        case ToolShape::boring:
        case ToolShape::counterbore:
        case ToolShape::thread:
        case ToolShape::slot:
        case ToolShape::corner_rounding:
        case ToolShape::form:
            flatten(sizes.shape, not_modelled, remark);
            break;
        default:
            break;
    }
}

}  // namespace

bool set_shape(motion::DeclaredTool& tool, ToolSizes sizes, std::string& remark) {
    if (sizes.shape == ToolShape::probe || sizes.shape == ToolShape::turning) {
        add_remark(remark, "a " + std::string(name_of(sizes.shape)) + " mills nothing");
        return false;
    }
    if (!kLimits.cutter_diameter.range.contains(sizes.diameter_mm)) {
        add_remark(remark, sizes.diameter_mm == 0 ? "no diameter is stated"
                                                  : out_of_range(kLimits.cutter_diameter, sizes.diameter_mm));
        return false;
    }
    if (2 * sizes.corner_mm > sizes.diameter_mm + 2 * kCornerSlack) {
        add_remark(remark, "the corner radius is more than half the diameter");
        return false;
    }
    sizes.corner_mm = std::min(sizes.corner_mm, 0.5 * sizes.diameter_mm);
    tool.diameter_mm = sizes.diameter_mm;
    tool.corner_mm = sizes.corner_mm;
    const bool is_drill = sizes.shape == ToolShape::drill || sizes.shape == ToolShape::spot_drill;
    const bool has_flutes =
        kLimits.flutes.range.contains(sizes.flutes) && !(is_drill && sizes.flutes > kMostFlutesOfDrill);
    tool.flutes = sizes.flutes > 0 && has_flutes ? sizes.flutes : 0;
    if (kLimits.cutting_length.range.contains(sizes.edge_mm)) tool.edge_mm = sizes.edge_mm;
    const bool has_angle = sizes.point_deg > 0 || sizes.taper_deg > 0;
    if (has_angle && (sizes.shape == ToolShape::unstated || sizes.shape == ToolShape::flat))
        add_remark(remark, "an angle is stated, and no shape that has one: the angle is left out");
    set_kind(tool, sizes, remark);
    return true;
}

}  // namespace tribo::readers
