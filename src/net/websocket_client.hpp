// SPDX-License-Identifier: MIT
// WebSocket client for a service on this machine (RFC 6455): sends and receives text messages.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::net {

struct WebSocketAddress {
    std::string host = "127.0.0.1";
    std::uint16_t port = 0;
    std::string path = "/";
};

// One thread at a time, never a servo or audio thread. Every call returns after `timeout_ms` at the latest.
class WebSocketClient {
  public:
    // The error says whether the port is closed or the service there is no WebSocket.
    static Result<std::unique_ptr<WebSocketClient>> connect(const WebSocketAddress& address, int timeout_ms);
    ~WebSocketClient();

    enum class Got { message, late, closed };
    // Receives the next text message into `text`.
    Got receive(std::string& text);
    // False when the connection is closed.
    bool send(std::string_view text);

  private:
    struct Connection;
    explicit WebSocketClient(std::unique_ptr<Connection> connection);
    std::unique_ptr<Connection> connection_;
};

}  // namespace tribo::net
