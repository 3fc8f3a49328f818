// SPDX-License-Identifier: MIT
#include "app/compare/compare_outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/text/decimal.hpp"
#include "base/text/printable.hpp"
#include "files/image/png.hpp"
#include "files/json/json.hpp"
#include "report/compare/compare_page.hpp"
#include "report/picture/picture.hpp"

namespace tribo::app {
namespace {

constexpr std::size_t kShownPairs = 10;

std::string digits(double value, int count = 3) {
    return format_digits(value, count);
}

std::string place_text(Vec3 p) {
    return digits(p.x) + ", " + digits(p.y) + ", " + digits(p.z) + " mm";
}

// The row of the largest value along the program.
std::string line_of_largest(const ComparedRun& run, std::string_view key) {
    const auto value = [&](const session::ComparedRow& row) {
        if (key == "peak_force_n") return row.peak_xy_n;
        if (key == "peak_torque_nm") return std::abs(row.peak_torque_nm);
        if (key == "multiplier_max") return row.multiplier.value_or(0);
        if (key == "load_ratio_max") return row.load_ratio.value_or(0);
        return 0.0;
    };
    const auto most = std::ranges::max_element(run.rows, {}, value);
    if (most == run.rows.end() || !(value(*most) > 0) || most->line <= 0) return "";
    return "line " + std::to_string(most->line);
}

// The pairs that differ most in a quantity, the largest first.
std::vector<const session::CutPair*> largest_pairs(const session::JoinedCuts& cuts, session::Quantity q,
                                                   std::size_t most) {
    std::vector<const session::CutPair*> pairs;
    const auto size = [q](const session::CutPair* pair) { return std::abs(session::difference(*pair, q)); };
    for (const session::CutPair& pair : cuts.pairs)
        if (size(&pair) > 0) pairs.push_back(&pair);
    // Equal ones stay in their order, which is that of their addresses.
    std::ranges::sort(pairs, {}, [&](const session::CutPair* pair) { return std::pair(-size(pair), pair); });
    pairs.resize(std::min(pairs.size(), most));
    return pairs;
}

std::string joined_text(const session::JoinedCuts& cuts) {
    std::string text = "Both cuts are joined by " + std::string(name_of(cuts.by)) + ": " + cuts.why + ".";
    if (cuts.step > 0)
        text += " A step is " + digits(cuts.step) + (cuts.by == session::JoinBy::time ? " s." : " mm3.");
    return text;
}

std::string pair_name(const session::JoinedCuts& cuts, const session::CutPair& pair) {
    if (cuts.by == session::JoinBy::line) return "line " + digits(pair.place, 9);
    return digits(pair.place) + (cuts.by == session::JoinBy::time ? " s" : " mm3");
}

void add_run(files::Json& json, const char* key, const ComparedRun& run) {
    files::Json object;
    object["name"] = run.name;
    object["kind"] = std::string(name_of(run.kind));
    if (!run.what.empty()) object["what"] = run.what;
    for (std::size_t n = 0; n < kTotals.size(); ++n) files::set(object, kTotals[n].key, run.totals[n]);
    object["missing"] = run.missing;
    json[key] = std::move(object);
}

files::Json place_json(const surface::DifferencePlace& place, const Comparison& c) {
    files::Json json;
    json["mm"] = place.mm;
    json["on_a_mm"] = files::triple(place.on_a_mm);
    json["on_b_mm"] = files::triple(place.on_b_mm);
    if (const int line = c.a.line_at(place.on_a_mm); line > 0) json["line_a"] = line;
    if (const int line = c.b.line_at(place.on_b_mm); line > 0) json["line_b"] = line;
    return json;
}

std::string place_in_words(const surface::DifferencePlace& place, const Comparison& c, bool leaves_more) {
    std::string by;
    const auto add_line = [&](int line, const char* name) {
        if (line > 0)
            by += (by.empty() ? ", made by line " : " and line ") + std::to_string(line) + " of " + name;
    };
    add_line(c.a.line_at(place.on_a_mm), "A");
    add_line(c.b.line_at(place.on_b_mm), "B");
    return std::string("B ") + (leaves_more ? "leaves " : "cuts ") + digits(std::abs(place.mm)) + " mm " +
           (leaves_more ? "more" : "deeper") + " at most, at " + place_text(place.on_b_mm) + by + ".";
}

std::vector<std::string> part_facts(const Comparison& c) {
    if (!c.parts) return {"The parts cannot be compared: one of them is not known."};
    const surface::VolumeDifference& v = c.parts->volumes;
    std::vector<std::string> facts;
    if (v.only_a_mm3 == 0 && v.only_b_mm3 == 0) {
        facts.push_back("Both parts hold the same material.");
    } else {
        facts.push_back("Only A holds " + digits(v.only_a_mm3) + " mm3, only B holds " +
                        digits(v.only_b_mm3) + " mm3.");
    }
    const surface::SurfaceDifference& s = c.parts->surfaces;
    if (s.more) facts.push_back(place_in_words(*s.more, c, true));
    if (s.less) facts.push_back(place_in_words(*s.less, c, false));
    if (!s.more && !s.less) facts.push_back("Their surfaces are the same.");
    return facts;
}

// What changed, in a sentence.
std::string verdict(const Comparison& c) {
    std::string text;
    const auto change = [&](const char* key, const char* what) {
        const auto n = static_cast<std::size_t>(
            std::ranges::find(kTotals, std::string_view(key), &TotalWords::key) - kTotals.begin());
        const std::optional<double>&a = c.a.totals[n], &b = c.b.totals[n];
        if (!a || !b || *a == *b) return;
        text += (text.empty() ? "B: " : ", ") + std::string(what) + " " + digits(*b) + " in place of " +
                digits(*a) + " " + kTotals[n].unit;
        if (*a > 0) {
            const double percent = 100 * (*b - *a) / *a;
            text += std::string(" (") + (percent > 0 ? "+" : "") + digits(percent) + " %)";
        }
    };
    change("duration_s", "time");
    change("peak_force_n", "peak force");
    change("peak_power_w", "peak power");
    if (text.empty()) text = "Time, peak force and peak power do not differ";
    if (c.parts) {
        const surface::SurfaceDifference& s = c.parts->surfaces;
        const double most = std::max(s.more ? s.more->mm : 0, s.less ? -s.less->mm : 0);
        text += most > 0 ? ". The parts are up to " + digits(most) + " mm apart" : ". The parts are the same";
    }
    return text + ".";
}

report::HtmlTable largest_table(const Comparison& c) {
    report::HtmlTable table;
    table.title = "Where the force changes most";
    table.hint = "Peak force across the axis, N: the largest of the " +
                 std::string(c.cuts.by == session::JoinBy::line ? "line" : "step") + ".";
    table.header = {"Place", "Line of A", "Line of B", "A", "B", "B - A", "Tip in B, mm"};
    for (const session::CutPair* pair : largest_pairs(c.cuts, session::Quantity::peak_force, kShownPairs)) {
        const double a = pair->a->of(session::Quantity::peak_force),
                     b = pair->b->of(session::Quantity::peak_force);
        table.rows.push_back({pair_name(c.cuts, *pair), std::to_string(pair->a->line),
                              std::to_string(pair->b->line), digits(a), digits(b), digits(b - a),
                              place_text(pair->b->tip_mm)});
    }
    return table;
}

std::optional<report::ComparedMoment> moment(const std::optional<session::CutStretch>& stretch,
                                             const std::vector<session::Quantity>& lanes) {
    if (!stretch) return {};
    report::ComparedMoment m{stretch->from_s, stretch->line, stretch->tip_mm, {}};
    for (const session::Quantity q : lanes) m.values.push_back(stretch->of(q));
    return m;
}

// The quantities that at least one of the runs knows.
std::vector<session::Quantity> known_lanes(const session::JoinedCuts& cuts) {
    std::vector<session::Quantity> lanes;
    for (std::size_t n = 0; n < session::kQuantities; ++n) {
        const auto q = static_cast<session::Quantity>(n);
        const auto knows = [q](const std::optional<session::CutStretch>& s) {
            return s && std::isfinite(s->of(q)) && s->of(q) != 0;
        };
        if (std::ranges::any_of(cuts.pairs, [&](const auto& p) { return knows(p.a) || knows(p.b); }))
            lanes.push_back(q);
    }
    return lanes;
}

void add_steps(const session::JoinedCuts& cuts, report::ComparePage& page) {
    const std::vector<session::Quantity> lanes = known_lanes(cuts);
    for (const session::Quantity q : lanes) {
        const session::QuantityWords& words = session::kQuantityWords[session::index_of(q)];
        page.lanes.push_back({std::string(words.name), std::string(words.unit)});
    }
    page.axis = cuts.by == session::JoinBy::line      ? "time of A, s"
                : cuts.by == session::JoinBy::removed ? "removed volume, mm3"
                                                      : "time, s";
    if (lanes.empty()) return;
    for (const session::CutPair& pair : cuts.pairs) {
        report::ComparedStep step{pair.place, cuts.step, moment(pair.a, lanes), moment(pair.b, lanes)};
        if (cuts.by == session::JoinBy::line) {
            step.at = pair.a->from_s;
            step.width = pair.a->to_s - pair.a->from_s;
        }
        page.steps.push_back(std::move(step));
    }
}

report::ComparedSide side_of(ComparedRun& run, std::optional<report::ReportPart> part) {
    report::ComparedSide side;
    side.name = run.name;
    side.what = std::string(name_of(run.kind)) + (run.what.empty() ? "" : ", " + run.what);
    side.sound = std::move(run.sound);
    if (!run.mesh.triangles.empty())
        side.picture_png =
            files::png_bytes(report::draw_part(run.mesh, {}, {.on_ground = true, .sawn = run.untouched}));
    side.part = std::move(part);
    return side;
}

}  // namespace

bool is_compare_file(const std::string& name) {
    static constexpr std::array<std::string_view, 5> names{"compare.csv", "compare.json", "compare.html",
                                                           "sound_a.wav", "sound_b.wav"};
    return std::ranges::find(names, name) != names.end();
}

std::string compare_json(const Comparison& c) {
    files::Json json;
    json["schema"] = "tribo.compare/1";
    json["version"] = TRIBO_VERSION;
    add_run(json, "a", c.a);
    add_run(json, "b", c.b);
    files::Json difference = files::Json::object();
    for (std::size_t n = 0; n < kTotals.size(); ++n)
        if (c.a.totals[n] && c.b.totals[n])
            files::set(difference, kTotals[n].key, *c.b.totals[n] - *c.a.totals[n]);
    json["difference"] = std::move(difference);
    json["joined"] = {
        {"by", std::string(name_of(c.cuts.by))}, {"why", c.cuts.why}, {"rows", c.cuts.pairs.size()}};
    if (c.cuts.step > 0) json["joined"]["step"] = c.cuts.step;
    json["largest"] = files::Json::array();
    for (std::size_t n = 0; n < session::kQuantities; ++n) {
        const auto q = static_cast<session::Quantity>(n);
        for (const session::CutPair* pair : largest_pairs(c.cuts, q, 1)) {
            files::Json one;
            one["quantity"] = std::string(session::kQuantityWords[n].key);
            one["place"] = pair_name(c.cuts, *pair);
            one["line_a"] = pair->a->line;
            one["line_b"] = pair->b->line;
            one["a"] = pair->a->of(q);
            one["b"] = pair->b->of(q);
            one["difference"] = session::difference(*pair, q);
            json["largest"].push_back(std::move(one));
        }
    }
    if (c.parts) {
        const surface::VolumeDifference& v = c.parts->volumes;
        files::Json part;
        part["only_a_mm3"] = v.only_a_mm3;
        part["only_b_mm3"] = v.only_b_mm3;
        part["cell_mm"] = v.cell_mm;
        if (c.parts->surfaces.more) part["b_leaves_more"] = place_json(*c.parts->surfaces.more, c);
        if (c.parts->surfaces.less) part["b_cuts_deeper"] = place_json(*c.parts->surfaces.less, c);
        json["part"] = std::move(part);
    }
    json["set_up"] = c.set_up;
    json["warnings"] = files::Json::array();
    for (const ComparedRun* run : {&c.a, &c.b})
        for (const Warning& w : run->warnings) json["warnings"].push_back(w.message());
    return files::pretty(json);
}

std::string compare_csv(const Comparison& c) {
    std::string csv = c.cuts.by == session::JoinBy::line      ? "line"
                      : c.cuts.by == session::JoinBy::removed ? "removed_mm3"
                                                              : "t_s";
    for (const char* side : {"a", "b"})
        for (const char* name : {"t_s", "line", "tip_x_mm", "tip_y_mm", "tip_z_mm"})
            csv += "," + std::string(side) + "_" + name;
    for (const session::QuantityWords& words : session::kQuantityWords)
        for (const char* side : {"a_", "b_", "difference_"}) csv += "," + (side + std::string(words.key));
    csv += '\n';
    const auto cell = [&](double value) {
        csv += ',';
        if (std::isfinite(value)) append_decimal(csv, value);
    };
    for (const session::CutPair& pair : c.cuts.pairs) {
        append_decimal(csv, pair.place);
        for (const std::optional<session::CutStretch>* side : {&pair.a, &pair.b}) {
            if (!*side) {
                csv += ",,,,,";
                continue;
            }
            cell((*side)->from_s);
            cell((*side)->line);
            for (int axis = 0; axis < 3; ++axis) cell((*side)->tip_mm[axis]);
        }
        for (std::size_t n = 0; n < session::kQuantities; ++n) {
            const auto q = static_cast<session::Quantity>(n);
            cell(pair.a ? pair.a->of(q) : NAN);
            cell(pair.b ? pair.b->of(q) : NAN);
            cell(session::difference(pair, q));
        }
        csv += '\n';
    }
    return csv;
}

std::string compare_html(Comparison& c) {
    report::ComparePage page;
    page.version = TRIBO_VERSION;
    page.verdict = verdict(c);
    page.notices = c.set_up;
    page.part_facts = part_facts(c);
    page.joined = joined_text(c.cuts);
    for (const ComparedRun* run : {&c.a, &c.b})
        for (const Warning& w : run->warnings) page.warnings.push_back(w.message());
    for (std::size_t n = 0; n < kTotals.size(); ++n)
        page.totals.push_back({kTotals[n].name, kTotals[n].unit, c.a.totals[n], c.b.totals[n],
                               line_of_largest(c.a, kTotals[n].key), line_of_largest(c.b, kTotals[n].key)});
    add_steps(c.cuts, page);
    if (report::HtmlTable table = largest_table(c); !table.rows.empty())
        page.tables.push_back(std::move(table));
    std::optional<report::ReportPart> a, b;
    if (c.parts) {
        a = std::move(c.parts->a);
        b = std::move(c.parts->b);
    }
    page.a = side_of(c.a, std::move(a));
    page.b = side_of(c.b, std::move(b));
    return report::compare_page(page);
}

void print(const Comparison& c) {
    std::printf("%s\n", printable(verdict(c)).c_str());
    std::printf("%-26s %12s %12s %12s\n", "", "A", "B", "B - A");
    for (std::size_t n = 0; n < kTotals.size(); ++n) {
        const std::optional<double>&a = c.a.totals[n], &b = c.b.totals[n];
        if (!a && !b) continue;
        const std::string name =
            std::string(kTotals[n].name) + (*kTotals[n].unit ? ", " : "") + kTotals[n].unit;
        std::printf("%-26s %12s %12s %12s\n", name.c_str(), a ? digits(*a).c_str() : "-",
                    b ? digits(*b).c_str() : "-", a && b ? digits(*b - *a).c_str() : "");
    }
    for (const std::string& fact : part_facts(c)) std::printf("%s\n", printable(fact).c_str());
    for (const std::string& fact : c.set_up) std::printf("%s\n", printable(fact).c_str());
    std::printf("%s\n", printable(joined_text(c.cuts)).c_str());
}

}  // namespace tribo::app
