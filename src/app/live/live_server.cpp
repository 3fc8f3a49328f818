// SPDX-License-Identifier: MIT
#include "app/live/live_server.hpp"

#include <algorithm>
#include <cstdio>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/live/browser.hpp"
#include "base/text/printable.hpp"
#include "net/addresses.hpp"
#include "net/secret.hpp"
#include "net/tls.hpp"
#include "protocol/live_message.hpp"

namespace tribo::app {
namespace {

// A certificate with its whole chain has a few kilobytes.
constexpr std::uint64_t kLargestPemBytes = 1'000'000;

FileResult<net::TlsContext> read_tls(const LiveCall& call) {
    net::TlsKeys keys{{}, {}, call.tls_certificate, call.tls_key};
    auto certificate = files::read_file(keys.certificate_file, kLargestPemBytes);
    if (!certificate) return std::unexpected(FileFailure(certificate.error(), FileFault::input));
    auto key = files::read_file(keys.key_file, kLargestPemBytes);
    if (!key) return std::unexpected(FileFailure(key.error(), FileFault::input));
    keys.certificate_pem = *std::move(certificate);
    keys.key_pem = *std::move(key);
    auto context = net::make_tls_context(keys);
    if (!context) return std::unexpected(FileFailure(context.error()));
    return *std::move(context);
}

void warn_of(const net::ServerOptions& options) {
    if (options.token.empty() || options.tls) return;
    std::fprintf(
        stderr,
        "warning: other machines get this page in the clear: whoever is on the same network can read the "
        "token along,\nand phones and headsets give a page without TLS neither sound nor virtual reality; "
        "give --tls-cert and --tls-key\n");
}

}  // namespace

FileResult<net::ServerOptions> live_server_options(const LiveCall& call) {
    net::ServerOptions options;
    options.address = call.listen;
    options.port = call.port;
    options.subprotocol = kLiveSubprotocol;
    // The clients learn of the end even while the picture is busy.
    options.is_over = [] { return interrupted().load(); };
    if (!call.tls_certificate.empty()) {
        auto tls = read_tls(call);
        if (!tls) return std::unexpected(tls.error());
        options.tls = tls->context;
        // The names of this server are those of the certificate.
        options.hosts = tls->names;
    }
    if (net::is_loopback(call.listen)) return options;
    options.token = net::random_token();
    if (const std::string name = net::host_name(); !name.empty()) {
        options.hosts.push_back(name);
        if (name.find('.') == std::string::npos) options.hosts.push_back(name + ".local");  // as by mDNS
    }
    return options;
}

std::vector<std::string> live_urls(const net::ServerOptions& options, std::uint16_t port) {
    const bool every = net::is_every_address(options.address);
    std::vector<std::string> hosts;
    // With another name than that of the certificate, browsers show a warning.
    if (options.tls) hosts = options.hosts;
    if (!options.tls) hosts.push_back(every ? "127.0.0.1" : options.address);
    if (every) {
        for (const std::string& address : net::own_addresses()) hosts.push_back(address);
    }
    if (hosts.empty()) hosts.push_back(options.address);
    std::vector<std::string> urls;
    for (const std::string& host : hosts) {
        std::string url = (options.tls ? "https://" : "http://") + net::in_url(host) + ":" +
                          std::to_string(port) + "/" +
                          (options.token.empty() ? "" : "?token=" + options.token);
        if (std::find(urls.begin(), urls.end(), url) == urls.end()) urls.push_back(std::move(url));
    }
    return urls;
}

std::string live_last_words(std::string_view why) {
    return protocol::live_refusal({"", 0, 0, std::string(why), "the limits stand in docs/live-protocol.md"});
}

FileResult<WebFiles> live_page(const LiveCall& call) {
    const std::string root = call.web_root.empty() ? WebFiles::folder_of("viewer") : call.web_root;
    if (root.empty()) {
        return std::unexpected(
            FileFailure({"", 0, 0, "this build has no page to show",
                         "build it with Node.js there, or name a folder with --web-root"}));
    }
    return WebFiles::read(root);
}

std::unique_ptr<net::Server> open_live_server(const LiveCall& call, const std::string& what,
                                              net::ServerHandlers handlers, int& exit_code) {
    const auto options = live_server_options(call);
    if (!options) {
        exit_code = report(options.error());
        return nullptr;
    }
    auto server = net::Server::start(*options, std::move(handlers));
    if (!server) {
        report(server.error());
        exit_code = kRefused;
        return nullptr;
    }
    const std::vector<std::string> urls = live_urls(*options, (*server)->port());
    std::printf("%s is live at %s (Ctrl-C ends it)\n", printable(what).c_str(), urls.front().c_str());
    for (std::size_t n = 1; n < urls.size(); ++n) std::printf("  also at %s\n", urls[n].c_str());
    std::fflush(stdout);
    warn_of(*options);
    if (call.open) open_browser(urls.front(), !options->token.empty());
    return *std::move(server);
}

}  // namespace tribo::app
