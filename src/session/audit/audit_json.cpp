// SPDX-License-Identifier: MIT
#include "session/audit/audit_json.hpp"

#include "base/text/json_writer.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::session {
namespace {

void write_band(JsonWriter& json, const RatioBand& band) {
    json.begin_array().value(band.low).value(band.value).value(band.high).end_array();
}

void write_limit(JsonWriter& json, const CutLimit& limit) {
    json.begin_object();
    // The limits of a spindle follow its speed.
    if (limit.value > 0) {
        json.set("value", limit.value);
        if (limit.low != limit.high)
            json.key("band").begin_array().value(limit.low).value(limit.high).end_array();
    }
    json.set("from", limit.source);
    if (limit.rule_of_thumb) json.set("rule_of_thumb", true);
    json.end_object();
}

void write_limits(JsonWriter& json, const ToolLimits& limits) {
    json.begin_object();
    for (std::size_t n = 0; n < kLoadKinds; ++n)
        if (limits.most[n]) write_limit(json.key(kLoadWords[n].key), *limits.most[n]);
    write_limit(json.key("least_chip_mm"), limits.least_chip);
    json.end_object();
}

// The keys of a tally, in an object that has begun.
void write_tally(JsonWriter& json, const LoadTally& tally, const LoadModel& model, const MillSetup& setup) {
    if (tally.line > 0) json.set("line", tally.line);
    json.set("tool", setup.cutters[tally.cutter].number);
    json.set("t_s", tally.start_s);
    json.set("feed_mm", tally.feed_mm);
    json.set("feed_s", tally.feed_s);
    json.set("cutting_s", tally.cutting_s);
    json.set("removed_mm3", tally.removed_mm3);
    for (std::size_t n = 0; n < kLoadKinds; ++n) {
        const PeakLoad& peak = tally.peaks[n];
        if (!(peak.value > 0)) continue;
        json.key(kLoadWords[n].key).begin_object().set("value", peak.value);
        if (peak.ratio > 0) write_band(json.key("ratio"), band_of(tally, static_cast<LoadKind>(n), model));
        if (tally.line == 0) json.set("line", peak.line);
        json.end_object();
    }
    json.set("rubbing_s", tally.thin.below_value_s);
    json.set("plunge_deg", tally.plunge_deg);
    json.set("jump_n", tally.jump_n);
    json.set("entries", tally.entries);
    json.set("collisions", tally.collisions);
    if (tally.gouge_mm) json.set("gouge_mm", *tally.gouge_mm);
    if (tally.scallop_mm) json.set("scallop_mm", *tally.scallop_mm);
}

void write_verdict(JsonWriter& json, const Verdict& verdict) {
    json.begin_object().set("outcome", name_of(verdict.outcome)).set("sentence", verdict.sentence);
    json.key("findings").begin_array();
    for (const Finding& finding : verdict.findings) {
        json.begin_object().set("outcome", name_of(finding.outcome)).set("text", finding.text);
        if (finding.line > 0) json.set("line", finding.line);
        if (finding.ratio) write_band(json.key("ratio"), *finding.ratio);
        json.end_object();
    }
    json.end_array().end_object();
}

void write_counts(JsonWriter& json, const std::array<LineCounts, kLoadKinds>& counts) {
    json.begin_object();
    for (std::size_t n = 0; n < kLoadKinds; ++n) {
        if (counts[n].over + counts[n].undecided == 0) continue;
        json.key(kLoadWords[n].key).begin_object();
        json.set("over", counts[n].over).set("undecided", counts[n].undecided).end_object();
    }
    json.end_object();
}

}  // namespace

std::string audit_json(const Audit& audit, const Verdict& verdict, const AuditFacts& facts,
                       const LoadModel& model, const MillSession& session) {
    const MillSetup& setup = session.setup();
    JsonWriter json;
    json.begin_object();
    write_verdict(json.key("verdict"), verdict);
    const auto set = [&](const char* key, const std::optional<double>& value) {
        if (value) json.set(key, *value);
    };
    set("chatter_probability", facts.chatter_probability);
    json.key("force_band").begin_array();
    json.value(model.force_low_factor()).value(model.force_high_factor()).end_array();
    json.set("duration_s", audit.duration_s);
    json.set("feed_s", audit.feed_s);
    json.set("cutting_s", audit.cutting_s);
    json.set("air_share", audit.air_share());
    json.set("lines", audit.line_count);
    set("tolerance_mm", model.limits().tolerance_mm);
    set("gouge_max_mm", facts.gouge_mm);
    set("bending_leaves_mm", facts.left_mm);
    set("bending_overcuts_mm", facts.overcut_mm);
    write_counts(json.key("lines_over"), audit.lines);
    json.key("tools").begin_array();
    for (const LoadTally& tool : audit.tools) {
        json.begin_object();
        write_tally(json, tool, model, setup);
        json.set("cutter", job::tool_words(setup.cutters[tool.cutter]));
        write_limits(json.key("limits"), model.limits().of_cutter[tool.cutter]);
        json.end_object();
    }
    json.end_array().key("worst").begin_array();
    for (const LoadTally& line : audit.worst) {
        json.begin_object();
        write_tally(json, line, model, setup);
        json.end_object();
    }
    json.end_array().key("collisions").begin_array();
    for (const MillCollision& c : session.totals().collisions) {
        json.begin_object().set("line", c.line).set("t_s", c.t_s).set("kind", milling::name(c.kind));
        json.key("tip_mm").begin_array().value(c.tip_mm.x).value(c.tip_mm.y).value(c.tip_mm.z);
        json.end_array().end_object();
    }
    json.end_array().end_object();
    return json.text();
}

void append_audit_line(const LoadTally& line, const MillSetup& setup, std::vector<double>& numbers) {
    for (const double value : {static_cast<double>(line.line), line.start_s, line.end_s - line.start_s,
                               static_cast<double>(setup.cutters[line.cutter].number), line.spindle_rpm,
                               line.feed_mm, line.feed_s, line.cutting_s, line.removed_mm3})
        numbers.push_back(value);
    for (const PeakLoad& peak : line.peaks) numbers.push_back(peak.value);
    for (const PeakLoad& peak : line.peaks) numbers.push_back(peak.ratio);
    for (const double value : {line.thin.below_value_s, line.plunge_deg, line.jump_n,
                               static_cast<double>(line.entries), static_cast<double>(line.collisions)})
        numbers.push_back(value);
}

}  // namespace tribo::session
