// SPDX-License-Identifier: MIT
// `tribo live [JOB]`: the job milled before the eyes of a browser.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/feel/arm_call.hpp"

namespace tribo::app {

inline constexpr std::uint16_t kLivePort = 8317;

struct LiveCall {
    std::string job;  // empty: an empty bench
    std::uint16_t port = kLivePort;
    std::string listen = "127.0.0.1";      // an address in digits
    std::string tls_certificate, tls_key;  // files in PEM; both or none
    bool open = false;                     // the page in the user's browser
    std::string web_root;                  // empty: as built or installed
    std::optional<double> resolution_mm;   // absent: as render
    int threads = 0;                       // 0: all
    std::string audio = "browser";         // who sounds: browser, native or off
    ArmCall arm;
    std::string device = "auto";  // the first arm that opens, else the simulated hand; or its word
};

// Serves until Ctrl-C; gives the exit code.
int live(const LiveCall& call);

}  // namespace tribo::app
