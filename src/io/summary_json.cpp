// SPDX-License-Identifier: MIT
#include "io/summary_json.hpp"

#include "io/json.hpp"

namespace tribo::io {
namespace {

void set_with_band(Json& json, const std::string& key, double value, const Summary& s) {
    set(json, key.c_str(), value);
    if (std::isfinite(value) && s.force_low_factor < s.force_high_factor) {
        json[key + "_band"] = {value * s.force_low_factor, value * s.force_high_factor};
    }
}

// Sixteen hexadecimal digits: JSON's numbers are doubles for many readers, and would lose bits.
std::string hex(std::uint64_t value) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text(16, '0');
    for (std::size_t n = 0; n < 16; ++n) text[n] = digits[value >> (60 - 4 * n) & 15];
    return text;
}

Json stock_record_json(const formats::StockRecord& record) {
    Json json;
    json["job"] = record.job;
    set(json, "until_s", record.until_s);
    json["stock"] = hex(record.stock);
    json["cutters"] = hex(record.cutters);
    json["moves"] = hex(record.moves);
    return json;
}

}  // namespace

std::string summary_json(const Summary& s) {
    Json json;
    json["schema"] = "tribo.summary/1";
    json["version"] = s.version;
    json["job"] = s.job;
    set(json, "duration_s", s.duration_s);
    set(json, "cutting_s", s.cutting_s);
    set(json, "path_mm", s.path_mm);
    set(json, "removed_mm3", s.removed_mm3);
    set(json, "remaining_mm3", s.remaining_mm3);
    set_with_band(json, "mean_force_n", s.mean_force_n, s);
    set_with_band(json, "peak_force_n", s.peak_force_n, s);
    set_with_band(json, "peak_torque_nm", s.peak_torque_nm, s);
    set_with_band(json, "peak_power_w", s.peak_power_w, s);
    set(json, "tooth_passing_hz", s.tooth_passing_hz);
    set(json, "work_j", s.work_j);
    set(json, "energy_balance", s.energy_balance);
    if (s.triangles) json["triangles"] = *s.triangles;
    set(json, "resolution_mm", s.resolution_mm);
    set(json, "gouge_max_mm", s.gouge_max_mm);
    set(json, "rest_max_mm", s.rest_max_mm);
    set(json, "scallop_max_mm", s.scallop_max_mm);
    if (s.stock_record) json["stock_record"] = stock_record_json(*s.stock_record);
    if (s.as_published) json["as_published"] = true;
    json["collisions"] = Json::array();
    for (const SummaryCollision& c : s.collisions) {
        Json collision;
        if (c.line > 0) collision["line"] = c.line;
        set(collision, "t_s", c.t_s);
        collision["kind"] = c.kind;
        collision["tip_mm"] = triple(c.tip_mm);
        json["collisions"].push_back(std::move(collision));
    }
    json["warnings"] = Json::array();
    for (const Warning& w : s.warnings) json["warnings"].push_back(w.message());
    set(json, "seconds", s.seconds);
    set(json, "peak_memory_mb", s.peak_memory_mb);
    return pretty(json);
}

}  // namespace tribo::io
