// SPDX-License-Identifier: MIT
#include "app/audit/audit_outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/text/decimal.hpp"
#include "base/text/printable.hpp"
#include "files/json/json.hpp"
#include "job/words/tool_words.hpp"
#include "report/audit/audit_page.hpp"
#include "session/audit/audit_json.hpp"

namespace tribo::app {
namespace {

constexpr std::size_t kShownLines = 10;

std::string digits(double value, int count = 4) {
    return format_digits(value, count);
}

std::string tool_name(const milling::Cutter& cutter) {
    return cutter.number > 0 ? "T" + std::to_string(cutter.number) : "tool";
}

// The text of lines of a program file, where it can be read again.
class ProgramText {
  public:
    explicit ProgramText(const std::string& file) {
        if (auto text = files::read_file(file, files::kLargestInputBytes, files::Pipes::refuse))
            text_ = *std::move(text);
        for (std::size_t at = 0; at < text_.size(); at = std::min(text_.find('\n', at), text_.size() - 1) + 1)
            begins_.push_back(at);
    }
    std::string line(int number) const {
        if (number < 1 || static_cast<std::size_t>(number) > begins_.size()) return "";
        const std::size_t from = begins_[static_cast<std::size_t>(number) - 1];
        return printable(
            text_.substr(from, std::min(text_.find_first_of("\r\n", from), text_.size()) - from));
    }

  private:
    std::string text_;
    std::vector<std::size_t> begins_;
};

std::string ratio_text(const session::LoadTally& tally, session::LoadKind kind,
                       const session::LoadModel& model) {
    const session::PeakLoad& peak = tally.of(kind);
    return peak.ratio > 0 ? in_words(session::band_of(tally, kind, model)) : "";
}

std::string loads_text(const session::LoadTally& tally, session::LoadKind kind) {
    const double value = tally.of(kind).value;
    const std::string unit(session::words_of(kind).unit);
    return value > 0 ? digits(value, 3) + (unit.empty() ? "" : " " + unit) : "";
}

}  // namespace

bool is_audit_file(const std::string& name) {
    static constexpr std::array<std::string_view, 3> names{"audit.csv", "audit.json", "audit.html"};
    return std::ranges::find(names, name) != names.end();
}

FileResult<AuditCsv> AuditCsv::create(const std::string& path, bool has_form_error, bool has_design) {
    auto file = files::FileWriter::create(path);
    if (!file) return std::unexpected(file.error());
    std::string header = "line,t_s,tool,spindle_rpm,duration_s,feed_mm,feed_s,cutting_s,removed_mm3";
    for (const session::LoadWords& words : session::kLoadWords) header += "," + std::string(words.key);
    header += ",rubbing_s,plunge_deg,jump_n,entries,collisions,worst,ratio_low,ratio,ratio_high";
    if (has_form_error) header += ",bending_leaves_mm,bending_overcuts_mm";
    if (has_design) header += ",gouge_mm,scallop_mm";
    file->write(header + "\n");
    return AuditCsv(std::move(*file), has_form_error, has_design);
}

void AuditCsv::add(const session::LoadTally& line, const session::LoadModel& model,
                   const session::MillSetup& setup) {
    std::array<char, 400> text{};
    int n =
        std::snprintf(text.data(), text.size(), "%d,%.6f,%d,%.6g,%.6f,%.4f,%.6f,%.6f,%.4f", line.line,
                      line.start_s, setup.cutters[line.cutter].number, line.spindle_rpm,
                      line.end_s - line.start_s, line.feed_mm, line.feed_s, line.cutting_s, line.removed_mm3);
    std::string row(text.data(), static_cast<std::size_t>(n));
    for (const session::PeakLoad& peak : line.peaks) {
        n = std::snprintf(text.data(), text.size(), ",%.6g", peak.value);
        row.append(text.data(), static_cast<std::size_t>(n));
    }
    const auto worst = line.worst();
    const session::RatioBand band = worst ? session::band_of(line, *worst, model) : session::RatioBand{};
    const std::string_view key = worst ? session::words_of(*worst).key : "";
    n = std::snprintf(text.data(), text.size(), ",%.6f,%.2f,%.3f,%d,%d,%.*s,%.4g,%.4g,%.4g",
                      line.thin.below_value_s, line.plunge_deg, line.jump_n, line.entries, line.collisions,
                      static_cast<int>(key.size()), key.data(), band.low, band.value, band.high);
    row.append(text.data(), static_cast<std::size_t>(n));
    if (has_form_error_ || has_design_) {
        rows_.push_back({line.start_s, line.end_s, std::move(row)});
    } else {
        file_.write(row + "\n");
    }
}

FileResult<void> AuditCsv::finish(const surface::FormError& form_error,
                                  const std::optional<session::PartErrors>& errors) {
    const auto two = [](double first_mm, double second_mm) {
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), ",%.4g,%.4g", first_mm, second_mm);
        return std::string(text.data());
    };
    for (const Row& row : rows_) {
        std::string text = row.text;
        if (has_form_error_) {
            const surface::FormError::Extremes e = form_error.extremes_between(row.start_s, row.end_s);
            text += two(e.left_mm, e.overcut_mm);
        }
        if (errors) {
            const session::PartErrors::Largest e = errors->between(row.start_s, row.end_s);
            text += two(e.gouge_mm, e.scallop_mm);
        }
        file_.write(text + "\n");
    }
    return file_.finish();
}

void LoadCurve::add(double from_s, double to_s, double value) {
    if (!(duration_s_ > 0)) return;
    const auto step_at = [&](double t_s) {
        const double step = std::floor(t_s / duration_s_ * static_cast<double>(kSteps));
        return static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(kSteps - 1)));
    };
    for (std::size_t n = step_at(from_s); n <= step_at(to_s); ++n) values_[n] = std::max(values_[n], value);
}

std::string audit_json(const AuditCall& call, const AuditAnswer& answer, const PreparedJob& loaded,
                       const session::LoadModel& model, const session::MillSession& session) {
    files::Json json;
    json["schema"] = "tribo.audit/1";
    json["version"] = TRIBO_VERSION;
    json["job"] = call.job;
    json["material"] = loaded.material.name;
    json.update(
        files::parse(session::audit_json(answer.audit, answer.verdict, answer.facts, model, session)));
    if (answer.uncertain) json["uncertain_cases"] = *answer.uncertain;
    files::set(json, "rest_max_mm", answer.rest_mm);
    files::set(json, "scallop_max_mm", answer.scallop_mm);
    if (answer.errors) {
        json["gouges"] = files::Json::array();
        for (const session::PartErrors::Gouge& gouge : answer.errors->gouges())
            json["gouges"].push_back({{"line", gouge.line}, {"gouge_mm", gouge.mm}});
    }
    if (call.stable) json["speeds"] = speeds_json(answer.speeds);
    json["warnings"] = files::Json::array();
    for (const Warning& w : answer.warnings) json["warnings"].push_back(w.message());
    return files::pretty(json);
}

std::string audit_html(const AuditCall& call, const AuditAnswer& answer, const PreparedJob& loaded,
                       const session::LoadModel& model, const session::MillSession& session) {
    using session::LoadKind;
    const session::MillSetup& setup = session.setup();
    const session::Audit& audit = answer.audit;
    report::AuditPage page;
    page.title = call.job;
    page.subtitle = loaded.material.name + ", " + digits(audit.duration_s, 3) + " s, " +
                    std::to_string(audit.line_count) + " lines that move";
    page.verdict = answer.verdict.sentence;
    page.version = TRIBO_VERSION;
    page.is_bad = answer.verdict.outcome == session::Outcome::over;
    for (const session::Finding& f : answer.verdict.findings)
        page.findings.push_back(std::string(name_of(f.outcome)) + ": " + f.text);
    for (const Warning& w : answer.warnings) page.warnings.push_back(w.message());
    page.curves.push_back({"Largest force, N", answer.force_n.duration_s(), answer.force_n.values(), 0});
    page.curves.push_back(
        {"Load over the limit that is nearest", answer.ratio.duration_s(), answer.ratio.values(), 1});

    report::HtmlTable tools{"Tools",
                            "Ratios are loads over their limits, with the band of forces and limits.",
                            {"Tool", "Cutter", "Cutting, s", "Feed, mm"},
                            {}};
    report::HtmlTable limits{"Limits", "Where each limit is from.", {"Tool", "Load", "Limit", "From"}, {}};
    for (const session::LoadWords& words : session::kLoadWords) tools.header.emplace_back(words.name);
    const std::array<std::string, 2> of_part{"Gouge, mm", "Scallop, mm"};
    const auto add_errors = [](const session::LoadTally& tally, std::vector<std::string>& row) {
        if (!tally.gouge_mm) return;
        row.push_back(digits(*tally.gouge_mm, 3));
        row.push_back(digits(tally.scallop_mm.value_or(0), 3));
    };
    if (answer.errors) tools.header.insert(tools.header.end(), of_part.begin(), of_part.end());
    for (const session::LoadTally& tool : audit.tools) {
        const milling::Cutter& cutter = setup.cutters[tool.cutter];
        std::vector<std::string> row{tool_name(cutter), job::tool_words(cutter), digits(tool.cutting_s, 3),
                                     digits(tool.feed_mm, 3)};
        for (std::size_t n = 0; n < session::kLoadKinds; ++n) {
            const auto kind = static_cast<LoadKind>(n);
            const std::string ratio = ratio_text(tool, kind, model);
            row.push_back(loads_text(tool, kind) + (ratio.empty() ? "" : " (" + ratio + ")"));
            const auto& limit = model.limits().of_cutter[tool.cutter].most[n];
            if (!limit) continue;
            const std::string unit(session::kLoadWords[n].unit);
            std::string value = limit->value > 0 ? digits(limit->value) + " " + unit : "by speed";
            if (limit->low != limit->high)
                value += " (" + digits(limit->low) + " to " + digits(limit->high) + ")";
            limits.rows.push_back(
                {tool_name(cutter), std::string(session::kLoadWords[n].name), value, limit->source});
        }
        add_errors(tool, row);
        tools.rows.push_back(std::move(row));
        const session::CutLimit& least = model.limits().of_cutter[tool.cutter].least_chip;
        limits.rows.push_back({tool_name(cutter), "least chip", digits(least.value) + " mm", least.source});
    }
    report::HtmlTable worst{
        "Worst lines",
        "Those whose load is nearest to, or farthest over, its limit.",
        {"Line", "Text", "Tool", "Load", "Value", "Of its limit", "Plunge, deg", "Jump, N"},
        {}};
    if (answer.errors) worst.header.insert(worst.header.end(), of_part.begin(), of_part.end());
    const ProgramText text(loaded.job.path.file);
    for (std::size_t n = 0; n < std::min(kShownLines, audit.worst.size()); ++n) {
        const session::LoadTally& line = audit.worst[n];
        const LoadKind kind = *line.worst();
        worst.rows.push_back(
            {std::to_string(line.line), text.line(line.line), tool_name(setup.cutters[line.cutter]),
             std::string(session::words_of(kind).name), loads_text(line, kind), ratio_text(line, kind, model),
             digits(line.plunge_deg, 3), digits(line.jump_n, 3)});
        add_errors(line, worst.rows.back());
    }
    page.tables = {std::move(tools), std::move(worst)};
    if (answer.errors && !answer.errors->gouges().empty()) {
        report::HtmlTable gouges{
            "Gouges", "The lines that cut deepest into the design.", {"Line", "Text", "Gouge, mm"}, {}};
        for (const session::PartErrors::Gouge& gouge : answer.errors->gouges()) {
            if (gouges.rows.size() == kShownLines) break;
            gouges.rows.push_back({std::to_string(gouge.line), text.line(gouge.line), digits(gouge.mm, 3)});
        }
        page.tables.push_back(std::move(gouges));
    }
    page.tables.push_back(std::move(limits));
    if (call.stable) {
        report::HtmlTable speeds{"Spindle speeds",
                                 "Speeds without chatter; feeds follow them, so that the chips stay.",
                                 {"Speed"},
                                 {}};
        for (std::string& text : in_words(answer.speeds)) speeds.rows.push_back({std::move(text)});
        page.tables.push_back(std::move(speeds));
    }
    const Box3 blank = session.stock().blank().bounds_mm();
    const Vec3 size = blank.size();
    page.facts = {
        {"Program", loaded.job.path.file},
        {"Stock", digits(size.x) + " x " + digits(size.y) + " x " + digits(size.z) + " mm, from " +
                      digits(blank.min.x) + ", " + digits(blank.min.y) + ", " + digits(blank.min.z)},
        {"Material", loaded.material.name + ": " + loaded.material.what},
        {"Forces", digits(model.force_low_factor(), 2) + " to " + digits(model.force_high_factor(), 2) +
                       " times what stands here; " + loaded.material.source},
        {"Bands", answer.uncertain ? "9 of 10 of " + std::to_string(*answer.uncertain) +
                                         " cases of forces, run-out and modes, over the band of each limit"
                                   : "the factors of the forces over the band of each limit"},
        {"Feed without a chip", digits(100 * audit.air_share(), 2) + " % of the time of feed moves"},
        {"Resolution", digits(setup.cell_mm) + " mm"}};
    if (answer.facts.gouge_mm)
        page.facts.emplace_back("Deviation", "gouge " + digits(*answer.facts.gouge_mm, 3) + " mm, rest " +
                                                 digits(answer.rest_mm.value_or(0), 3) + " mm, scallop " +
                                                 digits(answer.scallop_mm.value_or(0), 3) + " mm");
    return report::audit_page(page);
}

void print(const AuditAnswer& answer, const session::LoadModel& model, const session::MillSession& session) {
    const session::Audit& audit = answer.audit;
    std::printf("%s\n", printable(answer.verdict.sentence).c_str());
    for (std::size_t n = 1; n < answer.verdict.findings.size(); ++n)
        std::printf("  %s: %s\n", std::string(name_of(answer.verdict.findings[n].outcome)).c_str(),
                    printable(answer.verdict.findings[n].text).c_str());
    std::printf("%-16s %.1f s; feed moves %.1f s, of which %.3g %% cut nothing\n", "time", audit.duration_s,
                audit.feed_s, 100 * audit.air_share());
    std::printf("%-16s %.2g to %.2g times the computed ones\n", "true forces", model.force_low_factor(),
                model.force_high_factor());
    if (answer.uncertain) std::printf("%-16s 9 of 10 of %d cases\n", "bands", *answer.uncertain);
    for (const session::LoadTally& tool : audit.tools) {
        const milling::Cutter& cutter = session.setup().cutters[tool.cutter];
        std::printf("%-16s %s, cutting %.1f s\n", tool_name(cutter).c_str(), job::tool_words(cutter).c_str(),
                    tool.cutting_s);
        for (std::size_t n = 0; n < session::kLoadKinds; ++n) {
            const auto kind = static_cast<session::LoadKind>(n);
            if (!(tool.peaks[n].value > 0)) continue;
            const std::string ratio = ratio_text(tool, kind, model);
            std::printf("  %-14s %s%s, line %d\n", std::string(session::kLoadWords[n].name).c_str(),
                        loads_text(tool, kind).c_str(),
                        ratio.empty() ? "" : (", " + ratio + " of its limit").c_str(), tool.peaks[n].line);
        }
        std::printf("  %-14s %d entries into material, largest jump %.3g N, steepest plunge %.3g deg\n",
                    "way in", tool.entries, tool.jump_n, tool.plunge_deg);
    }
    if (answer.facts.gouge_mm) {
        const int line = answer.facts.gouge_line;
        std::printf("%-16s gouge %.3g mm%s, scallop %.3g mm\n", "part", *answer.facts.gouge_mm,
                    line > 0 ? (" in line " + std::to_string(line)).c_str() : "",
                    answer.scallop_mm.value_or(0));
    }
    for (const std::string& text : in_words(answer.speeds))
        std::printf("%-16s %s\n", "speed", printable(text).c_str());
    std::printf("%-16s %zu collisions, %zu warnings\n", "findings", session.totals().collisions.size(),
                answer.warnings.size());
}

}  // namespace tribo::app
