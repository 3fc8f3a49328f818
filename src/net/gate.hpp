// SPDX-License-Identifier: MIT
// Who may come in. A request names this server in Host (against DNS rebinding: a foreign page whose name
// suddenly means this machine); a WebSocket also comes from a page of this server's (Origin), asks for the
// subprotocol and, where one is set, brings the token. A client that was in gets a resume token, good once,
// for pages of the same origin, in the place of the token.
//
// Knows no sockets and no clock; one thread at a time.
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

// How long after its client has gone a resume token is good.
inline constexpr std::chrono::minutes kResumeTime{10};

struct GateOptions {
    std::string subprotocol;
    std::string token;               // empty: none is asked for
    std::vector<std::string> names;  // without port; besides localhost and the address that was asked
    bool secure = false;             // pages come over https
};

// What a request says of itself, undecoded.
struct Knock {
    std::string_view host, origin, subprotocol, target;
    std::string_view asked_address;  // this end of its connection, in digits
};

struct Admission {
    bool resumed = false;
    ClientId before = 0;  // who it was; may still look as if it were here
};

class Gate {
  public:
    using Time = std::chrono::steady_clock::time_point;

    explicit Gate(GateOptions options);

    // Whether a request by this Host means this server.
    bool goes_by(std::string_view host, std::string_view asked_address) const;
    // Lets a WebSocket in, using up the resume token that it brings, or says in a line why not.
    std::expected<Admission, std::string> admit(const Knock& knock, Time now);
    // A resume token for a client that was let in with this origin.
    std::string resume_token(ClientId client, std::string_view origin, Time now);
    // From now on its resume token grows old.
    void left(ClientId client, Time now);

  private:
    struct Resume {
        std::string token, origin;
        ClientId client = 0;
        bool here = true, used = false;
        Time good_until;
    };
    std::expected<Admission, std::string> resume(std::string_view token, std::string_view origin, Time now);
    void forget_old(Time now);

    GateOptions options_;
    std::deque<Resume> resumes_;  // in the order of their making
};

}  // namespace tribo::net
