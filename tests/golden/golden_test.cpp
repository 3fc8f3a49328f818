// SPDX-License-Identifier: MIT
// This build's hashes against golden.txt. A change of what a room computes changes its line: look at the
// room's own tests, then copy the new line from the failure.
#include "golden/golden.hpp"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <string>

#include "places.hpp"

namespace tribo::golden {
namespace {

std::map<std::string, std::string> agreed() {
    std::map<std::string, std::string> values;
    std::ifstream in(TRIBO_SOURCE_DIR "/tests/golden/golden.txt");
    std::string name, value;
    while (in >> name >> value) values[name] = value;
    return values;
}

TEST(Golden, this_build_computes_the_agreed_bits) {
    const auto expected = agreed();
    EXPECT_EQ(expected.size(), goldens().size());
    for (const Golden& golden : goldens()) {
        char value[17];
        std::snprintf(value, sizeof value, "%016llx", static_cast<unsigned long long>(golden.hash()));
        const auto line = expected.find(golden.name);
        EXPECT_TRUE(line != expected.end() && line->second == value) << golden.name << ' ' << value;
    }
}

}  // namespace
}  // namespace tribo::golden
