// SPDX-License-Identifier: MIT
// What this process has begun to write and not yet given its name. An end without destructors, as after a
// signal, removes it with this list. Any thread.
#pragma once

#include <string>

namespace tribo::files {

enum class Removal { with_contents, if_empty };

void note_unfinished(const std::string& path, Removal removal);
void forget_unfinished(const std::string& path);

// Removes all that is noted, the newest first. Whoever notes or forgets something afterwards waits for the
// end of the process: call this only just before that.
void remove_unfinished();

}  // namespace tribo::files
