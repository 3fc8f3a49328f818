// SPDX-License-Identifier: MIT
// Hidden siblings of a file or folder: what is written there takes the name later. Each is locked (flock)
// while its process lives, so that a later run can tell and remove what a killed one left.
#pragma once

#include <string>
#include <vector>

namespace tribo::files {

// `.BASE.tribo-KIND-`: all siblings of one kind begin so.
std::string sibling_prefix(const std::string& base, const char* kind);

// A name that nobody can foresee: `prefix` and 16 hexadecimal digits.
std::string random_sibling(const std::string& prefix);

// Locks the file or folder that `descriptor` has open. False: another process holds it, or `path` names
// another one by now.
bool hold_sibling(int descriptor, const std::string& path);

// The siblings in `folder` that no living process holds. Links are none.
std::vector<std::string> abandoned_siblings(const std::string& folder, const std::string& prefix);

// Sends what `descriptor` has open to the disk. Returns 0 or the error number. A file system that cannot do
// so has nothing more durable to offer: 0.
int sync_descriptor(int descriptor);

}  // namespace tribo::files
