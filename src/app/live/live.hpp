// SPDX-License-Identifier: MIT
// `tribo live [JOB]`: shows the job in a browser while it is milled.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/feel/arm_call.hpp"
#include "app/render/program_flags.hpp"

namespace tribo::app {

inline constexpr std::uint16_t kLivePort = 8317;

struct LiveCall {
    std::string job;  // a job or a program; empty: none
    ProgramFlags program;
    std::uint16_t port = kLivePort;
    std::string listen = "127.0.0.1";      // an address in digits
    std::string tls_certificate, tls_key;  // files in PEM; both or none
    bool open = false;                     // opens the page in the browser of the user
    std::string web_root;                  // empty: folder of the build or installation
    std::optional<double> resolution_mm;   // absent: as in render
    std::optional<double> memory_mb;       // absent: memory of the machine
    int threads = 0;                       // 0: all
    std::optional<int> uncertain;          // cases of what is known with a spread only
    std::string audio = "browser";         // sound output: browser, native or off
    ArmCall arm;
    std::string device = "auto";  // "auto": first available arm, else the simulated hand; or a name
};

// Serves until Ctrl-C; gives the exit code.
int live(const LiveCall& call);

}  // namespace tribo::app
