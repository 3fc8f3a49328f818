// SPDX-License-Identifier: MIT
// Words of a block: an address with its value, a keyword, a call.
#include <algorithm>
#include <array>
#include <cmath>

#include "readers/siemens/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr int kDeepestMacro = 8;

// Keywords without effect on the path: look-ahead, smoothing and jerk, feed forward, dynamics, compressors,
// interpolation of the orientation, spindles and their modes, messages, protection zones, channels, display.
constexpr std::string_view kSilent[] = {
    "MSG",          "PRINT",      "PRINTLN",   "CP",         "PTP",      "PTPG0",       "TOWSTD",
    "TOWMCS",       "TOWWCS",     "TOWBCS",    "TOWTCS",     "TOWKCS",   "FENDNORM",    "STOPRE",
    "SOFT",         "SOFTA",      "BRISK",     "BRISKA",     "DRIVE",    "DRIVEA",      "FFWON",
    "FFWOF",        "COMPCAD",    "COMPON",    "COMPCURV",   "COMPOF",   "COMPSURF",    "COMPPATH",
    "ORIWKS",       "ORIMKS",     "ORIAXES",   "ORIVECT",    "ORIPLANE", "ORISON",      "ORISOF",
    "ORIPATH",      "ORIPATHS",   "ORIROTC",   "ORID",       "ORIVIRT1", "ORIVIRT2",    "ORICONIO",
    "ORICONTO",     "ORIROTA",    "CFTCP",     "CFC",        "CFIN",     "UPATH",       "SPATH",
    "FIFOCTRL",     "STARTFIFO",  "STOPFIFO",  "DIAMOF",     "DIAM90",   "DIAMCYCOF",   "DIAMCHANA",
    "CUTDD",        "CUTCONON",   "CUTCONOF",  "NORM",       "KONT",     "KONTC",       "KONTT",
    "DYNNORM",      "DYNROUGH",   "DYNFINISH", "DYNSEMIFIN", "DYNPOS",   "DYNPREC",     "CYCLE832",
    "RTLION",       "RTLIOF",     "CDON",      "CDOF",       "CDOF2",    "GROUP_BEGIN", "GROUP_END",
    "GROUP_ADDEND", "SETMS",      "WALIMON",   "WALIMOF",    "SPCON",    "SPCOF",       "SPINON",
    "SPINOF",       "MEAS",       "SETAL",     "SBLON",      "SBLOF",    "DISPLOF",     "DISPLON",
    "SAVE",         "ACTBLOCNO",  "ASPLINEON", "BAUTO",      "BNAT",     "BTAN",        "EAUTO",
    "ENAT",         "ETAN",       "PAROT",     "PAROTOF",    "WAITM",    "WAITP",       "WAITS",
    "WAITMC",       "SETM",       "CLEARM",    "INIT",       "START",    "WAITE",       "GET",
    "GETD",         "RELEASE",    "EXTERN",    "TCARR",      "TCOABS",   "TCOFR",       "TCOFRX",
    "TCOFRY",       "TCOFRZ",     "TOFFON",    "TOFFOF",     "PDELAYON", "PDELAYOF",    "SON",
    "SPOF",         "F_SAVE_ORI", "CPRECON",   "CPRECOF",    "FNORM",    "FLIN",        "FCUB",
    "FPO",          "DISABLE",    "ENABLE",    "CLRINT",     "LIFTFAST", "TRAILON",     "TRAILOF",
    "COUPON",       "COUPOF",     "CANCEL",    "NEWCONF",    "DELDTG",   "IPTRLOCK",    "IPTRUNLOCK",
    "POLFMASK",     "POLFMLIN",   "LFON",      "LFOF",       "LFTXT",    "LFPOS",       "LFWP",
    "CPROT",        "CPROTDEF",   "PROTA",     "PROTS",      "STRINGIS", "CALCPOSI",    "VELOLIMA",
    "ACCLIMA",      "JERKLIMA",   "SYNFCT",    "F_HEAD",     "WRITE",    "DELETE",      "MMC",
    "G_INFO",       "STOLF",      "CTOLG0",    "CADIS",      "ADDFRAME", "REPOSA",      "OEMIPO1",
    "ORICURINV",
};

struct Refused {
    std::string_view word, what, remedy;
};
constexpr std::string_view kPlain = "let the CAM system write the path with G0 to G3";
constexpr std::string_view kFrames = "write TRANS and ROT";
constexpr Refused kRefused[] = {
    {"TRAANG", "an inclined axis", kPlain},
    {"TRACON", "chained transformations", kPlain},
    {"ORICURVE", "the tool's axis along a second curve", "let the CAM system write A3 B3 C3"},
    {"INVCW", "involutes", kPlain},
    {"INVCCW", "involutes", kPlain},
    {"OFFN", "an offset contour", kPlain},
    {"ROTS", "frames by solid angles", kFrames},
    {"AROTS", "frames by solid angles", kFrames},
    {"CROTS", "frames by solid angles", kFrames},
    {"TOFRAMEX", "frames whose X lies along the tool", "write TOFRAME"},
    {"TOFRAMEY", "frames whose Y lies along the tool", "write TOFRAME"},
    {"TOROTX", "frames whose X lies along the tool", "write TOROT"},
    {"TOROTY", "frames whose Y lies along the tool", "write TOROT"},
    {"MEAW", "moves that end where a probe touches", "take the measurement out of the program"},
    {"REPOS", "the return to a contour", kPlain},
    {"ISOCALL", "programs of another control", "copy its path into this program"},
    {"PUNCH", "punching", "only milling is read"},
    {"DIAMON", "diameters of a lathe", "only milling is read"},
    {"GEOAX", "other axes in the place of X, Y and Z", kPlain},
};

// Frames along the tool, and their end.
constexpr std::string_view kToolFrames[] = {"TOROT", "TOROTZ", "TOFRAME", "TOFRAMEZ", "TOROTOF", "TOFRAMEOF"};

constexpr std::string_view kFrameWords[] = {"TRANS", "ATRANS", "ROT",    "AROT",
                                            "SCALE", "ASCALE", "MIRROR", "AMIRROR"};

struct NamedMotion {
    std::string_view word;
    Motion motion;
};
constexpr NamedMotion kMotions[] = {
    {"CIP", Motion::through_point}, {"CT", Motion::tangent},    {"BSPLINE", Motion::bspline},
    {"ASPLINE", Motion::akima},     {"CSPLINE", Motion::cubic}, {"POLY", Motion::poly},
};

bool is_cycle(std::string_view name) {
    return name == "WORKPIECE" || name.starts_with("CYCLE") || name.starts_with("HOLES") ||
           name.starts_with("POCKET") || name.starts_with("SLOT") || name == "LONGHOLE";
}

template <std::size_t N>
bool is_word_of(const std::string_view (&words)[N], std::string_view name) {
    return std::find(std::begin(words), std::end(words), name) != std::end(words);
}

}  // namespace

Result<void> Interpreter::read_words(Cursor& in, Words& words, int depth) {
    while (!in.at_end()) {
        if (auto done = read_word(in, words, depth); !done) return done;
    }
    return {};
}

Result<void> Interpreter::read_word(Cursor& in, Words& words, int depth) {
    const char c = in.peek_after_blanks();
    if (c == '$') return assign_system(in);
    if (c == '(') {  // of other dialects: a comment
        if (path_.first(kComment)) {
            path_.warn(line_number(), "text in parentheses is taken as a comment; Siemens writes ';'");
        }
        const std::size_t begin = in.at + 1;
        if (auto done = skip_parentheses(in); !done) return done;
        path_.notes.read(in.line.substr(begin, in.at - begin - 1), line_number());
        return {};
    }
    if (c == '@') {
        return in.refuse(in.at, "@ codes of the Sinumerik 8xx are not read", "write it for an 840D");
    }
    if (is_letter(c) || c == '_') return read_name(in, words, depth);
    return in.refuse(in.at, shown_character(c) + " does not belong here", "correct or delete it");
}

// Skips "(...)" with what it holds.
Result<void> Interpreter::skip_parentheses(Cursor& in) {
    const std::size_t begin = in.at;
    int depth = 0;
    bool is_quoted = false;
    for (; in.at < in.line.size(); ++in.at) {
        const char c = in.line[in.at];
        if (c == '"') is_quoted = !is_quoted;
        if (is_quoted) continue;
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (depth == 0) {
            ++in.at;
            return {};
        }
    }
    return in.refuse(begin, "the parenthesis does not close", "close it");
}

// A letter with its number (X10, G1), a name with '=', '[' or '(' behind it, or a name alone.
Result<void> Interpreter::read_name(Cursor& in, Words& words, int depth) {
    const std::size_t at = in.at;
    const std::string name = name_at(in);
    std::size_t behind = at + name.size();
    while (behind < in.line.size() && is_blank(in.line[behind])) ++behind;
    const char next = behind < in.line.size() ? in.line[behind] : '\0';
    const bool is_equal = next == '=' && !(behind + 1 < in.line.size() && in.line[behind + 1] == '=');
    std::size_t digits = at + 1;
    while (digits < at + name.size() && is_digit(in.line[digits])) ++digits;
    const bool is_numbered = digits > at + 1 && name[0] != '_';  // R1, G1X, CYCLE81: no
    const bool is_address = name.size() == 1 || (is_numbered && digits == at + name.size());
    const bool is_own =
        variables_.find(name) != nullptr || macros_.contains(name) || text_.unit_named(name) != nullptr;
    if (is_equal && (!is_numbered || is_address || is_own)) {
        in.at = behind + 1;
        return read_named_value(in, name, at, words);
    }
    if (next == '[' && (!is_numbered || is_own)) {
        in.at = behind + 1;
        return read_indexed(in, name, at, words);
    }
    if (const auto macro = macros_.find(name); macro != macros_.end()) {
        if (depth > kDeepestMacro) return in.refuse(at, "DEFINE leads to itself", "correct it");
        in.at = at + name.size();
        const std::string text = macro->second;
        if (auto cause = limit_.count(text.size())) {
            is_over_ = true;
            return path_.refuse(place(1), *std::move(cause), RunLimit::kRemedy);
        }
        Cursor inner = in;
        inner.line = text;
        inner.at = 0;
        return read_words(inner, words, depth + 1);
    }
    // A name has two letters; M6 (TEXT) is a word with a comment.
    const bool is_called = next == '(' && (!is_address || name[0] == 'L');
    const bool is_program = is_called || text_.unit_named(name) != nullptr;
    if (name[0] != '_' && (name.size() == 1 || is_numbered) && !is_program) {
        in.at = at + 1;
        if (name[0] == 'L' && is_numbered && is_address) {  // L100: a subprogram
            in.at = at + name.size();
            words.call.emplace();
            words.call->name = name;
            words.call->line = line_number();
            words.call->column = static_cast<int>(at) + 1;
            return {};
        }
        in.skip_blanks();
        std::size_t end = in.at;
        if (end < in.line.size() && (in.line[end] == '-' || in.line[end] == '+')) ++end;
        while (end < in.line.size() && (is_digit(in.line[end]) || in.line[end] == '.')) ++end;
        const auto value = number_of(in.line.substr(in.at, end - in.at));
        if (!value) return in.refuse(at, std::string(1, name[0]) + " without a number", "write its number");
        in.at = end;
        return take_address(in, std::string(1, name[0]), {*value, Measure::modal, static_cast<int>(at) + 1},
                            words);
    }
    in.at = at + name.size();
    if (name == "FGROUP") return group_feed(in);
    const auto known = read_keyword(in, name, words);
    if (!known) return std::unexpected(known.error());
    if (*known) return {};
    if (words.call) {
        return in.refuse(at, "the word " + name.substr(0, 31) + " is not known",
                         "delete it where it does not move the tool");
    }
    if (!is_cycle(name) && text_.unit_named(name) == nullptr) {  // not at hand: what is given does not matter
        words.call.emplace();
        words.call->name = name;
        words.call->line = line_number();
        words.call->column = static_cast<int>(at) + 1;
        words.call->has_list = in.peek_after_blanks() == '(';
        return words.call->has_list ? skip_parentheses(in) : Result<void>{};
    }
    auto call = call_at(in, name, at);
    if (!call) return std::unexpected(call.error());
    words.call = *std::move(call);
    return {};
}

// Returns false for a name that is no word of the language.
Result<bool> Interpreter::read_keyword(Cursor& in, const std::string& name, Words& words) {
    const std::size_t at = in.at - name.size();
    const auto skip_rest = [&]() -> Result<bool> {
        if (in.peek_after_blanks() != '(') return true;
        if (auto done = skip_parentheses(in); !done) return std::unexpected(done.error());
        return true;
    };
    if (name.starts_with("CUT2D") || name.starts_with("CUT3D")) {
        is_spatial_ = name.starts_with("CUT3D");
        return true;
    }
    if (name == "ORIEULER" || name.starts_with("ORIRPY")) {
        euler_ = name == "ORIEULER";
        euler_stated_ = true;
        return true;
    }
    if (is_word_of(kSilent, name)) return skip_rest();
    if (is_word_of(kToolFrames, name)) {
        words.tool_frame = name;
        return true;
    }
    if (is_word_of(kFrameWords, name)) {
        words.frame = name;
        return true;
    }
    for (const NamedMotion& known : kMotions) {
        if (known.word != name) continue;
        words.motion = known.motion;
        return true;
    }
    if (name == "SUPA") {
        words.machine_place = true;
        return true;
    }
    if (name == "TRAORI" || name == "TRAFOOF") {
        words.tip_control = name == "TRAORI";
        return skip_rest();
    }
    if (name == "TRACYL") {
        auto call = call_at(in, name, at);
        if (!call) return std::unexpected(call.error());
        words.cylinder = *std::move(call);
        return true;
    }
    if (name == "TRANSMIT") {
        words.is_polar = true;
        return skip_rest();
    }
    if (name == "RET") {
        words.m.push_back({17, static_cast<int>(at) + 1});
        return skip_rest();
    }
    for (const Refused& refused : kRefused) {
        if (refused.word != name) continue;
        return in.refuse(at, name + " (" + std::string(refused.what) + ") is not read",
                         std::string(refused.remedy));
    }
    return false;
}

}  // namespace tribo::readers::siemens
