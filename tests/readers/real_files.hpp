// SPDX-License-Identifier: MIT
// Real programs that lie beside the repository, where they do.
#pragma once

#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "places.hpp"

namespace tribo::readers {

// The bytes of a file of ../shared/data/gcode; none where the folder is missing.
inline std::optional<std::string> real_file(const std::string& name) {
    std::ifstream in(std::string(TRIBO_SOURCE_DIR) + "/../shared/data/gcode/" + name, std::ios::binary);
    if (!in) return std::nullopt;
    return std::string{std::istreambuf_iterator<char>(in), {}};
}

}  // namespace tribo::readers
