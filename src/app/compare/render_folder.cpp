// SPDX-License-Identifier: MIT
// A run as the files of its render folder tell it. What is not there is said, not guessed.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/compare/compared_run.hpp"
#include "field/mesh/mesh_shape.hpp"
#include "files/json/json.hpp"
#include "files/json/stock_record_json.hpp"
#include "files/model/model_file.hpp"
#include "files/sound/sound_file.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

// Spacing for a part of a folder without a summary: a share of its longest edge.
constexpr double kCellsAnEdge = 400;

bool is_there(const std::string& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

std::unexpected<FileFailure> damaged(const std::string& path) {
    return std::unexpected(
        FileFailure({path, 0, 0, "is no summary of a render", "render the job again into this folder"}));
}

FileResult<void> read_summary(const std::string& folder, ComparedRun& run) {
    const std::string path = folder + "/summary.json";
    if (!is_there(path)) {
        run.missing.push_back("the totals: no summary.json");
        return {};
    }
    auto text = files::read_file(path);
    if (!text) return std::unexpected(text.error());
    const files::Json json = files::parse(*text);
    if (!json.is_object() || !json.contains("schema") || !json["schema"].is_string() ||
        !json["schema"].get_ref<const std::string&>().starts_with("tribo.summary/"))
        return damaged(path);
    for (std::size_t n = 0; n < kTotals.size(); ++n) {
        const auto found = json.find(kTotals[n].key);
        if (found == json.end()) continue;
        if (found->is_number()) run.totals[n] = found->get<double>();
        if (found->is_array()) run.totals[n] = static_cast<double>(found->size());  // collisions
    }
    if (const auto chatter = json.find("chatter"); chatter != json.end() && chatter->is_array()) {
        for (const files::Json& line : *chatter) {
            if (!line.is_object() || !line.contains("multiplier") || !line["multiplier"].is_number())
                return damaged(path);
            std::optional<double>& most = run.total("multiplier_max");
            most = std::max(most.value_or(0), line["multiplier"].get<double>());
        }
    }
    if (auto record = files::read_stock_record(folder)) run.record = *std::move(record);
    if (const auto job = json.find("job"); job != json.end() && job->is_string())
        run.what = "rendered from " + job->get<std::string>();
    return {};
}

FileResult<void> read_forces(const std::string& folder, ComparedRun& run) {
    const std::string path = folder + "/forces.csv";
    if (!is_there(path)) {
        run.missing.push_back("forces along the program: no forces.csv");
        return {};
    }
    auto text = files::read_file(path);
    if (!text) return std::unexpected(text.error());
    auto rows = readers::read_forces_csv(*text, path);
    if (!rows) return std::unexpected(FileFailure(rows.error()));
    run.rows.reserve(rows->size());
    for (const readers::ForceTableRow& row : *rows) run.rows.push_back({row, {}, {}});
    return {};
}

FileResult<void> read_part(const std::string& folder, std::optional<double> cell_mm,
                           const ParallelFor& parallel, ComparedRun& run) {
    const std::string stl = folder + "/machined.stl", glb = folder + "/machined.glb";
    const std::string& path = is_there(stl) ? stl : glb;
    if (!is_there(path)) {
        run.missing.push_back("the part: no machined.stl or machined.glb");
        return {};
    }
    auto model = files::read_model_file({path, {}, readers::kMaxTriangles});
    if (!model) return std::unexpected(model.error());
    auto shape = field::MeshShape::make(std::move(model->mesh));
    if (!shape) {
        run.missing.push_back("the part: in " + fs::path(path).filename().string() + " " +
                              shape.error().cause);
        return {};
    }
    run.mesh = (*shape)->mesh();
    const Vec3 size = (*shape)->bounds_mm().size();
    const double cell = cell_mm.value_or(
        run.total("resolution_mm").value_or(std::max({size.x, size.y, size.z}) / kCellsAnEdge));
    run.solid = std::make_unique<field::CarvedField>(*std::move(shape), cell, parallel);
    return {};
}

// One channel of it, on both sides.
FileResult<void> read_sound(const std::string& folder, ComparedRun& run) {
    const std::string path = folder + "/sound.wav";
    if (!is_there(path)) {
        run.missing.push_back("the sound: no sound.wav");
        return {};
    }
    const auto sound = files::read_sound(path);
    if (!sound) {
        run.missing.push_back("the sound: sound.wav " + sound.error().cause);
        return {};
    }
    report::ReportSound& heard = run.sound.emplace();
    heard.rate_hz = sound->sample_rate_hz;
    heard.seconds = static_cast<double>(sound->samples.size()) / heard.rate_hz;
    heard.heard_from_s = run.rows.empty() ? 0 : std::min(run.rows.front().start_s, heard.seconds);
    const auto first = static_cast<std::size_t>(heard.heard_from_s * heard.rate_hz);
    const auto most = static_cast<std::size_t>(report::kReportSoundS * heard.rate_hz);
    const std::size_t end = std::min(sound->samples.size(), first + most);
    for (std::size_t n = first; n < end; ++n)
        heard.stereo.insert(heard.stereo.end(), 2, static_cast<float>(sound->samples[n]));
    return {};
}

}  // namespace

FileResult<ComparedRun> read_run(const std::string& folder, std::optional<double> cell_mm,
                                 const ParallelFor& parallel) {
    const auto holds = [&](const char* name) { return is_there(folder + "/" + name); };
    if (std::ranges::none_of(std::array{"summary.json", "forces.csv", "machined.stl", "machined.glb"}, holds))
        return std::unexpected(FileFailure(
            {folder, 0, 0, "is no folder that tribo render wrote",
             "name a job, a program, or a folder with summary.json, forces.csv or machined.stl"}));
    ComparedRun run;
    run.name = folder;
    run.kind = RunKind::folder;
    if (auto done = read_summary(folder, run); !done) return std::unexpected(done.error());
    if (auto done = read_forces(folder, run); !done) return std::unexpected(done.error());
    run.total_rows();
    if (auto done = read_part(folder, cell_mm, parallel, run); !done) return std::unexpected(done.error());
    if (auto done = read_sound(folder, run); !done) return std::unexpected(done.error());
    run.missing.push_back("the load of the tool: a render folder does not hold it");
    return run;
}

}  // namespace tribo::app
