// SPDX-License-Identifier: MIT
// Server of a live view: addresses, names, token and TLS, with their messages.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/live/live.hpp"
#include "app/live/web_files.hpp"
#include "net/server.hpp"

namespace tribo::app {

inline constexpr const char* kLiveSubprotocol = "tribo.live.1";

// Options from --listen, --port and --tls-*, with the TLS files. For other machines it makes an access
// token.
FileResult<net::ServerOptions> live_server_options(const LiveCall& call);

// Addresses of this server: first for a browser on this machine, then for other machines.
std::vector<std::string> live_urls(const net::ServerOptions& options, std::uint16_t port);

// The built page of the live view.
FileResult<WebFiles> live_page(const LiveCall& call);

// Starts the server, prints `what` and the addresses, prints warnings, and opens a browser if requested.
// Returns null after an error message, with `exit_code` set.
std::unique_ptr<net::Server> open_live_server(const LiveCall& call, const std::string& what,
                                              net::ServerHandlers handlers, int& exit_code);

// The text that a client gets before the server closes its connection for breaking a rule.
std::string live_last_words(std::string_view why);

// Serves the page without a job, for files that are dropped into it, until Ctrl-C. Returns the exit
// code.
int live_without_job(const LiveCall& call);

}  // namespace tribo::app
