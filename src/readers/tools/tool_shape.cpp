// SPDX-License-Identifier: MIT
#include "readers/tools/tool_shape.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

using enum ToolShape;

enum class Match {
    word,  // whole words
    part,  // also inside a word, as in German compounds
};

struct Phrase {
    std::string_view text;
    ToolShape shape;
    bool is_noun;
    Match match = Match::word;
};

// The first phrase that a text contains gives its shape: special ones stand before general ones.
constexpr std::array kPhrases{
    Phrase{"LOLLIPOP", lollipop, true},
    Phrase{"PROBE", probe, true},
    Phrase{"TASTER", probe, true, Match::part},
    Phrase{"TURNING", turning, true},
    Phrase{"TURN", turning, true},
    Phrase{"LATHE", turning, true},
    Phrase{"CNMG", turning, true},
    Phrase{"DREHMEISSEL", turning, true, Match::part},
    Phrase{"THREAD MILL", thread, true},
    Phrase{"THREADMILL", thread, true},
    Phrase{"GEWINDEFRAS", thread, true, Match::part},
    Phrase{"GEWINDEFRAES", thread, true, Match::part},
    Phrase{"GEWINDEBOHR", tap, true, Match::part},
    Phrase{"TAP", tap, true},
    Phrase{"TAPRH", tap, true},  // of the library of Mastercam
    Phrase{"TAPLH", tap, true},
    Phrase{"ROSQUEAMENTO", tap, true},
    Phrase{"TARAUD", tap, true},
    Phrase{"GWINTOWNIK", tap, true},
    Phrase{"METCHIK", tap, true},
    Phrase{"MASCHIO", tap, true},
    Phrase{"MACHO", tap, true},
    Phrase{"DOVETAIL", dovetail, true},
    Phrase{"SCHWALBENSCHWANZ", dovetail, true, Match::part},
    Phrase{"QUEUE D ARONDE", dovetail, true},
    Phrase{"COUNTERBORE", counterbore, true},
    Phrase{"COUNTER BORE", counterbore, true},
    Phrase{"COUNTERSINK", countersink, true},
    Phrase{"COUNTER SINK", countersink, true},
    Phrase{"CSINK", countersink, true},
    Phrase{"SENKER", countersink, true, Match::part},
    Phrase{"AVELLANADOR", countersink, true},
    Phrase{"SVASATORE", countersink, true},
    Phrase{"CENTER DRILL", centre_drill, true},
    Phrase{"CENTRE DRILL", centre_drill, true},
    Phrase{"CENTERDRILL", centre_drill, true},
    Phrase{"ZENTRIER", centre_drill, true, Match::part},
    Phrase{"FORET A CENTRER", centre_drill, true},
    Phrase{"BROCA DE CENTRAR", centre_drill, true},
    Phrase{"PUNTA DA CENTRO", centre_drill, true},
    Phrase{"NAWIERTAK", centre_drill, true},
    Phrase{"PONTFURO", centre_drill, true},
    Phrase{"SPOT DRILL", spot_drill, true},
    Phrase{"SPOTDRILL", spot_drill, true},
    Phrase{"SPOTTING DRILL", spot_drill, true},
    Phrase{"ANBOHRER", spot_drill, true, Match::part},
    Phrase{"FORET A POINTER", spot_drill, true},
    Phrase{"SPOT", spot_drill, false},
    Phrase{"SLOT DRILL", flat, true},
    Phrase{"MILL DRILL", flat, true},
    Phrase{"FRASBOHRER", flat, true, Match::part},
    Phrase{"FRAESBOHRER", flat, true, Match::part},
    // Umlauts that FreeCAD's labels lose: Fr__sbohrer.
    Phrase{"FR SBOHRER", flat, true},
    Phrase{"FR SER", flat, true, Match::part},
    Phrase{"REAMER DRILL", drill, true},
    Phrase{"REAMER", reamer, true},
    Phrase{"REIBAHLE", reamer, true, Match::part},
    Phrase{"ALESOIR", reamer, true},
    Phrase{"ESCARIADOR", reamer, true},
    Phrase{"ALESATORE", reamer, true},
    Phrase{"ROZWIERTAK", reamer, true},
    Phrase{"BORING BAR", boring, true},
    Phrase{"BORE BAR", boring, true},
    Phrase{"BORING HEAD", boring, true},
    Phrase{"AUSDREH", boring, true, Match::part},
    Phrase{"CORNER ROUNDING", corner_rounding, false},
    Phrase{"RADIUS MILL", corner_rounding, true},
    Phrase{"VIERTELKREIS", corner_rounding, true, Match::part},
    Phrase{"FORM MILL", form, true},
    Phrase{"TAPERED", taper, false},
    Phrase{"TAPER", taper, false},
    Phrase{"KEGELFRAS", taper, true, Match::part},
    Phrase{"KONISCH", taper, false, Match::part},
    Phrase{"CONIQUE", taper, false},
    Phrase{"CONICA", taper, false},
    Phrase{"CONICO", taper, false},
    Phrase{"V BIT", v, true},
    Phrase{"VBIT", v, true},
    Phrase{"V CUTTER", v, true},
    Phrase{"V GROOVE", v, false},
    Phrase{"V CARVE", v, false},
    Phrase{"CHAMFER", chamfer, false},
    Phrase{"FASENFRAS", chamfer, true, Match::part},
    Phrase{"FAZOWNIK", chamfer, true},
    Phrase{"FASFRAS", chamfer, true, Match::part},
    Phrase{"CHANFREIN", chamfer, false},
    Phrase{"BISELADO", chamfer, false},
    Phrase{"SMUSSO", chamfer, false},
    Phrase{"ENGRAVER", engraver, true},
    Phrase{"GRAWER", engraver, true},
    Phrase{"ENGRAV", engraver, false, Match::part},
    Phrase{"GRAVIERSTICHEL", engraver, true, Match::part},
    Phrase{"GRAVIER", engraver, false, Match::part},
    Phrase{"BARREL", barrel, false},
    Phrase{"TONNENFRAS", barrel, true, Match::part},
    Phrase{"LENS", lens, false},
    Phrase{"LINSENFRAS", lens, true, Match::part},
    Phrase{"SLOT MILL", slot, true},
    Phrase{"T SLOT", slot, false},
    Phrase{"SLITTING SAW", slot, true},
    Phrase{"WOODRUFF", slot, false},
    Phrase{"KEYSEAT", slot, false},
    Phrase{"SCHEIBENFRAS", slot, true, Match::part},
    Phrase{"DRILL", drill, true},
    Phrase{"DRILLBIT", drill, true},
    Phrase{"DRL", drill, true},
    Phrase{"CSIGAFURO", drill, true},
    Phrase{"BOHRER", drill, true, Match::part},
    Phrase{"FORET", drill, true},
    Phrase{"BORR", drill, true, Match::part},
    Phrase{"BROCA", drill, true},
    Phrase{"BROCACAO", drill, true},
    Phrase{"PUNTA ELICOIDALE", drill, true},
    Phrase{"WIERTLO", drill, true},
    Phrase{"SVERLO", drill, true},
    Phrase{"FACE MILL", face, true},
    Phrase{"FACEMILL", face, true},
    Phrase{"PLANFRAS", face, true, Match::part},
    Phrase{"PLANFRAES", face, true, Match::part},
    Phrase{"MESSERKOPF", face, true, Match::part},
    Phrase{"SHELL MILL", face, true},
    Phrase{"SURFACER", face, true},
    Phrase{"FLY CUTTER", face, true},
    Phrase{"FLYCUTTER", face, true},
    Phrase{"FRAISE A SURFACER", face, true},
    Phrase{"GLOWICA", face, true},
    Phrase{"BALL END", ball, true},
    Phrase{"BALL NOSE", ball, true},
    Phrase{"BULL NOSE", bull, true},
    Phrase{"BALL", ball, false},
    Phrase{"BALLNOSE", ball, true},
    Phrase{"BALLEND", ball, true},
    Phrase{"BALLMILL", ball, true},
    Phrase{"KUGEL", ball, false, Match::part},
    Phrase{"RADIUSFRAS", ball, true, Match::part},
    Phrase{"VOLLRADIUS", ball, false, Match::part},
    Phrase{"FULLR", ball, false, Match::part},
    Phrase{"HEMISPHERI", ball, false, Match::part},
    Phrase{"SPHERIQUE", ball, false},
    Phrase{"BOULE", ball, false},
    Phrase{"ESFERIC", ball, false, Match::part},
    Phrase{"SFERIC", ball, false, Match::part},
    Phrase{"KULIST", ball, true, Match::part},
    Phrase{"BULL", bull, false},
    Phrase{"BULLNOSE", bull, true},
    Phrase{"TORUS", bull, false, Match::part},
    Phrase{"TOROID", bull, false, Match::part},
    Phrase{"TORIQUE", bull, false},
    Phrase{"TORIC", bull, false, Match::part},
    Phrase{"TIPRAD", bull, false},
    Phrase{"TIPRADIUSED", bull, false},
    Phrase{"ECKRADIUS", bull, false, Match::part},
    Phrase{"FLAT", flat, false},
    Phrase{"SQUARE", flat, false},
    Phrase{"ENDMILL", flat, true},
    Phrase{"MILL", flat, true},
    Phrase{"CUTTER", flat, true},
    Phrase{"BIT", flat, true},
    Phrase{"SLOTTER", flat, true},
    Phrase{"FRAS", flat, true, Match::part},
    Phrase{"FRAES", flat, true, Match::part},
    Phrase{"FRAISE", flat, true},
    Phrase{"FRESA", flat, true},
    Phrase{"FREZ", flat, true},
    Phrase{"FREZA", flat, true},
    Phrase{"FREES", flat, true},
    Phrase{"WALCOWY", flat, true},
    Phrase{"PALCOWY", flat, true},
    Phrase{"MARO", flat, true},
};
// Of these nouns alone the shape is not known: an end mill, or any other.
constexpr std::array<std::string_view, 3> kAnyTool{"CUTTER", "BIT", "MILL"};

struct Name {
    ToolShape shape;
    std::string_view text;
};
constexpr std::array kNames{
    Name{unstated, "tool"},
    Name{flat, "flat end mill"},
    Name{ball, "ball end mill"},
    Name{bull, "bull nose end mill"},
    Name{face, "face mill"},
    Name{taper, "tapered mill"},
    Name{v, "V-bit"},
    Name{chamfer, "chamfer mill"},
    Name{countersink, "countersink"},
    Name{drill, "drill"},
    Name{spot_drill, "spot drill"},
    Name{centre_drill, "centre drill"},
    Name{engraver, "engraver"},
    Name{dovetail, "dovetail mill"},
    Name{lens, "lens mill"},
    Name{barrel, "barrel mill"},
    Name{lollipop, "lollipop mill"},
    Name{thread, "thread mill"},
    Name{slot, "slot mill"},
    Name{corner_rounding, "corner-rounding mill"},
    Name{form, "form mill"},
    Name{reamer, "reamer"},
    Name{tap, "tap"},
    Name{boring, "boring bar"},
    Name{counterbore, "counterbore"},
    Name{probe, "probe"},
    Name{turning, "turning tool"},
};

// Returns the words alone, each between single blanks. The TAPER of `TAPER=118DEG` is a key and no word.
std::string words_of(std::string_view text) {
    std::string words = " ";
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (is_letter(text[at])) {
            words += text[at];
        } else if (words.back() != ' ') {
            if (text[at] == '=' && words.ends_with(" TAPER")) words.resize(words.size() - 5);
            if (words.back() != ' ') words += ' ';
        }
    }
    if (words.back() != ' ') words += ' ';
    return words;
}

bool contains(std::string_view words, const Phrase& phrase) {
    for (std::size_t at = words.find(phrase.text); at != std::string_view::npos;
         at = words.find(phrase.text, at + 1)) {
        const bool is_whole = words[at - 1] == ' ' && words[at + phrase.text.size()] == ' ';
        if (is_whole || phrase.match == Match::part) return true;
    }
    return false;
}

}  // namespace

ShapeWords shape_in(std::string_view folded_text) {
    const std::string words = words_of(folded_text);
    ShapeWords found;
    for (const Phrase& phrase : kPhrases) {
        if (!contains(words, phrase)) continue;
        bool is_any = false;
        for (const std::string_view any : kAnyTool) is_any = is_any || phrase.text == any;
        if (found.shape == unstated && !is_any) found.shape = phrase.shape;
        found.names_tool = found.names_tool || phrase.is_noun;
    }
    const bool is_end_mill = words.find(" END MILL ") != std::string::npos;
    if (found.shape == unstated && is_end_mill) found.shape = flat;
    return found;
}

bool is_noun_of_tool(std::string_view folded_word) {
    const std::string word = words_of(folded_word);
    return std::ranges::any_of(
        kPhrases, [&](const Phrase& phrase) { return phrase.is_noun && contains(word, phrase); });
}

std::string_view name_of(ToolShape shape) {
    for (const Name& name : kNames) {
        if (name.shape == shape) return name.text;
    }
    return kNames[0].text;
}

}  // namespace tribo::readers
