// SPDX-License-Identifier: MIT
// Small models that several tests of the readers share, and what stands for "this input gives that message".
#pragma once

#include <cstring>
#include <gtest/gtest.h>
#include <string>

#include "readers/mesh/model.hpp"

namespace tribo::readers::test {

// The unit tetrahedron with corners at the origin and on the axes: volume 1/6.
inline TriangleMesh tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
}

template <class T>
void put(std::string& bytes, T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

template <class T>
void put_big_endian(std::string& bytes, T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    for (std::size_t i = sizeof value; i-- > 0;) bytes += raw[i];
}

struct BadInput {
    const char* what;
    std::string bytes;
    int line;             // 0: the message names no line
    const char* message;  // part of the error's cause
};

inline void expect_refused(const BadInput& bad, ModelFormat format) {
    SCOPED_TRACE(bad.what);
    const auto model = read_model(bad.bytes, format, {.source_name = "part"});
    ASSERT_FALSE(model.has_value());
    EXPECT_EQ(model.error().file, "part");
    EXPECT_EQ(model.error().line, bad.line) << model.error().text();
    EXPECT_NE(model.error().cause.find(bad.message), std::string::npos) << model.error().text();
    EXPECT_FALSE(model.error().remedy.empty()) << model.error().text();
}

inline testing::AssertionResult is_read(const Result<Model>& model) {
    if (model) return testing::AssertionSuccess();
    return testing::AssertionFailure() << model.error().text();
}

}  // namespace tribo::readers::test
