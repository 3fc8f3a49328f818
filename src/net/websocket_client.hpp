// SPDX-License-Identifier: MIT
// A WebSocket to a service on this machine (RFC 6455): text out, text in, one at a time.
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

// One thread at a time, never a servo's or audio's. Every call gives up after `timeout_ms`.
class WebSocketClient {
  public:
    // The error says whether nobody listens there or somebody does not speak WebSocket.
    static Result<std::unique_ptr<WebSocketClient>> connect(const WebSocketAddress& address, int timeout_ms);
    ~WebSocketClient();

    enum class Got { message, late, closed };
    // The next text message into `text`.
    Got receive(std::string& text);
    // False where the connection is gone.
    bool send(std::string_view text);

  private:
    struct Connection;
    explicit WebSocketClient(std::unique_ptr<Connection> connection);
    std::unique_ptr<Connection> connection_;
};

}  // namespace tribo::net
