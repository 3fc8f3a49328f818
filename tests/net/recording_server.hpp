// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>

#include "net/raw_client.hpp"
#include "net/server.hpp"

namespace tribo::net::test {

inline constexpr const char* kProtocol = "test.1";

// A server that keeps what it was told, for the test's thread to wait for.
class RecordingServer {
  public:
    explicit RecordingServer(ServerOptions options = {}) {
        options.subprotocol = kProtocol;
        ServerHandlers handlers;
        handlers.on_get = [](std::string_view path, AcceptedEncodings accepted) -> std::optional<Page> {
            if (path == "/") return Page{"text/html", "<p>hello", ""};
            if (path == "/a.js" && accepted.brotli) return Page{"text/javascript", "packed", "br"};
            if (path == "/a.js" && accepted.gzip) return Page{"text/javascript", "zipped", "gzip"};
            return std::nullopt;
        };
        handlers.on_connect = [this](ClientId id, const ResumeInfo& resume) {
            {
                const std::lock_guard lock(mutex_);
                resume_infos_[id] = resume;
            }
            note("connected", id);
        };
        handlers.on_disconnect = [this](ClientId id) { note("disconnected", id); };
        handlers.on_overflow = [this](ClientId id) { note("overflowed", id); };
        handlers.on_message = [this](ClientId id, std::string_view text) {
            note(std::string(text), id);
            return text == "many" ? Taken::too_many : text == "much" ? Taken::too_much : Taken::yes;
        };
        handlers.last_words = [](std::string_view why) { return "bye: " + std::string(why); };
        auto started = Server::start(options, std::move(handlers));
        if (!started) throw std::runtime_error(started.error().text());
        server = std::move(*started);
    }
    ~RecordingServer() { server.reset(); }

    // The client of the next event of that name, or 0 after twenty seconds.
    ClientId wait(const std::string& what) {
        std::unique_lock lock(mutex_);
        ClientId id = 0;
        changed_.wait_for(lock, std::chrono::seconds(20), [&] {
            for (auto it = events_.begin(); it != events_.end(); ++it) {
                if (it->first != what) continue;
                id = it->second;
                events_.erase(it);
                return true;
            }
            return false;
        });
        return id;
    }

    ResumeInfo resume_info(ClientId id) {
        const std::lock_guard lock(mutex_);
        return resume_infos_[id];
    }

    std::unique_ptr<Server> server;

  private:
    void note(std::string what, ClientId id) {
        const std::lock_guard lock(mutex_);
        events_.emplace_back(std::move(what), id);
        changed_.notify_all();
    }
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::pair<std::string, ClientId>> events_;
    std::map<ClientId, ResumeInfo> resume_infos_;
};

}  // namespace tribo::net::test
