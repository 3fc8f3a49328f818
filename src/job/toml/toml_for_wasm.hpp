// SPDX-License-Identifier: MIT
// What toml++ asks of a standard library and libc++ 19 for WebAssembly leaves out: numbers with a decimal
// point, and the stream of a file, in a function that nobody calls. Without the first, toml++ falls back on
// streams and their locales, 200 KB of module.
//
// toml++ writes `std::` inside its own namespace, where the compiler looks for a namespace of that name
// first: `toml::std` is the standard library and these two. Nothing is added to `::std`.
#pragma once

#include <charconv>
#include <istream>
#include <string>
#include <string_view>

#include "base/text/decimal.hpp"

#define TOML_FLOAT_CHARCONV 1

namespace toml::std {

using namespace ::std;

using ::std::from_chars;
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const size_t read = tribo::parse_decimal(string_view(first, static_cast<size_t>(last - first)), value);
    return {first + read, read > 0 ? errc{} : errc::invalid_argument};
}

class ifstream : public istream {
  public:
    ifstream() : istream(nullptr) {}
    void open(const string&, ios_base::openmode) {}
    bool is_open() const { return false; }
};

}  // namespace toml::std
