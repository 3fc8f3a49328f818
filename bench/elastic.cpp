// SPDX-License-Identifier: MIT
// The elastic image: a frame of a whole sheet, and what a small touch costs of it.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "elastic/picture.hpp"
#include "elastic/sheet.hpp"
#include "harness.hpp"

namespace tribo::bench {
namespace {

constexpr int kNodes = 512;
constexpr double kFrameS = 1.0 / 60;

// A contact that moves, so that its tiles never settle.
elastic::ContactEllipse moving_contact(double radius_mm, int frame) {
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

// Seconds to draw a pressed sheet whole, by one thread.
double picture_s(const elastic::Finish* finish) {
    elastic::Sheet sheet({kNodes, kNodes, 80.0 / kNodes});
    sheet.set_material({1.4, 0});
    elastic::ContactEllipse contact;
    contact.x_mm = contact.y_mm = 40;
    contact.force_n = 1;
    sheet.press({&contact, 1});
    sheet.step(1);
    const std::vector<std::uint8_t> image(std::size_t{4} * kNodes * kNodes, 150);
    std::vector<std::uint8_t> out(image.size());
    std::vector<double> seconds(7);
    for (double& s : seconds) {
        const double begin = thread_s();
        elastic::draw_rows(sheet, image, out, 0, kNodes, finish);
        s = thread_s() - begin;
    }
    return median(seconds);
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
    const elastic::SmallRelief relief{kNodes, kNodes, std::vector<std::int8_t>(2 * kNodes * kNodes, 9)};
    const elastic::Finish finish{&relief};
    const double lit_s = picture_s(&finish);
    report.add({"picture with a finish, one thread", lit_s * 1e3, "ms", 150});
    report.add({"of it, over one as published", lit_s / picture_s(nullptr), "x", 1.5});
}

}  // namespace tribo::bench
