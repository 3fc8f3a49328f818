// SPDX-License-Identifier: MIT
// Facts of a frequency response for `tribo inspect`.
#include <cstdio>

#include "files/json/json.hpp"
#include "report/facts.hpp"

namespace tribo::report {
namespace {

template <class... Values>
std::string worded(const char* format, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace

Facts describe(const readers::FrequencyResponse& response, const Result<dynamics::ModeFit>& fit,
               const Warnings& warnings) {
    Facts facts;
    facts.warnings = warnings;
    const double from_hz = response.frequency_hz.front(), to_hz = response.frequency_hz.back();
    files::Json json;
    json["schema"] = "tribo.inspect/1";
    json["kind"] = "frequency response";
    json["what"] = response.description;
    json["points"] = response.frequency_hz.size();
    json["band_hz"] = {from_hz, to_hz};
    facts.lines.emplace_back("format", "frequency response: " + response.description);
    facts.lines.emplace_back(
        "points", std::to_string(response.frequency_hz.size()) + worded(", %.6g to %.6g Hz", from_hz, to_hz));
    json["modes"] = files::Json::array();
    if (fit) {
        for (const dynamics::FittedMode& m : fit->modes) {
            json["modes"].push_back({{"frequency_hz", m.frequency_hz},
                                     {"damping_ratio", m.damping_ratio},
                                     {"stiffness_n_per_mm", m.stiffness_n_per_mm}});
            facts.lines.emplace_back("mode", worded("%.5g Hz, damping %.4g %%, %.4g N/mm", m.frequency_hz,
                                                    100 * m.damping_ratio, m.stiffness_n_per_mm));
        }
        json["residual"] = fit->residual;
        facts.lines.emplace_back("residual", worded("%.3g %%", 100 * fit->residual));
    } else {
        facts.lines.emplace_back("modes", "none: " + fit.error().cause);
        facts.warnings.push_back({fit.error().file, fit.error().line, fit.error().cause});
    }
    json["warnings"] = files::Json::array();
    for (const Warning& w : facts.warnings) json["warnings"].push_back(w.message());
    facts.json = files::pretty(json);
    return facts;
}

}  // namespace tribo::report
