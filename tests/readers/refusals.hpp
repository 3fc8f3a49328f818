// SPDX-License-Identifier: MIT
// Tables of what a text reader refuses: where, and why.
#pragma once

#include <gtest/gtest.h>
#include <span>
#include <string>

#include "base/result.hpp"

namespace tribo::readers {

struct Refusal {
    std::string text;
    int line, column;
    const char* cause;  // part of it
};

// `read(text, source_name)` gives the reader's Result.
template <class Read>
void expect_refused(std::span<const Refusal> refusals, Read read) {
    for (const Refusal& refusal : refusals) {
        const auto result = read(refusal.text, "part.txt");
        ASSERT_FALSE(result.has_value()) << refusal.text;
        const Error& error = result.error();
        EXPECT_EQ(error.file, "part.txt") << refusal.text;
        EXPECT_EQ(error.line, refusal.line) << refusal.text << error.text();
        EXPECT_EQ(error.column, refusal.column) << refusal.text << error.text();
        EXPECT_NE(error.cause.find(refusal.cause), std::string::npos) << refusal.text << error.text();
        EXPECT_FALSE(error.remedy.empty()) << error.text();
    }
}

}  // namespace tribo::readers
