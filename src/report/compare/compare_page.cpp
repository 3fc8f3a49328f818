// SPDX-License-Identifier: MIT
#include "report/compare/compare_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text/decimal.hpp"
#include "files/json/json.hpp"
#include "report/report_page.hpp"

namespace tribo::report {
namespace {

constexpr std::size_t kMostSteps = 4000;  // the plots have fewer pixels
constexpr int kDigits = 3;                // of values in text

std::string text_of(const std::optional<double>& value) {
    return value ? format_digits(*value, kDigits) : "not known";
}

std::string change_of(const ComparedTotal& t) {
    if (!t.a || !t.b) return "";
    const double change = *t.b - *t.a;
    if (change == 0) return "0";
    return (change > 0 ? "+" : "") + format_digits(change, kDigits);
}

std::string percent_of(const ComparedTotal& t) {
    if (!t.a || !t.b || *t.a == 0 || *t.a == *t.b) return "";
    const double percent = 100 * (*t.b - *t.a) / std::abs(*t.a);
    return (percent > 0 ? "+" : "") + format_digits(percent, kDigits) + " %";
}

std::string totals_table(const std::vector<ComparedTotal>& totals) {
    std::string html =
        "<div class=\"wide\"><table class=\"totals\"><tr><th></th><th scope=\"col\">A</th><th "
        "scope=\"col\">B</th><th scope=\"col\">B - A</th><th></th></tr>\n";
    const auto value = [](const std::optional<double>& v, const std::string& place) {
        return "<td>" + text_of(v) + (v && !place.empty() ? " <small>" + escaped(place) + "</small>" : "") +
               "</td>";
    };
    for (const ComparedTotal& t : totals) {
        if (!t.a && !t.b) continue;
        html += "<tr><th scope=\"row\">" + escaped(t.name) +
                (t.unit.empty() ? "" : " <small>" + escaped(t.unit) + "</small>") + "</th>" +
                value(t.a, t.place_a) + value(t.b, t.place_b) + "<td><b>" + change_of(t) + "</b></td><td>" +
                percent_of(t) + "</td></tr>\n";
    }
    return html + "</table></div>";
}

std::string view(const ComparedSide& side, const char* letter) {
    const std::string id = std::string("view-") + (letter[0] == 'A' ? "a" : "b");
    std::string html = "<figure class=\"part\" id=\"" + id + "\"><h3><span class=\"letter\">" + letter +
                       "</span> " + escaped(side.name) + "</h3>\n";
    if (side.picture_png.empty()) return html + "<p class=\"hint\">No part is known.</p></figure>\n";
    html += "<img alt=\"Part " + std::string(letter) + "\" src=\"data:image/png;base64," +
            base64(side.picture_png) + "\">\n";
    if (side.part) {
        html +=
            "<div class=\"live\" hidden><canvas tabindex=\"0\" role=\"application\" "
            "aria-roledescription=\"3D view\" aria-label=\"Part " +
            std::string(letter) + "\" aria-describedby=\"view-hint\"></canvas></div>\n";
    }
    return html + "<p class=\"readout\"></p></figure>\n";
}

std::string part_bytes(const ComparedSide& side, const char* id) {
    if (!side.part) return "";
    return "<script type=\"text/plain\" id=\"" + std::string(id) + "\">" +
           base64(report_part_bytes(*side.part)) + "</script>\n";
}

std::string sound_of(const ComparedSide& side, const char* id) {
    if (!side.sound || side.sound->stereo.empty()) return "";
    return "<script type=\"text/plain\" id=\"" + std::string(id) + "\">" +
           base64(wav_bytes_16(side.sound->stereo, 2, side.sound->rate_hz)) + "</script>\n";
}

bool can_sound(const ComparePage& page) {
    const auto sounds = [](const ComparedSide& s) { return s.sound && !s.sound->stereo.empty(); };
    return sounds(page.a) && sounds(page.b);
}

std::string listen(const ComparePage& page) {
    if (!can_sound(page)) return "";
    const auto from = [](const ReportSound& s) { return format_digits(s.heard_from_s, kDigits) + " s"; };
    return "<section id=\"listen\"><h2>Sound</h2>\n<p class=\"hint\">Both sounds run at the same time from "
           "the "
           "beginning of their cuts (A from " +
           from(*page.a.sound) + ", B from " + from(*page.b.sound) +
           " on); the switch changes which one you hear, without a gap.</p>\n<div class=\"buttons\"><button "
           "type=\"button\" id=\"play-sound\">Play</button><div class=\"choices\" role=\"radiogroup\" "
           "aria-label=\"Hear\"><label><input type=\"radio\" name=\"heard\" value=\"a\" checked> A</label>"
           "<label><input type=\"radio\" name=\"heard\" value=\"b\"> B</label></div></div></section>\n";
}

std::string lane_choices(const std::vector<ComparedLane>& lanes) {
    std::string html;
    for (std::size_t n = 0; n < lanes.size(); ++n)
        html += "<label><input type=\"radio\" name=\"lane\" value=\"" + std::to_string(n) + "\"" +
                (n == 0 ? " checked" : "") + "> " + escaped(lanes[n].name) + "</label>\n";
    return html;
}

// A number with few digits, for a plot; null: not known.
std::string number(double value, int digits) {
    return std::isfinite(value) ? format_digits(value, digits) : "null";
}

std::string column(const std::vector<ComparedStep>& steps,
                   const std::function<std::string(const ComparedStep&)>& value) {
    std::string text = "[";
    for (const ComparedStep& step : steps) text += value(step) + ",";
    if (text.back() == ',') text.pop_back();
    return text + "]";
}

std::string side_json(const ComparePage& page, const std::vector<ComparedStep>& steps, const char* key,
                      std::optional<ComparedMoment> ComparedStep::* side, const ComparedSide& of) {
    using M = const ComparedMoment&;
    const auto list = [&](const std::function<std::string(M)>& value) {
        return column(steps, [&](const ComparedStep& step) {
            return step.*side ? value(*(step.*side)) : std::string("null");
        });
    };
    std::string json = std::string("\"") + key + "\":{\"t\":" + list([](M m) { return number(m.t_s, 8); }) +
                       ",\"line\":" + list([](M m) { return std::to_string(m.line); }) +
                       ",\"x\":" + list([](M m) { return number(m.tip_mm.x, 6); }) +
                       ",\"y\":" + list([](M m) { return number(m.tip_mm.y, 6); }) +
                       ",\"z\":" + list([](M m) { return number(m.tip_mm.z, 6); }) + ",\"values\":[";
    for (std::size_t n = 0; n < page.lanes.size(); ++n)
        json += (n > 0 ? "," : "") + list([&](M m) { return number(m.values[n], 5); });
    json += "]";
    if (of.part) json += ",\"part\":" + report_part_json(*of.part);
    return json + "}";
}

std::string data_json(const ComparePage& page) {
    const std::vector<ComparedStep> steps = thin_steps(page.steps, kMostSteps);
    std::string json =
        "{\"schema\":\"tribo.compare-page/1\",\"axis\":" + files::dump(files::Json(page.axis)) +
        ",\"lanes\":[";
    for (const ComparedLane& lane : page.lanes)
        json += (&lane == &page.lanes.front() ? "" : ",") +
                files::dump(files::Json{{"name", lane.name}, {"unit", lane.unit}});
    json += "],\"at\":" + column(steps, [](const ComparedStep& s) { return number(s.at, 8); }) +
            ",\"width\":" + column(steps, [](const ComparedStep& s) { return number(s.width, 5); }) + "," +
            side_json(page, steps, "a", &ComparedStep::a, page.a) + "," +
            side_json(page, steps, "b", &ComparedStep::b, page.b) + "}";
    return json_for_script(json);
}

void join(std::optional<ComparedMoment>& moment, const std::optional<ComparedMoment>& next) {
    if (!next) return;
    if (!moment) {
        moment = next;
        return;
    }
    const std::vector<double> before = moment->values;
    if (!before.empty() && next->values[0] > before[0]) *moment = *next;
    for (std::size_t n = 0; n < before.size(); ++n) moment->values[n] = std::fmax(before[n], next->values[n]);
}

std::string paragraphs(const std::vector<std::string>& sentences) {
    std::string html;
    for (const std::string& s : sentences) html += "<li>" + escaped(s) + "</li>\n";
    return html.empty() ? "" : "<ul class=\"facts\">\n" + html + "</ul>\n";
}

}  // namespace

std::vector<ComparedStep> thin_steps(std::vector<ComparedStep> steps, std::size_t most) {
    if (steps.size() <= most || most == 0) return steps;
    const std::size_t at_once = (steps.size() + most - 1) / most;
    std::vector<ComparedStep> thin;
    for (std::size_t n = 0; n < steps.size(); ++n) {
        if (n % at_once == 0) {
            thin.push_back(std::move(steps[n]));
            continue;
        }
        ComparedStep& into = thin.back();
        into.width = steps[n].at + steps[n].width - into.at;
        join(into.a, steps[n].a);
        join(into.b, steps[n].b);
    }
    return thin;
}

std::string compare_page(const ComparePage& page) {
    return filled(kReportComparison, [&](std::string_view mark) -> std::string {
        if (mark == "title") return escaped(page.a.name) + " and " + escaped(page.b.name);
        if (mark == "style") return std::string(kReportStyle);
        if (mark == "what_a") return escaped(page.a.what);
        if (mark == "what_b") return escaped(page.b.what);
        if (mark == "name_a") return escaped(page.a.name);
        if (mark == "name_b") return escaped(page.b.name);
        if (mark == "verdict") return escaped(page.verdict);
        if (mark == "notices") return notice_list(page.notices, "Compared as they stand");
        if (mark == "totals") return totals_table(page.totals);
        if (mark == "views") return view(page.a, "A") + view(page.b, "B");
        if (mark == "part_facts") return paragraphs(page.part_facts);
        if (mark == "joined") return escaped(page.joined);
        if (mark == "lanes") return lane_choices(page.lanes);
        if (mark == "sound") return listen(page);
        if (mark == "warnings") return notice_list(page.warnings, "Warnings");
        if (mark == "data") return data_json(page);
        if (mark == "parts") return part_bytes(page.a, "part-a") + part_bytes(page.b, "part-b");
        if (mark == "sounds" && can_sound(page))
            return sound_of(page.a, "sound-a") + sound_of(page.b, "sound-b");
        if (mark == "script") return std::string(kReportCompare);
        if (mark == "footer") return "Tribo " + escaped(page.version) + ". Units: mm, N, s.";
        if (mark == "tables") {
            std::string html;
            for (const HtmlTable& table : page.tables) html += html_of(table);
            return html;
        }
        return "";
    });
}

}  // namespace tribo::report
