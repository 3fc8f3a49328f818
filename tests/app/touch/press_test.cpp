// SPDX-License-Identifier: MIT
// `tribo press` from outside: frames against an independent computation of the touch paper's equations, and
// what comes out of good and bad calls.
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/run/program.hpp"
#include "base/hash.hpp"
#include "elastic/colour_difference.hpp"
#include "files/image/image_file.hpp"
#include "files/image/png.hpp"
#include "places.hpp"

namespace tribo::test {
namespace {

constexpr int kSize = 48;
constexpr double kWidthMm = 60, kRadiusMm = 5, kFps = 30;

std::string material(double k, double nu) {
    return R"({"schema": "tribo.material/1", "width_mm": 60, "stiffness_n_per_mm": )" + std::to_string(k) +
           R"(, "viscosity_n_s_per_mm": )" + std::to_string(nu) + "}";
}

// Pressed from 0 to 0.4 s while it moves, lifted, pressed again from 0.6 s.
constexpr const char* kStroke =
    "t_s,x_mm,y_mm,force_n\n0,20,30,1\n0.4,40,30,1\n0.401,40,30,0\n0.599,10,12,0\n0.6,10,12,2\n0.8,12,12,2\n";
constexpr int kFrames = 25;

struct Touch {
    bool down;
    double x, y, held;
};
Touch touch_at(int frame) {
    const double t = frame / kFps;
    if (t <= 0.4) return {true, 20 + 50 * t, 30, t};
    if (t < 0.5999) return {false, 0, 0, 0};
    return {true, 10 + 10 * (t - 0.6), 12, t - 0.6};
}

std::vector<float> heights(const Scratch& scratch, int frame) {
    char name[40];
    std::snprintf(name, sizeof name, "out/frame_%04d.f32", frame);
    const std::string bytes = scratch.get(name);
    std::vector<float> values(bytes.size() / sizeof(float));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    return values;
}

Outcome press(const Scratch& scratch, std::vector<std::string> more) {
    std::vector<std::string> arguments{"press", "m.json", "--stroke", "s.csv", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tribo(arguments, scratch.path());
}

// Equation 1, 2 or the point limit, straight from the page.
double published(bool area, double d, double t) {
    const double reach = 40 * kRadiusMm;
    if (d > reach) return 0;
    if (!area) return t == 0 ? 0 : -std::exp(-5 * d / (reach * t)) * t;
    if (d <= kRadiusMm) return (std::exp(5 * (d - kRadiusMm) / kRadiusMm) - 1) / 10 - t;
    return t == 0 ? 0 : -std::exp(-5 * (d - kRadiusMm) / (reach * t)) * (t - 1.0 / 50);
}

TEST(Press, frames_as_published_are_equations_1_to_3) {
    const double k = 1.4, nu = 0.1, ts = 1 / kFps;
    for (const bool area : {true, false}) {
        Scratch scratch;
        scratch.put("m.json", material(k, nu));
        scratch.put("s.csv", kStroke);
        const Outcome run = press(scratch, {"--as-published", "--heights", "--size", "48", "--fps", "30",
                                            "--radius-mm", "5", "--contact", area ? "area" : "point"});
        ASSERT_EQ(run.code, 0) << run.err;
        std::vector<double> e(kSize * kSize);
        for (int frame = 0; frame < kFrames; ++frame) {
            const std::vector<float> written = heights(scratch, frame);
            ASSERT_EQ(written.size(), e.size()) << frame;
            const Touch touch = touch_at(frame);
            for (int i = 0; i < kSize * kSize; ++i) {
                const double x = (i % kSize + 0.5) * kWidthMm / kSize;
                const double y = (std::floor(i / kSize) + 0.5) * kWidthMm / kSize;
                const double p =
                    touch.down ? published(area, std::hypot(x - touch.x, y - touch.y), touch.held) : 0;
                double& node = e[static_cast<std::size_t>(i)];
                node = (p + nu / ts * node) / (k + nu / ts);
                ASSERT_NEAR(written[static_cast<std::size_t>(i)], node, 1e-5) << frame << ' ' << i;
            }
        }
        EXPECT_TRUE(heights(scratch, kFrames).empty());
    }
}

TEST(Press, default_frames_do_not_depend_on_their_rate_and_never_rise) {
    std::vector<float> at_30;
    for (const int rate : {30, 60, 144}) {
        Scratch scratch;
        scratch.put("m.json", material(4, 0.8));
        scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,25,30,2\n1,25,30,2\n");
        const Outcome run = press(scratch, {"--heights", "--size", "48", "--fps", std::to_string(rate)});
        ASSERT_EQ(run.code, 0) << run.err;
        const std::vector<float> end = heights(scratch, rate);
        ASSERT_EQ(end.size(), std::size_t{kSize * kSize});
        if (at_30.empty()) at_30 = end;
        for (std::size_t i = 0; i < end.size(); ++i) {
            EXPECT_LE(end[i], 0);
            EXPECT_NEAR(end[i], at_30[i], 1e-5 + 0.01 * std::abs(at_30[i]));
        }
        // Under the finger: 2 N over 4 N/mm, five time constants on.
        EXPECT_NEAR(end[24 * kSize + 20], -0.5 * (1 - std::exp(-5)), 0.01);
    }
}

// A finger over the middle of node 20, 24. Under it the depth is that of one spring and damper.
std::vector<double> depths_under(const std::string& stroke, int rate) {
    Scratch scratch;
    scratch.put("m.json", material(4, 0.8));
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n" + stroke);
    const Outcome run = press(scratch, {"--heights", "--size", "48", "--fps", std::to_string(rate)});
    EXPECT_EQ(run.code, 0) << run.err;
    std::vector<double> depths;
    for (int frame = 0; frame <= rate; ++frame) {
        const std::vector<float> e = heights(scratch, frame);
        depths.push_back(e.empty() ? NAN : -e[24 * kSize + 20]);
    }
    return depths;
}

TEST(Press, a_frame_shows_the_depth_at_its_own_time) {
    for (const int rate : {20, 60, 144, 500}) {
        const std::vector<double> sudden = depths_under(
            "0,25.625,30.625,0\n0.4999,25.625,30.625,0\n0.5,25.625,30.625,2\n1,25.625,30.625,2\n", rate);
        const std::vector<double> growing = depths_under("0,25.625,30.625,0\n1,25.625,30.625,2\n", rate);
        // A force that grows is taken as constant from frame to frame: off by at most its growth dt^2 / (12
        // tau).
        const double chords = 0.5 / (12 * 0.2 * rate * rate) + 1e-5;
        for (int frame = 0; frame <= rate; ++frame) {
            const auto n = static_cast<std::size_t>(frame);
            const double t = 1.0 * frame / rate, held = std::max(t - 0.5, 0.0);
            EXPECT_NEAR(sudden[n], 0.5 * (1 - std::exp(-held / 0.2)), 1e-5) << rate << ' ' << t;
            EXPECT_NEAR(growing[n], 0.5 * (t - 0.2 * (1 - std::exp(-t / 0.2))), chords) << rate << ' ' << t;
        }
    }
}

TEST(Press, a_frame_before_the_touch_is_the_image_itself) {
    Scratch scratch;
    files::Image image{kSize, kSize, std::vector<std::uint8_t>(4 * kSize * kSize)};
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        image.rgba[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 255 : (i * i) % 256);
    }
    scratch.put("image.png", files::png_bytes(image));
    std::string with_image = material(1.4, 0.1);
    with_image.insert(with_image.size() - 1, R"(, "image": "image.png")");
    scratch.put("m.json", with_image);
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,30,30,0\n0.1,30,30,0\n0.101,30,30,3\n0.3,30,30,3\n");
    const Outcome run = press(scratch, {"--size", "48", "--fps", "20"});
    ASSERT_EQ(run.code, 0) << run.err;
    const auto first = files::parse_image(scratch.get("out/frame_0000.png"), "first");
    const auto last = files::parse_image(scratch.get("out/frame_0006.png"), "last");
    ASSERT_TRUE(first && last);
    EXPECT_EQ(first->rgba, image.rgba);
    EXPECT_NE(last->rgba, image.rgba);
    EXPECT_TRUE(scratch.get("out/frame_0000.f32").empty());
    const auto summary = nlohmann::json::parse(scratch.get("out/summary.json"));
    EXPECT_EQ(summary["schema"], "tribo.press/1");
    EXPECT_EQ(summary["frames"], 7);
}

// A picture of its own with the keys in `more`, pressed and drawn at 48 x 48.
std::string last_frame(const std::string& more, std::vector<std::string> flags,
                       const files::Image* height_map = nullptr) {
    Scratch scratch;
    files::Image image{kSize, kSize, std::vector<std::uint8_t>(4 * kSize * kSize, 255)};
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(80 + (i / 4 * 31 + i % 4 * 7) % 120);
    }
    scratch.put("image.png", files::png_bytes(image));
    if (height_map != nullptr) scratch.put("map.png", files::png_bytes(*height_map));
    std::string text = material(1.4, 0.1);
    text.insert(text.size() - 1, R"(, "image": "image.png")" + more);
    scratch.put("m.json", text);
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,25,30,1\n0.5,25,30,1\n");
    flags.insert(flags.end(), {"--size", "48", "--fps", "10"});
    const Outcome run = press(scratch, std::move(flags));
    EXPECT_EQ(run.code, 0) << run.err;
    const auto frame = files::parse_image(scratch.get("out/frame_0005.png"), "frame");
    EXPECT_TRUE(frame);
    return frame ? std::string(frame->rgba.begin(), frame->rgba.end()) : "";
}

// The hash of what Tribo 0.1 drew before materials had a finish.
TEST(Press, as_published_draws_the_same_frames_whatever_the_finish) {
    const std::string plain = last_frame("", {"--as-published"});
    Hash hash;
    hash.add(std::string_view(plain));
    EXPECT_EQ(hash.value(), 5421012510701842409U);
    EXPECT_TRUE(last_frame(R"(, "gloss": 1, "roughness": 0.1, "relief_slope": 1, "pile": 1)",
                           {"--as-published"}) == plain);
}

TEST(Press, half_a_newton_is_seen_on_two_percent_of_paper_and_ten_of_sponge) {
    for (const auto& [name, share] : {std::pair{"paper", 0.02}, {"sponge", 0.10}}) {
        Scratch scratch;
        scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,40,40,0\n0.1,40,40,0\n0.101,40,40,0.5\n1,40,40,0.5\n");
        const std::string file = std::string(TRIBO_SOURCE_DIR) + "/examples/materials/" + name + ".json";
        const Outcome run =
            run_tribo({"press", file, "--stroke", "s.csv", "--out", "out", "--fps", "10", "--size", "256"},
                      scratch.path());
        ASSERT_EQ(run.code, 0) << run.err;
        const auto rest = files::parse_image(scratch.get("out/frame_0000.png"), "rest");
        const auto pressed = files::parse_image(scratch.get("out/frame_0010.png"), "pressed");
        ASSERT_TRUE(rest && pressed);
        EXPECT_GE(elastic::share_seen(rest->rgba, pressed->rgba), share) << name;
    }
}

TEST(Press, lights_a_material_by_its_finish_and_its_height_map) {
    const std::string usual = last_frame("", {});
    EXPECT_TRUE(last_frame(R"(, "gloss": 0.04, "roughness": 0.5, "relief_slope": 0.2)", {}) == usual);
    EXPECT_FALSE(last_frame(R"(, "gloss": 0.5)", {}) == usual);
    EXPECT_FALSE(last_frame(R"(, "roughness": 0.2)", {}) == usual);
    EXPECT_FALSE(last_frame(R"(, "relief_slope": 0.5)", {}) == usual);
    // A level map is no relief at all.
    const files::Image level{kSize, kSize, std::vector<std::uint8_t>(4 * kSize * kSize, 128)};
    EXPECT_TRUE(last_frame(R"(, "height_map": "map.png")", {}, &level) ==
                last_frame(R"(, "relief_slope": 0)", {}));
}

TEST(Press, keeps_the_trail_of_a_finger_on_a_pile_after_it_has_left) {
    const auto rubbed = [](const std::string& pile) {
        Scratch scratch;
        scratch.put("m.json", R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 4,
            "viscosity_n_s_per_mm": 0, "width_mm": 80, "pile": )" +
                                  pile + "}");
        scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,20,40,1\n0.5,60,40,1\n0.6,60,40,0\n1,60,40,0\n");
        const Outcome run = press(scratch, {"--size", "48", "--fps", "10"});
        EXPECT_EQ(run.code, 0) << run.err;
        const auto frame = files::parse_image(scratch.get("out/frame_0010.png"), "frame");
        return frame ? frame->rgba : std::vector<std::uint8_t>();
    };
    EXPECT_GT(elastic::share_seen(rubbed("0"), rubbed("0.5")), 0.05);
}

TEST(Press, refuses_what_it_cannot_do_and_leaves_nothing) {
    Scratch scratch;
    scratch.put("m.json", material(1.4, 0.1));
    scratch.put("s.csv", kStroke);
    const auto expect_refusal = [&](std::vector<std::string> more, const std::string& part) {
        const Outcome run = press(scratch, std::move(more));
        EXPECT_EQ(run.code, 2);
        EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
    };
    expect_refusal({"--contact", "line"}, "--contact");
    expect_refusal({"--size", "0"}, "--size");
    expect_refusal({"--fps", "nan"}, "--fps");
    expect_refusal({"--radius-mm", "0"}, "--radius-mm");
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,1,1,1\n1000,1,1,1\n");
    expect_refusal({"--fps", "9999"}, "frames");
    scratch.put("s.csv", "t_s,x_mm\n");
    expect_refusal({}, "s.csv");
    scratch.put("s.csv", kStroke);
    scratch.put("m.json", "{}");
    expect_refusal({}, "m.json");
    std::string without_image = material(1.4, 0.1);
    without_image.insert(without_image.size() - 1, R"(, "image": "gone.png")");
    scratch.put("m.json", without_image);
    expect_refusal({}, "gone.png");
    scratch.put("gone.png", "not a picture");
    expect_refusal({}, "gone.png");
    const files::Image image{4, 3, std::vector<std::uint8_t>(48, 200)}, turned{3, 4, image.rgba};
    scratch.put("gone.png", files::png_bytes(image));
    without_image.insert(without_image.size() - 1, R"(, "height_map": "map.png")");
    scratch.put("m.json", without_image);
    expect_refusal({}, "map.png");
    scratch.put("map.png", "no picture either");
    expect_refusal({}, "map.png");
    scratch.put("map.png", files::png_bytes(turned));
    expect_refusal({}, "map.png: error: the height map has 3 x 4 pixels");
    expect_refusal({}, "4 x 3 pixels, as the image");
    scratch.put("m.json", "{\n\"schema\": \"tribo.material/1\",\n\"gloss\": NaN}");
    expect_refusal({}, "m.json:3:");
}

}  // namespace
}  // namespace tribo::test
