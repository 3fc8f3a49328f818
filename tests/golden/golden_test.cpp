// SPDX-License-Identifier: MIT
// This build's hashes against golden.txt. A change of what a room computes changes its line: look at the
// room's own tests, then copy the new line from the failure.
#include "golden/golden.hpp"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <ostream>
#include <string>

#include "places.hpp"

namespace tribo::golden {

void PrintTo(const Golden& golden, std::ostream* out) {
    *out << golden.name;
}

namespace {

std::map<std::string, std::string> agreed() {
    std::map<std::string, std::string> values;
    std::ifstream in(TRIBO_SOURCE_DIR "/tests/golden/golden.txt");
    std::string name, value;
    while (in >> name >> value) values[name] = value;
    return values;
}

class Bits : public testing::TestWithParam<Golden> {};

TEST_P(Bits, are_those_that_all_builds_agree_on) {
    const auto expected = agreed();
    char value[17];
    std::snprintf(value, sizeof value, "%016llx", static_cast<unsigned long long>(GetParam().hash()));
    const auto line = expected.find(GetParam().name);
    EXPECT_TRUE(line != expected.end() && line->second == value) << GetParam().name << ' ' << value;
}

INSTANTIATE_TEST_SUITE_P(Golden, Bits, testing::ValuesIn(goldens().begin(), goldens().end()),
                         [](const auto& golden) { return golden.param.name; });

TEST(GoldenFile, has_no_other_lines) {
    EXPECT_EQ(agreed().size(), goldens().size());
}

}  // namespace
}  // namespace tribo::golden
