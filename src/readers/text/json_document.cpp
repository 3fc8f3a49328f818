// SPDX-License-Identifier: MIT
// JSON (RFC 8259).
#include <utility>

#include "readers/text/document.hpp"
#include "readers/text/text_lines.hpp"
#include "readers/text/utf8.hpp"

namespace tribo::readers {
namespace {

class JsonReader {
  public:
    JsonReader(std::string_view bytes, const std::string& source_name)
        : text_(bytes), source_name_(source_name) {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    }

    Result<Document> read() {
        document_.nodes.emplace_back();
        if (auto done = value(0, 0); !done) return std::unexpected(done.error());
        skip_blanks();
        if (at_ < text_.size()) return refuse("text follows the end of the JSON value");
        return std::move(document_);
    }

  private:
    std::unexpected<Error> refuse(std::string cause) const {
        return fail_at(source_name_, line_, 0, std::move(cause), "check that the file is whole");
    }
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    void skip_blanks() {
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n') ++line_;
            if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return;
        }
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }

    Result<std::uint32_t> add(std::uint32_t parent) {
        if (document_.nodes.size() >= kMostDocumentNodes)
            return refuse("more than " + std::to_string(kMostDocumentNodes) + " values");
        const auto place = static_cast<std::uint32_t>(document_.nodes.size());
        document_.nodes.emplace_back();
        document_.nodes[parent].children.push_back(place);
        return place;
    }

    Result<void> value(std::uint32_t place, int depth) {
        skip_blanks();
        document_.nodes[place].line = line_;
        if (depth > kDeepestDocument)
            return refuse("values nest deeper than " + std::to_string(kDeepestDocument));
        if (take('{')) return members(place, depth, true);
        if (take('[')) return members(place, depth, false);
        if (peek() == '"') {
            auto text = string();
            if (!text) return std::unexpected(text.error());
            document_.nodes[place].text = *std::move(text);
            return {};
        }
        const std::size_t start = at_;
        while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '+' ||
                                      text_[at_] == '-' || text_[at_] == '.'))
            ++at_;
        const std::string_view word = text_.substr(start, at_ - start);
        const bool is_number = !word.empty() && (is_digit(word.back()) || word.back() == '.');
        if (!is_number && word != "true" && word != "false" && word != "null") return refuse("no JSON value");
        document_.nodes[place].text = word;
        return {};
    }

    // Members of an object or elements of an array, behind the bracket.
    Result<void> members(std::uint32_t place, int depth, bool is_object) {
        (is_object ? document_.nodes[place].is_object : document_.nodes[place].is_array) = true;
        const char end = is_object ? '}' : ']';
        skip_blanks();
        if (take(end)) return {};
        for (;;) {
            skip_blanks();
            const auto child = add(place);
            if (!child) return std::unexpected(child.error());
            if (is_object) {
                if (peek() != '"') return refuse("an object without a key");
                auto name = string();
                if (!name) return std::unexpected(name.error());
                document_.nodes[*child].name = *std::move(name);
                skip_blanks();
                if (!take(':')) return refuse("a key without ':'");
            }
            if (auto done = value(*child, depth + 1); !done) return done;
            skip_blanks();
            if (take(end)) return {};
            if (!take(',')) return refuse(std::string("',' or '") + end + "' is missing");
        }
    }

    Result<unsigned> hex4() {
        unsigned code = 0;
        for (int i = 0; i < 4; ++i, ++at_) {
            const char c = to_upper(peek());
            const unsigned digit =
                is_digit(c) ? static_cast<unsigned>(c - '0') : static_cast<unsigned>(c - 'A' + 10);
            if (!is_digit(c) && (c < 'A' || c > 'F')) return refuse("\\u without four digits");
            code = code << 4U | digit;
        }
        return code;
    }

    Result<std::string> string() {
        std::string out;
        for (++at_; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '"') {
                ++at_;
                return out;
            }
            if (c == '\n') return refuse("a string without its end");
            if (c != '\\') {
                out += c;
                continue;
            }
            ++at_;
            if (auto done = escape(out); !done) return std::unexpected(done.error());
        }
        return refuse("a string without its end");
    }

    // The cursor is at the character behind the backslash, and stays at the last one of the escape.
    Result<void> escape(std::string& out) {
        constexpr std::string_view kLetters = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
        const std::size_t known = at_ < text_.size() ? kLetters.find(text_[at_]) : std::string_view::npos;
        if (known != std::string_view::npos) {
            out += kMeanings[known];
            return {};
        }
        if (peek() != 'u') return refuse("an unknown escape in a string");
        ++at_;
        const auto code = hex4();
        if (!code) return std::unexpected(code.error());
        unsigned character = *code;
        if (character >= 0xD800 && character < 0xDC00 && text_.substr(at_).starts_with("\\u")) {
            at_ += 2;
            const auto low = hex4();
            if (!low) return std::unexpected(low.error());
            if (*low >= 0xDC00 && *low < 0xE000)
                character = 0x10000U + ((character - 0xD800U) << 10U) + (*low - 0xDC00U);
        }
        append_utf8(out, character);
        --at_;
        return {};
    }

    std::string_view text_;
    const std::string& source_name_;
    std::size_t at_ = 0;
    int line_ = 1;
    Document document_;
};

}  // namespace

Result<Document> read_json(std::string_view bytes, const std::string& source_name) {
    return JsonReader(bytes, source_name).read();
}

}  // namespace tribo::readers
