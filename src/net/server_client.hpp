// SPDX-License-Identifier: MIT
// One WebSocket of a server. It reads text messages and writes one message at a time, control before data.
// A client that breaks a rule is closed with a reason. Only server.cpp includes this header (see
// connection.hpp).
#pragma once

#include <atomic>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "net/access_check.hpp"
#include "net/connection.hpp"
#include "net/seats.hpp"
#include "net/server.hpp"

namespace tribo::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Tcp = asio::ip::tcp;
using Request = http::request<http::empty_body>;
using Clock = std::chrono::steady_clock;

inline constexpr auto kHandshakeTime = std::chrono::seconds(2);  // also for a client's close frame
inline constexpr std::size_t kControlMessages = 1000;
// The client has connected again (RFC 6455, 7.4.2: codes 4000 to 4999 are private to the application).
inline constexpr websocket::close_code kTakenOver{4000};

class Client;

// State that all connections share. Only the server thread uses it, except for the atomic member.
struct Shared {
    explicit Shared(const ServerOptions& given)
        : options(given),
          access({given.subprotocol, given.token, given.hosts, given.tls != nullptr}),
          connections(given.connections, given.connections_per_address),
          client_seats(given.clients, given.clients_per_address) {}

    ServerOptions options;
    ServerHandlers handlers;
    AccessCheck access;
    std::optional<asio::ssl::context> tls;
    std::map<ClientId, std::weak_ptr<Client>> clients;
    std::atomic<std::size_t> client_count = 0;
    Seats connections, client_seats;
    ClientId next_id = 1;
    std::uint16_t port = 0;
};

class Client : public std::enable_shared_from_this<Client> {
  public:
    Client(Connection&& connection, Shared& shared) : socket_(std::move(connection)), shared_(shared) {}
    ~Client() { shared_.client_seats.leave(seat_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    // `address`: of the client. Idle until it is heard of.
    void accept(const Request& request, const Admission& admission, const std::string& address) {
        admission_ = admission;
        seat_ = shared_.client_seats.take(address, Clock::now(), [weak = weak_from_this()] {
            if (const auto self = weak.lock())
                self->disconnect(websocket::close_code::try_again_later,
                                 "silent, and another needs the place");
        });
        origin_ = std::string(request[http::field::origin]);
        auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
        timeout.handshake_timeout = kHandshakeTime;
        timeout.idle_timeout = kLongestSilence;  // with a ping after half of it
        socket_.set_option(timeout);
        socket_.set_option(websocket::stream_base::decorator([&](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, shared_.options.subprotocol);
        }));
        // Not read_message_max: it closes without a reason. take() checks the length.
        socket_.read_message_max(0);
        socket_.auto_fragment(false);
        socket_.control_callback([this](websocket::frame_type, beast::string_view) {
            heard();
            if (!too_many()) return;
            asio::post(socket_.get_executor(), [self = shared_from_this()] { self->disconnect_flood(); });
        });
        error_code ignored;  // the client may have disconnected already
        beast::get_lowest_layer(socket_).socket().set_option(Tcp::no_delay(true), ignored);
        beast::get_lowest_layer(socket_).expires_never();
        socket_.async_accept(request, [self = shared_from_this()](error_code error) {
            if (!error) self->begin();
        });
    }

    bool greeted() const { return greeted_; }

    void send_text(std::string text) {
        greeted_ = true;
        if (texts_.size() >= kControlMessages)
            return disconnect(websocket::close_code::policy_error, "too many unread texts");
        texts_.push_back(std::move(text));
        write();
    }

    void refuse(std::string text) {
        if (++refusals_ >= Server::kMostRefusals)
            return disconnect(websocket::close_code::policy_error, "too many messages that make no sense");
        send_text(std::move(text));
    }

    void send(const Bytes& data) {
        if (closing_) return;
        while (!data_.empty() && waiting_bytes_ + data->size() > shared_.options.queue_bytes) {
            waiting_bytes_ -= data_.front().counted_bytes;
            data_.pop_front();
            overflowed_ = true;
        }
        data_.push_back({data, data->size()});
        waiting_bytes_ += data->size();
        write();
    }

    void replay(const std::vector<Bytes>& data) {
        if (closing_) return;
        data_.clear();
        waiting_bytes_ = 0;
        for (const Bytes& one : data) data_.push_back({one, 0});
        write();
    }

    // Closes with a reason of at most 123 bytes, after the last words.
    void disconnect(websocket::close_code code, const std::string& why) {
        if (std::exchange(closing_, true)) return;
        if (id_ == 0) return beast::get_lowest_layer(socket_).close();  // before the handshake
        closing_since_ = Clock::now();
        closing_reason_ = websocket::close_reason(code, why);
        texts_.clear();
        data_.clear();
        waiting_bytes_ = 0;
        if (code != websocket::close_code::going_away && shared_.handlers.last_words)
            last_words_ = shared_.handlers.last_words(why);
        end();
        close();
    }

  private:
    // A message or an answer to a ping has come.
    void heard() { shared_.client_seats.set_idle_from(seat_, Clock::now() + kSilentTime); }

    void disconnect_flood() {
        disconnect(websocket::close_code::policy_error, "more than " +
                                                            std::to_string(shared_.options.messages_per_s) +
                                                            " messages a second for two seconds");
    }

    // Sends the last words and the close frame, once nothing else is being sent.
    void close() {
        if (writing_) return;
        const auto self = shared_from_this();
        if (last_words_.empty()) {
            socket_.async_close(closing_reason_, [self](error_code) {});
            return;
        }
        text_out_ = std::exchange(last_words_, {});
        writing_ = true;
        socket_.text(true);
        socket_.async_write(asio::buffer(text_out_), [self](error_code error, std::size_t) {
            self->writing_ = false;
            if (!error) self->close();
        });
    }

    void begin() {
        if (closing_) return;
        id_ = shared_.next_id++;
        if (const auto before = shared_.clients.find(admission_.previous); before != shared_.clients.end()) {
            if (const auto old = before->second.lock())
                old->disconnect(kTakenOver, "came back on another line");
        }
        shared_.clients[id_] = weak_from_this();
        shared_.client_count = shared_.clients.size();
        if (shared_.handlers.on_connect) {
            shared_.handlers.on_connect(
                id_, {admission_.resumed, shared_.access.resume_token(id_, origin_, Clock::now())});
        }
        read();
        watch();
        // A browser answers at once. Who never answers is idle.
        socket_.async_ping({}, [self = shared_from_this()](error_code) {});
    }

    // After a protocol error or disconnect() the client gets a close frame and kHandshakeTime to hang up.
    // Then the server closes the socket.
    void watch() {
        watch_.expires_after(kHandshakeTime);
        watch_.async_wait([weak = weak_from_this()](error_code error) {
            const auto self = weak.lock();
            if (error || !self) return;
            const bool late = self->closing_ && Clock::now() - self->closing_since_ >= kHandshakeTime;
            if (self->socket_.is_open() && !late) return self->watch();
            beast::get_lowest_layer(self->socket_).close();
            self->end();
        });
    }

    void end() {
        if (id_ == 0) return;
        const ClientId id = std::exchange(id_, 0);
        shared_.clients.erase(id);
        shared_.client_count = shared_.clients.size();
        shared_.access.on_disconnect(id, Clock::now());
        if (shared_.handlers.on_disconnect) shared_.handlers.on_disconnect(id);
    }

    // Reads in pieces, so that a message that is too long is refused before it is stored.
    void read() {
        const std::size_t room = shared_.options.message_bytes + 1 - in_.size();
        socket_.async_read_some(in_, room, [self = shared_from_this()](error_code error, std::size_t) {
            if (error) return self->end();
            self->take();
        });
    }

    void take() {
        if (closing_) return;
        if (in_.size() > shared_.options.message_bytes) {
            return disconnect(
                websocket::close_code::too_big,
                "a message may have at most " + std::to_string(shared_.options.message_bytes) + " bytes");
        }
        if (!socket_.is_message_done()) return read();
        heard();
        if (too_many()) return disconnect_flood();
        if (!socket_.got_text())
            return disconnect(websocket::close_code::unknown_data, "messages to the server are text");
        if (shared_.handlers.on_message) {
            const auto bytes = in_.data();
            const Taken taken =
                shared_.handlers.on_message(id_, {static_cast<const char*>(bytes.data()), bytes.size()});
            if (taken == Taken::too_many)
                return disconnect(websocket::close_code::policy_error, "too many messages wait");
            if (taken == Taken::too_much)
                return disconnect(websocket::close_code::too_big, "too many bytes of messages wait");
        }
        in_.consume(in_.size());
        read();
    }

    // Counts a message. The limit is checked over windows of two seconds.
    bool too_many() {
        const auto now = Clock::now();
        if (now - counted_from_ > std::chrono::seconds(2)) {
            counted_from_ = now;
            counted_ = 0;
        }
        return ++counted_ > 2 * shared_.options.messages_per_s;
    }

    void write() {
        if (writing_ || closing_) return;
        const auto done = [self = shared_from_this()](error_code error, std::size_t) {
            self->writing_ = false;
            if (error) return self->end();
            if (self->closing_) return self->close();
            self->write();
        };
        if (!texts_.empty()) {
            text_out_ = std::move(texts_.front());
            texts_.pop_front();
            writing_ = true;
            socket_.text(true);
            socket_.async_write(asio::buffer(text_out_), done);
        } else if (!data_.empty()) {
            data_out_ = std::move(data_.front().bytes);
            waiting_bytes_ -= data_.front().counted_bytes;
            data_.pop_front();
            writing_ = true;
            socket_.binary(true);
            socket_.async_write(asio::buffer(*data_out_), done);
        } else {
            data_out_.reset();
            if (std::exchange(overflowed_, false) && shared_.handlers.on_overflow)
                shared_.handlers.on_overflow(id_);
        }
    }

    websocket::stream<Connection, false> socket_;  // no message is compressed
    Shared& shared_;
    Admission admission_;
    std::string origin_;
    beast::flat_buffer in_;
    std::deque<std::string> texts_;
    struct Data {
        Bytes bytes;
        std::size_t counted_bytes = 0;  // for queue_bytes
    };
    std::deque<Data> data_;
    std::size_t waiting_bytes_ = 0;
    std::string text_out_, last_words_;
    websocket::close_reason closing_reason_;
    Seats::Id seat_ = 0;
    Bytes data_out_;
    bool writing_ = false, closing_ = false, overflowed_ = false, greeted_ = false;
    asio::steady_timer watch_{socket_.get_executor()};
    ClientId id_ = 0;
    Clock::time_point counted_from_ = Clock::now(), closing_since_;
    int counted_ = 0, refusals_ = 0;
};

}  // namespace tribo::net
