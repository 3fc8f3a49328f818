// SPDX-License-Identifier: MIT
#include "app/feed/feed_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "base/text/printable.hpp"
#include "files/json/json.hpp"

namespace tribo::app {
namespace {

constexpr std::size_t kShownLines = 10;
constexpr double kLeastForce = 1e-3, kStep = 1.01;

double worst(const FeedRun& run) {
    double most = 0;
    for (const session::BlockFeed& block : run.blocks) most = std::max(most, block.ratio);
    return most;
}

files::Json run_json(const FeedRun& run) {
    return {{"duration_s", run.totals.duration_s},
            {"cutting_s", run.totals.cutting_s},
            {"removed_mm3", run.totals.removed_mm3},
            {"peak_force_n", run.totals.peak_force_n},
            {"median_force_n", run.forces.quantile(0.5)},
            {"p95_force_n", run.forces.quantile(0.95)},
            {"worst_ratio", worst(run)}};
}

std::map<session::FeedReason, std::size_t> reasons(const FeedAnswer& answer) {
    std::map<session::FeedReason, std::size_t> counts;
    for (const session::BlockFeed& block : answer.before.blocks) ++counts[block.reason];
    return counts;
}

}  // namespace

void ForceShares::add(double force_n, double seconds) {
    const double step = std::log(std::max(force_n, kLeastForce) / kLeastForce) / std::log(kStep);
    const auto bin = static_cast<std::size_t>(step);
    if (seconds_.size() <= bin) seconds_.resize(bin + 1);
    seconds_[bin] += seconds;
    all_s_ += seconds;
}

double ForceShares::quantile(double share) const {
    double sum = 0;
    for (std::size_t n = 0; n < seconds_.size(); ++n) {
        sum += seconds_[n];
        if (sum >= share * all_s_ && sum > 0)
            return kLeastForce * std::pow(kStep, static_cast<double>(n) + 0.5);
    }
    return 0;
}

std::vector<LineOver> lines_over(const FeedAnswer& answer) {
    std::vector<LineOver> lines;
    for (std::size_t n = 0; n < answer.after.blocks.size(); ++n)
        if (is_over(answer.after.blocks[n].ratio))
            lines.push_back(
                {answer.before.blocks[n].line, answer.after.blocks[n].ratio, answer.before.blocks[n].reason});
    return lines;
}

std::string feed_json(const FeedCall& call, const FeedAnswer& answer) {
    files::Json json;
    json["schema"] = "tribo.feed/1";
    json["version"] = TRIBO_VERSION;
    json["job"] = call.job;
    json["file"] = answer.file;
    json["before"] = run_json(answer.before);
    json["after"] = run_json(answer.after);
    json["blocks"] = answer.before.blocks.size();
    json["changed"] = answer.changed;
    for (const auto& [reason, count] : reasons(answer)) json["reasons"][std::string(name_of(reason))] = count;
    if (call.stable) json["speeds"] = speeds_json(answer.speeds);
    json["over"] = files::Json::array();
    for (const LineOver& line : lines_over(answer))
        json["over"].push_back(
            {{"line", line.line}, {"ratio", line.ratio}, {"reason", name_of(line.reason)}});
    json["warnings"] = files::Json::array();
    for (const Warning& w : answer.warnings) json["warnings"].push_back(w.message());
    return files::pretty(json);
}

void print(const FeedAnswer& answer) {
    const FeedRun &a = answer.before, &b = answer.after;
    const auto evenness = [](const FeedRun& run) {
        const double median = run.forces.quantile(0.5);
        return median > 0 ? run.forces.quantile(0.95) / median : 0;
    };
    for (const std::string& text : in_words(answer.speeds))
        std::printf("%-16s %s\n", "speed", printable(text).c_str());
    std::printf("%-16s %zu of %zu blocks have another feed\n", "feeds", answer.changed, a.blocks.size());
    std::printf("%-16s %.1f s, was %.1f s\n", "time", b.totals.duration_s, a.totals.duration_s);
    std::printf("%-16s %.1f N, was %.1f N\n", "peak force", b.totals.peak_force_n, a.totals.peak_force_n);
    std::printf("%-16s %.3g, was %.3g\n", "p95 / median", evenness(b), evenness(a));
    std::printf("%-16s %.3g of the nearest limit, was %.3g\n", "load", worst(b), worst(a));
    for (const auto& [reason, count] : reasons(answer))
        std::printf("  %-14s decides %zu blocks\n", std::string(name_of(reason)).c_str(), count);
    const std::vector<LineOver> over = lines_over(answer);
    for (std::size_t n = 0; n < std::min(over.size(), kShownLines); ++n)
        std::printf("%-16s line %d: %.3g times the limit (%s)\n", "stays over", over[n].line, over[n].ratio,
                    std::string(name_of(over[n].reason)).c_str());
    if (over.size() > kShownLines) std::printf("%-16s and %zu more lines\n", "", over.size() - kShownLines);
    std::printf("%-16s %s\n", "file", printable(answer.file).c_str());
}

}  // namespace tribo::app
