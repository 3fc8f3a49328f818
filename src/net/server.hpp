// SPDX-License-Identifier: MIT
// HTTP and WebSocket on one port, in the clear or inside TLS, for a page of our own (RFC 9112, RFC 6455, RFC
// 8446). One thread inside; every function may be called from any thread but a real-time one, none waits for
// a client.
//
// Who is let in is the gate's to say (gate.hpp); others get 403 and a line that says why. Who asks in the
// clear where TLS is spoken is sent to https.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "net/gate.hpp"

struct ssl_ctx_st;  // OpenSSL's

namespace tribo::net {

using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;

struct Page {
    std::string content_type;
    std::string_view body;      // stays valid as long as the server runs
    std::string_view encoding;  // "br" or "gzip" where the body is compressed; else empty
};

// The compressed bodies that the browser says it can read.
struct Unpacks {
    bool brotli = false, gzip = false;
};

struct ServerOptions {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;  // 0: any that is free
    std::string subprotocol;
    std::string token;                // empty: none is asked for
    std::vector<std::string> hosts;   // names (without port) that this server goes by, besides localhost and
                                      // the address that was asked
    std::shared_ptr<ssl_ctx_st> tls;  // tls.hpp makes one; none: in the clear
    std::size_t queue_bytes = 32e6;   // of data that waits for one client; beyond it the oldest is dropped
    std::size_t message_bytes = 1e6;  // a client that sends longer messages is cut off
    int messages_per_s = 500;         // and so is one that sends more of them than this for two seconds
};

struct Arrival {
    bool resumed = false;  // with a resume token
    std::string resume;    // with which it may come back once, until kResumeTime after it has gone
};

// Called on the server's thread; they must not wait.
struct ServerHandlers {
    std::function<std::optional<Page>(std::string_view path, Unpacks unpacks)> page;  // GET; none: 404
    std::function<void(ClientId, const Arrival&)> came;
    std::function<void(ClientId, std::string_view text)> message;
    std::function<void(ClientId)> went;
    // Data that this client did not take in time was dropped: it needs all of it anew.
    std::function<void(ClientId)> lost;
};

class Server {
  public:
    // Listens. Refuses an address or port that the system does not give, saying which.
    static Result<std::unique_ptr<Server>> start(const ServerOptions& options, ServerHandlers handlers);
    ~Server();  // closes all connections
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    std::uint16_t port() const;
    // Control: never dropped. A client that lets a thousand of them wait is cut off.
    void send_text(ClientId to, std::string text);
    void send_text_all(const std::string& text);  // to all that have had one of their own
    // The same, to a message that made no sense: a client that gets kMostRefusals of them is cut off.
    void refuse(ClientId client, std::string text);
    static constexpr int kMostRefusals = 100;
    // Data: to one client, or to all that have had a text of their own (so that a greeting comes first);
    // dropped oldest first where a client does not keep up.
    void send(ClientId to, Bytes data);
    void send_all(const Bytes& data);
    // Closes with code 1008 and at most 123 bytes of reason.
    void cut_off(ClientId client, std::string why);
    std::size_t clients() const;

  private:
    struct Parts;
    explicit Server(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace tribo::net
