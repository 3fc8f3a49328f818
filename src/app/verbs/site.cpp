// SPDX-License-Identifier: MIT
// `tribo site --out DIR`: the static site, ready for any web server.
#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/exit.hpp"
#include "app/live/web_files.hpp"
#include "app/verbs/verbs.hpp"
#include "base/text/printable.hpp"
#include "files/output_folder.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

struct SiteCall {
    std::string out, web_root;
};

// Returns the files under `folder` by relative path, sorted.
std::vector<std::string> files_of(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (at->is_regular_file(error)) files.push_back(at->path().lexically_relative(folder).string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

int site(const SiteCall& call) {
    const std::string from = call.web_root.empty() ? WebFiles::folder_of("site") : call.web_root;
    std::error_code missing;
    if (from.empty() || !fs::is_regular_file(from + "/index.html", missing)) {
        return report(
            Error{from, 0, 0, "the pages of the site are not there",
                  "run 'make build' with Node.js 20.19 or newer, or name their folder with --web-root"});
    }
    const std::vector<std::string> files = files_of(from);
    auto folder = files::OutputFolder::open(call.out, [&](const std::string& name) {
        return std::binary_search(files.begin(), files.end(), name);
    });
    if (!folder) return report(folder.error());
    std::error_code error;
    if (fs::equivalent(from, folder->path(), error) && !error) {
        return report(Error{call.out, 0, 0, "holds the pages that are to be copied",
                            "name another folder for the site"});
    }
    for (const std::string& file : files) {
        const FileResult<std::string> bytes = files::read_file(from + "/" + file);
        if (!bytes) return report(bytes.error());
        fs::create_directories(fs::path(folder->file(file)).parent_path(), error);
        if (auto done = files::write_file(folder->file(file), *bytes); !done) return report(done.error());
    }
    if (auto done = folder->commit(); !done) return report(done.error());
    std::printf("%-16s %zu files in %s\n", "site", files.size(), printable(folder->path()).c_str());
    std::printf("%-16s any web server will do; sound needs https or localhost\n", "serve");
    return kDone;
}

}  // namespace

void add_site(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<SiteCall>();
    CLI::App* verb =
        program.add_subcommand("site", "Write the static site: touch page and mill page, no server needed");
    verb->add_option("--out", call->out, "Folder for the site; an older one of Tribo's is replaced whole")
        ->required()
        ->type_name("DIR");
    verb->add_option("--web-root", call->web_root, "Folder of the built pages; found by itself if absent")
        ->type_name("DIR");
    verb->callback([call, &exit_code] { exit_code = site(*call); });
}

}  // namespace tribo::app
