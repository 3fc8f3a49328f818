// SPDX-License-Identifier: MIT
#include "report/report_html.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <span>
#include <string_view>

#include "base/text/decimal.hpp"
#include "files/json/json.hpp"
#include "report/html_parts.hpp"
#include "report/report_page.hpp"

namespace tribo::report {
namespace {

constexpr std::size_t kMostRows = 12'000;  // the plots have fewer pixels
constexpr std::size_t kMostNotices = 30;
constexpr double kFinestMm = 1e-3;  // no length of the page is known better
constexpr int kSetDigits = 6;       // of feeds and speeds, which the program sets
constexpr double kGapShare = 0.5;   // of the duration of a row; a longer pause is a gap between cuts

// Rounds to significant digits, without an exponent for numbers of usual size.
std::string json_digits(double value, int digits) {
    std::array<char, 40> text = {};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    const double size = std::abs(value);
    if (std::string_view(text.data()).find('e') != std::string_view::npos && size >= 1 && size < 1e15) {
        std::snprintf(text.data(), text.size(), "%.0f", value);
    }
    return text.data();
}

// For the reader.
std::string figure(double value) {
    return format_digits(value, 3);
}

// None below a micrometre.
std::string length_text(double mm) {
    if (mm != 0 && std::abs(mm) < 0.5 * kFinestMm) return "&lt; " + figure(kFinestMm);
    return figure(std::round(mm / kFinestMm) * kFinestMm);
}

// In full hundredths of a millimetre, to find it.
std::string place(Vec3 mm) {
    const auto hundredths = [](double v) { return format_decimal(std::round(100 * v) / 100 + 0.0); };
    return hundredths(mm.x) + ", " + hundredths(mm.y) + ", " + hundredths(mm.z);
}

std::string time_text(double seconds) {
    if (seconds < 100) return figure(seconds) + " <small>s</small>";
    const long s = std::lround(seconds);
    std::array<char, 32> text = {};
    if (s >= 3600) {
        std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    } else {
        std::snprintf(text.data(), text.size(), "%ld:%02ld", s / 60, s % 60);
    }
    return std::string(text.data()) + (s >= 3600 ? " <small>h</small>" : " <small>min</small>");
}

std::string card(const std::string& label, const std::string& value, const std::string& note = "") {
    return "<div class=\"card\"><span>" + label + "</span><b>" + value + "</b>" +
           (note.empty() ? "" : "<span class=\"band\">" + note + "</span>") + "</div>\n";
}

std::string cards(const Summary& s) {
    const auto unit = [](double value, const char* name) {
        return figure(value) + " <small>" + name + "</small>";
    };
    const auto length = [](double mm) { return length_text(mm) + " <small>mm</small>"; };
    const auto band = [&](const ForceValue& value) {
        if (!(value.low < value.high)) return std::string();
        return figure(value.low) + " to " + figure(value.high);
    };
    const double cm3 = 1e-3;
    std::string html;
    html += card("Largest force", unit(s.peak_force_n.value, "N"), band(s.peak_force_n));
    html += card("Mean force", unit(s.mean_force_n.value, "N"), band(s.mean_force_n));
    html += card("Largest torque", unit(s.peak_torque_nm.value, "N m"), band(s.peak_torque_nm));
    html += card("Largest power", unit(s.peak_power_w.value, "W"), band(s.peak_power_w));
    if (s.tooth_passing_hz) html += card("Tooth passing", unit(*s.tooth_passing_hz, "Hz"));
    html += card("Duration", time_text(s.duration_s), "cutting " + time_text(s.cutting_s));
    html += card("Path", unit(s.path_mm * 1e-3, "m"), "feed moves");
    html += card("Removed", unit(s.removed_mm3 * cm3, "cm³"), figure(s.remaining_mm3 * cm3) + " cm³ remain");
    if (s.gouge_max_mm) html += card("Deepest gouge", length(*s.gouge_max_mm));
    if (s.rest_max_mm) html += card("Most material left", length(*s.rest_max_mm));
    if (s.chatter) {
        const std::size_t lines = s.chatter->size();
        html += card("Chatter",
                     lines == 0 ? "none"
                                : std::to_string(lines) +
                                      (lines == 1 ? " <small>line</small>" : " <small>lines</small>"),
                     "moves by " + length_text(s.largest_displacement_mm.value_or(0)) + " mm at most");
    }
    if (s.scallop_max_mm) html += card("Highest scallop", length(*s.scallop_max_mm));
    html += card("Resolution", unit(s.resolution_mm, "mm"),
                 s.triangles ? std::to_string(*s.triangles) + " triangles" : "");
    return html;
}

std::string list(std::vector<std::string> items, const std::string& title, std::string_view style) {
    if (items.size() > kMostNotices) {
        const std::size_t more = items.size() - kMostNotices;
        items.resize(kMostNotices);
        items.push_back("and " + std::to_string(more) + " more in summary.json");
    }
    return notice_list(items, title, style);
}

std::string notices(const Summary& s) {
    std::vector<std::string> collisions, warnings;
    for (const SummaryCollision& c : s.collisions) {
        collisions.push_back((c.line > 0 ? "line " + std::to_string(c.line) + ", " : "") + figure(c.t_s) +
                             " s: " + c.kind + ", tip at " + place(c.tip_mm) + " mm");
    }
    for (const Warning& w : s.warnings) warnings.push_back(w.message());
    const auto counted = [](std::size_t n, const char* what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    std::string html = list(collisions, counted(collisions.size(), "collision"), "bad") +
                       list(warnings, counted(warnings.size(), "warning"), "");
    if (s.as_published) {
        html +=
            "<div class=\"notice\">Forces and sound by the paper's formulas as printed (--as-published), "
            "which "
            "are known to be wrong.</div>\n";
    }
    return html;
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& rows) {
    std::string html = "<table>\n";
    for (const auto& [name, text] : rows) {
        html += "<tr><th scope=\"row\">" + escaped(name) + "</th><td>" + escaped(text) + "</td></tr>\n";
    }
    return html + "</table>";
}

std::string worst_table(const std::vector<ReportRow>& worst) {
    HtmlTable table;
    table.title = "Lines with the largest forces";
    table.hint = "Each at its worst place. Force: the largest in a turn, with its band, N.";
    table.header = {"Line", "Time, s",   "Tip, mm",      "Force",
                    "Band", "Depth, mm", "Feed, mm/min", "Spindle, rpm"};
    for (const ReportRow& r : worst)
        table.rows.push_back({std::to_string(r.line), figure(r.t_s), place(r.tip_mm), figure(r.peak_n),
                              figure(r.peak_low_n) + " to " + figure(r.peak_high_n), figure(r.depth_mm),
                              format_digits(r.feed_mm_per_min, kSetDigits),
                              format_digits(r.rpm, kSetDigits)});
    return table.rows.empty() ? "" : html_of(table);
}

std::string sheet(const ReportData& data) {
    std::string html = worst_table(data.worst);
    for (const HtmlTable& table : data.sheet) html += html_of(table);
    return html;
}

std::string audio(const ReportSound& sound) {
    if (sound.stereo.empty()) return "";
    const double heard =
        std::min(kReportSoundS, 0.5 * static_cast<double>(sound.stereo.size()) / sound.rate_hz);
    const auto most = 2 * static_cast<std::size_t>(kReportSoundS * sound.rate_hz);
    const auto heard_part = std::span(sound.stereo).first(std::min(sound.stereo.size() / 2 * 2, most));
    std::string html = "<audio controls preload=\"metadata\" src=\"data:audio/wav;base64," +
                       base64(wav_bytes_16(heard_part, 2, sound.rate_hz)) + "\"></audio>\n";
    if (heard < sound.seconds - 0.01) {
        html += "<p class=\"hint\">Plays " + figure(heard) + " s from " + figure(sound.heard_from_s) +
                " s on; sound.wav has all " + figure(sound.seconds) + " s.</p>\n";
    }
    return html;
}

// The picture, with the elements that the script shows over it.
std::string picture(const ReportData& data) {
    std::string still =
        "<img alt=\"The part as milled\" src=\"data:image/png;base64," + base64(data.picture_png) + "\">\n";
    if (!data.part) return still;
    return "<figure id=\"part-view\">\n" + still +
           R"(<div class="live" hidden><canvas tabindex="0" role="application" aria-roledescription="3D view"
aria-label="The part as milled" aria-describedby="part-hint"></canvas></div>
<div class="choices" role="radiogroup" aria-label="Colour the part by" hidden>
<label><input type="radio" name="part-colour" value="surface" checked> surface</label>
<label><input type="radio" name="part-colour" value="deviation"> )" +
           data.part->deviation_from + R"(</label>
</div>
<div class="scale" hidden><i></i><span></span><span></span><span></span></div>
<figcaption class="live" id="part-hint" hidden>Bright: machined. Dull: untouched stock. Yellow: the tool's tip at the row below. Drag
or arrow keys turn it, two fingers or shift move it, + and - or the wheel after a click come nearer, Home or a double click
shows all again.</figcaption>
</figure>)";
}

std::string chatter(const ReportChatter& chatter) {
    std::string html = R"(<section id="chatter">
<h2>Chatter along the program</h2>
<p class="hint">By how much a small vibration grows from tooth to tooth. Above 1 the cut chatters.</p>
<div class="plot"><canvas id="chatter-plot" role="img" aria-label="Multiplier over time"></canvas></div>
)";
    html += "<p>" + escaped(chatter.advice) + "</p>\n";
    if (!chatter.chart_svg.empty())
        html += "<figure class=\"chart\">" + chatter.chart_svg.substr(chatter.chart_svg.find("<svg")) +
                "<figcaption>Stable speeds and depths where it chatters most</figcaption></figure>\n";
    if (!chatter.displacement_mm.empty())
        html +=
            "<figure><div class=\"plot\"><canvas id=\"vibration-plot\" role=\"img\" "
            "aria-label=\"Displacement over "
            "time\"></canvas></div><figcaption>" +
            escaped(chatter.label) + "</figcaption></figure>\n";
    return html + "</section>";
}

// Returns a JSON array with at most `digits` digits per number.
template <class Items, class Value>
std::string array_of(const Items& items, int digits, const Value& value) {
    std::string text = "[";
    for (const auto& item : items) {
        const double v = static_cast<double>(value(item));
        text += json_digits(std::isfinite(v) ? v : 0, digits);
        text += ',';
    }
    if (text.back() == ',') text.pop_back();
    return text + "]";
}

std::string rows_json(const std::vector<ReportRow>& rows, bool chatter) {
    struct Column {
        const char* name;
        int digits;
        std::function<double(const ReportRow&)> value;
    };
    using R = const ReportRow&;
    std::vector<Column> columns = {
        {"t", 8, [](R r) { return r.t_s; }},
        {"dt", 4, [](R r) { return r.duration_s; }},
        {"line", 9, [](R r) { return r.line; }},
        {"x", 6, [](R r) { return r.tip_mm.x; }},
        {"y", 6, [](R r) { return r.tip_mm.y; }},
        {"z", 6, [](R r) { return r.tip_mm.z; }},
        {"mean", 4, [](R r) { return r.mean_n; }},
        {"peak", 4, [](R r) { return r.peak_n; }},
        {"low", 4, [](R r) { return r.peak_low_n; }},
        {"high", 4, [](R r) { return r.peak_high_n; }},
        {"entry", 4, [](R r) { return r.entry_deg; }},
        {"exit", 4, [](R r) { return r.exit_deg; }},
        {"depth", 4, [](R r) { return r.depth_mm; }},
        {"rpm", 5, [](R r) { return r.rpm; }},
        {"feed", 4, [](R r) { return r.feed_mm_per_min; }},
    };
    if (chatter) {
        columns.push_back({"mu", 4, [](R r) { return r.multiplier; }});
        columns.push_back({"move", 4, [](R r) { return r.displacement_mm; }});
    }
    std::string json = "{";
    for (const Column& column : columns) {
        json += (json.size() > 1 ? ",\"" : "\"") + std::string(column.name) +
                "\":" + array_of(rows, column.digits, column.value);
    }
    return json + "}";
}

std::string turn_json(const ReportTurn& turn) {
    std::string json = "{\"t\":" + json_digits(turn.t_s, 6) + ",\"line\":" + std::to_string(turn.line) +
                       ",\"rpm\":" + json_digits(turn.rpm, 6);
    json += ",\"x\":" + array_of(turn.force_n, 4, [](Vec3 f) { return f.x; });
    json += ",\"y\":" + array_of(turn.force_n, 4, [](Vec3 f) { return f.y; });
    json += ",\"z\":" + array_of(turn.force_n, 4, [](Vec3 f) { return f.z; });
    json += ",\"hz\":" + array_of(turn.spectrum, 6, [](const auto& line) { return line.first; });
    json += ",\"amplitude\":" + array_of(turn.spectrum, 4, [](const auto& line) { return line.second; });
    return json + "}";
}

std::string vibration_json(const ReportChatter& chatter) {
    std::string json = "{\"label\":" + files::dump(files::Json(chatter.label)) +
                       ",\"rate\":" + json_digits(chatter.rate_hz, 8);
    json += ",\"x\":" + array_of(chatter.displacement_mm, 4, [](const auto& mm) { return mm.first; });
    json += ",\"y\":" + array_of(chatter.displacement_mm, 4, [](const auto& mm) { return mm.second; });
    return json + "}";
}

std::string sound_json(const ReportSound& sound) {
    std::string json = "\"envelope\":{\"seconds\":" + json_digits(sound.seconds, 8) +
                       ",\"heard\":" + json_digits(sound.heard_from_s, 8);
    json += ",\"low\":" + array_of(sound.envelope_pascal, 3, [](const auto& step) { return step.first; });
    json += ",\"high\":" + array_of(sound.envelope_pascal, 3, [](const auto& step) { return step.second; });
    json += "},\"waves\":[";
    for (const ReportWave& wave : sound.waves) {
        json += "{\"label\":" + files::dump(files::Json(wave.label)) +
                ",\"rate\":" + json_digits(wave.rate_hz, 8) +
                ",\"samples\":" + array_of(wave.pascal, 4, [](float p) { return p; }) + "},";
    }
    if (json.back() == ',') json.pop_back();
    return json + "]";
}

std::string data_json(const ReportData& data) {
    std::string json = "{\"schema\":\"tribo.report/1\",\"rows\":" +
                       rows_json(thin_rows(data.rows, kMostRows), data.chatter.has_value());
    if (data.turn && !data.turn->force_n.empty()) json += ",\"turn\":" + turn_json(*data.turn);
    if (data.chatter && !data.chatter->displacement_mm.empty())
        json += ",\"vibration\":" + vibration_json(*data.chatter);
    if (data.sound && data.sound->seconds > 0) json += "," + sound_json(*data.sound);
    if (data.part) json += ",\"part\":" + report_part_json(*data.part);
    json += "}";
    return json_for_script(json);
}

ReportRow joined(const ReportRow& a, const ReportRow& b) {
    ReportRow row = b.peak_n > a.peak_n ? b : a;
    row.t_s = a.t_s;
    row.duration_s = b.t_s + b.duration_s - a.t_s;
    row.multiplier = std::max(a.multiplier, b.multiplier);
    row.displacement_mm = std::max(a.displacement_mm, b.displacement_mm);
    const double both = a.duration_s + b.duration_s;
    if (both > 0) row.mean_n = (a.mean_n * a.duration_s + b.mean_n * b.duration_s) / both;
    return row;
}

}  // namespace

std::vector<ReportRow> thin_rows(const std::vector<ReportRow>& rows, std::size_t most) {
    std::vector<ReportRow> thin = rows;
    while (thin.size() > most && most > 0) {
        const std::size_t before = thin.size();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < before; ++i) {
            const bool last = i + 1 == before;
            const double end = thin[i].t_s + thin[i].duration_s;
            if (!last && thin[i + 1].t_s <= end + kGapShare * thin[i].duration_s) {
                thin[kept++] = joined(thin[i], thin[i + 1]);
                ++i;
            } else {
                thin[kept++] = thin[i];
            }
        }
        thin.resize(kept);
        if (kept == before) break;  // only gaps are left
    }
    return thin;
}

std::vector<ReportRow> worst_lines(const std::vector<ReportRow>& rows) {
    std::map<int, ReportRow> of_line;
    for (const ReportRow& row : rows) {
        if (row.line <= 0) continue;
        const auto [at, is_new] = of_line.try_emplace(row.line, row);
        if (!is_new && row.peak_n > at->second.peak_n) at->second = row;
    }
    std::vector<ReportRow> worst;
    worst.reserve(of_line.size());
    for (const auto& [line, row] : of_line) worst.push_back(row);
    std::ranges::sort(worst, [](const ReportRow& a, const ReportRow& b) {
        return a.peak_n != b.peak_n ? a.peak_n > b.peak_n : a.line < b.line;
    });
    worst.resize(std::min(worst.size(), kWorstLines));
    return worst;
}

std::string report_html(const ReportData& data) {
    return filled(kReportPage, [&](std::string_view mark) -> std::string {
        if (mark == "title") return escaped(data.title);
        if (mark == "subtitle") return escaped(data.subtitle);
        if (mark == "style") return std::string(kReportStyle);
        if (mark == "script") return std::string(kReportScript);
        if (mark == "cards") return cards(data.summary);
        if (mark == "notices") return notices(data.summary);
        if (mark == "chatter") return data.chatter ? chatter(*data.chatter) : "";
        if (mark == "sheet") return sheet(data);
        if (mark == "facts") return facts(data.facts);
        if (mark == "audio") return data.sound ? audio(*data.sound) : "";
        if (mark == "data") return data_json(data);
        if (mark == "footer")
            return "Tribo " + escaped(data.summary.version) +
                   ". Units: mm, N, s. <span id=\"written\"></span>";
        if (mark == "picture" && !data.picture_png.empty()) return picture(data);
        if (mark == "part" && data.part) {
            return "<script type=\"text/plain\" id=\"part\">" + base64(report_part_bytes(*data.part)) +
                   "</script>";
        }
        if (mark == "view" && data.part) return std::string(kReportView);
        return "";
    });
}

}  // namespace tribo::report
