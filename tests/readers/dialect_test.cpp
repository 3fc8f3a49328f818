// SPDX-License-Identifier: MIT
#include "readers/control/dialect.hpp"

#include <gtest/gtest.h>

namespace tribo::readers {
namespace {

TEST(Dialect, IsToldByWhatOnlyOneControlWrites) {
    const struct {
        const char* text;
        std::optional<Dialect> dialect;
    } cases[] = {
        {"", std::nullopt},
        {"G21\nG0 X1 (MSG(hello))\n", std::nullopt},
        {"(made for TRAORI)\nG1 X1\n", std::nullopt},
        {"%\nO0001\nG1 X1\n", Dialect::fanuc},
        {":1234\nG1 X1\n", Dialect::fanuc},
        {"%O1000\nG1 X1\n", Dialect::fanuc},
        {"(made (by hand) for a mill)\n%\nO0025\nG1 X1\n", Dialect::fanuc},
        {"G1 X1\nG43.4 H1\n", Dialect::fanuc},
        {"g1 x1\no100 sub\n", std::nullopt},
        {"o<cut> call\n", Dialect::linuxcnc},
        {"o<pocket1> sub\n", Dialect::linuxcnc},
        {"o<cycle81> call [1]\n", Dialect::linuxcnc},
        {"DPRNT[POCKET DONE]\n", Dialect::fanuc},
        {"[BILLET X10 Y10 Z5\nG1 X1\n", Dialect::fanuc},
        // LinuxCNC refuses a cycle without R.
        {"G0 Z5\nG98 G81 Z-3 F100\nX10\n", Dialect::fanuc},
        {"G0 Z5\nG83 X1 Z-3 Q1 F100 (no R)\nG81 Z-3 R1\n", Dialect::fanuc},
        {"G0 Z5\nG81 X1 Z-3 R1 F100\nG81 Z-4\n", std::nullopt},
        {"G0 Z5\nG80 Z5\nG90 Z-3\nG8 Z1\n", std::nullopt},
        {"N10 POCKET3(5,0,1,-9)\n", Dialect::siemens},
        {"HOLES2(0,0,20,0,60,6)\n", Dialect::siemens},
        {"%\nM428\n", Dialect::linuxcnc},
        {"N10 TRAORI(1)\n", Dialect::siemens},
        {"N10 G1 X1 A3 = 0.5\n", Dialect::siemens},
        {"g2 x1 y1 cr=5\n", Dialect::siemens},
        {"N10 CYCLE800(0,\"\")\n", Dialect::siemens},
        {"N20 R1=0\nG0 X1\n", Dialect::siemens},
        {"N20 S2=1500 M2=3\nG0 X1\n", Dialect::siemens},
        {"G0 X1\nN30 g1 z = r6\n", Dialect::siemens},
        {"DEF REAL _F\n", Dialect::siemens},
        {"IF R1==5 GOTOF END\n", Dialect::siemens},
        {"L X1,5 Y0.5 FMAX\n", Dialect::heidenhain},
        {"#<max>=5\nG1 X1\n", Dialect::linuxcnc},
        {"\xEF\xBB\xBF"
         "0 BEGIN PGM X MM\r\n",
         Dialect::heidenhain},
    };
    for (const auto& c : cases) EXPECT_EQ(detect_dialect(c.text), c.dialect) << c.text;
}

}  // namespace
}  // namespace tribo::readers
