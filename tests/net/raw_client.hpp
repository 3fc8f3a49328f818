// SPDX-License-Identifier: MIT
// HTTP and WebSocket by hand on a socket, plain or in TLS, so that a test can also send what no library
// would.
#pragma once

#include <algorithm>
#include <arpa/inet.h>
#include <cstdint>
#include <memory>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace tribo::net::test {

class RawClient {
  public:
    enum class Over { plain, tls };
    explicit RawClient(std::uint16_t port, Over over = Over::plain)
        : port_(port), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        const timeval patience{20, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
        const int on = 1;
        ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
        if (!connected_ || over == Over::plain) return;
        context_.reset(SSL_CTX_new(TLS_client_method()));
        tls_.reset(SSL_new(context_.get()));
        SSL_set_fd(tls_.get(), socket_);
        connected_ = SSL_connect(tls_.get()) == 1;
    }
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;
    ~RawClient() { ::close(socket_); }

    // Ends what another thread waits for.
    void hang_up() { ::shutdown(socket_, SHUT_RDWR); }
    bool connected() const { return connected_; }
    std::string host() const { return "127.0.0.1:" + std::to_string(port_); }

    // False once the other side has gone.
    bool send(const std::string& bytes) {
        std::size_t done = 0;
        while (done < bytes.size()) {
            const char* from = bytes.data() + done;
            const ssize_t n = tls_ ? SSL_write(tls_.get(), from, static_cast<int>(bytes.size() - done))
                                   : ::send(socket_, from, bytes.size() - done, MSG_NOSIGNAL);
            if (n <= 0) return false;
            done += static_cast<std::size_t>(n);
        }
        return true;
    }

    // The header of an answer, with its blank line; the body is left.
    std::string header() {
        std::string text;
        while (!text.ends_with("\r\n\r\n")) {
            const auto c = byte();
            if (!c) break;
            text += static_cast<char>(*c);
        }
        return text;
    }

    std::string bytes(std::size_t count) {
        std::string text;
        while (text.size() < count && more()) {
            const std::size_t some = std::min(count - text.size(), in_.size() - at_);
            text.append(in_, at_, some);
            at_ += some;
        }
        return text;
    }

    // A whole GET: header and body by its Content-Length.
    std::string get(const std::string& target, const std::string& more = {}) {
        send("GET " + target + " HTTP/1.1\r\nHost: " + host() + "\r\n" + more + "\r\n");
        std::string text = header();
        const std::size_t at = text.find("Content-Length: ");
        if (at != std::string::npos) text += bytes(std::stoul(text.substr(at + 16)));
        return text;
    }

    std::string upgrade(const std::string& target, const std::string& protocol, const std::string& origin,
                        const std::string& as_host) {
        send("GET " + target + " HTTP/1.1\r\nHost: " + as_host +
             "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: " +
             protocol + "\r\nOrigin: " + origin + "\r\n\r\n");
        return header();
    }
    bool join(const std::string& protocol) {
        return upgrade("/live", protocol, origin(), host()).starts_with("HTTP/1.1 101");
    }
    std::string origin() const { return (tls_ ? "https://" : "http://") + host(); }

    // One masked frame (RFC 6455 5.2); opcode 1 text, 2 binary, 8 close.
    bool send_frame(int opcode, const std::string& payload) {
        std::string frame(1, static_cast<char>(0x80 | opcode));
        if (payload.size() < 126) {
            frame += static_cast<char>(0x80 | payload.size());
        } else {
            const bool two = payload.size() < 65536;
            frame += static_cast<char>(0x80 | (two ? 126 : 127));
            for (int shift = two ? 8 : 56; shift >= 0; shift -= 8)
                frame += static_cast<char>(payload.size() >> shift & 0xff);
        }
        const std::string mask = "\x11\x22\x33\x44";
        frame += mask;
        for (std::size_t n = 0; n < payload.size(); ++n) frame += static_cast<char>(payload[n] ^ mask[n % 4]);
        return send(frame);
    }

    struct Frame {
        int opcode = 0;
        std::string payload;
    };
    // The code and the words with which the other side closes, after what else it sends; 0 where it just
    // goes.
    struct Closing {
        int code = 0;
        std::string why;
    };
    Closing closing() {
        while (const auto one = frame()) {
            if (one->opcode != 8 || one->payload.size() < 2) continue;
            const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(one->payload[n]); };
            return {byte(0) << 8 | byte(1), one->payload.substr(2)};
        }
        return {};
    }
    // The next frame that is no ping. Pings are answered (RFC 6455 5.5.2).
    std::optional<Frame> frame() {
        for (;;) {
            auto one = any_frame();
            if (!one || one->opcode != 9) return one;
            send_frame(10, one->payload);
        }
    }
    std::optional<Frame> any_frame() {
        const std::string head = bytes(2);
        if (head.size() < 2) return std::nullopt;
        std::uint64_t size = static_cast<unsigned char>(head[1]) & 0x7f;
        if (size >= 126) {
            const std::string longer = bytes(size == 126 ? 2 : 8);
            size = 0;
            for (const char c : longer) size = size << 8 | static_cast<unsigned char>(c);
        }
        Frame frame{static_cast<unsigned char>(head[0]) & 0x0f, bytes(size)};
        if (frame.payload.size() < size) return std::nullopt;
        return frame;
    }

  private:
    std::optional<unsigned char> byte() {
        if (!more()) return std::nullopt;
        return static_cast<unsigned char>(in_[at_++]);
    }
    // Whether there is something to take; waits for it.
    bool more() {
        if (at_ < in_.size()) return true;
        in_.resize(65536);
        const ssize_t n = tls_ ? SSL_read(tls_.get(), in_.data(), static_cast<int>(in_.size()))
                               : ::recv(socket_, in_.data(), in_.size(), 0);
        in_.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
        at_ = 0;
        return n > 0;
    }

    struct Free {
        void operator()(SSL_CTX* p) const { SSL_CTX_free(p); }
        void operator()(SSL* p) const { SSL_free(p); }
    };
    std::uint16_t port_;
    int socket_;
    std::unique_ptr<SSL_CTX, Free> context_;
    std::unique_ptr<SSL, Free> tls_;
    bool connected_ = false;
    std::string in_;
    std::size_t at_ = 0;
};

}  // namespace tribo::net::test
