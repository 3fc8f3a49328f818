// SPDX-License-Identifier: MIT
#include "readers/siemens/siemens_text.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

struct Replacement {
    std::string_view word, by;
};
// Words of more than one letter, with their replacement. Parentheses after them are removed too.
constexpr std::array kReplaced{
    Replacement{"TRAORI", "G43.5"}, Replacement{"TRAFOOF", "G49"}, Replacement{"SUPA", "G53"},
    Replacement{"TRANS", "G52"},    Replacement{"RET", "M2"},
};
// Words without effect on the path: messages, look-ahead, smoothing, orientation control between two vectors.
constexpr std::array<std::string_view, 40> kSilent{
    "MSG",       "STOPRE",     "SOFT",     "BRISK",     "DRIVE",  "FFWON",   "FFWOF",   "COMPCAD",
    "COMPON",    "COMPCURV",   "COMPOF",   "ORIWKS",    "ORIMKS", "ORIAXES", "ORIVECT", "ORISON",
    "ORISOF",    "CFTCP",      "CFC",      "CFIN",      "UPATH",  "SPATH",   "FGROUP",  "FGREF",
    "FIFOCTRL",  "DIAMOF",     "CUTDD",    "CUT2D",     "NORM",   "KONT",    "DYNNORM", "DYNROUGH",
    "DYNFINISH", "DYNSEMIFIN", "CYCLE832", "WORKPIECE", "RTLION", "RTLIOF",  "ADIS",    "ADISPOS",
};
struct Refused {
    std::string_view word, what, remedy;
};
constexpr std::string_view kUpright = "let the CAM system write the path with TRAORI and A3 B3 C3";
constexpr std::string_view kPlain = "let the CAM system write it as G0 to G3 moves";
constexpr std::array kRefused{
    Refused{"CYCLE800", "swivelled planes", kUpright},
    Refused{"ROT", "turned frames", kUpright},
    Refused{"AROT", "turned frames", kUpright},
    Refused{"ATRANS", "added frames", "use TRANS"},
    Refused{"MIRROR", "mirrored frames", kPlain},
    Refused{"AMIRROR", "mirrored frames", kPlain},
    Refused{"SCALE", "scaled frames", kPlain},
    Refused{"ASCALE", "scaled frames", kPlain},
    Refused{"MCALL", "cycles", kPlain},
    Refused{"CIP", "arcs through three points", kPlain},
    Refused{"CT", "tangential arcs", kPlain},
    Refused{"AR", "arcs by their angle", kPlain},
    Refused{"BSPLINE", "splines", kPlain},
    Refused{"CSPLINE", "splines", kPlain},
    Refused{"ASPLINE", "splines", kPlain},
    Refused{"POLY", "polynomials", kPlain},
    Refused{"RND", "rounded corners", kPlain},
    Refused{"CHF", "chamfers", kPlain},
    Refused{"CHR", "chamfers", kPlain},
    Refused{"DEF", "variables with names", "use R parameters"},
    Refused{"IF", "branches", "let the CAM system write the path without them"},
    Refused{"ELSE", "branches", "let the CAM system write the path without them"},
    Refused{"WHILE", "loops", "let the CAM system write the path without them"},
    Refused{"FOR", "loops", "let the CAM system write the path without them"},
    Refused{"LOOP", "loops", "let the CAM system write the path without them"},
    Refused{"REPEAT", "repeats", "let the CAM system write the path without them"},
    Refused{"GOTOF", "jumps", "let the CAM system write the path without them"},
    Refused{"GOTOB", "jumps", "let the CAM system write the path without them"},
    Refused{"GOTO", "jumps", "let the CAM system write the path without them"},
    Refused{"EXTCALL", "calls of other programs", "copy that program into this one"},
    Refused{"CALL", "calls of other programs", "copy that program into this one"},
};
// G codes with another number: units with and without feeds, exact stop and smoothing (ignored), no work
// offset.
constexpr std::array kCodes{
    Replacement{"G70", "G20"},  Replacement{"G71", "G21"}, Replacement{"G700", "G20"},
    Replacement{"G710", "G21"}, Replacement{"G60", ""},    Replacement{"G9", ""},
    Replacement{"G601", ""},    Replacement{"G602", ""},   Replacement{"G603", ""},
    Replacement{"G64", ""},     Replacement{"G641", ""},   Replacement{"G642", ""},
    Replacement{"G643", ""},    Replacement{"G644", ""},   Replacement{"G645", ""},
    Replacement{"G500", ""},    Replacement{"G450", ""},   Replacement{"G451", ""},
    Replacement{"G290", ""},    Replacement{"M17", "M2"},  Replacement{"G153", "G53"},
};

bool is_name(char c) {
    return is_letter(c) || is_digit(c) || c == '_';
}

// Returns the position after the ')' that closes the parenthesis at `at`; none if it is not closed.
std::optional<std::size_t> parenthesis_end(std::string_view line, std::size_t at) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = at; i < line.size(); ++i) {
        if (line[i] == '"') quoted = !quoted;
        if (quoted) continue;
        depth += line[i] == '(' ? 1 : line[i] == ')' ? -1 : 0;
        if (depth == 0) return i + 1;
    }
    return std::nullopt;
}

class Rewriter {
  public:
    Rewriter(std::string_view line, int number, const std::string& source_name, std::string& out)
        : line_(line), number_(number), source_name_(source_name), out_(out) {}

    Result<void> run() {
        const std::string_view text = trimmed(line_);
        if (text.starts_with("%") || text.starts_with("PROC") || text.starts_with("proc")) return {};
        if (!text.empty() && text[0] == ':') {  // block number of a main block
            at_ = static_cast<std::size_t>(text.data() - line_.data()) + 1;
            out_.append(at_, ' ');
            while (at_ < line_.size() && is_digit(line_[at_])) copy_blank(1);
        }
        dwells_ = is_dwell();
        while (at_ < line_.size()) {
            const char c = line_[at_];
            if (c == ';') {
                out_ += line_.substr(at_);
                return {};
            }
            if (!is_letter(c)) {
                if (c == '(' || c == ')' || c == '"' || c == '$' || c == '[') {
                    return refuse(at_, shown_character(c) + " does not belong here", "correct or delete it");
                }
                out_ += c;
                ++at_;
                continue;
            }
            if (auto done = word(); !done) return done;
        }
        return {};
    }

  private:
    std::unexpected<Error> refuse(std::size_t at, std::string cause, std::string remedy) const {
        return fail_at(source_name_, number_, static_cast<int>(at) + 1, std::move(cause), std::move(remedy));
    }

    void copy_blank(std::size_t count) {
        out_.append(count, ' ');
        at_ += count;
    }

    // Writes the replacement of line_[at_, end).
    void put(std::string_view by, std::size_t end) {
        const std::size_t width = end - at_;
        out_ += by;
        if (by.size() < width) out_.append(width - by.size(), ' ');
        at_ = end;
    }

    // G4 F2: seconds, not a feed.
    bool is_dwell() const {
        std::string text;
        for (const char c : line_) {
            if (c == ';') break;
            text += to_upper(c);
        }
        for (const std::string_view code : {"G4", "G04"}) {
            const std::size_t at = text.find(code);
            if (at == std::string::npos || (at > 0 && is_name(text[at - 1]))) continue;
            const std::size_t after = at + code.size();
            if (after == text.size() || (!is_digit(text[after]) && text[after] != '.')) return true;
        }
        return false;
    }

    Result<void> word() {
        std::size_t letters = at_;
        while (letters < line_.size() && (is_letter(line_[letters]) || line_[letters] == '_')) ++letters;
        std::size_t end = letters;
        while (end < line_.size() && is_name(line_[end])) ++end;
        std::string name(line_.substr(at_, end - at_));
        std::transform(name.begin(), name.end(), name.begin(), to_upper);
        std::size_t next = end;
        while (next < line_.size() && is_blank(line_[next])) ++next;
        const bool assigned =
            next < line_.size() && line_[next] == '=' && !(next + 1 < line_.size() && line_[next + 1] == '=');
        const bool is_long = letters - at_ > 1;
        if (assigned) return assignment(name, next);
        if (is_long) return keyword(name, end);
        if (name[0] == 'G' || name[0] == 'M') {
            for (const Replacement& code : kCodes) {
                if (name != code.word || (end < line_.size() && line_[end] == '.')) continue;
                put(code.by, end);
                return {};
            }
        }
        if (name[0] == 'D' && name.size() > 1) {  // cutting edge of the tool
            put("", end);
            return {};
        }
        if (name[0] == 'L' && name.size() > 1) {
            return refuse(at_, "subprograms of other files are not at hand",
                          "copy that program into this one");
        }
        out_ += dwells_ && name[0] == 'F' ? 'P' : to_upper(line_[at_]);
        ++at_;
        while (at_ < line_.size() && (is_digit(line_[at_]) || line_[at_] == '.' || is_blank(line_[at_]) ||
                                      line_[at_] == '-' || line_[at_] == '+')) {
            out_ += line_[at_++];
        }
        return {};
    }

    Result<void> keyword(const std::string& name, std::size_t end) {
        std::size_t next = end;
        while (next < line_.size() && is_blank(line_[next])) ++next;
        std::size_t after = end;
        bool empty = false;
        if (next < line_.size() && line_[next] == '(') {
            const auto close = parenthesis_end(line_, next);
            if (!close) return refuse(next, "the parenthesis does not close", "close it");
            after = *close;
            empty = trimmed(line_.substr(next + 1, after - next - 2)).empty();
        }
        for (const Replacement& replaced : kReplaced) {
            if (name != replaced.word) continue;
            const bool alone = name == "TRANS" && trimmed(line_.substr(after)).empty();
            put(alone ? "G52 X0 Y0 Z0" : replaced.by, after);
            return {};
        }
        if (name == "CYCLE800" && empty) {
            put("", after);
            return {};
        }
        if (std::find(kSilent.begin(), kSilent.end(), name) != kSilent.end()) {
            put("", after);
            return {};
        }
        for (const Refused& refused : kRefused) {
            if (name != refused.word) continue;
            return refuse(at_, name + " (" + std::string(refused.what) + ") is not read yet",
                          std::string(refused.remedy));
        }
        if (name.starts_with("CYCLE") || name.starts_with("HOLES") || name.starts_with("POCKET")) {
            return refuse(at_, name + " (cycles) is not read yet", std::string(kPlain));
        }
        if (next < line_.size() && line_[next] == ':') {
            put("", next + 1);  // a label; jumps to labels are refused
            return {};
        }
        return refuse(at_, "the word " + name.substr(0, 20) + " is not known",
                      "delete it where it does not move the tool");
    }

    // NAME=value, with the '=' at `equals`.
    Result<void> assignment(const std::string& name, std::size_t equals) {
        std::size_t end = equals + 1;
        while (end < line_.size() && is_blank(line_[end])) ++end;
        const std::size_t value_at = end;
        if (value_at < line_.size() && line_[value_at] == '"') {
            return refuse(value_at, name + " with a name instead of a number", "call the tool by its number");
        }
        for (int depth = 0; end < line_.size(); ++end) {
            const char c = line_[end];
            depth += c == '(' ? 1 : c == ')' ? -1 : 0;
            if (c == ';' || (is_blank(c) && depth <= 0)) break;
        }
        const std::string_view value = line_.substr(value_at, end - value_at);
        std::string target;
        std::string_view extra;
        if (name.size() == 1) {
            target = dwells_ && name == "F" ? "P" : name;
        } else if (name == "CR") {
            target = "R";
        } else if (name == "A3" || name == "B3" || name == "C3") {
            target = std::string(1, static_cast<char>(name[0] - 'A' + 'I'));
        } else if (name == "S1" || name == "M1") {
            target = name.substr(0, 1);
        } else if (name == "TURN") {
            target = "P";
            extra = "1+";
        } else if (name[0] == 'R' && std::all_of(name.begin() + 1, name.end(), is_digit)) {
            target = "#" + name.substr(1) + "=";
            set_here_.push_back(name);
        } else if (name == "ADIS" || name == "ADISPOS" || name == "STOLF" || name == "OTOL" ||
                   name == "CTOL") {
            put("", end);
            return {};
        } else {
            return refuse(at_, name.substr(0, 20) + "= is not known",
                          "delete it where it does not move the tool");
        }
        const auto converted = expression(value, value_at, name);
        if (!converted) return std::unexpected(converted.error());
        const bool plain = number_of(value).has_value() && extra.empty();
        const std::string text =
            plain ? target + std::string(value) : target + "[" + std::string(extra) + *converted + "]";
        const std::size_t width = end - at_;
        if (text.size() < width) out_.append(width - text.size(), ' ');
        out_ += text;
        at_ = end;
        return {};
    }

    // Converts R1 to #1 and parentheses to brackets.
    Result<std::string> expression(std::string_view value, std::size_t at, const std::string& setting) const {
        if (value.empty()) return refuse(at, "a value is missing behind '='", "write a number");
        std::string text;
        for (std::size_t i = 0; i < value.size();) {
            if (!is_letter(value[i])) {
                if (value[i] == '$' || value[i] == '[' || value[i] == ']' || value[i] == '#') {
                    return refuse(at + i, shown_character(value[i]) + " does not belong into a value",
                                  "use numbers and R parameters");
                }
                text += value[i] == '(' ? '[' : value[i] == ')' ? ']' : value[i];
                ++i;
                continue;
            }
            std::string name;
            std::size_t end = i;
            while (end < value.size() && is_name(value[end])) name += to_upper(value[end++]);
            if (name[0] == 'R' && name.size() > 1 && std::all_of(name.begin() + 1, name.end(), is_digit)) {
                // The block may mean the old or the new value; the G-code reader does not detect this.
                if (std::find(set_here_.begin(), set_here_.end(), name) != set_here_.end() &&
                    name != setting) {
                    return refuse(at + i, name + " is used in the block that sets it", "put it on two lines");
                }
                text += "#" + name.substr(1);
            } else if (name == "SIN" || name == "COS" || name == "TAN" || name == "SQRT" || name == "ABS" ||
                       name == "ASIN" || name == "ACOS" || name == "ROUND") {
                text += name;
            } else if (name == "AC" || name == "IC" || name == "DC" || name == "ACP" || name == "ACN") {
                return refuse(at + i, name + "() is not read yet",
                              "write the word in absolute or incremental mode");
            } else {
                return refuse(at + i, "'" + name.substr(0, 20) + "' is not known",
                              "use numbers and R parameters");
            }
            i = end;
        }
        return text;
    }

    std::string_view line_;
    int number_;
    const std::string& source_name_;
    std::string& out_;
    std::size_t at_ = 0;
    bool dwells_ = false;
    std::vector<std::string> set_here_;  // R parameters that the line has set so far
};

}  // namespace

Result<std::string> siemens_to_gcode(std::string_view bytes, const std::string& source_name) {
    std::string out;
    out.reserve(bytes.size() + bytes.size() / 16);
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        if (line->size() > kLongestBlock) {
            return fail_at(source_name, lines.number(), static_cast<int>(kLongestBlock) + 1,
                           too_long_block(line->size()), "write it on several lines");
        }
        if (auto done = Rewriter(*line, lines.number(), source_name, out).run(); !done) {
            return std::unexpected(done.error());
        }
        out += '\n';
    }
    return out;
}

namespace {

Result<motion::Program> read_rewritten(std::string_view bytes, const GcodeOptions& options, MoveSink* sink) {
    const auto text = siemens_to_gcode(bytes, options.source_name);
    if (!text) return std::unexpected(text.error());
    auto program = sink != nullptr ? read_gcode(*text, options, *sink) : read_gcode(*text, options);
    if (program) program->dialect = "Siemens";
    return program;
}

}  // namespace

Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options) {
    return read_rewritten(bytes, options, nullptr);
}

Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options, MoveSink& sink) {
    return read_rewritten(bytes, options, &sink);
}

}  // namespace tribo::readers
