// SPDX-License-Identifier: MIT
// One WebSocket of a server: reads texts, writes one message at a time, control before data, and is cut off
// with a reason where it does what none should. For server.cpp alone (line.hpp says why).
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

#include "net/gate.hpp"
#include "net/line.hpp"
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

inline constexpr auto kHandshakeTime = std::chrono::seconds(2);  // also for a client's last word
inline constexpr std::size_t kControlMessages = 1000;
// The client came back on another line (RFC 6455, 7.4.2: 4000 to 4999 are the application's).
inline constexpr websocket::close_code kTakenOver{4000};

class Client;

// What connections share; touched by the server's thread alone, except where it says otherwise.
struct Shared {
    explicit Shared(const ServerOptions& given)
        : options(given), gate({given.subprotocol, given.token, given.hosts, given.tls != nullptr}) {}

    ServerOptions options;
    ServerHandlers handlers;
    Gate gate;
    std::optional<asio::ssl::context> tls;
    std::map<ClientId, std::weak_ptr<Client>> clients;
    std::atomic<std::size_t> client_count = 0;
    std::size_t connections = 0;
    ClientId next_id = 1;
    std::uint16_t port = 0;
};

class Client : public std::enable_shared_from_this<Client> {
  public:
    Client(Line&& line, Shared& shared) : socket_(std::move(line)), shared_(shared) {}

    void accept(const Request& request, const Admission& admission) {
        admission_ = admission;
        origin_ = std::string(request[http::field::origin]);
        auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
        timeout.handshake_timeout = kHandshakeTime;
        socket_.set_option(timeout);
        socket_.set_option(websocket::stream_base::decorator([&](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, shared_.options.subprotocol);
        }));
        // Not by read_message_max, which closes without a word.
        socket_.read_message_max(0);
        socket_.auto_fragment(false);
        socket_.control_callback([this](websocket::frame_type, beast::string_view) {
            if (!too_many()) return;
            asio::post(socket_.get_executor(), [self = shared_from_this()] {
                self->cut_off(websocket::close_code::policy_error, "too many messages");
            });
        });
        error_code ignored;  // of a client that has gone already
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
            return cut_off(websocket::close_code::policy_error, "too many messages wait");
        texts_.push_back(std::move(text));
        write();
    }

    void refuse(std::string text) {
        if (++refusals_ >= Server::kMostRefusals)
            return cut_off(websocket::close_code::policy_error, "too many messages that make no sense");
        send_text(std::move(text));
    }

    void send(const Bytes& data) {
        if (closing_) return;
        while (!data_.empty() && waiting_bytes_ + data->size() > shared_.options.queue_bytes) {
            waiting_bytes_ -= data_.front()->size();
            data_.pop_front();
            lost_ = true;
        }
        data_.push_back(data);
        waiting_bytes_ += data->size();
        write();
    }

    // Says why (at most 123 bytes) and is done with it.
    void cut_off(websocket::close_code code, const std::string& why) {
        if (std::exchange(closing_, true)) return;
        closing_since_ = Clock::now();
        texts_.clear();
        data_.clear();
        waiting_bytes_ = 0;
        socket_.async_close(websocket::close_reason(code, why), [self = shared_from_this()](error_code) {});
        end();
    }

  private:
    void begin() {
        id_ = shared_.next_id++;
        if (const auto before = shared_.clients.find(admission_.before); before != shared_.clients.end()) {
            if (const auto old = before->second.lock()) old->cut_off(kTakenOver, "came back on another line");
        }
        shared_.clients[id_] = weak_from_this();
        shared_.client_count = shared_.clients.size();
        if (shared_.handlers.came) {
            shared_.handlers.came(
                id_, {admission_.resumed, shared_.gate.resume_token(id_, origin_, Clock::now())});
        }
        read();
        watch();
    }

    // A client that broke the protocol, or is cut off, is told so and then waited for until it hangs up: not
    // for long.
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
        shared_.gate.left(id, Clock::now());
        if (shared_.handlers.went) shared_.handlers.went(id);
    }

    // A piece at a time, so that a message that is too long is refused before it is kept.
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
            return cut_off(
                websocket::close_code::too_big,
                "a message may have at most " + std::to_string(shared_.options.message_bytes) + " bytes");
        }
        if (!socket_.is_message_done()) return read();
        if (too_many()) return cut_off(websocket::close_code::policy_error, "too many messages");
        if (!socket_.got_text())
            return cut_off(websocket::close_code::unknown_data, "messages to the server are text");
        if (shared_.handlers.message) {
            const auto bytes = in_.data();
            shared_.handlers.message(id_, {static_cast<const char*>(bytes.data()), bytes.size()});
        }
        in_.consume(in_.size());
        read();
    }

    // Counts one, over two seconds at a time.
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
        } else {
            data_out_.reset();
            if (std::exchange(lost_, false) && shared_.handlers.lost) shared_.handlers.lost(id_);
        }
    }

    websocket::stream<Line> socket_;
    Shared& shared_;
    Admission admission_;
    std::string origin_;
    beast::flat_buffer in_;
    std::deque<std::string> texts_;
    std::deque<Bytes> data_;
    std::size_t waiting_bytes_ = 0;
    std::string text_out_;
    Bytes data_out_;
    bool writing_ = false, closing_ = false, lost_ = false, greeted_ = false;
    asio::steady_timer watch_{socket_.get_executor()};
    ClientId id_ = 0;
    Clock::time_point counted_from_ = Clock::now(), closing_since_;
    int counted_ = 0, refusals_ = 0;
};

}  // namespace tribo::net
