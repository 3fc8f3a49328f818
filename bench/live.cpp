// SPDX-License-Identifier: MIT
// The live server: how long a kilobyte takes from the engine to a page on the same machine.
#include <atomic>
#include <cstring>
#include <memory>
#include <thread>

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
constexpr int kMessages = 2000;
constexpr std::size_t kMessageBytes = 1000;

std::unique_ptr<net::Server> start(bool tls, std::atomic<net::ClientId>& newest) {
    net::ServerOptions options;
    options.subprotocol = kProtocol;
    if (tls) {
        const auto pair = net::test::make_certificate();
        options.tls = net::make_tls_context({pair.certificate, pair.key, "", ""})->context;
    }
    net::ServerHandlers handlers;
    handlers.on_connect = [&newest](net::ClientId id, const net::ResumeInfo&) { newest = id; };
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

}  // namespace

void measure_live(Report& report) {
    report.section("The live server on loopback");
    measure_messages(report, false);
    measure_messages(report, true);
    measure_live_servo(report);
}

}  // namespace tribo::bench
