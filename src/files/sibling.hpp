// SPDX-License-Identifier: MIT
// Hidden siblings of a file or folder: what is written there takes the name later. Each is locked (flock)
// while its process lives, so that a later run can tell and remove what a killed one left.
#pragma once

#include <functional>
#include <string>

namespace tribo::files {

// `.BASE.tribo-KIND-`: all siblings of one kind begin so.
std::string sibling_prefix(const std::string& base, const char* kind);

// A name that nobody can foresee: `prefix` and 16 hexadecimal digits.
std::string random_sibling(const std::string& prefix);

// Locks the file or folder that `descriptor` has open. False: another process holds it, or `path` names
// another one by now.
bool hold_sibling(int descriptor, const std::string& path);

// Calls `visit` with each sibling in `folder` that no living process holds. Links are none. It stays locked
// while `visit` runs: a process that has just made it cannot take it, and makes another.
void visit_abandoned(const std::string& folder, const std::string& prefix,
                     const std::function<void(const std::string&)>& visit);

// Sends what `descriptor` has open to the disk. Returns 0 or the error number. A file system that cannot do
// so has nothing more durable to offer: 0.
int sync_descriptor(int descriptor);

}  // namespace tribo::files
