// SPDX-License-Identifier: MIT
// `tribo live` without a job: the page mills the files dropped into it; the engine only serves the page.
#include <chrono>
#include <thread>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/live/live_server.hpp"
#include "net/inbox.hpp"
#include "protocol/live_message.hpp"

namespace tribo::app {
namespace {

constexpr auto kLookTime = std::chrono::milliseconds(20);

void answer(const net::Inbox::Event& event, net::Server& server) {
    using Kind = net::Inbox::Event::Kind;
    if (event.kind == Kind::connected) {
        protocol::LiveServerInfo info;
        info.version = TRIBO_VERSION;
        info.resume = event.resume.token;
        info.resumed = event.resume.resumed;
        server.send_text(event.client, protocol::live_server_info(info));
    } else if (event.kind == Kind::message) {
        server.refuse(event.client,
                      protocol::live_refusal({"", 0, 0, "no job is open in the engine",
                                              "drop a file into the page, or start 'tribo live JOB'"}));
    }
}

}  // namespace

int live_without_job(const LiveCall& call) {
    const auto files = live_page(call);
    if (!files) return report(files.error());
    net::Inbox inbox;
    net::ServerHandlers handlers;
    inbox.attach(handlers);
    handlers.on_get = [&](std::string_view path, net::AcceptedEncodings accepted) {
        return files->page(path, accepted);
    };
    handlers.last_words = live_last_words;
    int exit_code = kDone;
    const auto server = open_live_server(call, "An empty bench", std::move(handlers), exit_code);
    if (!server) return exit_code;
    while (!interrupted()) {
        std::this_thread::sleep_for(kLookTime);
        for (const net::Inbox::Event& event : inbox.take_all()) answer(event, *server);
    }
    return interrupted_exit_code();
}

}  // namespace tribo::app
