// SPDX-License-Identifier: MIT
#include "readers/control/dialect.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kLookedAt = 1 << 16;  // only this many characters from the start are read

struct Sign {
    std::string_view text;
    Dialect dialect;
};
// Clear signs anywhere in a block, in the order in which they are sought. The text is in upper case and
// without blanks. First those behind which a person may write any word.
constexpr std::array kSigns{
    Sign{"O<", Dialect::linuxcnc},         Sign{"#<", Dialect::linuxcnc},
    Sign{"DPRNT[", Dialect::fanuc},        Sign{"BEGINPGM", Dialect::heidenhain},
    Sign{"TOOLCALL", Dialect::heidenhain}, Sign{"FMAX", Dialect::heidenhain},
    Sign{"TRAORI", Dialect::siemens},      Sign{"TRAFOOF", Dialect::siemens},
    Sign{"CYCLE8", Dialect::siemens},      Sign{"MCALL", Dialect::siemens},
    Sign{"MSG(", Dialect::siemens},        Sign{"STOPRE", Dialect::siemens},
    Sign{"SUPA", Dialect::siemens},        Sign{"_N_", Dialect::siemens},
    Sign{"CR=", Dialect::siemens},         Sign{"A3=", Dialect::siemens},
    Sign{"=AC(", Dialect::siemens},        Sign{"=IC(", Dialect::siemens},
    Sign{"GOTOF", Dialect::siemens},       Sign{"GOTOB", Dialect::siemens},
    Sign{"ATRANS", Dialect::siemens},      Sign{"AROT", Dialect::siemens},

    Sign{"CUT2D", Dialect::siemens},       Sign{"DIAMOF", Dialect::siemens},
    Sign{"COMPCAD", Dialect::siemens},     Sign{"COMPON", Dialect::siemens},
    Sign{"FFWON", Dialect::siemens},       Sign{"ORIWKS", Dialect::siemens},
    Sign{"WORKPIECE(", Dialect::siemens},  Sign{"EXTCALL", Dialect::siemens},
    Sign{"TURN=", Dialect::siemens},       Sign{"RND=", Dialect::siemens},
    Sign{"CHF=", Dialect::siemens},        Sign{"CHR=", Dialect::siemens},
    Sign{"T=\"", Dialect::siemens},        Sign{"$P_", Dialect::siemens},
    Sign{"$TC_", Dialect::siemens},        Sign{"G642", Dialect::siemens},
    Sign{"G500", Dialect::siemens},        Sign{"G710", Dialect::siemens},
    Sign{"M428", Dialect::linuxcnc},       Sign{"M429", Dialect::linuxcnc},
    Sign{"G43.4", Dialect::fanuc},         Sign{"G43.5", Dialect::fanuc},
    Sign{"G68.2", Dialect::fanuc},         Sign{"]GOTO", Dialect::fanuc},
    Sign{"G54.1P", Dialect::fanuc},        Sign{"]DO", Dialect::fanuc},
    Sign{"]THEN", Dialect::fanuc},         Sign{"G65P", Dialect::fanuc},
    Sign{"#3000=", Dialect::fanuc},        Sign{"M98<", Dialect::fanuc},
    Sign{"[BILLET", Dialect::fanuc},       Sign{"[TOOLDEF", Dialect::fanuc},
};

// Beginnings of a Siemens block, behind its number. A bracket behind a digit is taken for a comment.
constexpr std::string_view kSiemensBlocks[] = {
    "DEFREAL",  "DEFINT",  "DEFBOOL", "DEFSTRING", "DEFAXIS",  "DEFCHAR", "ENDIF",   "ENDFOR",
    "ENDWHILE", "ENDLOOP", "TRANSX",  "TRANSY",    "TRANSZ",   "ROTX",    "ROTY",    "ROTZ",
    "ROTRPL",   "MIRRORX", "MIRRORY", "SCALEX",    "SLOT1",    "SLOT2",   "POCKET1", "POCKET2",
    "POCKET3",  "POCKET4", "HOLES1",  "HOLES2",    "LONGHOLE", "CYCLE"};

// R1=5, X=R1, and blocks that begin with a word of that language alone.
bool looks_like_siemens(std::string_view text) {
    std::string_view block = text;
    if (block.size() > 1 && (block[0] == 'N' || block[0] == ':') && is_digit(block[1])) {
        block.remove_prefix(std::min(block.find_first_not_of("0123456789", 1), block.size()));
    }
    for (const std::string_view begin : kSiemensBlocks) {
        if (block.starts_with(begin)) return true;
    }
    const std::size_t digits = block.starts_with("R") ? block.find_first_not_of("0123456789", 1) : 1;
    if (digits > 1 && digits < block.size() && block[digits] == '=') return true;
    for (std::size_t i = text.find('='); i != std::string_view::npos; i = text.find('=', i + 1)) {
        const bool is_axis = i > 0 && text[i - 1] >= 'X' && text[i - 1] <= 'Z';
        const bool is_whole = i < 2 || is_digit(text[i - 2]) || text[i - 2] == '.' || text[i - 2] == ')';
        // M2=3, S1=500: of the second spindle, of the first one.
        const bool is_spindle = i > 1 && is_digit(text[i - 1]) && (text[i - 2] == 'M' || text[i - 2] == 'S');
        const bool is_assigned = i + 1 < text.size() && text[i + 1] != '=';
        if (is_assigned && ((is_axis && is_whole) || (is_spindle && (i == 2 || !is_letter(text[i - 3])))))
            return true;
    }
    return false;
}

// To upper case, without blanks and comments, which may stand within each other.
std::string plain(std::string_view line) {
    std::string text;
    int depth = 0;
    for (const char c : line) {
        if (c == ';') break;
        if (c == '(' && (depth > 0 || text.empty() || !is_letter(text.back()))) ++depth;
        if (depth == 0 && !is_blank(c)) text += to_upper(c);
        if (c == ')' && depth > 0) --depth;
    }
    return text;
}

// O1000, :1000, <NAME>; %O1000 where the first line holds both.
bool is_program_number(std::string_view text) {
    if (text.starts_with("%O")) text.remove_prefix(1);
    if (text.starts_with('<') && text.find('>') == text.size() - 1) return true;
    return text.size() > 1 && (text[0] == 'O' || text[0] == ':') &&
           std::all_of(text.begin() + 1, text.end(), is_digit);
}

// G81 to G89 or G73 with a depth.
bool begins_cycle(std::string_view text) {
    if (text.find('Z') == std::string_view::npos) return false;
    for (std::size_t i = text.find('G'); i != std::string_view::npos; i = text.find('G', i + 1)) {
        const std::string_view code = text.substr(i, 3);
        if (code == "G73" || (code > "G80" && code <= "G89")) return true;
    }
    return false;
}

}  // namespace

std::optional<Dialect> dialect_of(std::string_view word) {
    const auto found = std::ranges::find(kDialectWords, word);
    if (found == kDialectWords.end()) return std::nullopt;
    return static_cast<Dialect>(found - kDialectWords.begin());
}

std::string_view name_of(Dialect dialect) {
    constexpr std::string_view names[] = {"LinuxCNC", "Fanuc", "Siemens", "Heidenhain", "NUM"};
    return names[static_cast<std::size_t>(dialect)];
}

std::optional<int> line_of_isg_kernel(std::string_view bytes) {
    constexpr std::string_view begins[] = {"#VAR",   "#CSDEF",  "#CSON",  "#RTCP",
                                           "#TRAFO", "#ENDVAR", "LCYCLE["};
    TextLines lines(bytes.substr(0, kLookedAt));
    for (int number = 1; const auto line = lines.next(); ++number) {
        const std::string text = plain(*line);
        std::string_view block = text;
        if (block.starts_with('N'))
            block.remove_prefix(std::min(block.find_first_not_of("0123456789", 1), block.size()));
        const bool is_begun =
            std::ranges::any_of(begins, [&](std::string_view begin) { return block.starts_with(begin); });
        const bool has_variable =
            block.find("V.L.") != std::string_view::npos || block.find("V.P.") != std::string_view::npos;
        if (is_begun || has_variable) return number;
    }
    return std::nullopt;
}

std::optional<Dialect> detect_dialect(std::string_view bytes) {
    TextLines lines(bytes.substr(0, kLookedAt));
    bool first = true;
    std::optional<bool> has_level;  // of the first cycle
    while (const auto line = lines.next()) {
        const std::string text = plain(*line);
        if (text.empty() || text == "%") continue;
        if (std::exchange(first, false) && is_program_number(text)) return Dialect::fanuc;
        for (const Sign& sign : kSigns) {
            if (text.find(sign.text) != std::string::npos) return sign.dialect;
        }
        if (looks_like_siemens(text)) return Dialect::siemens;
        if (!has_level && begins_cycle(text)) has_level = text.find('R') != std::string::npos;
    }
    // LinuxCNC refuses a cycle without the level R at which its feed begins; controls of Fanuc's kind run it.
    if (!has_level.value_or(true)) return Dialect::fanuc;
    return std::nullopt;
}

}  // namespace tribo::readers
