// SPDX-License-Identifier: MIT
// `--uncertain N` of render, audit and stability, on the built program.
#include <gtest/gtest.h>

#include "app/run/job_folder.hpp"
#include "app/run/small_inputs.hpp"

namespace tribo::test {
namespace {

using Json = nlohmann::json;

// Coefficients that are known exactly, unless `material` says more.
std::string job(const std::string& cutter, const std::string& material) {
    return "[stock]\nbox_mm = [[0, 0, -10], [30, 20, 0]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 6\nflutes "
           "= 2\n"
           "length_mm = 20\n" +
           cutter +
           "[material]\nktc_n_per_mm2 = 800\nkrc_n_per_mm2 = 200\nkac_n_per_mm2 = 100\nkte_n_per_mm = 10\n"
           "kre_n_per_mm = 10\nkae_n_per_mm = 1\n" +
           material + "[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 900\n[path]\ngcode = \"slot.nc\"\n";
}

class Uncertain : public testing::Test {
  protected:
    Uncertain() { folder_.put("slot.nc", kSlotProgram); }
    Outcome run(std::vector<std::string> call) const { return run_tribo(call, folder_.path()); }
    JobFolder folder_;
};

TEST_F(Uncertain, render_gives_bands_of_the_run_and_of_each_row) {
    folder_.put("job.toml", job("", "spread = 1\n"));
    ASSERT_EQ(
        folder_.render({"--resolution", "1", "--uncertain", "1000", "--only", "summary,forces,report"}).code,
        0);
    const Json summary = folder_.summary();
    EXPECT_EQ(summary["uncertain_cases"], 1000);
    for (const char* key : {"mean_force_n", "peak_force_n", "peak_torque_nm", "peak_power_w"}) {
        const double value = summary[key];
        const Json& band = summary[std::string(key) + "_band"];
        EXPECT_NEAR(band[0].get<double>() / value, 0.5, 0.005) << key;
        EXPECT_NEAR(band[1].get<double>() / value, 2, 0.02) << key;
    }
    const ForceColumns forces = folder_.forces();
    const std::vector<double>& low = forces.at("peak_force_low_n");
    ASSERT_FALSE(low.empty());
    for (std::size_t n = 0; n < low.size(); ++n)
        EXPECT_NEAR(forces.at("peak_force_high_n")[n] / low[n], 4, 0.06) << n;
    EXPECT_NE(folder_.get("report.html").find("\"low\":["), std::string::npos);
    EXPECT_NE(folder_.get("report.html").find("9 of 10 of 1000 cases"), std::string::npos);
}

TEST_F(Uncertain, the_same_call_gives_the_same_bands_with_any_number_of_threads) {
    folder_.put("job.toml", job("runout_mm = 0.01\nrunout_spread = 0.5\n", ""));
    const auto bands = [&](const char* threads) {
        EXPECT_EQ(folder_
                      .render({"--resolution", "1", "--uncertain", "50", "--only", "summary,forces",
                               "--threads", threads})
                      .code,
                  0);
        return folder_.get("forces.csv");
    };
    EXPECT_EQ(bands("1"), bands("3"));
}

TEST_F(Uncertain, audit_and_stability_take_it_too) {
    const std::string modes =
        "[[mode]]\ndirection = [1, 0, 0]\nfrequency_hz = 900\ndamping_ratio = 0.02\nstiffness_n_per_mm = "
        "4000\n"
        "stiffness_spread = 0.3\n";
    folder_.put("job.toml", job("", "spread = 1\n") + modes + "[limits]\nforce_n = 100\n");
    const Outcome audit = run({"audit", "job.toml", "--resolution", "1", "--uncertain", "500", "--json"});
    ASSERT_EQ(audit.code, 0) << audit.err;
    const Json load = Json::parse(audit.out)["tools"][0]["peak_force_n"]["ratio"];
    EXPECT_NEAR(load[0].get<double>() / load[1].get<double>(), 0.5, 0.01);
    EXPECT_NEAR(load[2].get<double>() / load[1].get<double>(), 2, 0.04);
    EXPECT_EQ(Json::parse(audit.out)["uncertain_cases"], 500);

    const Outcome stability = run(
        {"stability", "job.toml", "--resolution", "1", "--uncertain", "100", "--limit", "6000", "--json"});
    ASSERT_EQ(stability.code, 0) << stability.err;
    const Json limit = Json::parse(stability.out)["limits"][0];
    EXPECT_LT(limit["limit_mm_band"][0], limit["limit_mm"]);
    EXPECT_GT(limit["limit_mm_band"][1], limit["limit_mm"]);
}

TEST_F(Uncertain, refuses_a_job_without_any_spread) {
    folder_.put("job.toml", job("runout_spread = 0.5\n", ""));
    for (const char* verb : {"render", "audit"}) {
        const Outcome refused = run({verb, "job.toml", "--out", "o", "--uncertain", "50"});
        EXPECT_EQ(refused.code, 2);
        EXPECT_NE(refused.err.find("nothing in this job has a spread"), std::string::npos) << refused.err;
    }
    const Outcome live = run({"live", "job.toml", "--port", "0", "--uncertain", "50"});
    EXPECT_EQ(live.code, 2);
    EXPECT_NE(live.err.find("nothing in this job has a spread"), std::string::npos) << live.err;
    EXPECT_EQ(run({"live", "--uncertain", "50"}).code, 2);
    EXPECT_EQ(folder_.render({"--uncertain", "9"}).code, 2);
    EXPECT_EQ(folder_.render({"--uncertain", "20.5"}).code, 2);
}

}  // namespace
}  // namespace tribo::test
