// SPDX-License-Identifier: MIT
#include "readers/tools/tool_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "base/limits.hpp"
#include "readers/text/text_lines.hpp"
#include "readers/tools/folded_text.hpp"
#include "readers/tools/standard_sizes.hpp"
#include "readers/tools/text_tokens.hpp"

namespace tribo::readers {
namespace {

using namespace std::string_view_literals;

using Words = std::span<const std::string_view>;

constexpr std::array kToolWords{"TOOL"sv,        "WERKZEUG"sv, "WZ"sv,    "OUTIL"sv,
                                "HERRAMIENTA"sv, "UTENSILE"sv, "CUTTER"sv};
constexpr std::array kDiameterWords{"DIA"sv,         "DIAM"sv,    "DIAMETER"sv, "DIAMETRE"sv, "DIAMETRO"sv,
                                    "DURCHMESSER"sv, "DIAMETR"sv, "DMR"sv,      "FI"sv};
constexpr std::array kCornerWords{"CR"sv, "RC"sv, "ECKENRADIUS"sv, "ECKRADIUS"sv};
constexpr std::array kFluteWords{"FLUTE"sv,     "FLUTES"sv, "FLUITE"sv,  "FL"sv,     "FLT"sv,
                                 "FLTS"sv,      "INSERT"sv, "INSERTS"sv, "TEETH"sv,  "TOOTH"sv,
                                 "ZAHN"sv,      "ZAEHNE"sv, "ZAHNE"sv,   "ZAHNIG"sv, "SCHNEIDER"sv,
                                 "SCHNEIDEN"sv, "DENTS"sv,  "LABIOS"sv,  "FILOS"sv,  "TAGLIENTI"sv};
// The number behind one of these is no diameter.
constexpr std::array kOtherWords{"L"sv,  "LEN"sv, "LENGTH"sv, "LANGE"sv, "LAENGE"sv, "LONG"sv,  "EXT"sv,
                                 "H"sv,  "S"sv,   "F"sv,      "Z"sv,     "ZMIN"sv,   "ZMAX"sv,  "X"sv,
                                 "Y"sv,  "OFF"sv, "RPM"sv,    "FEED"sv,  "CUT"sv,    "DEPTH"sv, "STICKOUT"sv,
                                 "ID"sv, "N"sv,   "STOCK"sv,  "LEAVE"sv, "PITCH"sv,  "SHANK"sv};
// A number before one of these is no diameter.
constexpr std::array kExtents{"LOC"sv,  "OAL"sv,   "DEEP"sv, "DEPTH"sv, "TIEF"sv,  "LONG"sv, "LANG"sv,
                              "WIDE"sv, "THICK"sv, "MIN"sv,  "RPM"sv,   "SHANK"sv, "BORE"sv};
constexpr std::array kAngleWords{"TAPER"sv, "ANGLE"sv, "WINKEL"sv,  "SPITZENWINKEL"sv,
                                 "POINT"sv, "SIG"sv,   "TIPANGLE"sv};
// A number before one of these is the radius of a corner, or of a ball.
constexpr std::array kRadiusWords{"R"sv, "RAD"sv, "RADIUS"sv, "RADIUSED"sv, "RAYON"sv};
// What may stand between a size and its noun: 0.500 4FL END MILL.
constexpr std::array kBeforeNouns{"END"sv,    "FLAT"sv,    "BALL"sv, "BULL"sv, "NOSE"sv,
                                  "SQUARE"sv, "CARBIDE"sv, "HSS"sv,  "VHM"sv,  "CHAMFER"sv,
                                  "SPOT"sv,   "ROUGH"sv,   "UNC"sv,  "UNF"sv};
constexpr std::array kOffsetWords{"COMP"sv, "COMPENSATION"sv, "OFFSET"sv, "REGISTER"sv, "KORREKTUR"sv};
// Nouns of tools that are verbs, too.
constexpr std::array kWork{"DRILL"sv, "MILL"sv, "TAP"sv, "TURN"sv, "PROBE"sv, "COUNTERBORE"sv};
constexpr int kMostFlutesInText = 24;
// Less is the width of a chamfer: CHAMFER MILL .010.
constexpr double kLeastChamferMill = 0.06;
constexpr std::array kParallelPipes{"G"sv, "R"sv, "RP"sv, "BSP"sv, "BSPP"sv};
constexpr std::array kTaperPipes{"NPT"sv, "NPTF"sv, "BSPT"sv, "RC"sv};
// Threads in an inch: 10-24 TAP.
constexpr double kLeastPitch = 20;
// Whole numbers beside a noun that are sizes: ENDMILL 12, but ENDMILL 2 may be the second one.
constexpr double kLeastWholeMm = 3, kLargestWholeMm = 160;

// How plainly a text states a diameter: a higher one overrides a lower one.
enum class Plainness { none, size, name, key };

bool is_one_of(Words words, const TextToken& token) {
    return token.kind == TextToken::Kind::word &&
           std::ranges::any_of(words, [&](std::string_view word) { return token.text == word; });
}

bool is_whole_number(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, is_digit);
}

// DRILL_D8_5, MILL_D6_R0_5: names of tools may not hold a point. The number behind a size of a mill may be
// that of its teeth.
std::string with_points(std::string text) {
    const ToolShape shape = shape_in(text).shape;
    const bool is_drill = shape == ToolShape::drill || shape == ToolShape::reamer ||
                          shape == ToolShape::tap || shape == ToolShape::spot_drill ||
                          shape == ToolShape::centre_drill;
    for (std::size_t at = text.find('_'); at != std::string::npos; at = text.find('_', at + 1)) {
        std::size_t begin = at, end = at + 1;
        while (begin > 0 && is_digit(text[begin - 1])) --begin;
        while (end < text.size() && is_digit(text[end])) ++end;
        const bool is_between = begin < at && at - begin <= 2 && end > at + 1 && end - at <= 3;
        const bool goes_on = end < text.size() && is_letter(text[end]);
        if (is_between && !goes_on && (is_drill || text.substr(begin, at - begin) == "0")) text[at] = '.';
    }
    return text;
}

class TextReader {
  public:
    TextReader(std::string_view text, bool is_name)
        : text_(is_name ? with_points(folded(text)) : folded(text)),
          tokens_(tokens_of(text_)),
          is_name_(is_name) {}

    ToolText read() {
        if (read_cut_viewer()) return tool_;
        if (tokens_.size() == 1 && tokens_[0].is_number() && !tokens_[0].is_angle) {
            // "711951" is an article's number.
            tool_.is_bare_size = tokens_[0].value > 0 && !(is_name_ && tokens_[0].value > kLargestWholeMm);
            if (tool_.is_bare_size) set_diameter(tokens_[0], Plainness::size);
            return tool_;
        }
        tool_.is_for_compensation = text_.find("CONTROL COMP") != std::string::npos;
        const ShapeWords shape = shape_in(text_);
        tool_.shape = shape.shape;
        tool_.names_tool = shape.names_tool;
        if (is_about_end_mill()) {
            tool_.names_tool = true;
            if (tool_.shape == ToolShape::unstated) tool_.shape = ToolShape::flat;
        }
        for (std::size_t i = 0; i < tokens_.size();) i += take(i);
        finish();
        return tool_;
    }

  private:
    const TextToken& token(std::size_t i) const {
        static const TextToken none;
        return i < tokens_.size() ? tokens_[i] : none;
    }
    bool is_end(std::size_t i) const { return i >= tokens_.size(); }
    static bool is_fraction(const TextToken& t) { return t.is_number() && !t.is_integer && !t.is_angle; }

    // 1/2 EM, 10MM 4FL EM, EM .5: an end mill, where a size stands there. Elsewhere EM is a word of
    // Portuguese.
    bool is_about_end_mill() const {
        if (tokens_.size() == 2 && tokens_[0].is_word("EM") && is_fraction(tokens_[1])) return true;
        if (tokens_.size() < 2) return false;
        const std::size_t first = tokens_[0].is_word("T") && token(1).is_glued ? 2 : 0;
        if (!tokens_.back().is_word("EM") && !token(first + 1).is_word("EM")) return false;
        return token(first).is_number() || (token(first).is_sign('-') && token(first + 1).is_number());
    }

    // Returns the place of the number behind a key: `=`, `:`, `.`, `-`, `>`, `+` and `_` may stand between;
    // or the number of tokens if there is none.
    std::size_t number_behind(std::size_t i) const {
        for (std::size_t k = i + 1; k < tokens_.size() && k < i + 4; ++k) {
            if (tokens_[k].is_number()) return k;
            if (tokens_[k].kind == TextToken::Kind::word ||
                std::string_view("=:.->_|#+").find(tokens_[k].text[0]) == std::string_view::npos)
                break;
        }
        return tokens_.size();
    }

    void set_diameter(const TextToken& number, Plainness plainness) {
        if (!(number.value > 0) || plainness <= plainness_) return;
        tool_.diameter = StatedLength{number.value, number.unit_mm};
        plainness_ = plainness;
    }

    static bool is_tool_number(const TextToken& number) {
        return number.is_count() && kLimits.tool_number.range.contains(std::max(number.value, 1.0));
    }

    // Takes what begins at token i. Returns the number of tokens that belong to it.
    std::size_t take(std::size_t i) {
        const TextToken& t = token(i);
        if (t.kind == TextToken::Kind::word) return take_word(i);
        if (t.is_number()) return take_number(i);
        if (t.is_sign('#') && tool_.shape == ToolShape::tap && set_numbered_thread(i + 1)) return 2;
        if (i == 0 && t.is_sign('#') && token(1).is_count()) {
            // #14 [.182"] DRILL, #7 DRILL: the number of a wire gauge.
            const bool is_gauge = token(2).is_sign('[') || token(2).is_sign('(') || token(2).text == "DRILL";
            if (!is_gauge) set_number(token(i + 1));
            if (is_gauge && tool_.shape == ToolShape::drill) (void)set_gauge(token(i + 1));
            return 2;
        }
        return 1;
    }

    void set_inches(double inches) {
        TextToken size;
        size.value = inches;
        size.unit_mm = 25.4;
        set_diameter(size, Plainness::size);
    }

    // #7 DRILL, NO.7 DRILL: the wire gauge of a drill. The point of "NO." may have become that of the number.
    bool set_gauge(const TextToken& number) {
        const std::string_view digits = number.text.substr(number.text.starts_with('.') ? 1 : 0);
        const auto gauge = is_whole_number(digits) ? number_of(digits) : std::nullopt;
        if (!gauge || *gauge < 1 || *gauge > kGauges) return false;
        set_inches(gauge_drill_in(static_cast<int>(*gauge)));
        return true;
    }

    // #10-24, NO. 10-24
    bool set_numbered_thread(std::size_t i) {
        const TextToken& t = token(i);
        const std::string_view digits = t.text.substr(t.text.starts_with('.') ? 1 : 0);  // NO.10-32
        const auto number = t.is_number() && is_whole_number(digits) ? number_of(digits) : std::nullopt;
        const bool is_thread =
            number && *number <= kLargestThread && token(i + 1).is_sign('-') && token(i + 2).is_count();
        if (!is_thread) return false;
        set_inches(numbered_thread_in(*number));
        return true;
    }

    void set_number(const TextToken& number) {
        if (!tool_.number && is_tool_number(number)) tool_.number = static_cast<int>(number.value);
    }

    std::size_t take_word(std::size_t i) {
        const TextToken& t = token(i);
        const TextToken& next = token(i + 1);
        if (t.text == "T" && next.is_count() && next.is_glued && !tool_.number) {
            set_number(next);
            // T1755863337: a number of a tool library.
            if (!tool_.number && next.value > kLimits.tool_number.range.max) tool_.names_tool = true;
            number_at_ = i + 1;
            return 2;
        }
        is_about_offset_ = is_about_offset_ || is_one_of(kOffsetWords, t);
        if (is_one_of(kToolWords, t)) return take_tool_word(i);
        if (is_one_of(kDiameterWords, t)) return take_diameter(i);
        const std::size_t at = number_behind(i);
        const bool has_number = !is_end(at);
        const bool has_sign = has_number && at > i + 1;
        if (t.text == "SIZE" && has_number) {
            set_diameter(token(at), Plainness::key);
            return at - i + 1;
        }
        const bool is_d = t.text == "D";
        if ((is_d || t.text == "DM") && has_number && (has_sign || next.is_glued)) {  // DM=8, DM8
            if (is_d && !has_sign && token(at).is_integer && token(at).unit_mm == 0) {
                glued_d_ = token(at);  // a diameter, or the number of an offset
                return at - i + 1;
            }
            set_diameter(token(at), has_sign ? Plainness::key : Plainness::name);
            if (is_d && token(i + 1).is_sign('=') && tool_.number) tool_.is_for_compensation = true;
            return at - i + 1;
        }
        if (t.text == "NO" && has_number && tool_.shape == ToolShape::tap && set_numbered_thread(at))
            return at - i + 1;
        if (t.text == "NO" && has_number && tool_.shape == ToolShape::drill && set_gauge(token(at)))
            return at - i + 1;
        if (t.text == "LETTER" && next.kind == TextToken::Kind::word && next.text.size() == 1 &&
            tool_.shape == ToolShape::drill) {
            set_inches(letter_drill_in(next.text[0]));
            return 2;
        }
        // EM10, FM63
        if ((t.text == "EM" || t.text == "FM") && next.is_number() && next.is_glued) {
            tool_.names_tool = true;
            if (tool_.shape == ToolShape::unstated)
                tool_.shape = t.text == "EM" ? ToolShape::flat : ToolShape::face;
            set_diameter(next, Plainness::size);
            return 2;
        }
        if (t.text == "MM" && next.is_count() && next.is_glued) {  // MM10
            TextToken size = next;
            size.unit_mm = 1;
            set_diameter(size, Plainness::name);
            return 2;
        }
        if (t.text == "M" && tool_.shape == ToolShape::tap && next.is_number() && next.is_glued) {  // M8
            TextToken size = next;
            size.unit_mm = 1;
            set_diameter(size, Plainness::size);
            return 2;
        }
        // KR020.000 of a set-up sheet: the radius.
        if (t.text == "KR" && tool_.number && next.is_number() && next.is_glued && next.value > 0) {
            TextToken size = next;
            size.value *= 2;
            set_diameter(size, Plainness::key);
            return 2;
        }
        // R2=4: the corner radius in the tool table of a TNC.
        const bool is_r2 = t.text == "R" && next.is_count() && next.is_glued && next.value == 2 &&
                           token(i + 2).is_sign('=') && token(i + 3).is_number();
        if (is_r2) return take_corner(i, i + 3);
        const bool is_corner = is_one_of(kCornerWords, t) ||
                               (t.text == "R" && has_number && plainness_ != Plainness::none) ||
                               (t.text == "CORNER" && has_number);
        if (is_corner && has_number) return take_corner(i, at);
        if (t.text == "CORNER" || (t.text == "TIP" && next.is_word("RADIUS"))) {
            const std::size_t behind = number_behind(i + 1);
            if (!is_end(behind)) return take_corner(i, behind);
        }
        const bool is_radius = t.text == "R" || t.text == "RADIUS" || t.text == "RAYON";
        if (is_radius && has_number && !radius_) {
            radius_ = StatedLength{token(at).value, token(at).unit_mm};
            return at - i + 1;
        }
        if (is_one_of(kFluteWords, t)) return take_flutes(i, at);
        if (t.text == "Z" && next.is_count() && next.is_glued && next.value >= 1 && next.value <= 12) {
            lettered_flutes_ = static_cast<int>(next.value);
            return 2;
        }
        if (is_one_of(kAngleWords, t) && has_number && token(at).unit_mm == 0) {
            set_angle(token(at).value);
            tool_.is_taper_key = t.text == "TAPER";
            return at - i + 1;
        }
        if (is_one_of(kOtherWords, t) && has_number) {
            if (t.text == "H" && next.is_glued) offset_ = next.value;
            return at - i + 1;
        }
        return 1;
    }

    // TOOL 1, TOOL NUMBER: 1, TOOL - 1; TOOL DIAMETER and TOOL: 6mm are no numbers of tools.
    std::size_t take_tool_word(std::size_t i) {
        is_about_tool_ = true;
        is_named_ = is_named_ || token(i + 1).is_word("NAME") || token(i + 1).is_word("ID");
        std::size_t k = i;
        for (const std::string_view word : {"NUMBER", "NUM", "NO", "NR"}) {
            if (token(i + 1).is_word(word)) k = i + 1;
        }
        const std::size_t at = number_behind(k);
        if (token(i).text == "CUTTER" || is_end(at)) return 1;
        const TextToken& number = token(at);
        const bool counts = is_one_of(kFluteWords, token(at + 1)) || token(at + 1).is_sign('/');
        if (!number.is_count() || counts) return 1;
        tool_.is_number_of_library = !tool_.number && token(k + 1).is_sign('-');
        set_number(number);
        return at - i + 1;
    }

    std::size_t take_diameter(std::size_t i) {
        // DIA OUTIL = 15.
        const bool names_tool = is_one_of(kToolWords, token(i + 1));
        is_about_tool_ = is_about_tool_ || names_tool;
        const std::size_t at = number_behind(names_tool ? i + 1 : i);
        // .5 DIA 4 FLT EM, .257 DIA 135 DEG DRILL: the size stands before, another number behind.
        const bool is_other =
            !is_end(at) && (token(at).is_angle || is_one_of(kFluteWords, token(at + 1)) ||
                            is_one_of(kExtents, token(at + 1)) || is_one_of(kRadiusWords, token(at + 1)) ||
                            token(at + 1).is_word("POINT") || token(at + 1).is_word("ST"));
        if (is_other && i > 0 && token(i - 1).is_number()) {
            has_diameter_key_ = true;
            set_diameter(token(i - 1), Plainness::key);
            return 1;
        }
        if (!is_end(at)) {
            has_diameter_key_ = true;
            set_diameter(token(at), Plainness::key);
            return at - i + 1;
        }
        // 10 MM DIA END MILL; but DIA. OFF. is an offset.
        const bool is_offset = token(i + 1).is_word("OFF") || token(i + 2).is_word("OFF");
        if (i > 0 && token(i - 1).is_number() && !is_offset) set_diameter(token(i - 1), Plainness::key);
        return 1;
    }

    std::size_t take_corner(std::size_t i, std::size_t at) {
        if (!tool_.corner) tool_.corner = StatedLength{token(at).value, token(at).unit_mm};
        return at > i ? at - i + 1 : 1;
    }

    // FLUTES 3; but FLUTE LEN 16 is a length.
    std::size_t take_flutes(std::size_t i, std::size_t at) {
        if (token(i + 1).kind == TextToken::Kind::word && is_one_of(kOtherWords, token(i + 1))) return 1;
        if (is_end(at) || !token(at).is_count()) return 1;
        set_flutes(token(at).value);
        return at - i + 1;
    }

    void set_flutes(double count) {
        if (tool_.flutes == 0 && count >= 1 && count <= kMostFlutesInText)
            tool_.flutes = static_cast<int>(count);
    }
    void set_angle(double degrees) {
        if (!tool_.angle_deg && degrees > 0 && degrees < 180) tool_.angle_deg = degrees;
    }

    std::size_t take_number(std::size_t i) {
        const TextToken& t = token(i);
        std::size_t next = i + 1;
        if (token(next).is_sign('-')) ++next;
        if (t.is_count() && is_one_of(kFluteWords, token(next)) && !is_one_of(kOtherWords, token(next + 1))) {
            set_flutes(t.value);
            return next - i + 1;
        }
        // 10MM 2F EM
        const bool is_letter_f = token(i + 1).is_word("F") && token(i + 1).is_glued;
        if (t.is_count() && is_letter_f && tool_.names_tool && !token(i + 2).is_number()) {
            set_flutes(t.value);
            return 2;
        }
        // 135 POINT ANGLE, 90ST (Polish)
        const bool is_point =
            (token(i + 1).is_word("POINT") || token(i + 1).is_word("TIP")) && token(i + 2).is_word("ANGLE");
        const bool is_degrees = token(i + 1).is_word("ST") && token(i + 1).is_glued;
        if (t.is_angle || (t.unit_mm == 0 && (is_point || is_degrees))) {
            set_angle(t.value);
            return is_point ? 3 : 1;
        }
        // 1 = End Mill {6 mm}
        if (i == 0 && t.is_count() && token(1).is_sign('=') && tool_.names_tool) {
            set_number(t);
            return 2;
        }
        // 16R0.8: a diameter and its corner. 1/16 R BALL, .03 RAD: a radius.
        const bool is_glued_r = token(i + 1).is_word("R") && token(i + 1).is_glued &&
                                token(i + 2).is_number() && token(i + 2).is_glued;
        if (is_glued_r && (tool_.number || tool_.names_tool)) {
            set_diameter(t, Plainness::name);
            return 1 + take_corner(i + 1, i + 2);
        }
        const bool is_radius =
            is_one_of(kRadiusWords, token(i + 1)) && !token(i + 2).is_number() && !token(i + 2).is_sign('=');
        if (is_radius && tool_.shape == ToolShape::ball) {
            if (!radius_) radius_ = StatedLength{t.value, t.unit_mm};
            return 2;
        }
        if (is_radius && (tool_.number || tool_.names_tool) && !is_end(i + 2))
            return 1 + take_corner(i + 1, i);
        if (tool_.shape == ToolShape::tap && token(i + 2).value >= kLeastPitch && set_numbered_thread(i))
            return 3;
        const bool is_extent = is_one_of(kExtents, token(i + 1));
        if (t.unit_mm > 0 && !is_extent) {
            is_behind_number_ = is_behind_number_ || is_right_behind_number(i);
            set_diameter(t, Plainness::size);
        }
        // T0 : 1.0 and T1//15.98: nothing else in the text.
        const bool is_last = is_end(i + 1) && is_right_behind_number(i) && i > number_at_ + 1;
        if (is_last && t.unit_mm == 0) {
            is_behind_number_ = true;
            set_diameter(t, Plainness::size);
        }
        if (t.unit_mm == 0 && !is_extent) take_size_beside_noun(i);
        return 1;
    }

    // DRILL 6.8, 8.5 DRILL, BOHRER_6.8: in the name of a tool, or behind a tool's number. A whole number is a
    // size in mm where it cannot count things.
    void take_size_beside_noun(std::size_t i) {
        const auto is_joint = [](const TextToken& t) {
            return t.is_sign('_') || t.is_sign('-') || t.is_sign(':');
        };
        const auto is_noun = [](const TextToken& t) {
            return t.kind == TextToken::Kind::word && (t.text == "EM" || is_noun_of_tool(t.text));
        };
        const TextToken& number = token(i);
        const std::size_t before = i > 1 && is_joint(token(i - 1)) ? i - 2 : i - 1;
        const std::size_t after = is_joint(token(i + 1)) ? i + 2 : i + 1;
        const bool follows = i > 0 && is_noun(token(before));
        const bool leads = is_noun(token(after)) || (!number.is_integer && leads_to_noun(after));
        // HOLE-CENTERS-T3-4 - DRILL is the name of an operation: a tool's text begins with its number.
        // .125 FLAT END MILL, REAMER .250; but DRILL .5 may be what is done, and how deep.
        const bool names_it = i > 0 && before == 0 && is_end(i + 1) && !is_one_of(kWork, token(0));
        const bool is_alone = !number.is_integer && (i == 0 || names_it);
        const bool is_about_it = is_name_ || (tool_.number && number_at_ <= 1) || is_alone;
        if (!is_about_it || !(follows || leads)) return;
        if (!number.is_integer) {
            set_diameter(number, Plainness::size);
            return;
        }
        const bool is_size = number.value >= kLeastWholeMm && number.value <= kLargestWholeMm &&
                             number.value != tool_.number.value_or(0);
        const bool ends = token(i + 1).kind != TextToken::Kind::word && !token(i + 1).is_number();
        const bool begins = i == 0 || is_right_behind_number(i);
        if (!is_size || !((follows && ends) || (leads && begins))) return;
        TextToken size = number;
        size.unit_mm = 1;
        set_diameter(size, Plainness::size);
    }

    // True if adjectives and a number of flutes stand between token i and a noun.
    bool leads_to_noun(std::size_t i) const {
        for (std::size_t k = i; k < i + 6; ++k) {
            const TextToken& t = token(k);
            if (t.kind == TextToken::Kind::word && is_noun_of_tool(t.text)) return true;
            const bool counts = t.is_count() && (is_one_of(kFluteWords, token(k + 1)) || t.value < 100);
            if (!counts && !t.is_sign('-') && !is_one_of(kFluteWords, t) && !is_one_of(kBeforeNouns, t))
                return false;
        }
        return false;
    }

    // True if nothing but signs stands between the tool's number and token i.
    bool is_right_behind_number(std::size_t i) const {
        if (!tool_.number || number_at_ == 0 || i <= number_at_) return false;
        return std::all_of(
            tokens_.begin() + static_cast<std::ptrdiff_t>(number_at_) + 1,
            tokens_.begin() + static_cast<std::ptrdiff_t>(i), [](const TextToken& t) {
                return t.kind == TextToken::Kind::sign &&
                       (t.text == ":" || t.text == "/" || t.text == "=" || t.text == "|" || t.text == "-");
            });
    }

    // TOOL/MILL, diameter, corner radius, height, taper per side; TOOL/DRILL and TOOL/CHAMFER, diameter,
    // point angle, height (CutViewer, Carbide Create).
    bool read_cut_viewer() {
        if (!token(0).is_word("TOOL") || !token(1).is_sign('/') || token(2).kind != TextToken::Kind::word)
            return false;
        const std::string_view kind = token(2).text;
        std::vector<double> values;
        // A comma between digits separates here: 6.350,0.000.
        std::string rest(
            text_.substr(static_cast<std::size_t>(token(2).text.data() - text_.data()) + kind.size()));
        std::ranges::replace(rest, ',', ' ');
        for (const TextToken& t : tokens_of(rest)) {
            if (t.is_number()) values.push_back(t.value);
        }
        if (values.empty() || !(values[0] > 0)) return false;
        values.resize(std::max<std::size_t>(values.size(), 4));
        tool_.diameter = StatedLength{values[0], 0};
        tool_.names_tool = true;
        if (kind == "MILL") {
            tool_.corner = StatedLength{values[1], 0};
            tool_.shape = ToolShape::flat;
            if (values[3] > 0) {
                tool_.shape = ToolShape::taper;
                set_angle(values[3]);
                tool_.height = values[2];  // over which the cone widens from the diameter at its tip
            }
        } else if (kind == "DRILL" || kind == "CHAMFER") {
            tool_.shape = kind == "DRILL" ? ToolShape::drill : ToolShape::chamfer;
            set_angle(values[1]);
        } else {
            tool_.shape = kind == "CDRILL" ? ToolShape::centre_drill : ToolShape::form;
        }
        return true;
    }

    // H1 D1 are the numbers of offsets, and so are D05, D1 beside words about offsets and D21 beside inches.
    bool is_offset(const TextToken& number) const {
        const bool is_in_inches = tool_.diameter && tool_.diameter->unit_mm > 1;
        return number.value == offset_ || is_about_offset_ || number.text.starts_with('0') || is_in_inches;
    }

    // G1/4, NPT 1/8: a thread of pipes is wider than its name says.
    void widen_pipe_thread() {
        const auto has = [&](Words words) {
            return std::ranges::any_of(tokens_, [&](const TextToken& t) { return is_one_of(words, t); });
        };
        const bool is_taper = has(kTaperPipes);
        if (!tool_.diameter || (!is_taper && !has(kParallelPipes))) return;
        const bool is_in_inches = tool_.diameter->unit_mm > 1 || tool_.diameter->value == 1;
        const double wide_mm = is_in_inches ? pipe_thread_mm(tool_.diameter->value, is_taper) : 0;
        if (wide_mm > 0) tool_.diameter = StatedLength{wide_mm, 1};
    }

    void finish() {
        if (text_.find("WEAR COMP") != std::string::npos) tool_.is_for_compensation = false;
        if (!tool_.diameter) tool_.asks_for_size = is_about_tool_ && text_.find("SIZE") != std::string::npos;
        if (glued_d_.is_number() && !is_offset(glued_d_)) set_diameter(glued_d_, Plainness::name);
        if (tool_.corner && !tool_.diameter && tool_.shape == ToolShape::ball) {
            tool_.diameter = StatedLength{2 * tool_.corner->value, tool_.corner->unit_mm};
            plainness_ = Plainness::name;
        }
        if (radius_ && !tool_.diameter && tool_.shape == ToolShape::ball) {
            tool_.diameter = StatedLength{2 * radius_->value, radius_->unit_mm};
            plainness_ = Plainness::name;
        } else if (radius_ && !tool_.corner && tool_.diameter) {
            tool_.corner = radius_;
        }
        // R118 of a drill, R90 of a chamfer mill: the angle of its point.
        const bool has_point = tool_.shape == ToolShape::drill || tool_.shape == ToolShape::spot_drill ||
                               tool_.shape == ToolShape::centre_drill || tool_.shape == ToolShape::chamfer ||
                               tool_.shape == ToolShape::countersink;
        if (has_point && tool_.corner && tool_.diameter && tool_.corner->value > tool_.diameter->value / 2) {
            set_angle(tool_.corner->value);
            tool_.corner.reset();
        }
        if (tool_.shape == ToolShape::tap && plainness_ == Plainness::size) widen_pipe_thread();
        const bool is_chamfer = tool_.shape == ToolShape::chamfer && plainness_ == Plainness::size;
        if (is_chamfer && tool_.diameter->value < kLeastChamferMill) tool_.diameter.reset();
        if (tool_.flutes == 0 && (tool_.names_tool || plainness_ == Plainness::name))
            tool_.flutes = lettered_flutes_;
        const bool says_tool = (is_about_tool_ && (has_diameter_key_ || plainness_ == Plainness::key)) ||
                               (is_named_ && plainness_ == Plainness::name);
        tool_.names_tool = tool_.names_tool || says_tool;
        // A bare size beside a number must follow it: (T1 5 mm below the clamp) is one, (T1 at 5 mm) none.
        if (plainness_ == Plainness::size && !tool_.names_tool && !is_behind_number_) tool_.diameter.reset();
        // G38.2 Z-5 (probe): what the program does, and no tool of it.
        if (tool_.shape == ToolShape::probe && !tool_.number && !is_about_tool_) tool_.names_tool = false;
        if (tool_.shape == ToolShape::turning || tool_.shape == ToolShape::probe) tool_.diameter.reset();
    }

    std::string text_;
    std::vector<TextToken> tokens_;
    ToolText tool_;
    Plainness plainness_ = Plainness::none;
    std::optional<StatedLength> radius_;  // R or RADIUS before any diameter
    TextToken glued_d_;                   // a whole number right behind D
    double offset_ = -1;
    int lettered_flutes_ = 0;
    std::size_t number_at_ = 0;  // of the tool's number, where T stands before it
    bool is_about_tool_ = false, has_diameter_key_ = false, is_behind_number_ = false, is_named_ = false;
    bool is_about_offset_ = false;
    bool is_name_ = false;
};

}  // namespace

ToolText read_tool_text(std::string_view text, bool is_name) {
    constexpr std::size_t longest = 400;
    return TextReader(text.substr(0, longest), is_name).read();
}

}  // namespace tribo::readers
