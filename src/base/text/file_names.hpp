// SPDX-License-Identifier: MIT
// Parts of file names, from their text alone, so that it also works without a file system (in a page).
#pragma once

#include <string>
#include <string_view>

namespace tribo {

// Returns the file that `file` calls `name`: an absolute name unchanged, else relative to the folder of
// `file`.
inline std::string file_beside(std::string_view file, std::string_view name) {
    const std::size_t slash = file.rfind('/');
    if (name.starts_with('/') || slash == std::string_view::npos) return std::string(name);
    return std::string(file.substr(0, slash + 1)) + std::string(name);
}

// Returns ".csv" for "a/b.c.csv"; nothing for "a.b/c" and for ".csv", which is a name.
inline std::string_view extension_of(std::string_view file) {
    const std::string_view name = file.substr(file.rfind('/') + 1);
    const std::size_t dot = name.rfind('.');
    return dot == std::string_view::npos || dot == 0 ? std::string_view{} : name.substr(dot);
}

}  // namespace tribo
