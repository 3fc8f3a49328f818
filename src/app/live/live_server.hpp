// SPDX-License-Identifier: MIT
// Where and to whom a live view is served: addresses, names, token, TLS, and the words about it.
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

// As --listen, --port and --tls-* say, reading the files they name. Beyond this machine it asks for a token,
// made here.
FileResult<net::ServerOptions> live_server_options(const LiveCall& call);

// Where a server of these options is found: first for a browser on this machine, then for others.
std::vector<std::string> live_urls(const net::ServerOptions& options, std::uint16_t port);

// The built page of the live view.
FileResult<WebFiles> live_page(const LiveCall& call);

// Starts the server, prints that `what` is there and where, warns of what will not work, opens a browser
// where the call wants one. Nothing: it was said why not, and `exit_code` is set.
std::unique_ptr<net::Server> open_live_server(const LiveCall& call, const std::string& what,
                                              net::ServerHandlers handlers, int& exit_code);

// Serves the page with nothing on the bench, for files that are dropped into it, until Ctrl-C; gives the exit
// code.
int live_without_job(const LiveCall& call);

}  // namespace tribo::app
