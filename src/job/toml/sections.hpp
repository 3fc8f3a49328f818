// SPDX-License-Identifier: MIT
// The tables of a job file, one reader each. What is wrong stands in the TomlFile afterwards; the value given
// back is then of no use. Private to job/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "job/file_source.hpp"
#include "job/job.hpp"
#include "job/toml/toml_section.hpp"

namespace tribo::job {

// The keys of [path] that name a program, in the order of PathKind.
inline constexpr std::array<std::string_view, 3> kPathKindWords{"keyframes", "gcode", "apt"};

// The words of dynamics::ModeOn.
inline constexpr std::array<std::string_view, 2> kModeOnWords{"tool", "part"};

// Millimetres per unit of a model or of keyframes, where the section says it.
std::optional<double> read_unit_mm(TomlSection& section);
// A direction of any length, as a unit vector.
Vec3 read_direction(TomlSection& section, std::string_view key, Vec3 otherwise);
readers::ModelFile read_part(TomlFile& file, const toml::table& table);
JobSolid read_solid(TomlFile& file, const toml::table& table, const std::string& label);
// [stock]: a solid, or an earlier job.
void read_stock(TomlFile& file, const toml::table& table, Job& job);
// [setup]: the frame of this job in the stock of the earlier one.
motion::WorkFrame read_setup(TomlFile& file, const toml::table& table);
// [cutter] or every [[cutter]], and [holder] for those without one of their own.
std::vector<milling::Cutter> read_cutters(TomlSection& job);
JobMaterial read_material(TomlFile& file, const toml::table& table);
JobProcess read_process(TomlFile& file, const toml::table& table);
JobPath read_path(TomlFile& file, const toml::table& table);
JobEngagement read_engagement(TomlFile& file, const toml::table& table);
// One [[mode]].
dynamics::Mode read_mode(TomlFile& file, const toml::table& table);
// One [[frf]].
JobFrf read_frf(TomlFile& file, const toml::table& table);
// [dynamics]. `job` has its modes, responses and cutters; `root` is its table.
std::optional<JobEstimate> read_dynamics(TomlSection& root, const toml::table& table, const Job& job);
JobSound read_sound(TomlFile& file, const toml::table& table);
JobLimits read_limits(TomlFile& file, const toml::table& table);
JobHaptics read_haptics(TomlFile& file, const toml::table& table);
// Whether [path] names a file that describes a machine, or a machine.
inline bool is_machine_file(std::string_view machine) {
    return machine.ends_with(".toml");
}
// [machine], the file that it names or the one that [path] names, on the machine that [path] names; `path`
// has been read.
FileResult<JobMachine> read_machine(TomlSection& job, const JobPath& path, const FileSource& files);

}  // namespace tribo::job
