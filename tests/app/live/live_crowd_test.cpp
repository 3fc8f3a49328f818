// SPDX-License-Identifier: MIT
// `tribo live` with a crowd: viewers that only look keep their picture, whatever others do. The short test
// takes seconds; the long one also measures times and is for `make soak BUDGET=long`.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <thread>

#include "app/run/live_engine.hpp"
#include "app/run/live_viewer.hpp"
#include "net/raw_client.hpp"

namespace tribo::test {
namespace {

using net::test::RawClient;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using std::chrono::duration;

double seconds_since(Clock::time_point then) {
    return duration<double>(Clock::now() - then).count();
}

// A client on threads of its own.
class Member {
  public:
    explicit Member(std::uint16_t port) : client_(port) { joined_ = client_.join(kProtocol); }
    virtual ~Member() { leave(); }
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;
    // Whether the engine has kept it up to now.
    bool is_there() const { return joined_ && !gone_; }

  protected:
    template <class Work>
    void begin(Work work) {
        threads_.emplace_back(std::move(work));
    }
    void leave() {
        over_ = true;
        client_.hang_up();
        for (std::thread& t : threads_) t.join();
        threads_.clear();
    }
    RawClient client_;
    std::atomic<bool> over_ = false, gone_ = false;

  private:
    bool joined_ = false;
    std::vector<std::thread> threads_;
};

// Only looks, and measures the gaps between states while the program plays.
class Honest : public Member {
  public:
    explicit Honest(std::uint16_t port) : Member(port) {
        begin([this] { look(); });
    }
    ~Honest() override { leave(); }
    std::vector<double> gaps_s() {
        leave();
        return gaps_s_;
    }
    // Of the servo's lateness, as it was told last: 99.9 % (docs/live-protocol.md).
    double servo_p999_us() const { return servo_p999_us_; }
    double waited_s() const { return waited_s_; }

  private:
    void look() {
        const auto came = Clock::now();
        Clock::time_point before;
        bool was_playing = false;
        while (const auto frame = client_.frame()) {
            if (frame->opcode != 2) continue;
            const char kind = frame->payload.front();
            if (kind == 8) {
                float us = 0;
                std::memcpy(&us, frame->payload.data() + 48, sizeof us);
                servo_p999_us_ = static_cast<double>(us);
            }
            if (kind != 3) continue;
            if (waited_s_ == 0) waited_s_ = seconds_since(came);
            const bool playing = (frame->payload[frame->payload.size() - 4] & 2) != 0;
            if (was_playing) gaps_s_.push_back(seconds_since(before));
            was_playing = playing;
            before = Clock::now();
            if (!playing) client_.send_frame(1, R"({"op":"play"})");
        }
        gone_ = !over_;
    }
    std::vector<double> gaps_s_;
    std::atomic<double> servo_p999_us_ = 0, waited_s_ = 0;
};

// Sends what a page may send, a little slower than the limit.
class Flooding : public Member {
  public:
    explicit Flooding(std::uint16_t port) : Member(port) {
        begin([this] {
            while (client_.frame()) {
            }
            gone_ = !over_;
        });
        begin([this] { flood(); });
    }
    ~Flooding() override { leave(); }

  private:
    static constexpr int kPerSecond = 480;
    static std::string message(int n) {
        const auto set = [](const char* key, int value) {
            return R"({"op":"set","key":")" + std::string(key) + R"(","value":)" + std::to_string(value) +
                   "}";
        };
        switch (n % 6) {
            case 0:
                return set("feed_percent", 50 + n % 151);
            case 1:
                return set("spindle_percent", 50 + n % 151);
            case 2:
                return n % 12 == 2 ? R"({"op":"material","value":"ti6al4v"})"
                                   : R"({"op":"material","value":"al7075-t6"})";
            case 3:
                return set("helix_deg", n % 61);
            case 4:
                return R"({"op":"finger","position_mm":[20,)" + std::to_string(n % 30) +
                       R"(,-1],"down":true})";
            default:
                return n % kPerSecond == 5 ? R"({"op":"seek","t_s":0})" : R"({"op":"resync"})";
        }
    }
    void flood() {
        const auto begun = Clock::now();
        for (int n = 0; !over_ && client_.send_frame(1, message(n)); ++n)
            std::this_thread::sleep_until(begun + n * duration<double>(1.0 / kPerSecond));
    }
};

struct Crowd {
    std::vector<double> gaps_s, resident_mb;
    double servo_p999_us = 0, end_s = 0, newcomer_s = 0;
    int honest_gone = 0, flooding_gone = 0;
    std::size_t fewest_states = 0;  // of one honest viewer
};

// `each` of every kind: connections without a request, clients that never read, flooding and honest ones.
Crowd watch(std::chrono::seconds time, int each, int honest_ones) {
    LiveEngine engine;
    Crowd crowd;
    {
        std::vector<std::unique_ptr<Honest>> honest;
        std::vector<std::unique_ptr<Flooding>> flooding;
        for (int n = 0; n < honest_ones; ++n) honest.push_back(std::make_unique<Honest>(engine.port()));
        for (int n = 0; n < each; ++n) flooding.push_back(std::make_unique<Flooding>(engine.port()));
        std::vector<std::unique_ptr<RawClient>> silent;
        const auto begun = Clock::now();
        for (int second = 0; Clock::now() - begun < time; ++second) {
            // The engine hangs up on them after half a minute. They come again.
            if (second % 25 == 0) {
                silent.clear();
                for (int n = 0; n < 2 * each; ++n) {
                    silent.push_back(std::make_unique<RawClient>(engine.port()));
                    EXPECT_TRUE(n % 2 == 0 || silent.back()->join(kProtocol));
                }
            }
            std::this_thread::sleep_until(begun + (second + 1) * 1s);
            crowd.resident_mb.push_back(engine.resident_mb());
        }
        {
            const Honest newcomer(engine.port());
            for (int n = 0; n < 6000 && newcomer.waited_s() == 0; ++n) std::this_thread::sleep_for(10ms);
            crowd.newcomer_s = newcomer.waited_s();
        }
        crowd.servo_p999_us = honest.front()->servo_p999_us();
        for (const auto& one : honest) crowd.honest_gone += !one->is_there();
        for (const auto& one : flooding) crowd.flooding_gone += !one->is_there();
        for (const auto& one : honest) {
            const std::vector<double> gaps_s = one->gaps_s();
            crowd.fewest_states =
                std::min(one == honest.front() ? gaps_s.size() : crowd.fewest_states, gaps_s.size());
            crowd.gaps_s.insert(crowd.gaps_s.end(), gaps_s.begin(), gaps_s.end());
        }
        // While the others still flood.
        const auto end = Clock::now();
        EXPECT_EQ(engine.stop(SIGTERM).code, 128 + SIGTERM);
        crowd.end_s = seconds_since(end);
    }
    std::sort(crowd.gaps_s.begin(), crowd.gaps_s.end());
    return crowd;
}

double quantile(const std::vector<double>& sorted, double share) {
    if (sorted.empty()) return std::nan("");
    return sorted[std::min(sorted.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

void print(const char* who, const Crowd& crowd) {
    const auto [least, most] = std::minmax_element(crowd.resident_mb.begin(), crowd.resident_mb.end());
    std::printf(
        "%s: frame gap p50 %.1f, p99 %.1f, most %.1f ms of %zu; servo p99.9 %.0f us; resident %.1f to "
        "%.1f MB; newcomer %.3f s; SIGTERM %.3f s\n",
        who, 1e3 * quantile(crowd.gaps_s, 0.5), 1e3 * quantile(crowd.gaps_s, 0.99),
        1e3 * quantile(crowd.gaps_s, 1), crowd.gaps_s.size(), crowd.servo_p999_us, *least, *most,
        crowd.newcomer_s, crowd.end_s);
}

// Without times: other tests run beside this one, some of them under a sanitizer. The long one has the times.
TEST(LiveCrowd, leaves_those_who_only_look_their_picture) {
    const Crowd crowd = watch(6s, 2, 2);
    print("a crowd", crowd);
    EXPECT_EQ(crowd.honest_gone, 0);
    EXPECT_GT(crowd.fewest_states, 10u);
    EXPECT_GT(crowd.newcomer_s, 0);
}

TEST(LiveCrowd, DISABLED_leaves_those_who_only_look_their_picture_for_long) {
    const Crowd alone = watch(60s, 0, 1), crowd = watch(600s, 5, 5);
    print("one viewer", alone);
    print("a crowd", crowd);
    EXPECT_EQ(crowd.honest_gone, 0);
    EXPECT_EQ(crowd.flooding_gone, 0);
    EXPECT_LE(quantile(crowd.gaps_s, 0.99), 0.1);
    EXPECT_LE(crowd.end_s, 1);
    EXPECT_LE(crowd.servo_p999_us, 2 * alone.servo_p999_us);
    // After the first two minutes.
    const auto [least, most] = std::minmax_element(crowd.resident_mb.begin() + 120, crowd.resident_mb.end());
    EXPECT_LE(*most, 1.1 * *least);
}

}  // namespace
}  // namespace tribo::test
