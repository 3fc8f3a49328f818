// SPDX-License-Identifier: MIT
// The face for programs: a material as it is opened, pressed, drawn and rubbed from outside.
#include "tribo/touch.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "files/scratch.hpp"
#include "places.hpp"

namespace tribo {
namespace {

constexpr const char* kSponge = TRIBO_SOURCE_DIR "/examples/materials/sponge.json";

std::size_t pixels(const TouchMaterial& material) {
    return static_cast<std::size_t>(material.size_px()) * static_cast<std::size_t>(material.size_px());
}

TEST(TouchMaterial, yields_as_far_as_its_spring_says_and_comes_back) {
    const test::Scratch folder;
    folder.put("soft.json", R"({"schema": "tribo.material/1", "name": "soft",
        "stiffness_n_per_mm": 2, "viscosity_n_s_per_mm": 0.1, "width_mm": 64})");
    auto material = TouchMaterial::open(folder / "soft.json", {.size_px = 128});
    ASSERT_TRUE(material) << material.error().text();
    EXPECT_EQ(material->width_mm(), 64);
    EXPECT_FALSE(material->warnings().empty()) << "a plain image stands for none";
    EXPECT_FALSE(material->sounds());
    std::vector<std::uint8_t> rest(4 * pixels(*material)), drawn(rest.size());
    material->draw(rest);
    const elastic::ContactEllipse finger{.x_mm = 32.25, .y_mm = 32.25, .force_n = 1.5};
    material->press({&finger, 1});
    for (int n = 0; n < 600; ++n) material->step(1.0 / 60);
    // K is the force over the displacement at the centre.
    EXPECT_NEAR(material->depths_mm(64)[64], -1.5 / 2, 0.01);
    EXPECT_EQ(material->depths_mm(0)[0], 0);
    material->draw(drawn);
    EXPECT_NE(drawn, rest);
    material->press({});
    for (int n = 0; n < 6000 && material->step(1.0 / 60); ++n) {
    }
    material->draw(drawn);
    EXPECT_EQ(drawn, rest);
    std::vector<float> heard(4800, 1.0F);
    material->rub(100, 1);
    material->render(heard);
    for (const float x : heard) ASSERT_EQ(x, 0.0F);
}

TEST(TouchMaterial, sounds_while_it_is_rubbed) {
    auto material = TouchMaterial::open(kSponge);
    ASSERT_TRUE(material) << material.error().text();
    ASSERT_TRUE(material->sounds());
    const auto rms = [&](double speed, double force) {
        std::vector<float> heard(48000);
        material->rub(speed, force);
        material->render(heard);
        double sum = 0;
        for (std::size_t n = 4800; n < heard.size(); ++n) sum += heard[n] * static_cast<double>(heard[n]);
        return std::sqrt(sum / 43200);
    };
    EXPECT_GT(rms(100, 1), 1e-4);
    EXPECT_EQ(rms(0, 1), 0);
    EXPECT_EQ(rms(100, std::nan("")), 0);
}

TEST(TouchMaterial, refuses_in_words) {
    const test::Scratch folder;
    EXPECT_FALSE(TouchMaterial::open(folder / "none.json"));
    folder.put("bad.json", "{");
    EXPECT_FALSE(TouchMaterial::open(folder / "bad.json"));
    EXPECT_FALSE(TouchMaterial::open(kSponge, {.size_px = 5000}));
    EXPECT_FALSE(TouchMaterial::open(kSponge, {.sample_rate_hz = 10}));
}

}  // namespace
}  // namespace tribo
