// SPDX-License-Identifier: MIT
#include "job/loader.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "job/assumption.hpp"
#include "job/completion.hpp"
#include "job/input_kind.hpp"
#include "job/job_files.hpp"
#include "job/program_file.hpp"
#include "job/response_modes.hpp"
#include "job/toml/job_toml.hpp"
#include "job/toml/machine_file.hpp"

namespace tribo::job {
namespace {

void add(const Warnings& more, Warnings& warnings) {
    warnings.insert(warnings.end(), more.begin(), more.end());
}

// A triangle with its vertices, and with the tree and the normals of field::MeshDistance.
constexpr std::uint64_t kTriangleBytes = 170;

// What is left of LoadOptions::memory_bytes.
class Budget {
  public:
    explicit Budget(std::uint64_t bytes)
        : left_(bytes == 0 ? std::numeric_limits<std::uint64_t>::max() : bytes) {}

    std::size_t moves() const { return readers::most_moves(left_); }
    std::uint64_t triangles() const { return std::min(readers::kMaxTriangles, left_ / kTriangleBytes); }

    void take(const motion::Program& program) { take(program.moves.size() * readers::kMoveBytes); }
    void take(const TriangleMesh& mesh) { take(mesh.triangles.size() * kTriangleBytes); }

  private:
    void take(std::uint64_t bytes) { left_ -= std::min(left_, bytes); }

    std::uint64_t left_;
};

std::unexpected<FileFailure> refuse_model(const readers::ModelFile& model, Error error) {
    error.file = model.path;
    error.remedy += ", or state the unit of the file as unit_mm";
    return std::unexpected(FileFailure(std::move(error)));
}

// Reads with a budget.
struct Reading {
    const FileSource& files;
    const LoadOptions& options;
    Budget budget{options.memory_bytes};
    std::uint64_t solid_bytes = 0;

    // `most`: of triangles, whatever the budget.
    FileResult<readers::Model> model(const readers::ModelFile& file,
                                     std::uint64_t most = readers::kMaxTriangles) {
        readers::ModelFile limited = file;
        limited.max_triangles = std::min(budget.triangles(), most);
        auto read = files.read_model(limited);
        if (read) budget.take(read->mesh);
        return read;
    }

    FileResult<motion::Program> program(const Job& job) {
        auto read = read_program(files, job, budget.moves(), options.clock_s);
        if (read) budget.take(*read);
        return read;
    }

    FileResult<Solid> solid(const JobSolid& solid, std::uint64_t most = readers::kMaxTriangles) {
        if (!solid.model) return box_solid(solid.box_mm);
        auto read = model(*solid.model, most);
        if (!read) return std::unexpected(read.error());
        if (auto room = check_room(bounds(read->mesh)); !room)
            return refuse_model(*solid.model, room.error());
        auto made = mesh_solid(std::move(read->mesh), solid.model->path);
        if (!made) return std::unexpected(FileFailure(made.error()));
        solid_bytes += made->mesh->mesh().triangles.size() * kTriangleBytes;
        return *std::move(made);
    }
};

FileResult<void> read_path(Reading& reading, Job& job, motion::Program& program) {
    auto read = reading.program(job);
    if (!read) return std::unexpected(read.error());
    program = *std::move(read);
    if (auto done = complete_job(job, program, program.warnings); !done)
        return std::unexpected(FileFailure(done.error()));
    return {};
}

// The same for a job whose modes are needed, too.
FileResult<void> read_path_and_modes(Reading& reading, Job& job, motion::Program& program) {
    if (auto done = read_path(reading, job, program); !done) return done;
    return add_fitted_modes(reading.files, job, reading.options.memory_bytes, program.warnings);
}

// Reads each model of the fixtures once.
FileResult<void> load_fixtures(Reading& reading, LoadedJob& loaded) {
    std::map<std::pair<std::string, double>, std::size_t> read;  // by file and unit: number of the fixture
    std::uint64_t left = kMostFixtureTriangles;
    for (const JobSolid& fixture : loaded.job.fixtures) {
        if (fixture.model) {
            const std::pair key{reading.files.identity(fixture.model->path),
                                fixture.model->unit_mm.value_or(0)};
            const auto [known, is_new] = read.try_emplace(key, loaded.fixtures.size());
            if (!is_new) {
                loaded.fixtures.push_back(loaded.fixtures[known->second]);
                continue;
            }
        }
        auto solid = reading.solid(fixture, left);
        if (!solid) return std::unexpected(solid.error());
        if (solid->mesh) left -= solid->mesh->mesh().triangles.size();
        loaded.fixtures.push_back(*std::move(solid));
    }
    return {};
}

// The jobs that a job's stock comes from, from the last back to the first.
class Chain {
  public:
    Chain(Reading& reading, LoadedJob& loaded) : reading_(reading), files_(reading.files), loaded_(loaded) {}

    FileResult<void> load() {
        const Job* job = &loaded_.job;
        while (job->stock_from) {
            EarlierJob before;
            if (auto done = load_before(*job, before); !done) return done;
            loaded_.earlier.push_back(std::move(before));
            job = &loaded_.earlier.back().job;
        }
        auto blank = reading_.solid(job->stock);
        if (!blank) return std::unexpected(at_key(*job, blank.error()));
        loaded_.blank = *std::move(blank);
        return {};
    }

  private:
    struct Link {
        std::string identity, file;
    };

    FileResult<void> load_before(const Job& job, EarlierJob& before) {
        const JobStockFrom& from = *job.stock_from;
        const auto refuse = [&](std::string cause, std::string remedy, FileFault fault = FileFault::input) {
            return std::unexpected(
                FileFailure({job.file, from.line, from.column, std::move(cause), std::move(remedy)}, fault));
        };
        links_.push_back({files_.identity(job.file), job.file});
        auto source = files_.stock_source(from.path);
        if (!source) {
            FileFailure& error = source.error();
            if (!error.file.empty()) return std::unexpected(std::move(error));
            return refuse(std::move(error.cause), std::move(error.remedy), error.fault);
        }
        before.source = *std::move(source);
        const std::string& file = before.source.job;
        const std::string identity = files_.identity(file);
        const auto again = std::find_if(links_.begin(), links_.end(),
                                        [&](const Link& link) { return link.identity == identity; });
        if (again != links_.end()) {
            std::string circle;
            for (auto link = again; link != links_.end(); ++link) circle += link->file + " -> ";
            return refuse("the job begins with the stock that it leaves itself: " + circle + again->file,
                          "let the first of the jobs begin with box_mm or mesh");
        }
        if (links_.size() > kLongestChain) {
            return refuse(
                "more than " + std::to_string(kLongestChain) + " jobs begin with each other's stock",
                "render an early one, and begin with mesh = \"machined.stl\" of its folder");
        }
        auto read = read_job(files_, file);
        if (!read) return std::unexpected(read.error());
        before.job = *std::move(read);
        if (auto done = read_path(reading_, before.job, before.program); !done)
            return std::unexpected(at_key(before.job, done.error()));
        add(before.program.warnings, loaded_.warnings);
        return {};
    }

    Reading& reading_;
    const FileSource& files_;
    LoadedJob& loaded_;
    std::vector<Link> links_;  // the jobs on the way back
};

// All that loaded.job names besides its program.
FileResult<void> load_rest(Reading& reading, LoadedJob& loaded) {
    Job& job = loaded.job;
    loaded.warnings = loaded.assumptions;
    add(loaded.program.warnings, loaded.warnings);
    if (auto done = Chain(reading, loaded).load(); !done) return done;
    if (auto done = load_fixtures(reading, loaded); !done) return done;
    loaded.solid_bytes = reading.solid_bytes;
    if (const std::string& part = reading.options.part; !part.empty())
        job.part = readers::ModelFile{part, {}};
    if (!job.part) return {};
    auto part = reading.model(*job.part);
    if (!part) return std::unexpected(part.error());
    if (auto place = check_place(bounds(part->mesh)); !place) return refuse_model(*job.part, place.error());
    loaded.part = *std::move(part);
    add(loaded.part->warnings, loaded.warnings);
    return {};
}

Result<void> check(const ProgramInputs& inputs, PathKind kind, const std::string& name) {
    if (kind == PathKind::gcode) return {};
    if (!inputs.machine.empty()) {
        return fail_at(name, 0, 0, "a machine belongs to G-code: other paths hold the tool's axis already",
                       "leave the machine out");
    }
    if (inputs.dialect) return fail_at(name, 0, 0, "a dialect belongs to G-code", "leave the dialect out");
    if (kind == PathKind::keyframes && !inputs.tool_table.empty()) {
        return fail_at(name, 0, 0, "a tool table belongs to a program: keyframes call no tool",
                       "describe the tool in words, as in 'flat 6'");
    }
    return {};
}

// A job for a program: the inputs of the call, what the program declares, and assumptions.
FileResult<void> load_program(Reading& reading, const std::string& name, PathKind kind, LoadedJob& loaded) {
    const ProgramInputs& inputs = reading.options.program;
    if (auto good = check(inputs, kind, name); !good) return std::unexpected(FileFailure(good.error()));
    Job& job = loaded.job;
    job = job_of_program(name, kind, inputs);
    if (!inputs.machine.empty()) {
        auto machine = read_machine_named(reading.files, inputs.machine);
        if (!machine) return std::unexpected(machine.error());
        job.machine = *std::move(machine);
    }
    const Budget before = reading.budget;
    auto program = reading.program(job);
    if (!program) return std::unexpected(program.error());
    const std::size_t given = job.cutters.size();
    auto assumed = take_tools(job, *program, loaded.assumptions);
    if (!assumed) return std::unexpected(FileFailure(assumed.error()));
    const std::size_t described = job.cutters.size();
    assumed->add_to(job);
    std::optional<FileFailure> refusal;  // the first, of the usual size
    while (job.cutters.size() > given) {
        // Cutter compensation follows the tools, so the program is read as a job with these tools reads it.
        *program = {};
        reading.budget = before;
        program = reading.program(job);
        if (program) break;
        if (!refusal) refusal = program.error();
        if (!assumed->shrink_after(program.error())) return std::unexpected(*refusal);
        job.cutters.resize(described);
        assumed->add_to(job);
        program = motion::Program{};
    }
    assumed->say(loaded.assumptions);
    if (auto done = assume_stock(job, *program, inputs, loaded.assumptions); !done)
        return std::unexpected(FileFailure(done.error()));
    say_assumed_process(job, *program, inputs, loaded.assumptions);
    loaded.program = *std::move(program);
    loaded.is_program = true;
    return {};
}

}  // namespace

FileResult<motion::Program> read_and_complete(const FileSource& files, Job& job, const LoadOptions& options) {
    motion::Program program;
    Reading reading{files, options};
    if (auto done = read_path_and_modes(reading, job, program); !done)
        return std::unexpected(at_key(job, done.error()));
    return program;
}

FileResult<LoadedJob> load_job(const FileSource& files, const std::string& name, const LoadOptions& options) {
    FileResult<LoadedJob> loaded;
    FileResult<void> done;
    Reading reading{files, options};
    const auto input = kind_of_input(files, name);
    if (!input) return std::unexpected(input.error());
    if (input->program) {
        done = load_program(reading, name, *input->program, *loaded);
    } else {
        auto job = read_job(files, name, options.changes);
        if (!job) return std::unexpected(job.error());
        loaded->job = *std::move(job);
        done = read_path_and_modes(reading, loaded->job, loaded->program);
    }
    if (done) done = load_rest(reading, *loaded);
    if (!done) return std::unexpected(at_key(loaded->job, done.error()));
    return loaded;
}

}  // namespace tribo::job
