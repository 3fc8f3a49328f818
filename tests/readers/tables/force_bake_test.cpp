// SPDX-License-Identifier: MIT
#include "readers/tables/force_bake.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "base/hash.hpp"
#include "places.hpp"

namespace tribo::readers {
namespace {

contact::ForceTable some_table() {
    std::vector<contact::ForceStretch> cut;
    for (int n = 0; n < 60; ++n) {
        contact::ForceStretch s;
        s.start_s = 0.02 * n + (n >= 30 ? 1 : 0);  // a pause in the middle
        s.end_s = s.start_s + 0.02;
        s.rate_rad_per_s = 600;
        s.phase_rad = 0.1 * n;
        s.spectrum.order_step = 2;
        s.spectrum.harmonics.resize(3);
        s.spectrum.harmonics[0].x = 100 + 80 * std::sin(0.3 * n);
        s.spectrum.harmonics[1].y = {40, 10.0 * (n % 7)};
        cut.push_back(s);
    }
    const contact::ForceTableOptions options;
    return build_force_table(force_function(cut, options), options);
}

// Without sine and cosine: the same bytes everywhere.
contact::ForceTable small_table() {
    std::vector<contact::ForceStretch> cut;
    for (int n = 0; n < 12; ++n) {
        contact::ForceStretch s;
        s.start_s = 0.0625 * n + (n >= 7 ? 0.5 : 0);
        s.end_s = s.start_s + 0.0625;
        s.rate_rad_per_s = 512;
        s.phase_rad = 0.125 * n;
        s.spectrum.order_step = 2;
        s.spectrum.harmonics.resize(3);
        s.spectrum.harmonics[0].x = 100 + 16 * (n % 5);
        s.spectrum.harmonics[1].y = {40, 8.0 * (n % 3)};
        cut.push_back(s);
    }
    const contact::ForceTableOptions options;
    return build_force_table(force_function(cut, options), options);
}

void expect_same(const contact::ForceTable& a, const contact::ForceTable& b) {
    ASSERT_EQ(a.table().knots(), b.table().knots());
    ASSERT_EQ(a.pieces().size(), b.pieces().size());
    contact::ForceTable::Cursor first, second;
    for (int n = 0; n < 500; ++n) {
        const double t_s = 0.005 * n;
        Vec3 f, g;
        ASSERT_EQ(a.force_at(t_s, 5000, first, f), b.force_at(t_s, 5000, second, g)) << t_s;
        EXPECT_EQ(f, g) << t_s;
    }
}

TEST(ForceBake, comes_back_the_same_in_place_and_from_any_address) {
    const contact::ForceTable table = some_table();
    ASSERT_GT(table.table().knots(), 10U);
    ASSERT_GE(table.pieces().size(), 2U);
    const std::string bytes = write_force_bake(table, 0x1234567890abcdef);
    for (std::size_t shift = 0; shift < 2; ++shift) {
        // An odd address cannot be used in place.
        const auto kept = std::make_shared<std::vector<char>>(bytes.size() + shift);
        std::copy(bytes.begin(), bytes.end(), kept->begin() + static_cast<std::ptrdiff_t>(shift));
        auto read = read_force_bake({kept->data() + shift, bytes.size()}, kept, "force.bake");
        ASSERT_TRUE(read.has_value()) << read.error().text();
        EXPECT_EQ(read->key, 0x1234567890abcdefU);
        expect_same(read->table, table);
    }
}

TEST(ForceBake, tells_a_table_from_other_files_by_its_first_bytes) {
    const std::string bytes = write_force_bake(small_table(), 1);
    for (const std::size_t left : {bytes.size(), std::size_t{64}, std::size_t{8}, std::size_t{3}}) {
        EXPECT_TRUE(is_force_bake(std::string_view(bytes).substr(0, left))) << left;
    }
    EXPECT_TRUE(is_force_bake({}));
    for (const char* text : {"TR\n", "TRIBOFT ", "t_s,x_mm\n", "\n"})
        EXPECT_FALSE(is_force_bake(text)) << text;
}

// What the fuzzer begins from (fuzz/corpus/force_bake).
TEST(ForceBake, writes_the_seeds_of_its_fuzzer) {
    const std::pair<const char*, contact::ForceTable> seeds[] = {{"cut.bake", small_table()},
                                                                 {"empty.bake", {}}};
    for (const auto& [name, table] : seeds) {
        std::ifstream file(std::string(TRIBO_SOURCE_DIR "/fuzz/corpus/force_bake/") + name, std::ios::binary);
        ASSERT_TRUE(file) << name;
        const std::string seed{std::istreambuf_iterator<char>(file), {}};
        EXPECT_TRUE(seed == write_force_bake(table, 42)) << name << ", " << seed.size() << " bytes";
    }
}

TEST(ForceBake, keeps_a_table_of_nothing) {
    const auto read = read_force_bake(write_force_bake({}, 7), nullptr, "force.bake");
    ASSERT_TRUE(read.has_value()) << read.error().text();
    EXPECT_TRUE(read->table.table().empty());
    EXPECT_EQ(read->key, 7U);
}

TEST(ForceBake, refuses_every_damaged_byte_and_every_length) {
    const std::string bytes = write_force_bake(some_table(), 1);
    for (std::size_t n = 0; n < bytes.size(); n += n < 200 ? 1 : 37) {
        const bool in_key = n >= 32 && n < 40, spare = n >= 48 && n < 64;
        if (in_key || spare) continue;
        std::string damaged = bytes;
        damaged[n] = static_cast<char>(damaged[n] ^ 0x10);
        const auto read = read_force_bake(damaged, nullptr, "force.bake");
        ASSERT_FALSE(read.has_value()) << "byte " << n;
        EXPECT_EQ(read.error().file, "force.bake");
        EXPECT_FALSE(read.error().remedy.empty());
    }
    for (std::size_t length = 0; length < bytes.size(); length += 41) {
        EXPECT_FALSE(read_force_bake(std::string_view(bytes).substr(0, length), nullptr, "f").has_value());
    }
    EXPECT_FALSE(read_force_bake(bytes + "x", nullptr, "f").has_value());
}

TEST(ForceBake, says_when_another_version_wrote_it) {
    std::string bytes = write_force_bake(some_table(), 1);
    bytes[8] = 2;
    const auto read = read_force_bake(bytes, nullptr, "f");
    ASSERT_FALSE(read.has_value());
    EXPECT_NE(read.error().cause.find("version"), std::string::npos);
}

}  // namespace
}  // namespace tribo::readers
