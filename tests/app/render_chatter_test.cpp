// SPDX-License-Identifier: MIT
// `tribo render` of a job with modes: two columns of forces.csv, two keys of summary.json, and the howl.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

#include "app/run/benchmark_slot.hpp"
#include "app/run/job_folder.hpp"
#include "files/riff.hpp"

namespace tribo::test {
namespace {

// A slot 1 mm deep, 0.1 mm per tooth.
std::string slot(double rpm) {
    const std::string feed = std::to_string(0.2 * rpm);
    return "G21 G90 M3 S" + std::to_string(rpm) + " F" + feed + "\nG0 X-8 Y20 Z-1\nG1 X48\nM30\n";
}

class RenderChatter : public testing::Test {
  protected:
    void render(const std::string& more, double rpm, const std::vector<std::string>& flags) const {
        job.put("slot.nc", slot(rpm));
        job.put("job.toml", kBenchmarkSlot + more);
        const Outcome run = job.render(flags);
        ASSERT_EQ(run.code, 0) << run.err;
    }
    JobFolder job;
};

TEST_F(RenderChatter, adds_two_columns_and_changes_no_other) {
    render("", 9000, {"--only", "forces"});
    std::istringstream rigid(job.get("forces.csv"));
    const nlohmann::json of_rigid = job.summary();
    EXPECT_FALSE(of_rigid.contains("chatter"));
    EXPECT_FALSE(of_rigid.contains("largest_displacement_mm"));
    const double peak_n = of_rigid["peak_force_n"], mean_n = of_rigid["mean_force_n"];

    render(benchmark_mode("1, 0, 0"), 9000, {"--only", "forces"});
    std::istringstream bends(job.get("forces.csv"));
    std::string line, same;
    std::getline(rigid, same);
    std::getline(bends, line);
    EXPECT_EQ(line, same + ",multiplier,peak_displacement_mm");
    while (std::getline(rigid, same)) {
        ASSERT_TRUE(std::getline(bends, line));
        ASSERT_EQ(line.substr(0, same.size() + 1), same + ",");
    }
    double largest = 0;
    const ForceColumns rows = job.forces();
    for (const double mm : rows.at("peak_displacement_mm")) largest = std::max(largest, mm);
    for (const double multiplier : rows.at("multiplier")) EXPECT_LT(multiplier, 1);
    const nlohmann::json summary = job.summary();
    EXPECT_EQ(summary["chatter"], nlohmann::json::array());
    EXPECT_NEAR(summary["largest_displacement_mm"].get<double>(), largest, 1e-8);
    // Not more than a peak force would bend the mode at resonance, not less than half a mean force at rest.
    EXPECT_LT(largest, peak_n / 1340 / (2 * 0.011));
    EXPECT_GT(largest, 0.5 * mean_n / 1340);
}

TEST_F(RenderChatter, says_that_its_modes_are_estimated) {
    job.put("slot.nc", "G21 G90 M3 F1600\nG0 X-8 Y10 Z-1\nG1 X48\nM30\n");
    std::string text = kBenchmarkSlot;
    text.insert(text.find("[material]"), "stickout_mm = 60\n[holder]\ndiameter_mm = 40\nlength_mm = 60\n");
    job.put("job.toml", text + "[dynamics]\nestimate = true\n");
    const Outcome run = job.render({"--only", "summary,forces,report"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_FALSE(job.forces().at("multiplier").empty());
    const nlohmann::json summary = job.summary();
    EXPECT_TRUE(summary.contains("chatter"));
    const char* said = "the modes of the tool are estimated, not measured";
    EXPECT_NE(summary["warnings"].dump().find(said), std::string::npos);
    EXPECT_NE(job.get("report.html").find(said), std::string::npos);
    EXPECT_NE(job.get("report.html").find("modes estimated"), std::string::npos);
}

TEST_F(RenderChatter, names_the_lines_that_chatter_with_the_multiplier_of_the_stability_verb) {
    render(benchmark_mode("1, 0, 0"), 8000, {"--only", "summary"});
    const nlohmann::json chatter = job.summary()["chatter"];
    ASSERT_EQ(chatter.size(), 1u);
    EXPECT_EQ(chatter[0]["line"], 3);
    // The strongest line of the simulated slot; the field sees its walls to some hundredths.
    EXPECT_NEAR(chatter[0]["chatter_hz"].get<double>(), 969.0, 2);
    const std::string t_s = std::to_string(chatter[0]["t_s"].get<double>() + 1e-4);
    const Outcome other =
        run_tribo({"stability", "job.toml", "--t", t_s, "--at", "8000:1", "--json"}, job.path());
    ASSERT_EQ(other.code, 0) << other.err;
    const auto point = nlohmann::json::parse(other.out, nullptr, false)["points"][0];
    EXPECT_GT(point["multiplier"], 1);
    EXPECT_NEAR(chatter[0]["multiplier"].get<double>(), point["multiplier"].get<double>(), 1e-3);
    EXPECT_NEAR(chatter[0]["chatter_hz"].get<double>(), point["chatter_hz"].get<double>(), 1);
}

struct Line {
    double hz = 0, level_db = -400;
};

// The strongest line from `low_hz` to `high_hz` in one channel, under a Blackman-Harris window; `leaves` says
// which frequencies do not count.
template <class Leaves>
Line strongest(const std::vector<double>& stereo, double from_s, double to_s, double low_hz, double high_hz,
               Leaves&& leaves) {
    constexpr double kRate = 48000;
    const auto first = static_cast<std::size_t>(from_s * kRate),
               count = static_cast<std::size_t>((to_s - from_s) * kRate);
    std::vector<double> x(count);
    for (std::size_t n = 0; n < count; ++n) {
        const double a = 2 * std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(count);
        x[n] = stereo.at(2 * (first + n)) *
               (1 - 0.48829 / 0.35875 * std::cos(a) + 0.14128 / 0.35875 * std::cos(2 * a) -
                0.01168 / 0.35875 * std::cos(3 * a));
    }
    Line best;
    for (double hz = low_hz; hz <= high_hz; hz += 0.5) {
        if (leaves(hz)) continue;
        const std::complex<double> step = std::polar(1.0, -2 * std::numbers::pi * hz / kRate);
        std::complex<double> turn = 1, sum = 0;
        for (const double v : x) {
            sum += v * turn;
            turn *= step;
        }
        const double level = 20 * std::log10(2 * std::abs(sum) / static_cast<double>(count));
        if (level > best.level_db) best = {hz, level};
    }
    return best;
}

// The demo: 8000 rpm howls, 9000 rpm hums.
TEST_F(RenderChatter, howls_where_theory_says_and_hums_where_it_does_not) {
    for (const double rpm : {8000.0, 9000.0}) {
        render(benchmark_mode("1, 0, 0") + "[sound]\nmachine = \"none\"\nbits = 32\n", rpm,
               {"--only", "sound"});
        const std::vector<double> wave = Riff(job.get("sound.wav")).samples(32);
        const double tooth_hz = rpm / 30;
        const auto all = [](double) { return false; };
        const auto harmonic = [&](double hz) {
            return std::abs(hz - tooth_hz * std::round(hz / tooth_hz)) < 8;
        };
        const Line tooth = strongest(wave, 0.6, 1.1, tooth_hz - 2, tooth_hz + 2, all);
        const Line off = strongest(wave, 0.6, 1.1, 500, 1500, harmonic);
        if (rpm == 9000) {
            EXPECT_LT(off.level_db, tooth.level_db - 25);
            continue;
        }
        EXPECT_GT(off.level_db, tooth.level_db - 6);
        // Theory names +-chatter_hz and every tooth frequency from there.
        const nlohmann::json summary = job.summary();
        const double chatter_hz = summary["chatter"][0]["chatter_hz"];
        double nearest = 1;
        for (int n = -12; n <= 12; ++n) {
            for (const double sign : {1.0, -1.0})
                nearest = std::min(nearest, std::abs((sign * chatter_hz + n * tooth_hz) / off.hz - 1));
        }
        EXPECT_LT(nearest, 0.01) << off.hz;
    }
}

// A slot that is fully there from the first chip on: the howl grows, and nowhere is it rougher than when it
// is at its loudest.
TEST_F(RenderChatter, begins_and_ends_its_howl_without_a_click) {
    render("[engagement]\nentry_deg = 0\nexit_deg = 180\naxial_depth_mm = 1\n" + benchmark_mode("1, 0, 0") +
               "[sound]\nmachine = \"none\"\nbits = 32\n",
           8000, {"--only", "sound,forces"});
    const std::vector<double> wave = Riff(job.get("sound.wav")).samples(32);
    const auto roughest = [&](double from_s, double to_s) {
        double worst = 0;
        for (auto n = static_cast<std::size_t>(from_s * 48000); n < static_cast<std::size_t>(to_s * 48000);
             ++n)
            worst = std::max(worst, std::abs(wave.at(2 * n) - 2 * wave.at(2 * n + 2) + wave.at(2 * n + 4)));
        return worst;
    };
    const std::vector<double> t_s = job.forces().at("t_s"), lasts_s = job.forces().at("duration_s");
    const double begin_s = t_s.front(), end_s = t_s.back() + lasts_s.back();
    const double steady = roughest(end_s - 0.5, end_s - 0.1);
    EXPECT_EQ(roughest(0, begin_s), 0);
    EXPECT_GT(steady, 0);
    EXPECT_LT(roughest(begin_s, end_s - 0.5), 1.2 * steady);
    EXPECT_LT(roughest(end_s - 0.1, end_s + 0.1), 1.2 * steady);
    // It begins from nothing: in the first ten milliseconds it is much smoother.
    EXPECT_LT(roughest(begin_s, begin_s + 0.01), 0.3 * steady);
}

// A slot by a soft tool whose teeth come slowly: it bends by force over stiffness. As one tooth makes a wall,
// another one cuts at 90 deg, with ktc times its chip across the feed. So the tool cuts the left wall too
// deep and leaves as much on the right one: in surface.csv, in the summary, as deviation from the part of a
// stiff tool, and under the finger.
TEST_F(RenderChatter, leaves_the_error_of_a_wall_in_all_outputs) {
    std::string stiff = kBenchmarkSlot;
    stiff.replace(stiff.find("flutes = 2"), 10, "flutes = 4");
    job.put("slot.nc", "G21 G90 M3 S600 F120\nG0 X-8 Y20 Z-0.5\nG1 X48\nM30\n");
    job.put("job.toml", stiff);
    ASSERT_EQ(job.render({"--only", "mesh"}).code, 0);
    job.put("stiff.stl", job.get("machined.stl"));
    job.put("job.toml", stiff + R"([part]
surface = "stiff.stl"
[[mode]]
direction = [0, 1, 0]
frequency_hz = 1500
damping_ratio = 0.4
stiffness_n_per_mm = 1000
)");
    const Outcome run = job.render({"--only", "surface"});
    ASSERT_EQ(run.code, 0) << run.err;
    constexpr double kBentMm = 600 * 0.5 * 0.05 / 1000;

    const ForceColumns marks = job.columns("surface.csv");
    ASSERT_GT(marks.at("left_mm").size(), 1000u);
    for (std::size_t n = 0; n < marks.at("t_s").size(); ++n) {
        const double x = marks.at("x_mm")[n], side = marks.at("ny")[n];
        if (x < 6 || x > 34) continue;  // the whole slot
        EXPECT_NEAR(marks.at("y_mm")[n], 20 - 5 * side, 1e-6);
        EXPECT_NEAR(marks.at("left_mm")[n], side * kBentMm, 0.03 * kBentMm) << x;
        EXPECT_EQ(marks.at("line")[n], 3);
    }
    const nlohmann::json summary = job.summary(), error = summary["form_error"];
    EXPECT_NEAR(error["left_max_mm"].get<double>(), kBentMm, 0.1 * kBentMm);
    EXPECT_NEAR(error["overcut_max_mm"].get<double>(), kBentMm, 0.1 * kBentMm);
    EXPECT_EQ(error["left_line"], 3);
    EXPECT_NEAR(summary["rest_max_mm"].get<double>(), error["left_max_mm"].get<double>(), 0.002);
    EXPECT_NEAR(summary["gouge_max_mm"].get<double>(), error["overcut_max_mm"].get<double>(), 0.002);

    // Pressed 0.2 mm into the right wall, then into the left one.
    job.put("stroke.csv",
            "t_s,x_mm,y_mm,z_mm\n0,20,20,-0.2\n0.5,20,14.8,-0.2\n1,20,14.8,-0.2\n2,20,25.2,-0.2\n2.5,20,25.2,"
            "-0.2\n");
    const Outcome felt = run_tribo(
        {"feel", "job.toml", "--stroke", "stroke.csv", "--device", "playback", "--out", "out/trace.csv"},
        job.path());
    ASSERT_EQ(felt.code, 0) << felt.err;
    const ForceColumns trace = job.columns("trace.csv");
    EXPECT_NEAR(trace.at("fy_n")[900], 0.5 * (0.2 + kBentMm), 0.003);
    EXPECT_NEAR(trace.at("fy_n")[2400], -0.5 * (0.2 - kBentMm), 0.003);
    EXPECT_EQ(trace.at("fy_n")[1500], 0);
}

TEST_F(RenderChatter, refuses_a_surface_of_what_does_not_bend) {
    job.put("slot.nc", slot(9000));
    job.put("job.toml", kBenchmarkSlot);
    const Outcome run = job.render({"--only", "surface"});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("nothing in it can vibrate"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tribo::test
