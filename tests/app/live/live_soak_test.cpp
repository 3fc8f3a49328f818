// SPDX-License-Identifier: MIT
// `tribo live` played again and again at its highest speed: memory stays flat. The short test takes seconds;
// the long one is for `make soak BUDGET=long` and brings clients that never read.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>

#include "app/run/live_engine.hpp"
#include "app/run/live_viewer.hpp"
#include "net/raw_client.hpp"
#include "places.hpp"

namespace tribo::test {
namespace {

using net::test::RawClient;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

// Plays the job through, twice at least, and gives the engine's memory every second.
struct Played {
    std::vector<double> resident_mb;
    int rounds = 0;
};
Played play(seconds time, int silent_clients) {
    LiveEngine engine;
    const std::uint16_t port = engine.port();
    std::vector<std::unique_ptr<RawClient>> silent;
    for (int n = 0; n < silent_clients; ++n) {
        silent.push_back(std::make_unique<RawClient>(port));
        EXPECT_TRUE(silent.back()->join(kProtocol));
    }
    RawClient player(port);
    EXPECT_TRUE(player.join(kProtocol));
    player.send_frame(1, R"({"op":"speed","value":1000})");
    player.send_frame(1, R"({"op":"play"})");
    Played played;
    const auto begin = Clock::now();
    auto look = begin + seconds(1);
    bool asked = true;
    // A slow machine plays for longer.
    while (Clock::now() - begin < time || played.rounds < 2) {
        const auto frame = player.frame();
        if (!frame) break;
        if (Clock::now() >= look) {
            played.resident_mb.push_back(engine.resident_mb());
            look += seconds(1);
        }
        if (frame->opcode != 2 || frame->payload.front() != 3) continue;
        // Flags come last (docs/live-protocol.md).
        const bool playing = (frame->payload[frame->payload.size() - 4] & 2) != 0;
        if (playing) {
            asked = false;
        } else if (!asked) {
            // At the end: play begins anew.
            player.send_frame(1, R"({"op":"play"})");
            asked = true;
            ++played.rounds;
        }
    }
    // Ctrl-C is ignored by what a script starts in the background.
    EXPECT_EQ(engine.stop(SIGTERM).code, 128 + SIGTERM);
    return played;
}

std::string listed(const std::vector<double>& values) {
    std::ostringstream text;
    for (const double v : values) text << v << ' ';
    return text.str();
}

TEST(LiveSoak, playing_again_and_again_leaves_memory_flat) {
    if (kAddressSanitizer || kThreadSanitizer)
        GTEST_SKIP() << "the sanitizers keep what is freed for a while, and books of it";
    const Played played = play(seconds(8), 0);
    ASSERT_GE(played.resident_mb.size(), 6u);
    EXPECT_GE(played.rounds, 2);
    EXPECT_LT(played.resident_mb.back(), played.resident_mb[2] + 12) << listed(played.resident_mb);
}

TEST(LiveSoak, DISABLED_playing_for_long_leaves_memory_flat) {
    const Played played = play(std::chrono::minutes(10), 4);
    ASSERT_GE(played.resident_mb.size(), 500u);
    // Once what waits for those who never read is full.
    const auto late = played.resident_mb.begin() + 200;
    const auto [least, most] = std::minmax_element(late, played.resident_mb.end());
    std::printf("%d rounds; resident %.1f to %.1f MB from 200 s on; each minute:", played.rounds, *least,
                *most);
    for (std::size_t n = 0; n < played.resident_mb.size(); n += 60)
        std::printf(" %.1f", played.resident_mb[n]);
    std::printf(" MB\n");
    EXPECT_LT(played.resident_mb.back(), *late + 12) << listed(played.resident_mb);
}

}  // namespace
}  // namespace tribo::test
