// SPDX-License-Identifier: MIT
// `tribo live` without a job: the page mills the files dropped into it; the engine only serves the page.
#include <chrono>
#include <mutex>
#include <thread>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/live/live_server.hpp"
#include "protocol/live_message.hpp"

namespace tribo::app {
namespace {

constexpr auto kLookTime = std::chrono::milliseconds(20);

}  // namespace

int live_without_job(const LiveCall& call) {
    const auto files = live_page(call);
    if (!files) return report(files.error());
    // Answers from the thread of the server: clients may connect before this thread has the server object.
    std::mutex mutex;
    struct Answer {
        net::ClientId client;
        std::string text;
        bool refusal;
    };
    std::vector<Answer> answers;
    const auto say = [&](Answer answer) {
        const std::lock_guard lock(mutex);
        answers.push_back(std::move(answer));
    };
    net::ServerHandlers handlers;
    handlers.on_get = [&](std::string_view path, net::AcceptedEncodings accepted) {
        return files->page(path, accepted);
    };
    handlers.on_connect = [&](net::ClientId client, const net::ResumeInfo& resume) {
        protocol::LiveServerInfo info;
        info.version = TRIBO_VERSION;
        info.resume = resume.token;
        info.resumed = resume.resumed;
        say({client, protocol::live_server_info(info), false});
    };
    handlers.on_message = [&](net::ClientId client, std::string_view) {
        say({client,
             protocol::live_refusal({"", 0, 0, "no job is open in the engine",
                                     "drop a file into the page, or start 'tribo live JOB'"}),
             true});
    };
    int exit_code = kDone;
    const auto server = open_live_server(call, "An empty bench", std::move(handlers), exit_code);
    if (!server) return exit_code;
    while (!interrupted()) {
        std::this_thread::sleep_for(kLookTime);
        const std::lock_guard lock(mutex);
        for (Answer& one : answers) {
            one.refusal ? server->refuse(one.client, std::move(one.text))
                        : server->send_text(one.client, std::move(one.text));
        }
        answers.clear();
    }
    return interrupted_exit_code();
}

}  // namespace tribo::app
