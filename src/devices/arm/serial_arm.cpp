// SPDX-License-Identifier: MIT
#include "devices/arm/serial_arm.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <span>
#include <sys/ioctl.h>
#include <termios.h>
#include <thread>
#include <unistd.h>

#include "base/text/limit_text.hpp"
#include "devices/serial_packets.h"
#include "devices/servo/tick_clock.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;
using Clock = std::chrono::steady_clock;

// Interval of the requests until the board has started.
constexpr std::chrono::milliseconds kAskEvery{200};
constexpr std::size_t kLongestLine = 400, kShownOfLine = 60;
// The servo calls an arm silent after 5 ms. Two ticks of 2 ms and one of the servo fit in: one position may
// get lost.
constexpr double kLeastRateHz = 500, kMostRateHz = 20'000;
// Start bit, eight bits, stop bit.
constexpr unsigned kBitsPerByte = 10;
// Without a packet for so long the firmware switches the force off.
constexpr std::uint64_t kLetGoNs = 5'000'000;
// Without a position for so long the arm is gone, though its port is open.
constexpr std::uint64_t kGoneNs = 1'000'000'000;
// A line is too slow if it has not taken so many of so many forces.
constexpr int kForcesCounted = 200, kMostLeftOut = 10;
// At the end, for the force of zero.
constexpr std::chrono::milliseconds kLastForceTime{50};
constexpr double kMnPerN = 1e3, kMostMn = 32767;
// Number of positions for the speed.
constexpr std::size_t kSpeedTicks = 8;
// Ticks of the arm. Its positions have numbers from 0 to 255. After a longer gap by the clock they may have
// gone round, and say no longer how many ticks have passed.
constexpr double kLongestGap = 64;

struct Rate {
    int baud;
    speed_t code;
};
constexpr Rate kRates[] = {{115'200, B115200},   {230'400, B230400}, {460'800, B460800},
                           {500'000, B500000},   {921'600, B921600}, {1'000'000, B1000000},
                           {2'000'000, B2000000}};

using ForcePacket = std::array<std::uint8_t, TRIBO_FORCE_BYTES>;

enum class Sent : std::uint8_t { whole, none, gone };

class Port {
  public:
    Port(int handle, int baud)
        : handle_(handle),
          packet_ns_(1'000'000'000ULL * kBitsPerByte * TRIBO_FORCE_BYTES / static_cast<unsigned>(baud)) {}
    Port(Port&& other) noexcept : handle_(std::exchange(other.handle_, -1)), packet_ns_(other.packet_ns_) {}
    Port& operator=(Port&&) = delete;
    ~Port() {
        if (handle_ >= 0) ::close(handle_);
    }

    // Returns the number of received bytes, 0 if there are none, -1 if the port is gone.
    int read(std::span<std::uint8_t> into) noexcept {
        const ssize_t count = ::read(handle_, into.data(), into.size());
        if (count > 0) return static_cast<int>(count);
        return count < 0 && must_wait() ? 0 : -1;
    }
    // Returns false if the port is gone.
    bool ask() noexcept {
        const std::uint8_t question = TRIBO_ARM_ASK;
        return ::write(handle_, &question, 1) >= 0 || must_wait();
    }
    // Sends the packet, or nothing of it where it would wait for longer than a packet takes on the line.
    // Ticks that are late now and then lose no force so.
    Sent send(const ForcePacket& packet) noexcept {
        if (rest_ > 0) {
            // A driver that is nearly full has taken a part of the last packet.
            const ssize_t count = ::write(handle_, last_.data() + last_.size() - rest_, rest_);
            if (count > 0) rest_ -= static_cast<std::size_t>(count);
            return count >= 0 || must_wait() ? Sent::none : Sent::gone;
        }
        const std::uint64_t now = wall_ns();
        if (free_ns_ > now + packet_ns_ || has_waiting_bytes()) return Sent::none;
        const ssize_t count = ::write(handle_, packet.data(), packet.size());
        if (count < 0) return must_wait() ? Sent::none : Sent::gone;
        last_ = packet;
        rest_ = last_.size() - static_cast<std::size_t>(count);
        free_ns_ = std::max(free_ns_, now) + packet_ns_;
        return Sent::whole;
    }
    bool wait(std::chrono::milliseconds most) const {
        pollfd poll{handle_, POLLIN, 0};
        return ::poll(&poll, 1, static_cast<int>(most.count())) > 0;
    }

  private:
    static bool must_wait() noexcept { return errno == EAGAIN || errno == EINTR; }
    // Whether the driver still holds bytes. On USB the baud rate does not tell when they are sent.
    bool has_waiting_bytes() const noexcept {
        int count = 0;
        return ::ioctl(handle_, TIOCOUTQ, &count) == 0 && count > 0;
    }

    int handle_;
    std::uint64_t packet_ns_;    // that a packet takes on the line
    std::uint64_t free_ns_ = 0;  // when the line has sent the last packet
    ForcePacket last_{};
    std::size_t rest_ = 0;  // bytes of the last packet that are not sent
};

class SerialArm final : public haptics::Device {
  public:
    SerialArm(Port port, SerialArmFacts facts, const Mounting& mounting)
        : port_(std::move(port)),
          facts_(std::move(facts)),
          limits_(haptics::scaled(facts_.limits, mounting.scale)),
          mounting_(mounting),
          longest_gap_ns_(static_cast<std::uint64_t>(1e9 * kLongestGap / facts_.rate_hz)) {
        limits_.name = facts_.name;
    }
    ~SerialArm() override {
        const auto end = Clock::now() + kLastForceTime;
        while (send({}) == Sent::none && Clock::now() < end) std::this_thread::sleep_for(kLastForceTime / 50);
    }

    // Waits for the first position. Returns false if none comes.
    bool speaks(std::chrono::milliseconds most) {
        haptics::HandReading reading;
        const auto end = Clock::now() + most;
        DeviceState state = read(reading);
        while (state == DeviceState::silent && Clock::now() < end) {
            (void)port_.wait(std::chrono::milliseconds(20));
            state = read(reading);
        }
        return state == DeviceState::ready;
    }

    const haptics::DeviceLimits& limits() const override { return limits_; }

    DeviceState read(haptics::HandReading& reading) noexcept override {
        if (gone_) return DeviceState::gone;
        const std::uint64_t now = wall_ns();
        if (now - place_ns_ > longest_gap_ns_) taken_ = 0;
        bool any = false;
        for (int count = 1; count > 0;) {
            count = port_.read(std::span(bytes_).subspan(held_));
            if (count < 0) {
                gone_ = true;
                return DeviceState::gone;
            }
            held_ += static_cast<std::size_t>(count);
            any = take_packets() || any;
        }
        if (!any) {
            is_silent_ = place_ns_ > 0 && now - place_ns_ > kGoneNs;
            if (is_silent_) gone_ = true;
            return gone_ ? DeviceState::gone : DeviceState::silent;
        }
        place_ns_ = now;
        reading.position_mm = mounting_.origin_mm + mounting_.scale * place_;
        reading.velocity_mm_per_s = mounting_.scale * speed();
        reading.buttons = buttons_;
        reading.sequence = ++sequence_;
        return DeviceState::ready;
    }

    DeviceState write(Vec3 force_n) noexcept override {
        const Sent sent = send(force_n);
        if (sent == Sent::gone) gone_ = true;
        if (gone_) return DeviceState::gone;
        left_out_ += sent == Sent::none ? 1 : 0;
        if (++forces_ % kForcesCounted == 0) {
            if (left_out_ > kMostLeftOut) is_line_slow_ = true;
            left_out_ = 0;
        }
        const std::uint64_t now = wall_ns();
        if (sent == Sent::whole) sent_ns_ = now;
        return now - sent_ns_ > kLetGoNs ? DeviceState::refused : DeviceState::ready;
    }

    std::string trouble() const override {
        if (is_silent_) {
            return "the serial arm is gone: its port is open, and no position has come for 1 s; see whether "
                   "its board hangs or has restarted";
        }
        if (gone_) return "the serial arm is gone: its port has closed";
        if (is_line_slow_) {
            return "the line carries fewer forces than the servo makes, and some were not sent; take a "
                   "higher baud rate (serial:PORT@BAUD, as in the firmware) or a lower --rate";
        }
        return {};
    }

  private:
    Sent send(Vec3 force_n) noexcept {
        tribo_force_mn force{};
        for (int i = 0; i < 3; ++i) {
            const double mn = std::clamp(kMnPerN * force_n[i], -kMostMn, kMostMn);
            force.mn[i] = static_cast<std::int16_t>(std::lround(mn));
        }
        ForcePacket packet;
        tribo_write_force(&force, packet.data());
        return port_.send(packet);
    }
    // Takes the newest position from the received bytes. Returns false if there is none.
    bool take_packets() noexcept {
        bool any = false;
        std::size_t at = 0;
        while (held_ - at >= TRIBO_PLACE_BYTES) {
            tribo_place place;
            if (tribo_read_place(&bytes_[at], &place) == 0) {
                ++at;  // a partial or damaged packet: search the next mark
                continue;
            }
            at += TRIBO_PLACE_BYTES;
            take(place);
            any = true;
        }
        held_ -= at;
        std::memmove(bytes_.data(), &bytes_[at], held_);
        return any;
    }
    void take(const tribo_place& place) noexcept {
        const double step = facts_.limits.resolution_mm;
        place_ = step * Vec3{static_cast<double>(place.step[0]), static_cast<double>(place.step[1]),
                             static_cast<double>(place.step[2])};
        buttons_ = place.buttons;
        tick_ += static_cast<std::uint8_t>(place.sequence - static_cast<std::uint8_t>(tick_));
        past_[taken_ % past_.size()] = {place_, tick_};
        ++taken_;
    }
    // Divides by the ticks counted by the arm, so that a lost packet does not change the speed.
    Vec3 speed() const noexcept {
        if (taken_ < 2) return {};
        const Past& last = past_[(taken_ - 1) % past_.size()];
        const Past& first = past_[taken_ <= past_.size() ? 0 : taken_ % past_.size()];
        const auto ticks = static_cast<double>(last.tick - first.tick);
        return ticks > 0 ? (facts_.rate_hz / ticks) * (last.place - first.place) : Vec3{};
    }

    struct Past {
        Vec3 place;
        std::uint64_t tick = 0;
    };
    Port port_;
    SerialArmFacts facts_;
    haptics::DeviceLimits limits_;
    Mounting mounting_;
    std::uint64_t longest_gap_ns_;
    std::uint64_t place_ns_ = 0;  // when the last position came
    std::array<std::uint8_t, 512> bytes_{};
    std::size_t held_ = 0, taken_ = 0;
    std::array<Past, kSpeedTicks + 1> past_;
    Vec3 place_;
    unsigned buttons_ = 0;
    std::uint64_t sequence_ = 0;
    std::uint64_t tick_ = 0;     // of the arm; the low byte is the number of its last position
    std::uint64_t sent_ns_ = 0;  // when the last force was sent
    int forces_ = 0, left_out_ = 0;
    std::atomic<bool> gone_{false}, is_silent_{false}, is_line_slow_{false};
};

Result<Port> open_port(const SerialArmOptions& options) {
    const Rate* rate = std::ranges::find(kRates, options.baud, &Rate::baud);
    if (rate == std::end(kRates)) {
        return fail("a serial line has no " + std::to_string(options.baud) + " baud here",
                    "take 115200, 230400, 460800, 500000, 921600, 1000000 or 2000000");
    }
    const int handle = ::open(options.port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (handle < 0) {
        const int error = errno;
        return fail(options.port + ": " + std::strerror(error),
                    error == EACCES
                        ? "give yourself the right to use it: join the group 'dialout', or add a udev rule"
                        : "plug the arm in, and see which /dev/ttyACM* or /dev/ttyUSB* comes");
    }
    Port port(handle, options.baud);
    termios how{};
    if (::tcgetattr(handle, &how) != 0)
        return fail(options.port + " is not a serial port", "name the arm's /dev/ttyACM* or /dev/ttyUSB*");
    ::cfmakeraw(&how);
    how.c_cflag |= CLOCAL | CREAD;
    how.c_cc[VMIN] = 1;  // no data does not mean the end of the file
    how.c_cc[VTIME] = 0;
    ::cfsetspeed(&how, rate->code);
    if (::tcsetattr(handle, TCSANOW, &how) != 0)
        return fail(options.port + " does not take " + std::to_string(options.baud) + " baud", "");
    return port;
}

// The line with which an arm of any version answers begins with this.
constexpr std::string_view kAnyHello = "tribo-arm ";

// Returns the line that begins with the hello, and skips other text.
Result<std::string> ask(Port& port, const SerialArmOptions& options) {
    std::string other;  // the line of an arm of another version
    const auto end = Clock::now() + std::chrono::milliseconds(options.timeout_ms);
    auto next = Clock::now();
    std::string text;
    while (Clock::now() < end) {
        if (Clock::now() >= next) {
            if (!port.ask()) break;
            next += kAskEvery;
        }
        (void)port.wait(std::chrono::milliseconds(20));
        std::array<std::uint8_t, 256> bytes;
        const int count = port.read(bytes);
        if (count < 0) continue;  // the board restarts
        for (int n = 0; n < count; ++n) text.push_back(static_cast<char>(bytes[static_cast<std::size_t>(n)]));
        const std::size_t from = text.find(kAnyHello);
        if (from != std::string::npos) {
            const std::size_t to = text.find('\n', from);
            if (to == std::string::npos) continue;
            // The library of Arduino ends its lines with CR LF.
            std::string line = text.substr(from, to - from - (text[to - 1] == '\r' ? 1 : 0));
            if (line.starts_with(TRIBO_ARM_HELLO)) return line;
            other = std::move(line);
            text.erase(0, to);
        } else if (text.size() > 2 * kLongestLine) {
            text.erase(0, text.size() - kLongestLine);
        }
    }
    if (!other.empty()) {
        return fail(
            "the arm on " + options.port + " answers '" + other.substr(0, kShownOfLine) +
                "': it has another version of the packets than this Tribo, which expects '" TRIBO_ARM_HELLO
                "'",
            "build its firmware with the serial_packets.h of this Tribo");
    }
    return fail("nobody on " + options.port + " answers as a Tribo arm",
                "load examples/serial_arm onto it, and see that both have the same baud rate (here " +
                    std::to_string(options.baud) + ")");
}

}  // namespace

Result<SerialArmFacts> read_serial_arm_facts(std::string_view line) {
    constexpr std::string_view kHello = TRIBO_ARM_HELLO;
    if (!line.starts_with(kHello))
        return fail("the line does not begin with '" + std::string(kHello) + "'", "");
    SerialArmFacts facts;
    struct Number {
        std::string_view key;
        double& value;
        double least, most;
    };
    const Number numbers[] = {
        {"max_n", facts.limits.max_force_n, 0.01, 32},
        {"max_n_per_mm", facts.limits.max_stiffness_n_per_mm, 1e-3, 100},
        {"max_ns_per_mm", facts.limits.max_damping_n_s_per_mm, 0, 1},
        {"resolution_mm", facts.limits.resolution_mm, 1e-4, 1},
        {"rate_hz", facts.rate_hz, kLeastRateHz, kMostRateHz},
    };
    line.remove_prefix(kHello.size());
    while (!line.empty()) {
        const std::string_view fact = line.substr(0, line.find(';'));
        line.remove_prefix(std::min(line.size(), fact.size() + 1));
        const std::size_t equals = fact.find('=');
        const std::string_view key = fact.substr(0, equals),
                               value = equals == fact.npos ? "" : fact.substr(equals + 1);
        if (key == "name") {
            facts.name.clear();
            for (const char c : value.substr(0, 40)) facts.name.push_back(c >= ' ' && c < 127 ? c : '?');
        }
        for (const Number& n : numbers) {
            if (key != n.key) continue;
            double v = 0;
            const auto read = std::from_chars(value.data(), value.data() + value.size(), v);
            if (read.ec != std::errc() || read.ptr != value.data() + value.size() ||
                !(v >= n.least && v <= n.most)) {
                return fail("the arm says '" + std::string(fact.substr(0, kShownOfLine)) +
                                "': " + std::string(key) + " is a number from " + plain_number(n.least) +
                                " to " + plain_number(n.most),
                            "correct its firmware");
            }
            n.value = v;
        }
    }
    return facts;
}

Result<std::unique_ptr<haptics::Device>> open_serial_arm(const SerialArmOptions& options) {
    if (options.port.empty()) {
        return fail("no port is named for the serial arm",
                    "name it: --device serial:/dev/ttyACM0, with @115200 behind it for another baud rate "
                    "than 1000000");
    }
    auto port = open_port(options);
    if (!port) return std::unexpected(port.error());
    auto line = ask(*port, options);
    if (!line) return std::unexpected(line.error());
    auto facts = read_serial_arm_facts(*line);
    if (!facts) return std::unexpected(facts.error());
    auto arm = std::make_unique<SerialArm>(std::move(*port), std::move(*facts), options.mounting);
    if (!arm->speaks(std::chrono::milliseconds(options.timeout_ms))) {
        return fail("the arm on " + options.port + " answers, but sends no position",
                    "correct its firmware: it sends a packet of serial_packets.h at each of its ticks");
    }
    return arm;
}

}  // namespace tribo::devices
