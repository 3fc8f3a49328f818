// SPDX-License-Identifier: MIT
// The rules of the house, as functions of a source's path and text, so that they can be tried on made-up
// sources.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tribo::house {

struct Room {
    std::string name;
    std::string table_entry;            // the last column of the README's table
    std::set<std::string> may_include;  // other rooms
    bool same_bits;                     // compiles to WebAssembly and is hashed
};

// The table of README.md, top to bottom.
const std::vector<Room>& rooms();

// What breaks a rule, each as `path:line: complaint`. `path` is relative to the repository.
std::vector<std::string> include_complaints(const std::string& path, std::string_view text);
std::vector<std::string> same_bits_complaints(const std::string& path, std::string_view text);
std::vector<std::string> form_complaints(const std::string& path, std::string_view text);

// The functions of the unnamed namespace, each once. Neighbours are compiled as one source (CONTRIBUTING.md),
// so one that has the name of a neighbour's may be taken for it.
std::set<std::string> helpers_of(std::string_view text);

}  // namespace tribo::house
