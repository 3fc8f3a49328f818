// SPDX-License-Identifier: MIT
// `tribo live` as a program: what it says, how it ends. What it shows: web/viewer/test/live.test.ts.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "app/program.hpp"

namespace tribo::test {
namespace {

constexpr const char* kJob =
    "[stock]\nbox_mm = [[0,0,-5],[20,10,0]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 6\nflutes = 2\n"
    "helix_deg = 30\nlength_mm = 15\n[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\n"
    "feed_mm_per_min = 600\n[path]\ngcode = \"p.nc\"\n";

class Live : public testing::Test {
  protected:
    void SetUp() override {
        scratch_.put("job.toml", kJob);
        scratch_.put("p.nc", "G21 G90\nG0 X-5 Y5 Z2\nG1 Z-1\nG1 X25\n");
        scratch_.put("index.html", "<p>page");
    }
    Outcome live(std::vector<std::string> more, int interrupt_after_ms = 0) const {
        more.insert(more.begin(), {"live", "job.toml", "--resolution", "0.5"});
        return run_tribo(more, scratch_.path(), interrupt_after_ms);
    }
    Scratch scratch_;
};

TEST_F(Live, serves_until_it_is_interrupted) {
    const Outcome run = live({"--port", "0", "--web-root", "."}, 2000);
    EXPECT_EQ(run.code, 130) << run.err;
    EXPECT_NE(run.out.find("job.toml is live at http://127.0.0.1:"), std::string::npos) << run.out;
}

TEST_F(Live, says_what_is_missing) {
    Outcome run = live({"--port", "0", "--web-root", "nowhere"});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("nowhere"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("--web-root"), std::string::npos) << run.err;
    scratch_.put("p.nc", "G21 G90\nG0 X0 Y0 Z0 A30\nG1 X5\n");
    run = live({"--port", "0", "--web-root", "."});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("p.nc:2"), std::string::npos) << run.err;
}

TEST_F(Live, says_that_its_port_is_taken) {
    const int other = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ASSERT_EQ(::bind(other, reinterpret_cast<const sockaddr*>(&address), size), 0);
    ASSERT_EQ(::listen(other, 1), 0);
    ASSERT_EQ(::getsockname(other, reinterpret_cast<sockaddr*>(&address), &size), 0);
    const std::string port = std::to_string(ntohs(address.sin_port));
    const Outcome run = live({"--port", port, "--web-root", "."});
    EXPECT_EQ(run.code, 3);
    EXPECT_NE(run.err.find(port), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("--port"), std::string::npos) << run.err;
    ::close(other);
}

}  // namespace
}  // namespace tribo::test
