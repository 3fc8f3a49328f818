// SPDX-License-Identifier: MIT
// Parts of file names, by their text alone: where there is no file system (a page), too.
#pragma once

#include <string>
#include <string_view>

namespace tribo {

// The file that `file` calls `name`: an absolute name as it is, else from the folder of `file`.
inline std::string file_beside(std::string_view file, std::string_view name) {
    const std::size_t slash = file.rfind('/');
    if (name.starts_with('/') || slash == std::string_view::npos) return std::string(name);
    return std::string(file.substr(0, slash + 1)) + std::string(name);
}

// ".csv" of "a/b.c.csv"; nothing of "a.b/c" and of ".csv", which is a name.
inline std::string_view extension_of(std::string_view file) {
    const std::string_view name = file.substr(file.rfind('/') + 1);
    const std::size_t dot = name.rfind('.');
    return dot == std::string_view::npos || dot == 0 ? std::string_view{} : name.substr(dot);
}

}  // namespace tribo
