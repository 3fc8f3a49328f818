// SPDX-License-Identifier: MIT
// The live server: how long a kilobyte takes from the engine to a page on the same machine, and what sixteen
// clients of which four never read do to the servo beside them.
#include <atomic>
#include <cstring>
#include <memory>
#include <thread>

#include "devices/servo_thread.hpp"
#include "harness.hpp"
#include "net/certificates.hpp"
#include "net/raw_client.hpp"
#include "net/server.hpp"
#include "net/tls.hpp"

namespace tribo::bench {
namespace {

using net::test::RawClient;
using std::chrono::milliseconds;

constexpr const char* kProtocol = "bench.1";
constexpr int kClients = 16, kSilent = 4;
constexpr int kMessages = 2000;
constexpr std::size_t kMessageBytes = 1000;
// About what milling at full speed sends in a frame of the picture.
constexpr std::size_t kFrameBytes = 100'000;

std::unique_ptr<net::Server> start(bool tls, std::atomic<net::ClientId>& newest) {
    net::ServerOptions options;
    options.subprotocol = kProtocol;
    if (tls) {
        const auto pair = net::test::make_certificate();
        options.tls = net::make_tls_context({pair.certificate, pair.key, "", ""})->context;
    }
    net::ServerHandlers handlers;
    handlers.came = [&newest](net::ClientId id, const net::Arrival&) { newest = id; };
    return *net::Server::start(options, std::move(handlers));
}

// Sends one of them every millisecond, stamped; the client says how old it was when it was there, us.
std::vector<double> ages_us(bool tls) {
    std::atomic<net::ClientId> newest{0};
    const auto server = start(tls, newest);
    RawClient client(server->port(), tls ? RawClient::Over::tls : RawClient::Over::plain);
    if (!client.join(kProtocol)) return {};
    while (newest == 0) std::this_thread::yield();
    std::vector<double> ages;
    std::thread reader([&] {
        for (int n = 0; n < kMessages; ++n) {
            const auto frame = client.frame();
            if (!frame) return;
            double sent = 0;
            std::memcpy(&sent, frame->payload.data(), sizeof sent);
            ages.push_back(1e6 * (wall_s() - sent));
        }
    });
    for (int n = 0; n < kMessages; ++n) {
        auto bytes = std::make_shared<std::vector<std::uint8_t>>(kMessageBytes);
        const double now = wall_s();
        std::memcpy(bytes->data(), &now, sizeof now);
        server->send(newest, std::move(bytes));
        std::this_thread::sleep_for(milliseconds(1));
    }
    reader.join();
    return ages;
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void measure_messages(Report& report, bool tls) {
    const auto ages = ages_us(tls);
    const std::string how = tls ? ", TLS" : "";
    report.add({"1 kB from server to page, p50" + how, 1e-3 * quantile(ages, 0.5), "ms", 1});
    report.add({"1 kB from server to page, p99" + how, 1e-3 * quantile(ages, 0.99), "ms"});
}

// Five seconds of an empty tick at 1 kHz; with clients, frames go to all of them at 60 Hz meanwhile.
void measure_servo_beside(Report& report, bool with_clients) {
    std::atomic<net::ClientId> newest{0};
    const auto server = start(false, newest);
    std::vector<std::unique_ptr<RawClient>> clients;
    std::vector<std::thread> readers;
    for (int n = 0; with_clients && n < kClients; ++n) {
        const net::ClientId before = newest;
        clients.push_back(std::make_unique<RawClient>(server->port()));
        if (!clients.back()->join(kProtocol)) return;
        while (newest == before) std::this_thread::yield();
        server->send_text(newest, "hello");
        if (n >= kSilent) {
            readers.emplace_back([client = clients.back().get()] {
                while (client->frame()) continue;
            });
        }
    }
    int ticks = 0;
    devices::ServoThread loop({1000, true, false}, [&](double) { return ++ticks < 5000; });
    while (loop.running()) {
        server->send_all(std::make_shared<std::vector<std::uint8_t>>(kFrameBytes));
        std::this_thread::sleep_for(std::chrono::microseconds(16'667));
    }
    loop.join();
    for (const auto& client : clients) client->hang_up();
    for (std::thread& reader : readers) reader.join();
    const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
    const std::string how = with_clients ? ", 16 clients, 4 never read" : ", nobody there";
    if (!loop.granted().real_time.empty()) report.note(loop.granted().real_time);
    report.add({"servo lateness p50" + how, us(loop.lateness().quantile_ns(0.5)), "us"});
    report.add({"servo lateness p99" + how, us(loop.lateness().quantile_ns(0.99)), "us"});
    report.add({"servo lateness p99.9" + how, us(loop.lateness().quantile_ns(0.999)), "us"});
    report.add({"servo lateness max" + how, us(loop.lateness().max_ns()), "us"});
    report.add({"ticks skipped" + how, static_cast<double>(loop.skipped()), ""});
}

}  // namespace

void measure_live(Report& report) {
    report.section("The live server on loopback");
    measure_messages(report, false);
    measure_messages(report, true);
    report.section("The servo beside the live server, 6 MB/s to each client");
    measure_servo_beside(report, false);
    measure_servo_beside(report, true);
}

}  // namespace tribo::bench
