// SPDX-License-Identifier: MIT
// The server against clients of every kind: polite, foreign, rude, slow.
#include "net/server.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <gtest/gtest.h>
#include <map>
#include <mutex>

#include "net/raw_client.hpp"

namespace tribo::net {
namespace {

using test::RawClient;
using namespace std::chrono_literals;

constexpr const char* kProtocol = "test.1";

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
        handlers.on_message = [this](ClientId id, std::string_view text) { note(std::string(text), id); };
        auto started = Server::start(options, std::move(handlers));
        if (!started) throw std::runtime_error(started.error().text());
        server = std::move(*started);
    }
    ~RecordingServer() { server.reset(); }

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

TEST(Server, gives_pages_and_keeps_the_connection) {
    RecordingServer recorded;
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.connected());
    const std::string page = client.get("/?a=b");
    EXPECT_TRUE(page.starts_with("HTTP/1.1 200")) << page;
    EXPECT_TRUE(page.ends_with("<p>hello")) << page;
    EXPECT_NE(page.find("Content-Security-Policy: default-src 'self'"), std::string::npos);
    const std::string script = client.get("/a.js", "Accept-Encoding: gzip, deflate\r\n");
    EXPECT_NE(script.find("Content-Encoding: gzip"), std::string::npos) << script;
    EXPECT_NE(script.find("Vary: Accept-Encoding"), std::string::npos) << script;
    EXPECT_TRUE(client.get("/a.js", "Accept-Encoding: gzip, deflate, br;q=0.9\r\n").ends_with("packed"));
    EXPECT_TRUE(client.get("/a.js", "Accept-Encoding: brown\r\n").starts_with("HTTP/1.1 404"));
    for (const char* path :
         {"/../../etc/passwd", "/..%2f..%2fetc%2fpasswd", "//etc/passwd", "/./", "http://x/", "/\\..\\etc"}) {
        RawClient other(recorded.server->port());
        EXPECT_FALSE(other.get(path).starts_with("HTTP/1.1 200")) << path;
    }
}

TEST(Server, refuses_other_methods_and_foreign_names) {
    RecordingServer recorded;
    {
        RawClient client(recorded.server->port());
        client.send("POST / HTTP/1.1\r\nHost: " + client.host() + "\r\nContent-Length: 0\r\n\r\n");
        EXPECT_TRUE(client.header().starts_with("HTTP/1.1 405"));
    }
    RawClient client(recorded.server->port());
    client.send("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
    EXPECT_TRUE(client.header().starts_with("HTTP/1.1 403"));
}

TEST(Server, lets_in_only_its_own_page_with_the_protocol_and_the_token) {
    ServerOptions options;
    options.token = "secret";
    RecordingServer recorded(options);
    const auto answer = [&](const char* target, const char* protocol, const char* origin, const char* host) {
        RawClient client(recorded.server->port());
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

TEST(Server, lets_a_client_come_back_once_with_its_resume_token) {
    ServerOptions options;
    options.token = "secret";
    RecordingServer recorded(options);
    const auto handshake = [&](RawClient& client, const std::string& target, const std::string& name) {
        const std::string host = name + ":" + std::to_string(recorded.server->port());
        return client.upgrade(target, kProtocol, "http://" + host, host);
    };
    std::string resume;
    ClientId first = 0;
    RawClient before(recorded.server->port());
    ASSERT_TRUE(handshake(before, "/live?token=secret", "127.0.0.1").starts_with("HTTP/1.1 101"));
    first = recorded.wait("connected");
    EXPECT_FALSE(recorded.resume_info(first).resumed);
    resume = recorded.resume_info(first).token;
    EXPECT_EQ(resume.size(), 32u);
    // In the place of the token; who came before is told to go.
    RawClient after(recorded.server->port());
    ASSERT_TRUE(handshake(after, "/live?resume=" + resume, "127.0.0.1").starts_with("HTTP/1.1 101"));
    EXPECT_EQ(recorded.wait("disconnected"), first);
    EXPECT_EQ(before.closing().code, 4000);
    const ClientId second = recorded.wait("connected");
    EXPECT_TRUE(recorded.resume_info(second).resumed);
    EXPECT_NE(recorded.resume_info(second).token, resume);
    // Used, even beside the right token.
    for (const char* more : {"", "&token=secret"}) {
        RawClient again(recorded.server->port());
        const std::string answer = handshake(again, "/live?resume=" + resume + more, "127.0.0.1");
        EXPECT_TRUE(answer.starts_with("HTTP/1.1 403")) << answer;
        EXPECT_NE(again.bytes(80).find("used before"), std::string::npos);
    }
    // Of a page of another origin, though this server goes by that name too.
    RawClient foreign(recorded.server->port());
    EXPECT_TRUE(handshake(foreign, "/live?resume=" + recorded.resume_info(second).token, "localhost")
                    .starts_with("HTTP/1.1 403"));
    EXPECT_NE(foreign.bytes(80).find("another origin"), std::string::npos);
    RawClient unknown(recorded.server->port());
    EXPECT_TRUE(handshake(unknown, "/live?resume=0123456789abcdef0123456789abcdef", "127.0.0.1")
                    .starts_with("HTTP/1.1 403"));
}

TEST(Server, carries_messages_both_ways) {
    RecordingServer recorded;
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    const ClientId id = recorded.wait("connected");
    ASSERT_NE(id, 0u);
    EXPECT_EQ(recorded.server->clients(), 1u);
    ASSERT_TRUE(client.send_frame(1, "play"));
    EXPECT_EQ(recorded.wait("play"), id);
    recorded.server->send_text(id, "hello");
    recorded.server->send_all(std::make_shared<std::vector<std::uint8_t>>(100'000, std::uint8_t{7}));
    auto frame = client.frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->opcode, 1);
    EXPECT_EQ(frame->payload, "hello");
    frame = client.frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->opcode, 2);
    EXPECT_TRUE(frame->payload == std::string(100'000, '\7'));
}

TEST(Server, sends_a_newcomer_nothing_before_its_greeting) {
    RecordingServer recorded;
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    const ClientId id = recorded.wait("connected");
    const auto data = [](char c) { return std::make_shared<std::vector<std::uint8_t>>(3, c); };
    recorded.server->send_all(data('a'));
    recorded.server->send_text(id, "hello");
    recorded.server->send_all(data('b'));
    EXPECT_EQ(client.frame()->payload, "hello");
    EXPECT_EQ(client.frame()->payload, "bbb");
}

TEST(Server, tells_when_a_client_goes) {
    RecordingServer recorded;
    ClientId id = 0;
    {
        RawClient client(recorded.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        id = recorded.wait("connected");
    }
    EXPECT_EQ(recorded.wait("disconnected"), id);
    EXPECT_EQ(recorded.server->clients(), 0u);
    recorded.server->send_text(id, "to nobody");
}

TEST(Server, cuts_off_who_floods_saying_so) {
    ServerOptions options;
    options.messages_per_s = 20;
    RecordingServer recorded(options);
    for (const int opcode : {1, 9}) {  // texts, pings
        RawClient client(recorded.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        for (int n = 0; n < 200; ++n) client.send_frame(opcode, "x");
        EXPECT_NE(recorded.wait("disconnected"), 0u);
        const auto closing = client.closing();
        EXPECT_EQ(closing.code, 1008);
        EXPECT_EQ(closing.why, "too many messages");
    }
}

TEST(Server, cuts_off_who_sends_too_much_saying_how_much_is_right) {
    ServerOptions options;
    options.message_bytes = 1000;
    RecordingServer recorded(options);
    {
        RawClient client(recorded.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        ASSERT_TRUE(client.send_frame(1, std::string(1000, 'x')));
        EXPECT_NE(recorded.wait(std::string(1000, 'x')), 0u);
        client.send_frame(1, std::string(1001, 'x'));
        EXPECT_NE(recorded.wait("disconnected"), 0u);
        const auto closing = client.closing();
        EXPECT_EQ(closing.code, 1009);
        EXPECT_EQ(closing.why, "a message may have at most 1000 bytes");
    }
    // In pieces, and with a length that nobody will ever send.
    {
        RawClient client(recorded.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        client.send(std::string("\x01\xfe\x03\xe8MASK", 8) + std::string(1000, 'x') +
                    std::string("\x80\xfe\x03\xe8MASK", 8) + std::string(1000, 'x'));
        EXPECT_EQ(client.closing().code, 1009);
    }
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    client.send(std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff"
                            "MASK",
                            14) +
                std::string(2000, 'x'));
    EXPECT_EQ(client.closing().code, 1009);
}

TEST(Server, cuts_off_who_sends_what_is_no_message) {
    RecordingServer recorded;
    const auto closing_after = [&](const std::string& bytes) {
        RawClient::Closing closing;
        {
            RawClient client(recorded.server->port());
            EXPECT_TRUE(client.join(kProtocol));
            client.send(bytes);
            closing = client.closing();
        }
        EXPECT_NE(recorded.wait("disconnected"), 0u);
        return closing;
    };
    EXPECT_EQ(closing_after("\xff\xff\xff\xff no frame at all").code, 1002);
    EXPECT_EQ(closing_after("\x81\x02hi").code, 1002);                                // not masked
    EXPECT_EQ(closing_after(std::string("\x81\x82\0\0\0\0\xff\xfe", 8)).code, 1007);  // not UTF-8
    const auto binary = closing_after(std::string("\x82\x82\0\0\0\0hi", 8));
    EXPECT_EQ(binary.code, 1003);
    EXPECT_EQ(binary.why, "messages to the server are text");
    RawClient client(recorded.server->port());
    EXPECT_TRUE(client.join(kProtocol));
}

TEST(Server, cuts_off_a_client_on_request) {
    RecordingServer recorded;
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    const ClientId id = recorded.wait("connected");
    recorded.server->disconnect(id, "enough");
    EXPECT_EQ(recorded.wait("disconnected"), id);
    const auto closing = client.closing();
    EXPECT_EQ(closing.code, 1008);
    EXPECT_EQ(closing.why, "enough");
}

TEST(Server, cuts_off_who_makes_no_sense_a_hundred_times) {
    RecordingServer recorded;
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    const ClientId id = recorded.wait("connected");
    for (int n = 0; n < Server::kMostRefusals; ++n) recorded.server->refuse(id, "what?");
    EXPECT_EQ(recorded.wait("disconnected"), id);
    const auto closing = client.closing();
    EXPECT_EQ(closing.code, 1008);
    EXPECT_EQ(closing.why, "too many messages that make no sense");
}

TEST(Server, serves_twelve_while_four_never_read) {
    ServerOptions options;
    options.queue_bytes = 1'000'000;
    RecordingServer recorded(options);
    std::vector<std::unique_ptr<RawClient>> clients;
    for (int n = 0; n < 16; ++n) {
        clients.push_back(std::make_unique<RawClient>(recorded.server->port()));
        ASSERT_TRUE(clients.back()->join(kProtocol));
        recorded.server->send_text(recorded.wait("connected"), "hello");
        if (n >= 4) {
            ASSERT_EQ(clients.back()->frame()->payload, "hello");
        }
    }
    EXPECT_EQ(recorded.server->clients(), 16u);
    // 50 MB to each: more than sockets hold. The twelve take each before the next comes.
    constexpr int kFrames = 200;
    for (int n = 0; n < kFrames; ++n) {
        recorded.server->send_all(
            std::make_shared<std::vector<std::uint8_t>>(250'000, static_cast<std::uint8_t>(n)));
        for (std::size_t c = 4; c < clients.size(); ++c) {
            const auto frame = clients[c]->frame();
            ASSERT_TRUE(frame);
            ASSERT_EQ(frame->payload.size(), 250'000u);
            ASSERT_EQ(static_cast<std::uint8_t>(frame->payload.front()), n);
        }
    }
    // One of the four begins to read: in order, with a gap, up to the last one.
    EXPECT_EQ(clients[0]->frame()->payload, "hello");
    int before = -1, taken = 0;
    while (before < kFrames - 1) {
        const auto frame = clients[0]->frame();
        ASSERT_TRUE(frame);
        const int n = static_cast<std::uint8_t>(frame->payload.front());
        EXPECT_GT(n, before);
        before = n;
        ++taken;
    }
    EXPECT_LT(taken, kFrames);
    EXPECT_NE(recorded.wait("overflowed"), 0u);
}

TEST(Server, never_waits_for_a_client_that_does_not_read) {
    ServerOptions options;
    options.queue_bytes = 1'000'000;
    RecordingServer recorded(options);
    RawClient slow(recorded.server->port()), quick(recorded.server->port());
    ASSERT_TRUE(slow.join(kProtocol));
    recorded.server->send_text(recorded.wait("connected"), "hello");
    ASSERT_TRUE(quick.join(kProtocol));
    const ClientId quick_id = recorded.wait("connected");
    recorded.server->send_text(quick_id, "hello");
    EXPECT_EQ(quick.frame()->payload, "hello");
    // 400 MB: more than any socket holds; were it kept, memory would show it.
    const auto data = std::make_shared<std::vector<std::uint8_t>>(1'000'000);
    for (int n = 0; n < 400; ++n) recorded.server->send_all(data);
    recorded.server->send_text(quick_id, "last");
    for (;;) {
        const auto frame = quick.frame();
        ASSERT_TRUE(frame);
        if (frame->opcode == 1) break;
    }
    // It begins to read, and is told that it missed something.
    while (slow.frame()) {
        if (recorded.wait("overflowed") != 0) break;
    }
    SUCCEED();
}

TEST(Server, refuses_a_port_that_is_taken_and_an_address_that_is_none) {
    RecordingServer recorded;
    ServerOptions options;
    options.port = recorded.server->port();
    const auto second = Server::start(options, {});
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().text().find(std::to_string(options.port)), std::string::npos);
    options.address = "somewhere";
    EXPECT_FALSE(Server::start(options, {}));
}

TEST(Server, survives_requests_that_never_end) {
    RecordingServer recorded;
    RawClient client(recorded.server->port());
    client.send("GET / HTTP/1.1\r\nHost: " + client.host() + "\r\nX: " + std::string(100'000, 'x'));
    EXPECT_EQ(client.bytes(1), "");
    RawClient other(recorded.server->port());
    EXPECT_TRUE(other.get("/").starts_with("HTTP/1.1 200"));
}

}  // namespace
}  // namespace tribo::net
