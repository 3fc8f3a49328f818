// SPDX-License-Identifier: MIT
// Writes JSON (RFC 8259) in one line, for the modules of the pages, which have no JSON library. Any thread.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include "base/text/decimal.hpp"
#include "base/text/json_string.hpp"

namespace tribo {

// Commas come by themselves. The caller keeps the order of JSON: a key before each value of an object, and an
// end for each begin.
class JsonWriter {
  public:
    JsonWriter& begin_object() { return begin('{'); }
    JsonWriter& end_object() { return end('}'); }
    JsonWriter& begin_array() { return begin('['); }
    JsonWriter& end_array() { return end(']'); }
    JsonWriter& key(std::string_view name) {
        comma();
        append_json_string(text_, name);
        text_ += ':';
        return *this;
    }
    JsonWriter& value(std::string_view text) {
        comma();
        append_json_string(text_, text);
        return *this;
    }
    // Finite: JSON has no others.
    JsonWriter& value(double number) {
        comma();
        append_decimal(text_, number);
        return *this;
    }
    template <std::integral Number>
    JsonWriter& value(Number number) {
        comma();
        if constexpr (std::same_as<Number, bool>) {
            text_ += number ? "true" : "false";
        } else {
            text_ += std::to_string(number);
        }
        return *this;
    }
    // A key with its value.
    template <class Value>
    JsonWriter& set(std::string_view name, const Value& of) {
        return key(name).value(of);
    }

    const std::string& text() const { return text_; }

  private:
    JsonWriter& begin(char bracket) {
        comma();
        text_ += bracket;
        return *this;
    }
    JsonWriter& end(char bracket) {
        text_ += bracket;
        return *this;
    }
    void comma() {
        if (text_.empty()) return;
        const char last = text_.back();
        if (last != '{' && last != '[' && last != ':') text_ += ',';
    }

    std::string text_;
};

}  // namespace tribo
