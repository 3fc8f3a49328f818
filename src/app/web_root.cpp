// SPDX-License-Identifier: MIT
#include "app/web_root.hpp"

#include <filesystem>
#include <vector>

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

}  // namespace

io::FileResult<std::string> find_web_files(const std::string& web_root, const std::string& part) {
    std::error_code error;
    std::vector<fs::path> places;
    if (!web_root.empty()) {
        places.emplace_back(web_root);
    } else {
        const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
        places = {program / "../share/tribo/web", program / "../web"};
    }
    for (const fs::path& place : places) {
        if (fs::is_directory(place / part, error)) return (place / part).string();
    }
    const std::string remedy =
        "run `make build` with Node.js 20.19 or newer, or name the folder by --web-root";
    return std::unexpected(io::Failure({web_root.empty() ? part : (fs::path(web_root) / part).string(), 0, 0,
                                        "the pages are not there", remedy}));
}

}  // namespace tribo::app
