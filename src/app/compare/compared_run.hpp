// SPDX-License-Identifier: MIT
// One of the two runs of `tribo compare`: milled from a job or a program, or read from a render folder.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/compare.hpp"
#include "app/render/render_job.hpp"
#include "base/parallel.hpp"
#include "files/output_folder.hpp"
#include "report/report_html.hpp"
#include "session/compare/compared_rows.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::app {

// A number of a whole run, as summary.json has it.
struct TotalWords {
    const char *key, *name, *unit;
};
inline constexpr std::array<TotalWords, 17> kTotals{{
    {"duration_s", "time", "s"},
    {"cutting_s", "cutting time", "s"},
    {"path_mm", "path of feed moves", "mm"},
    {"removed_mm3", "removed volume", "mm3"},
    {"remaining_mm3", "remaining volume", "mm3"},
    {"mean_force_n", "mean force", "N"},
    {"peak_force_n", "peak force", "N"},
    {"peak_torque_nm", "peak torque", "N m"},
    {"peak_power_w", "peak power", "W"},
    {"work_j", "work of the spindle", "J"},
    {"gouge_max_mm", "deepest gouge", "mm"},
    {"rest_max_mm", "most material left", "mm"},
    {"scallop_max_mm", "highest scallop", "mm"},
    {"multiplier_max", "chatter multiplier", ""},
    {"load_ratio_max", "tool load, to its limit", ""},
    {"collisions", "collisions", ""},
    {"resolution_mm", "resolution", "mm"},
}};

enum class RunKind { job, program, folder };
std::string_view name_of(RunKind kind);

struct ComparedRun {
    std::string name;  // as called
    RunKind kind = RunKind::job;
    std::string what;  // material and cutters, as far as they are known
    std::array<std::optional<double>, kTotals.size()> totals;
    std::vector<session::ComparedRow> rows;
    std::optional<job::StockRecord> record;  // identifies stock, cutters and moves
    std::vector<std::string> missing;        // what cannot be compared, in sentences
    Warnings warnings;
    // The part; null and empty: not known. Of a folder it is its mesh, of a job the carved stock.
    std::unique_ptr<session::MillSession> session;
    std::unique_ptr<field::CarvedField> solid;
    TriangleMesh mesh;
    std::vector<std::uint8_t> untouched;  // of its triangles, see stock_faces.hpp; empty: not known
    std::optional<report::ReportSound> sound;

    const field::CarvedField* part() const { return session ? &session->stock() : solid.get(); }
    std::optional<double>& total(std::string_view key);
    // Sets the totals that are the largest values of the rows.
    void total_rows();
    // The line that made a place of the surface; 0: the blank, an earlier job, or not known.
    int line_at(Vec3 surface_mm) const;
};

// A run before it is milled.
struct ComparedInput {
    std::string name;
    std::optional<PreparedJob> prepared;  // absent: a render folder
};

// Looks what the name is, and loads a job or a program. `flags` are for a program alone.
FileResult<ComparedInput> open_input(const std::string& name, const ProgramFlags& flags,
                                     std::optional<double> resolution_mm);
// Whether it is a program and takes its flags.
FileResult<bool> is_program(const std::string& name);

// Mills the job; its sound becomes the file `sound_file`. Empty: interrupted. The progress is shown under
// `stage`.
FileResult<std::optional<ComparedRun>> mill_run(ComparedInput input, const std::string& sound_file,
                                                const ParallelFor& parallel, const char* stage);
// Reads a render folder. `cell_mm`: spacing of the grid for its part, if the folder does not say.
FileResult<ComparedRun> read_run(const std::string& folder, std::optional<double> cell_mm,
                                 const ParallelFor& parallel);

}  // namespace tribo::app
