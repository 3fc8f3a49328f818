// SPDX-License-Identifier: MIT
// Kinematics and packets of a Novint Falcon, against the chain of its joints and against differences.
#include "devices/arm/falcon/falcon_kinematics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "devices/arm/falcon/falcon_packets.hpp"

namespace tribo::devices::falcon {
namespace {

constexpr double kReach = 35;  // of a cube about the middle, mm

Vec3 drawn(const CounterNoise& noise, std::uint64_t n, double half_mm) {
    const auto between = [&](std::uint64_t k) { return half_mm * (2 * noise.uniform(3 * n + k) - 1); };
    return {between(0), between(1), between(2)};
}

// Along a leg from the middle of the base to the middle of the grip, with Stamper's three angles of its
// joints: the arm turns by theta_1, the shin by theta_2 about a parallel axis and by theta_3 out of the
// plane.
Vec3 end_of_leg(std::size_t leg, double theta_1, double theta_2, double theta_3) {
    constexpr double a = 60, b = 102.5, c = 14, d = 11.25, e = 11.25, f = -25, r = 37.233758, s = -27.330909;
    constexpr double directions_deg[] = {105, -15, -135};
    const double shin = d + e + b * math::sin(theta_3);
    const double u = r + a * math::cos(theta_1) + shin * math::cos(theta_2) - c;
    const double v = s + b * math::cos(theta_3) - f;
    const double w = a * math::sin(theta_1) + shin * math::sin(theta_2);
    const double turn = directions_deg[leg] * math::kRadPerDeg;
    return {u * math::cos(turn) - v * math::sin(turn), u * math::sin(turn) + v * math::cos(turn), w};
}

// The other two angles by a search that knows nothing of the solution in closed form: theta_3 from the plane
// of the leg, theta_2 by halving.
double miss_of_leg(std::size_t leg, double theta_1, Vec3 grip) {
    double best = 1e9;
    for (int n = 0; n <= 720; ++n) {
        const double theta_2 = math::kPi * n / 720;
        double low = 0.02, high = math::kPi - 0.02;  // theta_3: v falls with it
        const Vec3 base = end_of_leg(leg, theta_1, theta_2, math::kHalfPi);
        const Vec3 side =
            end_of_leg(leg, theta_1, theta_2, 0.02) - end_of_leg(leg, theta_1, theta_2, math::kPi - 0.02);
        const Vec3 along = normalized(side);
        for (int k = 0; k < 60; ++k) {
            const double half = 0.5 * (low + high);
            (dot(end_of_leg(leg, theta_1, theta_2, half) - base, along) > dot(grip - base, along) ? low
                                                                                                  : high) =
                half;
        }
        best = std::min(best, distance(end_of_leg(leg, theta_1, theta_2, low), grip));
    }
    return best;
}

TEST(FalconKinematics, closes_the_chain_of_every_leg) {
    const CounterNoise noise(1);
    for (std::uint64_t n = 0; n < 5; ++n) {
        const Vec3 grip = kMiddle + drawn(noise, n, kReach);
        const auto angles = angles_at(grip);
        ASSERT_TRUE(angles.has_value());
        // The search has steps of a quarter of a degree on a leg of 125 mm: 0.3 mm on each side.
        for (std::size_t leg = 0; leg < 3; ++leg)
            EXPECT_LT(miss_of_leg(leg, (*angles)[leg], grip), 0.3) << leg;
    }
}

TEST(FalconKinematics, is_the_same_for_three_legs_a_third_of_a_turn_apart) {
    const auto middle = angles_at(kMiddle);
    ASSERT_TRUE(middle.has_value());
    EXPECT_NEAR((*middle)[0], (*middle)[1], 1e-12);
    EXPECT_NEAR((*middle)[0], (*middle)[2], 1e-12);
    const double c = -0.5, s = -0.8660254037844386;  // by -120 degrees, from leg 0 to leg 1
    const CounterNoise noise(2);
    for (std::uint64_t n = 0; n < 50; ++n) {
        const Vec3 grip = kMiddle + drawn(noise, n, kReach);
        const auto one = angles_at(grip);
        const auto turned = angles_at({c * grip.x - s * grip.y, s * grip.x + c * grip.y, grip.z});
        ASSERT_TRUE(one && turned);
        for (std::size_t leg = 0; leg < 3; ++leg) EXPECT_NEAR((*one)[leg], (*turned)[(leg + 1) % 3], 1e-12);
    }
}

TEST(FalconKinematics, finds_the_grip_again_from_anywhere_in_the_workspace) {
    const CounterNoise noise(3);
    for (std::uint64_t n = 0; n < 2000; ++n) {
        const Vec3 grip = kMiddle + drawn(noise, 2 * n, kReach);
        const auto angles = angles_at(grip);
        ASSERT_TRUE(angles.has_value());
        const auto from_middle = grip_at(*angles, kMiddle),
                   from_afar = grip_at(*angles, kMiddle + drawn(noise, 2 * n + 1, 30));
        ASSERT_TRUE(from_middle && from_afar) << n;
        EXPECT_LT(distance(*from_middle, grip), 1e-6) << n;
        EXPECT_LT(distance(*from_afar, grip), 1e-6) << n;
    }
}

TEST(FalconKinematics, has_gradients_that_agree_with_differences) {
    const CounterNoise noise(4);
    for (std::uint64_t n = 0; n < 200; ++n) {
        const Vec3 grip = kMiddle + drawn(noise, n, kReach);
        const auto rows = gradients_at(grip);
        ASSERT_TRUE(rows.has_value());
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 step;
            step[axis] = 1e-4;
            const auto up = angles_at(grip + step), down = angles_at(grip - step);
            for (std::size_t leg = 0; leg < 3; ++leg)
                EXPECT_NEAR((*rows)[leg][axis], ((*up)[leg] - (*down)[leg]) / 2e-4, 1e-8);
        }
    }
}

// Virtual work: a small motion of the grip takes the same work from the force as from the torques.
TEST(FalconKinematics, has_torques_that_do_the_work_of_the_force) {
    const CounterNoise noise(5);
    for (std::uint64_t n = 0; n < 500; ++n) {
        const Vec3 grip = kMiddle + drawn(noise, 3 * n, kReach), force = drawn(noise, 3 * n + 1, 8),
                   way = 1e-5 * drawn(noise, 3 * n + 2, 1);
        const auto torques = torques_for(force, grip);
        const auto before = angles_at(grip - way), after = angles_at(grip + way);
        double work = 0;
        for (std::size_t leg = 0; leg < 3; ++leg) work += torques[leg] * ((*after)[leg] - (*before)[leg]);
        EXPECT_NEAR(work, 2 * dot(force, way), 1e-9 * length(force));
    }
}

TEST(FalconKinematics, has_no_answer_where_the_grip_cannot_be) {
    for (const Vec3 grip : {Vec3{0, 0, 400}, Vec3{300, 0, 125}, Vec3{0, -200, 100}, Vec3{0, 0, -1000}}) {
        EXPECT_FALSE(angles_at(grip).has_value());
        EXPECT_FALSE(gradients_at(grip).has_value());
        EXPECT_EQ(torques_for({1, 2, 3}, grip), (std::array<double, 3>{}));
    }
    EXPECT_FALSE(grip_at({3, -3, 3}, kMiddle).has_value());
}

std::vector<std::uint8_t> bytes_of(const std::string& text) {
    return {text.begin(), text.end()};
}

TEST(FalconPackets, writes_the_letters_of_the_protocol) {
    const Packet packet = command({0x1234, -1, 0}, kRed, true);
    EXPECT_EQ(std::string(packet.begin(), packet.end()), "<EDCBPPPPAAAAJA>");
    const Packet quiet = command({0, 0, -32768}, kGreen | kBlue, false);
    EXPECT_EQ(std::string(quiet.begin(), quiet.end()), "<AAAAAAAAAAAIGA>");
}

TEST(FalconPackets, reads_counts_buttons_and_homing) {
    StateReader reader;
    // Encoders 0x0001, -2, 0x7fff; buttons 5; two of three encoders are homed.
    EXPECT_TRUE(reader.take(bytes_of(std::string("<BAAAOPPPPPPH") + char('A' + 0x35) + "A>")));
    EXPECT_EQ(reader.state().counts, (std::array<int, 3>{1, -2, 32767}));
    EXPECT_EQ(reader.state().buttons, 5U);
    EXPECT_FALSE(reader.state().homed);
    EXPECT_TRUE(reader.take(bytes_of(std::string("<AAAAAAAAAAAA") + char('A' + 0x70) + "A>")));
    EXPECT_TRUE(reader.state().homed);
}

// A packet of 14 bytes had its end taken for the status (libnifalcon, pull request 30).
TEST(FalconPackets, takes_no_short_long_or_damaged_packet) {
    StateReader reader;
    ASSERT_TRUE(reader.take(bytes_of("<CAAAAAAAAAAAAA>")));
    for (const char* bad : {"<AAAAAAAAAAAA>", "<AAAAAAAAAAAAA>", "<AAAAAAAAAAAAAAA>", "AAAAAAAAAAAAAA>", ">",
                            "<", ">>>>", "<AAAAQAAAAAAAAA>", "<AAAA@AAAAAAAAA>", "<AAAAAAAAAAAA@A>"}) {
        EXPECT_FALSE(reader.take(bytes_of(bad))) << bad;
        EXPECT_EQ(reader.state().counts[0], 2) << bad;
    }
    // Each of these leaves the reader ready for the next whole packet.
    EXPECT_TRUE(reader.take(bytes_of("<AAAA<DAAAAAAAAAAAAA>")));
    EXPECT_EQ(reader.state().counts[0], 3);
}

RC_GTEST_PROP(FalconPackets, any_three_counts_come_back_from_any_pieces_between_any_bytes, ()) {
    const auto count = rc::gen::inRange(-32768, 32768);
    const std::array<int, 3> counts{*count, *count, *count};
    // What the Falcon sends has the form of what it is sent, but for the status.
    const Packet packet = command(counts, 0, false);
    auto stream = *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::arbitrary<std::uint8_t>());
    stream.insert(stream.end(), packet.begin(), packet.end());
    const auto piece = static_cast<std::size_t>(*rc::gen::inRange(1, 20));
    StateReader reader;
    bool last = false;
    for (std::size_t at = 0; at < stream.size(); at += piece)
        last = reader.take(std::span(stream).subspan(at, std::min(piece, stream.size() - at)));
    RC_ASSERT(last);
    RC_ASSERT(reader.state().counts == counts);
}

}  // namespace
}  // namespace tribo::devices::falcon
