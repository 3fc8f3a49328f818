// SPDX-License-Identifier: MIT
// A page of `tribo live`, without a browser.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <string>

#include "net/raw_client.hpp"

namespace tribo::test {

inline constexpr const char* kProtocol = "tribo.live.1";

// The address that was printed first, in its parts.
struct Address {
    std::string scheme, host, token;
    std::uint16_t port = 0;
};
inline Address address_in(const std::string& out) {
    Address a;
    const std::size_t at = out.find(" live at ") + 9, slashes = out.find("://", at);
    if (at < 9 || slashes == std::string::npos) return a;
    const std::size_t colon = out.find(':', slashes + 3), end = out.find_first_of(" \n", slashes);
    a.scheme = out.substr(at, slashes - at);
    a.host = out.substr(slashes + 3, colon - slashes - 3);
    a.port = static_cast<std::uint16_t>(std::stoi(out.substr(colon + 1)));
    const std::size_t token = out.find("?token=", slashes);
    if (token < end) a.token = out.substr(token + 7, end - token - 7);
    return a;
}

// Follows what a page is told.
class Viewer {
  public:
    explicit Viewer(std::uint16_t port) : client_(port) { EXPECT_TRUE(client_.join(kProtocol)); }

    bool say(const std::string& text) { return client_.send_frame(1, text); }
    // The next text with this word; empty if the engine has gone or does not say it for twenty seconds.
    std::string text_with(const std::string& word) {
        return next([&](const net::test::RawClient::Frame& frame) {
            return frame.opcode == 1 && frame.payload.find(word) != std::string::npos;
        });
    }
    // Waits for a state of at least, or at most, this time (docs/live-protocol.md).
    bool state(bool at_least, double t_s) {
        return !next([&](const net::test::RawClient::Frame& frame) {
                    if (frame.opcode != 2 || frame.payload.front() != 3) return false;
                    double now_s = 0;
                    std::memcpy(&now_s, frame.payload.data() + 8, sizeof now_s);
                    return at_least ? now_s >= t_s : now_s <= t_s;
                }).empty();
    }
    // The next frame of a kind; empty if none comes.
    std::string frame_of(char kind) {
        return next([&](const net::test::RawClient::Frame& frame) {
            return frame.opcode == 2 && frame.payload.front() == kind;
        });
    }
    bool step_back() {
        return say(R"({"op":"seek","t_s":2})") && state(true, 2) && say(R"({"op":"seek","t_s":0})") &&
               state(false, 0);
    }

  private:
    template <class Wanted>
    std::string next(const Wanted& wanted) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (std::chrono::steady_clock::now() < end) {
            const auto frame = client_.frame();
            if (!frame) break;
            if (wanted(*frame)) return frame->payload;
        }
        return {};
    }

    net::test::RawClient client_;
};

}  // namespace tribo::test
