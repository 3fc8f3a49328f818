// SPDX-License-Identifier: MIT
// The table of limits against every door by which its quantities come in, and against docs/limits.md.
#include "base/limits.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <string_view>

#include "app/limits/doors.hpp"
#include "base/text/limit_text.hpp"
#include "files/files.hpp"
#include "places.hpp"

namespace tribo::test {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// The last number that a range accepts, and one beyond. The one next to zero would have 324 digits.
struct Border {
    double inside, outside;
};
std::vector<Border> borders_of(const Range& range) {
    const double below = range.min == 0 ? -1e-9 : std::nextafter(range.min, -kInfinite);
    return {{range.min, below}, {range.max, std::nextafter(range.max, kInfinite)}};
}

void try_both_sides(const Doors& doors) {
    for (const Door& door : doors) {
        const Limit& limit = *door.limit;
        SCOPED_TRACE(std::string(limit.quantity) + " through " + door.name);
        // The end of every message about this range.
        const std::string range = plain_number(limit.range.min) + " to " + plain_number(limit.range.max);
        for (const auto& [inside, outside] : borders_of(limit.range)) {
            const std::string accepted = door.error_of(inside);
            EXPECT_TRUE(accepted.empty() ||
                        (!door.other_rule.empty() && accepted.find(door.other_rule) != accepted.npos))
                << written(inside) << ": " << accepted;
            const std::string refused = door.error_of(outside);
            EXPECT_NE(refused.find(range), refused.npos) << written(outside) << ": " << refused;
        }
        // Far beyond, where sums overflow.
        for (const double far : {-1e300, 1e300}) {
            EXPECT_FALSE(door.error_of(far).empty()) << written(far);
        }
    }
}

TEST(Limits, of_a_job_hold_at_both_ends) {
    try_both_sides(job_doors());
}

TEST(Limits, of_programs_hold_at_both_ends) {
    try_both_sides(program_doors());
}

TEST(Limits, of_tables_hold_at_both_ends) {
    try_both_sides(table_doors());
}

TEST(Limits, of_materials_hold_at_both_ends) {
    try_both_sides(material_doors());
}

TEST(Limits, of_messages_of_a_page_hold_at_both_ends) {
    try_both_sides(live_doors());
}

TEST(Limits, of_flags_hold_at_both_ends) {
    try_both_sides(flag_doors());
}

TEST(Limits, all_have_a_door) {
    std::set<std::string_view> with_door;
    for (const Doors& doors :
         {job_doors(), program_doors(), table_doors(), material_doors(), live_doors(), flag_doors()}) {
        for (const Door& door : doors) with_door.insert(door.limit->quantity);
    }
    std::set<std::string_view> names;
    for (const Limit& limit : all_limits()) {
        EXPECT_TRUE(with_door.contains(limit.quantity)) << limit.quantity << " has no door";
        EXPECT_TRUE(names.insert(limit.quantity).second) << limit.quantity << " stands there twice";
        EXPECT_LT(limit.range.min, limit.range.max) << limit.quantity;
        EXPECT_FALSE(limit.range.above) << limit.quantity;  // not tried here
    }
}

TEST(Limits, stand_in_the_documentation) {
    std::string table;
    for (const Limit& l : all_limits()) {
        table += std::string("| ") + l.quantity + " | " + l.unit + " | " + plain_number(l.range.min) + " | " +
                 plain_number(l.range.max) + " | " + l.given + " | " + l.why + " |\n";
    }
    const auto page = files::read_file(std::string(TRIBO_SOURCE_DIR) + "/docs/limits.md");
    ASSERT_TRUE(page) << page.error().text();
    const std::string rule = "|---|---|---|---|---|---|\n";
    const std::size_t at = page->find(rule);
    ASSERT_NE(at, page->npos);
    EXPECT_EQ(page->substr(at + rule.size(), table.size()), table)
        << "docs/limits.md is out of date; put there:\n"
        << table;
}

}  // namespace
}  // namespace tribo::test
