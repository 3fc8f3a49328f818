// SPDX-License-Identifier: MIT
// The elastic image: a frame of a whole sheet, and what a small touch costs of it.
#include <array>
#include <cmath>

#include "elastic/sheet.hpp"
#include "harness.hpp"

namespace tribo::bench {
namespace {

constexpr int kNodes = 512;
constexpr double kFrameS = 1.0 / 60;

// A contact that moves, so that its tiles never settle.
elastic::Contact moving_contact(double radius_mm, int frame) {
    return {kNodes / 2.0 + frame % 2, kNodes / 2.0, radius_mm, radius_mm, 0, 1 + 0.01 * (frame % 7), 0};
}

struct FrameCost {
    double press_s = 0, step_s = 0;
};

FrameCost frame_cost(double radius_mm) {
    elastic::Sheet sheet({kNodes, kNodes, 1});
    sheet.set_material({1, 1});
    std::array<double, 101> press{}, step{};
    for (int frame = 0; frame < 101; ++frame) {
        const std::array contact{moving_contact(radius_mm, frame)};
        const auto at = static_cast<std::size_t>(frame);
        const double begin = thread_s();
        sheet.press(contact);
        const double pressed = thread_s();
        sheet.step(kFrameS);
        sheet.update_normals();
        press[at] = pressed - begin;
        step[at] = thread_s() - pressed;
    }
    return {median({press.begin(), press.end()}), median({step.begin(), step.end()})};
}

}  // namespace

void measure_elastic(Report& report) {
    report.section("Elastic image, 512 x 512 nodes");
    // The contact's reach covers every node; 1 % of them; none.
    const FrameCost whole = frame_cost(64);
    const FrameCost small = frame_cost(std::sqrt(0.01 * kNodes * kNodes / 3.14159265) / elastic::kReach);
    report.add({"step and normals, whole sheet", whole.step_s * 1e3, "ms", 0.2});
    report.add({"pressure, whole sheet", whole.press_s * 1e3, "ms", 0.3});
    report.add({"frame with 1 % touched, share of the whole",
                (small.step_s + small.press_s) / (whole.step_s + whole.press_s) * 100, "%", 5});
    elastic::Sheet rest({kNodes, kNodes, 1});
    rest.update_normals();
    const double begin = thread_s();
    for (int i = 0; i < 1000; ++i) {
        rest.press({});
        rest.step(kFrameS);
        rest.update_normals();
    }
    report.add({"frame at rest", (thread_s() - begin) * 1e3, "us", 10});
}

}  // namespace tribo::bench
