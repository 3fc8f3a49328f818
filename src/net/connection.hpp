// SPDX-License-Identifier: MIT
// A TCP connection, plain or TLS, as one type: code on top of it is compiled only once. Only server.cpp
// includes this header, so that all of Beast stays in one translation unit.
#pragma once

#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>

namespace tribo::net {

class Connection {
  public:
    using Plain = boost::beast::tcp_stream;
    using Secure = boost::beast::ssl_stream<Plain>;
    using executor_type = Plain::executor_type;

    explicit Connection(boost::asio::ip::tcp::socket&& socket) : stream_(Plain(std::move(socket))) {}

    bool secure() const { return std::holds_alternative<Secure>(stream_); }
    // The TCP stream with its timeouts.
    Plain& next_layer() {
        Plain* plain = std::get_if<Plain>(&stream_);
        return plain ? *plain : std::get<Secure>(stream_).next_layer();
    }
    executor_type get_executor() { return next_layer().get_executor(); }
    // Numeric address of the server side.
    std::string local_address() {
        boost::system::error_code error;
        const auto end = next_layer().socket().local_endpoint(error);
        return error ? std::string() : unmapped(end.address()).to_string();
    }
    // Numeric address of the client. Of IPv6 only the network (64 bits): one machine may have all its
    // addresses.
    std::string client_network() {
        boost::system::error_code error;
        const auto end = next_layer().socket().remote_endpoint(error);
        if (error) return {};
        const boost::asio::ip::address address = unmapped(end.address());
        if (address.is_v4()) return address.to_string();
        auto bytes = address.to_v6().to_bytes();
        std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
        return boost::asio::ip::address_v6(bytes).to_string();
    }

    // Starts TLS as the server. `begun` holds the bytes that were already read. All later traffic is
    // encrypted.
    template <class Buffers, class Handler>
    void async_secure(boost::asio::ssl::context& context, const Buffers& begun, Handler&& handler) {
        Plain plain = std::move(std::get<Plain>(stream_));
        stream_.emplace<Secure>(std::move(plain), context)
            .async_handshake(Secure::server, begun, std::forward<Handler>(handler));
    }

    // Converts to one type of buffers and one type of handlers, so that the rest is compiled only once.
    template <class Buffers, class Handler>
    void async_read_some(const Buffers& buffers, Handler&& handler) {
        read_some(few<boost::asio::mutable_buffer>(buffers), Done(std::forward<Handler>(handler)));
    }
    template <class Buffers, class Handler>
    void async_write_some(const Buffers& buffers, Handler&& handler) {
        write_some(few<boost::asio::const_buffer>(buffers), Done(std::forward<Handler>(handler)));
    }

    // Beast calls this to close the connection of a WebSocket.
    template <class Handler>
    friend void async_teardown(boost::beast::role_type role, Connection& connection, Handler&& handler) {
        using boost::beast::websocket::async_teardown;
        std::move_only_function<void(boost::system::error_code)> done(std::forward<Handler>(handler));
        if (Secure* secure = std::get_if<Secure>(&connection.stream_))
            return secure->async_shutdown(std::move(done));
        async_teardown(role, std::get<Plain>(connection.stream_), std::move(done));
    }

  private:
    // IPv4 addresses come to a socket of both versions in the form of IPv6.
    static boost::asio::ip::address unmapped(const boost::asio::ip::address& address) {
        if (!address.is_v6() || !address.to_v6().is_v4_mapped()) return address;
        return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, address.to_v6());
    }

    using Done = std::move_only_function<void(boost::system::error_code, std::size_t)>;
    // Enough for the head and the body of a message. The next call takes the rest.
    static constexpr std::size_t kBuffers = 4;

    template <class Buffer, class Buffers>
    static std::array<Buffer, kBuffers> few(const Buffers& buffers) {
        std::array<Buffer, kBuffers> some;
        std::size_t n = 0;
        const auto end = boost::asio::buffer_sequence_end(buffers);
        for (auto it = boost::asio::buffer_sequence_begin(buffers); it != end && n < kBuffers; ++it) {
            const Buffer one(*it);
            if (one.size() > 0) some[n++] = one;
        }
        return some;
    }
    void read_some(const std::array<boost::asio::mutable_buffer, kBuffers>& buffers, Done done) {
        std::visit([&](auto& s) { s.async_read_some(buffers, std::move(done)); }, stream_);
    }
    void write_some(const std::array<boost::asio::const_buffer, kBuffers>& buffers, Done done) {
        std::visit([&](auto& s) { s.async_write_some(buffers, std::move(done)); }, stream_);
    }

    std::variant<Plain, Secure> stream_;
};

}  // namespace tribo::net
