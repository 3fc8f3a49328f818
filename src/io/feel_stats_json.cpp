// SPDX-License-Identifier: MIT
#include "io/feel_stats_json.hpp"

#include <algorithm>

#include "io/json.hpp"

namespace tribo::io {
namespace {

Json figures(const DurationFigures& f) {
    Json json;
    set(json, "p50", f.p50_us);
    set(json, "p99", f.p99_us);
    set(json, "p999", f.p999_us);
    set(json, "max", f.max_us);
    return json;
}

}  // namespace

std::string feel_stats_json(const FeelStats& s) {
    Json json;
    json["schema"] = "tribo.feel/1";
    json["version"] = s.version;
    json["device"] = s.device;
    json["mode"] = s.mode;
    json["ticks"] = s.ticks;
    set(json, "rate_hz", s.rate_hz);
    json["cpu_us"] = figures(s.cpu);
    json["wall_us"] = figures(s.wall);
    json["empty_cpu_us"] = figures(s.empty_cpu);
    json["empty_wall_us"] = figures(s.empty_wall);
    if (s.lateness) json["lateness_us"] = figures(*s.lateness);
    json["late"] = s.late;
    set(json, "max_force_n", s.max_force_n);
    set(json, "lowest_energy_nmm", s.lowest_energy_nmm);
    if (s.table) {
        Json table;
        table["pieces"] = s.table->pieces;
        table["knots"] = s.table->knots;
        table["bytes"] = s.table->bytes;
        set(table, "worst_jnd", s.table->worst_jnd);
        table["uniform_knots"] = s.table->uniform_knots;
        set(table, "times_smaller_than_uniform",
            static_cast<double>(s.table->uniform_knots) /
                static_cast<double>(std::max<std::size_t>(1, s.table->knots)));
        json["force_table"] = std::move(table);
    }
    json["faults"] = Json::object();
    for (const FeelStats::FaultCount& fault : s.faults) json["faults"][fault.name] = fault.count;
    json["notes"] = s.notes;
    return pretty(json);
}

}  // namespace tribo::io
