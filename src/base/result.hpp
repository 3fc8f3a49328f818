// SPDX-License-Identifier: MIT
// The result of a function that can fail on its input: a value, or an Error with a remedy for the user.
// Program errors are asserts, never Errors.
#pragma once

#include <expected>
#include <string>
#include <utility>
#include <vector>

namespace tribo {

struct Error {
    std::string file;    // as given by the user; empty if no file is involved
    int line = 0;        // from 1; 0: no specific line
    int column = 0;      // from 1; 0: no specific column
    std::string cause;   // the fault, as a clause without a full stop
    std::string remedy;  // the remedy, as an imperative clause; may be empty

    // `file:line:column: error: cause; remedy`, without the unknown parts, as printable().
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

// Input that was read with an assumption that the user should know.
struct Warning {
    std::string file;
    int line = 0;  // from 1; 0: no specific line
    std::string text;

    // `file:line: warning: text`, as printable().
    std::string message() const;
};
using Warnings = std::vector<Warning>;

}  // namespace tribo
