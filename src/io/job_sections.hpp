// SPDX-License-Identifier: MIT
// The tables of a job file, one reader each. What is wrong stands in the TomlFile afterwards; the value given
// back is then of no use. Private to io/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/job.hpp"
#include "io/files.hpp"
#include "io/toml_section.hpp"

namespace tribo::io {

// Millimetres per unit of a model or of keyframes, where the section says it.
std::optional<double> read_unit_mm(TomlSection& section);
formats::ModelFile read_part(TomlFile& file, const toml::table& table);
formats::JobSolid read_solid(TomlFile& file, const toml::table& table, const std::string& label);
// [stock]: a solid, or an earlier job.
void read_stock(TomlFile& file, const toml::table& table, formats::Job& job);
// [setup]: the frame of this job in the stock of the earlier one.
formats::WorkFrame read_setup(TomlFile& file, const toml::table& table);
// [cutter] or every [[cutter]], and [holder] for those without one of their own.
std::vector<milling::Cutter> read_cutters(TomlSection& job);
formats::JobMaterial read_material(TomlFile& file, const toml::table& table);
formats::JobProcess read_process(TomlFile& file, const toml::table& table);
formats::JobPath read_path(TomlFile& file, const toml::table& table);
formats::JobEngagement read_engagement(TomlFile& file, const toml::table& table);
formats::JobSound read_sound(TomlFile& file, const toml::table& table);
formats::JobHaptics read_haptics(TomlFile& file, const toml::table& table);
// Whether [path] names a file that describes a machine, or a machine.
inline bool is_machine_file(std::string_view machine) {
    return machine.ends_with(".toml");
}
// [machine], the file that it names or the one that [path] names, on the machine that [path] names; `path`
// has been read.
FileResult<formats::JobMachine> read_machine(TomlSection& job, const formats::JobPath& path);

}  // namespace tribo::io
