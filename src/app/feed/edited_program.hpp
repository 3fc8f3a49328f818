// SPDX-License-Identifier: MIT
// A program with another text, read and prepared as the one on the disk.
#pragma once

#include <string>

#include "app/feed/feed.hpp"
#include "base/file_result.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::app {

// `file`: the program of the job, which has this text now. Warnings are not said again.
FileResult<session::MillSetup> prepare_edited(const FeedCall& call, const std::string& file, std::string text,
                                              double cell_mm);

}  // namespace tribo::app
