// SPDX-License-Identifier: MIT
#include "report/feel_stats_json.hpp"

#include <algorithm>

#include "files/json/json.hpp"

namespace tribo::report {
namespace {

files::Json figures(const DurationFigures& f) {
    files::Json json;
    files::set(json, "p50", f.p50_us);
    files::set(json, "p99", f.p99_us);
    files::set(json, "p999", f.p999_us);
    files::set(json, "max", f.max_us);
    return json;
}

}  // namespace

std::string feel_stats_json(const FeelStats& s) {
    files::Json json;
    json["schema"] = "tribo.feel/1";
    json["version"] = s.version;
    json["device"] = s.device;
    json["mode"] = s.mode;
    json["ticks"] = s.ticks;
    files::set(json, "rate_hz", s.rate_hz);
    json["cpu_us"] = figures(s.cpu);
    json["wall_us"] = figures(s.wall);
    json["empty_cpu_us"] = figures(s.empty_cpu);
    json["empty_wall_us"] = figures(s.empty_wall);
    if (s.lateness) json["lateness_us"] = figures(*s.lateness);
    json["late"] = s.late;
    files::set(json, "max_force_n", s.max_force_n);
    files::set(json, "lowest_energy_nmm", s.lowest_energy_nmm);
    if (s.table) {
        files::Json table;
        table["pieces"] = s.table->pieces;
        table["knots"] = s.table->knots;
        table["bytes"] = s.table->bytes;
        files::set(table, "worst_jnd", s.table->worst_jnd);
        table["uniform_knots"] = s.table->uniform_knots;
        files::set(table, "times_smaller_than_uniform",
                   static_cast<double>(s.table->uniform_knots) /
                       static_cast<double>(std::max<std::size_t>(1, s.table->knots)));
        json["force_table"] = std::move(table);
    }
    json["faults"] = files::Json::object();
    for (const FeelStats::FaultCount& fault : s.faults) json["faults"][fault.name] = fault.count;
    json["notes"] = s.notes;
    return files::pretty(json);
}

}  // namespace tribo::report
