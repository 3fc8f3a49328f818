// SPDX-License-Identifier: MIT
#include "material/material_text.hpp"

#include <algorithm>
#include <string_view>

#include "base/decimal.hpp"
#include "base/math.hpp"
#include "material/material_schema.hpp"

namespace tribo::material {
namespace {

// Bytes of the UTF-8 character that `text` starts with; 0: it is none (RFC 3629).
std::size_t character_bytes(std::string_view text) {
    const auto byte = [&](std::size_t n) {
        return n < text.size() ? static_cast<unsigned char>(text[n]) : 0U;
    };
    const auto goes_on = [&](std::size_t n) { return (byte(n) & 0xc0U) == 0x80U; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4 || !goes_on(1)) return 0;
    if (first < 0xe0) return 2;
    // Overlong forms, surrogates, and what is beyond the last character.
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0) ||
        (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90) || !goes_on(2)) {
        return 0;
    }
    if (first < 0xf0) return 3;
    return goes_on(3) ? 4 : 0;
}

void append_quoted(std::string& to, std::string_view text) {
    constexpr std::string_view kHex = "0123456789abcdef", kReplacement = "\xef\xbf\xbd";
    to += '"';
    while (!text.empty()) {
        const std::size_t bytes = character_bytes(text);
        const char c = text[0];
        const auto code = static_cast<unsigned char>(c);
        if (bytes == 0) {
            to += kReplacement;
        } else if (c == '"' || c == '\\') {
            to += {'\\', c};
        } else if (code < 0x20) {
            to += {'\\', 'u', '0', '0', kHex[code / 16U], kHex[code % 16U]};
        } else {
            to += text.substr(0, bytes);
        }
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    to += '"';
}

void append(std::string& to, int value) {
    to += std::to_string(value);
}

// With a point or an exponent, so that readers see that it need not be whole.
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
        append_quoted(text_, schema);
    }
    void text(const char* key, const std::string& value) {
        if (value.empty()) return;
        begin(key);
        append_quoted(text_, value);
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
        append_quoted(text_, key);
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
