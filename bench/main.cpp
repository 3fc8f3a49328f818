// SPDX-License-Identifier: MIT
// tribo_bench [--json FILE] [--repeats N] [--only PART]
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string_view>

#include "harness.hpp"

int main(int argc, char** argv) {
    using namespace tribo::bench;
    std::string json, only;
    int repeats = 3;
    for (int n = 1; n < argc; n += 2) {
        const std::string_view flag = argv[n];
        const char* value = n + 1 < argc ? argv[n + 1] : nullptr;
        if (value && flag == "--json") {
            json = value;
        } else if (value && flag == "--only") {
            only = value;
        } else if (value && flag == "--repeats" && std::atoi(value) > 0) {
            repeats = std::atoi(value);
        } else {
            std::fprintf(stderr, "usage: tribo_bench [--json FILE] [--repeats N] [--only PART]\n");
            return 2;
        }
    }
    Report report;
    const struct {
        const char* name;
        std::function<void()> measure;
    } parts[] = {
        {"processes", [&] { measure_processes(report, repeats); }},
        {"long", [&] { measure_long_programs(report); }},
        {"forces", [&] { measure_forces(report, repeats); }},
        {"stability", [&] { measure_stability(report, repeats); }},
        {"contact", [&] { measure_contact(report); }},
        {"queries", [&] { measure_queries(report); }},
        {"rows", [&] { measure_rows(report); }},
        {"carving", [&] { measure_carving(report, repeats); }},
        {"moves", [&] { measure_many_moves(report, repeats); }},
        {"milling", [&] { measure_milling(report, repeats); }},
        {"sessions", [&] { measure_sessions(report, repeats); }},
        {"scrub", [&] { measure_scrub(report); }},
        {"noise", [&] { measure_noise(report, repeats); }},
        {"sound", [&] { measure_sound(report); }},
        {"elastic", [&] { measure_elastic(report); }},
        {"servo", [&] { measure_servo(report); }},
        {"live", [&] { measure_live(report); }},
    };
    bool known = only.empty();
    for (const auto& part : parts) {
        if (!only.empty() && only != part.name) continue;
        known = true;
        part.measure();
    }
    if (!known) {
        std::fprintf(stderr, "tribo_bench: unknown part '%s'; the parts are:", only.c_str());
        for (const auto& part : parts) std::fprintf(stderr, " %s", part.name);
        std::fprintf(stderr, "\n");
        return 2;
    }
    if (json.empty()) return 0;
    std::ofstream file(json);
    file << report.json();
    file.close();
    if (!file) std::fprintf(stderr, "tribo_bench: cannot write %s\n", json.c_str());
    return file ? 0 : 3;
}
