// SPDX-License-Identifier: MIT
// The result of a call that reads or writes a file: a value, or an error with its origin: a wrong input of
// the caller or a refusal of the system. The two end the program with different exit codes.
#pragma once

#include <utility>

#include "base/result.hpp"

namespace tribo {

enum class FileFault {
    input,    // the request is wrong: a folder, too long, a file that we must not replace
    missing,  // no such file: the request is wrong as well
    system,   // the file system refused: no right, no room, a broken disk
};

struct FileFailure : Error {
    FileFault fault = FileFault::input;

    FileFailure(Error error, FileFault whose = FileFault::input) : Error(std::move(error)), fault(whose) {}
};

template <class T>
using FileResult = std::expected<T, FileFailure>;

}  // namespace tribo
