// SPDX-License-Identifier: MIT
#include "report/summary_json.hpp"

#include "files/json/json.hpp"

namespace tribo::report {
namespace {

void set_with_band(files::Json& json, const std::string& key, const ForceValue& force) {
    files::set(json, key.c_str(), force.value);
    if (std::isfinite(force.value) && force.low < force.high) json[key + "_band"] = {force.low, force.high};
}

// Sixteen hexadecimal digits: many readers store JSON numbers as doubles and would lose bits.
std::string hex(std::uint64_t value) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text(16, '0');
    for (std::size_t n = 0; n < 16; ++n) text[n] = digits[value >> (60 - 4 * n) & 15];
    return text;
}

files::Json stock_record_json(const job::StockRecord& record) {
    files::Json json;
    json["job"] = record.job;
    files::set(json, "until_s", record.until_s);
    json["stock"] = hex(record.stock);
    json["cutters"] = hex(record.cutters);
    json["moves"] = hex(record.moves);
    return json;
}

}  // namespace

std::string summary_json(const Summary& s) {
    files::Json json;
    json["schema"] = "tribo.summary/1";
    json["version"] = s.version;
    json["job"] = s.job;
    files::set(json, "duration_s", s.duration_s);
    files::set(json, "cutting_s", s.cutting_s);
    files::set(json, "path_mm", s.path_mm);
    files::set(json, "removed_mm3", s.removed_mm3);
    files::set(json, "remaining_mm3", s.remaining_mm3);
    set_with_band(json, "mean_force_n", s.mean_force_n);
    set_with_band(json, "peak_force_n", s.peak_force_n);
    set_with_band(json, "peak_torque_nm", s.peak_torque_nm);
    set_with_band(json, "peak_power_w", s.peak_power_w);
    if (s.uncertain_cases) json["uncertain_cases"] = *s.uncertain_cases;
    files::set(json, "tooth_passing_hz", s.tooth_passing_hz);
    files::set(json, "work_j", s.work_j);
    files::set(json, "energy_balance", s.energy_balance);
    if (s.triangles) json["triangles"] = *s.triangles;
    files::set(json, "resolution_mm", s.resolution_mm);
    files::set(json, "gouge_max_mm", s.gouge_max_mm);
    files::set(json, "rest_max_mm", s.rest_max_mm);
    files::set(json, "scallop_max_mm", s.scallop_max_mm);
    if (s.gouge_at_mm) json["gouge_at_mm"] = files::triple(*s.gouge_at_mm);
    if (s.rest_at_mm) json["rest_at_mm"] = files::triple(*s.rest_at_mm);
    if (s.stock_record) json["stock_record"] = stock_record_json(*s.stock_record);
    if (s.as_published) json["as_published"] = true;
    json["collisions"] = files::Json::array();
    for (const SummaryCollision& c : s.collisions) {
        files::Json collision;
        if (c.line > 0) collision["line"] = c.line;
        files::set(collision, "t_s", c.t_s);
        collision["kind"] = c.kind;
        collision["tip_mm"] = files::triple(c.tip_mm);
        json["collisions"].push_back(std::move(collision));
    }
    if (s.chatter) {
        json["chatter"] = files::Json::array();
        for (const SummaryChatter& c : *s.chatter) {
            files::Json chatter;
            chatter["line"] = c.line;
            files::set(chatter, "t_s", c.t_s);
            files::set(chatter, "multiplier", c.multiplier);
            files::set(chatter, "chatter_hz", c.chatter_hz);
            json["chatter"].push_back(std::move(chatter));
        }
    }
    files::set(json, "chatter_probability", s.chatter_probability);
    files::set(json, "largest_displacement_mm", s.largest_displacement_mm);
    if (s.form_error) {
        files::Json error;
        files::set(error, "left_max_mm", s.form_error->left_mm);
        files::set(error, "overcut_max_mm", s.form_error->overcut_mm);
        files::set(error, "wave_max_mm", s.form_error->wave_mm);
        if (s.form_error->left_line > 0) error["left_line"] = s.form_error->left_line;
        if (s.form_error->overcut_line > 0) error["overcut_line"] = s.form_error->overcut_line;
        json["form_error"] = std::move(error);
    }
    json["warnings"] = files::Json::array();
    for (const Warning& w : s.warnings) json["warnings"].push_back(w.message());
    files::set(json, "seconds", s.seconds);
    files::set(json, "peak_memory_mb", s.peak_memory_mb);
    return files::pretty(json);
}

}  // namespace tribo::report
