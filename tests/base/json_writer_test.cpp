// SPDX-License-Identifier: MIT
#include "base/text/json_writer.hpp"

#include <gtest/gtest.h>

namespace tribo {
namespace {

TEST(JsonWriter, puts_commas_between_values_and_none_elsewhere) {
    JsonWriter json;
    json.begin_object()
        .set("a", 1)
        .key("b")
        .begin_array()
        .value(0.5)
        .value("x,\"y")
        .begin_array()
        .end_array();
    json.begin_object().end_object().value(true).end_array().set("c", std::string("d")).end_object();
    EXPECT_EQ(json.text(), R"({"a":1,"b":[0.5,"x,\"y",[],{},true],"c":"d"})");
}

TEST(JsonWriter, keeps_values_apart_that_look_like_brackets) {
    JsonWriter json;
    json.begin_array().value("[").value("{").value(":").value(false).end_array();
    EXPECT_EQ(json.text(), R"(["[","{",":",false])");
}

}  // namespace
}  // namespace tribo
