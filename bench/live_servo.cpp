// SPDX-License-Identifier: MIT
// The servo inside `tribo live`: how late it is with no page, with one, and with sixteen of which four never
// read, while the bowl is milled at ten times its speed and a led hand presses on it.
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <memory>
#include <optional>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "harness.hpp"
#include "net/raw_client.hpp"

extern char** environ;

namespace tribo::bench {
namespace {

using net::test::RawClient;

constexpr const char* kProtocol = "tribo.live.1";
constexpr int kSeconds = 10;
constexpr std::size_t kHeaderBytes = 16;
constexpr unsigned char kServoFrame = 8;

// `tribo live` of the bowl on a port that is free.
class LiveProgram {
  public:
    LiveProgram() {
        int way[2];
        if (::pipe(way) != 0) return;
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, way[1], 1);
        posix_spawn_file_actions_addclose(&actions, way[0]);
        std::string program = TRIBO_PROGRAM, verb = "live", flag = "--port", port = "0",
                    job = TRIBO_SOURCE_DIR "/examples/bowl/bowl.toml", root = "--web-root",
                    page = TRIBO_SOURCE_DIR "/web/mill";
        char* const arguments[] = {program.data(), verb.data(), job.data(),  flag.data(),
                                   port.data(),    root.data(), page.data(), nullptr};
        if (::posix_spawn(&child_, program.c_str(), &actions, nullptr, arguments, environ) != 0) child_ = 0;
        posix_spawn_file_actions_destroy(&actions);
        ::close(way[1]);
        std::string said;
        char c = 0;
        while (child_ > 0 && ::read(way[0], &c, 1) == 1 && c != '\n') said += c;
        const std::size_t at = said.find("127.0.0.1:");
        if (at != std::string::npos)
            port_ = static_cast<std::uint16_t>(std::strtoul(said.c_str() + at + 10, nullptr, 10));
        out_ = way[0];
    }
    ~LiveProgram() {
        if (child_ > 0) {
            ::kill(child_, SIGTERM);
            ::waitpid(child_, nullptr, 0);
        }
        ::close(out_);
    }
    std::uint16_t port() const { return port_; }

  private:
    pid_t child_ = 0;
    int out_ = -1;
    std::uint16_t port_ = 0;
};

struct Figures {
    std::uint32_t ticks = 0, late = 0;
    std::array<float, 4> lateness_us{}, cpu_us{};
};

// What the servo says of itself after kSeconds with so many pages beside the one that plays and presses.
std::optional<Figures> servo_with(int reading, int silent) {
    const LiveProgram program;
    RawClient player(program.port());
    if (!player.join(kProtocol)) return std::nullopt;
    std::vector<std::unique_ptr<RawClient>> pages;
    std::vector<std::thread> readers;
    for (int n = 0; n < reading + silent; ++n) {
        pages.push_back(std::make_unique<RawClient>(program.port()));
        if (!pages.back()->join(kProtocol)) return std::nullopt;
        if (n < reading) {
            readers.emplace_back([page = pages.back().get()] {
                while (page->frame()) continue;
            });
        }
    }
    constexpr int text = 1;
    player.send_frame(text, R"({"op":"speed","value":10})");
    player.send_frame(text, R"({"op":"play"})");
    player.send_frame(text, R"({"op":"finger","position_mm":[45,45,-1],"down":true})");
    std::optional<Figures> last;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(kSeconds);
    while (std::chrono::steady_clock::now() < end) {
        const auto frame = player.frame();
        if (!frame) break;
        const std::string& payload = frame->payload;
        if (payload.size() < kHeaderBytes + 56 || static_cast<unsigned char>(payload[0]) != kServoFrame)
            continue;
        Figures now;
        const char* at = payload.data() + kHeaderBytes;
        std::memcpy(&now.ticks, at, 4);
        std::memcpy(&now.late, at + 4, 4);
        std::memcpy(now.lateness_us.data(), at + 24, 16);
        std::memcpy(now.cpu_us.data(), at + 40, 16);
        last = now;
    }
    for (const auto& page : pages) page->hang_up();
    for (std::thread& reader : readers) reader.join();
    return last;
}

}  // namespace

void measure_live_servo(Report& report) {
    report.section("The servo in `tribo live` at 1 kHz while the bowl is milled, over ten seconds");
    const struct {
        const char* name;
        int reading, silent;
    } cases[] = {{"one page", 0, 0}, {"sixteen pages, four never read", 11, 4}};
    std::optional<Figures> alone;
    for (const auto& c : cases) {
        const auto f = servo_with(c.reading, c.silent);
        if (!f) {
            report.note("`tribo live` did not start");
            return;
        }
        if (!alone) alone = f;
        const char* const names[] = {"p50", "p99", "p99.9", "max"};
        for (std::size_t n = 0; n < 4; ++n) {
            report.add({std::string("lateness ") + names[n] + ", " + c.name,
                        static_cast<double>(f->lateness_us[n]), "us", std::nullopt, Better::lower, "one page",
                        static_cast<double>(alone->lateness_us[n])});
        }
        report.add(
            {std::string("tick, processor time, p99.9, ") + c.name, static_cast<double>(f->cpu_us[2]), "us"});
        report.add({std::string("ticks late, ") + c.name, 100.0 * f->late / std::max(1U, f->ticks), "%"});
    }
}

}  // namespace tribo::bench
