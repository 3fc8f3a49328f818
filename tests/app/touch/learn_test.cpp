// SPDX-License-Identifier: MIT
// `tribo learn` from outside: what becomes of recordings of known spectrum and level, and of bad calls.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "app/run/program.hpp"
#include "files/image/png.hpp"
#include "files/riff.hpp"

namespace tribo::test {
namespace {

constexpr int kRate = 44100;

// Two resonances: poles at r e^{+-iw}. As a predictor a_1 ... a_4.
const std::array<double, 5>& resonances() {
    static const std::array<double, 5> a = [] {
        const auto pair = [](double hz, double r) {
            return std::array{1.0, -2 * r * std::cos(2 * std::numbers::pi * hz / kRate), r * r};
        };
        const auto p = pair(1200, 0.95), q = pair(5200, 0.9);
        std::array<double, 5> both{};
        for (std::size_t n = 0; n < 3; ++n) {
            for (std::size_t m = 0; m < 3; ++m) both[n + m] += p[n] * q[m];
        }
        return both;
    }();
    return a;
}

// Seconds of noise through them with an RMS of `level_db` dB of full scale.
std::vector<double> rubbed(double level_db, double seconds, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss;
    std::vector<double> x(static_cast<std::size_t>(seconds * kRate));
    double power = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
        x[n] = gauss(random);
        for (std::size_t k = 1; k < 5 && k <= n; ++k) x[n] -= resonances()[k] * x[n - k];
        power += x[n] * x[n] / static_cast<double>(x.size());
    }
    for (double& v : x) v *= std::pow(10, level_db / 20) / std::sqrt(power);
    return x;
}

// |1 / A| in dB.
double gain_db(const std::vector<double>& a, double hz) {
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        sum += std::polar(a[k], -2 * std::numbers::pi * hz / kRate * static_cast<double>(k));
    }
    return -20 * std::log10(std::abs(sum));
}

class Learn : public testing::Test {
  protected:
    Learn() {
        scratch.put("slow.wav", wav(kRate, rubbed(-40, 6, 1)));
        scratch.put("fast.wav", wav(kRate, rubbed(-26, 6, 2)));
    }
    Outcome learn(std::vector<std::string> more) const {
        more.insert(more.begin(), "learn");
        return run_tribo(more, scratch.path());
    }
    Scratch scratch;
};

TEST_F(Learn, gives_the_spectrum_and_levels_of_recordings_in_any_order) {
    const Outcome run = learn({"--recording", "400:fast.wav", "--recording", "40:slow.wav", "--out", "m.json",
                               "--stiffness", "2.5", "--viscosity", "0.2", "--note", "made up"});
    ASSERT_EQ(run.code, 0) << run.err;
    const auto m = nlohmann::json::parse(scratch.get("m.json"));
    EXPECT_EQ(m["schema"], "tribo.material/1");
    EXPECT_EQ(m["name"], "m");
    EXPECT_EQ(m["note"], "made up");
    EXPECT_EQ(m["stiffness_n_per_mm"], 2.5);
    ASSERT_EQ(m["voices"].size(), 2u);
    EXPECT_EQ(m["voices"][0]["speed_mm_per_s"], 40);
    EXPECT_EQ(m["voices"][1]["speed_mm_per_s"], 400);
    EXPECT_EQ(m["voices"][0]["recordings"][0]["file"], "slow.wav");
    // A decade of speed, 14 dB; half way, at 126 mm/s, -33 dB.
    EXPECT_NEAR(m["voices"][0]["level_db"].get<double>(), -40, 0.5);
    EXPECT_NEAR(m["voices"][1]["level_db"].get<double>(), -26, 0.5);
    EXPECT_NEAR(m["level_law"]["db_per_decade_speed"].get<double>(), 14, 0.5);
    for (const auto& voice : m["voices"]) {
        // Step-up, as the page on material files tells it.
        std::vector<double> a{1};
        for (const double k : voice["reflection"].get<std::vector<double>>()) {
            EXPECT_LT(std::abs(k), 1);
            const std::vector<double> before = a;
            a.push_back(k);
            for (std::size_t i = 1; i < before.size(); ++i) a[i] += k * before[before.size() - i];
        }
        std::vector<double> off;
        double mean = 0, square = 0;
        for (double hz = 200; hz <= 20000; hz += 50) {
            off.push_back(gain_db(a, hz) - gain_db({resonances().begin(), resonances().end()}, hz));
        }
        for (const double d : off) mean += d / static_cast<double>(off.size());
        for (const double d : off) square += (d - mean) * (d - mean) / static_cast<double>(off.size());
        EXPECT_LT(std::sqrt(square), 1);  // log-spectral distance, dB
    }
    EXPECT_EQ(scratch.entries(), 3u);
    const Outcome inspect = run_tribo({"inspect", "m.json", "--json"}, scratch.path());
    EXPECT_EQ(inspect.code, 0) << inspect.err;
}

TEST_F(Learn, writes_a_page_that_shows_and_plays_original_and_imitation) {
    const Outcome run = learn({"--recording", "40:slow.wav", "--recording", "400:fast.wav", "--out",
                               "cork.json", "--report", "--order", "12", "--method", "burg"});
    ASSERT_EQ(run.code, 0) << run.err;
    const auto m = nlohmann::json::parse(scratch.get("cork.json"));
    EXPECT_EQ(m["method"], "burg");
    EXPECT_EQ(m["voices"][0]["reflection"].size(), 12u);
    const std::string page = scratch.get("cork.html");
    const auto count = [&](std::string_view what) {
        std::size_t n = 0;
        for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++n;
        return n;
    };
    EXPECT_TRUE(page.starts_with("<!doctype html>") || page.starts_with("<!DOCTYPE html>"));
    EXPECT_GE(count("<audio"), 4u);  // two voices, recording and imitation of each
    EXPECT_GE(count("<svg") + count("<canvas"), 2u);
    for (const char* measure : {"urtosis", "10 ms", "held", "slow.wav", "fast.wav"}) {
        EXPECT_GT(count(measure), 0u) << measure;
    }
    // It opens offline: nothing is fetched from anywhere.
    for (const char* away : {"src=\"http", "href=\"http", "@import", "fetch("})
        EXPECT_EQ(count(away), 0u) << away;
}

TEST_F(Learn, reports_silence_and_clipping_and_learns_from_the_rest) {
    std::vector<double> x = rubbed(-6, 4, 3);  // peaks beyond full scale are cut off
    x.insert(x.end(), 4 * kRate, 0.0);
    scratch.put("odd.wav", wav(kRate, x));
    const Outcome run = learn({"--recording", "100@0.5:odd.wav", "--out", "m.json"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("silen"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("clip"), std::string::npos) << run.err;
    const auto m = nlohmann::json::parse(scratch.get("m.json"));
    EXPECT_EQ(m["voices"][0]["force_n"], 0.5);
    EXPECT_NEAR(m["voices"][0]["recordings"][0]["silent_share"].get<double>(), 0.5, 0.02);
    EXPECT_GT(m["voices"][0]["recordings"][0]["clipped_share"].get<double>(), 0.001);
    EXPECT_NEAR(m["voices"][0]["level_db"].get<double>(), -6, 1);
}

TEST_F(Learn, takes_down_how_the_image_takes_the_light_and_no_more_than_was_said) {
    const std::vector<std::uint8_t> pixels(24, 90);
    scratch.put("image.png", files::png_bytes({2, 3, pixels}));
    scratch.put("map.png", files::png_bytes({2, 3, pixels}));
    const auto learned = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--recording", "40:slow.wav", "--order", "4", "--image", "image.png",
                                 "--out", "m.json"});
        const Outcome run = learn(more);
        EXPECT_EQ(run.code, 0) << run.err;
        return nlohmann::json::parse(scratch.get("m.json"));
    };
    const auto m = learned({"--height-map", "map.png", "--relief-slope", "0", "--gloss", "0.5", "--roughness",
                            "0.1", "--pile", "0.4"});
    EXPECT_EQ(m["height_map"], "map.png");
    EXPECT_EQ(m["relief_slope"], 0);
    EXPECT_EQ(m["gloss"], 0.5);
    EXPECT_EQ(m["pile"], 0.4);
    EXPECT_EQ(m["roughness"], 0.1);
    const auto usual = learned({});
    for (const char* key : {"height_map", "relief_slope", "gloss", "roughness", "pile"})
        EXPECT_FALSE(usual.contains(key)) << key;
}

TEST_F(Learn, refuses_bad_calls_by_name_and_leaves_what_was_there) {
    scratch.put("silent.wav", wav(kRate, std::vector<double>(2 * kRate)));
    scratch.put("short.wav", wav(kRate, rubbed(-20, 0.01, 1)));
    scratch.put("text.wav", "not a sound");
    const std::vector<std::uint8_t> pixels(24, 90);
    scratch.put("image.png", files::png_bytes({2, 3, pixels}));
    scratch.put("turned.png", files::png_bytes({3, 2, pixels}));
    scratch.put("m.json", "old");
    const std::size_t before = scratch.entries();
    const auto refuses = [&](std::vector<std::string> more, const std::string& part) {
        more.insert(more.end(), {"--out", "m.json"});
        const Outcome run = learn(more);
        EXPECT_EQ(run.code, 2) << part;
        EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
        EXPECT_EQ(scratch.get("m.json"), "old");
        EXPECT_EQ(scratch.entries(), before);
    };
    refuses({}, "--recording");
    refuses({"--recording", "slow.wav"}, "slow.wav");
    refuses({"--recording", "0:slow.wav"}, "speed");
    refuses({"--recording", "nan:slow.wav"}, "speed");
    refuses({"--recording", "40@-1:slow.wav"}, "force");
    refuses({"--recording", "40:"}, "file");
    refuses({"--recording", "40:text.wav"}, "text.wav");
    refuses({"--recording", "40:silent.wav"}, "silent.wav");
    refuses({"--recording", "40:short.wav"}, "short.wav");
    refuses({"--recording", "40:slow.wav", "--recording", "90:text.wav"}, "text.wav");
    refuses({"--recording", "40:slow.wav", "--method", "guess"}, "--method");
    refuses({"--recording", "40:slow.wav", "--order", "0"}, "--order");
    refuses({"--recording", "40:slow.wav", "--stiffness", "nan"}, "--stiffness");
    refuses({"--recording", "40:slow.wav", "--image", "gone.png"}, "gone.png");
    refuses({"--recording", "40:slow.wav", "--gloss", "1.5"}, "--gloss");
    refuses({"--recording", "40:slow.wav", "--gloss", "nan"}, "--gloss");
    refuses({"--recording", "40:slow.wav", "--roughness", "0"}, "--roughness");
    refuses({"--recording", "40:slow.wav", "--relief-slope", "-0.1"}, "--relief-slope");
    refuses({"--recording", "40:slow.wav", "--height-map", "map.png"}, "--image");
    refuses({"--recording", "40:slow.wav", "--image", "image.png", "--height-map", "gone.png"}, "gone.png");
    refuses({"--recording", "40:slow.wav", "--image", "image.png", "--height-map", "text.wav"}, "text.wav");
    refuses({"--recording", "40:slow.wav", "--image", "image.png", "--height-map", "turned.png"},
            "turned.png: error: the height map has 3 x 2 pixels; give one of 2 x 3 pixels, as the image");
}

TEST_F(Learn, names_folders_and_files_that_are_not_there) {
    EXPECT_EQ(learn({"--recording", "40:slow.wav", "--order", "4", "--out", "no/such/folder/m.json"}).code,
              2);
    const Outcome run = learn({"--recording", "40:gone.wav", "--out", "m.json"});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("gone.wav"), std::string::npos);
    EXPECT_EQ(scratch.entries(), 2u);
    // A device that takes nothing is the system's refusal.
    EXPECT_EQ(learn({"--recording", "40:slow.wav", "--order", "4", "--out", "/dev/full"}).code, 3);
}

}  // namespace
}  // namespace tribo::test
