// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "base/text/decimal.hpp"
#include "job/solid.hpp"
#include "job/toml/sections.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kSolidKeys{"box_mm"sv, "mesh"sv, "unit_mm"sv};
constexpr std::array kStockKeys{"box_mm"sv, "mesh"sv, "unit_mm"sv, "from"sv};
constexpr std::array kSetupKeys{"origin_mm"sv, "x_axis"sv, "z_axis"sv};

// How far the axes of a set-up may be off a right angle: x is then turned square to z, which moves a point at
// 100 mm by at most 0.17 mm. Directions written with three decimals are far within it.
constexpr double kLargestSkew = 1.7453e-3;  // cosine of the angle between them: 0.1 degrees

JobSolid solid_of(TomlSection& section, const char* otherwise) {
    const std::string& label = section.label();
    JobSolid solid;
    if (section.has("box_mm") && section.has("mesh")) {
        section.fail("mesh", label + " has both 'box_mm' and 'mesh'", "keep one of them");
    } else if (section.has("mesh")) {
        solid.model = readers::ModelFile{section.required_path("mesh"), read_unit_mm(section)};
    } else if (section.has("box_mm")) {
        if (const auto box = section.box("box_mm")) {
            solid.box_mm = *box;
            if (const auto room = check_room(*box); !room)
                section.fail("box_mm", "in 'box_mm' " + room.error().cause, room.error().remedy);
        }
        if (section.has("unit_mm")) {
            section.fail("unit_mm", "'unit_mm' belongs to a mesh; a box is in mm", "remove it");
        }
    } else {
        section.fail("", label + " has neither 'box_mm' nor 'mesh'",
                     std::string("write box_mm = [[x, y, z], [x, y, z]] or mesh = \"FILE\"") + otherwise);
    }
    return solid;
}

}  // namespace

Vec3 read_direction(TomlSection& section, std::string_view key, Vec3 otherwise) {
    const Vec3 written = section.point(key, kLimits.direction).value_or(otherwise);
    const double size = length(written);
    if (size > 0 && std::isfinite(size)) return written / size;
    section.fail(key, "'" + std::string(key) + "' is no direction: its length is " + format_decimal(size),
                 "write a direction such as [1, 0, 0]");
    return otherwise;
}

std::optional<double> read_unit_mm(TomlSection& section) {
    return section.number("unit_mm", kLimits.unit);
}

JobSolid read_solid(TomlFile& file, const toml::table& table, const std::string& label) {
    TomlSection section(file, table, label, kSolidKeys);
    return solid_of(section, "");
}

void read_stock(TomlFile& file, const toml::table& table, Job& job) {
    TomlSection section(file, table, "[stock]", kStockKeys);
    if (!section.has("from")) {
        job.stock = solid_of(section, ", or from = \"FIRST.toml\" for the stock that another job leaves");
        return;
    }
    for (const std::string_view key : {"box_mm"sv, "mesh"sv, "unit_mm"sv}) {
        if (!section.has(key)) continue;
        section.fail(key, "[stock] has both 'from' and '" + std::string(key) + "'",
                     key == "unit_mm"sv ? "remove it: the earlier job is in mm" : "keep one of them");
    }
    const toml::source_position place = table.get("from")->source().begin;
    job.stock_from = {section.required_path("from"), static_cast<int>(place.line),
                      static_cast<int>(place.column)};
}

motion::WorkFrame read_setup(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[setup]", kSetupKeys);
    motion::WorkFrame frame;
    frame.origin_mm = section.point("origin_mm").value_or(Vec3{});
    frame.x = read_direction(section, "x_axis", frame.x);
    frame.z = read_direction(section, "z_axis", frame.z);
    const double skew = dot(frame.x, frame.z);
    if (!(std::abs(skew) <= kLargestSkew)) {
        const bool only_z = !section.has("x_axis");
        section.fail(only_z ? "z_axis" : "x_axis",
                     only_z ? "'z_axis' is not square to the x axis, which is [1, 0, 0] where it is not given"
                            : "'x_axis' is not square to 'z_axis'",
                     only_z ? "write 'x_axis' too, square to it" : "make them square to each other");
        return frame;
    }
    if (skew != 0) frame.x = normalized(frame.x - skew * frame.z);
    frame.y = cross(frame.z, frame.x);
    return frame;
}

}  // namespace tribo::job
