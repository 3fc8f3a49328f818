// SPDX-License-Identifier: MIT
// What toml++ asks of a standard library and libc++ 19 for WebAssembly leaves out; included before it there
// (src/wasm/CMakeLists.txt). Without the first it falls back on streams and their locales, 200 KB of module;
// the second stands in a function that nobody calls.
#pragma once

#include <charconv>
#include <istream>
#include <streambuf>
#include <string_view>

#include "base/decimal.hpp"

#define TOML_FLOAT_CHARCONV 1

namespace std {

inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format = chars_format::general) {
    const size_t read = tribo::parse_decimal(string_view(first, static_cast<size_t>(last - first)), value);
    return {first + read, read > 0 ? errc{} : errc::invalid_argument};
}

template <>
class basic_ifstream<char> : public basic_istream<char> {
  public:
    basic_ifstream() : basic_istream<char>(nullptr) {}
    void open(const string&, ios_base::openmode) {}
    bool is_open() const { return false; }
    void close() {}
};

}  // namespace std
