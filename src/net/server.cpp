// SPDX-License-Identifier: MIT
#include "net/server.hpp"

#include <algorithm>
#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <thread>
#include <utility>  // before Asio: Boost 1.74 uses std::exchange without it

namespace tribo::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Tcp = asio::ip::tcp;
using Request = http::request<http::empty_body>;
using Clock = std::chrono::steady_clock;

constexpr auto kRequestTime = std::chrono::seconds(30);   // for a request, or until the next one begins
constexpr auto kHandshakeTime = std::chrono::seconds(2);  // also for a client's last word
constexpr std::uint32_t kHeaderBytes = 16 * 1024;
constexpr std::size_t kControlMessages = 1000;
constexpr std::size_t kMostConnections = 256;

std::string_view view(boost::string_view s) {
    return {s.data(), s.size()};
}

// "name", "name:port", "[::1]:port" without the port.
std::string_view without_port(std::string_view host) {
    const std::size_t colon = host.rfind(':');
    if (colon == std::string_view::npos || host.find(']', colon) != std::string_view::npos) return host;
    return host.substr(0, colon);
}

// The value of `name` in the query of a target, undecoded.
std::string_view query_value(std::string_view target, std::string_view name) {
    std::size_t at = target.find('?');
    while (at != std::string_view::npos) {
        const std::size_t end = target.find('&', at + 1);
        const std::string_view pair =
            target.substr(at + 1, end == std::string_view::npos ? end : end - at - 1);
        if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=')
            return pair.substr(name.size() + 1);
        at = end;
    }
    return {};
}

// In a time that does not tell how much of it is right.
bool same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned differ = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        differ |= static_cast<unsigned char>(a[n]) ^ static_cast<unsigned char>(b[n]);
    return differ == 0;
}

class Client;

// What connections share; touched by the server's thread alone, except where it says otherwise.
struct Shared {
    ServerOptions options;
    ServerHandlers handlers;
    std::map<ClientId, std::weak_ptr<Client>> clients;
    std::atomic<std::size_t> client_count = 0;
    std::size_t connections = 0;
    ClientId next_id = 1;
    std::uint16_t port = 0;

    bool is_own_host(std::string_view host) const {
        const std::string_view name = without_port(host);
        if (name == "localhost" || name == "127.0.0.1" || name == "[::1]" || name == options.address)
            return true;
        return std::find(options.hosts.begin(), options.hosts.end(), name) != options.hosts.end();
    }
    // A page's origin must be the very host that it asks.
    bool is_own_origin(std::string_view origin, std::string_view host) const {
        const std::size_t slashes = origin.find("://");
        return slashes != std::string_view::npos && origin.substr(slashes + 3) == host;
    }
};

// One WebSocket: reads texts, writes one message at a time, control before data.
class Client : public std::enable_shared_from_this<Client> {
  public:
    Client(beast::tcp_stream&& stream, Shared& shared) : socket_(std::move(stream)), shared_(shared) {}

    void accept(const Request& request) {
        auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
        timeout.handshake_timeout = kHandshakeTime;
        socket_.set_option(timeout);
        socket_.set_option(websocket::stream_base::decorator([&](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, shared_.options.subprotocol);
        }));
        socket_.read_message_max(shared_.options.message_bytes);
        socket_.auto_fragment(false);
        beast::get_lowest_layer(socket_).socket().set_option(Tcp::no_delay(true));
        beast::get_lowest_layer(socket_).expires_never();
        socket_.async_accept(request, [self = shared_from_this()](error_code error) {
            if (!error) self->begin();
        });
    }

    void send_text(std::string text) {
        if (texts_.size() >= kControlMessages) {
            close(websocket::close_code::policy_error, "too many messages wait");
            return;
        }
        texts_.push_back(std::move(text));
        write();
    }

    void send(const Bytes& data) {
        while (!data_.empty() && waiting_bytes_ + data->size() > shared_.options.queue_bytes) {
            waiting_bytes_ -= data_.front()->size();
            data_.pop_front();
            lost_ = true;
        }
        data_.push_back(data);
        waiting_bytes_ += data->size();
        write();
    }

    void close(websocket::close_code code, const char* why) {
        if (std::exchange(closing_, true)) return;
        socket_.async_close(websocket::close_reason(code, why), [self = shared_from_this()](error_code) {});
    }

  private:
    void begin() {
        id_ = shared_.next_id++;
        shared_.clients[id_] = weak_from_this();
        shared_.client_count = shared_.clients.size();
        if (shared_.handlers.came) shared_.handlers.came(id_);
        read();
        watch();
    }

    // A client that broke the protocol is told so, and then waited for until it hangs up: not for long.
    void watch() {
        watch_.expires_after(kHandshakeTime);
        watch_.async_wait([weak = weak_from_this()](error_code error) {
            const auto self = weak.lock();
            if (error || !self) return;
            if (self->socket_.is_open()) return self->watch();
            beast::get_lowest_layer(self->socket_).close();
            self->end();
        });
    }

    void end() {
        if (id_ == 0) return;
        shared_.clients.erase(id_);
        shared_.client_count = shared_.clients.size();
        if (shared_.handlers.went) shared_.handlers.went(id_);
        id_ = 0;
    }

    void read() {
        socket_.async_read(in_, [self = shared_from_this()](error_code error, std::size_t) {
            if (error) return self->end();
            self->take();
        });
    }

    void take() {
        // Over two seconds at a time.
        const auto now = Clock::now();
        if (now - counted_from_ > std::chrono::seconds(2)) {
            counted_from_ = now;
            counted_ = 0;
        }
        if (++counted_ > 2 * shared_.options.messages_per_s) {
            close(websocket::close_code::policy_error, "too many messages");
            return end();
        }
        if (!socket_.got_text()) {
            close(websocket::close_code::bad_payload, "messages to the server are text");
            return end();
        }
        if (shared_.handlers.message) {
            const auto bytes = in_.data();
            shared_.handlers.message(id_, {static_cast<const char*>(bytes.data()), bytes.size()});
        }
        in_.consume(in_.size());
        if (!closing_) read();
    }

    void write() {
        if (writing_ || closing_) return;
        const auto done = [self = shared_from_this()](error_code error, std::size_t) {
            self->writing_ = false;
            if (error) return self->end();
            self->write();
        };
        if (!texts_.empty()) {
            text_out_ = std::move(texts_.front());
            texts_.pop_front();
            writing_ = true;
            socket_.text(true);
            socket_.async_write(asio::buffer(text_out_), done);
        } else if (!data_.empty()) {
            data_out_ = std::move(data_.front());
            data_.pop_front();
            waiting_bytes_ -= data_out_->size();
            writing_ = true;
            socket_.binary(true);
            socket_.async_write(asio::buffer(*data_out_), done);
        } else if (std::exchange(lost_, false) && shared_.handlers.lost) {
            shared_.handlers.lost(id_);
        }
    }

    websocket::stream<beast::tcp_stream> socket_;
    Shared& shared_;
    beast::flat_buffer in_;
    std::deque<std::string> texts_;
    std::deque<Bytes> data_;
    std::size_t waiting_bytes_ = 0;
    std::string text_out_;
    Bytes data_out_;
    bool writing_ = false, closing_ = false, lost_ = false;
    asio::steady_timer watch_{socket_.get_executor()};
    ClientId id_ = 0;
    Clock::time_point counted_from_ = Clock::now();
    int counted_ = 0;
};

// One connection as long as it speaks HTTP.
class Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(Tcp::socket&& socket, Shared& shared) : stream_(std::move(socket)), shared_(shared) {
        ++shared_.connections;
    }
    ~Connection() { --shared_.connections; }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void read() {
        parser_.emplace();
        parser_->header_limit(kHeaderBytes);
        parser_->body_limit(std::uint64_t{0});
        stream_.expires_after(kRequestTime);
        http::async_read(stream_, buffer_, *parser_,
                         [self = shared_from_this()](error_code error, std::size_t) {
                             if (!error) self->take(self->parser_->release());
                         });
    }

  private:
    void take(Request request) {
        const std::string_view host = view(request[http::field::host]);
        if (!shared_.is_own_host(host)) return refuse(request, "this server does not go by that name");
        if (websocket::is_upgrade(request)) {
            const std::string_view origin = view(request[http::field::origin]);
            const std::string_view token = query_value(view(request.target()), "token");
            if (!shared_.is_own_origin(origin, host)) return refuse(request, "the page is not this server's");
            if (view(request[http::field::sec_websocket_protocol]) != shared_.options.subprotocol)
                return refuse(request, "the subprotocol is not " + shared_.options.subprotocol);
            if (!same_secret(token, shared_.options.token)) return refuse(request, "the token is wrong");
            std::make_shared<Client>(std::move(stream_), shared_)->accept(request);
            return;
        }
        if (request.method() != http::verb::get && request.method() != http::verb::head)
            return answer(request, http::status::method_not_allowed, {"text/plain", "only GET\n", ""});
        std::string_view path = view(request.target());
        path = path.substr(0, path.find('?'));
        const bool gzip = view(request[http::field::accept_encoding]).find("gzip") != std::string_view::npos;
        const auto page = shared_.handlers.page ? shared_.handlers.page(path, gzip) : std::nullopt;
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
        response->set(http::field::cache_control, "no-cache");
        // Nothing else may embed or read the page; shared memory between its workers is allowed.
        response->set("Cross-Origin-Opener-Policy", "same-origin");
        response->set("Cross-Origin-Embedder-Policy", "require-corp");
        response->set("Cross-Origin-Resource-Policy", "same-origin");
        response->set("X-Content-Type-Options", "nosniff");
        response->set(
            "Content-Security-Policy",
            "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' "
            "'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; worker-src 'self' blob:");
        response->keep_alive(request.keep_alive() && status == http::status::ok);
        response->content_length(page.body.size());
        const bool head = request.method() == http::verb::head;
        auto serializer = std::make_shared<http::response_serializer<Body>>(*response);
        const auto done = [self = shared_from_this(), response, serializer](error_code error, std::size_t) {
            if (error) return;
            if (!response->keep_alive()) {
                error_code ignored;
                self->stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
                return;
            }
            self->read();
        };
        if (head) {
            serializer->split(true);
            http::async_write_header(stream_, *serializer, done);
        } else {
            http::async_write(stream_, *serializer, done);
        }
    }

    beast::tcp_stream stream_;
    Shared& shared_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    std::string text_;
};

}  // namespace

struct Server::Parts {
    Shared shared;  // outlives the connections, which the context holds
    asio::io_context context{1};
    Tcp::acceptor acceptor{context};
    std::thread thread;

    void accept() {
        acceptor.async_accept([this](error_code error, Tcp::socket socket) {
            if (error == asio::error::operation_aborted) return;
            if (!error && shared.connections < kMostConnections)
                std::make_shared<Connection>(std::move(socket), shared)->read();
            accept();
        });
    }

    template <class Action>
    void to_client(ClientId id, Action action) {
        asio::post(context, [this, id, action = std::move(action)] {
            const auto found = shared.clients.find(id);
            if (found == shared.clients.end()) return;
            if (const auto client = found->second.lock()) action(*client);
        });
    }
};

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
    parts_->thread = std::thread([p = parts_.get()] { p->context.run(); });
}

Server::~Server() {
    parts_->context.stop();
    parts_->thread.join();
}

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options, ServerHandlers handlers) {
    auto parts = std::make_unique<Parts>();
    parts->shared.options = options;
    parts->shared.handlers = std::move(handlers);
    error_code error;
    const auto address = asio::ip::make_address(options.address, error);
    if (error)
        return fail("'" + options.address + "' is no address",
                    "give an IP address, such as 127.0.0.1 or 0.0.0.0");
    const Tcp::endpoint endpoint(address, options.port);
    Tcp::acceptor& acceptor = parts->acceptor;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
        return fail("cannot listen on " + options.address + ", port " + std::to_string(options.port) + ": " +
                        error.message(),
                    "choose another with --port");
    }
    parts->shared.port = acceptor.local_endpoint().port();
    parts->accept();
    return std::unique_ptr<Server>(new Server(std::move(parts)));
}

std::uint16_t Server::port() const {
    return parts_->shared.port;
}

void Server::send_text(ClientId to, std::string text) {
    parts_->to_client(to, [text = std::move(text)](Client& client) { client.send_text(text); });
}

void Server::send_text_all(const std::string& text) {
    asio::post(parts_->context, [this, text] {
        for (const auto& [id, weak] : parts_->shared.clients) {
            if (const auto client = weak.lock()) client->send_text(text);
        }
    });
}

void Server::send(ClientId to, Bytes data) {
    parts_->to_client(to, [data = std::move(data)](Client& client) { client.send(data); });
}

void Server::send_all(const Bytes& data) {
    asio::post(parts_->context, [this, data] {
        for (const auto& [id, weak] : parts_->shared.clients) {
            if (const auto client = weak.lock()) client->send(data);
        }
    });
}

std::size_t Server::clients() const {
    return parts_->shared.client_count;
}

}  // namespace tribo::net
