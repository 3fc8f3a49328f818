// SPDX-License-Identifier: MIT
#include "app/outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "files/files.hpp"
#include "files/folder_list.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const std::string& one, const std::string& other) {
    std::error_code error;
    if (fs::equivalent(one, other, error) && !error) return fs::is_regular_file(one, error);
    // Files that are not there yet.
    const fs::path a = fs::weakly_canonical(fs::absolute(one, error), error),
                   b = fs::weakly_canonical(fs::absolute(other, error), error);
    return !error && !fs::exists(a, error) && a == b;
}

std::unexpected<FileFailure> refuse(const std::string& file, std::string cause,
                                    std::string remedy = "name another file for the output") {
    return std::unexpected(FileFailure({file, 0, 0, std::move(cause), std::move(remedy)}));
}

}  // namespace

FileResult<void> check_outputs(const std::vector<std::string>& outputs,
                               const std::vector<std::string>& inputs) {
    std::vector<std::string> named;
    std::ranges::copy_if(outputs, std::back_inserter(named), [](const auto& name) { return !name.empty(); });
    for (auto output = named.begin(); output != named.end(); ++output) {
        const auto is_output = [&](const std::string& other) { return is_same_file(*output, other); };
        if (files::was_read(*output) || std::ranges::any_of(inputs, is_output))
            return refuse(*output, "is an input of this run and would be replaced");
        if (std::any_of(named.begin(), output, is_output)) return refuse(*output, "is named for two outputs");
        std::error_code error;
        if (fs::is_directory(*output, error)) return refuse(*output, "is a folder");
        const fs::path folder = fs::path(*output).parent_path();
        if (!folder.empty() && !fs::is_directory(folder, error)) {
            return refuse(*output, "its folder is not there",
                          "make the folder " + folder.string() + ", or name another file for the output");
        }
    }
    return {};
}

FileResult<void> check_output_folder(const files::OutputFolder& folder) {
    for (const std::string& name : files::read_folder_list(folder.path())) {
        if (name == files::kFolderList || !files::was_read(folder.path() + "/" + name)) continue;
        return std::unexpected(FileFailure({folder.name() + "/" + name, 0, 0,
                                            "is an input of this run, which would replace its folder",
                                            "name another folder for the output"}));
    }
    return {};
}

}  // namespace tribo::app
