// SPDX-License-Identifier: MIT
// Names, macros and copies against the points that they stand for.
#include <gtest/gtest.h>
#include <string>

#include "readers/apt/apt_text.hpp"
#include "readers/program_checks.hpp"

namespace tribo::readers {
namespace {

motion::Program from_start(const std::string& text) {
    return apt_in_mm("FROM/0,0,5\n" + text);
}

TEST(AptProcedures, StandForTheirPoints) {
    const struct {
        const char *text, *points;
    } cases[] = {
        {"A=5\nB=A\nP1=POINT/1,A,-2\nP2=POINT/B,7\nGOTO/P1\nGOTO/P2\nGOTO/-A,A,0,0,0,1\nA=6\nGOTO/A,0,0\n",
         "GOTO/1,5,-2\nGOTO/5,7,0\nGOTO/-5,5,0,0,0,1\nGOTO/6,0,0\n"},
        {"M1=MACRO/X1,Y1=3\nRAPID\nGOTO/X1,Y1,5\nGOTO/X1,Y1,-1\nTERMAC\nCALL/M1,X1=2\nCALL/M1,X1=4,Y1=-6\n",
         "RAPID\nGOTO/2,3,5\nGOTO/2,3,-1\nRAPID\nGOTO/4,-6,5\nGOTO/4,-6,-1\n"},
        {"A=1\nM1=MACRO/A\nGOTO/A,0,0\nTERMAC\nM2=MACRO/B\nCALL/M1,A=B\nGODLTA/0,0,B\nTERMAC\nCALL/"
         "M2,B=7\nGOTO/A,1,0\n",
         "GOTO/7,0,0\nGODLTA/0,0,7\nGOTO/1,1,0\n"},
        {"INDEX/1\nGOTO/1,0,0\nRAPID\nGOTO/1,2,0\nCOPY/1,TRANSL,10,0,-1,2\nGOTO/0,0,0\n",
         "GOTO/1,0,0\nRAPID\nGOTO/1,2,0\nGOTO/11,0,-1\nRAPID\nGOTO/11,2,-1\nGOTO/21,0,-2\nRAPID\nGOTO/"
         "21,2,-2\n"
         "GOTO/0,0,0\n"},
        {"INDEX/7\nGOTO/1,0,0,1,0,0\nCOPY/7,XYROT,90,3\n",
         "GOTO/1,0,0,1,0,0\nGOTO/0,1,0,0,1,0\nGOTO/-1,0,0,-1,0,0\nGOTO/0,-1,0,0,-1,0\n"},
        // A copy of a copy: a row of two, twice.
        {"INDEX/2\nINDEX/1\nGOTO/1,0,0\nCOPY/1,TRANSL,5,0,0,1\nCOPY/2,TRANSL,0,9,0,1\n",
         "GOTO/1,0,0\nGOTO/6,0,0\nGOTO/1,9,0\nGOTO/6,9,0\n"},
        {"INDEX/1\nGOTO/1,0,0\nCIRCLE/1,5,0,0,0,1,5\nGOTO/6,5,0\nCOPY/1,TRANSL,20,0,0,1\n",
         "GOTO/1,0,0\nCIRCLE/1,5,0,0,0,1,5\nGOTO/6,5,0\nGOTO/21,0,0\nCIRCLE/21,5,0,0,0,1,5\nGOTO/26,5,0\n"},
        {"INDEX/1\nGOTO/1,0,0\nGODLTA/1,0,0\nCOPY/1,SAME,1\n",
         "GOTO/1,0,0\nGODLTA/1,0,0\nGOTO/1,0,0\nGODLTA/1,0,0\n"},
    };
    for (const auto& one : cases) {
        const motion::Program read = from_start(one.text), expected = from_start(one.points);
        ASSERT_EQ(read.moves.size(), expected.moves.size()) << one.text;
        for (std::size_t k = 0; k < read.moves.size(); ++k) {
            expect_near(read.moves[k].end.tip_mm, expected.moves[k].end.tip_mm);
            expect_near(read.moves[k].end.axis, expected.moves[k].end.axis);
            expect_near(pose_at(read.moves[k], 0.5).tip_mm, pose_at(expected.moves[k], 0.5).tip_mm, 1e-9);
            EXPECT_EQ(read.moves[k].kind, expected.moves[k].kind) << one.text;
        }
    }
}

TEST(AptProcedures, EndCopiesOfCopies) {
    std::string text = "INDEX/1\nGOTO/1,0,0\n";
    for (int i = 0; i < 30; ++i) text += "COPY/1,SAME,1\n";  // doubles each time
    const auto program = read_apt("UNITS/MM\nFEDRAT/100\nFROM/0,0,5\n" + text, {.source_name = "p.apt"});
    ASSERT_FALSE(program.has_value());
    EXPECT_NE(program.error().cause.find("more than 1000000 statements"), std::string::npos);
}

}  // namespace
}  // namespace tribo::readers
