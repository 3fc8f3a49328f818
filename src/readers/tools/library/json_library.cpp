// SPDX-License-Identifier: MIT
// Tool libraries in JSON: Fusion (.json, and .tools when unpacked) and single tool bits of FreeCAD (.fctb).
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/limits.hpp"
#include "readers/tools/folded_text.hpp"
#include "readers/tools/library/libraries.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kMostHolderSteps = 100;  // as in a job

// Reads numbers of the children of a node; 0 where they are absent.
class Sizes {
  public:
    Sizes(const Document& document, const DocumentNode* node, double unit_mm)
        : document_(document), node_(node), unit_mm_(unit_mm) {}

    double length(std::string_view name) const { return number(name, unit_mm_); }
    double plain(std::string_view name) const { return number(name, 1); }
    double first_length(std::initializer_list<std::string_view> names) const {
        for (const std::string_view name : names) {
            if (const double value = length(name); value > 0) return value;
        }
        return 0;
    }
    int count(std::string_view name) const {
        const double value = plain(name);
        return value >= 1 && value <= 1e9 ? static_cast<int>(value) : 0;
    }

  private:
    double number(std::string_view name, double unit) const {
        if (node_ == nullptr) return 0;
        const double value = quantity_of(document_.text(*node_, name), unit).value_or(0);
        return value > 0 && value < 1e6 ? value : 0;
    }

    const Document& document_;
    const DocumentNode* node_;
    double unit_mm_;
};

// The steps of a holder, from its face up. A cone counts as a cylinder of its larger diameter.
std::vector<motion::DeclaredStep> holder_steps(const Document& document, const DocumentNode* holder,
                                               double unit_mm) {
    const DocumentNode* segments = holder == nullptr ? nullptr : document.child(*holder, "segments");
    if (segments == nullptr || !segments->is_array || segments->children.size() > kMostHolderSteps) return {};
    std::vector<motion::DeclaredStep> steps;
    std::vector<double> lower_mm, upper_mm;
    for (const std::uint32_t place : segments->children) {
        const Sizes segment(document, &document.nodes[place], unit_mm);
        lower_mm.push_back(segment.length("lower-diameter"));
        upper_mm.push_back(segment.length("upper-diameter"));
        const motion::DeclaredStep step{std::max(lower_mm.back(), upper_mm.back()), segment.length("height")};
        if (!kLimits.holder.range.contains(step.diameter_mm) ||
            !kLimits.holder.range.contains(step.length_mm))
            return {};
        steps.push_back(step);
    }
    // The list begins at the tool, unless its diameters meet only from the spindle on.
    std::size_t up = 0, down = 0;
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
        up += upper_mm[i] == lower_mm[i + 1] ? 1 : 0;
        down += lower_mm[i] == upper_mm[i + 1] ? 1 : 0;
    }
    if (down > up) std::reverse(steps.begin(), steps.end());
    return steps;
}

// The codes are those of ISO 13399 where it has one: DC diameter, RE corner radius, SIG point angle, LCF
// length of the edges, LB length below the holder, SFDM diameter of the shank, NOF flutes; TA is the angle of
// the side to the axis.
void add_fusion_tool(const Document& document, const DocumentNode& entry, LibraryTools& tools) {
    LibraryTool tool;
    tool.line = entry.line;
    tool.type = document.text(entry, "type");
    tool.name = document.text(entry, "description");
    if (tool.type == "holder") return;
    const double unit_mm = folded(document.text(entry, "unit")).starts_with("IN") ? kMmPerInch : 1;
    const Sizes geometry(document, document.child(entry, "geometry"), unit_mm);
    const Sizes post(document, document.child(entry, "post-process"), 1);
    const int number = post.count("number");
    if (number > 0) tool.number = number;
    ToolSizes& sizes = tool.sizes;
    sizes.shape = shape_in(folded(tool.type)).shape;
    sizes.diameter_mm = geometry.length("DC");
    sizes.corner_mm = geometry.length("RE");
    sizes.tip_mm = geometry.length("tip-diameter");
    sizes.edge_mm = geometry.length("LCF");
    sizes.point_deg = geometry.plain("SIG");
    sizes.flutes = geometry.count("NOF");
    const double side_deg = geometry.plain("TA");
    switch (sizes.shape) {
        case ToolShape::taper:
        case ToolShape::dovetail:
            sizes.taper_deg = side_deg;
            break;
        case ToolShape::chamfer:
        case ToolShape::engraver:
            if (side_deg > 0) sizes.point_deg = 2 * side_deg;
            break;
        case ToolShape::flat:
        case ToolShape::ball:
        case ToolShape::bull:
        case ToolShape::face:
            sizes.point_deg = 0;
            sizes.tip_mm = 0;
            break;
        default:
            break;
    }
    // A corner that is no smaller than the radius is that of a ball.
    if (sizes.shape == ToolShape::lollipop)
        sizes.neck_mm = geometry.first_length({"shoulder-diameter", "SFDM"});
    if (const double length = geometry.length("assemblyGaugeLength"); length > 0) tool.length_mm = length;
    tool.stickout_mm = geometry.length("LB");
    tool.shank_mm = geometry.length("SFDM");
    if (const DocumentNode* holder = document.child(entry, "holder")) {
        const bool is_inch = folded(document.text(*holder, "unit")).starts_with("IN");
        const bool has_unit = document.child(*holder, "unit") != nullptr;
        tool.holder = holder_steps(document, holder, !has_unit ? unit_mm : is_inch ? kMmPerInch : 1);
    }
    tools.add(std::move(tool));
}

// FreeCAD names the shape by the file of its model: endmill.fcstd, v-bit.fcstd.
void add_freecad_tool(const Document& document, const DocumentNode& entry, LibraryTools& tools) {
    LibraryTool tool;
    tool.line = entry.line;
    tool.name = document.text(entry, "name");
    const std::string shape = folded(document.text(entry, "shape"));
    tool.type = shape.substr(0, shape.find(".FCSTD"));
    struct Name {
        std::string_view text;
        ToolShape shape;
    };
    constexpr std::array kNames{
        Name{"ENDMILL", ToolShape::flat},
        Name{"BALLEND", ToolShape::ball},
        Name{"BULLNOSE", ToolShape::bull},
        Name{"TORUS", ToolShape::bull},
        Name{"CHAMFER", ToolShape::chamfer},
        Name{"DOVETAIL", ToolShape::dovetail},
        Name{"DRILL", ToolShape::drill},
        Name{"V-BIT", ToolShape::v},
        Name{"VBIT", ToolShape::v},
        Name{"SLITTINGSAW", ToolShape::slot},
        Name{"THREAD-MILL", ToolShape::thread},
        Name{"THREADMILL", ToolShape::thread},
        Name{"TAPEREDBALLNOSE", ToolShape::taper},
        Name{"RADIUS", ToolShape::corner_rounding},
        Name{"REAMER", ToolShape::reamer},
        Name{"TAP", ToolShape::tap},
        Name{"PROBE", ToolShape::probe},
        Name{"LOLLIPOP", ToolShape::lollipop},
    };
    ToolSizes& sizes = tool.sizes;
    for (const Name& name : kNames) {
        if (tool.type == name.text) sizes.shape = name.shape;
    }
    const Sizes parameter(document, document.child(entry, "parameter"), 1);
    const Sizes attribute(document, document.child(entry, "attribute"), 1);
    sizes.diameter_mm = parameter.length("Diameter");
    sizes.edge_mm = parameter.first_length({"CuttingEdgeHeight", "CuttingEdgeLength"});
    sizes.corner_mm = parameter.first_length({"TorusRadius", "CornerRadius"});
    // Older bull noses state the radius of the flat part, or its diameter.
    const double flat_mm = std::max(2 * parameter.length("FlatRadius"), parameter.length("FlatDiameter"));
    if (sizes.shape == ToolShape::bull && sizes.corner_mm == 0 && flat_mm > 0 && flat_mm < sizes.diameter_mm)
        sizes.corner_mm = 0.5 * (sizes.diameter_mm - flat_mm);
    sizes.tip_mm = parameter.length("TipDiameter");
    sizes.neck_mm = parameter.length("NeckDiameter");
    tool.shank_mm = parameter.length("ShankDiameter");
    sizes.flutes = std::max(parameter.count("Flutes"), attribute.count("Flutes"));
    const double angle_deg = parameter.plain("CuttingEdgeAngle");
    switch (sizes.shape) {
        case ToolShape::drill:
            sizes.point_deg = parameter.plain("TipAngle");
            break;
        case ToolShape::taper: {  // the tip's diameter and half of the full angle
            sizes.taper_deg = 0.5 * std::max(angle_deg, parameter.plain("TaperAngle"));
            if (sizes.tip_mm == 0) sizes.tip_mm = sizes.diameter_mm;
            sizes.diameter_mm = sizes.tip_mm;
            sizes.corner_mm = 0.5 * sizes.tip_mm;
            break;
        }
        case ToolShape::dovetail:
            sizes.taper_deg = 0.5 * angle_deg;
            break;
        default:
            sizes.point_deg = angle_deg;
    }
    tools.add(std::move(tool));
}

}  // namespace

Result<ToolTable> read_json_library(std::string_view bytes, const std::string& source_name) {
    const auto document = read_json(bytes, source_name);
    if (!document) return std::unexpected(document.error());
    LibraryTools tools(source_name);
    const DocumentNode& root = document->root();
    const DocumentNode* list = root.is_array ? &root : document->child(root, "data");
    if (list != nullptr && list->is_array) {
        for (const std::uint32_t place : list->children)
            add_fusion_tool(*document, document->nodes[place], tools);
        return tools.finish();
    }
    if (document->child(root, "geometry") != nullptr) {
        add_fusion_tool(*document, root, tools);
        return tools.finish();
    }
    if (document->child(root, "parameter") != nullptr) {
        add_freecad_tool(*document, root, tools);
        return tools.finish();
    }
    const DocumentNode* bits = document->child(root, "tools");
    if (bits != nullptr && bits->is_array) {
        return fail_at(source_name, bits->line, 0,
                       "a library of FreeCAD names its tools and does not hold them",
                       "give one of the tool bits (.fctb) that it names");
    }
    return fail_at(source_name, 1, 0, "JSON that is no tool library known here",
                   "give a library of Fusion (.json, .tools) or a tool bit of FreeCAD (.fctb)");
}

}  // namespace tribo::readers
