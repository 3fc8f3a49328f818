// SPDX-License-Identifier: MIT
// HTTP and WebSocket server on one port, plain or TLS, for the pages of this program (RFC 9112, RFC 6455,
// RFC 8446). It runs one thread. Every function may be called from any thread except a real-time one, and no
// function waits for a client.
//
// access_check.hpp decides whether a request is allowed. A refused request gets status 403 and one line with
// the reason. A plain request to a TLS server is redirected to https.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "net/access_check.hpp"

struct ssl_ctx_st;  // OpenSSL's

namespace tribo::net {

using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;

struct Page {
    std::string content_type;
    std::string_view body;      // stays valid as long as the server runs
    std::string_view encoding;  // "br" or "gzip" where the body is compressed; else empty
};

// Compressed encodings that the browser accepts.
struct AcceptedEncodings {
    bool brotli = false, gzip = false;
};

struct ServerOptions {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;  // 0: any free port
    std::string subprotocol;
    std::string token;                 // empty: no token is required
    std::vector<std::string> hosts;    // names of this server (without port), besides localhost and its
                                       // address
    std::shared_ptr<ssl_ctx_st> tls;   // from tls.hpp; null: no TLS
    std::size_t queue_bytes = 32e6;    // data queue of one client; when it is full the oldest is dropped
    std::size_t message_bytes = 4096;  // a client that sends a longer message is disconnected
    int messages_per_s = 500;          // a client with a higher rate over two seconds is disconnected
    // At most so many at once, in all and of one address (of IPv6: of a network of 64 bits). One that comes
    // then takes the place of the one that has been idle for the longest time. A connection without a request
    // is idle at once, a client (WebSocket) when it has not answered for kSilentTime.
    std::size_t connections = 256, connections_per_address = 128;
    std::size_t clients = 64, clients_per_address = 32;
    // Checked 20 times a second on the server thread: true says goodbye to all clients (close code 1001) and
    // accepts no more. Empty: only the destructor does.
    std::function<bool()> is_over;
};

// A client that answers no ping for this long is disconnected, and gives way to others before that.
inline constexpr std::chrono::seconds kLongestSilence{30}, kSilentTime{20};

// Whether the receiver has room for a message.
enum class Taken { yes, too_many, too_much };

struct ResumeInfo {
    bool resumed = false;  // the client connected with a resume token
    std::string token;     // for one reconnection, until kResumeTime after it disconnects
};

// Called on the server thread. They must not block.
struct ServerHandlers {
    std::function<std::optional<Page>(std::string_view path, AcceptedEncodings accepted)>
        on_get;  // none: 404
    std::function<void(ClientId, const ResumeInfo&)> on_connect;
    // A client whose message is not taken is disconnected, with code 1008 (too many) or 1009 (too much).
    std::function<Taken(ClientId, std::string_view text)> on_message;
    std::function<void(ClientId)> on_disconnect;
    // The data queue of this client was full and data was dropped: the client needs a full replay.
    std::function<void(ClientId)> on_overflow;
    // Makes the text that a client gets before it is disconnected for breaking a rule. May be empty.
    std::function<std::string(std::string_view why)> last_words;
};

class Server {
  public:
    // Starts to listen. The error names an address or port that the system refuses.
    static Result<std::unique_ptr<Server>> start(const ServerOptions& options, ServerHandlers handlers);
    ~Server();  // says goodbye to all clients (close code 1001) and waits up to 0.3 s for their answers
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    std::uint16_t port() const;
    // Control messages are never dropped. A client with a thousand unread ones is disconnected.
    void send_text(ClientId to, std::string text);
    void send_text_all(const std::string& text);  // to all clients that have received a text of their own
    // Sends the answer to an invalid message. After kMostRefusals of them the client is disconnected.
    void refuse(ClientId client, std::string text);
    static constexpr int kMostRefusals = 100;
    // Data messages, to one client or to all clients that have received a text of their own (the greeting
    // comes first). When a client is too slow the oldest data is dropped.
    void send(ClientId to, Bytes data);
    void send_all(const Bytes& data);
    // Replaces the data that waits for this client by all of these. They do not count for queue_bytes: the
    // caller keeps them anyway.
    void replay(ClientId to, std::vector<Bytes> data);
    // Closes with code 1008 and at most 123 bytes of reason.
    void disconnect(ClientId client, std::string why);
    std::size_t clients() const;

  private:
    struct Parts;
    explicit Server(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace tribo::net
