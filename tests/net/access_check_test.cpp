// SPDX-License-Identifier: MIT
// Who is let in, by the rules alone.
#include "net/access_check.hpp"

#include <gtest/gtest.h>
#include <set>

#include "net/addresses.hpp"
#include "net/secret.hpp"

namespace tribo::net {
namespace {

using namespace std::chrono_literals;

const AccessCheck::Time kNow{std::chrono::hours(1)};

Credentials credentials(std::string_view target) {
    return {"mill.local:8317", "https://mill.local:8317", "p.1", target, "192.168.1.5"};
}

AccessCheck access_check() {
    return AccessCheck({"p.1", "secret", {"Mill.local"}, true});
}

TEST(AccessCheck, knows_its_own_names_and_the_address_of_the_connection) {
    const AccessCheck g = access_check();
    for (const char* host :
         {"localhost", "localhost:8317", "MILL.local:1", "192.168.1.5:8317", "192.168.1.5"})
        EXPECT_TRUE(g.is_own_name(host, "192.168.1.5")) << host;
    EXPECT_TRUE(g.is_own_name("[fd00::5]:8317", "fd00::5"));
    EXPECT_TRUE(g.is_own_name("[::1]", "::1"));
    for (const char* host : {"", ":8317", "evil.example", "localhost.evil.example", "192.168.1.6",
                             "mill.local.", "127.0.0.1", "[::1]:8317", "mill", "0.0.0.0"})
        EXPECT_FALSE(g.is_own_name(host, "192.168.1.5")) << host;
    EXPECT_FALSE(g.is_own_name("", ""));
}

TEST(AccessCheck, asks_for_the_origin_over_https_where_pages_come_so) {
    AccessCheck g = access_check();
    EXPECT_TRUE(g.admit(credentials("/live?token=secret"), kNow));
    for (const char* origin :
         {"", "null", "http://mill.local:8317", "https://mill.local", "https://evil.example",
          "https://mill.local:8317/", "https://mill.local:8317.evil.example"}) {
        Credentials k = credentials("/live?token=secret");
        k.origin = origin;
        const auto admitted = g.admit(k, kNow);
        ASSERT_FALSE(admitted) << origin;
        EXPECT_EQ(admitted.error(), "the page is not this server's");
    }
}

TEST(AccessCheck, keeps_a_resume_token_for_kResumeTime_after_the_client_disconnected) {
    AccessCheck g = access_check();
    const std::string early = g.resume_token(1, "https://mill.local:8317", kNow);
    const std::string late = g.resume_token(2, "https://mill.local:8317", kNow);
    // As long as it is there the token does not grow old.
    const AccessCheck::Time gone = kNow + 24h;
    g.on_disconnect(1, gone);
    g.on_disconnect(2, gone);
    const auto back = g.admit(credentials("/live?resume=" + early), gone + kResumeTime - 1s);
    ASSERT_TRUE(back) << back.error();
    EXPECT_TRUE(back->resumed);
    EXPECT_EQ(back->previous, 1u);
    const auto refused = g.admit(credentials("/live?resume=" + late), gone + kResumeTime);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().find("too old"), std::string::npos);
}

TEST(AccessCheck, takes_a_resume_token_that_a_foreign_origin_brought_from_everybody) {
    AccessCheck g = access_check();
    const std::string token = g.resume_token(1, "https://mill.local:8317", kNow);
    Credentials foreign = credentials("");
    const std::string target = "/live?resume=" + token;
    foreign.host = "localhost:8317";
    foreign.origin = "https://localhost:8317";
    foreign.target = target;
    EXPECT_EQ(g.admit(foreign, kNow).error(), "the resume token belongs to another origin");
    EXPECT_EQ(g.admit(credentials(target), kNow).error(), "the resume token was used before");
}

TEST(AccessCheck, an_empty_resume_token_is_none) {
    AccessCheck g = access_check();
    EXPECT_FALSE(g.admit(credentials("/live?resume="), kNow));
    EXPECT_TRUE(g.admit(credentials("/live?resume=&token=secret"), kNow));
}

TEST(Secret, tokens_have_128_bits_and_do_not_come_twice) {
    std::set<std::string> seen;
    for (int n = 0; n < 1000; ++n) {
        const std::string token = random_token();
        EXPECT_EQ(token.size(), 32u);
        EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
        EXPECT_TRUE(seen.insert(token).second);
    }
    EXPECT_TRUE(same_secret("", ""));
    EXPECT_TRUE(same_secret("abc", "abc"));
    EXPECT_FALSE(same_secret("abc", "abd"));
    EXPECT_FALSE(same_secret("abc", "ab"));
}

TEST(Addresses, are_told_apart) {
    for (const char* text : {"127.0.0.1", "127.8.8.8", "::1"}) EXPECT_TRUE(is_loopback(text)) << text;
    for (const char* text : {"0.0.0.0", "::", "192.168.1.5", "localhost", ""})
        EXPECT_FALSE(is_loopback(text)) << text;
    for (const char* text : {"somewhere", "1.2.3", "1.2.3.4.5", "256.0.0.1", "[::1]", "", "127.0.0.1:80"})
        EXPECT_FALSE(is_address(text)) << text;
    EXPECT_TRUE(is_every_address("0.0.0.0") && is_every_address("::") && is_every_address("0:0::0"));
    EXPECT_EQ(in_url("::1"), "[::1]");
    EXPECT_EQ(in_url("10.0.0.1"), "10.0.0.1");
    for (const std::string& address : own_addresses()) {
        EXPECT_TRUE(is_address(address)) << address;
        EXPECT_FALSE(is_loopback(address)) << address;
    }
}

}  // namespace
}  // namespace tribo::net
