// SPDX-License-Identifier: MIT
#include "devices/arm/falcon/falcon.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "base/math.hpp"
#include "devices/arm/arm_exchange.hpp"
#include "devices/arm/falcon/falcon_kinematics.hpp"
#include "devices/arm/falcon/falcon_packets.hpp"
#include "devices/arm/falcon/ftdi_port.hpp"
#include "devices/servo/tick_clock.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr std::uint16_t kVendor = 0x0403, kProduct = 0xcb48;
// Encoder and transmission, as libnifalcon measured them: 320 slots read four times, a shaft of 14.25 mm that
// turns a sector of 110 mm, and the angle of an arm at which a homed encoder shows zero.
constexpr double kRadPerCount = math::kTwoPi / (4 * 320) * 14.25 / 110;
constexpr double kZeroRad = 35 * math::kRadPerDeg;
// Motor value per N mm of torque on an arm; a positive value turns the arm back. No value is larger.
constexpr double kMotorPerNmm = -10, kMostMotor = 4096;
// Baud rates: 9600 for the question, 140,000 for the firmware, 1,500,000 for the packets.
constexpr std::uint16_t kAskBaud = 0x4138, kLoadBaud = 0x15, kRunBaud = 0x2;
constexpr int kLoadLatencyMs = 16, kRunLatencyMs = 1;
constexpr std::uint8_t kAsk[] = {0x0a, 0x43, 0x0d}, kAsked[] = {0x0a, 0x44, 0x2c, 0x0d}, kLoad[] = {0x41};
// A packet of the chip without its line state.
constexpr std::size_t kBlock = 62;
constexpr int kMostLoads = 10, kMostAsks = 20;
constexpr std::size_t kMostFirmware = 1 << 20;
constexpr milliseconds kTransfer{1000}, kReply{20};
// Replies in a row that may be missing before the Falcon counts as gone: one second.
constexpr int kMostMissed = 50;
// Number of readings for the speed.
constexpr std::size_t kSpeedReadings = 8;

// Reads until `count` bytes have come, or the time is over.
std::vector<std::uint8_t> read_bytes(FtdiPort& port, std::size_t count, milliseconds most) {
    std::vector<std::uint8_t> bytes;
    for (const auto end = Clock::now() + most; bytes.size() < count && Clock::now() < end;) {
        const auto more = port.read(most);
        bytes.insert(bytes.end(), more.begin(), more.end());
        if (!port.is_connected()) break;
    }
    return bytes;
}

bool start_loader(FtdiPort& port) {
    if (!port.purge() || !port.set_latency_ms(kLoadLatencyMs) || !port.set_baud_code(kAskBaud) ||
        !port.set_8n1_without_flow_control() || !port.set_rts(false) || !port.set_dtr(false) ||
        !port.set_dtr(true))
        return false;
    bool asked = false;
    for (int n = 0; n < kMostAsks && !asked && port.is_connected(); ++n) {
        if (!port.write(kAsk, kTransfer)) return false;
        // Some chips send a zero first.
        const auto bytes = read_bytes(port, std::size(kAsked), 3 * kReply);
        asked = std::ranges::search(bytes, kAsked).size() == std::size(kAsked);
    }
    if (!asked || !port.set_dtr(false) || !port.set_baud_code(kLoadBaud) || !port.write(kLoad, kTransfer))
        return false;
    const auto bytes = read_bytes(port, std::size(kLoad), 5 * kReply);
    return std::ranges::equal(bytes, kLoad);
}

// The loader of the Falcon sends back each block.
bool load(FtdiPort& port, std::span<const std::uint8_t> firmware) {
    if (!start_loader(port)) return false;
    while (!firmware.empty()) {
        const auto block = firmware.first(std::min(kBlock, firmware.size()));
        if (!port.write(block, kTransfer)) return false;
        if (!std::ranges::equal(read_bytes(port, block.size(), 10 * kReply), block)) return false;
        firmware = firmware.subspan(block.size());
    }
    return true;
}

bool set_run_mode(FtdiPort& port) {
    return port.set_latency_ms(kRunLatencyMs) && port.set_baud_code(kRunBaud) && port.purge();
}

// Sends a packet and waits for one.
bool exchange(FtdiPort& port, falcon::StateReader& reader, const falcon::Packet& packet) {
    if (!port.write(packet, kReply)) return false;
    for (const auto end = Clock::now() + kReply; Clock::now() < end && port.is_connected();) {
        if (reader.take(port.read(kReply))) return true;
    }
    return false;
}

bool has_firmware(FtdiPort& port) {
    falcon::StateReader reader;
    bool any = set_run_mode(port);
    for (int n = 0; any && n < 5; ++n) {
        if (exchange(port, reader, falcon::command({}, falcon::kRed, true))) return true;
    }
    return false;
}

Result<std::vector<std::uint8_t>> read_firmware(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return fail_at(file, 0, 0, "no firmware for the Falcon can be read there", "name another file");
    std::vector<std::uint8_t> bytes;
    for (std::istreambuf_iterator<char> at(in), end; at != end && bytes.size() <= kMostFirmware; ++at)
        bytes.push_back(static_cast<std::uint8_t>(*at));
    if (bytes.empty() || bytes.size() > kMostFirmware) {
        return fail_at(file, 0, 0, bytes.empty() ? "the file is empty" : "the file is no firmware: over 1 MB",
                       "name the firmware of the Falcon, for example novint.bin of libnifalcon");
    }
    return bytes;
}

std::optional<Vec3> grip_of(const falcon::State& state, Vec3 near) {
    falcon::Angles angles{};
    for (std::size_t n = 0; n < 3; ++n) angles[n] = kZeroRad + kRadPerCount * state.counts[n];
    return falcon::grip_at(angles, near);
}

// Keeps the direction where a motor cannot do as much.
std::array<int, 3> motors_for(Vec3 force_n, Vec3 grip) {
    const auto torques = falcon::torques_for(force_n, grip);
    double largest = 0;
    for (const double t : torques) largest = std::max(largest, std::abs(kMotorPerNmm * t));
    const double share = largest > kMostMotor ? kMostMotor / largest : 1;
    std::array<int, 3> motors{};
    for (std::size_t n = 0; n < 3; ++n)
        motors[n] = static_cast<int>(std::lround(share * kMotorPerNmm * torques[n]));
    return motors;
}

class Falcon final : public haptics::Device {
  public:
    Falcon(FtdiPort port, const falcon::State& first, const Mounting& mounting)
        : port_(std::move(port)),
          mounting_(mounting),
          limits_(haptics::scaled(haptics::limits_of("Falcon"), mounting.scale)) {
        take(first);
        thread_ = std::thread([this] { loop(); });
    }
    ~Falcon() override {
        closing_.store(true, std::memory_order_relaxed);
        thread_.join();
        (void)port_.write(falcon::command({}, 0, false), kTransfer);
    }

    const haptics::DeviceLimits& limits() const override { return limits_; }
    DeviceState read(haptics::HandReading& reading) noexcept override {
        if (gone_.load(std::memory_order_acquire)) return DeviceState::gone;
        return take_newest(readings_, reading);
    }
    DeviceState write(Vec3 force_n) noexcept override {
        command_.send(kRightUpNear.from_stock(force_n));
        return DeviceState::ready;
    }
    std::string trouble() const override {
        return gone_.load(std::memory_order_acquire)
                   ? "the Falcon has gone silent: its USB or its power was unplugged, or its power failed"
                   : "";
    }

  private:
    void take(const falcon::State& state) {
        const std::optional<Vec3> at = grip_of(state, grip_);
        if (!at) return;  // counts of no position: the servo notices the silence
        grip_ = *at;
        past_[taken_ % past_.size()] = {grip_, wall_ns()};
        ++taken_;
        haptics::HandReading& r = readings_.back();
        r.position_mm =
            mounting_.origin_mm + mounting_.scale * kRightUpNear.to_stock(grip_ - falcon::kMiddle);
        r.velocity_mm_per_s = mounting_.scale * kRightUpNear.to_stock(speed());
        r.buttons = state.buttons;
        r.sequence = taken_;
        readings_.publish();
    }
    Vec3 speed() const {
        const Past& last = past_[(taken_ - 1) % past_.size()];
        const Past& first = past_[taken_ <= past_.size() ? 0 : taken_ % past_.size()];
        const double seconds = 1e-9 * static_cast<double>(last.ns - first.ns);
        return seconds > 0 ? (last.at - first.at) / seconds : Vec3{};
    }
    void loop() {
        falcon::StateReader reader;
        int missed = 0;
        while (!closing_.load(std::memory_order_relaxed) && missed < kMostMissed && port_.is_connected()) {
            const auto motors = motors_for(command_.force_n(), grip_);
            const bool answered = exchange(port_, reader, falcon::command(motors, falcon::kGreen, false));
            missed = answered ? 0 : missed + 1;
            if (answered) take(reader.state());
        }
        gone_.store(true, std::memory_order_release);
    }

    struct Past {
        Vec3 at;
        std::uint64_t ns = 0;
    };
    FtdiPort port_;
    Mounting mounting_;
    haptics::DeviceLimits limits_;
    Vec3 grip_ = falcon::kMiddle;
    std::array<Past, kSpeedReadings + 1> past_;
    std::uint64_t taken_ = 0;
    Snapshot<haptics::HandReading> readings_;
    ForceCommand command_;
    std::atomic<bool> closing_{false}, gone_{false};
    std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<haptics::Device>> open_falcon(const FalconOptions& options) {
    std::vector<std::uint8_t> firmware;
    if (!options.firmware.empty()) {
        auto bytes = read_firmware(options.firmware);
        if (!bytes) return std::unexpected(bytes.error());
        firmware = std::move(*bytes);
    }
    auto port = FtdiPort::open(options.libusb, kVendor, kProduct);
    if (!port) {
        Error error = port.error();
        error.cause = "Novint Falcon: " + error.cause;
        return std::unexpected(error);
    }
    bool runs = has_firmware(*port);
    if (!runs && firmware.empty()) {
        return fail("the Falcon has no firmware since it was switched on",
                    "name a firmware file: --device falcon:FILE (novint.bin of libnifalcon, or the file of "
                    "Novint's driver)");
    }
    for (int n = 0; n < kMostLoads && !runs && port->is_connected(); ++n)
        runs = load(*port, firmware) && has_firmware(*port);
    if (!runs) {
        return fail_at(
            options.firmware, 0, 0,
            "the Falcon does not run with this firmware, after " + std::to_string(kMostLoads) + " tries",
            "plug its USB and its power in again, without a hub; then try again");
    }
    // The encoders do not know where they are until each has been at the end of its way.
    falcon::StateReader reader;
    bool answered = false;
    const auto end = Clock::now() + milliseconds(options.homing_ms);
    do {
        answered = exchange(*port, reader, falcon::command({}, falcon::kRed, true));
        if (answered && reader.state().homed)
            return std::make_unique<Falcon>(std::move(*port), reader.state(), options.mounting);
    } while (Clock::now() < end && port->is_connected());
    return fail(
        "the Falcon is not homed: it does not know where its grip is",
        "switch its power on; start again and, while its lights are red, pull the grip out as far as it "
        "goes and push it in");
}

}  // namespace tribo::devices
