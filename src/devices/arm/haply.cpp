// SPDX-License-Identifier: MIT
#include "devices/arm/haply.hpp"

#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/text/printable.hpp"
#include "devices/arm/arm_exchange.hpp"
#include "devices/servo/tick_clock.hpp"
#include "net/websocket_client.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;
using Json = nlohmann::json;

constexpr double kMmPerM = 1e3;
// Most time for one reply. Without a position for so long the arm is gone: the service is silent, or answers
// without it.
constexpr int kReplyMs = 1000;
constexpr std::uint64_t kGoneNs = kReplyMs * 1'000'000ULL;
// Of an answer in a message.
constexpr std::size_t kShownOfAnswer = 80;

bool read_triple(const Json& parent, const char* key, Vec3& out) {
    const auto found = parent.find(key);
    if (found == parent.end() || !found->is_object()) return false;
    Vec3 v;
    int n = 0;
    for (const char* axis : {"x", "y", "z"}) {
        const auto number = found->find(axis);
        if (number == found->end() || !number->is_number()) return false;
        v[n++] = number->get<double>();
    }
    if (!is_finite(v)) return false;
    out = v;
    return true;
}

// The grip points along +y of its own frame, in the axes of the application (tutorial 06 of the SDK). The
// hand is at the other end.
void read_grip(const Json& grip, HaplyState& state) {
    const auto inner = grip.find("state");
    if (inner == grip.end() || !inner->is_object()) return;
    const auto q = inner->find("orientation");
    if (q != inner->end() && q->is_object()) {
        const double w = q->value("w", 1.0), x = q->value("x", 0.0), y = q->value("y", 0.0),
                     z = q->value("z", 0.0);
        state.stylus = -normalized({2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)});
    }
    const auto buttons = inner->find("buttons");
    if (buttons != inner->end() && buttons->is_object()) {
        state.buttons = 0;
        unsigned bit = 1;
        for (const char* name : {"a", "b", "c"}) {
            if (buttons->value(name, false)) state.buttons |= bit;
            bit <<= 1;
        }
    }
}

bool read_state(const Json& json, HaplyState& state) {
    const auto arms = json.find("inverse3");
    if (arms == json.end() || !arms->is_array() || arms->empty()) return false;
    for (const char* key : {"wireless_verse_grip", "verse_grip"}) {
        const auto grips = json.find(key);
        if (grips != json.end() && grips->is_array() && !grips->empty() && grips->front().is_object())
            read_grip(grips->front(), state);
    }
    for (const Json& arm : *arms) {
        if (!arm.is_object()) continue;
        const std::string id = arm.value("device_id", std::string());
        if (id.empty() || (!state.id.empty() && id != state.id)) continue;
        const auto inner = arm.find("state");
        if (inner == arm.end() || !inner->is_object() ||
            !read_triple(*inner, "cursor_position", state.position_m))
            return false;
        read_triple(*inner, "cursor_velocity", state.velocity_m_per_s);
        if (const auto status = arm.find("status"); status != arm.end() && status->is_object())
            state.calibrated = status->value("calibrated", state.calibrated);
        if (const auto config = arm.find("config"); config != arm.end() && config->is_object()) {
            state.model = config->value("type", state.model);
            state.has_presets = config->contains("preset");
        }
        state.id = id;
        return true;
    }
    return false;
}

class Haply final : public haptics::Device {
  public:
    Haply(std::unique_ptr<net::WebSocketClient> client, HaplyState first, const HaplyOptions& options)
        : client_(std::move(client)),
          state_(std::move(first)),
          mounting_(options.mounting),
          has_presets_(state_.has_presets),
          model_(state_.model.empty() ? "Inverse3" : state_.model),
          limits_(haptics::scaled(haptics::limits_of(model_), mounting_.scale)) {
        limits_.name = model_;
        publish();
        thread_ = std::thread([this] { loop(); });
    }
    ~Haply() override {
        closing_.store(true, std::memory_order_relaxed);
        thread_.join();
        client_->send(haply_force_command(state_, {}));
    }

    const haptics::DeviceLimits& limits() const override { return limits_; }
    DeviceState read(haptics::HandReading& reading) noexcept override {
        if (gone_.load(std::memory_order_acquire)) return DeviceState::gone;
        return take_newest(readings_, reading);
    }
    DeviceState write(Vec3 force_n) noexcept override {
        command_.send(kRightAwayUp.from_stock(force_n));
        return DeviceState::ready;
    }
    std::string trouble() const override {
        if (gone_.load(std::memory_order_acquire)) return why_gone_;
        if (!has_presets_) {
            return "Haply's Inverse Service is older than 3.5: the zero of the arm is at its base, not in "
                   "the "
                   "middle of its reach";
        }
        return {};
    }

  private:
    void publish() {
        haptics::HandReading& r = readings_.back();
        r.position_mm =
            mounting_.origin_mm + mounting_.scale * kMmPerM * kRightAwayUp.to_stock(state_.position_m);
        r.velocity_mm_per_s = mounting_.scale * kMmPerM * kRightAwayUp.to_stock(state_.velocity_m_per_s);
        r.stylus = kRightAwayUp.to_stock(state_.stylus);
        r.buttons = state_.buttons;
        r.sequence = ++sequence_;
        readings_.publish();
    }
    void loop() {
        using Got = net::WebSocketClient::Got;
        std::string text;
        auto got = Got::message;
        std::uint64_t state_ns = wall_ns();
        while (!closing_.load(std::memory_order_relaxed) && wall_ns() - state_ns < kGoneNs) {
            const bool is_open =
                got != Got::message || client_->send(haply_force_command(state_, command_.force_n()));
            got = is_open ? client_->receive(text) : Got::closed;
            if (got == Got::closed) break;
            if (got == Got::message && read_haply_state(text, state_)) {
                if (!state_.calibrated) break;  // its positions are none
                publish();
                state_ns = wall_ns();
            }
        }
        if (!state_.calibrated) client_->send(haply_force_command(state_, {}));
        why_gone_ = !state_.calibrated
                        ? "the Inverse3 is no longer calibrated: put its grip on the inkwell until "
                          "the light is steady"
                    : got == Got::closed ? "the service has closed the connection"
                    : got == Got::late   ? "the service has fallen silent"
                                         : "the service gives no position of the Inverse3 any more (is it "
                                           "unplugged or switched off?); it answers '" +
                                             printable(text.substr(0, kShownOfAnswer)) + "'";
        gone_.store(true, std::memory_order_release);
    }

    std::unique_ptr<net::WebSocketClient> client_;
    HaplyState state_;
    Mounting mounting_;
    bool has_presets_;
    std::string model_;
    haptics::DeviceLimits limits_;
    std::uint64_t sequence_ = 0;
    Snapshot<haptics::HandReading> readings_;
    ForceCommand command_;
    std::atomic<bool> closing_{false}, gone_{false};
    std::string why_gone_;  // set before gone_
    std::thread thread_;
};

// Services before 3.5 call the vector "values".
Json force_message(const HaplyState& state, Vec3 f) {
    Json arm{{"device_id", state.id}};
    arm["commands"]["set_cursor_force"][state.has_presets ? "vector" : "values"] = {
        {"x", f.x}, {"y", f.y}, {"z", f.z}};
    Json message;
    message["inverse3"] = Json::array({std::move(arm)});
    return message;
}

}  // namespace

bool read_haply_state(std::string_view text, HaplyState& state) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return false;
    try {
        return read_state(json, state);
    } catch (const Json::exception&) {  // the value has another type than documented
        return false;
    }
}

std::string haply_hello(const HaplyState& state) {
    Json message = force_message(state, {});
    if (state.has_presets) {
        message["session"]["configure"]["profile"]["name"] = "tribo";
        message["inverse3"][0]["configure"]["preset"]["preset"] = "arm_front_centered";
    }
    return message.dump();
}

std::string haply_force_command(const HaplyState& state, Vec3 force_n) {
    return force_message(state, force_n).dump();
}

Result<std::unique_ptr<haptics::Device>> open_haply(const HaplyOptions& options) {
    auto client =
        net::WebSocketClient::connect({options.host, options.port}, std::min(options.timeout_ms, kReplyMs));
    if (!client) {
        Error error = client.error();
        error.remedy = "install and start Haply's Inverse Service, version 3.5 or later";
        return std::unexpected(error);
    }
    const std::uint64_t end = wall_ns() + static_cast<std::uint64_t>(options.timeout_ms) * 1'000'000;
    std::string text;
    HaplyState state;
    bool spoke = false, greeted = false;
    while (wall_ns() < end) {
        const auto got = (*client)->receive(text);
        if (got == net::WebSocketClient::Got::closed) break;
        if (got == net::WebSocketClient::Got::late) continue;
        spoke = true;
        if (read_haply_state(text, state)) {
            if (!state.calibrated) {
                return fail("the Inverse3 is not calibrated",
                            "put its grip on the inkwell until the light is steady, or follow Haply Hub");
            }
            // The positions of the first message have the zero that was set before.
            if (greeted) return std::make_unique<Haply>(std::move(*client), std::move(state), options);
            if (!(*client)->send(haply_hello(state))) break;
            greeted = true;
            continue;
        }
        if (text.find("inverse3") == std::string::npos) {
            return fail("the service does not speak of an inverse3: it is another version",
                        "install Haply's Inverse Service 3.5 or later");
        }
    }
    if (spoke)
        return fail("the service knows of no Inverse3", "plug it in, switch it on and let it calibrate");
    return fail("the service says nothing", "plug the Inverse3 in, and restart the service");
}

}  // namespace tribo::devices
