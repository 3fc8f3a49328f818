// SPDX-License-Identifier: MIT
// Strings in JSON (RFC 8259), for the modules of the pages, which have no JSON library. Any thread.
#pragma once

#include <string>
#include <string_view>

namespace tribo {

// Appends `text` in quotes. Bytes that are not UTF-8 (RFC 3629) become replacement characters.
void append_json_string(std::string& to, std::string_view text);

}  // namespace tribo
