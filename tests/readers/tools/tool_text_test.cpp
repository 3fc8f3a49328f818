// SPDX-License-Identifier: MIT
// The forms in which CAM systems and people write tools into programs, one of each kind.
#include "readers/tools/tool_text.hpp"

#include <gtest/gtest.h>
#include <string>

#include "readers/tools/tool_notes.hpp"

namespace tribo::readers {
namespace {

using enum ToolShape;

constexpr int kNoNumber = -1;

struct Form {
    const char* text;
    int number;
    ToolShape shape;
    double diameter, unit_mm, corner, angle_deg;
    int flutes;
};

// Sizes are what a machinist reads in the text; unit 0: that of the program.
const Form kForms[] = {
    // Fusion, HSMWorks, Inventor CAM
    {"T7 D=8. CR=1.5 - ZMIN=-2. - bullnose end mill", 7, bull, 8, 0, 1.5, 0, 0},
    {"T3  D=5 CR=2.5 - ZMIN=-1 - ball end mill", 3, ball, 5, 0, 2.5, 0, 0},
    {"T9 D=4.2 CR=0. TAPER=118deg - ZMIN=-11 - drill", 9, drill, 4.2, 0, 0, 118, 0},
    {"T4 D=6 CR=0 TAPER=45deg - ZMIN=-1 - chamfer mill", 4, chamfer, 6, 0, 0, 45, 0},
    {"#12 D=16 CR=0.8 - ZMIN=-3 - ZMAX=+10 - bull nose end mill", 12, bull, 16, 0, 0.8, 0, 0},
    {"T2 D=+4 CR=+0 - ZMIN=-15 - flat end mill", 2, flat, 4, 0, 0, 0, 0},
    // SolidWorks CAM, CAMWorks, Mastercam
    // A wire gauge is no number of a tool.
    {" #14 [.182\"] DRILL, CARB, TSC ", kNoNumber, drill, 0.182, 25.4, 0, 0, 0},
    // Poland, Russia
    {"FREZ PALCOWY FI 10", kNoNumber, flat, 10, 0, 0, 0, 0},
    {"WIERTLO FI6", kNoNumber, drill, 6, 0, 0, 0, 0},
    {"SVERLO D5", kNoNumber, drill, 5, 0, 0, 0, 0},
    {"FREZ KULISTY FI8", kNoNumber, ball, 8, 0, 0, 0, 0},
    {"T04 ID=004  DIA-0.3750  TOOL END MILL", 4, flat, 0.375, 0, 0, 0, 0},
    {" T2 | 3/8 BALL ENDMILL | H2 | D2 | WEAR COMP | TOOL DIA. - .375 ", 2, ball, 0.375, 0, 0, 0, 0},
    {"3/4 FLAT ENDMILL TOOL - 5 DIA. OFF. - 5 LEN. - 5 DIA. - .75", 5, flat, 0.75, 0, 0, 0, 0},
    // CamBam, EZ-CAM, Estlcam, HeeksCNC
    {" T2 : 3.175 ", 2, unstated, 3.175, 0, 0, 0, 0},
    {"T6//11.97", 6, unstated, 11.97, 0, 0, 0, 0},
    {"tool change to 3 mm HSS Ball End Mill", kNoNumber, ball, 3, 1, 0, 0, 0},
    // FreeCAD
    {"begin operation: T2: 5mm Endmill", 2, flat, 5, 1, 0, 0, 0},
    {"TC: 6.35mm Ball End", kNoNumber, ball, 6.35, 1, 0, 0, 0},
    {"Compensated Tool Path. Diameter: 4.0", kNoNumber, unstated, 4, 0, 0, 0, 0},
    // pcb2gcode, FlatCAM, pcb-gcode
    {"MSG, Change tool bit to drill size 0.9 mm", kNoNumber, drill, 0.9, 1, 0, 0, 0},
    {"MSG, Change tool bit to cutter diameter 1.50000mm", kNoNumber, unstated, 1.5, 1, 0, 0, 0},
    {"TOOL DIAMETER: 0.4 mm", kNoNumber, unstated, 0.4, 1, 0, 0, 0},
    {"MSG, Change to Tool Dia = 1.2000", kNoNumber, unstated, 1.2, 0, 0, 0, 0},
    {"Tool: 3 -> Dia: 0.8", 3, unstated, 0.8, 0, 0, 0, 0},
    {" T05 | 0.600mm 0.0236in | 0.0000in | 0.0000in |       7 ", 5, unstated, 0.6, 1, 0, 0, 0},
    // Vectric
    {"1 = End Mill {3 mm}", 1, flat, 3, 1, 0, 0, 0},
    {"T3 = Ball Nose {0.25 inches}", 3, ball, 0.25, 25.4, 0, 0, 0},
    {"2 = V-Bit {60 deg 12.7 mm}", 2, v, 12.7, 1, 0, 60, 0},
    {"Toolpath: Outside Tool: End Mill {1/8 inch}", kNoNumber, flat, 0.125, 25.4, 0, 0, 0},
    // Carbide Create, CutViewer
    {"TOOL/MILL,6.350,3.175, 0.000, 0.00", kNoNumber, flat, 6.35, 0, 3.175, 0, 0},
    {"TOOL/MILL,0.10, 0.00, 8.00, 30.00", kNoNumber, taper, 0.1, 0, 0, 30, 0},
    {"TOOL/DRILL, 5, 118, 40", kNoNumber, drill, 5, 0, 0, 118, 0},
    {"TOOL/CHAMFER, 10, 90, 5", kNoNumber, chamfer, 10, 0, 0, 90, 0},
    // PowerMill, Blender CAM, NX
    {"TOOL DIA. : 12. LENGTH 60.", kNoNumber, unstated, 12, 0, 0, 0, 0},
    {"TOOL ID : D20R2", kNoNumber, unstated, 20, 0, 2, 0, 0},
    {"Tool: D = 2.0 mm type BALLNOSE flutes 4", kNoNumber, ball, 2, 1, 0, 0, 4},
    {"TOOL NAME FACEMILL_D50", kNoNumber, face, 50, 0, 0, 0, 0},
    {"TOOL NAME MM12_NUT", kNoNumber, unstated, 12, 1, 0, 0, 0},
    // By hand, in several languages
    {"Tool:  4mm 3-flute flat end mill", kNoNumber, flat, 4, 1, 0, 0, 3},
    {"TOOL CHANGE \xE2\x80\x94 T2: 8mm Ball End Mill", 2, ball, 8, 1, 0, 0, 0},
    {"Current cutter: 3mm endmill 2flute", kNoNumber, flat, 3, 1, 0, 0, 2},
    {"Change tool to 1/4\" Engraver 90 degree", kNoNumber, engraver, 0.25, 25.4, 0, 90, 0},
    {"T10 12 MM DIA ROUGHING END MILL", 10, flat, 12, 1, 0, 0, 0},
    {"T9 1-1/2 FACE MILL", 9, face, 1.5, 25.4, 0, 0, 0},
    {"T1 1/2 END MILL", 1, flat, 0.5, 25.4, 0, 0, 0},
    {"T4 SCHAFTFRAESER D12 Z4", 4, flat, 12, 0, 0, 0, 4},
    // hyperMILL, which writes a number of its tool library
    {"TOOL: T1755863337 | GUH-5640 / DM=8 CR=1 TL=357", kNoNumber, unstated, 8, 0, 1, 0, 0},
    {"T7 SCHFR_DM20_SN4", 7, unstated, 20, 0, 0, 0, 0},
    {"T5 Kugelfr\xC3\xA4ser \xC3\x98"
     "6,5 mm 2 Schneiden",
     5, ball, 6.5, 1, 0, 0, 2},
    {"Kugelfr\xE4ser \xD8"
     "6,5",
     kNoNumber, ball, 6.5, 0, 0, 0, 0},
    {"T6 BOHRER D=8,5 SPITZENWINKEL 130", 6, drill, 8.5, 0, 0, 130, 0},
    {"T7 NC-Anbohrer D10 90\xC2\xB0", 7, spot_drill, 10, 0, 0, 90, 0},
    {"VHM-Torusfraeser D10 R1", kNoNumber, bull, 10, 0, 1, 0, 0},
    {"FRAISE DIAMETRE 20", kNoNumber, flat, 20, 0, 0, 0, 0},
    {"T8 FORET A CENTRER D3.15", 8, centre_drill, 3.15, 0, 0, 0, 0},
    {"T3 D=3 CR=0. - ZMIN=-1. - FRESA CON PUNTA PLANA", 3, flat, 3, 0, 0, 0, 0},
    {"T11 GEWINDEBOHRER M6 D6", 11, tap, 6, 0, 0, 0, 0},
    {"T8 DRILL D6.8 R118 ID:FURO_6.8", 8, drill, 6.8, 0, 0, 118, 0},
    {"T1 FACE MILL D63 R0.8 \"PLANFR63\"", 1, face, 63, 0, 0.8, 0, 0},
    // A bare number beside the noun, behind the tool's number
    {"T1  0.25 END MILL", 1, flat, 0.25, 0, 0, 0, 0},
    {"T5 0.500 4FL END MILL", 5, flat, 0.5, 0, 0, 0, 4},
    {"T3 0.250-20 UNC TAP", 3, tap, 0.25, 0, 0, 0, 0},
    {"T4 D5 DRILL 135 Point Angle", 4, drill, 5, 0, 0, 135, 0},
    {"T5 DRILL 6.8", 5, drill, 6.8, 0, 0, 0, 0},
    {"T7 - 8.5 DRILL", 7, drill, 8.5, 0, 0, 0, 0},
    {"T3 .5 ENDMILL 4 FLUTE", 3, flat, 0.5, 0, 0, 0, 4},
    {"T12 FACE MILL 50", 12, face, 50, 1, 0, 0, 0},
    {"T2 12 ENDMILL", 2, flat, 12, 1, 0, 0, 0},
    {"T8 TAP M8X1.25", 8, tap, 8, 1, 0, 0, 0},
    {"1/2 EM", kNoNumber, flat, 0.5, 25.4, 0, 0, 0},
    {"T4 10MM 3 FL EM", 4, flat, 10, 1, 0, 0, 3},
    {"3/8 BALL EM", kNoNumber, ball, 0.375, 25.4, 0, 0, 0},
    {"EM .5", kNoNumber, flat, 0.5, 0, 0, 0, 0},
    {"REAMER .250", kNoNumber, reamer, 0.25, 0, 0, 0, 0},
    {"T5 4-INCH FACE MILL", 5, face, 4, 25.4, 0, 0, 0},
    {"2.5 IN FACEMILL", kNoNumber, face, 2.5, 25.4, 0, 0, 0},
    {"T2 10mm 2F EM", 2, flat, 10, 1, 0, 0, 2},
    {"T2 BROCA\xC3\x87\xC3\x83O \xC3\x98"
     "5mm",
     2, drill, 5, 1, 0, 0, 0},
    // A diameter before DIA, whatever number follows
    {"T1 .5 DIA 4 FLT EM", 1, flat, 0.5, 0, 0, 0, 4},
    {"T1 1/2\" DIA 4 FLUTE ENDMILL", 1, flat, 0.5, 25.4, 0, 0, 4},
    {"TOOL #1 .5 DIA. - 3 FLT FEM", 1, unstated, 0.5, 0, 0, 0, 3},
    {"T1 .5 DIA 1.25 LOC EM", 1, flat, 0.5, 0, 0, 0, 0},
    {"T1 .5 DIA .03 RAD EM", 1, flat, 0.5, 0, 0.03, 0, 0},
    {"T1 .5 DIA 90 DEG SPOT", 1, spot_drill, 0.5, 0, 0, 90, 0},
    {"T1 .257 DIA 135 DEG DRILL", 1, drill, 0.257, 0, 0, 135, 0},
    {"T1 .257 DIA 3.5 LONG DRILL", 1, drill, 0.257, 0, 0, 0, 0},
    {"T1 12MM DIA 4 FLUTE ENDMILL", 1, flat, 12, 1, 0, 0, 4},
    {"T1 12MM DIA 2.5 RAD ENDMILL", 1, flat, 12, 1, 2.5, 0, 0},
    {"T1 .5 DIA, 4 FLUTE ENDMILL", 1, flat, 0.5, 0, 0, 0, 4},
    {"T1 6.0 DIA. BALL 2 FLT", 1, ball, 6, 0, 0, 0, 2},
    // Numbers of offsets
    {"T1   - 0.500 ENDMILL - H1   - D1   - D0.5000\"", 1, flat, 0.5, 25.4, 0, 0, 0},
    {"T1 5/16 EM D21", 1, flat, 0.3125, 25.4, 0, 0, 0},
    {"T1 H1 D1 DRILL D8.5", 1, drill, 8.5, 0, 0, 0, 0},
    {"T5 D05 ENDMILL 10MM", 5, flat, 10, 1, 0, 0, 0},
    {"T12 ENDMILL 10MM H12 D12", 12, flat, 10, 1, 0, 0, 0},
    {"T6 D6 ENDMILL", 6, flat, 6, 0, 0, 0, 0},
    // Gauges and letters, radii of balls, short forms
    {"T1 NO.7 DRILL", 1, drill, 0.201, 25.4, 0, 0, 0},
    {"#7 DRILL", kNoNumber, drill, 0.201, 25.4, 0, 0, 0},
    {"NO. 21 DRILL", kNoNumber, drill, 0.159, 25.4, 0, 0, 0},
    {"LETTER F DRILL", kNoNumber, drill, 0.257, 25.4, 0, 0, 0},
    {"T1 NO.10-32 TAP", 1, tap, 0.19, 25.4, 0, 0, 0},
    {"T1 10-32 TAP", 1, tap, 0.19, 25.4, 0, 0, 0},
    {"T1 1/16 R BALL", 1, ball, 0.125, 25.4, 0, 0, 0},
    {"T1 5MM RADIUS BALL", 1, ball, 10, 1, 0, 0, 0},
    {"T1 EM10", 1, flat, 10, 0, 0, 0, 0},
    {"T2 FM63", 2, face, 63, 0, 0, 0, 0},
    {"T3 16R0.8", 3, unstated, 16, 0, 0.8, 0, 0},
    {"DIA 50 FINISH BORE BAR", kNoNumber, boring, 50, 0, 0, 0, 0},
    {"FAZOWNIK FI10 90ST", kNoNumber, chamfer, 10, 0, 0, 90, 0},
    {"DRILL \xCF\x86"
     "5.5mm",
     kNoNumber, drill, 5.5, 1, 0, 0, 0},
    {"T2: Kugelfraeser (R2=4)", 2, ball, 8, 0, 4, 0, 0},
    {"DIA OUTIL = 15. RAYON = 1.", kNoNumber, unstated, 15, 0, 1, 0, 0},
    {"T01 TC1: KL+087.000 KR020.000 NZ06", 1, unstated, 40, 0, 0, 0, 0},
    {"T1595399926 | D6_HSS_CSF / DM=6 CR=0 TL=177.2", kNoNumber, unstated, 6, 0, 0, 0, 0},
    {"FRAISE BOULE D10", kNoNumber, ball, 10, 0, 0, 0, 0},
    // Threads: by number, of pipes, of the library of Mastercam
    {"1/4-20 TAPRH|TOOL - 2|DIA. OFF. - 2|LEN. - 2|TOOL DIA. - .25", 2, tap, 0.25, 0, 0, 0, 0},
    {"NO. 10-24 TAPRH", kNoNumber, tap, 0.19, 25.4, 0, 0, 0},
    {"T3 #8-32 TAP", 3, tap, 0.164, 25.4, 0, 0, 0},
    {"T1 G1/4 TAP", 1, tap, 13.157, 1, 0, 0, 0},
    {"T1 NPT 1/8 TAP", 1, tap, 10.287, 1, 0, 0, 0},
    {"T4 ROSQUEAMENTO M6x1.0", 4, tap, 6, 1, 0, 0, 0},
};

TEST(ToolText, reads_the_forms_of_cam_systems_and_people) {
    for (const Form& form : kForms) {
        SCOPED_TRACE(form.text);
        const ToolText tool = read_tool_text(form.text);
        ASSERT_TRUE(tool.describes_tool());
        EXPECT_EQ(tool.number.value_or(kNoNumber), form.number);
        EXPECT_EQ(tool.shape, form.shape);
        EXPECT_EQ(tool.diameter->value, form.diameter);
        EXPECT_EQ(tool.diameter->unit_mm, form.unit_mm);
        EXPECT_EQ(tool.corner.value_or(StatedLength{}).value, form.corner);
        EXPECT_EQ(tool.angle_deg.value_or(0), form.angle_deg);
        EXPECT_EQ(tool.flutes, form.flutes);
    }
}

TEST(ToolText, takes_nothing_from_texts_about_other_things) {
    for (const char* text : {"",
                             "2D Pocket 10mm",
                             "DRILL 4 HOLES 5MM DEEP",
                             "POINTAGE 4 TROUS DIAM 10",
                             "T1 AT 5 MM ABOVE THE CLAMP",
                             "STOCK IS 30MM DIAMETER ACETAL ROD",
                             "Groove roughing cuts - 4.6825mm wide",
                             "Z Toolchange: 12.7 mm",
                             "CUTTER COMP LEFT (D1 = RADIUS REGISTER)",
                             "T12 CNMG OD TURN WITH .03\" NR INSERT",
                             "12-HOLE DRILL PATTERN",
                             "Pocket size: 60mm x 60mm",
                             "Hexagon - Face #1 - Square X[-5.7..8.8] Y[18..30]",
                             "T2 later",
                             "TOOL T3",
                             "CHANGE TOOL TO 0.0 MM ENDMILL",
                             "X= 100.000, Y= 100.000 ,Z= 12.000",
                             "ENGRAVE \"5\" AND \"10\"",
                             "FEED 300 MM/MIN",
                             "tool change at 0.0000  0.0000  10.0000 ",
                             "MILL 1.5 DEEP",
                             "DESBASTE EM 10MM",
                             "CAVIDADE 10MM EM",
                             "T5 ENDMILL 2",
                             "HOLE-CENTERS-T3-4 - DRILL",
                             "T5 DRILL 5",
                             "T5 DRILL 4 HOLES",
                             "DRILL 6.8"}) {
        EXPECT_FALSE(read_tool_text(text).describes_tool()) << text;
    }
}

TEST(ToolText, takes_a_bare_number_beside_the_noun_in_the_name_of_a_tool) {
    const struct {
        const char* name;
        ToolShape shape;
        double diameter;
    } cases[] = {{"BOHRER_6.8", drill, 6.8},    {"FRAESER_12", flat, 12},
                 {"SCHAFTFRAESER_8", flat, 8},  {"8.5 SPIRALBOHRER", drill, 8.5},
                 {"Frez_walcowy_12", flat, 12}, {"GEWINDEBOHRER_M8", tap, 8},
                 {"DRILL_D8_5", drill, 8.5},    {"BOHRER_8_5", drill, 8.5},
                 {"FRAESER_D8_4", flat, 8},     {"DRILL_D8_5XD", drill, 8}};
    for (const auto& c : cases) {
        const ToolText tool = read_tool_text(c.name, true);
        ASSERT_TRUE(tool.describes_tool()) << c.name;
        EXPECT_EQ(tool.shape, c.shape) << c.name;
        EXPECT_EQ(tool.diameter->value, c.diameter) << c.name;
    }
    EXPECT_EQ(read_tool_text("FRAESER_D6_R0_5", true).corner->value, 0.5);
    for (const char* name : {"FRAESER_1", "SCHRUPPER", "TASTER_6", "MILL_2_OF_8", "711951"})
        EXPECT_FALSE(read_tool_text(name, true).describes_tool()) << name;
}

TEST(ToolText, takes_the_width_of_a_chamfer_for_no_diameter) {
    EXPECT_FALSE(read_tool_text("TOOL 1 = CHAMFER MILL .010").diameter.has_value());
    EXPECT_TRUE(read_tool_text("TOOL 1 = CHAMFER MILL .250").diameter.has_value());
}

motion::Move sideways(int tool = 0) {
    motion::Move move;
    move.tool = tool;
    move.end.tip_mm = {1, 0, 0};
    return move;
}
motion::Move down(int tool) {
    motion::Move move;
    move.tool = tool;
    move.end.tip_mm = {0, 0, -3};
    return move;
}

TEST(ToolText, takes_none_of_a_list_without_numbers_for_the_next_tool) {
    Warnings warnings;
    const char* const list[] = {"MILL D=10 H2", "BALL MILL D=10 H1", "BALL MILL D=6 H3"};
    for (const int lines : {1, 2, 3}) {
        ToolNotes notes;
        for (int n = 0; n < lines; ++n) notes.read(list[n], n + 1);
        notes.change(2);
        notes.cut(sideways(2));
        EXPECT_EQ(notes.tools(1, "p.mpf", warnings).size(), lines == 1 ? 1u : 0u) << lines;
    }
    // Two lines about one tool, and a text right before the change behind another one farther up.
    ToolNotes twice;
    twice.read("END MILL D=10", 1);
    twice.read("END MILL D=10 4 FLUTES", 2);
    twice.change(3);
    EXPECT_EQ(twice.tools(1, "p.mpf", warnings).size(), 1u);
    ToolNotes apart;
    apart.read("FACE MILL D=50", 1);
    apart.read("END MILL D=8", 9);
    apart.change(3);
    ASSERT_EQ(apart.tools(1, "p.mpf", warnings).size(), 1u);
    EXPECT_EQ(apart.tools(1, "p.mpf", warnings)[0].diameter_mm, 8);
}

// H63Z10L85: of its holder.
TEST(ToolText, gives_a_drill_no_more_than_four_flutes) {
    Warnings warnings;
    for (const auto& [text, flutes] : {std::pair{"T1 GUH-5512_H63Z10L85 DRILL / DM=9", 0},
                                       {"T1 DRILL Z3 D=9", 3},
                                       {"T1 MILL Z10 D=9", 10}}) {
        ToolNotes notes;
        notes.read(text, 1);
        const auto tools = notes.tools(1, "p.h", warnings);
        ASSERT_EQ(tools.size(), 1u) << text;
        EXPECT_EQ(tools[0].flutes, flutes) << text;
    }
}

motion::DeclaredTool only_tool(ToolNotes& notes, double unit_mm = 1) {
    Warnings warnings;
    const auto tools = notes.tools(unit_mm, "p.nc", warnings);
    EXPECT_EQ(tools.size(), 1u);
    EXPECT_TRUE(warnings.empty());
    return tools.empty() ? motion::DeclaredTool{} : tools.front();
}

TEST(ToolNotes, give_a_text_without_a_number_to_the_tool_that_is_changed_next_to_it) {
    ToolNotes before;  // the text, then the change
    before.read("6 mm end mill", 3);
    before.change(4);
    EXPECT_EQ(only_tool(before).number, 4);
    ToolNotes after;  // the change, then the text, then the first cut
    after.change(2);
    after.read("6 mm end mill", 3);
    after.cut(sideways());
    EXPECT_EQ(only_tool(after).number, 2);
    ToolNotes late;  // the tool has cut: the text is about the next one
    late.change(2);
    late.cut(sideways());
    late.read("6 mm end mill", 9);
    late.change(5);
    EXPECT_EQ(only_tool(late).number, 5);
    ToolNotes twice;  // the second comment of a line, and the line once more
    twice.read("Tool Number:1", 3);
    twice.read("6 mm dia. slot drill", 3);
    twice.change(1);
    twice.cut(sideways());
    twice.read("Tool Number:1", 3);
    twice.read("6 mm dia. slot drill", 3);
    twice.change(2);
    EXPECT_EQ(only_tool(twice).number, 1);
    ToolNotes alone;  // a program without T
    alone.read("6 mm end mill", 1);
    alone.cut(sideways());
    EXPECT_EQ(only_tool(alone).number, 0);
    ToolNotes emptied;  // T0 takes the tool out: the text on the line of the next change is that tool's
    emptied.change(0);
    emptied.read("6 mm end mill", 2);
    emptied.change(3);
    EXPECT_EQ(only_tool(emptied).number, 3);
    ToolNotes zero;  // T0 cuts: it is a tool of that number
    zero.change(0);
    zero.read("6 mm end mill", 2);
    zero.cut(sideways());
    zero.change(3);
    EXPECT_EQ(only_tool(zero).number, 0);
    ToolNotes probed;  // what a move does is no tool
    probed.read("probe", 1);
    probed.change(1);
    probed.read("Change Tool: Diameter: 6 mm", 3);
    EXPECT_EQ(only_tool(probed).diameter_mm, 6);
}

TEST(ToolNotes, take_a_bare_number_in_the_block_that_changes_the_tool) {
    for (const auto& [text, diameter] : {std::pair{"DRILL 8.5", 8.5},
                                         {"FLAT ENDMILL 12", 12.0},
                                         {"12 ENDMILL", 12.0},
                                         {"FACEMILL 63", 63.0}}) {
        ToolNotes notes;
        notes.read(text, 2, true);
        notes.change(2);
        Warnings assumed;
        const auto tools = notes.tools(1, "p.nc", assumed);
        ASSERT_EQ(tools.size(), 1u) << text;
        EXPECT_EQ(tools[0].diameter_mm, diameter) << text;
    }
    ToolNotes work;  // elsewhere it may be what is done
    work.change(2);
    work.read("DRILL 8.5", 3);
    work.read("DRILL 4 HOLES", 4, true);
    Warnings warnings;
    EXPECT_TRUE(work.tools(1, "p.nc", warnings).empty());
}

TEST(ToolNotes, give_each_tool_of_a_list_in_one_line_its_part) {
    const std::vector<std::vector<const char*>> lines{
        {"T1 = 10 MM 3-FLUTE END MILL, T2 = 6.6 MM DRILL"},
        {"TOOLS: T1 D10 ENDMILL, T2 D6.6 DRILL"},
        {"T1 10MM ENDMILL / T2 6.6 DRILL"},
        {"T1: FRESA D10 - T2: BROCA D6.6"},
        {"10MM END MILL T1, 6.6MM DRILL T2"},
        {"HAAS VF-3 MACH21 / T01 10MM 2FL EM, T02 6.6MM DRILL"},
        {"T01 - 10MM END MILL", "T02 - 6.6MM DRILL"},
    };
    for (const auto& line : lines) {
        SCOPED_TRACE(line[0]);
        ToolNotes notes;
        for (int run = 0; run < 2; ++run)
            for (const char* comment : line) notes.read(comment, 3);
        Warnings warnings;
        const auto tools = notes.tools(1, "p.nc", warnings);
        ASSERT_EQ(tools.size(), 2u);
        EXPECT_EQ(tools[0].number, 1);
        EXPECT_EQ(tools[0].diameter_mm, 10);
        EXPECT_NE(tools[0].kind, "drill");
        EXPECT_EQ(tools[1].number, 2);
        EXPECT_EQ(tools[1].diameter_mm, 6.6);
        EXPECT_EQ(tools[1].kind, "drill");
    }
}

TEST(ToolNotes, take_the_number_of_a_library_for_that_of_the_program_where_nothing_else_says_so) {
    const std::string five = "7.2 DRILL TOOL - 5 DIA. OFF. - 5 LEN. - 5 DIA. - 7.2",
                      seven = "16. FLAT ENDMILL TOOL - 7 DIA. OFF. - 7 LEN. - 7 DIA. - 16.";
    const auto diameter_of = [](ToolNotes& notes, int number) {
        Warnings warnings;
        for (const auto& tool : notes.tools(1, "p.nc", warnings))
            if (tool.number == number) return tool.diameter_mm;
        return 0.0;
    };
    ToolNotes behind;  // each text behind the change of another number
    behind.change(7);
    behind.read(five, 3);
    behind.cut(sideways(7));
    behind.change(5);
    behind.read(seven, 9);
    EXPECT_EQ(diameter_of(behind, 7), 7.2);
    EXPECT_EQ(diameter_of(behind, 5), 16);
    ToolNotes named;  // a text without a number says the same
    named.read("16 mm end mill", 2);
    named.change(4);
    named.read(seven, 4);
    named.cut(sideways(4));
    named.read("7.2 mm drill", 8);
    named.change(25);
    named.read(five, 9);
    EXPECT_EQ(diameter_of(named, 4), 16);
    EXPECT_EQ(diameter_of(named, 25), 7.2);
    EXPECT_EQ(diameter_of(named, 7), 0);
    ToolNotes before;
    before.read(seven, 3);
    before.change(4);
    EXPECT_EQ(diameter_of(before, 4), 16);
    EXPECT_EQ(diameter_of(before, 7), 0);
    ToolNotes list;  // at the head: each its own
    list.read(five, 1);
    list.read(seven, 2);
    list.change(7);
    list.cut(sideways(7));
    list.change(5);
    EXPECT_EQ(diameter_of(list, 7), 16);
    EXPECT_EQ(diameter_of(list, 5), 7.2);
    ToolNotes unused;
    unused.read(five, 1);
    EXPECT_EQ(diameter_of(unused, 5), 7.2);
}

TEST(ToolNotes, take_a_tool_without_a_shape_that_only_goes_down_for_a_drill) {
    for (const bool mills : {false, true}) {
        ToolNotes notes;
        notes.read(" T2 : 3.175 ", 1);
        notes.change(2);
        notes.cut(down(2));
        if (mills) notes.cut(sideways(2));
        Warnings warnings;
        const auto tools = notes.tools(1, "p.nc", warnings);
        ASSERT_EQ(tools.size(), 1u);
        EXPECT_EQ(tools[0].kind, mills ? "" : "drill");
        EXPECT_EQ(warnings.size(), mills ? 0u : 1u);
    }
}

TEST(ToolNotes, give_a_text_with_a_name_to_the_tool_of_that_name) {
    ToolNotes notes;
    notes.read("\"FACE50\" D=50 - ZMIN=0 - face mill", 1);
    notes.read("\"EM10\" D=10 - ZMIN=-5 - flat end mill", 2);
    notes.read("T7 = KUGEL_D8", 3);
    EXPECT_EQ(notes.number_of("KUGEL_D8"), 7);
    EXPECT_FALSE(notes.number_of("KUGEL"));
    notes.name(1, "EM10", 5);
    notes.change(1);
    notes.name(2, "FACE50", 9);
    notes.change(2);
    Warnings warnings;
    const auto tools = notes.tools(1, "p.nc", warnings);
    ASSERT_EQ(tools.size(), 3u);
    for (const auto& [number, diameter] : {std::pair{1, 10.0}, {2, 50.0}, {7, 8.0}}) {
        const auto is_it = [&](const motion::DeclaredTool& tool) { return tool.number == number; };
        EXPECT_EQ(std::ranges::find_if(tools, is_it)->diameter_mm, diameter);
    }
}

TEST(ToolNotes, join_a_header_of_several_lines) {
    ToolNotes notes;
    notes.read("TOOL TYPE : BALLNOSED MILL BALL", 1);
    notes.read("TOOL DIA. : 16. LENGTH 80.", 2);
    notes.change(3);
    const motion::DeclaredTool tool = only_tool(notes);
    EXPECT_EQ(tool.diameter_mm, 16);
    EXPECT_EQ(tool.corner_mm, 8);
    ToolNotes sized;
    sized.read("  Tool Size", 1);
    sized.read("0.2000  ", 2);
    EXPECT_EQ(only_tool(sized).diameter_mm, 0.2);
}

TEST(ToolNotes, say_that_two_texts_disagree_about_one_tool) {
    ToolNotes notes;
    notes.read("T1 D=6 - end mill", 2);
    notes.read("T1: 6mm end mill", 5);  // the same
    notes.read("T1 D=8 - end mill", 90);
    Warnings warnings;
    const auto tools = notes.tools(1, "p.nc", warnings);
    ASSERT_EQ(tools.size(), 1u);
    EXPECT_EQ(tools[0].diameter_mm, 6);
    EXPECT_EQ(tools[0].line, 2);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].line, 90);
    EXPECT_NE(warnings[0].text.find("a diameter of 8 here, and of 6 on line 2"), std::string::npos);
}

TEST(ToolNotes, take_sizes_in_the_unit_of_the_program_or_their_own) {
    ToolNotes inches;
    inches.read("T1 D=0.5 CR=0.1 - bull nose end mill", 1);
    const motion::DeclaredTool bull_mill = only_tool(inches, 25.4);
    EXPECT_EQ(bull_mill.diameter_mm, 12.7);
    EXPECT_EQ(bull_mill.corner_mm, 2.54);
    ToolNotes stated;
    stated.read("T1: 6mm end mill", 1);
    EXPECT_EQ(only_tool(stated, 25.4).diameter_mm, 6);
}

TEST(ToolNotes, make_the_shapes_that_texts_name) {
    struct Shape {
        const char* text;
        std::string kind;
        double diameter_mm, corner_mm, point_deg, taper_deg, tip_mm;
        const char* remark;  // a part of the warning; empty: none
    };
    const Shape shapes[] = {
        {"T1 D=8 CR=0 - flat end mill", "", 8, 0, 0, 0, 0, ""},
        {"T1 D=8 - ball end mill", "", 8, 4, 0, 0, 0, ""},
        {"T1 D=5 CR=0 TAPER=118deg - drill", "drill", 5, 0, 118, 0, 0, ""},
        {"T1 D=5 - drill", "drill", 5, 0, 118, 0, 0, "118 degrees are assumed"},
        {"T1 D=10 TAPER=90deg - spot drill", "drill", 10, 0, 90, 0, 0, ""},
        {"T1 D=6 TAPER=45deg - chamfer mill", "chamfer", 6, 0, 90, 0, 0, ""},
        {"T1 D=6 90 DEG CHAMFER MILL", "chamfer", 6, 0, 90, 0, 0, ""},
        {"T1 D=6 45 DEG CHAMFER MILL", "chamfer", 6, 0, 90, 0, 0, ""},
        {"1 = V-Bit {60 deg 12 mm}", "v", 12, 0, 60, 0, 0, ""},
        {"T1 D=10 TAPER=82deg - countersink", "countersink", 10, 0, 82, 0, 0, ""},
        {"T1: 1/4\" engraver 30 degree", "engraver", 6.35, 0, 30, 0, 0, ""},
        {"T1 D=6 - thread mill", "", 6, 0, 0, 0, 0, "thread mill is milled as an end mill"},
        {"T1 D=6 - right hand tap", "", 6, 0, 0, 0, 0, "tap is milled as an end mill"},
        {"T1 D=6 CR=0 - bull nose end mill", "", 6, 0, 0, 0, 0, "taken as sharp"},
    };
    for (const Shape& shape : shapes) {
        SCOPED_TRACE(shape.text);
        ToolNotes notes;
        notes.read(shape.text, 7);
        Warnings warnings;
        const auto tools = notes.tools(1, "p.nc", warnings);
        ASSERT_EQ(tools.size(), 1u);
        EXPECT_EQ(tools[0].kind, shape.kind);
        EXPECT_EQ(tools[0].diameter_mm, shape.diameter_mm);
        EXPECT_EQ(tools[0].corner_mm, shape.corner_mm);
        EXPECT_EQ(tools[0].point_deg, shape.point_deg);
        EXPECT_EQ(tools[0].taper_deg, shape.taper_deg);
        EXPECT_EQ(tools[0].tip_mm, shape.tip_mm);
        ASSERT_EQ(warnings.empty(), *shape.remark == '\0');
        if (!warnings.empty()) {
            EXPECT_NE(warnings[0].text.find(shape.remark), std::string::npos) << warnings[0].text;
            EXPECT_EQ(warnings[0].line, 7);
        }
    }
    ToolNotes cone;  // at 45 degrees it widens by 16 mm over 8 mm
    cone.read("TOOL/MILL,0.5,0,8,45", 1);
    const motion::DeclaredTool taper = only_tool(cone);
    EXPECT_EQ(taper.kind, "taper");
    EXPECT_EQ(taper.tip_mm, 0.5);
    EXPECT_EQ(taper.edge_mm, 8);
    EXPECT_NEAR(taper.diameter_mm, 16.5, 1e-12);
}

TEST(ToolNotes, give_radius_compensation_only_diameters_that_the_control_uses) {
    ToolNotes notes;
    notes.read("T1 D=10 CR=0 - flat end mill", 1);
    notes.read("T2 | END MILL | H2 | D2 | CONTROL COMP | TOOL DIA. - 8.", 2);
    notes.read("T3 | END MILL | H3 | D3 | WEAR COMP | TOOL DIA. - 8.", 3);
    EXPECT_EQ(notes.diameter_mm(1, 1), 10);
    EXPECT_EQ(notes.diameter_mm(2, 1), 8);
    EXPECT_FALSE(notes.diameter_mm(3, 1));
    EXPECT_FALSE(notes.diameter_mm(4, 1));
    EXPECT_EQ(notes.no_diameter_text(3),
              "line 3 gives tool 3 a diameter of 8, but not whether the control compensates all of it or the "
              "wear alone");
    EXPECT_EQ(notes.diameter_comment(3), "(T3 D=8)");
    EXPECT_EQ(notes.no_diameter_text(4, "radius"), "nothing states the radius of tool 4");
    // What is advised states it.
    ToolNotes advised;
    advised.read(notes.diameter_comment(3), 1);
    EXPECT_EQ(advised.diameter_mm(3, 1), 8);
}

}  // namespace
}  // namespace tribo::readers
