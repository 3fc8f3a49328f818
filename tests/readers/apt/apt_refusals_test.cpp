// SPDX-License-Identifier: MIT
// What the APT reader refuses of circles, cycles, frames and settings, and where.
#include <gtest/gtest.h>
#include <string>

#include "readers/apt/apt_text.hpp"

namespace tribo::readers {
namespace {

TEST(AptRefusals, NameTheStatementThePlaceAndTheReason) {
    const std::string at = "UNITS/MM\nFEDRAT/100\nFROM/10,0,0\n";  // three lines
    const std::string circle = at + "CIRCLE/0,0,0,0,0,1,10\n";
    const Refusal refusals[] = {
        {"UNITS/MM\nCIRCLE/0,0,0,0,0,1,5\n", 2, 1, "a circle before any point"},
        {at + "CIRCLE/0,0,0,5\n", 4, 1, "'CIRCLE' without centre, axis and radius"},
        {at + "CIRCLE/0,0,0,0,0\n", 4, 1, "without centre, axis and radius"},
        {at + "CIRCLE/10,0,5,0,0,1\n", 4, 1, "a circle without a radius"},
        {at + "CIRCLE/0,0,0,0,0,0,5\n", 4, 14, "the direction has no length"},
        {at + "CIRCLE/0,0,0,0,0,1,0\n", 4, 20, "without a radius"},
        {at + "CIRCLE/0,0,0,0,0,1,-5\n", 4, 20, "'-5' is out of range"},
        {at + "CIRCLE/0,0,zero,0,0,1,5\n", 4, 12, "'zero' is not a number"},
        {at + "CIRCLE/0,0,0,0,0,1,5,FAST\n", 4, 22, "'FAST' is not known here"},
        {at + "MOVARC/CENTER,0,0,0,RADIUS,5\n", 4, 1, "'MOVARC' without centre, axis and radius"},
        {at + "MOVARC/0,0,0,0,0,1,10,ANGLE\n", 4, 23, "a number is missing"},
        {at + "CIRCLE/0,0,0,0,0,1,5\nGOTO/0,5,0\n", 5, 1,
         "starts 10 mm from the axis of its circle of radius 5 mm"},
        {circle + "GOTO/0,11,0\n", 5, 1, "ends 11 mm from the axis of its circle of radius 10 mm"},
        {at + "MOVARC/0,0,0,0,0,1,10,ANGLE,80\nGOTO/0,10,0\n", 4, 1,
         "states a turn of 80 degrees where its points make 90"},
        {circle + "GOTO/0,10\n", 5, 1, "'GOTO' has 2 numbers"},
        {at + "INDIRV/1,0\n", 4, 1, "INDIRV without a direction"},
        {at + "TLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)\n", 4, 1, "without INDIRV"},
        {at + "INDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10)\n", 5, 1,
         "in a form that is not known"},
        {at + "INDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),TO,(LINE/0,0,0,0,10,0)\n", 5, 1,
         "in a form that is not known"},
        {at + "INDIRV/1,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)\n", 5, 1,
         "INDIRV does not lead along the circle"},
        {at + "CYCLE\n", 4, 1, "CYCLE without a kind"},
        {at + "CYCLE/THREAD,5\n", 4, 7, "'THREAD' is not a cycle that is read"},
        {at + "CYCLE/ON\n", 4, 1, "before any cycle was described"},
        {at + "CYCLE/DRILL,FEDTO,5,MMPM,9\nCYCLE/ON,FED,5\n", 5, 10, "'FED' is not known in a cycle"},
        {at + "CYCLE/DRILL\n", 4, 1, "a cycle without a depth"},
        {at + "CYCLE/DRILL,FEDTO\n", 4, 13, "a number is missing after this"},
        {at + "CYCLE/DRILL,FEDTO,deep\n", 4, 19, "'deep' is not a number"},
        {at + "CYCLE/DRILL,FEDTO,5,RAPTO,-3\n", 4, 27, "'-3' is out of range"},
        {at + "CYCLE/DRILL,FEDTO,5,MMPM,0\n", 4, 21, "the feed of 0 mm/min is out of range"},
        {at + "CYCLE/DRILL,FEDTO,5,CAM,1\n", 4, 21, "'CAM' is not known in a cycle"},
        {at + "CYCLE/DRILL,5,80,3\n", 4, 1, "the cycle's feed has no unit"},
        {at + "CYCLE/DRILL,5,MMPM,80,3,4\n", 4, 25, "more numbers than depth, feed and clearance"},
        {at + "CYCLE/DRILL,FEDTO,5,DWELL,REV,2\n", 4, 31, "a dwell in turns with the spindle speed unknown"},
        {at + "CYCLE/DEEP,FEDTO,500,STEP,.001,MMPM,80\n", 4, 1, "more than 10000 pecks"},
        {at + "CYCLE/DRILL,FEDTO,5\nCIRCLE/0,0,0,0,0,1,10\n", 5, 1, "while the CYCLE of line 4 is on"},
        {at + "CYCLE/TAP,FEDTO,5,MMPR,1\nGOTO/0,0,0\n", 5, 1,
         "a feed per turn with the spindle speed unknown"},
        {"UNITS/MM\nFROM/0,0,0\nCYCLE/DRILL,FEDTO,5\nGOTO/0,0,0\n", 4, 1, "a feed move before any FEDRAT"},
        {"UNITS/MM\nGODLTA/1,0,0\n", 2, 1, "GODLTA before any point"},
        {at + "GODLTA/1,0\n", 4, 1, "GODLTA has 2 numbers"},
        {at + "GOHOME/1,0\n", 4, 1, "'GOHOME' has 2 numbers"},
        {at + "RETRCT/TOOL\n", 4, 8, "RETRCT with conditions"},
        {at + "CLEARP\n", 4, 1, "CLEARP without a plane"},
        {at + "CLEARP/XZ,5\n", 4, 8, "'XZ' is no plane"},
        {at + "CLEARP/YZPLAN,50\nRETRCT\n", 5, 1, "does not lead to the clearance plane"},
        {at + "TLAXIS/1\n", 4, 1, "TLAXIS without a direction"},
        {"MSYS/0,0,0\n", 1, 1, "'MSYS' has 3 numbers"},
        {"MSYS/0,0,0,2,0,0,0,1,0\n", 1, 1, "is not a turn without stretch"},
        {"MSYS/0,0,0,1,0,0,1,0,0\n", 1, 1, "is not a turn without stretch"},
        {"CSYS/0,1,0,0\n", 1, 1, "'CSYS' has 4 numbers"},
        {"CSYS/0,-1,0,0,1,0,0,0,0,0,1,0\n", 1, 1, "does not say whether points are written in it"},
        {"TRNTYP/WORLD\nCSYS/1,0,0,0,0,1,0,0,0,0,-1,0\n", 2, 1, "third axis of CSYS"},
        {"TRNTYP/TOOL\n", 1, 8, "neither WORLD nor LOCAL"},
        {"TRNTYP/WORLD,0,0,5\n", 1, 18, "TRNTYP with an offset"},
        {"TRANS/1,2\n", 1, 1, "'TRANS' has 2 numbers"},
        {"ORIGIN/1,2,z\n", 1, 12, "'z' is not a number"},
        {"FEDRAT/5,FPT\n", 1, 10, "a feed per tooth"},
        {"FEDRAT/INVERS,5\n", 1, 1, "a feed in inverse time"},
        {"SPINDL/SFM,300\n", 1, 1, "a surface speed with the cutter's diameter unknown"},
        {"TLDATA/MILL\n", 1, 1, "TLDATA without a kind and a diameter"},
        {"TLDATA/MILL,10,6\n", 1, 16, "does not fit"},
        {at + "DELAY/2,REV\n", 4, 9, "a dwell in turns"},
        {"ROTATE/AAXIS,30\n", 1, 1, "'ROTATE' (moves of rotary axes) is not read"},
        {"ROTABL/30\n", 1, 1, "'ROTABL' (moves of rotary axes) is not read"},
        {"ROTATE/TABLE\n", 1, 1, "'ROTATE' (moves of rotary axes) is not read"},
        {"TRACUT/1\n", 1, 1, "TRACUT with a matrix in a form that is not read"},
        {"TRACUT/(MATRIX/YZROT,30)\n", 1, 1, "TRACUT with a matrix in a form that is not read"},
        {"TRACUT/(MATRIX/TRANSL,1,2,z)\n", 1, 27, "'z' is not a number"},
        {"TRACUT/2,0,0,0,0,1,0,0,0,0,1,0\n", 1, 1, "is not a turn without stretch"},
        {"REFSYS/M1\n", 1, 1, "'REFSYS' (transformations of what was written before) is not read"},
        {"CALSUB/1\n", 1, 1, "'CALSUB' (loops, macros and copies) is not read"},
        {"NURBS/1\n", 1, 1, "'NURBS' (curves between points) is not read"},
        {"MODE/INCR\n", 1, 6, "points as increments"},
        {"ARCSLP/FILLET,1\n", 1, 1, "ARCSLP with more than the rise of a helix"},
        {"MCSYS/NUM,1,POINT,0,0,0\n", 1, 1, "'MCSYS' has 3 numbers"},
        {at + "GOCLER/1\n", 4, 1, "statement 'GOCLER' is not known"},
        {at + "N10 G1 X5\n", 4, 1, "statement 'N10 G1 X5' is not known"},
        {at + "M30\n", 4, 1, "statement 'M30' is not known"},
        {at + "L1=LINE/1,2\n", 4, 1, "which defines geometry (LINE"},
        {at + "GOTO/1,2,3,0,0,1,0,0,0\n", 4, 18, "the direction has no length"},
        {"$$-> CSYS / 1,0,0\n", 1, 6, "'CSYS' has 3 numbers"},
        {at + "$$-> CSYS / 1,0,0,9,0,1,0,0,0,0,1,0\n", 4, 6, "another coordinate system than at the start"},
        {"$$*CATIA0\n$$ a\n$$ 2 0 0 0\n$$ 0 1 0 0\n$$ 0 0 1 0\n", 1, 4, "is not a turn without stretch"},
        {"$$-> CUTCOM_GEOMETRY_TYPE / OUTPUT_ON_EDGE\nCUTCOM / LEFT\n", 2, 1, "those of the part's contour"},
        {at + "INDIRP/1,0\n", 4, 1, "INDIRP without a point"},
        {at + "PSIS/S1\n", 4, 1, "a circle of CATIA in a form that is not known"},
        {at + "PSIS/(POINT/0,0,1)\n", 4, 1, "PSIS with a surface that is not written as a plane"},
        {at + "INDIRV/0,1,0\nTLON,GOFWD/(CYLNDR/0,0,0,10),ON,(LINE/0,0,0,0,10,0)\n", 5, 1,
         "in a form that is not known"},
        {at + "INDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,0,0),ON,(LINE/0,0,0,0,10,0)\n", 5, 26,
         "a circle without a radius"},
        {at + "INDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(PLANE/1,0,0,11)\n", 5, 1,
         "the plane at the end does not cross the circle"},
        {at + "CYCLE/TAP,DEPTH,5,TPI,0\n", 4, 19, "out of range"},
        {at + "CYCLE/DEEP,5,80,MMPM,3,4,5\n", 4, 26, "more numbers than"},
        {"LOOPST\nGOTO/1,2,3\n", 1, 1, "LOOPST without its LOOPND"},
        {"LOOPND\n", 1, 1, "'LOOPND' (loops, macros and copies) is not read"},
        {"DO/10,I=1,5\n", 1, 1, "'DO' (loops, macros and copies) is not read"},
        {"JUMPTO/A\n", 1, 1, "a jump outside of a loop and a macro"},
        {"IF (1) A,B,C\n", 1, 1, "a jump outside of a loop and a macro"},
        {"LOOPST\nJUMPTO/A\nLOOPND\n", 2, 1, "a jump to A, which is no label here"},
        {"LOOPST\nJUMPTO\nLOOPND\n", 2, 1, "JUMPTO without its label"},
        {"LOOPST\nA) RAPID\nA) RAPID\nLOOPND\n", 3, 1, "the label A stands twice"},
        {"LOOPST\nIF (X-1) A,B,C\nLOOPND\n", 2, 1, "IF without a formula in brackets"},
        {"LOOPST\nIF (1/0) A,B,C\nLOOPND\n", 2, 1, "IF without a formula in brackets"},
        {"LOOPST\nIF (1\nLOOPND\n", 2, 1, "IF without a formula in brackets"},
        {"LOOPST\nIF (1) THEN\nLOOPND\n", 2, 1, "IF without labels and without a statement"},
        {"LOOPST\nA) JUMPTO/A\nLOOPND\n", 2, 1, "more than 1000000 statements"},
        {"COPY/1,SAME,2\n", 1, 1, "COPY without its INDEX"},
        {"INDEX/1\nCOPY/1,MODIFY,M,2\n", 2, 1, "COPY is read with SAME, TRANSL and XYROT"},
        {"INDEX/1\nCOPY/1,SAME,2.5\n", 2, 13, "COPY without a number of copies"},
        {"INDEX/A\n", 1, 1, "INDEX without its number"},
        {"CALL/M\n", 1, 1, "CALL of a macro that is not defined"},
        {"M=MACRO/A\nGOTO/A,0,0\n", 1, 1, "the macro M has no TERMAC"},
        {"M=MACRO/A\nTERMAC\nCALL/M,B=2\n", 3, 8, "no parameter of the macro"},
        {"M=MACRO\nCALL/M\nTERMAC\nCALL/M\n", 2, 1, "too deeply"},
        {"GOFWD/L1\n", 1, 1, "'GOFWD' (moves that an APT processor computes) is not read"},
        {"GOLFT/L1\n", 1, 1, "'GOLFT' (moves that an APT processor computes) is not read"},
    };
    expect_refused_apt(refusals);
}

TEST(AptReader, gives_all_refusals_at_once) {
    std::vector<Error> refusals;
    AptOptions options;
    options.source_name = "part.apt";
    options.refusals = &refusals;
    const auto program = read_apt(
        "UNITS/MM\nFEDRAT/100\nGOTO/0,0\nCIRCLE/0,0\nGOTO/1,2,3\nGOLFT/L1\nGOTO/1,2,x\nROTABL/30\nGOLFT/L2\n"
        "GOTO/1,2,3\nGOTO/1,2,4\nFINI\n",
        options);
    ASSERT_FALSE(program.has_value());
    EXPECT_EQ(program.error().text(), refusals.at(0).text());
    const int lines[] = {3, 4, 6, 7, 8};
    ASSERT_EQ(refusals.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(refusals[i].line, lines[i]) << refusals[i].text();
        EXPECT_FALSE(refusals[i].remedy.empty());
    }
    refusals.clear();
    EXPECT_TRUE(read_apt("UNITS/MM\nFEDRAT/100\nGOTO/0,0,0\nGOTO/1,2,3\nFINI\n", options).has_value());
    EXPECT_TRUE(refusals.empty());
}

}  // namespace
}  // namespace tribo::readers
