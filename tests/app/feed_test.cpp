// SPDX-License-Identifier: MIT
// `tribo feed` from outside: what it writes, what it leaves, refusals.
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

#include "app/run/benchmark_slot.hpp"
#include "app/run/program.hpp"

namespace tribo::test {
namespace {

constexpr const char* kFeedSlots =
    "G21 G90 M3 S8000\nG0 X-8 Y20 Z5\nZ-1\nG1 X20 F1600 (first)\nX48\nG0 Z5\nY35\nX-8\nZ-0.5\nG1 X48\nG0 "
    "Z5\nM30\n";

class FeedVerb : public testing::Test {
  protected:
    Outcome run(std::vector<std::string> flags, const std::string& program = kFeedSlots) const {
        scratch.put("slot.nc", program);
        scratch.put("job.toml", kBenchmarkSlot);
        flags.insert(flags.begin(), {"feed", "job.toml"});
        return run_tribo(flags, scratch.path());
    }
    nlohmann::json audit(const std::string& program) const {
        scratch.put("slot.nc", program);
        const Outcome outcome = run_tribo({"audit", "job.toml", "--json"}, scratch.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out, nullptr, false);
    }
    Scratch scratch;
};

TEST_F(FeedVerb, changes_the_feed_words_alone_and_reaches_the_target) {
    const Outcome outcome = run({"--out", "new.nc", "--force-n", "40", "--chip-mm", "0.001:1"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string text = scratch.get("new.nc");
    // Without its feed words it is the old program.
    std::string bare, old = kFeedSlots;
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] == 'F') {
            while (n + 1 < text.size() && (std::isdigit(text[n + 1]) || text[n + 1] == '.')) ++n;
            if (!bare.empty() && bare.back() == ' ') bare.pop_back();
            continue;
        }
        bare += text[n];
    }
    old.erase(old.find(" F1600"), 6);
    EXPECT_EQ(bare, old);
    // Two teeth, never both in the slot: the force is depth f (600^2 + 200^2)^0.5, so f = 40 / 632.5.
    const auto json = audit(text);
    EXPECT_LE(json["tools"][0]["peak_force_n"]["value"].get<double>(), 40 * 1.01);
    EXPECT_GE(json["tools"][0]["peak_force_n"]["value"].get<double>(), 40 * 0.98);
    const auto feed_behind = [&](const std::string& words) {
        return std::stod(text.substr(text.find(words) + words.size()));
    };
    EXPECT_NEAR(feed_behind("G1 X20 F"), 1011.9, 10) << text;
    EXPECT_NEAR(feed_behind("G1 X48 F"), 2023.9, 20) << text;
}

// Zigzags of random depths, widths and feeds. As the edges have no force of their own, the peak of a program
// that is slowed evenly is in proportion to its feeds.
TEST_F(FeedVerb, is_faster_than_slowing_the_whole_program_evenly_to_the_same_peak) {
    std::mt19937 random(20'261'125);
    const auto between = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    const auto peak_of = [](const nlohmann::json& audited) {
        return audited["tools"][0]["peak_force_n"]["value"].get<double>();
    };
    for (int round = 0; round < 6; ++round) {
        struct Cut {
            std::string words;
            int feed;
        };
        std::vector<Cut> cuts;
        double y = 0;
        for (int n = 0; n < 8; ++n) {
            y += between(1, 9);
            cuts.push_back({"G1 X" + std::to_string(n % 2 > 0 ? -8 : 48), between(200, 2400)});
            cuts.push_back(
                {"G1 Y" + std::to_string(y) + " Z-" + std::to_string(between(1, 4)), between(200, 2400)});
        }
        const auto program = [&](double factor) {
            std::string text = "G21 G90 M3 S8000\nG0 X-8 Y0 Z5\nZ-1\n";
            for (const Cut& cut : cuts) text += cut.words + " F" + std::to_string(factor * cut.feed) + "\n";
            return text + "M30\n";
        };
        const std::string old = program(1);
        ASSERT_EQ(run({"--out", "new.nc", "--force-n", "150", "--chip-mm", "0.0001:5"}, old).code, 0);
        const auto before = audit(old), after = audit(scratch.get("new.nc"));
        ASSERT_LE(peak_of(after), 150 * 1.01);
        const auto even = audit(program(peak_of(after) / peak_of(before)));
        ASSERT_NEAR(peak_of(even), peak_of(after), 0.01 * peak_of(after));
        EXPECT_LT(after["duration_s"].get<double>(), 0.99 * even["duration_s"].get<double>()) << old;
    }
}

TEST_F(FeedVerb, changes_nothing_the_second_time) {
    ASSERT_EQ(run({"--out", "new.nc", "--force-n", "40", "--chip-mm", "0.001:1"}).code, 0);
    const std::string once = scratch.get("new.nc");
    const Outcome again =
        run({"--out", "newer.nc", "--force-n", "40", "--chip-mm", "0.001:1", "--json"}, once);
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(scratch.get("newer.nc"), once);
    EXPECT_EQ(nlohmann::json::parse(again.out, nullptr, false)["changed"], 0);
}

TEST_F(FeedVerb, changes_nothing_the_second_time_where_short_moves_share_rows) {
    // A wave of short moves over the edge of the block: each allows another feed.
    std::string wave = "G21 G90 M3 S8000\nG0 X-8 Y-2 Z-1\nG1 X-4 F900\n";
    for (int n = 0; n < 160; ++n) {
        const double x = -4 + 0.3 * n;
        wave += "X" + std::to_string(x) + " Y" + std::to_string(-2 + 3 * std::sin(0.35 * n)) + "\n";
    }
    const std::vector<std::string> flags{"--force-n", "40", "--chip-mm", "0.001:1"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), flags.begin(), flags.end());
        return more;
    };
    ASSERT_EQ(run(with({"--out", "new.nc"}), wave + "M30\n").code, 0);
    const std::string once = scratch.get("new.nc");
    EXPECT_GT(std::ranges::count(once, 'F'), 20) << once;
    ASSERT_EQ(run(with({"--out", "newer.nc"}), once).code, 0);
    EXPECT_EQ(scratch.get("newer.nc"), once);
}

TEST_F(FeedVerb, writes_in_place_only_if_it_is_asked_to) {
    const Outcome refused = run({"--out", "slot.nc", "--force-n", "40"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("is an input of this run"), std::string::npos) << refused.err;
    EXPECT_EQ(scratch.get("slot.nc"), kFeedSlots);
    EXPECT_EQ(run({}).code, 2);
    EXPECT_EQ(run({"--in-place", "--force-n", "40"}).code, 0);
    EXPECT_NE(scratch.get("slot.nc"), kFeedSlots);
}

TEST_F(FeedVerb, refuses_by_line_what_it_cannot_rewrite_and_writes_nothing) {
    struct Case {
        const char* program;
        const char* says;
    };
    for (const auto& [program, says] : {
             Case{"G21 G90 M3 S8000\nG0 X-8 Y20 Z-1\no1 repeat [2]\nG91 G1 X5 F900\nY1\no1 endrepeat\nM30\n",
                  "slot.nc:4: error: this line runs after line 5"},
             Case{"G21 G90 M3 S8000\n#1=900\nG0 X-8 Y20 Z-1\nG1 X48 F#1\nM30\n",
                  "slot.nc:4: error: the feed of this line is computed"},
             Case{"G21 G90 M3 S8000\nG0 X-8 Y20 Z-1\nG1 X48\nM30\n", "slot.nc:3: error: no feed word"},
         }) {
        const Outcome outcome = run({"--out", "new.nc", "--force-n", "40"}, program);
        EXPECT_EQ(outcome.code, 2) << program;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(scratch.path() + "/new.nc"));
    }
}

TEST_F(FeedVerb, leaves_feeds_that_stand_in_no_feed_word_and_says_so) {
    const std::string apt =
        "UNITS/MM\nMULTAX/ON\nSPINDL/8000,CLW\nRAPID\nGOTO/-8,20,5,0,0,1\nFEDRAT/1600,MMPM\nGOTO/"
        "-8,20,-1,0,0,1\nGOTO/20,20,-1,0,0,1\n"
        "RAPID\nGOTO/20,20,5,0,0,1\nCYCLE/DRILL,FEDTO,3,MMPM,700,RAPTO,3\nGOTO/20,32,0,0,0,1\nCYCLE/"
        "OFF\nFINI\n";
    scratch.put("slot.apt", apt);
    const Outcome outcome =
        run_tribo({"feed", "slot.apt", "--tool", "flat 10 helix 0 length 20", "--stock", "0 0 -10 40 40 0",
                   "--out", "new.apt", "--force-n", "2000", "--chip-mm", "0.0001:1"},
                  scratch.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("stand in no feed word"), std::string::npos)
        << outcome.err << outcome.out << scratch.get("new.apt");
    EXPECT_NE(scratch.get("new.apt").find("MMPM,700"), std::string::npos);
}

TEST_F(FeedVerb, unrolls_a_loop_and_divides_its_blocks) {
    const std::string loop =
        "G21 G90 M3 S8000\nG0 X-8 Y20 Z-1\n#1=900\no1 repeat [2]\nG91 G1 X14 F#1\nX14\no1 endrepeat\nM30\n";
    ASSERT_EQ(run({"--out", "new.nc", "--force-n", "40", "--chip-mm", "0.001:1", "--unroll", "--split", "7",
                   "--json"},
                  loop)
                  .code,
              0);
    const std::string text = scratch.get("new.nc");
    EXPECT_EQ(text.find("o1"), std::string::npos) << text;
    EXPECT_EQ(std::ranges::count(text, '\n'), 12) << text;  // 4 of the head, 8 blocks of 7 mm
    const auto json = audit(text);
    EXPECT_NEAR(json["tools"][0]["peak_force_n"]["value"].get<double>(), 40, 0.8);
    EXPECT_NEAR(json["tools"][0]["feed_mm"].get<double>(), 56, 1e-6);
    EXPECT_EQ(run({"--out", "new.nc", "--split", "7"}, loop).code, 2);
}

TEST_F(FeedVerb, unrolls_a_loop_in_the_language_of_its_control) {
    const std::string klartext =
        "BEGIN PGM SLOT MM\nTOOL CALL 1 Z S8000\nL X-8 Y+20 Z-1 R0 FMAX M3\nLBL 1\nL IX+7 R0 F900\nL "
        "IX+7\nCALL LBL "
        "1 "
        "REP 3\nM30\nEND PGM SLOT MM\n";
    const std::string siemens =
        "DEF INT N\nG71 G90 G17\nS8000 M3\nG0 X-8 Y20 Z-1\nFOR N=1 TO 4\nG1 X=IC(7) "
        "F900\nX=IC(7)\nENDFOR\nM30\n";
    for (const std::string& loop : {klartext, siemens}) {
        const std::vector<std::string> flags{"--out", "new.nc", "--force-n", "40", "--chip-mm", "0.001:1"};
        const Outcome refused = run(flags, loop);
        EXPECT_EQ(refused.code, 2);
        EXPECT_NE(refused.err.find("--unroll"), std::string::npos) << refused.err;
        std::vector<std::string> more = flags;
        more.push_back("--unroll");
        const Outcome outcome = run(more, loop);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const std::string text = scratch.get("new.nc");
        EXPECT_EQ(text.find("LBL"), std::string::npos) << text;
        EXPECT_EQ(text.find("FOR"), std::string::npos) << text;
        const auto json = audit(text);
        EXPECT_NEAR(json["tools"][0]["peak_force_n"]["value"].get<double>(), 40, 0.8) << text;
        EXPECT_NEAR(json["tools"][0]["feed_mm"].get<double>(), 56, 1e-6);
    }
}

TEST_F(FeedVerb, writes_speeds_without_chatter_and_keeps_the_chips) {
    const std::vector<std::string> flags{"feed",      "job.toml",  "--stable", "--force-n", "2000",
                                         "--chip-mm", "0.001:0.1", "--json",   "--out"};
    const auto feed = [&](const char* out, const std::string& program) {
        scratch.put("slot.nc", program);
        scratch.put("job.toml", kBenchmarkSlot + benchmark_mode("1, 0, 0"));
        std::vector<std::string> call = flags;
        call.emplace_back(out);
        return run_tribo(call, scratch.path());
    };
    const Outcome outcome = feed("new.nc", kFeedSlots);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto speed = nlohmann::json::parse(outcome.out, nullptr, false)["speeds"][0];
    EXPECT_EQ(speed["old_rpm"], 8000);
    EXPECT_GT(speed["old_multiplier"], 1);
    EXPECT_LT(speed["new_multiplier"], 1);
    const std::string once = scratch.get("new.nc");
    const double rpm = std::stod(once.substr(once.find('S') + 1));
    EXPECT_EQ(rpm, speed["new_rpm"].get<double>());
    // The chip of 0.1 mm stays.
    EXPECT_NEAR(std::stod(once.substr(once.find('F') + 1)), 0.2 * rpm, 2e-3 * rpm) << once;
    ASSERT_EQ(feed("newer.nc", once).code, 0);
    EXPECT_EQ(scratch.get("newer.nc"), once);
    // Without modes nothing is known about chatter.
    const Outcome refused = run({"--out", "new.nc", "--stable"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("what bends"), std::string::npos) << refused.err;
}

TEST_F(FeedVerb, refuses_wrong_targets) {
    EXPECT_EQ(run({"--out", "new.nc", "--force-n", "-1"}).code, 2);
    EXPECT_EQ(run({"--out", "new.nc", "--chip-mm", "0.1:0.01"}).code, 2);
    EXPECT_EQ(run({"--out", "new.nc", "--chip-mm", "0.1"}).code, 2);
    EXPECT_EQ(run({"--out", "new.nc", "--in-place"}).code, 2);
}

}  // namespace
}  // namespace tribo::test
