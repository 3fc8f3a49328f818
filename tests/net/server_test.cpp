// SPDX-License-Identifier: MIT
// The server against clients of every kind: polite, foreign, rude, slow.
#include "net/server.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <gtest/gtest.h>
#include <mutex>

#include "net/raw_client.hpp"

namespace tribo::net {
namespace {

using test::RawClient;
using namespace std::chrono_literals;

constexpr const char* kProtocol = "test.1";

// A server that keeps what it was told, for the test's thread to wait for.
class Told {
  public:
    explicit Told(ServerOptions options = {}) {
        options.subprotocol = kProtocol;
        ServerHandlers handlers;
        handlers.page = [](std::string_view path, bool gzip) -> std::optional<Page> {
            if (path == "/") return Page{"text/html", "<p>hello", ""};
            if (path == "/a.js" && gzip) return Page{"text/javascript", "zipped", "gzip"};
            return std::nullopt;
        };
        handlers.came = [this](ClientId id) { note("came", id); };
        handlers.went = [this](ClientId id) { note("went", id); };
        handlers.lost = [this](ClientId id) { note("lost", id); };
        handlers.message = [this](ClientId id, std::string_view text) { note(std::string(text), id); };
        auto started = Server::start(options, std::move(handlers));
        if (!started) throw std::runtime_error(started.error().text());
        server = std::move(*started);
    }
    ~Told() { server.reset(); }

    // The client of the next event of that name, or 0 after twenty seconds.
    ClientId wait(const std::string& what) {
        std::unique_lock lock(mutex_);
        ClientId id = 0;
        changed_.wait_for(lock, 20s, [&] {
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
};

TEST(Server, gives_pages_and_keeps_the_connection) {
    Told told;
    RawClient client(told.server->port());
    ASSERT_TRUE(client.connected());
    const std::string page = client.get("/?a=b");
    EXPECT_TRUE(page.starts_with("HTTP/1.1 200")) << page;
    EXPECT_TRUE(page.ends_with("<p>hello")) << page;
    EXPECT_NE(page.find("Content-Security-Policy: default-src 'self'"), std::string::npos);
    const std::string script = client.get("/a.js", "Accept-Encoding: gzip, deflate\r\n");
    EXPECT_NE(script.find("Content-Encoding: gzip"), std::string::npos) << script;
    EXPECT_TRUE(client.get("/../../etc/passwd").starts_with("HTTP/1.1 404"));
}

TEST(Server, refuses_other_methods_and_foreign_names) {
    Told told;
    {
        RawClient client(told.server->port());
        client.send("POST / HTTP/1.1\r\nHost: " + client.host() + "\r\nContent-Length: 0\r\n\r\n");
        EXPECT_TRUE(client.header().starts_with("HTTP/1.1 405"));
    }
    RawClient client(told.server->port());
    client.send("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
    EXPECT_TRUE(client.header().starts_with("HTTP/1.1 403"));
}

TEST(Server, lets_in_only_its_own_page_with_the_protocol_and_the_token) {
    ServerOptions options;
    options.token = "secret";
    Told told(options);
    const auto answer = [&](const char* target, const char* protocol, const char* origin, const char* host) {
        RawClient client(told.server->port());
        const auto or_own = [&](const char* given, const std::string& own) { return given ? given : own; };
        return client.upgrade(target, protocol, or_own(origin, "http://" + client.host()),
                              or_own(host, client.host()));
    };
    EXPECT_TRUE(answer("/live?token=secret", kProtocol, nullptr, nullptr).starts_with("HTTP/1.1 101"));
    const struct {
        const char *target, *protocol, *origin, *host;
    } wrong[] = {
        {"/live", kProtocol, nullptr, nullptr},
        {"/live?token=", kProtocol, nullptr, nullptr},
        {"/live?token=secre", kProtocol, nullptr, nullptr},
        {"/live?token=Secret", kProtocol, nullptr, nullptr},
        {"/live?xtoken=secret", kProtocol, nullptr, nullptr},
        {"/live?token=secret", "other.1", nullptr, nullptr},
        {"/live?token=secret", kProtocol, "http://evil.example", nullptr},
        {"/live?token=secret", kProtocol, "null", nullptr},
        {"/live?token=secret", kProtocol, "http://127.0.0.1:1", nullptr},
        {"/live?token=secret", kProtocol, "http://evil.example", "evil.example"},
    };
    for (const auto& w : wrong) {
        EXPECT_TRUE(answer(w.target, w.protocol, w.origin, w.host).starts_with("HTTP/1.1 403"))
            << w.target << ' ' << w.protocol;
    }
}

TEST(Server, carries_messages_both_ways) {
    Told told;
    RawClient client(told.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    const ClientId id = told.wait("came");
    ASSERT_NE(id, 0u);
    EXPECT_EQ(told.server->clients(), 1u);
    ASSERT_TRUE(client.send_frame(1, "play"));
    EXPECT_EQ(told.wait("play"), id);
    told.server->send_text(id, "hello");
    told.server->send_all(std::make_shared<std::vector<std::uint8_t>>(100'000, std::uint8_t{7}));
    auto frame = client.frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->opcode, 1);
    EXPECT_EQ(frame->payload, "hello");
    frame = client.frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->opcode, 2);
    EXPECT_TRUE(frame->payload == std::string(100'000, '\7'));
}

TEST(Server, tells_when_a_client_goes) {
    Told told;
    ClientId id = 0;
    {
        RawClient client(told.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        id = told.wait("came");
    }
    EXPECT_EQ(told.wait("went"), id);
    EXPECT_EQ(told.server->clients(), 0u);
    told.server->send_text(id, "to nobody");
}

TEST(Server, cuts_off_who_floods_or_sends_too_much_or_nonsense) {
    ServerOptions options;
    options.message_bytes = 1000;
    options.messages_per_s = 20;
    Told told(options);
    {
        RawClient client(told.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        for (int n = 0; n < 200; ++n) client.send_frame(1, "x");
        EXPECT_NE(told.wait("went"), 0u);
    }
    {
        RawClient client(told.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        client.send_frame(1, std::string(2000, 'x'));
        EXPECT_NE(told.wait("went"), 0u);
        const auto frame = client.frame();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->opcode, 8);
    }
    {
        RawClient client(told.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        client.send("\xff\xff\xff\xff no frame at all");
        EXPECT_NE(told.wait("went"), 0u);
    }
    {
        RawClient client(told.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        client.send_frame(2, "binary");
        EXPECT_NE(told.wait("went"), 0u);
    }
    RawClient client(told.server->port());
    EXPECT_TRUE(client.join(kProtocol));
}

TEST(Server, never_waits_for_a_client_that_does_not_read) {
    ServerOptions options;
    options.queue_bytes = 1'000'000;
    Told told(options);
    RawClient slow(told.server->port()), quick(told.server->port());
    ASSERT_TRUE(slow.join(kProtocol));
    ASSERT_NE(told.wait("came"), 0u);
    ASSERT_TRUE(quick.join(kProtocol));
    const ClientId quick_id = told.wait("came");
    // 400 MB: more than any socket holds; were it kept, memory would show it.
    const auto data = std::make_shared<std::vector<std::uint8_t>>(1'000'000);
    for (int n = 0; n < 400; ++n) told.server->send_all(data);
    told.server->send_text(quick_id, "last");
    for (;;) {
        const auto frame = quick.frame();
        ASSERT_TRUE(frame);
        if (frame->opcode == 1) break;
    }
    // It begins to read, and is told that it missed something.
    while (slow.frame()) {
        if (told.wait("lost") != 0) break;
    }
    SUCCEED();
}

TEST(Server, refuses_a_port_that_is_taken_and_an_address_that_is_none) {
    Told told;
    ServerOptions options;
    options.port = told.server->port();
    const auto second = Server::start(options, {});
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().text().find(std::to_string(options.port)), std::string::npos);
    options.address = "somewhere";
    EXPECT_FALSE(Server::start(options, {}));
}

TEST(Server, survives_requests_that_never_end) {
    Told told;
    RawClient client(told.server->port());
    client.send("GET / HTTP/1.1\r\nHost: " + client.host() + "\r\nX: " + std::string(100'000, 'x'));
    EXPECT_EQ(client.bytes(1), "");
    RawClient other(told.server->port());
    EXPECT_TRUE(other.get("/").starts_with("HTTP/1.1 200"));
}

}  // namespace
}  // namespace tribo::net
