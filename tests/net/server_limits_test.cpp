// SPDX-License-Identifier: MIT
// The server with clients that break its rules, never read, say nothing, or are too many.
#include <chrono>
#include <gtest/gtest.h>

#include "net/recording_server.hpp"

namespace tribo::net {
namespace {

using namespace test;
using namespace std::chrono_literals;

TEST(ServerLimits, cuts_off_who_floods_saying_so) {
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
        EXPECT_EQ(closing.why, "more than 20 messages a second for two seconds");
    }
}

TEST(ServerLimits, cuts_off_who_sends_too_much_saying_how_much_is_right) {
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

TEST(ServerLimits, cuts_off_who_sends_what_is_no_message) {
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

TEST(ServerLimits, cuts_off_a_client_on_request) {
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

TEST(ServerLimits, cuts_off_who_makes_no_sense_a_hundred_times) {
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

TEST(ServerLimits, serves_twelve_while_four_never_read) {
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
    // 25 MB to each: more than sockets hold. The twelve take each before the next comes.
    constexpr int kFrames = 100;
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

TEST(ServerLimits, never_waits_for_a_client_that_does_not_read) {
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

TEST(ServerLimits, survives_requests_that_never_end) {
    RecordingServer recorded;
    RawClient client(recorded.server->port());
    client.send("GET / HTTP/1.1\r\nHost: " + client.host() + "\r\nX: " + std::string(100'000, 'x'));
    EXPECT_TRUE(client.header().starts_with("HTTP/1.1 431"));
    RawClient other(recorded.server->port());
    EXPECT_TRUE(other.get("/").starts_with("HTTP/1.1 200"));
}

TEST(ServerLimits, answers_what_is_no_request) {
    RecordingServer recorded;
    for (const char* wrong :
         {"\r\n\r\nhello\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "GET\r\n\r\n", "GET / HTTP/1.1\r\nHost\r\n\r\n",
          "\x16\x03\x01\x02\x01\x01\x01\xfc\x03\x03\r\n\r\n"}) {
        RawClient client(recorded.server->port());
        client.send(wrong);
        EXPECT_TRUE(client.header().starts_with("HTTP/1.1 400")) << wrong;
    }
    RawClient client(recorded.server->port());
    client.send("GET / HTTP/1.1\r\nHost: " + client.host() + "\r\nContent-Length: 5\r\n\r\nhello");
    EXPECT_TRUE(client.header().starts_with("HTTP/1.1 413"));
}

TEST(ServerLimits, tells_who_sends_more_than_it_takes) {
    RecordingServer recorded;
    const struct {
        const char* text;
        int code;
        std::string why;
    } cases[] = {{"many", 1008, "too many messages wait"}, {"much", 1009, "too many bytes of messages wait"}};
    for (const auto& c : cases) {
        RawClient client(recorded.server->port());
        ASSERT_TRUE(client.join(kProtocol));
        client.send_frame(1, c.text);
        EXPECT_EQ(client.frame()->payload, "bye: " + c.why);
        const auto closing = client.closing();
        EXPECT_EQ(closing.code, c.code);
        EXPECT_EQ(closing.why, c.why);
    }
}

TEST(ServerLimits, lets_the_longest_silent_connection_make_room) {
    ServerOptions options;
    options.connections = options.connections_per_address = 20;
    RecordingServer recorded(options);
    std::vector<std::unique_ptr<RawClient>> silent;
    for (int n = 0; n < 50; ++n) silent.push_back(std::make_unique<RawClient>(recorded.server->port()));
    const auto before = std::chrono::steady_clock::now();
    RawClient client(recorded.server->port());
    EXPECT_TRUE(client.get("/").starts_with("HTTP/1.1 200"));
    EXPECT_LT(std::chrono::steady_clock::now() - before, 5s);
    // The first to come is the first to go; the last are still there.
    EXPECT_EQ(silent.front()->bytes(1), "");
    EXPECT_TRUE(silent.back()->get("/").starts_with("HTTP/1.1 200"));
}

TEST(ServerLimits, keeps_viewers_that_answer_and_gives_the_places_of_silent_ones_to_others) {
    ServerOptions options;
    options.clients = options.clients_per_address = 4;
    RecordingServer recorded(options);
    std::vector<std::unique_ptr<RawClient>> clients;
    const auto join = [&](bool answers) {
        clients.push_back(std::make_unique<RawClient>(recorded.server->port()));
        if (!clients.back()->join(kProtocol)) return false;
        const ClientId id = recorded.wait("connected");
        recorded.server->send_text(id, "hello");
        if (!answers) return true;
        // The ping comes before the text.
        EXPECT_EQ(clients.back()->frame()->payload, "hello");
        clients.back()->send_frame(1, "here");
        EXPECT_EQ(recorded.wait("here"), id);
        return true;
    };
    EXPECT_TRUE(join(true));
    EXPECT_TRUE(join(false));
    EXPECT_TRUE(join(true));
    EXPECT_TRUE(join(true));
    EXPECT_TRUE(join(true));  // in the place of the silent one
    EXPECT_EQ(clients[1]->closing().code, 1013);
    EXPECT_FALSE(join(true));  // nobody is silent
    RawClient other(recorded.server->port());
    EXPECT_TRUE(other.upgrade("/live", kProtocol, other.origin(), other.host()).starts_with("HTTP/1.1 503"));
    const std::string picture = "a picture for all";
    recorded.server->send_all(std::make_shared<std::vector<std::uint8_t>>(picture.begin(), picture.end()));
    for (const std::size_t n : {0u, 2u, 3u, 4u}) EXPECT_EQ(clients[n]->frame()->payload, picture);
}

TEST(ServerLimits, replays_in_place_of_what_waits) {
    ServerOptions options;
    options.queue_bytes = 1'000'000;
    RecordingServer recorded(options);
    RawClient client(recorded.server->port());
    ASSERT_TRUE(client.join(kProtocol));
    const ClientId id = recorded.wait("connected");
    recorded.server->send_text(id, "hello");
    // More than the sockets and the queue hold.
    const auto frame = [](int n) {
        return std::make_shared<std::vector<std::uint8_t>>(250'000, static_cast<std::uint8_t>(n));
    };
    for (int n = 0; n < 100; ++n) recorded.server->send(id, frame(1));
    std::vector<Bytes> all;
    for (int n = 0; n < 20; ++n) all.push_back(frame(2));
    recorded.server->replay(id, all);
    recorded.server->send(id, frame(3));
    EXPECT_EQ(client.frame()->payload, "hello");
    int old = 0, replayed = 0;
    for (;;) {
        const auto one = client.frame();
        ASSERT_TRUE(one);
        if (one->payload.front() == 3) break;
        ASSERT_TRUE(one->payload.front() == 1 ? replayed == 0 : true);
        (one->payload.front() == 1 ? old : replayed) += 1;
    }
    EXPECT_LT(old, 100);
    EXPECT_EQ(replayed, 20);
}

}  // namespace
}  // namespace tribo::net
