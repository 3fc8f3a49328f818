// SPDX-License-Identifier: MIT
#include "report/audit/audit_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "report/html_parts.hpp"
#include "report/report_page.hpp"

namespace tribo::report {
namespace {

std::string number(double value, const char* format = "%.1f") {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

// 1, 2 or 5 times a power of ten: about `parts` of them up to the value.
double step_of(double most, int parts) {
    const double rough = most / parts, power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= rough) return step * power;
    return 10 * power;
}

std::string chart(const AuditCurve& curve) {
    constexpr double kWidth = 1100, kHeight = 220, kLeft = 60, kBottom = 24, kTop = 8;
    const double most = std::max(*std::ranges::max_element(curve.values), curve.limit);
    if (!(most > 0) || !(curve.duration_s > 0)) return "<p class=\"hint\">Nothing to draw.</p>\n";
    const double top = 1.05 * most;
    const auto x_of = [&](double t_s) { return kLeft + (kWidth - kLeft - 8) * t_s / curve.duration_s; };
    const auto y_of = [&](double value) {
        return kHeight - kBottom - (kHeight - kBottom - kTop) * value / top;
    };
    std::string svg = "<svg viewBox=\"0 0 " + number(kWidth, "%.0f") + " " + number(kHeight, "%.0f") +
                      "\" role=\"img\" aria-label=\"" + escaped(curve.title) + "\">\n";
    const auto rule = [&](double x1, double y1, double x2, double y2, const char* style) {
        svg += "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
               number(y2) + "\" class=\"" + style + "\"/>\n";
    };
    const auto text = [&](double x, double y, const char* anchor, double value) {
        svg += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
               number(value, "%.4g") + "</text>\n";
    };
    for (double value = 0, step = step_of(top, 5); value <= top; value += step) {
        rule(kLeft, y_of(value), kWidth - 8, y_of(value), "grid");
        text(kLeft - 6, y_of(value) + 4, "end", value);
    }
    for (double t = 0, step = step_of(curve.duration_s, 10); t <= curve.duration_s; t += step)
        text(x_of(t), kHeight - 6, "middle", t);
    svg += "<polyline points=\"";
    const auto steps = static_cast<double>(curve.values.size());
    for (std::size_t n = 0; n < curve.values.size(); ++n)
        for (const double edge : {0.0, 1.0})
            svg += number(x_of((static_cast<double>(n) + edge) / steps * curve.duration_s)) + "," +
                   number(y_of(curve.values[n])) + " ";
    svg += "\"/>\n";
    if (curve.limit > 0) rule(kLeft, y_of(curve.limit), kWidth - 8, y_of(curve.limit), "limit");
    return svg + "</svg>\n";
}

}  // namespace

std::string audit_page(const AuditPage& page) {
    std::string html =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
        "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
        "base-uri 'none'; form-action 'none'\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>" +
        escaped(page.title) + ": audit</title>\n<style>" + std::string(kReportStyle) +
        "svg{width:100%;height:auto;background:var(--card);border:1px solid var(--line);border-radius:8px}"
        "svg .grid{stroke:var(--grid)}svg .limit{stroke:var(--bad);stroke-width:1.5;stroke-dasharray:6 4}"
        "svg text{fill:var(--soft);font-size:12px}svg polyline{fill:none;stroke:var(--mean);stroke-width:1.2}"
        ".verdict{font-size:19px;margin:18px 0}"
        "</style></head><body>\n<header><p class=\"mark\">Tribo</p><h1>" +
        escaped(page.title) + "</h1><p class=\"subtitle\">" + escaped(page.subtitle) + "</p></header>\n";
    html += "<main>\n<p class=\"verdict notice" + std::string(page.is_bad ? " bad" : "") + "\">" +
            escaped(page.verdict) + "</p>\n";
    html += notice_list(page.findings, "Findings", page.is_bad ? "bad" : "");
    for (const AuditCurve& curve : page.curves)
        html += "<section><h2>" + escaped(curve.title) + "</h2><figure>" + chart(curve) +
                "<figcaption>Over the time of the program, s.</figcaption></figure></section>\n";
    for (const HtmlTable& t : page.tables) html += html_of(t);
    html += "<section><h2>Set-up</h2><table>\n";
    for (const auto& [name, text] : page.facts)
        html += "<tr><th scope=\"row\">" + escaped(name) + "</th><td>" + escaped(text) + "</td></tr>\n";
    html += "</table></section>\n" + notice_list(page.warnings, "Warnings");
    return html + "</main>\n<footer>Tribo " + escaped(page.version) +
           ". Units: mm, N, s.</footer>\n</body></html>\n";
}

}  // namespace tribo::report
