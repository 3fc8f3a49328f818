// SPDX-License-Identifier: MIT
#include "app/live/opening_page.hpp"

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "files/sibling.hpp"
#include "files/unfinished.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

// A slow machine starts a browser in less.
constexpr auto kReadWithin = std::chrono::seconds(30);

// Also at the end of the process.
struct Removed {
    std::string path;
    ~Removed() {
        if (!path.empty()) ::unlink(path.c_str());
    }
};

std::string page_folder() {
    const char* session = std::getenv("XDG_RUNTIME_DIR");
    if (session != nullptr && session[0] == '/') return session;
    std::error_code error;
    return fs::temp_directory_path(error).string();
}

}  // namespace

std::optional<std::string> write_opening_page(const std::string& url) {
    static Removed page;
    const std::string path = page_folder() + "/" + files::random_sibling("tribo-live-") + ".html";
    const std::string text =
        "<!doctype html>\n<meta charset=\"utf-8\">\n<meta name=\"referrer\" content=\"no-referrer\">\n"
        "<meta http-equiv=\"refresh\" content=\"0; url=" +
        url + "\">\n<title>Tribo</title>\n<p><a href=\"" + url + "\">The live view</a>\n";
    files::note_unfinished(path, files::Removal::with_contents);
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (file < 0) return std::nullopt;
    page.path = path;
    const bool whole = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    ::close(file);
    if (!whole) return std::nullopt;
    std::thread([path] {
        std::this_thread::sleep_for(kReadWithin);
        ::unlink(path.c_str());
    }).detach();
    return path;
}

}  // namespace tribo::app
