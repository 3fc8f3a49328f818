// SPDX-License-Identifier: MIT
// Ctrl-C and its relatives as a flag that a run looks at, so that it can unwind and leave nothing
// half-written.
#pragma once

#include <atomic>

namespace tribo::app {

// From now on SIGINT, SIGTERM and SIGHUP raise the flag; a second one ends the program at once, as if this
// had never been called. Also makes a broken pipe and a file-size limit errors of the write instead of
// signals.
void catch_signals();

// True once a signal came. Any thread may look.
const std::atomic<bool>& interrupted();

// 128 + the number of the signal, as shells count: 130 for Ctrl-C.
int interrupted_exit_code();

}  // namespace tribo::app
