// SPDX-License-Identifier: MIT
// Addresses with their values: X10, X=AC(10), PO[X]=(1,2), R1=5.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr std::string_view kAxes = "XYZ", kParallel = "UVW", kRotary = "ABC", kCentres = "IJK";

// Addresses without effect on the path: feeds of single axes and corners, smoothing, speeds, limits. DISR and
// its like size the ways of G147 and on, which are refused by these codes.
constexpr std::string_view kSilent[] = {
    "ADIS",   "ADISPOS", "STOLF",   "OTOL",   "CTOL",   "ATOL",   "CTOLG0", "FRC",   "FRCM",  "FD",
    "FDA",    "FP",      "OVR",     "OVRRAP", "OVRA",   "SPOS",   "SPOSA",  "LIMS",  "SVC",   "DL",
    "DITS",   "DITE",    "VELOLIM", "ACC",    "FA",     "FL",     "FXS",    "SF",    "ANGLE", "DISC",
    "SCC",    "TOWER",   "MTL",     "SR",     "SRA",    "ST",     "STA",    "G",     "FMA",   "JERKLIM",
    "ACCLIM", "DISCL",   "ORIRES",  "CUTMOD", "OTOLG0", "SCPARA", "DISR",   "DISRP", "FAD",
};

constexpr std::pair<std::string_view, Measure> kMeasures[] = {
    {"AC", Measure::absolute},  {"IC", Measure::incremental}, {"DC", Measure::shortest},
    {"ACP", Measure::positive}, {"ACN", Measure::negative},
};

}  // namespace

// The value behind '=': a formula, with AC( IC( DC( around it or not.
Result<Amount> Interpreter::amount(Cursor& in) {
    in.skip_blanks();
    Amount found;
    found.column = static_cast<int>(in.at) + 1;
    const std::string name = name_at(in);
    std::size_t behind = in.at + name.size();
    while (behind < in.line.size() && is_blank(in.line[behind])) ++behind;
    for (const auto& [word, measure] : kMeasures) {
        if (word == name && behind < in.line.size() && in.line[behind] == '(') {
            in.at = behind;
            found.measure = measure;
        }
    }
    if ((name == "CAC" || name == "CIC" || name == "CDC") && found.measure == Measure::modal) {
        return in.refuse(in.at, name + "() names a place of a table of the machine", "write the coordinate");
    }
    if (name == "QU" && behind < in.line.size() && in.line[behind] == '(') in.at = behind;
    const auto value = Formula(in, variables_, *this).number();
    if (!value) return std::unexpected(value.error());
    found.value = *value;
    return found;
}

// NAME= with the cursor behind the '='.
Result<void> Interpreter::read_named_value(Cursor& in, const std::string& name, std::size_t at,
                                           Words& words) {
    const bool is_r =
        name[0] == 'R' && name.size() > 1 && std::all_of(name.begin() + 1, name.end(), is_digit);
    if (is_r || variables_.find(name) != nullptr) {
        in.at = at + name.size();
        return assign(name, at, in);
    }
    if (name == "T") return choose_tool(in, at, words);
    const bool is_edge = name == "D" || name == "DL" || name == "H";
    if (is_edge && in.peek_after_blanks() == '"') {
        const auto text = quoted(in);
        if (!text) return std::unexpected(text.error());
        return {};
    }
    if (name == "ID" || name == "IDS") {
        in.at = in.line.size();
        if (passed_over_.insert("ID").second) {
            path_.warn(line_number(),
                       "synchronised actions (ID, IDS) are passed over: they are taken not "
                       "to move the tool");
        }
        return {};
    }
    // _CAMTOLERANCE=0.01: a variable that the control has.
    if (name[0] == '_') {
        const auto given = Formula(in, variables_, *this).value();
        if (!given) return std::unexpected(given.error());
        Variable variable;
        variable.type = std::holds_alternative<double>(*given) ? Type::real : Type::text;
        variable.values = {*given};
        if (!variables_.define(name, std::move(variable)))
            return in.refuse(at, "the variables hold more than a million values", "define smaller arrays");
        if (passed_over_.insert(name).second) {
            path_.warn(line_number(), name.substr(0, 31) +
                                          " is not defined in the program: it is taken as a "
                                          "variable of the control");
        }
        return {};
    }
    const std::size_t begin = in.at;
    auto value = amount(in);
    if (!value && words.machine_place && name.size() == 1) {
        // A place of the machine, by a variable that it keeps: where it is, does not matter here.
        in.at = begin;
        in.skip_blanks();
        while (in.at < in.line.size() && !is_blank(in.line[in.at])) ++in.at;
        value = Amount{};
    }
    if (!value) return std::unexpected(value.error());
    value->column = static_cast<int>(at) + 1;
    return take_address(in, name, *value, words);
}

// NAME[...]= with the cursor behind the '['.
Result<void> Interpreter::read_indexed(Cursor& in, const std::string& name, std::size_t at, Words& words) {
    if (name == "R" || variables_.find(name) != nullptr) {
        in.at = at + name.size();
        return assign(name, at, in);
    }
    const auto index = Formula(in, variables_, *this).indices();
    if (!index) return std::unexpected(index.error());
    if (in.peek_after_blanks() != '=') {
        return in.refuse(at, name.substr(0, 31) + "[] is not known", "define it with DEF, or delete it");
    }
    ++in.at;
    const std::string axis = text_of((*index)[0]);
    if (name == "POS" || name == "POSA" || name == "POSP" || name == "IP") {
        if (name == "IP") return in.refuse(at, "IP[] is not read", "write the increment with IC()");
        const auto value = amount(in);
        if (!value) return std::unexpected(value.error());
        words.positions = true;
        return take_address(in, axis, *value, words);
    }
    if (name == "FGREF") return refer_feed(in, axis);
    if (name == "PO") {
        const std::size_t k = axis.size() == 1 ? kAxes.find(axis[0]) : std::string_view::npos;
        if (k > 2)
            return in.refuse(at, "a polynomial of " + axis.substr(0, 8) + " is not read", "write X, Y, Z");
        const bool is_list = in.peek_after_blanks() == '(';
        if (is_list) ++in.at;
        for (bool first = true;; first = false) {
            auto value = amount(in);
            if (!value) return std::unexpected(value.error());
            if (first) {
                words.linear[k] = *value;
            } else {
                words.polynomial[k].push_back(value->value);
            }
            if (!is_list) return {};
            const char c = in.peek_after_blanks();
            if (c != ',' && c != ')') return in.refuse(at, "the parenthesis does not close", "close it");
            ++in.at;
            if (c == ')') return {};
            if (words.polynomial[k].size() >= 4) {
                return in.refuse(at, "a polynomial of more than the fifth degree", "write it in parts");
            }
        }
    }
    if (std::find(std::begin(kSilent), std::end(kSilent), name) != std::end(kSilent)) {
        const auto value = amount(in);
        return value ? Result<void>{} : std::unexpected(value.error());
    }
    return in.refuse(at, name.substr(0, 31) + "[] is not known", "define it with DEF, or delete it");
}

// FGREF[A]=10: the radius at which the feed counts the turn of the axis.
Result<void> Interpreter::refer_feed(Cursor& in, const std::string& axis) {
    const auto value = amount(in);
    if (!value) return std::unexpected(value.error());
    const std::size_t k = axis.size() == 1 ? std::string_view("ABC").find(axis[0]) : std::string_view::npos;
    if (k > 2 || !(value->value > 0)) return {};
    feed_radius_mm_[static_cast<int>(k)] = value->value * unit_mm_;
    count_turns();
    return {};
}

// FGROUP(X,Y,Z,A): the axes whose way the feed counts; FGROUP() returns to X, Y and Z.
Result<void> Interpreter::group_feed(Cursor& in) {
    in_feed_ = {};
    count_turns();
    if (in.peek_after_blanks() != '(') return {};
    const std::size_t begin = in.at;
    if (auto done = skip_parentheses(in); !done) return done;
    for (const char c : in.line.substr(begin, in.at - begin)) {
        const std::size_t k = std::string_view("ABC").find(to_upper(c));
        if (k < 3) in_feed_[k] = true;
    }
    count_turns();
    return {};
}

void Interpreter::count_turns() {
    for (int k = 0; k < 3; ++k)
        path_.rotary_feed.mm_per_rad[k] = in_feed_[static_cast<std::size_t>(k)] ? feed_radius_mm_[k] : 0;
}

Result<void> Interpreter::take_address(Cursor& in, const std::string& name, Amount amount, Words& words) {
    const std::size_t at = static_cast<std::size_t>(amount.column - 1);
    const char letter = name[0];
    const bool is_single = name.size() == 1;
    const auto whole = [&](double least, double most) {
        return amount.value >= least && amount.value <= most && amount.value == std::floor(amount.value);
    };
    // M1=3, S1=500, X1=10, F1=...: with the number of the spindle or the axis.
    const bool is_extended = name.size() == 2 && is_digit(name[1]);
    if (const std::size_t k = kAxes.find(letter); k < 3 && (is_single || (is_extended && name[1] == '1'))) {
        words.linear[k] = amount;
        return {};
    }
    if (const std::size_t k = kParallel.find(letter);
        k < 3 && (is_single || (is_extended && name[1] == '1'))) {
        words.parallel[k] = amount;
        return {};
    }
    if (const std::size_t k = kRotary.find(letter); k < 3) {
        if (is_single || (is_extended && name[1] == '1')) {
            words.rotary[k] = amount;
            return {};
        }
        if (is_extended && name[1] == '3') {
            words.vector[k] = amount.value;
            return {};
        }
        if (is_extended && name[1] == '2') {
            words.angle[k] = amount.value;
            return {};
        }
    }
    if (const std::size_t k = kCentres.find(letter); k < 3) {
        if (is_single) {
            words.centre[k] = amount;
            return {};
        }
        if (is_extended && name[1] == '1') {
            words.through[k] = amount;
            return {};
        }
    }
    if (letter == 'G' && is_single) {
        if (!whole(0, 999)) return in.refuse(at, "G without a whole number", "correct it");
        words.g.push_back({static_cast<int>(amount.value), amount.column});
        return {};
    }
    if (letter == 'M' && (is_single || is_extended)) {
        if (!whole(0, 99999)) return in.refuse(at, "M without a whole number", "correct it");
        words.m.push_back({static_cast<int>(amount.value), amount.column});
        return {};
    }
    if (letter == 'S' && (is_single || (is_extended && name[1] == '1'))) {
        words.spindle = amount;
        return {};
    }
    if ((letter == 'S' || letter == 'H') && is_extended) return {};
    if (name == "F") {
        words.feed = amount;
        return {};
    }
    if (name == "FB") {
        words.block_feed = amount;
        return {};
    }
    if (name == "FZ") {
        words.tooth_feed = amount;
        return {};
    }
    if (name == "T") {
        if (!whole(0, kLimits.tool_number.range.max)) {
            return path_.refuse(place(amount.column), "T without a whole number", "write the tool's number");
        }
        words.tool = amount.value;
        return {};
    }
    if (name == "P") {
        if (!whole(0, 1e6)) return in.refuse(at, "P without a whole number", "write how often to run it");
        words.times = static_cast<long>(amount.value);
        return {};
    }
    if (name == "D" || name == "H" || name == "N" || name == "E") return {};
    const std::pair<std::string_view, std::optional<double> Words::*> plain[] = {
        {"CR", &Words::radius},     {"AR", &Words::opening},     {"TURN", &Words::turns},
        {"RND", &Words::rounding},  {"CHF", &Words::chamfer},    {"CHR", &Words::chamfer_leg},
        {"ANG", &Words::direction}, {"RPL", &Words::plane_turn}, {"PW", &Words::weight},
        {"PL", &Words::knot_step},  {"SD", &Words::degree},
    };
    for (const auto& [word, member] : plain) {
        if (word != name) continue;
        words.*member = amount.value;
        return {};
    }
    if (name == "RP" || name == "AP") {
        (name == "RP" ? words.polar_radius : words.polar_angle) = amount;
        return {};
    }
    if (name == "OFFN") {
        const double mm = amount.value * unit_mm_;
        if (auto good = path_.in_range(kLimits.coordinate, mm, place(amount.column)); !good) return good;
        if (mm < 0) return in.refuse(at, "OFFN is negative", "write a contour that is larger");
        if (side_ != 0) return in.refuse(at, "OFFN within radius compensation", "write G40 before it");
        contour_offset_mm_ = mm;
        return {};
    }
    if (name == "RNDM") {
        const double mm = amount.value * unit_mm_;
        if (auto good = path_.in_range(kLimits.coordinate, mm, place(amount.column)); !good) return good;
        if (mm < 0) return in.refuse(at, "RNDM is negative", "write a radius, or 0 to end it");
        modal_rounding_mm_ = mm;
        return {};
    }
    if (name == "R") {
        if (path_.first(kRadiusWord)) {
            path_.warn(line_number(), "R is taken for the radius of an arc; Siemens writes CR=");
        }
        words.radius = amount.value;
        return {};
    }
    if (std::find(std::begin(kSilent), std::end(kSilent), name) != std::end(kSilent)) return {};
    return in.refuse(at, name.substr(0, 31) + "= is not known", "delete it where it does not move the tool");
}

}  // namespace tribo::readers::siemens
