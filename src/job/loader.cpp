// SPDX-License-Identifier: MIT
#include "job/loader.hpp"

#include <algorithm>
#include <utility>

#include "job/assumption.hpp"
#include "job/completion.hpp"
#include "job/program_file.hpp"
#include "job/toml/job_toml.hpp"

namespace tribo::job {
namespace {

void add(const Warnings& more, Warnings& warnings) {
    warnings.insert(warnings.end(), more.begin(), more.end());
}

FileResult<void> load_solid(const FileSource& files, const JobSolid& solid, Solid& loaded) {
    if (!solid.model) {
        loaded = box_solid(solid.box_mm);
        return {};
    }
    auto model = files.read_model(*solid.model);
    if (!model) return std::unexpected(model.error());
    auto made = mesh_solid(std::move(model->mesh), solid.model->path);
    if (!made) return std::unexpected(FileFailure(made.error()));
    loaded = *std::move(made);
    return {};
}

// `is_assumed`: what neither job nor program says is assumed.
FileResult<void> read_path(const FileSource& files, bool is_assumed, Job& job, motion::Program& program) {
    auto read = read_program(files, job);
    if (!read) return std::unexpected(read.error());
    program = *std::move(read);
    if (is_assumed) assume_job(job, program, program.warnings);
    if (auto done = complete_job(job, program, program.warnings); !done)
        return std::unexpected(FileFailure(done.error()));
    return {};
}

// The jobs that a job's stock comes from, from the last back to the first.
class Chain {
  public:
    Chain(const FileSource& files, LoadedJob& loaded) : files_(files), loaded_(loaded) {}

    FileResult<void> load() {
        const Job* job = &loaded_.job;
        while (job->stock_from) {
            EarlierJob before;
            if (auto done = load_before(*job, before); !done) return done;
            loaded_.earlier.push_back(std::move(before));
            job = &loaded_.earlier.back().job;
        }
        return load_solid(files_, job->stock, loaded_.blank);
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
        if (auto done = read_path(files_, false, before.job, before.program); !done) return done;
        add(before.program.warnings, loaded_.warnings);
        return {};
    }

    const FileSource& files_;
    LoadedJob& loaded_;
    std::vector<Link> links_;  // the jobs on the way back
};

// All that loaded.job names.
FileResult<void> load_all(const FileSource& files, bool is_assumed, const LoadOptions& options,
                          LoadedJob& loaded) {
    Job& job = loaded.job;
    if (auto done = read_path(files, is_assumed, job, loaded.program); !done) return done;
    loaded.warnings = loaded.program.warnings;
    if (auto done = Chain(files, loaded).load(); !done) return done;
    for (const JobSolid& fixture : job.fixtures) {
        if (auto done = load_solid(files, fixture, loaded.fixtures.emplace_back()); !done) return done;
    }
    if (!options.part.empty()) job.part = readers::ModelFile{options.part, {}};
    if (!job.part) return {};
    auto part = files.read_model(*job.part);
    if (!part) return std::unexpected(part.error());
    loaded.part = *std::move(part);
    add(loaded.part->warnings, loaded.warnings);
    return {};
}

}  // namespace

FileResult<motion::Program> read_and_complete(const FileSource& files, Job& job) {
    motion::Program program;
    if (auto done = read_path(files, false, job, program); !done) return std::unexpected(done.error());
    return program;
}

FileResult<LoadedJob> load_job(const FileSource& files, const std::string& name, const LoadOptions& options) {
    auto job = read_job(files, name);
    if (!job) return std::unexpected(job.error());
    FileResult<LoadedJob> loaded;
    loaded->job = *std::move(job);
    if (auto done = load_all(files, false, options, *loaded); !done) return std::unexpected(done.error());
    return loaded;
}

FileResult<LoadedJob> load_program(const FileSource& files, const std::string& name,
                                   const LoadOptions& options) {
    const auto bytes = files.read(name, kLargestProgramBytes);
    if (!bytes) return std::unexpected(bytes.error());
    const auto kind = detect_program(*bytes, name);
    if (!kind) {
        return std::unexpected(
            FileFailure({name, 0, 0, "this is no job and no program that is known here",
                         "drop a job (.toml) with its files, G-code, APT or keyframes (.csv)"}));
    }
    FileResult<LoadedJob> loaded;
    loaded->job = job_of_program(name, *kind);
    if (auto done = load_all(files, true, options, *loaded); !done) return std::unexpected(done.error());
    return loaded;
}

}  // namespace tribo::job
