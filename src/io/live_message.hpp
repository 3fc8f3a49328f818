// SPDX-License-Identifier: MIT
// The texts of the live view (docs/live-protocol.md): commands from a page, news to it.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::io {

enum class LiveOp { play, pause, speed, seek, resync };

struct LiveCommand {
    LiveOp op = LiveOp::pause;
    double value = 0;  // of speed: seconds of the program per second; of seek: the time, s
};

// Refuses what is no command, saying why in words for the page.
Result<LiveCommand> parse_live_command(std::string_view text);

// What a page is told first.
std::string live_server_info(const std::string& version, const std::string& job, const Warnings& warnings);
// That a command was refused.
std::string live_refusal(const Error& error);
// That frames were dropped: the page asks for all of them with resync.
std::string live_lost();

}  // namespace tribo::io
