// SPDX-License-Identifier: MIT
// Tells jobs, programs and other files apart, by name and content.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "job/file_source.hpp"
#include "job/job.hpp"

namespace tribo::job {

// A job, or a program in one of its formats.
struct InputKind {
    std::optional<PathKind> program;  // absent: a job
};

// A job is named .toml or has a section of a job file; for programs see detect_program(). Refuses other files
// with what they look like.
FileResult<InputKind> kind_of_input(const FileSource& files, const std::string& name);

// What a file looks like that is neither, for messages: "is empty", "looks like a model (STL)", "looks like a
// picture", "is no text" ...
std::string likeness(std::string_view bytes, std::string_view name);

}  // namespace tribo::job
