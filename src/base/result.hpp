// SPDX-License-Identifier: MIT
// What a function gives that can fail on its input: a value, or an Error that a person can act on.
// Program errors are asserts, never Errors.
#pragma once

#include <expected>
#include <string>
#include <utility>
#include <vector>

namespace tribo {

struct Error {
    std::string file;    // as the user named it; empty when no file is involved
    int line = 0;        // from 1; 0: not about one line
    int column = 0;      // from 1; 0: not about one column
    std::string cause;   // what is wrong, as a clause without a full stop
    std::string remedy;  // what to do about it, as an imperative clause; may be empty

    // `file:line:column: error: cause; remedy`, leaving out what is not known.
    std::string text() const;
};

template <class T>
using Result = std::expected<T, Error>;

inline std::unexpected<Error> fail(std::string cause, std::string remedy = {}) {
    return std::unexpected(Error{{}, 0, 0, std::move(cause), std::move(remedy)});
}
inline std::unexpected<Error> fail_at(std::string file, int line, int column, std::string cause,
                                      std::string remedy = {}) {
    return std::unexpected(Error{std::move(file), line, column, std::move(cause), std::move(remedy)});
}

// Something read and understood with an assumption that the user should know of.
struct Warning {
    std::string file;
    int line = 0;  // from 1; 0: not about one line
    std::string text;

    // `file:line: warning: text`
    std::string message() const;
};
using Warnings = std::vector<Warning>;

}  // namespace tribo
