// SPDX-License-Identifier: MIT
#include "app/live.hpp"

#include <chrono>
#include <cstdio>
#include <deque>
#include <mutex>
#include <spawn.h>
#include <thread>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/render_job.hpp"
#include "app/threads.hpp"
#include "app/web_files.hpp"
#include "io/live_message.hpp"
#include "net/server.hpp"
#include "session/live_memory.hpp"
#include "session/live_mill.hpp"

extern char** environ;

namespace tribo::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSubprotocol = "tribo.live.1";
constexpr auto kFrameTime = std::chrono::microseconds(16'667);
// Of a frame's time, how much may go into milling: the rest is for the picture.
constexpr auto kMillingTime = std::chrono::microseconds(9'000);
// A clock that did not run for longer than this (a laptop asleep) jumps no further.
constexpr double kLongestStepS = 0.1;

// What the server's thread has for the mill's, which alone answers.
struct Event {
    enum class Kind { came, lost, message } kind;
    net::ClientId client;
    std::string text = {};
};

class Inbox {
  public:
    void put(const Event& event) {
        const std::lock_guard lock(mutex_);
        events_.push_back(event);
    }
    std::deque<Event> take_all() {
        const std::lock_guard lock(mutex_);
        return std::exchange(events_, {});
    }

  private:
    std::mutex mutex_;
    std::deque<Event> events_;
};

net::Bytes shared(std::span<const std::uint8_t> frame) {
    return std::make_shared<const std::vector<std::uint8_t>>(frame.begin(), frame.end());
}

void open_browser(const std::string& url) {
    std::string program = "xdg-open", argument = url;
    char* const arguments[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    if (::posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) != 0)
        std::fprintf(stderr, "no browser could be opened; open the address by hand\n");
}

class Show {
  public:
    Show(session::LiveMill& mill, std::string job, Warnings warnings)
        : mill_(mill), job_(std::move(job)), warnings_(std::move(warnings)) {}

    net::ServerHandlers handlers(const WebFiles& files) {
        net::ServerHandlers h;
        h.page = [&files](std::string_view path, bool gzip) { return files.page(path, gzip); };
        h.came = [this](net::ClientId id) { inbox_.put({Event::Kind::came, id}); };
        h.lost = [this](net::ClientId id) { inbox_.put({Event::Kind::lost, id}); };
        h.message = [this](net::ClientId id, std::string_view text) {
            inbox_.put({Event::Kind::message, id, std::string(text)});
        };
        return h;
    }

    // Until the user ends it.
    Result<void> run(net::Server& server) {
        auto before = Clock::now(), next = before;
        while (!interrupted()) {
            for (const Event& event : inbox_.take_all()) answer(event, server);
            const auto now = Clock::now();
            const double dt = std::min(std::chrono::duration<double>(now - before).count(), kLongestStepS);
            before = now;
            const auto may_go_on = [&] { return Clock::now() - now < kMillingTime && !interrupted(); };
            const auto frames = [&](std::span<const std::uint8_t> frame) {
                memory_.take(frame);
                server.send_all(shared(frame));
            };
            if (auto done = mill_.tick(dt, may_go_on, frames); !done) return done;
            next = std::max(next + kFrameTime, Clock::now());
            std::this_thread::sleep_until(next);
        }
        return {};
    }

  private:
    void answer(const Event& event, net::Server& server) {
        switch (event.kind) {
            case Event::Kind::came:
                server.send_text(event.client, io::live_server_info(TRIBO_VERSION, job_, warnings_));
                replay(event.client, server);
                break;
            case Event::Kind::lost:
                server.send_text(event.client, io::live_lost());
                break;
            case Event::Kind::message:
                if (const auto command = io::parse_live_command(event.text)) {
                    obey(*command, event.client, server);
                } else {
                    server.send_text(event.client, io::live_refusal(command.error()));
                }
                break;
        }
    }
    void replay(net::ClientId to, net::Server& server) {
        memory_.replay([&](std::span<const std::uint8_t> frame) { server.send(to, shared(frame)); });
    }
    void obey(const io::LiveCommand& command, net::ClientId from, net::Server& server) {
        switch (command.op) {
            case io::LiveOp::play:
                return mill_.play(true);
            case io::LiveOp::pause:
                return mill_.play(false);
            case io::LiveOp::speed:
                return mill_.set_speed(command.value);
            case io::LiveOp::seek:
                return mill_.set_clock(command.value);
            case io::LiveOp::resync:
                return replay(from, server);
        }
    }

    session::LiveMill& mill_;
    std::string job_;
    Warnings warnings_;
    session::LiveMemory memory_;
    Inbox inbox_;
};

}  // namespace

int live(const LiveCall& call) {
    RenderCall render;
    render.job = call.job;
    render.resolution_mm = call.resolution_mm;
    render.only = {"mesh"};
    auto first = load_job(render, session::LiveMill::kPieceMm);
    if (!first) return report(first.error());
    if (auto fits = check_memory(render, *first); !fits) return report(fits.error());
    report(first->warnings);

    const std::string root = call.web_root.empty() ? WebFiles::folder_of("viewer") : call.web_root;
    if (root.empty()) {
        return report(io::Failure({"", 0, 0, "this build has no page to show",
                                   "build it with Node.js there, or name a folder with --web-root"}));
    }
    const auto files = WebFiles::read(root);
    if (!files) return report(files.error());

    // Set back, the program begins again as its files are by then.
    Warnings warnings = first->warnings;
    std::optional<session::MillSetup> ready = std::move(first->setup);
    const auto make_setup = [&]() -> Result<session::MillSetup> {
        if (ready) return *std::exchange(ready, std::nullopt);
        auto again = load_job(render, session::LiveMill::kPieceMm);
        if (!again) return std::unexpected(Error(again.error()));
        return std::move(again->setup);
    };
    auto mill = session::LiveMill::create(
        make_setup, parallel_for_over(call.threads > 0 ? call.threads : available_threads()));
    if (!mill) return report(mill.error());

    Show show(**mill, call.job, std::move(warnings));
    net::ServerOptions options;
    options.port = call.port;
    options.subprotocol = kSubprotocol;
    auto server = net::Server::start(options, show.handlers(*files));
    if (!server) {
        report(server.error());
        return kRefused;
    }
    const std::string url = "http://127.0.0.1:" + std::to_string((*server)->port()) + "/";
    std::printf("%s is live at %s (Ctrl-C ends it)\n", call.job.c_str(), url.c_str());
    std::fflush(stdout);
    if (call.open) open_browser(url);
    const auto done = show.run(**server);
    server->reset();
    if (!done) return report(done.error());
    return interrupted_exit_code();
}

}  // namespace tribo::app
