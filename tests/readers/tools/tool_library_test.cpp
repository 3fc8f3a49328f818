// SPDX-License-Identifier: MIT
// Tool libraries of CAM systems, told by their content. Each was written for this test in the system's
// format.
#include <algorithm>
#include <gtest/gtest.h>

#include "readers/tables/tool_table.hpp"
#include "readers/text/document.hpp"

namespace tribo::readers {
namespace {

const motion::DeclaredTool* find(const ToolTable& table, int number) {
    for (const motion::DeclaredTool& tool : table.tools) {
        if (tool.number == number) return &tool;
    }
    return nullptr;
}

ToolTable read(std::string_view text) {
    auto table = read_tool_table(text, {.source_name = "lib"});
    EXPECT_TRUE(table) << (table ? "" : table.error().cause);
    return table ? *std::move(table) : ToolTable{};
}

bool warns(const ToolTable& table, std::string_view text) {
    for (const Warning& warning : table.warnings) {
        if (warning.text.find(text) != std::string::npos) return true;
    }
    return false;
}

constexpr const char* kFusion = R"({"version": 7, "data": [
  {"type": "bull nose end mill", "unit": "millimeters", "description": "12 R1",
   "geometry": {"DC": 12, "RE": 1, "NOF": 4, "LCF": 26, "LB": 40, "OAL": 83, "SFDM": 12, "assemblyGaugeLength": 110.5},
   "post-process": {"number": 3}},
  {"type": "ball end mill", "unit": "inches", "description": "quarter \u00bd ball",
   "geometry": {"DC": 0.25, "RE": 0.125, "NOF": 2}, "post-process": {"number": 4}},
  {"type": "drill", "unit": "millimeters", "geometry": {"DC": 5, "SIG": 140, "NOF": 2}, "post-process": {"number": 5}},
  {"type": "probe", "unit": "millimeters", "description": "touch", "geometry": {"DC": 6}, "post-process": {"number": 99}},
  {"type": "flat end mill", "unit": "millimeters", "description": "free", "geometry": {"DC": 6}, "post-process": {"number": 0}},
  {"type": "flat end mill", "unit": "millimeters", "description": "again", "geometry": {"DC": 8}, "post-process": {"number": 3}},
  {"type": "holder", "unit": "millimeters", "segments": []}
]})";

TEST(ToolLibrary, of_fusion_gives_sizes_in_the_unit_of_each_tool) {
    const ToolTable table = read(kFusion);
    ASSERT_EQ(table.tools.size(), 3u);
    const motion::DeclaredTool& bull = *find(table, 3);
    EXPECT_EQ(bull.diameter_mm, 12);
    EXPECT_EQ(bull.corner_mm, 1);
    EXPECT_EQ(bull.flutes, 4);
    EXPECT_EQ(bull.length_mm, 110.5);
    EXPECT_EQ(bull.line, 2);
    EXPECT_EQ(bull.table, "lib");
    EXPECT_NEAR(find(table, 4)->diameter_mm, 6.35, 1e-12);
    EXPECT_NEAR(find(table, 4)->corner_mm, 3.175, 1e-12);
    EXPECT_EQ(find(table, 5)->diameter_mm, 5);
    EXPECT_EQ(find(table, 5)->kind, "drill");
    EXPECT_EQ(find(table, 5)->point_deg, 140);
    EXPECT_EQ(bull.kind, "");
    EXPECT_EQ(bull.edge_mm, 26);
}

TEST(ToolLibrary, of_fusion_gives_stick_out_shank_and_holder) {
    const auto with = [](const std::string& holder) {
        return read(
            R"({"data": [{"type": "flat end mill", "unit": "inches", "geometry": {"DC": 0.5, "LCF": 1, "LB": 2,
            "SFDM": 0.375, "NOF": 2}, "post-process": {"number": 1}, "holder": )" +
            holder + "}]}");
    };
    // From the tool up; and the same listed from the spindle down, in a unit of its own.
    const ToolTable up = with(R"({"segments": [{"height": 1, "lower-diameter": 0.8, "upper-diameter": 1.2},
        {"height": 2, "lower-diameter": 1.2, "upper-diameter": 2}]})");
    const ToolTable down = with(R"({"unit": "millimeters", "segments":
        [{"height": 50.8, "lower-diameter": 30.48, "upper-diameter": 50.8},
         {"height": 25.4, "lower-diameter": 20.32, "upper-diameter": 30.48}]})");
    for (const ToolTable* table : {&up, &down}) {
        ASSERT_EQ(table->tools.size(), 1u);
        const motion::DeclaredTool& tool = table->tools[0];
        EXPECT_NEAR(tool.stickout_mm, 50.8, 1e-12);
        EXPECT_NEAR(tool.shank_mm, 9.525, 1e-12);
        ASSERT_EQ(tool.holder.size(), 2u);
        EXPECT_NEAR(tool.holder[0].diameter_mm, 30.48, 1e-12);
        EXPECT_NEAR(tool.holder[0].length_mm, 25.4, 1e-12);
        EXPECT_NEAR(tool.holder[1].diameter_mm, 50.8, 1e-12);
        EXPECT_NEAR(tool.holder[1].length_mm, 50.8, 1e-12);
    }
    EXPECT_TRUE(with(R"({"segments": [{"height": 0, "lower-diameter": 1}]})").tools[0].holder.empty());
    EXPECT_EQ(find(read(kFusion), 3)->stickout_mm, 40);
    EXPECT_EQ(find(read(kFusion), 4)->stickout_mm, 0);
}

TEST(ToolLibrary, says_which_entries_it_cannot_use) {
    const ToolTable table = read(kFusion);
    EXPECT_TRUE(warns(table, "T99 (touch) is not used: a probe mills nothing"));
    EXPECT_TRUE(warns(table, "a tool (free) is not used: the library gives it no number"));
    EXPECT_TRUE(warns(table, "T3 (again) is not used: another tool of this number"));
    EXPECT_EQ(table.warnings.size(), 3u);
}

TEST(ToolLibrary, of_freecad_stands_for_every_number) {
    const ToolTable table = read(
        "{\"version\": 2, \"name\": \"3/8 torus\", \"shape\": \"bullnose.fcstd\",\n"
        " \"parameter\": {\"Diameter\": \"0.375 in\", \"FlatRadius\": \"3.1750 mm\", \"Flutes\": \"3\"},\n"
        " \"attribute\": {}}");
    ASSERT_EQ(table.tools.size(), 1u);
    EXPECT_EQ(table.tools[0].number, 0);
    EXPECT_NEAR(table.tools[0].diameter_mm, 9.525, 1e-12);
    EXPECT_NEAR(table.tools[0].corner_mm, 1.5875, 1e-12);  // 9.525 / 2 - 3.175
    EXPECT_EQ(table.tools[0].flutes, 3);
}

TEST(ToolLibrary, of_csv_reads_quotes_and_separators) {
    for (const char separator : {',', ';', '\t'}) {
        std::string text =
            "\"Number (tool_number)\",\"Type (tool_type)\",\"Description (tool_description)\",\"Unit "
            "(tool_unit)\","
            "\"Diameter (tool_diameter)\",\"Corner Radius (tool_cornerRadius)\",\"Number of Flutes "
            "(tool_numberOfFlutes)\"\r\n"
            "7,flat end mill,\"6 \"\"rough\"\"\",millimeters,6,0,3\r\n"
            "8,bull nose end mill,plain,inches,0.5,0.03,4\r\n"
            "8,bull nose end mill,plain with other feeds,inches,0.5,0.03,4\r\n";
        std::ranges::replace(text, ',', separator);
        const ToolTable table = read(text);
        ASSERT_EQ(table.tools.size(), 2u) << separator;
        EXPECT_EQ(find(table, 7)->diameter_mm, 6);
        EXPECT_EQ(find(table, 7)->flutes, 3);
        EXPECT_NEAR(find(table, 8)->diameter_mm, 12.7, 1e-12);
        EXPECT_NEAR(find(table, 8)->corner_mm, 0.762, 1e-12);
        EXPECT_TRUE(table.warnings.empty());
    }
}

std::string din_tool(const std::string& properties) {
    return "<?xml version=\"1.0\"?>\n<!DOCTYPE Tool-Data SYSTEM "
           "\"DIN_4000.dtd\">\n<Tool-Data><Tool><Main-Data>"
           "<PrimaryId>X1</PrimaryId></Main-Data><Properties>" +
           properties + "</Properties></Tool></Tool-Data>";
}
std::string property(const char* name, const char* value) {
    return std::string("<Property-Data><PropertyName source=\"din_mk\">") + name + "</PropertyName><Value>" +
           value + "</Value></Property-Data>\n";
}

TEST(ToolLibrary, of_din_4000_reads_decimal_commas) {
    const ToolTable mill =
        read(din_tool(property("NSM", "DIN4000-82") + property("BLD", "2") + property("A1", "9,8") +
                      property("G1", "0,5") + property("F21", "4") + property("C3", "10")));
    ASSERT_EQ(mill.tools.size(), 1u);
    EXPECT_EQ(mill.tools[0].diameter_mm, 9.8);
    EXPECT_EQ(mill.tools[0].corner_mm, 0.5);
    EXPECT_EQ(mill.tools[0].flutes, 4);
    const ToolTable twist =
        read(din_tool(property("NSM", "DIN4000-81") + property("BLD", "1") + property("A11", "2,55") +
                      property("E1", "140") + property("D1", "2")));
    ASSERT_EQ(twist.tools.size(), 1u);
    EXPECT_EQ(twist.tools[0].diameter_mm, 2.55);
    EXPECT_EQ(twist.tools[0].kind, "drill");
    EXPECT_EQ(twist.tools[0].point_deg, 140);
}

TEST(ToolLibrary, of_iso_13399_reads_codes) {
    const ToolTable table = read(
        "<Assets><CuttingTool toolId=\"E10\"><Description>ball end mill</Description>"
        "<ProgramToolNumber>12</ProgramToolNumber><CuttingDiameterMax code=\"DC\">10</CuttingDiameterMax>"
        "<Teeth code=\"NOF\">2</Teeth><FunctionalLength "
        "code=\"LF\">95.5</FunctionalLength></CuttingTool></Assets>");
    ASSERT_EQ(table.tools.size(), 1u);
    EXPECT_EQ(table.tools[0].number, 12);
    EXPECT_EQ(table.tools[0].corner_mm, 5);
    EXPECT_EQ(table.tools[0].flutes, 2);
    EXPECT_EQ(table.tools[0].length_mm, 95.5);
}

TEST(ToolLibrary, of_linuxcnc_takes_shape_and_flutes_from_the_comment) {
    const ToolTable table = read("T1 P1 D6 ;ball end mill 3 flutes\nT2 P2 D8 ;spare\n");
    ASSERT_EQ(table.tools.size(), 2u);
    EXPECT_EQ(table.tools[0].corner_mm, 3);
    EXPECT_EQ(table.tools[0].flutes, 3);
    EXPECT_EQ(table.tools[1].corner_mm, 0);
}

TEST(ToolLibrary, that_is_none_is_refused_with_its_cause) {
    struct Bad {
        std::string text, cause;
    };
    const Bad bads[] = {
        {"{", "an object without a key"},
        {"{\"a\": 1", "',' or '}' is missing"},
        {"{\"a\": nope}", "no JSON value"},
        {"{\"a\": \"x", "a string without its end"},
        {"{\"a\": \"\\q\"}", "an unknown escape"},
        {"{\"a\": 1} x", "text follows the end"},
        {"{\"a\": 1}", "JSON that is no tool library"},
        {std::string(100, '['), "nest deeper than 64"},
        {"{\"data\": []}", "holds no tool that can be used"},
        {"{\"tools\": [{\"nr\": 1, \"path\": \"a.fctb\"}]}", "names its tools and does not hold them"},
        {"<a>", "the element a is not closed"},
        {"<a></b>", "closes another element"},
        {"<a b=1></a>", "without its value"},
        {"<a>&x;</a>", "the entity &x; is not known"},
        {"<a><!-- </a>", "a comment without its end"},
        {"<a></a><b></b>", "a second root element"},
        {"<a></a>", "XML that is no tool library"},
        {din_tool(property("NSM", "DIN4000-145") + property("A1", "5")), "the class DIN4000-145 is not read"},
        {din_tool(property("NSM", "DIN4000-82")), "no diameter is stated"},
        {std::string("PK\x03\x04zip"), "still packed"},
    };
    for (const Bad& bad : bads) {
        const auto table = read_tool_table(bad.text, {.source_name = "lib"});
        ASSERT_FALSE(table) << bad.text;
        EXPECT_NE(table.error().cause.find(bad.cause), std::string::npos) << table.error().cause;
        EXPECT_EQ(table.error().file, "lib");
        EXPECT_FALSE(table.error().remedy.empty());
    }
}

TEST(Documents, resolve_escapes_and_entities) {
    const auto json =
        read_json("\xEF\xBB\xBF{\"k\\n\": [\"\\u00e4\\ud83d\\ude00\", -1.5e3, true, null, {}]}", "f");
    ASSERT_TRUE(json);
    const DocumentNode* list = json->child(json->root(), "k\n");
    ASSERT_NE(list, nullptr);
    ASSERT_EQ(list->children.size(), 5u);
    EXPECT_EQ(json->nodes[list->children[0]].text, "\xC3\xA4\xF0\x9F\x98\x80");
    EXPECT_EQ(json->nodes[list->children[1]].text, "-1.5e3");
    const auto xml = read_xml("<p:a x='1 &lt; 2'>&#x41;&#66;<![CDATA[<&>]]><b/></p:a>", "f");
    ASSERT_TRUE(xml);
    EXPECT_EQ(xml->root().name, "a");
    EXPECT_EQ(xml->root().text, "AB<&>");
    EXPECT_EQ(xml->text(xml->root(), "@x"), "1 < 2");
    EXPECT_NE(xml->child(xml->root(), "b"), nullptr);
}

}  // namespace
}  // namespace tribo::readers
