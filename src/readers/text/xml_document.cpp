// SPDX-License-Identifier: MIT
// The part of XML 1.0 that tool libraries use.
#include <algorithm>
#include <array>
#include <utility>

#include "readers/text/document.hpp"
#include "readers/text/text_lines.hpp"
#include "readers/text/utf8.hpp"

namespace tribo::readers {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

class XmlReader {
  public:
    XmlReader(std::string_view bytes, const std::string& source_name)
        : text_(bytes), source_name_(source_name) {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    }

    Result<Document> read() {
        while (at_ < text_.size()) {
            if (text_[at_] != '<') {
                if (auto done = characters(); !done) return std::unexpected(done.error());
                continue;
            }
            if (auto done = markup(); !done) return std::unexpected(done.error());
        }
        if (!open_.empty())
            return refuse("the element " + document_.nodes[open_.back()].name + " is not closed");
        if (document_.nodes.empty()) return refuse("no XML element");
        return std::move(document_);
    }

  private:
    std::unexpected<Error> refuse(std::string cause) const {
        return fail_at(source_name_, line_, 0, std::move(cause), "check that the file is whole");
    }
    void advance(std::size_t to) {
        for (; at_ < to && at_ < text_.size(); ++at_) {
            if (text_[at_] == '\n') ++line_;
        }
    }
    bool starts(std::string_view with) const { return text_.substr(at_).starts_with(with); }

    Result<void> skip_to(std::string_view end, const char* what) {
        const std::size_t found = text_.find(end, at_);
        if (found == std::string_view::npos) return refuse(std::string(what) + " without its end");
        advance(found + end.size());
        return {};
    }

    Result<void> markup() {
        if (starts("<!--")) return skip_to("-->", "a comment");
        if (starts("<?")) return skip_to("?>", "an instruction");
        if (starts("<![CDATA[")) {
            const std::size_t end = text_.find("]]>", at_);
            if (end == std::string_view::npos || open_.empty()) return refuse("CDATA without its end");
            document_.nodes[open_.back()].text += text_.substr(at_ + 9, end - at_ - 9);
            advance(end + 3);
            return {};
        }
        if (starts("<!")) return skip_doctype();
        if (starts("</")) return close();
        return open();
    }

    // Its internal subset in brackets is skipped too.
    Result<void> skip_doctype() {
        int depth = 0;
        for (std::size_t i = at_; i < text_.size(); ++i) {
            if (text_[i] == '[') ++depth;
            if (text_[i] == ']') --depth;
            if (text_[i] != '>' || depth > 0) continue;
            advance(i + 1);
            return {};
        }
        return refuse("DOCTYPE without its end");
    }

    // A name without its prefix.
    std::string name() {
        std::size_t end = at_;
        while (end < text_.size() && !is_space(text_[end]) &&
               std::string_view("/>=<\"'").find(text_[end]) == std::string_view::npos)
            ++end;
        std::string_view whole = text_.substr(at_, end - at_);
        at_ = end;
        const std::size_t colon = whole.rfind(':');
        return std::string(colon == std::string_view::npos ? whole : whole.substr(colon + 1));
    }
    void skip_blanks() {
        std::size_t end = at_;
        while (end < text_.size() && is_space(text_[end])) ++end;
        advance(end);
    }

    Result<std::uint32_t> add(std::string node_name) {
        if (document_.nodes.size() >= kMostDocumentNodes)
            return refuse("more than " + std::to_string(kMostDocumentNodes) + " elements");
        const auto place = static_cast<std::uint32_t>(document_.nodes.size());
        document_.nodes.emplace_back();
        document_.nodes[place].name = std::move(node_name);
        document_.nodes[place].line = line_;
        if (!open_.empty()) document_.nodes[open_.back()].children.push_back(place);
        return place;
    }

    Result<void> open() {
        ++at_;
        std::string element = name();
        if (element.empty()) return refuse("'<' without a name");
        if (open_.empty() && !document_.nodes.empty()) return refuse("a second root element");
        if (open_.size() > kDeepestDocument)
            return refuse("elements nest deeper than " + std::to_string(kDeepestDocument));
        const auto place = add(std::move(element));
        if (!place) return std::unexpected(place.error());
        document_.nodes[*place].is_object = true;
        open_.push_back(*place);
        for (;;) {
            skip_blanks();
            if (starts("/>")) {
                at_ += 2;
                open_.pop_back();
                return {};
            }
            if (starts(">")) {
                ++at_;
                return {};
            }
            if (auto done = attribute(); !done) return done;
        }
    }

    Result<void> attribute() {
        const std::string key = name();
        skip_blanks();
        if (key.empty() || !starts("=")) return refuse("an element without its end");
        ++at_;
        skip_blanks();
        const char quote = at_ < text_.size() ? text_[at_] : '\0';
        const std::size_t end =
            quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : std::string_view::npos;
        if (end == std::string_view::npos) return refuse("the attribute " + key + " without its value");
        const auto place = add("@" + key);
        if (!place) return std::unexpected(place.error());
        const std::string_view raw = text_.substr(at_ + 1, end - at_ - 1);
        if (auto done = append(document_.nodes[*place].text, raw); !done) return done;
        advance(end + 1);
        return {};
    }

    Result<void> close() {
        at_ += 2;
        const std::string element = name();
        skip_blanks();
        if (open_.empty() || element != document_.nodes[open_.back()].name || !starts(">"))
            return refuse("</" + element.substr(0, 40) + "> closes another element");
        ++at_;
        open_.pop_back();
        return {};
    }

    Result<void> characters() {
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        const std::string_view raw = text_.substr(at_, end - at_);
        if (open_.empty()) {
            for (const char c : raw) {
                if (!is_space(c)) return refuse("text outside of all elements");
            }
        } else if (auto done = append(document_.nodes[open_.back()].text, raw); !done) {
            return done;
        }
        advance(end);
        return {};
    }

    // Appends text with its entities resolved.
    Result<void> append(std::string& out, std::string_view raw) {
        for (std::size_t i = 0; i < raw.size(); ++i) {
            if (raw[i] != '&') {
                out += raw[i];
                continue;
            }
            const std::size_t end = raw.find(';', i);
            if (end == std::string_view::npos || end - i > 10) return refuse("'&' that begins no entity");
            if (!entity(out, raw.substr(i + 1, end - i - 1)))
                return refuse("the entity " + std::string(raw.substr(i, end - i + 1)) + " is not known");
            i = end;
        }
        return {};
    }

    static bool entity(std::string& out, std::string_view name) {
        constexpr std::array<std::pair<std::string_view, char>, 5> kNamed{
            {{"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}}};
        for (const auto& [known, character] : kNamed) {
            if (name != known) continue;
            out += character;
            return true;
        }
        if (!name.starts_with('#')) return false;
        const bool is_hex = name.size() > 1 && (name[1] == 'x' || name[1] == 'X');
        unsigned code = 0;
        const std::string_view digits = name.substr(is_hex ? 2 : 1);
        for (const char c : digits) {
            const char upper = to_upper(c);
            const bool is_hex_letter = is_hex && upper >= 'A' && upper <= 'F';
            if (!is_digit(c) && !is_hex_letter) return false;
            const auto digit = static_cast<unsigned>(is_digit(c) ? c - '0' : upper - 'A' + 10);
            code = code * (is_hex ? 16U : 10U) + digit;
        }
        if (digits.empty()) return false;
        append_utf8(out, code);
        return true;
    }

    std::string_view text_;
    const std::string& source_name_;
    std::size_t at_ = 0;
    int line_ = 1;
    Document document_;
    std::vector<std::uint32_t> open_;
};

}  // namespace

Result<Document> read_xml(std::string_view bytes, const std::string& source_name) {
    return XmlReader(bytes, source_name).read();
}

}  // namespace tribo::readers
