// SPDX-License-Identifier: MIT
// The server inside TLS, and keys with which it does not start.
#include "net/tls.hpp"

#include <gtest/gtest.h>

#include "net/certificates.hpp"
#include "net/raw_client.hpp"
#include "net/server.hpp"

namespace tribo::net {
namespace {

using test::make_certificate;
using test::RawClient;

Result<TlsContext> made_of(const std::string& certificate, const std::string& key) {
    return make_tls_context({certificate, key, "c.pem", "k.pem"});
}

TEST(Tls, takes_a_certificate_with_its_key_and_reads_its_names) {
    const auto pair = make_certificate("DNS:Mill.local,DNS:*.example,IP:192.168.1.5,IP:fd00::5");
    const auto tls = made_of(pair.certificate, pair.key);
    ASSERT_TRUE(tls) << tls.error().text();
    EXPECT_EQ(tls->names, (std::vector<std::string>{"mill.local", "192.168.1.5", "fd00::5"}));
    // With others of a chain behind it.
    EXPECT_TRUE(made_of(pair.certificate + make_certificate().certificate, pair.key));
}

TEST(Tls, says_what_is_wrong_with_a_file_and_which_it_is) {
    const auto pair = make_certificate(), other = make_certificate();
    const auto expired = make_certificate("DNS:localhost", -30, -1);
    const auto early = make_certificate("DNS:localhost", 1, 30);
    const auto locked = make_certificate("DNS:localhost", -1, 30, "sesame");
    std::string broken = pair.certificate;
    broken[broken.size() / 2] = '!';
    const struct {
        std::string certificate, key;
        const char *file, *says;
    } cases[] = {
        {"", pair.key, "c.pem", "holds no certificate"},
        {"hello", pair.key, "c.pem", "holds no certificate"},
        {broken, pair.key, "c.pem", "holds no certificate"},
        {pair.key, pair.certificate, "c.pem", "holds a key"},
        {expired.certificate, expired.key, "c.pem", "expired on 20"},
        {early.certificate, early.key, "c.pem", "not valid before 20"},
        {pair.certificate, "", "k.pem", "holds no private key"},
        {pair.certificate, pair.certificate, "k.pem", "holds no private key"},
        {pair.certificate, pair.key.substr(0, 80), "k.pem", "holds no private key"},
        {pair.certificate, other.key, "k.pem", "not that of the certificate in 'c.pem'"},
        {locked.certificate, locked.key, "k.pem", "passphrase"},
    };
    for (const auto& c : cases) {
        const auto tls = made_of(c.certificate, c.key);
        ASSERT_FALSE(tls) << c.says;
        EXPECT_EQ(tls.error().file, c.file);
        EXPECT_NE(tls.error().cause.find(c.says), std::string::npos) << tls.error().text();
        EXPECT_FALSE(tls.error().remedy.empty());
    }
}

class TlsServer : public testing::Test {
  protected:
    void SetUp() override {
        const auto pair = make_certificate();
        const auto tls = made_of(pair.certificate, pair.key);
        ASSERT_TRUE(tls);
        ServerOptions options;
        options.subprotocol = "test.1";
        options.tls = tls->context;
        ServerHandlers handlers;
        handlers.on_get = [](std::string_view, AcceptedEncodings) {
            return Page{"text/html", "<p>hello", ""};
        };
        handlers.on_message = [this](ClientId id, std::string_view text) {
            server_->send_text(id, std::string(text));
            server_->send(id, std::make_shared<std::vector<std::uint8_t>>(300'000, std::uint8_t{7}));
            return Taken::yes;
        };
        auto started = Server::start(options, std::move(handlers));
        ASSERT_TRUE(started);
        server_ = std::move(*started);
    }
    void TearDown() override { server_.reset(); }
    std::unique_ptr<Server> server_;
};

TEST_F(TlsServer, gives_pages_and_carries_messages) {
    RawClient page(server_->port(), RawClient::Over::tls);
    ASSERT_TRUE(page.connected());
    for (int n = 0; n < 2; ++n) EXPECT_TRUE(page.get("/").ends_with("<p>hello"));
    RawClient client(server_->port(), RawClient::Over::tls);
    ASSERT_TRUE(client.join("test.1"));
    ASSERT_TRUE(client.send_frame(1, "hi"));
    const auto text = client.frame();
    ASSERT_TRUE(text);
    EXPECT_EQ(text->payload, "hi");
    const auto data = client.frame();
    ASSERT_TRUE(data);
    EXPECT_TRUE(data->payload == std::string(300'000, '\7'));
    client.send_frame(8, "\x03\xe8");
    EXPECT_EQ(client.closing().code, 1000);
}

TEST_F(TlsServer, wants_the_origin_to_be_https) {
    RawClient client(server_->port(), RawClient::Over::tls);
    EXPECT_TRUE(client.upgrade("/live", "test.1", "http://" + client.host(), client.host())
                    .starts_with("HTTP/1.1 403"));
}

TEST_F(TlsServer, sends_who_asks_in_the_clear_to_https) {
    RawClient client(server_->port());
    const std::string answer = client.get("/a?b=c");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 308")) << answer;
    EXPECT_NE(answer.find("Location: https://" + client.host() + "/a?b=c\r\n"), std::string::npos) << answer;
    RawClient foreign(server_->port());
    foreign.send("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
    EXPECT_TRUE(foreign.header().starts_with("HTTP/1.1 403"));
    RawClient in_the_clear(server_->port());
    EXPECT_FALSE(in_the_clear.join("test.1"));
}

TEST_F(TlsServer, survives_handshakes_that_break_off) {
    for (const std::string& bytes : {std::string("\x16"), std::string("\x16\x03\x01\x02\x00garbage", 12),
                                     std::string("\x16\x03\x01\x40\x00", 5) + std::string(16384, '\xff')}) {
        RawClient client(server_->port());
        client.send(bytes);
    }
    RawClient client(server_->port(), RawClient::Over::tls);
    EXPECT_TRUE(client.join("test.1"));
}

}  // namespace
}  // namespace tribo::net
