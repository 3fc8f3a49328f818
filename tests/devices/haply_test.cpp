// SPDX-License-Identifier: MIT
// The Inverse3 through a server that speaks the documented messages.
#include "devices/arm/haply.hpp"

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>  // before Beast: 1.74 leaves it out
#include <vector>

namespace tribo::devices {
namespace {

namespace beast = boost::beast;
using tcp = boost::asio::ip::tcp;
using haptics::DeviceState;

// One client: says hello, then answers every message by `reply` until that gives nothing; then closes.
class Service {
  public:
    using Reply = std::function<std::string(const std::string&)>;
    Service(std::string hello, Reply reply) : hello_(std::move(hello)), reply_(std::move(reply)) {
        thread_ = std::thread([this] { serve(); });
    }
    ~Service() {
        if (!accepted_) {  // wakes accept()
            beast::error_code ignored;
            tcp::socket socket(context_);
            socket.connect({boost::asio::ip::address_v4::loopback(), port()}, ignored);
        }
        thread_.join();
    }
    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  private:
    void serve() {
        beast::error_code error;
        tcp::socket socket(context_);
        acceptor_.accept(socket, error);
        accepted_ = true;
        beast::websocket::stream<tcp::socket> ws(std::move(socket));
        ws.accept(error);
        if (error) return;
        ws.text(true);
        if (!hello_.empty()) ws.write(boost::asio::buffer(hello_), error);
        beast::flat_buffer buffer;
        while (!error) {
            ws.read(buffer, error);
            if (error) return;
            const std::string answer = reply_(beast::buffers_to_string(buffer.data()));
            buffer.consume(buffer.size());
            if (answer.empty()) {
                ws.next_layer().close(error);
                return;
            }
            ws.write(boost::asio::buffer(answer), error);
        }
    }
    boost::asio::io_context context_;
    tcp::acceptor acceptor_{context_, {boost::asio::ip::address_v4::loopback(), 0}};
    std::string hello_;
    Reply reply_;
    std::atomic<bool> accepted_{false};
    std::thread thread_;
};

std::string state_at(double x, double y, double z) {
    nlohmann::json json;
    json["inverse3"] = {{{"device_id", "0A"},
                         {"state",
                          {{"cursor_position", {{"x", x}, {"y", y}, {"z", z}}},
                           {"cursor_velocity", {{"x", 0.0}, {"y", 0.0}, {"z", 0.05}}}}}}};
    json["wireless_verse_grip"] = {{{"device_id", "1B"},
                                    {"state",
                                     {{"orientation", {{"w", 1.0}, {"x", 0.0}, {"y", 0.0}, {"z", 0.0}}},
                                      {"buttons", {{"a", true}, {"b", false}, {"c", true}}}}}}};
    return json.dump();
}

// The first message of version 3.5 (page "WebSocket Protocol" of Haply's documentation), shortened.
std::string inventory_at(double x, double y, double z, bool calibrated = true) {
    nlohmann::json json = nlohmann::json::parse(state_at(x, y, z));
    json["session_id"] = 7;
    json["inverse3"][0]["config"] = {{"type", "inverse3x"},
                                     {"handedness", "right"},
                                     {"preset", "defaults"},
                                     {"basis", {{"permutation", "XYZ"}}}};
    json["inverse3"][0]["status"] = {{"calibrated", calibrated}};
    return json.dump();
}

HaplyOptions at(const Service& service) {
    HaplyOptions options;
    options.port = service.port();
    options.timeout_ms = 500;
    return options;
}

bool haply_comes(haptics::Device& device, haptics::HandReading& reading, DeviceState state) {
    for (int n = 0; n < 8000; ++n) {
        if (device.read(reading) == state) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

// As tutorials 01, 04 and 06 of Inverse SDK 3.5 have it: the first message registers the session and sets the
// preset, with a force of zero; all others are a force. The zero of the arm is that of the preset.
TEST(Haply, speaks_as_the_vendors_tutorials_do) {
    std::mutex mutex;
    std::vector<std::string> got;
    Service service(inventory_at(0, -0.12, 0.15), [&](const std::string& text) {
        const std::lock_guard lock(mutex);
        if (got.empty() || got.back() != text) got.push_back(text);
        return state_at(0.01, 0.02, 0.03);
    });
    auto device = open_haply(at(service));
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_EQ((*device)->limits().name, "inverse3x");
    EXPECT_EQ((*device)->limits().max_force_n, 2);
    EXPECT_EQ((*device)->trouble(), "");
    haptics::HandReading reading;
    ASSERT_TRUE(haply_comes(**device, reading, DeviceState::ready));
    EXPECT_NEAR(distance(reading.position_mm, {10, 20, 30}), 0, 1e-9);
    const nlohmann::json force = nlohmann::json::parse(R"({"inverse3": [{"device_id": "0A",
        "commands": {"set_cursor_force": {"vector": {"x": 0.5, "y": 0, "z": 1.25}}}}]})");
    const nlohmann::json none = nlohmann::json::parse(R"({"inverse3": [{"device_id": "0A",
        "commands": {"set_cursor_force": {"vector": {"x": 0, "y": 0, "z": 0}}}}]})");
    const auto last_is = [&](const nlohmann::json& message) {
        const std::lock_guard lock(mutex);
        return nlohmann::json::parse(got.back()) == message;
    };
    for (int n = 0; n < 4000 && !last_is(force); ++n) {
        (*device)->write({0.5, 0, 1.25});
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    EXPECT_TRUE(last_is(force));
    device->reset();
    for (int n = 0; n < 4000 && !last_is(none); ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard lock(mutex);
    EXPECT_EQ(nlohmann::json::parse(got.front()), nlohmann::json::parse(R"({
        "session": {"configure": {"profile": {"name": "tribo"}}},
        "inverse3": [{"device_id": "0A", "configure": {"preset": {"preset": "arm_front_centered"}},
                      "commands": {"set_cursor_force": {"vector": {"x": 0, "y": 0, "z": 0}}}}]})"));
    std::size_t forces = 0;
    for (std::size_t n = 1; n < got.size(); ++n) {
        const nlohmann::json message = nlohmann::json::parse(got[n]);
        EXPECT_TRUE(message == force || message == none) << got[n];
        forces += message == force ? 1 : 0;
    }
    EXPECT_GE(forces, 1U);
    EXPECT_EQ(nlohmann::json::parse(got.back()), none);  // of the closing
}

// Tutorial 06: the grip points along +y of its own frame; x is right, y away from the user, z up.
TEST(Haply, has_the_hand_behind_the_grip) {
    const auto stylus_of = [](double w, double x, double y, double z) {
        nlohmann::json json = nlohmann::json::parse(state_at(0, 0, 0));
        json["wireless_verse_grip"][0]["state"]["orientation"] = {{"w", w}, {"x", x}, {"y", y}, {"z", z}};
        HaplyState state;
        EXPECT_TRUE(read_haply_state(json.dump(), state));
        return state.stylus;
    };
    const double half = 0.7071067811865476;
    EXPECT_NEAR(distance(stylus_of(1, 0, 0, 0), {0, -1, 0}), 0, 1e-12);
    // A quarter of a turn about x: it points up; about -x: down; about z: to the left.
    EXPECT_NEAR(distance(stylus_of(half, half, 0, 0), {0, 0, -1}), 0, 1e-12);
    EXPECT_NEAR(distance(stylus_of(half, -half, 0, 0), {0, 0, 1}), 0, 1e-12);
    EXPECT_NEAR(distance(stylus_of(half, 0, 0, half), {1, 0, 0}), 0, 1e-12);
}

TEST(Haply, refuses_an_arm_that_is_not_calibrated) {
    Service service(inventory_at(0, 0, 0, false), [](const std::string&) { return std::string(); });
    const auto device = open_haply(at(service));
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().cause.find("not calibrated"), std::string::npos);
    EXPECT_NE(device.error().remedy.find("inkwell"), std::string::npos);
}

// Services before 3.5 know no presets and name the vector "values".
TEST(Haply, takes_states_and_answers_each_with_the_newest_force) {
    std::atomic<double> seen_z{0};
    std::atomic<bool> well_formed{true};
    Service service(state_at(0.01, 0.02, 0.03), [&](const std::string& text) {
        const auto json = nlohmann::json::parse(text, nullptr, false);
        if (!json.is_object() || json["inverse3"][0]["device_id"] != "0A") {
            well_formed = false;
        } else {
            seen_z = json["inverse3"][0]["commands"]["set_cursor_force"]["values"]["z"].get<double>();
        }
        return state_at(0.01, 0.02, 0.04);
    });
    auto device = open_haply(at(service));
    ASSERT_TRUE(device.has_value()) << device.error().text();
    haptics::HandReading reading;
    ASSERT_TRUE(haply_comes(**device, reading, DeviceState::ready));
    for (int n = 0; n < 4000 && (seen_z != 1.25 || reading.position_mm.z < 39); ++n) {
        (*device)->write({0, 0, 1.25});
        (*device)->read(reading);
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    EXPECT_EQ(seen_z, 1.25);
    EXPECT_NE((*device)->trouble().find("older than 3.5"), std::string::npos);
    EXPECT_NEAR(distance(reading.position_mm, {10, 20, 40}), 0, 1e-9);
    EXPECT_NEAR(reading.velocity_mm_per_s.z, 50, 1e-9);
    EXPECT_EQ(reading.buttons, 5U);
    // The servo falls silent: zero is sent, not the old force.
    for (int n = 0; n < 4000 && seen_z != 0; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(seen_z, 0);
    EXPECT_TRUE(well_formed);
    device->reset();
}

TEST(Haply, is_gone_when_the_service_closes) {
    std::atomic<int> left{5};
    Service service(state_at(0, 0, 0),
                    [&](const std::string&) { return left-- > 0 ? state_at(0, 0, 0.001) : std::string(); });
    auto device = open_haply(at(service));
    ASSERT_TRUE(device.has_value()) << device.error().text();
    haptics::HandReading reading;
    EXPECT_TRUE(haply_comes(**device, reading, DeviceState::gone));
    EXPECT_FALSE((*device)->trouble().empty());
}

// The service runs on and answers.
TEST(Haply, is_gone_when_the_service_has_lost_the_arm) {
    for (const std::string& answer :
         {std::string(R"({"inverse3": []})"), std::string(R"({"verse_grip": []})"),
          std::string(R"({"error": "motor overheated"})"),
          std::string(R"({"inverse3": [{"device_id": "FF", "state": {"cursor_position": )"
                      R"({"x": 0, "y": 0, "z": 0}}}]})")}) {
        std::atomic<int> left{5};
        Service service(state_at(0, 0, 0),
                        [&](const std::string&) { return left-- > 0 ? state_at(0, 0, 0.001) : answer; });
        auto device = open_haply(at(service));
        ASSERT_TRUE(device.has_value()) << device.error().text();
        haptics::HandReading reading;
        EXPECT_TRUE(haply_comes(**device, reading, DeviceState::gone)) << answer;
        EXPECT_NE((*device)->trouble().find(answer.substr(0, 40)), std::string::npos) << (*device)->trouble();
    }
}

// Positions without a calibration are none.
TEST(Haply, is_gone_when_it_is_no_longer_calibrated) {
    std::atomic<int> left{5};
    std::atomic<int> asked_after{0};
    std::mutex mutex;
    std::string last;
    Service service(inventory_at(0, -0.12, 0.15), [&](const std::string& text) {
        const std::lock_guard lock(mutex);
        last = text;
        if (left-- > 0) return inventory_at(0, 0, 0.001);
        ++asked_after;
        return inventory_at(0, 0, 0.5, false);
    });
    auto device = open_haply(at(service));
    ASSERT_TRUE(device.has_value()) << device.error().text();
    haptics::HandReading reading;
    for (int n = 0; n < 8000 && (*device)->read(reading) != DeviceState::gone; ++n) {
        (void)(*device)->write({0, 0, 1});
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ((*device)->read(reading), DeviceState::gone);
    EXPECT_NE((*device)->trouble().find("no longer calibrated"), std::string::npos) << (*device)->trouble();
    EXPECT_LT(reading.position_mm.z, 2);  // none of the others was taken
    // The last word is a force of zero.
    for (int n = 0; n < 4000 && asked_after < 2; ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard lock(mutex);
    const auto force = nlohmann::json::parse(last)["inverse3"][0]["commands"]["set_cursor_force"]["vector"];
    EXPECT_EQ(force, (nlohmann::json{{"x", 0.0}, {"y", 0.0}, {"z", 0.0}})) << last;
}

TEST(Haply, is_silent_while_a_reply_is_late) {
    Service service(state_at(0, 0, 0), [&](const std::string&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        return state_at(0, 0, 0.001);
    });
    auto device = open_haply(at(service));
    ASSERT_TRUE(device.has_value()) << device.error().text();
    haptics::HandReading reading;
    ASSERT_TRUE(haply_comes(**device, reading, DeviceState::ready));
    EXPECT_TRUE(haply_comes(**device, reading, DeviceState::silent));
    EXPECT_TRUE(haply_comes(**device, reading, DeviceState::ready));
}

TEST(Haply, says_what_to_do_where_there_is_no_service_no_arm_or_another_version) {
    const auto echo = [](const std::string&) { return std::string("{}"); };
    HaplyOptions nobody;
    nobody.port = 1;
    auto device = open_haply(nobody);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().remedy.find("Inverse Service"), std::string::npos);
    {
        Service service(R"({"inverse3": []})", echo);
        device = open_haply(at(service));
        ASSERT_FALSE(device.has_value());
        EXPECT_NE(device.error().cause.find("knows of no Inverse3"), std::string::npos);
    }
    {
        Service service(R"({"devices": {"version": 1}})", echo);
        device = open_haply(at(service));
        ASSERT_FALSE(device.has_value());
        EXPECT_NE(device.error().cause.find("another version"), std::string::npos);
    }
    {
        Service service("", echo);
        device = open_haply(at(service));
        ASSERT_FALSE(device.has_value());
        EXPECT_NE(device.error().cause.find("says nothing"), std::string::npos);
    }
}

TEST(Haply, takes_no_damaged_message_for_a_state) {
    HaplyState state;
    EXPECT_TRUE(read_haply_state(state_at(1, 2, 3), state));
    EXPECT_EQ(state.id, "0A");
    for (const char* bad :
         {"", "{", "[]", "null", "{\"inverse3\": 5}", "{\"inverse3\": [5]}",
          "{\"inverse3\": [{\"device_id\": 5}]}", "{\"inverse3\": [{\"device_id\": \"0A\"}]}",
          "{\"inverse3\": [{\"device_id\": \"0A\", \"state\": {\"cursor_position\": {\"x\": 1}}}]}",
          "{\"inverse3\": [{\"device_id\": \"0A\", \"state\": {\"cursor_position\": "
          "{\"x\": 1, \"y\": \"a\", \"z\": 1}}}]}",
          "{\"inverse3\": [{\"device_id\": \"9Z\", \"state\": {\"cursor_position\": "
          "{\"x\": 1, \"y\": 1, \"z\": 1}}}]}"}) {
        EXPECT_FALSE(read_haply_state(bad, state)) << bad;
    }
    EXPECT_EQ(state.position_m, (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace tribo::devices
