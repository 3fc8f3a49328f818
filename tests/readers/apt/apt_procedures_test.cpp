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
        // Formulas: ** before * before +, degrees, a slash that divides.
        {"A=2\nB=-A**2+3*(A+1)/2\nGOTO/B,10*SINF(30),SQRTF(A*8)\nGOTO/(B+.5)*2,-(A-5),1.5E1\n",
         "GOTO/.5,5,4\nGOTO/2,3,15\n"},
        // A row of holes by the arithmetic IF, with a label alone in its line.
        {"X=10\nLOOPST\nL1) GOTO/X,0,5\nGODLTA/0,0,-6\nX=X+10\nIF (X-30) L1,L1,FIN\nFIN) "
         "loopnd\nGOTO/0,0,9\n",
         "GOTO/10,0,5\nGODLTA/0,0,-6\nGOTO/20,0,5\nGODLTA/0,0,-6\nGOTO/30,0,5\nGODLTA/0,0,-6\nGOTO/0,0,9\n"},
        {"X=10\nLOOPST\nL1) GOTO/X,0,5\nGODLTA/0,0,-6\nX=X+10\nIF (X-30) L1,L1,L2\nL2)\nLOOPND\nGOTO/0,0,9\n",
         "GOTO/10,0,5\nGODLTA/0,0,-6\nGOTO/20,0,5\nGODLTA/0,0,-6\nGOTO/30,0,5\nGODLTA/0,0,-6\nGOTO/0,0,9\n"},
        // Rows and columns by logical IF and JUMPTO; steps of 0.1 that add up to 0.3.
        {"LOOPST\nY=0\nROW) X=0\nCOL) GOTO/X,Y,5\nX=X+.1\nIF (X .LT. .3) JUMPTO/COL\n"
         "Y=Y+1\nIF(Y.EQ.2.OR.X.GT.9)JUMPTO/OUT\nJUMPTO/ROW\nGOTO/9,9,9\nOUT) GOTO/1,1,1\nLOOPND\n",
         "GOTO/0,0,5\nGOTO/.1,0,5\nGOTO/.2,0,5\nGOTO/0,1,5\nGOTO/.1,1,5\nGOTO/.2,1,5\nGOTO/1,1,1\n"},
        // A loop within a loop, a statement behind an IF, a jump in a macro.
        {"M1=MACRO/N\nI=0\nAGAIN) I=I+1\nGOTO/I,N,0\nIF (I/2 .LT. N/2) JUMPTO/AGAIN\nTERMAC\n"
         "N=1\nLOOPST\nA) CALL/M1,N=N\nLOOPST\nIF (N .EQ. 2) GOTO/7,7,7\nLOOPND\nN=N+1\nIF (N-3) A,B,B\n"
         "B) GOTO/0,0,0\nLOOPND\n",
         "GOTO/1,1,0\nGOTO/1,2,0\nGOTO/2,2,0\nGOTO/7,7,7\nGOTO/0,0,0\n"},
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
