// SPDX-License-Identifier: MIT
// Turns Ctrl-C and similar signals into a flag. A run checks the flag, so that it can end without
// incomplete files. A run that does not see the flag in time is ended.
#pragma once

#include <atomic>

namespace tribo::app {

// From now on a thread of its own waits for SIGINT, SIGTERM and SIGHUP and then sets the flag. 0.7 s later,
// or at a second signal, it removes what is unfinished (files/unfinished.hpp) and ends the program with
// interrupted_exit_code(), whatever the other threads do or wait for. A broken pipe and the limit of file
// sizes then give errors of the write, not signals. Call it before any thread starts. The signals are blocked
// in the programs that this one starts, unless it gives them a mask of their own.
void catch_signals();

// True after a signal. Any thread may read it.
const std::atomic<bool>& interrupted();

// 128 + the number of the first signal, as in shells: 130 for Ctrl-C.
int interrupted_exit_code();

}  // namespace tribo::app
