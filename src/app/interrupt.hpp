// SPDX-License-Identifier: MIT
// Turns Ctrl-C and similar signals into a flag. A run checks the flag, so that it can end without
// incomplete files.
#pragma once

#include <atomic>

namespace tribo::app {

// From now on SIGINT, SIGTERM and SIGHUP set the flag. A second signal ends the program at once.
// A broken pipe and the limit of file sizes then give errors of the write, not
// signals.
void catch_signals();

// True after a signal. Any thread may read it.
const std::atomic<bool>& interrupted();

// 128 + the number of the signal, as in shells: 130 for Ctrl-C.
int interrupted_exit_code();

}  // namespace tribo::app
