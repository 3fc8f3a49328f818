// SPDX-License-Identifier: MIT
#include "report/chart/stroke_font.hpp"

#include <algorithm>
#include <string_view>

namespace tribo::report {
namespace {

// Points as two digits, x and y: the base line is y = 2, small letters end at 6, capitals at 8. A slash
// lifts the pen.
struct Letter {
    char character;
    std::string_view strokes;
};

constexpr Letter kLetters[] = {
    {'0', "03 07 18 38 47 43 32 12 03"},
    {'1', "06 28 22"},
    {'2', "07 18 38 47 46 02 42"},
    {'3', "07 18 38 47 46 35 15/35 44 43 32 12 03"},
    {'4', "32 38 04 44"},
    {'5', "48 08 05 35 44 43 32 12 03"},
    {'6', "38 18 07 03 12 32 43 44 35 15 04"},
    {'7', "08 48 12"},
    {'8', "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35"},
    {'9', "12 32 43 47 38 18 07 06 15 35 46"},
    {'A', "02 28 42/14 34"},
    {'B', "02 08 38 47 46 35 05/35 44 43 32 02"},
    {'C', "47 38 18 07 03 12 32 43"},
    {'D', "02 08 28 46 44 22 02"},
    {'E', "48 08 02 42/05 35"},
    {'F', "48 08 02/05 35"},
    {'G', "47 38 18 07 03 12 32 43 45 25"},
    {'H', "02 08/42 48/05 45"},
    {'I', "02 08"},
    {'J', "38 33 22 12 03"},
    {'K', "02 08/48 05 42"},
    {'L', "08 02 42"},
    {'M', "02 08 25 48 42"},
    {'N', "02 08 42 48"},
    {'O', "03 07 18 38 47 43 32 12 03"},
    {'P', "02 08 38 47 46 35 05"},
    {'Q', "03 07 18 38 47 43 32 12 03/24 42"},
    {'R', "02 08 38 47 46 35 05/25 42"},
    {'S', "47 38 18 07 06 15 35 44 43 32 12 03"},
    {'T', "08 48/28 22"},
    {'U', "08 03 12 32 43 48"},
    {'V', "08 22 48"},
    {'W', "08 12 26 32 48"},
    {'X', "02 48/08 42"},
    {'Y', "08 25 48/25 22"},
    {'Z', "08 48 02 42"},
    {'a', "35 26 16 05 03 12 22 33/36 32"},
    {'b', "08 02/05 16 26 35 33 22 12 03"},
    {'c', "35 26 16 05 03 12 22 33"},
    {'d', "38 32/35 26 16 05 03 12 22 33"},
    {'e', "04 34 35 26 16 05 03 12 22 33"},
    {'f', "28 17 12/06 26"},
    {'g', "36 31 20 10 01/35 26 16 05 03 12 22 33"},
    {'h', "08 02/05 16 26 35 32"},
    {'i', "06 02/08"},
    {'j', "16 11 00/18"},
    {'k', "08 02/36 04 32"},
    {'l', "08 02"},
    {'m', "06 02/05 16 25 22/25 36 45 42"},
    {'n', "06 02/05 16 26 35 32"},
    {'o', "05 16 26 35 33 22 12 03 05"},
    {'p', "06 00/05 16 26 35 33 22 12 03"},
    {'q', "36 30/35 26 16 05 03 12 22 33"},
    {'r', "06 02/05 16 26"},
    {'s', "35 26 16 05 14 24 33 22 12 03"},
    {'t', "18 13 22/06 26"},
    {'u', "06 03 12 22 33/36 32"},
    {'v', "06 22 46"},
    {'w', "06 12 25 32 46"},
    {'x', "06 32/36 02"},
    {'y', "06 22/46 22 10 00"},
    {'z', "06 36 02 32"},
    {'.', "02"},
    {',', "12 01"},
    {':', "02/05"},
    {';', "15/12 01"},
    {'(', "18 07 03 12"},
    {')', "08 17 13 02"},
    {'-', "04 34"},
    {'+', "05 45/27 23"},
    {'/', "02 48"},
    {'%', "02 48/07/43"},
    {'=', "04 34/06 36"},
    {'<', "37 05 33"},
    {'>', "07 35 03"},
    {'\'', "08 06"},
};
constexpr std::string_view kBox = "02 08 48 42 02";
constexpr double kCapital = 6, kBase = 2;     // of the grid
constexpr double kBlank = 3, kBetween = 1.8;  // a space; the gap between two letters

}  // namespace

Glyph glyph_of(char character) {
    if (character == ' ') return {kBlank / kCapital, {}};
    const auto* letter = std::find_if(std::begin(kLetters), std::end(kLetters),
                                      [&](const Letter& l) { return l.character == character; });
    const std::string_view strokes = letter == std::end(kLetters) ? kBox : letter->strokes;
    Glyph glyph;
    glyph.strokes.emplace_back();
    double widest = 0;
    for (std::size_t n = 0; n + 1 < strokes.size(); n += 3) {
        const double x = strokes[n] - '0', y = strokes[n + 1] - '0' - kBase;
        widest = std::max(widest, x);
        glyph.strokes.back().push_back({x / kCapital, y / kCapital});
        if (n + 2 < strokes.size() && strokes[n + 2] == '/') glyph.strokes.emplace_back();
    }
    glyph.advance = (widest + kBetween) / kCapital;
    return glyph;
}

}  // namespace tribo::report
