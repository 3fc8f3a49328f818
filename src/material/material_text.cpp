// SPDX-License-Identifier: MIT
#include "material/material_text.hpp"

#include <algorithm>
#include <string_view>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "base/text/json_string.hpp"
#include "material/material_schema.hpp"

namespace tribo::material {
namespace {

void append(std::string& to, int value) {
    to += std::to_string(value);
}

// Writes a point or an exponent, so that readers see that the number need not be an integer.
void append(std::string& to, double value) {
    const std::size_t begin = to.size();
    append_decimal(to, value);
    if (to.find_first_of(".e", begin) == to.npos) to += ".0";
}

template <class Items>
void append(std::string& to, const Items& items) {
    char before = '[';
    for (const auto& item : items) {
        to += before;
        append(to, item);
        before = ',';
    }
    to += items.empty() ? "[]" : "]";
}

class TextWriter {
  public:
    static constexpr bool kReads = false;

    explicit TextWriter(std::string& text) : text_(text) { text_ += '{'; }
    void end() { text_ += '}'; }

    void schema(const char* schema) {
        begin("schema");
        append_json_string(text_, schema);
    }
    void text(const char* key, const std::string& value) {
        if (value.empty()) return;
        begin(key);
        append_json_string(text_, value);
    }
    template <class Number>
    void number(const char* key, Number value, Range, std::optional<Absent> absent = {}) {
        if (absent && absent->left_out && value == absent->value) return;
        begin(key);
        append(text_, value);
    }
    void numbers(const char* key, const std::vector<double>& values, Range, std::size_t) {
        begin(key);
        append(text_, values);
    }
    void numbers(const char* key, const std::optional<std::vector<double>>& values, Range range,
                 std::size_t most) {
        if (values) numbers(key, *values, range, most);
    }
    void tables(const char* key, const std::vector<std::vector<double>>& tables, Range, std::size_t) {
        begin(key);
        append(text_, tables);
    }
    template <class T>
    bool object(const char* key, T& value, bool present) {
        if (!present) return false;
        begin(key);
        TextWriter inner(text_);
        describe(inner, value);
        inner.end();
        return true;
    }
    template <class T>
    void object(const char* key, std::optional<T>& value) {
        if (value) object(key, *value, true);
    }
    template <class Item>
    void objects(const char* key, std::size_t, std::size_t count, const Item& item) {
        if (count == 0) return;
        begin(key);
        for (std::size_t n = 0; n < count; ++n) {
            text_ += n == 0 ? '[' : ',';
            TextWriter inner(text_);
            item(inner, n);
            inner.end();
        }
        text_ += ']';
    }
    template <class Part>
    void unheard(const Part& part) {
        part(*this);
    }
    void expect(bool, const char*, const char*, const char*) {}

  private:
    void begin(const char* key) {
        if (!first_) text_ += ',';
        first_ = false;
        append_json_string(text_, key);
        text_ += ':';
    }

    std::string& text_;
    bool first_ = true;
};

}  // namespace

std::vector<double> line_spectrum_hz(const noise::ArModel& model) {
    std::vector<double> hz;
    for (const double angle : noise::line_spectrum_of(model.reflection)) {
        hz.push_back(std::round(100 * angle / math::kTwoPi * model.sample_rate_hz) / 100);
    }
    return hz;
}

std::string material_text(Material material) {
    std::string text;
    TextWriter writer(text);
    describe(writer, material);
    writer.end();
    return text;
}

}  // namespace tribo::material
