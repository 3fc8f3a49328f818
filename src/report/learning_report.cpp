// SPDX-License-Identifier: MIT
#include "report/learning_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "report/html_parts.hpp"
#include "report/report_page.hpp"

namespace tribo::report {
namespace {

std::string fixed(double value, int decimals) {
    std::array<char, 48> text = {};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

struct PlotLine {
    const char* name;
    const char* style;  // CSS variable
    const std::vector<double>* values;
};

// Plots levels in dB over a logarithmic frequency axis.
std::string plot(const std::vector<double>& hz, const std::vector<PlotLine>& lines, double from_hz,
                 double to_hz) {
    constexpr double kWidth = 560, kHeight = 240, kLeft = 46, kBottom = 26;
    double top = -1e9, bottom = 1e9;
    for (const PlotLine& line : lines) {
        for (std::size_t n = 0; n < hz.size(); ++n) {
            if (hz[n] < from_hz || hz[n] > to_hz) continue;
            top = std::max(top, (*line.values)[n]);
            bottom = std::min(bottom, (*line.values)[n]);
        }
    }
    if (!(top > bottom)) return "<p class=\"hint\">Nothing to draw.</p>";
    bottom = std::max(bottom, top - 90);
    top = 10 * std::ceil((top + 1) / 10);
    bottom = 10 * std::floor((bottom - 1) / 10);
    const auto x_of = [&](double f) {
        return kLeft + (kWidth - kLeft - 8) * std::log(f / from_hz) / std::log(to_hz / from_hz);
    };
    const auto y_of = [&](double level) {
        return 8 + (kHeight - kBottom - 8) * (top - std::clamp(level, bottom, top)) / (top - bottom);
    };
    std::string svg =
        "<svg viewBox=\"0 0 " + fixed(kWidth, 0) + " " + fixed(kHeight, 0) + "\" role=\"img\">\n";
    const auto text = [&](double x, double y, const char* anchor, const std::string& label) {
        svg += "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor + "\">" +
               label + "</text>\n";
    };
    const auto rule = [&](double x1, double y1, double x2, double y2) {
        svg += "<line x1=\"" + fixed(x1, 1) + "\" y1=\"" + fixed(y1, 1) + "\" x2=\"" + fixed(x2, 1) +
               "\" y2=\"" + fixed(y2, 1) + "\"/>\n";
    };
    const double step = top - bottom > 50 ? 20 : top - bottom > 20 ? 10 : 5;
    for (double level = step * std::ceil(bottom / step); level <= top; level += step) {
        rule(kLeft, y_of(level), kWidth - 8, y_of(level));
        text(kLeft - 6, y_of(level) + 4, "end", fixed(level, 0));
    }
    for (double decade = 1; decade < to_hz; decade *= 10) {
        for (const double part : {1.0, 2.0, 5.0}) {
            const double f = part * decade;
            if (f < from_hz || f > to_hz) continue;
            rule(x_of(f), 8, x_of(f), kHeight - kBottom);
            text(x_of(f), kHeight - 8, "middle", f >= 1000 ? fixed(f / 1000, 0) + "k" : fixed(f, 0));
        }
    }
    for (const PlotLine& line : lines) {
        svg += std::string("<polyline style=\"stroke:var(") + line.style + ")\" points=\"";
        for (std::size_t n = 0; n < hz.size(); ++n) {
            if (hz[n] < from_hz || hz[n] > to_hz) continue;
            svg += fixed(x_of(hz[n]), 1) + "," + fixed(y_of((*line.values)[n]), 1) + " ";
        }
        svg += "\"/>\n";
    }
    return svg + "</svg>\n";
}

std::string legend(const std::vector<PlotLine>& lines) {
    std::string html = "<p class=\"legend\">";
    for (const PlotLine& line : lines) {
        html += std::string("<span style=\"color:var(") + line.style + ")\">&#9632;</span> " + line.name +
                " &nbsp; ";
    }
    return html + "</p>\n";
}

std::string player(const std::string& label, const std::vector<float>& sound, double rate_hz) {
    return "<p>" + label + "<br><audio controls preload=\"metadata\" src=\"data:audio/wav;base64," +
           base64(wav_bytes_16(sound, 1, rate_hz)) + "\"></audio></p>\n";
}

std::string row(const std::string& name, const std::array<std::string, 3>& cells, const char* hint) {
    std::string html = "<tr><th scope=\"row\">" + name + "<br><small>" + hint + "</small></th>";
    for (const std::string& cell : cells) html += "<td class=\"number\">" + cell + "</td>";
    return html + "</tr>\n";
}

std::string figures_of(const noise::VoiceQuality& q) {
    const auto three = [](const noise::Trio& t, int decimals) {
        return std::array<std::string, 3>{fixed(t.original, decimals), fixed(t.gaussian, decimals),
                                          fixed(t.voice, decimals)};
    };
    std::string html =
        "<table><tr><th></th><th>recording</th><th>filter and white noise</th><th>voice</th></tr>\n";
    html += row("Kurtosis", three(q.kurtosis, 1), "3 is Gaussian, more is grain");
    html += row("Level deviation, 10 ms frames", three(q.deviation_db, 2),
                "dB, the recording without the slow level of its hand");
    html +=
        "</table>\n<table><tr><th></th><th>voice</th><th>plain fit, order 50</th><th>the halves "
        "themselves</th></tr>\n";
    html += row("Held-out spectral distance",
                {fixed(q.held_out_db, 2), fixed(q.held_out_plain_db, 2), fixed(q.halves_db, 2)},
                "dB, fitted on one half, held against the other");
    html += row("Level error", {fixed(q.level_error_db, 2), "", ""}, "dB, a minute played");
    return html + "</table>\n";
}

std::string section(const ReportedVoice& v) {
    const noise::VoiceQuality& q = v.quality;
    char title[96];
    std::snprintf(title, sizeof title, "%.4g mm/s, %.3g N, %.1f dB", v.model.speed_mm_per_s, v.model.force_n,
                  v.model.level_db);
    const std::vector<PlotLine> spectra{{"recording", "--peak", &q.original_db},
                                        {"model", "--mean", &q.model_db}};
    const std::vector<PlotLine> modulation{{"recording", "--peak", &q.modulation.original_db},
                                           {"filter and white noise", "--z", &q.modulation.gaussian_db},
                                           {"voice", "--mean", &q.modulation.voice_db}};
    std::string html =
        std::string("<section><h2>") + title + "</h2><p class=\"hint\">" + escaped(v.recording) +
        "</p>\n<div class=\"pair\"><figure>" +
        plot(q.hz, spectra, 50, std::min(20000.0, 0.5 * q.sample_rate_hz)) + legend(spectra) +
        "<figcaption>Power spectrum, dB of full scale, over Hz.</figcaption></figure>\n<figure>" +
        plot(q.modulation.hz, modulation, 5, 200) + legend(modulation) +
        "<figcaption>Modulation spectrum: how strongly the envelope fluctuates, the slow level of the hand "
        "apart, dB, over "
        "Hz.</figcaption></figure></div>\n" +
        figures_of(q) + "<div class=\"pair\"><div>" + player("Recording", q.original, q.sample_rate_hz) +
        player("Voice", q.voice, q.sample_rate_hz) + "</div><div>" +
        player("Filter and white noise alone", q.gaussian, q.sample_rate_hz) + "</div></div>\n";
    return html + "</section>\n";
}

}  // namespace

std::string learning_report(const material::Material& material, const noise::Learned& learned,
                            const std::vector<ReportedVoice>& voices) {
    const std::string name = escaped(material.name);
    std::string html =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
        "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
        "media-src data:; base-uri 'none'; form-action 'none'\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>" +
        name + ": learned voices</title>\n<style>" + std::string(kReportStyle) +
        "svg{width:100%;height:auto;background:var(--card);border:1px solid var(--line);"
        "border-radius:8px}svg line{stroke:var(--grid)}svg text{fill:var(--soft);font-size:11px}"
        "svg polyline{fill:none;stroke-width:1.4}table{margin:12px 0}.legend{font-size:13px;"
        "margin:4px 0;color:var(--soft)}</style></head><body>\n<header><p class=\"mark\">Tribo</p><h1>" +
        name + "</h1><p class=\"subtitle\">" + std::to_string(material.voices.models.size()) +
        (material.voices.models.size() == 1 ? " voice" : " voices") + " of order " +
        std::to_string(learned.order) + ", " + escaped(material.method) + ", high-pass " +
        fixed(material.highpass_hz, 0) + " Hz; level " + fixed(material.voices.law.level_db, 1) +
        " dB at 100 mm/s and 1 N, " + fixed(material.voices.law.db_per_decade_speed, 1) +
        " dB per decade of speed, " + fixed(material.voices.law.db_per_decade_force, 1) +
        " of force</p></header>\n";
    if (!material.note.empty()) html += "<div class=\"notice\">" + escaped(material.note) + "</div>\n";
    for (const Warning& w : learned.warnings)
        html += "<div class=\"notice\">" + escaped(w.message()) + "</div>\n";
    if (!learned.held_out_db.empty()) {
        std::vector<double> orders;
        for (std::size_t n = 0; n < learned.held_out_db.size(); ++n)
            orders.push_back(static_cast<double>(n + 1));
        html += "<section><h2>Order</h2><figure style=\"max-width:560px\">" +
                plot(orders, {{"held out", "--mean", &learned.held_out_db}}, 1,
                     static_cast<double>(orders.size())) +
                "<figcaption>Distance from the spectrum of sound that was not fitted, dB, over the number of "
                "poles.</figcaption></figure></section>\n";
    }
    for (const ReportedVoice& v : voices) html += section(v);
    return html + "</body></html>\n";
}

}  // namespace tribo::report
