// SPDX-License-Identifier: MIT
#include "app/live/web_files.hpp"

#include <array>
#include <filesystem>

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".webp", "image/webp"},
}};

std::string_view type_of(std::string_view name) {
    for (const auto& [extension, type] : kTypes) {
        if (name.ends_with(extension)) return type;
    }
    return "application/octet-stream";
}

}  // namespace

std::string WebFiles::folder_of(const std::string& name) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path here = program.parent_path();
    for (const fs::path& folder : {here / "../share/tribo/web" / name, here / "../web" / name}) {
        if (fs::is_regular_file(folder / "index.html", error))
            return fs::weakly_canonical(folder, error).string();
    }
    return {};
}

FileResult<WebFiles> WebFiles::read(const std::string& folder) {
    WebFiles files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (!entry.is_regular_file(error)) continue;
        auto bytes = files::read_file(entry.path().string());
        if (!bytes) return std::unexpected(bytes.error());
        files.bytes_["/" + entry.path().filename().string()] = *std::move(bytes);
    }
    if (!files.bytes_.contains("/index.html")) {
        return std::unexpected(FileFailure({folder, 0, 0, "holds no index.html",
                                            "build the pages with 'make build', or name their folder with "
                                            "--web-root"}));
    }
    return files;
}

std::optional<net::Page> WebFiles::page(std::string_view path, net::AcceptedEncodings accepted) const {
    if (path == "/") path = "/index.html";
    const auto stored = [&](std::string_view extension,
                            std::string_view encoding) -> std::optional<net::Page> {
        const auto found = bytes_.find(std::string(path).append(extension));
        if (found == bytes_.end()) return std::nullopt;
        return net::Page{std::string(type_of(path)), found->second, encoding};
    };
    std::optional<net::Page> page;
    if (accepted.brotli) page = stored(".br", "br");
    if (!page && accepted.gzip) page = stored(".gz", "gzip");
    return page ? page : stored("", "");
}

}  // namespace tribo::app
