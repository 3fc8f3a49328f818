// SPDX-License-Identifier: MIT
// The server with clients that keep to the rules, and foreign ones.
#include "net/server.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>

#include "net/recording_server.hpp"

namespace tribo::net {
namespace {

using namespace test;
using namespace std::chrono_literals;

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

TEST(Server, says_goodbye) {
    RecordingServer recorded;
    std::vector<std::unique_ptr<RawClient>> clients;
    for (int n = 0; n < 4; ++n) {
        clients.push_back(std::make_unique<RawClient>(recorded.server->port()));
        ASSERT_TRUE(clients.back()->join(kProtocol));
        ASSERT_NE(recorded.wait("connected"), 0u);
    }
    // They do not answer the close frame: the server waits for that, but not long.
    const auto before = std::chrono::steady_clock::now();
    recorded.server.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - before, 1s);
    for (const auto& client : clients) {
        const auto closing = client->closing();
        EXPECT_EQ(closing.code, 1001);
        EXPECT_EQ(closing.why, "the engine ends");
    }
}

TEST(Server, says_goodbye_once_it_is_over) {
    std::atomic<bool> over = false;
    ServerOptions options;
    options.is_over = [&] { return over.load(); };
    RecordingServer recorded(options);
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    ASSERT_NE(recorded.wait("connected"), 0u);
    over = true;
    EXPECT_EQ(client.closing().code, 1001);
    EXPECT_FALSE(RawClient(recorded.server->port()).connected());
}

}  // namespace
}  // namespace tribo::net
