// SPDX-License-Identifier: MIT
// `tribo live` as a program: what it says, how it ends. What it shows: web/mill/test/live.test.ts.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "app/run/benchmark_slot.hpp"
#include "app/run/live_viewer.hpp"
#include "app/run/program.hpp"
#include "net/certificates.hpp"
#include "net/raw_client.hpp"

namespace tribo::test {
namespace {

using net::test::RawClient;

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

// Kinds of docs/live-protocol.md: 13 what bends, 14 multipliers, 15 the chart.
TEST_F(Live, tells_what_bends_the_multipliers_and_the_chart_of_a_job_with_modes) {
    scratch_.put("job.toml", std::string(kJob) + benchmark_mode("1, 0, 0"));
    RunningTribo engine({"live", "job.toml", "--resolution", "0.5", "--port", "0", "--web-root", "."},
                        scratch_.path());
    Viewer viewer(address_in(engine.out_with("Ctrl-C")).port);
    EXPECT_FALSE(viewer.frame_of(13).empty());
    EXPECT_TRUE(viewer.say(R"({"op":"seek","t_s":1.5})"));
    EXPECT_FALSE(viewer.frame_of(14).empty());
    EXPECT_FALSE(viewer.frame_of(15).empty());
}

TEST_F(Live, serves_an_empty_bench_without_a_job) {
    RunningTribo engine({"live", "--port", "0", "--web-root", "."}, scratch_.path());
    const Address at = address_in(engine.out_with("Ctrl-C"));
    ASSERT_EQ(at.host, "127.0.0.1");
    EXPECT_EQ(at.token, "");
    RawClient client(at.port);
    ASSERT_TRUE(client.join(kProtocol));
    const auto info = client.frame();
    ASSERT_TRUE(info);
    EXPECT_NE(info->payload.find("serverInfo"), std::string::npos);
    EXPECT_EQ(info->payload.find("\"job\""), std::string::npos);
    client.send_frame(1, R"({"op":"play"})");
    const auto refusal = client.frame();
    ASSERT_TRUE(refusal);
    EXPECT_NE(refusal->payload.find("no job is open"), std::string::npos);
    // Pages are what stood in the folder at the start, and nothing beyond it.
    EXPECT_TRUE(RawClient(at.port).get("/").ends_with("<p>page"));
    for (const char* path :
         {"/../../../../../../etc/passwd", "/..%2f..%2fetc%2fpasswd", "//etc/passwd", "/etc/passwd"})
        EXPECT_TRUE(RawClient(at.port).get(path).starts_with("HTTP/1.1 404")) << path;
    EXPECT_EQ(engine.stop().code, 130);
}

TEST_F(Live, shows_its_token_to_no_list_of_processes) {
    // What would start a browser keeps what it was given.
    scratch_.put("bin/xdg-open", "#!/bin/sh\ngrep SigBlk /proc/self/status > " + scratch_ / "blocked" +
                                     "\nprintf '%s' \"$*\" > " + scratch_ / "given.new" + " && mv " +
                                     scratch_ / "given.new" + " " + scratch_ / "given" + "\n");
    std::filesystem::permissions(scratch_ / "bin/xdg-open", std::filesystem::perms::owner_all);
    std::filesystem::create_directory(scratch_ / "session");
    const std::string path = std::string(std::getenv("PATH"));
    ::setenv("PATH", (scratch_ / "bin" + ":" + path).c_str(), 1);
    ::setenv("DISPLAY", ":99", 1);
    ::setenv("XDG_RUNTIME_DIR", (scratch_ / "session").c_str(), 1);
    RunningTribo engine({"live", "--port", "0", "--web-root", ".", "--listen", "0.0.0.0", "--open"},
                        scratch_.path());
    ::setenv("PATH", path.c_str(), 1);
    ::unsetenv("DISPLAY");
    ::unsetenv("XDG_RUNTIME_DIR");
    const Address at = address_in(engine.out_with("Ctrl-C"));
    ASSERT_GT(at.token.size(), 20u);
    std::string given;
    for (int n = 0; n < 500 && given.empty(); ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        given = scratch_.get("given");
    }
    ASSERT_TRUE(given.starts_with(scratch_ / "session/")) << given;
    EXPECT_EQ(given.find(at.token), std::string::npos);
    std::ifstream page(given);
    const std::string text{std::istreambuf_iterator<char>(page), {}};
    EXPECT_NE(text.find("url=http://127.0.0.1:" + std::to_string(at.port) + "/?token=" + at.token),
              std::string::npos)
        << text;
    const auto others = std::filesystem::perms::group_all | std::filesystem::perms::others_all;
    EXPECT_EQ(std::filesystem::status(given).permissions() & others, std::filesystem::perms::none);
    // A browser that blocks signals could not be ended with SIGTERM.
    EXPECT_EQ(scratch_.get("blocked"), "SigBlk:\t0000000000000000\n");
    EXPECT_EQ(engine.stop().code, 130);
    EXPECT_FALSE(std::filesystem::exists(given));
}

TEST_F(Live, comes_back_whole_after_a_resume) {
    RunningTribo engine({"live", "job.toml", "--resolution", "0.5", "--port", "0", "--web-root", "."},
                        scratch_.path());
    const Address at = address_in(engine.out_with("Ctrl-C"));
    // Texts and kinds of frames up to the state, which ends what a newcomer gets.
    const auto greeting = [](RawClient& client) {
        std::string info;
        std::vector<int> kinds;
        while (kinds.empty() || kinds.back() != 3) {
            const auto frame = client.frame();
            if (!frame) break;
            if (frame->opcode == 1 && info.empty()) info = frame->payload;
            if (frame->opcode == 2) kinds.push_back(frame->payload.front());
        }
        return std::pair(info, kinds);
    };
    RawClient first(at.port);
    ASSERT_TRUE(first.join(kProtocol));
    const auto [info, kinds] = greeting(first);
    EXPECT_NE(info.find(R"("resumed":false)"), std::string::npos) << info;
    ASSERT_GT(kinds.size(), 2u);
    EXPECT_EQ(kinds.front(), 1);
    const std::string resume = info.substr(info.find(R"("resume":")") + 10, 32);
    RawClient second(at.port);
    ASSERT_TRUE(second.upgrade("/live?resume=" + resume, kProtocol, second.origin(), second.host())
                    .starts_with("HTTP/1.1 101"));
    const auto [info_again, kinds_again] = greeting(second);
    EXPECT_NE(info_again.find(R"("resumed":true)"), std::string::npos) << info_again;
    EXPECT_EQ(kinds_again, kinds);
    EXPECT_EQ(first.closing().code, 4000);
    RawClient third(at.port);
    EXPECT_TRUE(third.upgrade("/live?resume=" + resume, kProtocol, third.origin(), third.host())
                    .starts_with("HTTP/1.1 403"));
}

TEST_F(Live, lifts_the_finger_of_a_client_that_goes) {
    RunningTribo engine({"live", "job.toml", "--resolution", "0.5", "--port", "0", "--web-root", "."},
                        scratch_.path());
    const Address at = address_in(engine.out_with("Ctrl-C"));
    Viewer watching(at.port);
    EXPECT_TRUE(watching.say(R"({"op":"pause"})") && watching.say(R"({"op":"mode","value":"inspect"})"));
    // Whether the flag of contact of a finger frame comes to be this, within so many pictures.
    const auto touches = [&](bool wanted) {
        for (int n = 0; n < 300; ++n) {
            const std::string frame = watching.frame_of(7);
            if (frame.size() < 60) return false;
            if (((frame[56] & 1) != 0) == wanted) return true;
        }
        return false;
    };
    {
        Viewer pressing(at.port);
        EXPECT_TRUE(pressing.say(R"({"op":"finger","position_mm":[10,5,3],"down":true})"));
        EXPECT_TRUE(touches(false));
        EXPECT_TRUE(pressing.say(R"({"op":"finger","position_mm":[10,5,-1],"down":true})"));
        EXPECT_TRUE(touches(true));
    }
    EXPECT_TRUE(touches(false));
}

TEST_F(Live, goes_on_with_the_old_cut_while_a_file_is_wrong) {
    const std::string program = scratch_.get("p.nc"), job = scratch_.get("job.toml");
    RunningTribo engine(
        {"live", "job.toml", "--resolution", "0.5", "--port", "0", "--web-root", ".", "--memory", "500"},
        scratch_.path());
    Viewer viewer(address_in(engine.out_with("Ctrl-C")).port);
    ASSERT_TRUE(viewer.step_back());
    const auto remove = [&](const char* name) { std::filesystem::remove(scratch_ / name); };
    const struct {
        const char* what;
        std::function<void()> spoil;
        const char *file, *says;
    } cases[] = {
        {"a typo", [&] { scratch_.put("p.nc", "G21 G90\nG0 X-5 Y5 Z2\nG1 Zx-1\nG1 X25\n"); }, "p.nc",
         R"("line":3)"},
        {"an emptied program", [&] { scratch_.put("p.nc", ""); }, "p.nc", ""},
        {"a deleted program", [&] { remove("p.nc"); }, "job.toml", "names p.nc, which is not there"},
        {"a pipe in its place",
         [&] {
             remove("p.nc");
             ASSERT_EQ(::mkfifo((scratch_ / "p.nc").c_str(), 0600), 0);
         },
         "p.nc", "is a pipe"},
        {"a folder in its place",
         [&] {
             remove("p.nc");
             std::filesystem::create_directory(scratch_ / "p.nc");
         },
         "p.nc", "is a folder"},
        {"a wrong job", [&] { scratch_.put("job.toml", "[stock]\nbox_mm = 5\n"); }, "job.toml",
         R"("line":2)"},
        {"a stock of 90 m",
         [&] {
             std::string wide = job;
             wide.replace(wide.find("[20,10,0]"), 9, "[90000,90000,0]");
             scratch_.put("job.toml", wide);
         },
         "job.toml", "MB are allowed"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.what);
        c.spoil();
        ASSERT_TRUE(viewer.step_back());
        // Who comes now is told too.
        Viewer latecomer(address_in(engine.out_with("Ctrl-C")).port);
        const std::string said = latecomer.text_with(R"("files")");
        EXPECT_NE(said.find(c.file), std::string::npos) << said;
        EXPECT_NE(said.find(c.says), std::string::npos) << said;
        remove("p.nc");
        scratch_.put("p.nc", program);
        scratch_.put("job.toml", job);
        ASSERT_TRUE(viewer.step_back());
        EXPECT_NE(latecomer.text_with(R"("files")").find(R"("wrong":null)"), std::string::npos);
    }
    // What a new program warns of is told, also to who comes later.
    scratch_.put("p.nc", program + "M123\n");
    Viewer witness(address_in(engine.out_with("Ctrl-C")).port);
    ASSERT_TRUE(viewer.step_back());
    EXPECT_NE(witness.text_with("M123").find(R"("wrong":null)"), std::string::npos);
    Viewer newcomer(address_in(engine.out_with("Ctrl-C")).port);
    EXPECT_NE(newcomer.text_with("M123").find("serverInfo"), std::string::npos);
    // A new program is milled as it is.
    scratch_.put("p.nc", "G21 G90\nG0 X-5 Y5 Z2\nG1 Z-1\nG1 X25\nG1 Y8\nG1 X-5\n");
    ASSERT_TRUE(viewer.step_back());
    EXPECT_TRUE(viewer.say(R"({"op":"seek","t_s":5})") && viewer.state(true, 5));
    const Outcome end = engine.stop();
    EXPECT_EQ(end.code, 130);
    EXPECT_NE(end.err.find("p.nc:3"), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("the cut before goes on"), std::string::npos) << end.err;
}

TEST_F(Live, refuses_a_program_in_a_pipe) {
    std::filesystem::remove(scratch_ / "p.nc");
    ASSERT_EQ(::mkfifo((scratch_ / "p.nc").c_str(), 0600), 0);
    const Outcome run = live({"--port", "0", "--web-root", "."});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("p.nc: error: is a pipe"), std::string::npos) << run.err;
}

TEST_F(Live, asks_for_a_token_and_warns_where_other_machines_may_come) {
    RunningTribo engine({"live", "--port", "0", "--web-root", ".", "--listen", "0.0.0.0"}, scratch_.path());
    const Address at = address_in(engine.out_with("Ctrl-C"));
    EXPECT_EQ(at.scheme, "http");
    EXPECT_EQ(at.token.size(), 32u);
    const auto answer = [&](const std::string& target, const std::string& host) {
        RawClient client(at.port);
        return client.upgrade(target, kProtocol, "http://" + host, host);
    };
    const std::string here = "127.0.0.1:" + std::to_string(at.port);
    EXPECT_TRUE(answer("/live?token=" + at.token, here).starts_with("HTTP/1.1 101"));
    EXPECT_TRUE(answer("/live", here).starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(answer("/live?token=" + std::string(32, '0'), here).starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(answer("/live?token=" + at.token, "evil.example").starts_with("HTTP/1.1 403"));
    char name[256] = {};
    ::gethostname(name, sizeof name - 1);
    EXPECT_TRUE(answer("/live?token=" + at.token, std::string(name) + ":" + std::to_string(at.port))
                    .starts_with("HTTP/1.1 101"));
    const Outcome end = engine.stop();
    EXPECT_NE(end.err.find("neither sound nor virtual reality"), std::string::npos) << end.err;
}

TEST_F(Live, speaks_tls) {
    const auto pair = net::test::make_certificate();
    scratch_.put("c.pem", pair.certificate);
    scratch_.put("k.pem", pair.key);
    RunningTribo engine({"live", "--port", "0", "--web-root", ".", "--listen", "0.0.0.0", "--tls-cert",
                         "c.pem", "--tls-key", "k.pem"},
                        scratch_.path());
    const Address at = address_in(engine.out_with("Ctrl-C"));
    EXPECT_EQ(at.scheme, "https");
    EXPECT_EQ(at.host, "localhost");
    RawClient client(at.port, RawClient::Over::tls);
    ASSERT_TRUE(client.connected());
    EXPECT_TRUE(client.upgrade("/live?token=" + at.token, kProtocol, client.origin(), client.host())
                    .starts_with("HTTP/1.1 101"));
    const Outcome end = engine.stop();
    EXPECT_EQ(end.err, "");
}

TEST_F(Live, refuses_keys_that_do_not_serve_and_addresses_that_are_not_its_own) {
    const auto pair = net::test::make_certificate(), other = net::test::make_certificate();
    const auto expired = net::test::make_certificate("DNS:localhost", -9, -1);
    scratch_.put("c.pem", pair.certificate);
    scratch_.put("k.pem", pair.key);
    scratch_.put("other.pem", other.key);
    scratch_.put("expired.pem", expired.certificate);
    scratch_.put("expired-k.pem", expired.key);
    scratch_.put("junk.pem", "junk");
    const struct {
        std::vector<std::string> more;
        int code;
        const char* says;
    } cases[] = {
        {{"--tls-cert", "c.pem"}, 2, "--tls-key"},
        {{"--tls-key", "k.pem"}, 2, "--tls-cert"},
        {{"--tls-cert", "none.pem", "--tls-key", "k.pem"}, 2, "none.pem: error"},
        {{"--tls-cert", "c.pem", "--tls-key", "."}, 2, "folder"},
        {{"--tls-cert", "junk.pem", "--tls-key", "k.pem"}, 2, "junk.pem: error"},
        {{"--tls-cert", "c.pem", "--tls-key", "other.pem"}, 2, "other.pem: error"},
        {{"--tls-cert", "expired.pem", "--tls-key", "expired-k.pem"}, 2, "expired on"},
        {{"--listen", "somewhere"}, 2, "somewhere"},
        {{"--listen", "192.0.2.77"}, 3, "192.0.2.77"},  // of TEST-NET-1: nobody's
    };
    for (const auto& c : cases) {
        std::vector<std::string> arguments{"live", "--port", "0", "--web-root", "."};
        arguments.insert(arguments.end(), c.more.begin(), c.more.end());
        const Outcome run = run_tribo(arguments, scratch_.path());
        EXPECT_EQ(run.code, c.code) << run.err;
        EXPECT_NE(run.err.find(c.says), std::string::npos) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

TEST_F(Live, says_where_it_is_when_no_browser_can_be_opened) {
    std::string display;
    for (char** entry = environ; *entry != nullptr; ++entry) display += std::string(*entry) + "\n";
    if (display.find("DISPLAY=") != std::string::npos) GTEST_SKIP() << "there is a screen here";
    const Outcome run =
        run_tribo({"live", "--port", "0", "--web-root", ".", "--open"}, scratch_.path(), 1000);
    EXPECT_EQ(run.code, 130);
    EXPECT_NE(run.out.find("http://127.0.0.1:"), std::string::npos);
    EXPECT_NE(run.err.find("open the address by hand"), std::string::npos) << run.err;
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
