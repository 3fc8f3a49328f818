// SPDX-License-Identifier: MIT
#include "session/audit/verdict.hpp"

#include <algorithm>
#include <tuple>

#include "base/text/decimal.hpp"

namespace tribo::session {
namespace {

// Every cut begins and ends with thin chips: below this share of the cutting time they are no finding.
constexpr double kRubbingShare = 0.1;
// A gouge from here on is more than the facets of a usual model; without a tolerance there is no "Yes" beside
// it.
constexpr double kPlainGougeMm = 0.01;
// A probability of chatter from which on it is sure, and one up to which it is ruled out: the bands of modes
// and forces hold in 9 of 10 cases.
constexpr double kSure = 0.95, kRuledOut = 0.05;

std::string two(double value) {
    return format_digits(value, 2);
}

class Judge {
  public:
    Judge(const Audit& audit, const LoadModel& model, const MillSession& session, const AuditFacts& facts)
        : audit_(audit), model_(model), session_(session), facts_(facts) {}

    Verdict judge() {
        add_collisions();
        add_loads();
        add_rubbing();
        add_part();
        Verdict verdict;
        // Sure findings first, of these collisions, then the one that is farthest over its limit.
        const auto rank = [](const Finding& f) {
            return std::tuple(f.outcome == Outcome::over ? 0 : 1,
                              f.ratio      ? -f.ratio->value
                              : f.line > 0 ? -1e9
                                           : 0,
                              f.line, std::string_view(f.text));
        };
        std::ranges::sort(findings_, {}, rank);
        verdict.findings = std::move(findings_);
        if (session_.totals().rows == 0) {
            verdict.outcome = Outcome::nothing_cut;
            verdict.sentence = "Nothing is cut: there is nothing to judge.";
        } else if (verdict.findings.empty()) {
            verdict.sentence = within();
        } else {
            const Finding& first = verdict.findings.front();
            verdict.outcome = first.outcome;
            verdict.sentence = (first.outcome == Outcome::over ? "No: " : "No verdict: ") + first.text;
            if (const std::size_t others = verdict.findings.size() - 1; others > 0)
                verdict.sentence +=
                    "; and " + std::to_string(others) + (others > 1 ? " more findings" : " more finding");
            verdict.sentence += ".";
        }
        return verdict;
    }

  private:
    std::string tool_name(std::size_t cutter) const {
        const int number = session_.setup().cutters[cutter].number;
        return number > 0 ? "T" + std::to_string(number) : "the tool";
    }

    void add_collisions() {
        const std::vector<MillCollision>& all = session_.totals().collisions;
        if (all.empty()) return;
        const MillCollision& first = all.front();
        std::string text =
            "line " + std::to_string(first.line) + ": " + std::string(milling::name(first.kind));
        std::ranges::replace(text, '-', ' ');
        if (all.size() > 1)
            text += ", and " + std::to_string(all.size() - 1) +
                    (all.size() == 2 ? " more collision" : " more collisions");
        findings_.push_back({Outcome::over, std::move(text), first.line, {}});
    }

    // For each load the tool that is farthest over its limit.
    void add_loads() {
        for (std::size_t n = 0; n < kLoadKinds; ++n) {
            const auto kind = static_cast<LoadKind>(n);
            const auto ratio_of = [&](const LoadTally& tool) { return tool.peaks[n].ratio; };
            const auto tool = std::ranges::max_element(audit_.tools, {}, ratio_of);
            if (tool == audit_.tools.end() || !(ratio_of(*tool) > 0)) continue;
            const RatioBand ratio = band_of(*tool, kind, model_);
            const bool unsure = kind == LoadKind::multiplier && facts_.chatter_probability.has_value();
            const Outcome outcome = unsure ? chatter_outcome() : outcome_of(ratio);
            if (outcome == Outcome::within) continue;
            add_load(kind, *tool, ratio, outcome);
        }
    }
    Outcome chatter_outcome() const {
        const double p = *facts_.chatter_probability;
        return p >= kSure ? Outcome::over : p <= kRuledOut ? Outcome::within : Outcome::undecided;
    }
    void add_load(LoadKind kind, const LoadTally& tool, const RatioBand& ratio, Outcome outcome) {
        const LoadWords& words = words_of(kind);
        const PeakLoad& peak = tool.of(kind);
        std::string text = "line " + std::to_string(peak.line) + ", " + tool_name(tool.cutter) + ": ";
        if (outcome == Outcome::over) text += std::string(words.fault) + "; ";
        text += "the " + std::string(words.name) + " is " + in_words(ratio) + " times its limit";
        if (kind == LoadKind::multiplier && facts_.chatter_probability)
            text += ", and chatter has a probability of " + two(*facts_.chatter_probability);
        const LineCounts& lines = audit_.lines[index_of(kind)];
        const std::size_t others = outcome == Outcome::over ? lines.over : lines.undecided;
        if (others > 1) text += " (" + std::to_string(others) + " lines)";
        findings_.push_back({outcome, std::move(text), peak.line, ratio});
    }

    void add_rubbing() {
        ThinTime thin;
        for (const LoadTally& tool : audit_.tools) {
            thin.below_low_s += tool.thin.below_low_s;
            thin.below_value_s += tool.thin.below_value_s;
            thin.below_high_s += tool.thin.below_high_s;
        }
        const double cutting_s = session_.totals().cutting_s;
        if (!(thin.below_high_s > kRubbingShare * cutting_s)) return;
        const bool sure = thin.below_low_s > kRubbingShare * cutting_s;
        const double share = (sure ? thin.below_low_s : thin.below_high_s) / cutting_s;
        // The limits of the first tool stand for all: they differ only where a job states none of them.
        const CutLimit& least = model_.limits().of_cutter[audit_.tools.front().cutter].least_chip;
        std::string text = sure ? "the teeth rub rather than cut: " : "the teeth may rub rather than cut: ";
        text += "in " + two(100 * share) + " % of the cutting time the chip is thinner than " +
                two(sure ? least.low : least.high) + " mm";
        findings_.push_back({sure ? Outcome::over : Outcome::undecided, std::move(text), 0, {}});
    }

    void add_part() {
        const std::optional<double> tolerance = model_.limits().tolerance_mm;
        if (!tolerance) return add_unjudged_gouge();
        const auto add = [&](const std::optional<double>& error_mm, const char* what, int line,
                             bool by_force) {
            if (!error_mm) return;
            const double r = *error_mm / *tolerance;
            const RatioBand ratio =
                by_force ? RatioBand{r * model_.force_low_factor(), r, r * model_.force_high_factor()}
                         : RatioBand{r, r, r};
            const Outcome outcome = outcome_of(ratio);
            if (outcome == Outcome::within) return;
            std::string text = line > 0 ? "line " + std::to_string(line) + ": " : "";
            text += std::string(what) + two(*error_mm) + " mm, " + in_words(ratio) + " times the tolerance";
            findings_.push_back({outcome, std::move(text), line, ratio});
        };
        add(facts_.gouge_mm, "the part has a gouge of ", facts_.gouge_line, false);
        add(facts_.left_mm, "bending leaves ", facts_.left_line, true);
        add(facts_.overcut_mm, "bending cuts too deep by ", facts_.overcut_line, true);
    }

    void add_unjudged_gouge() {
        if (!(facts_.gouge_mm.value_or(0) > kPlainGougeMm)) return;
        const int line = facts_.gouge_line;
        findings_.push_back({Outcome::undecided,
                             (line > 0 ? "line " + std::to_string(line) + ": " : "") +
                                 "the part has a gouge of " + two(*facts_.gouge_mm) +
                                 " mm, and no tolerance_mm says whether it may",
                             line,
                             {}});
    }

    std::string within() const {
        const LoadTally* worst = nullptr;
        LoadKind kind = LoadKind::force;
        for (const LoadTally& tool : audit_.tools) {
            const auto nearest = tool.worst();
            if (!nearest || (worst != nullptr && worst->of(kind).ratio >= tool.of(*nearest).ratio)) continue;
            worst = &tool;
            kind = *nearest;
        }
        if (worst == nullptr) return "Nothing is over a limit.";
        const PeakLoad& peak = worst->of(kind);
        return "Yes: nothing is over a limit. The " + std::string(words_of(kind).name) +
               " is nearest to its own, " + in_words(band_of(*worst, kind, model_)) + " of it, in line " +
               std::to_string(peak.line) + ".";
    }

    const Audit& audit_;
    const LoadModel& model_;
    const MillSession& session_;
    const AuditFacts& facts_;
    std::vector<Finding> findings_;
};

}  // namespace

std::string_view name_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::nothing_cut:
            return "nothing cut";
        case Outcome::within:
            return "within";
        case Outcome::undecided:
            return "undecided";
        case Outcome::over:
            return "over";
    }
    return "";
}

Outcome outcome_of(const RatioBand& ratio) {
    return ratio.low > 1 ? Outcome::over : ratio.high > 1 ? Outcome::undecided : Outcome::within;
}

std::string in_words(const RatioBand& ratio) {
    const std::string low = two(ratio.low), high = two(ratio.high);
    return low == high ? low : low + " to " + high;
}

Verdict verdict(const Audit& audit, const LoadModel& model, const MillSession& session,
                const AuditFacts& facts) {
    return Judge(audit, model, session, facts).judge();
}

}  // namespace tribo::session
