// SPDX-License-Identifier: MIT
// One file out of a zip archive (APPNOTE 6.3), for tool libraries that are packed so. Stored and deflated
// entries; no encryption, no parts on several disks, no zip64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::files {

bool is_zip(std::string_view bytes);

// Returns the first entry whose name ends with `suffix`. Refuses as soon as it unpacks to more than
// `limit_bytes`, and contents that do not have their stated size and checksum.
Result<std::string> unzip(std::string_view bytes, std::string_view suffix, std::uint64_t limit_bytes,
                          const std::string& source_name);

}  // namespace tribo::files
