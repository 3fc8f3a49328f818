// SPDX-License-Identifier: MIT
#include "net/websocket_client.hpp"

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <utility>  // before Beast: 1.74 does not include it

namespace tribo::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = asio::ip::tcp;

// A read that exceeds its time continues: cancelling would lose the state of the stream.
struct WebSocketClient::Connection {
    asio::io_context context;
    beast::websocket::stream<beast::tcp_stream, false> socket{context};
    beast::flat_buffer buffer;
    std::chrono::milliseconds timeout{0};
    bool reading = false, read = false, closed = false;

    // Runs the pending operations until `done` or until the time is over.
    bool run_until(const bool& done) {
        context.restart();
        const auto end = std::chrono::steady_clock::now() + timeout;
        while (!done && !closed && std::chrono::steady_clock::now() < end) {
            if (context.run_one_until(end) == 0 && context.stopped()) break;
        }
        return done;
    }
};

WebSocketClient::WebSocketClient(std::unique_ptr<Connection> connection)
    : connection_(std::move(connection)) {}
WebSocketClient::~WebSocketClient() = default;

Result<std::unique_ptr<WebSocketClient>> WebSocketClient::connect(const WebSocketAddress& address,
                                                                  int timeout_ms) {
    const std::string where = address.host + ":" + std::to_string(address.port);
    auto c = std::make_unique<Connection>();
    c->timeout = std::chrono::milliseconds(timeout_ms);
    beast::error_code error;
    const auto ip = asio::ip::make_address(address.host, error);
    if (error) return fail("'" + address.host + "' is not an address", "name one like 127.0.0.1");
    bool done = false;
    c->socket.next_layer().expires_after(c->timeout);
    c->socket.next_layer().async_connect(tcp::endpoint(ip, address.port), [&](beast::error_code e) {
        error = e;
        done = true;
    });
    if (!c->run_until(done)) {
        beast::get_lowest_layer(c->socket).cancel();
        c->context.restart();
        c->context.run();
        return fail("nobody answers at " + where, "start the service");
    }
    if (error) return fail("nobody listens at " + where + " (" + error.message() + ")", "start the service");
    done = false;
    c->socket.async_handshake(where, address.path, [&](beast::error_code e) {
        error = e;
        done = true;
    });
    if (!c->run_until(done)) {
        beast::get_lowest_layer(c->socket).cancel();
        c->context.restart();
        c->context.run();
        return fail("what listens at " + where + " does not answer", "see what else uses this port");
    }
    if (error) {
        return fail("what listens at " + where + " does not speak WebSocket (" + error.message() + ")",
                    "see what else uses this port");
    }
    beast::get_lowest_layer(c->socket).expires_never();
    c->socket.text(true);
    return std::unique_ptr<WebSocketClient>(new WebSocketClient(std::move(c)));
}

WebSocketClient::Got WebSocketClient::receive(std::string& text) {
    Connection& c = *connection_;
    if (c.closed) return Got::closed;
    if (!c.reading) {
        c.reading = true;
        c.read = false;
        c.socket.async_read(c.buffer, [&c](beast::error_code e, std::size_t) {
            c.read = true;
            c.closed = c.closed || e;
        });
    }
    if (!c.run_until(c.read)) return c.closed ? Got::closed : Got::late;
    c.reading = false;
    if (c.closed) return Got::closed;
    text = beast::buffers_to_string(c.buffer.data());
    c.buffer.consume(c.buffer.size());
    return Got::message;
}

bool WebSocketClient::send(std::string_view text) {
    Connection& c = *connection_;
    if (c.closed) return false;
    bool done = false;
    c.socket.async_write(asio::buffer(text), [&](beast::error_code e, std::size_t) {
        done = true;
        c.closed = c.closed || e;
    });
    if (!c.run_until(done)) {
        // The service does not accept data any more. The write refers to data that is about to be destroyed.
        beast::get_lowest_layer(c.socket).close();
        c.closed = true;
        c.context.restart();
        c.context.run();
        return false;
    }
    return !c.closed;
}

}  // namespace tribo::net
