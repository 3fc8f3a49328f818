// SPDX-License-Identifier: MIT
// Tool libraries in XML: DIN 4000 (Tool-Data, as the catalogues of makers export it) and elements that carry
// the property codes of ISO 13399 (MTConnect assets, Property-Data with such codes).
#include <algorithm>
#include <map>
#include <utility>

#include "readers/text/text_lines.hpp"
#include "readers/tools/folded_text.hpp"
#include "readers/tools/library/libraries.hpp"

namespace tribo::readers {
namespace {

using Properties = std::map<std::string, std::string, std::less<>>;

// Adds the properties below a node: <PropertyName>A1</PropertyName><Value>6</Value>, and elements with a
// `code`.
void collect(const Document& document, const DocumentNode& node, Properties& properties) {
    const std::string_view name = trimmed(document.text(node, "PropertyName"));
    if (!name.empty()) properties.emplace(name, trimmed(document.text(node, "Value")));
    const std::string_view code = document.text(node, "@code");
    if (!code.empty()) properties.emplace(code, trimmed(node.text));
    for (const char* key : {"ProgramToolNumber", "ToolNumber", "PrimaryId", "ToolId", "Description"}) {
        if (node.name == key) properties.emplace(key, trimmed(node.text));
    }
    for (const std::uint32_t place : node.children) collect(document, document.nodes[place], properties);
}

class Values {
  public:
    explicit Values(const Properties& properties) : properties_(properties) {}

    std::string_view text(std::string_view code) const {
        const auto found = properties_.find(code);
        return found == properties_.end() ? std::string_view() : std::string_view(found->second);
    }
    // The first of the codes with a number > 0.
    double first(std::initializer_list<std::string_view> codes, double unit = 1) const {
        for (const std::string_view code : codes) {
            const double value = quantity_of(text(code), unit).value_or(0);
            if (value > 0 && value < 1e6) return value;
        }
        return 0;
    }

  private:
    const Properties& properties_;
};

// DIN 4000-81 (drills with one edge system) and 4000-82 (solid end mills); decimals have a comma, lengths are
// mm.
bool set_din(const Values& values, LibraryTool& tool) {
    const std::string_view standard = values.text("NSM"), picture = values.text("BLD");
    ToolSizes& sizes = tool.sizes;
    if (standard.find("4000-81") != std::string_view::npos) {
        sizes.shape = picture == "6"   ? ToolShape::spot_drill
                      : picture == "7" ? ToolShape::centre_drill
                                       : ToolShape::drill;
        sizes.diameter_mm = values.first({"A11", "A1"});
        sizes.point_deg = values.first({"E1"});
        sizes.edge_mm = values.first({"B2", "B4"});
        sizes.flutes = static_cast<int>(values.first({"D1", "F21"}));
        return true;
    }
    if (standard.find("4000-82") != std::string_view::npos) {
        sizes.diameter_mm = values.first({"A1"});
        sizes.corner_mm = std::max(values.first({"G1"}), values.first({"G4"}));
        sizes.edge_mm = values.first({"B2"});
        sizes.flutes = static_cast<int>(values.first({"F21", "D1"}));
        if (picture == "3") sizes.shape = ToolShape::chamfer;
        return true;
    }
    return false;
}

void set_iso(const Values& values, double unit_mm, LibraryTool& tool) {
    ToolSizes& sizes = tool.sizes;
    sizes.shape = shape_in(folded(tool.type)).shape;
    sizes.diameter_mm = values.first({"DC", "DCX"}, unit_mm);
    sizes.corner_mm = values.first({"RE"}, unit_mm);
    sizes.point_deg = values.first({"SIG"});
    sizes.edge_mm = values.first({"APMX", "APMXS", "LCF"}, unit_mm);
    sizes.flutes = static_cast<int>(values.first({"ZEFP", "PCEDC", "NOF", "ZEFF"}));
    if (sizes.point_deg > 0 && sizes.shape == ToolShape::unstated) sizes.shape = ToolShape::drill;
    if (const double length = values.first({"LF", "LUX"}, unit_mm); length > 0) tool.length_mm = length;
}

void add_tool(const Document& document, const DocumentNode& node, LibraryTools& tools) {
    Properties properties;
    collect(document, node, properties);
    const Values values(properties);
    LibraryTool tool;
    tool.line = node.line;
    tool.name = values.text("PrimaryId");
    if (tool.name.empty()) tool.name = document.text(node, "@toolId");
    tool.type = values.text("J22");
    if (tool.type.empty()) tool.type = values.text("Description");
    if (const double number = values.first({"ProgramToolNumber", "ToolNumber"}); number >= 1)
        tool.number = static_cast<int>(number);
    const bool is_din = !values.text("NSM").empty();
    if (is_din && !set_din(values, tool)) {
        tools.warn(node.line, tool.name + " is not used: the class " + std::string(values.text("NSM")) +
                                  " is not read, only DIN 4000-81 and 4000-82");
        return;
    }
    const std::string unit =
        folded(document.text(node, "@unit")) + folded(document.text(node, "@nativeUnits"));
    if (!is_din) set_iso(values, unit.starts_with("IN") ? kMmPerInch : 1, tool);
    tools.add(std::move(tool));
}

}  // namespace

Result<ToolTable> read_xml_library(std::string_view bytes, const std::string& source_name) {
    const auto document = read_xml(bytes, source_name);
    if (!document) return std::unexpected(document.error());
    LibraryTools tools(source_name);
    bool found = false;
    for (const DocumentNode& node : document->nodes) {
        if (node.name != "Tool" && node.name != "CuttingTool") continue;
        found = true;
        add_tool(*document, node, tools);
    }
    if (!found) {
        return fail_at(
            source_name, 1, 0, "XML that is no tool library known here",
            "give tools of DIN 4000 (Tool-Data), or elements Tool or CuttingTool with codes of ISO 13399");
    }
    return tools.finish();
}

}  // namespace tribo::readers
