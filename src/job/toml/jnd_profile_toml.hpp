// SPDX-License-Identifier: MIT
// Reads a user's just-noticeable differences (docs/feel.md): a TOML file in which every key may be left out.
#pragma once

#include <string>
#include <string_view>

#include "contact/jnd_profile.hpp"
#include "job/file_source.hpp"

namespace tribo::job {

// `file` is the name for messages.
Result<contact::JndProfile> parse_jnd_profile(std::string_view text, const std::string& file);

FileResult<contact::JndProfile> read_jnd_profile(const FileSource& files, const std::string& path);

}  // namespace tribo::job
