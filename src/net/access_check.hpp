// SPDX-License-Identifier: MIT
// Access check of requests. Every request must name this server in its Host header: this stops DNS
// rebinding, where a foreign page makes its own name resolve to this machine. A WebSocket request must also
// come from a page of this server (Origin header), ask for the subprotocol and carry the token, if one is
// set. Each connected client gets a resume token, which replaces the token once, for the same origin.
//
// Uses no sockets and no clock. One thread at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

namespace tribo::net {

using ClientId = std::uint64_t;

// A resume token expires this long after its client has disconnected.
inline constexpr std::chrono::minutes kResumeTime{10};

struct AccessOptions {
    std::string subprotocol;
    std::string token;               // empty: no token is required
    std::vector<std::string> names;  // names of this server, without port, besides localhost and its address
    bool secure = false;             // pages are served over https
};

// The fields of a request that the check reads, undecoded.
struct Credentials {
    std::string_view host, origin, subprotocol, target;
    std::string_view local_address;  // numeric address of the server side of the connection
};

struct Admission {
    bool resumed = false;
    ClientId previous = 0;  // its id before; that connection may still look open
};

class AccessCheck {
  public:
    using Time = std::chrono::steady_clock::time_point;

    explicit AccessCheck(AccessOptions options);

    // Whether this Host header names this server.
    bool is_own_name(std::string_view host, std::string_view local_address) const;
    // Admits a WebSocket and uses up its resume token. The error is one line with the reason.
    std::expected<Admission, std::string> admit(const Credentials& credentials, Time now);
    // Makes a resume token for a client that was admitted with this origin.
    std::string resume_token(ClientId client, std::string_view origin, Time now);
    // The client has disconnected: the lifetime of its resume token starts.
    void on_disconnect(ClientId client, Time now);

  private:
    struct ResumeToken {
        std::string token, origin;
        ClientId client = 0;
        bool connected = true, used = false;
        Time expires_at;
    };
    std::expected<Admission, std::string> resume(std::string_view token, std::string_view origin, Time now);
    void drop_expired(Time now);

    AccessOptions options_;
    std::deque<ResumeToken> resume_tokens_;  // oldest first
};

}  // namespace tribo::net
