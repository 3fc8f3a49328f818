// SPDX-License-Identifier: MIT
#include "net/server.hpp"

#include <boost/asio/ip/v6_only.hpp>
#include <thread>

#include "net/connection.hpp"
#include "net/server_client.hpp"

namespace tribo::net {
namespace {

constexpr auto kRequestTime = std::chrono::seconds(30);  // for a request, or until the next one begins
constexpr auto kTlsTime = std::chrono::seconds(10);      // for the handshake of TLS
constexpr auto kPause = std::chrono::milliseconds(100);
constexpr std::uint32_t kHeaderBytes = 16 * 1024;
constexpr auto kAnswerTime = std::chrono::seconds(5);          // an answer that takes longer counts as idle
constexpr auto kOverTime = std::chrono::milliseconds(50);      // between two checks of is_over
constexpr auto kGoodbyeTime = std::chrono::milliseconds(300);  // for the answers to the close frames
constexpr auto kGoodbyeCheck = std::chrono::milliseconds(5);

std::string_view view(boost::string_view s) {
    return {s.data(), s.size()};
}

// One connection while it uses HTTP.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
  public:
    HttpSession(Tcp::socket&& socket, Shared& shared) : connection_(std::move(socket)), shared_(shared) {}
    ~HttpSession() { shared_.connections.leave(seat_); }
    HttpSession(const HttpSession&) = delete;
    HttpSession& operator=(const HttpSession&) = delete;

    // Closes at once if there is no room.
    void begin() {
        address_ = connection_.client_network();
        if (!shared_.connections.make_room(address_, Clock::now())) return;
        seat_ = shared_.connections.take(address_, Clock::now(), [weak = weak_from_this()] {
            if (const auto self = weak.lock()) self->connection_.next_layer().close();
        });
        local_address_ = connection_.local_address();
        if (!shared_.tls) return read();
        connection_.next_layer().expires_after(kTlsTime);
        beast::async_detect_ssl(connection_.next_layer(), buffer_,
                                [self = shared_from_this()](error_code error, bool secure) {
                                    if (error) return;
                                    // A client without TLS is redirected.
                                    secure ? self->secure() : self->read();
                                });
    }

  private:
    void secure() {
        connection_.async_secure(*shared_.tls, buffer_.data(),
                                 [self = shared_from_this()](error_code error, std::size_t used) {
                                     if (error) return;
                                     self->buffer_.consume(used);
                                     self->read();
                                 });
    }

    void read() {
        parser_.emplace();
        parser_->header_limit(kHeaderBytes);
        parser_->body_limit(std::uint64_t{0});
        connection_.next_layer().expires_after(kRequestTime);
        shared_.connections.set_idle_from(seat_, Clock::now());
        http::async_read(connection_, buffer_, *parser_,
                         [self = shared_from_this()](error_code error, std::size_t) {
                             if (error) return self->refuse_broken(error);
                             self->shared_.connections.set_idle_from(self->seat_, Clock::now() + kAnswerTime);
                             self->take(self->parser_->release());
                         });
    }

    // What is no request gets an answer. Connections that end or that time out get none.
    void refuse_broken(error_code error) {
        static const auto& of_http = make_error_code(http::error::bad_version).category();
        if (error.category() != of_http || error == http::error::end_of_stream) return;
        if (error == http::error::header_limit)
            return answer({}, http::status::request_header_fields_too_large,
                          {"text/plain", "the header is too long\n", ""});
        if (error == http::error::body_limit)
            return answer({}, http::status::payload_too_large, {"text/plain", "no body, please\n", ""});
        answer({}, http::status::bad_request, {"text/plain", "this is no HTTP/1.1 request\n", ""});
    }

    void take(Request request) {
        const std::string_view host = view(request[http::field::host]);
        const std::string_view target = view(request.target());
        if (!shared_.access.is_own_name(host, local_address_))
            return refuse(request, "this server does not go by that name");
        if (shared_.tls && !connection_.secure()) {
            location_ = "https://" + std::string(host) + std::string(target);
            return answer(request, http::status::permanent_redirect,
                          {"text/plain", "this server speaks https\n", ""});
        }
        if (websocket::is_upgrade(request)) {
            const auto admitted = shared_.access.admit(
                {host, view(request[http::field::origin]), view(request[http::field::sec_websocket_protocol]),
                 target, local_address_},
                Clock::now());
            if (!admitted) return refuse(request, admitted.error());
            if (!shared_.client_seats.make_room(address_, Clock::now()))
                return answer(request, http::status::service_unavailable,
                              {"text/plain", "too many viewers are connected\n", ""});
            std::make_shared<Client>(std::move(connection_), shared_)->accept(request, *admitted, address_);
            return;
        }
        if (request.method() != http::verb::get && request.method() != http::verb::head)
            return answer(request, http::status::method_not_allowed, {"text/plain", "only GET\n", ""});
        const std::string_view path = target.substr(0, target.find('?'));
        http::ext_list codings(request[http::field::accept_encoding]);
        const AcceptedEncodings accepted{codings.exists("br"), codings.exists("gzip")};
        const auto page = shared_.handlers.on_get ? shared_.handlers.on_get(path, accepted) : std::nullopt;
        if (!page) return answer(request, http::status::not_found, {"text/plain", "nothing here\n", ""});
        answer(request, http::status::ok, *page);
    }

    void refuse(const Request& request, const std::string& why) {
        text_ = why + "\n";
        answer(request, http::status::forbidden, {"text/plain", text_, ""});
    }

    void answer(const Request& request, http::status status, const Page& page) {
        using Body = http::span_body<const char>;
        const boost::beast::span<const char> body(page.body.data(), page.body.size());
        auto response = std::make_shared<http::response<Body>>(
            std::piecewise_construct, std::make_tuple(body), std::make_tuple(status, request.version()));
        response->set(http::field::content_type, page.content_type);
        if (!page.encoding.empty())
            response->set(http::field::content_encoding, {page.encoding.data(), page.encoding.size()});
        response->set(http::field::vary, "Accept-Encoding");
        response->set(http::field::cache_control, "no-cache");
        // Other sites must not embed or read the page; shared memory between its workers is allowed.
        response->set("Cross-Origin-Opener-Policy", "same-origin");
        response->set("Cross-Origin-Embedder-Policy", "require-corp");
        response->set("Cross-Origin-Resource-Policy", "same-origin");
        response->set("X-Content-Type-Options", "nosniff");
        response->set("Referrer-Policy", "no-referrer");  // the address may contain the token
        response->set("Content-Security-Policy",
                      "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' "
                      "'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; worker-src 'self' "
                      "blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
        if (!location_.empty()) response->set(http::field::location, location_);
        response->keep_alive(request.keep_alive() && status == http::status::ok);
        response->content_length(page.body.size());
        const bool head = request.method() == http::verb::head;
        auto serializer = std::make_shared<http::response_serializer<Body>>(*response);
        const auto done = [self = shared_from_this(), response, serializer](error_code error, std::size_t) {
            if (error) return;
            if (!response->keep_alive()) {
                async_teardown(beast::role_type::server, self->connection_, [self](error_code) {});
                return;
            }
            self->read();
        };
        if (head) {
            serializer->split(true);
            http::async_write_header(connection_, *serializer, done);
        } else {
            http::async_write(connection_, *serializer, done);
        }
    }

    Connection connection_;
    Shared& shared_;
    beast::flat_buffer buffer_;
    Seats::Id seat_ = 0;
    std::string address_, local_address_, location_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    std::string text_;
};

}  // namespace

struct Server::Parts {
    explicit Parts(const ServerOptions& options) : shared(options) {}

    Shared shared;  // outlives the connections, which the context holds
    asio::io_context context{1};
    Tcp::acceptor acceptor{context};
    asio::steady_timer pause{context}, over{context}, goodbye{context};
    std::thread thread;

    void accept() {
        acceptor.async_accept([this](error_code error, Tcp::socket socket) {
            if (error == asio::error::operation_aborted) return;
            if (!error) {
                std::make_shared<HttpSession>(std::move(socket), shared)->begin();
                return accept();
            }
            // The system has no resources for another connection. Pause instead of retrying at once.
            pause.expires_after(kPause);
            pause.async_wait([this](error_code stopped) {
                if (!stopped) accept();
            });
        });
    }

    void watch_is_over() {
        if (!shared.options.is_over) return;
        over.expires_after(kOverTime);
        over.async_wait([this](error_code stopped) {
            if (stopped) return;
            if (shared.options.is_over()) return say_goodbye();
            watch_is_over();
        });
    }

    // Accepts no more, and sends the close frames.
    void say_goodbye() {
        error_code ignored;
        acceptor.close(ignored);
        pause.cancel();
        // To disconnect a client removes it.
        for (const auto& [id, weak] : std::map(shared.clients)) {
            if (const auto client = weak.lock())
                client->disconnect(websocket::close_code::going_away, "the engine ends");
        }
    }

    // Stops once all clients have answered, or after the time.
    void stop_by(Clock::time_point last) {
        if (shared.client_seats.taken() == 0 || Clock::now() >= last) return context.stop();
        goodbye.expires_after(kGoodbyeCheck);
        goodbye.async_wait([this, last](error_code) { stop_by(last); });
    }

    template <class Action>
    void to_client(ClientId id, Action action) {
        asio::post(context, [this, id, action = std::move(action)] {
            const auto found = shared.clients.find(id);
            if (found == shared.clients.end()) return;
            if (const auto client = found->second.lock()) action(*client);
        });
    }

    // Acts on all clients that have received their greeting.
    template <class Action>
    void to_all(Action action) {
        asio::post(context, [this, action = std::move(action)] {
            // The action on one client may end it.
            std::vector<std::shared_ptr<Client>> greeted;
            for (const auto& [id, weak] : shared.clients) {
                if (auto client = weak.lock(); client && client->greeted())
                    greeted.push_back(std::move(client));
            }
            for (const auto& client : greeted) action(*client);
        });
    }
};

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
    parts_->thread = std::thread([p = parts_.get()] { p->context.run(); });
}

Server::~Server() {
    asio::post(parts_->context, [p = parts_.get()] {
        p->over.cancel();
        p->say_goodbye();
        p->stop_by(Clock::now() + kGoodbyeTime);
    });
    parts_->thread.join();
}

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options, ServerHandlers handlers) {
    auto parts = std::make_unique<Parts>(options);
    parts->shared.handlers = std::move(handlers);
    if (options.tls) {
        // The context of Asio is another owner.
        SSL_CTX_up_ref(options.tls.get());
        parts->shared.tls.emplace(options.tls.get());
    }
    error_code error;
    const auto address = asio::ip::make_address(options.address, error);
    if (error)
        return fail("'" + options.address + "' is no address",
                    "give an IP address, such as 127.0.0.1 or 0.0.0.0");
    const Tcp::endpoint endpoint(address, options.port);
    Tcp::acceptor& acceptor = parts->acceptor;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    // The IPv6 wildcard also accepts IPv4.
    if (!error && address.is_v6()) acceptor.set_option(asio::ip::v6_only(false), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
        return fail("cannot listen on " + options.address + ", port " + std::to_string(options.port) + ": " +
                        error.message(),
                    error == asio::error::address_in_use || error == asio::error::access_denied
                        ? "choose another with --port"
                        : "listen on an address that this machine has, such as 127.0.0.1 or 0.0.0.0");
    }
    parts->shared.port = acceptor.local_endpoint().port();
    parts->accept();
    parts->watch_is_over();
    return std::unique_ptr<Server>(new Server(std::move(parts)));
}

std::uint16_t Server::port() const {
    return parts_->shared.port;
}

void Server::send_text(ClientId to, std::string text) {
    parts_->to_client(to, [text = std::move(text)](Client& client) { client.send_text(text); });
}

void Server::send_text_all(const std::string& text) {
    parts_->to_all([text](Client& client) { client.send_text(text); });
}

void Server::refuse(ClientId client, std::string text) {
    parts_->to_client(client, [text = std::move(text)](Client& c) { c.refuse(text); });
}

void Server::send(ClientId to, Bytes data) {
    parts_->to_client(to, [data = std::move(data)](Client& client) { client.send(data); });
}

void Server::send_all(const Bytes& data) {
    parts_->to_all([data](Client& client) { client.send(data); });
}

void Server::replay(ClientId to, std::vector<Bytes> data) {
    parts_->to_client(to, [data = std::move(data)](Client& client) { client.replay(data); });
}

void Server::disconnect(ClientId client, std::string why) {
    parts_->to_client(client, [why = std::move(why)](Client& c) {
        c.disconnect(websocket::close_code::policy_error, why);
    });
}

std::size_t Server::clients() const {
    return parts_->shared.client_count;
}

}  // namespace tribo::net
