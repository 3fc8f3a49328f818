// SPDX-License-Identifier: MIT
#include "app/render/job_files.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "base/file_names.hpp"
#include "files/model/model_file.hpp"
#include "job/program_file.hpp"
#include "job/toml/job_toml.hpp"
#include "report/stock_record_json.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

// Absolute, with links in its folders resolved. A link to a job stays: what the job names is found from where
// the link stands.
fs::path resolved(const std::string& file) {
    std::error_code error;
    const fs::path absolute = fs::absolute(file, error);
    const fs::path folder = fs::weakly_canonical(absolute.parent_path(), error);
    return error ? fs::path(file) : folder / absolute.filename();
}

std::string identity(const std::string& file) {
    return resolved(file).string();
}

// Input errors carry no file: they are about the `from` that names the path.
FileResult<session::StockSource> read_source(const std::string& path, std::vector<std::string>& folders) {
    constexpr const char* kName = "name an earlier job (.toml) or the folder of its render";
    const auto refuse = [&](const std::string& cause, std::string remedy) {
        return std::unexpected(FileFailure({"", 0, 0, "'" + path + "' " + cause, std::move(remedy)}));
    };
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return refuse("to take the stock from is not there", kName);
    if (!fs::is_directory(status)) {
        if (extension_of(path) == ".toml") return session::StockSource{path, {}};
        return refuse("is no job (.toml) and no folder of a render",
                      std::string(kName) + "; a model of the stock is mesh = \"FILE\"");
    }
    auto record = report::read_stock_record(path);
    if (!record) {
        if (record.error().fault == FileFault::system) return std::unexpected(record.error());
        return refuse(record.error().cause, record.error().remedy);
    }
    const fs::path folder = fs::weakly_canonical(path, error);
    folders.push_back(folder.string());
    // By the name that was given where that leads to the same file: messages show it.
    std::string file = (path / fs::path(record->job)).lexically_normal().string();
    const fs::path counted = (folder / record->job).lexically_normal();
    if (fs::exists(counted, error) && !fs::equivalent(file, counted, error)) file = counted.string();
    if (!fs::exists(file, error)) {
        return refuse("was rendered from '" + file + "', which is gone",
                      "bring it back, or begin with mesh = \"machined.stl\" of the folder");
    }
    return session::StockSource{file, *std::move(record)};
}

}  // namespace

FileResult<job::Solid> read_solid(const job::JobSolid& solid) {
    if (!solid.model) return job::box_solid(solid.box_mm);
    auto model = files::read_model_file(*solid.model);
    if (!model) return std::unexpected(model.error());
    auto made = job::mesh_solid(std::move(model->mesh), solid.model->path);
    if (!made) return std::unexpected(FileFailure(made.error()));
    return *std::move(made);
}

FileResult<StockOnDisk> read_stock(const job::Job& job, Warnings& warnings) {
    StockOnDisk read;
    FileFault fault = FileFault::input;
    const auto noting_fault = [&fault](auto result) {
        using Value = typename decltype(result)::value_type;
        if (result) return Result<Value>(*std::move(result));
        fault = result.error().fault;
        return Result<Value>(std::unexpected(Error(result.error())));
    };
    session::JobFiles files;
    files.job = [&](const std::string& file) { return noting_fault(job::read_job(file)); };
    files.program = [&](const job::Job& j) { return noting_fault(job::read_program(j)); };
    files.solid = [&](const job::JobSolid& solid) { return noting_fault(read_solid(solid)); };
    files.source = [&](const std::string& path) { return noting_fault(read_source(path, read.folders)); };
    files.identity = identity;
    auto stock = session::read_stock(job, files, warnings);
    if (!stock) return std::unexpected(FileFailure(stock.error(), fault));
    read.stock = *std::move(stock);
    return read;
}

std::string relative_to(const std::string& folder, const std::string& file) {
    return resolved(file).lexically_proximate(folder).string();
}

}  // namespace tribo::app
