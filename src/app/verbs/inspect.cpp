// SPDX-License-Identifier: MIT
// `tribo inspect FILE`: facts about a program, a model, a job or a material.
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/exit.hpp"
#include "app/options.hpp"
#include "app/outputs.hpp"
#include "app/verbs/verbs.hpp"
#include "base/text/printable.hpp"
#include "files/disk_source.hpp"
#include "files/files.hpp"
#include "files/gzip.hpp"
#include "files/machine_limits.hpp"
#include "files/model/model_file.hpp"
#include "job/input_kind.hpp"
#include "job/loader.hpp"
#include "job/program/called_programs.hpp"
#include "job/program_file.hpp"
#include "job/response_modes.hpp"
#include "job/toml/job_toml.hpp"
#include "job/toml/machine_file.hpp"
#include "material/material_json.hpp"
#include "report/facts.hpp"
#include "report/picture/path_lines.hpp"
#include "report/picture/picture.hpp"

namespace tribo::app {
namespace {

// Feed for programs that state none, so that they can be inspected without a job.
constexpr double kAssumedFeedMmPerMin = 1000;

struct InspectCall {
    std::string file;
    bool json = false;
    std::string picture;
    std::string machine, dialect;
};

// Results: facts to print, and geometry to draw.
struct Found {
    report::Facts facts;
    TriangleMesh mesh;
    std::vector<report::PictureLine> lines;
    std::vector<readers::Rgb8> colours = {};   // of the triangles, or none
    std::vector<std::uint8_t> untouched = {};  // of the triangles, or none
};

// Examines moves while they are read: a long program is never held in memory.
class PathWatcher final : public readers::MoveSink {
  public:
    explicit PathWatcher(bool draws) : draws_(draws) {}

    void take(const motion::Move& move) override {
        meter.add(move);
        if (draws_) lines_.add(move);
    }
    std::vector<report::PictureLine> take_lines() { return lines_.take(); }

    motion::ProgramMeter meter;

  private:
    bool draws_;
    report::PathLines lines_;
};

// Points without triangles: the picture leaves room for the lines through them.
void make_room(TriangleMesh& mesh, const std::vector<report::PictureLine>& lines) {
    for (const report::PictureLine& line : lines)
        for (const Vec3 p : line.points_mm) mesh.positions.push_back(to_float(p));
}

Found found_program(const motion::Program& program, PathWatcher& path, job::PathKind kind,
                    double rapid_mm_per_min) {
    Found found{report::describe(program, path.meter, kind, rapid_mm_per_min), {}, path.take_lines()};
    make_room(found.mesh, found.lines);
    return found;
}

// `refusals` receives all refusals of a program, where its reader gives more than the first.
FileResult<Found> inspect_program(std::string_view bytes, const InspectCall& call, job::PathKind kind,
                                  std::vector<Error>& refusals) {
    job::JobMachine machine;
    if (!call.machine.empty()) {
        FileResult<job::JobMachine> named = job::read_machine_named(files::DiskSource(), call.machine);
        if (!named) return std::unexpected(named.error());
        machine = *std::move(named);
    }
    job::ProgramFileOptions options;
    if (machine.kinematics) options.machine = &*machine.kinematics;
    options.clock_s = files::machine_limits().clock_s;
    options.dialect = readers::dialect_of(call.dialect);
    const bool draws = !call.picture.empty();
    PathWatcher path(draws);
    Warnings called;
    std::string whole;
    if (kind == job::PathKind::gcode && job::may_call_programs(bytes)) {
        whole =
            job::with_called_programs(files::DiskSource(), std::string(bytes), call.file, options, called);
        bytes = whole;
    }
    Result<motion::Program> program = job::parse_program(bytes, call.file, kind, options, path);
    if (program) program->warnings.insert(program->warnings.end(), called.begin(), called.end());
    if (program) return found_program(*program, path, kind, machine.rapid_mm_per_min);
    // Maybe only the feed is missing, which a job would give. Read again with a feed; the reader then adds a
    // warning.
    options.default_feed_mm_per_min = kAssumedFeedMmPerMin;
    options.refusals = &refusals;
    PathWatcher again(draws);
    Result<motion::Program> with_feed = job::parse_program(bytes, call.file, kind, options, again);
    if (!with_feed) return std::unexpected(FileFailure(with_feed.error()));
    with_feed->warnings.insert(with_feed->warnings.end(), called.begin(), called.end());
    return found_program(*with_feed, again, kind, machine.rapid_mm_per_min);
}

FileResult<Found> inspect_model(const std::string& file) {
    FileResult<readers::Model> model = files::read_model_file({file, std::nullopt});
    if (!model) return std::unexpected(model.error());
    report::Facts facts = report::describe(*model);
    return Found{
        std::move(facts), std::move(model->mesh), {}, std::move(model->colours), std::move(model->untouched)};
}

FileResult<Found> inspect_response(std::string_view bytes, const std::string& file) {
    const auto response = readers::read_frequency_response(bytes, {.source_name = file});
    if (!response) return std::unexpected(FileFailure(response.error()));
    job::JobFrf all;
    all.file = file;
    Warnings warnings;
    const auto fit = job::fit_response(*response, all, warnings);
    return Found{report::describe(*response, fit, warnings), {}, {}};
}

FileResult<Found> inspect_job(std::string_view bytes, const std::string& file) {
    const files::DiskSource disk;
    FileResult<job::Job> job = job::parse_job(bytes, file, disk);
    if (!job) return std::unexpected(job.error());
    FileResult<motion::Program> program = job::read_and_complete(disk, *job, files::machine_limits());
    if (!program) return std::unexpected(program.error());
    PathWatcher path(true);
    for (const motion::Move& move : program->moves) path.take(move);
    Found found = found_program(*program, path, job->path.kind, job->machine.rapid_mm_per_min);
    std::optional<report::Facts> part;
    if (job->part) {
        FileResult<readers::Model> model = disk.read_model(*job->part);
        if (!model) return std::unexpected(model.error());
        part = report::describe(*model);
        found.mesh = std::move(model->mesh);
        make_room(found.mesh, found.lines);
    }
    found.facts = report::describe(*job, &found.facts, part ? &*part : nullptr, program->moves);
    return found;
}

FileResult<Found> inspect_file(const InspectCall& call, std::vector<Error>& refusals) {
    const std::string& file = call.file;
    const FileResult<std::string> bytes = files::read_file(file);
    if (!bytes) return std::unexpected(bytes.error());
    if (std::filesystem::path(file).extension() == ".toml") return inspect_job(*bytes, file);
    if (files::is_gzip(*bytes)) return inspect_model(file);
    if (material::looks_like_material(*bytes)) {
        const Result<material::Material> material = material::parse_material(*bytes, file);
        if (!material) return std::unexpected(FileFailure(material.error()));
        return Found{report::describe(*material), {}, {}};
    }
    if (readers::looks_like_response(*bytes)) return inspect_response(*bytes, file);
    const std::optional<job::PathKind> program = job::detect_program(*bytes, file);
    if (readers::detect_model_format(*bytes, file) && !program) return inspect_model(file);
    if (program) return inspect_program(*bytes, call, *program, refusals);
    return std::unexpected(FileFailure(
        {file, 0, 0, "is no kind of file that tribo knows: it " + job::likeness(*bytes, file),
         "try G-code (.ngc, .nc), APT (.apt), keyframes (.csv), a model (.stl, .obj, .ply, .wrl), "
         "a job (.toml), a frequency response (.csv, .uff) or a material (.json)"}));
}

int inspect(const InspectCall& call) {
    std::vector<Error> refusals;
    const FileResult<Found> found = inspect_file(call, refusals);
    if (!found) {
        const int code = refusals.empty() ? report(found.error()) : report(refusals[0]);
        for (std::size_t i = 1; i < refusals.size(); ++i) report(refusals[i]);
        if (refusals.size() == readers::kMostRefusals) {
            std::fprintf(stderr, "there may be more: only %zu refusals are shown\n", refusals.size());
        }
        return code;
    }
    if (!call.picture.empty()) {
        if (const auto checked = check_outputs({call.picture}); !checked) return report(checked.error());
        report::PictureOptions options;
        options.on_ground = !found->mesh.triangles.empty();
        options.triangle_colours = found->colours;
        options.sawn = found->untouched;
        const files::Image image = report::draw_part(found->mesh, found->lines, options);
        if (const auto written = files::write_png(call.picture, image); !written)
            return report(written.error());
    }
    if (call.json) {
        std::fputs(found->facts.json.c_str(), stdout);
    } else {
        std::printf("%s\n%s", printable(call.file).c_str(), report::aligned(found->facts.lines).c_str());
        for (const Warning& warning : found->facts.warnings) std::printf("%s\n", warning.message().c_str());
    }
    return std::fflush(stdout) == 0
               ? kDone
               : report(files::system_failure("standard output", "write", errno).error());
}

}  // namespace

void add_inspect(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<InspectCall>();
    CLI::App* verb = program.add_subcommand(
        "inspect", "Say what a program, a model, a job or a frequency response holds, with warnings");
    verb->add_option("FILE", call->file,
                     "G-code, APT, keyframes, a model, a job, a frequency response or a material")
        ->required();
    verb->add_flag("--json", call->json, "Print one JSON object");
    verb->add_option("--picture", call->picture, "Draw it into a PNG file")->type_name("F.png");
    verb->add_option("--machine", call->machine, "Read rotary words of G-code on this machine")
        ->type_name("NAME|F.toml");
    verb->add_option("--dialect", call->dialect,
                     "Read G-code as linuxcnc, fanuc, siemens, heidenhain or num; else told by the text")
        ->check(one_of({readers::kDialectWords.begin(), readers::kDialectWords.end()}))
        ->type_name("NAME");
    verb->callback([call, &exit_code] { exit_code = inspect(*call); });
}

}  // namespace tribo::app
