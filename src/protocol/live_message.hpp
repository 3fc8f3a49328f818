// SPDX-License-Identifier: MIT
// The texts of the live view (docs/live-protocol.md): commands from a page, news to it; with the JSON
// library, which a page's own mill does without (live_command.hpp).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "protocol/live_command.hpp"

namespace tribo::protocol {

// Reads a command. Refuses what is none, saying why in words for the page.
Result<LiveCommand> parse_live_command(std::string_view text);

struct LiveServerInfo {
    std::string version;
    std::string job;  // empty: there is none, and no materials and no device
    Warnings warnings;
    std::vector<std::string> materials;
    std::string device;
    double max_force_n = 0, rate_hz = 0;
    bool arm = false;               // motors move a person's hand
    std::string audio = "browser";  // who sounds: browser, native or off
    std::string resume;             // the token with which this client may come back
    bool resumed = false;           // it came back
};

// What a page is told first.
std::string live_server_info(const LiveServerInfo& info);
// That a command was refused.
std::string live_refusal(const Error& error);
// The files of the job were read again. `wrong`: their fault, with which the cut before goes on; none: they
// are good. `warnings`: of the cut that is milled now.
std::string live_files(const std::optional<Error>& wrong, const Warnings& warnings);
// That frames were dropped: the page asks for all of them with resync.
std::string live_lost();

}  // namespace tribo::protocol
