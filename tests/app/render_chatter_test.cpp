// SPDX-License-Identifier: MIT
// `tribo render` of a job with modes: two columns of forces.csv, two keys of summary.json.
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "app/run/program.hpp"
#include "app/run/small_inputs.hpp"

namespace tribo::test {
namespace {

std::string mode(double stiffness_n_per_mm) {
    return "[[mode]]\ndirection = [1, 0, 0]\nfrequency_hz = 922\ndamping_ratio = 0.03\nstiffness_n_per_mm "
           "= " +
           std::to_string(stiffness_n_per_mm) + "\n";
}

struct Rendered {
    nlohmann::json summary;
    std::vector<std::string> lines;  // of forces.csv, without the header
    std::string header;
};

class RenderChatter : public testing::Test {
  protected:
    Rendered render(const std::string& more, std::vector<std::string> flags = {}) const {
        scratch.put("slot.nc", kSlotProgram);
        scratch.put("job.toml", kSlotJob + more);
        const std::vector<std::string> verb{"render", "job.toml", "--out", "out", "--resolution", "0.5"};
        flags.insert(flags.begin(), verb.begin(), verb.end());
        const Outcome outcome = run_tribo(flags, scratch.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        Rendered rendered;
        rendered.summary = nlohmann::json::parse(scratch.get("out/summary.json"), nullptr, false);
        std::istringstream csv(scratch.get("out/forces.csv"));
        std::getline(csv, rendered.header);
        for (std::string line; std::getline(csv, line);) rendered.lines.push_back(line);
        return rendered;
    }
    Scratch scratch;
};

double cell(const std::string& line, int from_the_end) {
    std::size_t at = line.size();
    for (int n = 0; n < from_the_end; ++n) at = line.rfind(',', at - 1);
    return std::stod(line.substr(at + 1));
}

TEST_F(RenderChatter, adds_two_columns_and_changes_no_other) {
    const Rendered rigid = render("", {"--only", "forces"});
    EXPECT_FALSE(rigid.summary.contains("chatter"));
    EXPECT_FALSE(rigid.summary.contains("largest_displacement_mm"));
    const Rendered bends = render(mode(20'000), {"--only", "forces"});
    EXPECT_EQ(bends.header, rigid.header + ",multiplier,peak_displacement_mm");
    ASSERT_EQ(bends.lines.size(), rigid.lines.size());
    double largest = 0;
    for (std::size_t n = 0; n < rigid.lines.size(); ++n) {
        ASSERT_EQ(bends.lines[n].substr(0, rigid.lines[n].size() + 1), rigid.lines[n] + ",");
        EXPECT_LT(cell(bends.lines[n], 2), 1);
        EXPECT_GT(cell(bends.lines[n], 1), 0);
        largest = std::max(largest, cell(bends.lines[n], 1));
    }
    EXPECT_TRUE(bends.summary["chatter"].is_array());
    EXPECT_TRUE(bends.summary["chatter"].empty());
    EXPECT_NEAR(bends.summary["largest_displacement_mm"].get<double>(), largest, 1e-8);
    // Not more than a peak force would bend the mode at resonance, not less than half a mean force at rest.
    const double peak_n = rigid.summary["peak_force_n"], mean_n = rigid.summary["mean_force_n"];
    EXPECT_LT(largest, peak_n / 20'000 / (2 * 0.03));
    EXPECT_GT(largest, 0.5 * mean_n / 20'000);
}

TEST_F(RenderChatter, names_the_lines_that_chatter_with_the_multiplier_of_the_stability_verb) {
    const Rendered soft = render(mode(1500), {"--only", "summary"});
    const auto& chatter = soft.summary["chatter"];
    ASSERT_EQ(chatter.size(), 1u);
    EXPECT_EQ(chatter[0]["line"], 3);
    const Outcome other =
        run_tribo({"stability", "job.toml", "--resolution", "0.5", "--t",
                   std::to_string(chatter[0]["t_s"].get<double>() + 1e-4), "--at", "6000:2", "--json"},
                  scratch.path());
    ASSERT_EQ(other.code, 0) << other.err;
    const auto point = nlohmann::json::parse(other.out, nullptr, false)["points"][0];
    EXPECT_GT(point["multiplier"], 1);
    EXPECT_NEAR(chatter[0]["multiplier"].get<double>(), point["multiplier"].get<double>(), 1e-3);
    EXPECT_NEAR(chatter[0]["chatter_hz"].get<double>(), point["chatter_hz"].get<double>(), 1);
}

}  // namespace
}  // namespace tribo::test
