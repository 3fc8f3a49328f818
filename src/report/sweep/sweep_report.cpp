// SPDX-License-Identifier: MIT
#include "report/sweep/sweep_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "report/html_parts.hpp"
#include "report/report_page.hpp"

namespace tribo::report {
namespace {

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

// Equal in all cases but for rounding.
bool is_constant(const SweepOutput& output) {
    constexpr double kRounding = 1e-9;
    return output.most - output.least <= kRounding * std::max(std::abs(output.least), std::abs(output.most));
}

std::string histogram(const SweepOutput& output) {
    constexpr double kWidth = 260, kHeight = 60;
    const std::uint64_t most = output.histogram.empty() ? 0 : std::ranges::max(output.histogram);
    if (most == 0 || is_constant(output)) return "<p class=\"hint\">always the same</p>";
    std::string svg = "<svg viewBox=\"0 0 260 60\" role=\"img\" aria-label=\"distribution of " +
                      escaped(output.name) + "\">";
    const double width = kWidth / static_cast<double>(output.histogram.size());
    for (std::size_t n = 0; n < output.histogram.size(); ++n) {
        const double height = kHeight * static_cast<double>(output.histogram[n]) / static_cast<double>(most);
        svg += "<rect x=\"" + number(static_cast<double>(n) * width) + "\" y=\"" + number(kHeight - height) +
               "\" width=\"" + number(0.9 * width) + "\" height=\"" + number(height) + "\"/>";
    }
    return svg + "</svg>";
}

std::string bar(double share) {
    const double percent = 100 * std::clamp(share, 0.0, 1.0);
    return "<span class=\"bar\" style=\"width:" + number(percent) + "px\"></span> " + number(share);
}

std::string shares_table(const SweepReport& report) {
    std::string html =
        "<section><h2>Which input moves which result</h2><p class=\"hint\">Sobol' indices: the share of the "
        "variance of a result that an input causes alone, and together with the others (total). An input "
        "with a total near 0 does not matter here.</p>\n";
    for (const SweepOutput& output : report.outputs) {
        if (output.shares.empty() || is_constant(output)) continue;
        html += "<h3>" + escaped(output.name) +
                "</h3><table><tr><th>input</th><th>alone</th><th>total</th></tr>\n";
        std::vector<std::size_t> order(report.inputs.size());
        for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
        std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
            return std::pair(-output.shares[a].total, a) < std::pair(-output.shares[b].total, b);
        });
        for (const std::size_t n : order)
            html += "<tr><th scope=\"row\">" + escaped(report.inputs[n].key) + "</th><td>" +
                    bar(output.shares[n].first) + "</td><td>" + bar(output.shares[n].total) + "</td></tr>\n";
        html += "</table>\n";
    }
    return html + "</section>\n";
}

std::string outputs_table(const SweepReport& report) {
    std::string html =
        "<section><h2>Results</h2><p class=\"hint\">In 9 of 10 cases a result lies between low and high. "
        "Cases are counted from 0.</p>\n<table><tr><th>result</th>";
    for (const char* column : {"low", "median", "high", "mean", "least (case)", "most (case)"})
        html += std::string("<th class=\"number\">") + column + "</th>";
    html += "<th>distribution</th></tr>\n";
    for (const SweepOutput& o : report.outputs) {
        html += "<tr><th scope=\"row\">" + escaped(o.name) + "</th>";
        for (const double value : {o.band.low, o.band.median, o.band.high, o.mean})
            html += "<td class=\"number\">" + number(value) + "</td>";
        html += "<td class=\"number\">" + number(o.least) + " (" + std::to_string(o.least_case) +
                ")</td><td class=\"number\">" + number(o.most) + " (" + std::to_string(o.most_case) +
                ")</td><td>" + histogram(o) + "</td></tr>\n";
    }
    return html + "</table></section>\n";
}

std::string inputs_table(const SweepReport& report) {
    std::string html = "<section><h2>Inputs</h2><table>\n";
    for (const SweepInput& input : report.inputs)
        html += "<tr><th scope=\"row\">" + escaped(input.key) + "</th><td>" + escaped(input.values) +
                "</td></tr>\n";
    return html + "</table><p class=\"hint\">One case again: <code>tribo sweep " + escaped(report.file) +
           " --case N</code></p></section>\n";
}

std::string failures_table(const SweepReport& report) {
    if (report.failures.empty()) return {};
    std::string html =
        "<section><h2>Cases without a result</h2><table><tr><th>reason</th><th>cases</th><th>one of them"
        "</th></tr>\n";
    for (const SweepFailure& failure : report.failures)
        html += "<tr><td>" + escaped(failure.reason) + "</td><td class=\"number\">" +
                std::to_string(failure.count) + "</td><td class=\"number\">" +
                std::to_string(failure.example) + "</td></tr>\n";
    return html + "</table></section>\n";
}

}  // namespace

std::string sweep_report(const SweepReport& report) {
    const std::string name = escaped(report.file);
    std::string html =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
        "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
        "base-uri 'none'; form-action 'none'\">\n<meta name=\"viewport\" content=\"width=device-width, "
        "initial-scale=1\"><title>" +
        name + ": sweep</title>\n<style>" + std::string(kReportStyle) +
        "th.number{text-align:right}svg{width:200px;height:46px}svg rect{fill:var(--mean)}table{margin:12px "
        "0;border-spacing:14px 4px}"
        ".bar{display:inline-block;height:10px;background:var(--mean)}section{overflow-x:auto}"
        "</style></head><body>\n<header><p class=\"mark\">Tribo " +
        escaped(report.version) + "</p><h1>" + name + "</h1><p class=\"subtitle\">" +
        std::to_string(report.finished) + " of " + std::to_string(report.planned) +
        " cases finished</p></header>\n";
    const bool sampled =
        std::ranges::any_of(report.outputs, [](const SweepOutput& o) { return !o.shares.empty(); });
    html += outputs_table(report);
    if (sampled) html += shares_table(report);
    return html + inputs_table(report) + failures_table(report) + "</body></html>\n";
}

}  // namespace tribo::report
