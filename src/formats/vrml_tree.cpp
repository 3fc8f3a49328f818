// SPDX-License-Identifier: MIT
#include "formats/vrml_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "formats/model_text.hpp"

namespace tribo::formats {
namespace {

using Kind = VrmlTokenKind;

constexpr VrmlNodeType kSkippedType{"", VrmlRole::silent};

// Different unknown things told one by one; more of them are not worth reading.
constexpr std::size_t kMaxWarnings = 32;

bool is_one_of(std::string_view word, std::span<const std::string_view> list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

// Keeps the nodes that are open in a list of its own: the stack of a WebAssembly module is small.
class TreeParser {
  public:
    TreeParser(std::string_view text, const std::string& source_name)
        : lexer_(text), source_name_(source_name) {
        advance();
    }

    Result<VrmlTree> parse() {
        while (!open_.empty() || token_.kind != Kind::end) {
            const Result<void> ok = open_.empty()           ? step_outside()
                                    : open_.back().in_value ? step_value()
                                                            : step_body();
            if (!ok) return std::unexpected(ok.error());
        }
        return std::move(tree_);
    }

  private:
    // A node whose closing brace has not been read, and the field of it that is being read.
    struct OpenNode {
        const VrmlNodeType* type;
        VrmlToken start;
        std::string_view defined_name;
        std::vector<VrmlField> fields;
        VrmlField field;
        bool used = false, known = false;  // the field's value is kept; the node has such a field
        bool in_value = false, bracketed = false, any = false;
        std::size_t links_from = 0;
    };

    void advance() { token_ = lexer_.next(); }

    std::unexpected<Error> fail_here(std::string cause, std::string remedy = "export the model again") const {
        return fail_at(source_name_, token_.line, token_.column, std::move(cause), std::move(remedy));
    }

    std::unexpected<Error> expected(const std::string& what) const {
        switch (token_.kind) {
            case Kind::end:
                return fail_here("the file ends where " + what + " is due", "the file is cut short");
            case Kind::too_long:
                return fail_here("a word is longer than 64 kB", "this is not a usable model");
            case Kind::unterminated:
                return fail_here("a string has no closing quote");
            default:
                return fail_here("expected " + what + ", found " + quoted(token_.text));
        }
    }

    void warn_once(int line, std::string text) {
        if (tree_.warnings.size() >= kMaxWarnings) return;
        for (const Warning& w : tree_.warnings) {
            if (w.text == text) return;
        }
        tree_.warnings.push_back({source_name_, line, std::move(text)});
    }

    Result<std::string_view> take_word(const std::string& what) {
        if (token_.kind != Kind::word && token_.kind != Kind::number) return expected(what);
        const std::string_view word = token_.text;
        advance();
        return word;
    }

    // ROUTE node.event TO node.event
    Result<void> skip_route() {
        advance();
        if (auto ok = take_word("a node's event"); !ok) return std::unexpected(ok.error());
        if (!token_.is("TO")) return expected("'TO'");
        advance();
        if (auto ok = take_word("a node's event"); !ok) return std::unexpected(ok.error());
        return {};
    }

    VrmlNodeId add_node(const VrmlNodeType& type, const VrmlToken& at, const std::vector<VrmlField>& fields) {
        tree_.nodes.push_back({&type, at.line, at.column, static_cast<std::uint32_t>(tree_.fields.size()),
                               static_cast<std::uint32_t>(fields.size())});
        tree_.fields.insert(tree_.fields.end(), fields.begin(), fields.end());
        return static_cast<VrmlNodeId>(tree_.nodes.size() - 1);
    }

    // Hands a finished node to where it stands.
    Result<void> deliver(VrmlNodeId node, std::string_view defined_name) {
        if (!defined_name.empty()) named_[defined_name] = node;  // only now: no node contains itself
        if (open_.empty()) {
            tree_.roots.push_back(node);
            return {};
        }
        links_.push_back(node);
        return element_of(VrmlValue::Kind::nodes);
    }

    Result<void> step_outside() { return token_.is("ROUTE") ? skip_route() : begin_node(); }

    // node: [DEF name] type { body } | USE name
    Result<void> begin_node() {
        if (token_.is("PROTO") || token_.is("EXTERNPROTO")) return refuse_prototype();
        if (token_.is("USE")) return use();
        std::string_view name;
        if (token_.is("DEF")) {
            advance();
            const auto word = take_word("a name");
            if (!word) return std::unexpected(word.error());
            name = *word;
        }
        if (token_.kind != Kind::word) return expected("a node");
        const VrmlToken start = token_;
        if (open_.size() >= kMaxVrmlNesting) {
            return fail_here("nodes are nested more than " + std::to_string(kMaxVrmlNesting) + " deep",
                             "flatten the model's groups");
        }
        advance();
        if (token_.kind != Kind::open_brace) return expected("'{' after " + quoted(start.text));
        const VrmlNodeType* type = find_vrml_node(start.text);
        if (!type) warn_once(start.line, "the unknown node " + quoted(start.text) + " was skipped");
        if (!type || type->role == VrmlRole::script) {
            if (auto ok = skip_braces(); !ok) return ok;
            return deliver(add_node(kSkippedType, start, {}), name);
        }
        if (type->role == VrmlRole::no_surface) {
            warn_once(start.line, std::string(type->name) + " has no surface and was skipped");
        }
        advance();
        open_.push_back({.type = type, .start = start, .defined_name = name, .fields = {}, .field = {}});
        return {};
    }

    std::unexpected<Error> refuse_prototype() const {
        return fail_here(std::string(token_.text) + " is not read",
                         "export the model without prototypes, as IndexedFaceSet");
    }

    Result<void> use() {
        advance();
        if (token_.kind != Kind::word && token_.kind != Kind::number) return expected("a name");
        const auto found = named_.find(token_.text);
        if (found == named_.end()) {
            return fail_here("USE of " + quoted(token_.text) + ", which is not defined before this place");
        }
        advance();
        return deliver(found->second, {});
    }

    // From '{' past its '}', whatever is inside. Names defined inside stand for nothing.
    Result<void> skip_braces() {
        const int start_line = token_.line;
        std::size_t depth = 0;
        do {
            if (token_.kind == Kind::open_brace || token_.kind == Kind::open_bracket) ++depth;
            if (token_.kind == Kind::close_brace || token_.kind == Kind::close_bracket) --depth;
            if (token_.kind == Kind::end || token_.kind == Kind::too_long ||
                token_.kind == Kind::unterminated) {
                return expected("the end of the node of line " + std::to_string(start_line));
            }
            const bool defines = token_.is("DEF");
            advance();
            if (defines && token_.kind == Kind::word)
                named_[token_.text] = add_node(kSkippedType, token_, {});
        } while (depth > 0);
        return {};
    }

    // Between the fields of the innermost open node.
    Result<void> step_body() {
        OpenNode& node = open_.back();
        if (token_.kind == Kind::close_brace) {
            advance();
            const OpenNode closed = std::move(node);
            open_.pop_back();
            return deliver(add_node(*closed.type, closed.start, closed.fields), closed.defined_name);
        }
        if (token_.is("ROUTE")) return skip_route();
        if (token_.is("PROTO") || token_.is("EXTERNPROTO")) return refuse_prototype();
        if (token_.kind != Kind::word)
            return expected("a field of " + std::string(node.type->name) + " or '}'");
        node.used = is_one_of(token_.text, node.type->used);
        node.known = node.used || node.type->used.empty() || is_one_of(token_.text, node.type->passed);
        if (!node.known) {
            warn_once(token_.line, "the unknown field " + quoted(token_.text) + " of " +
                                       std::string(node.type->name) + " was skipped");
        }
        node.field = {token_.text, {}};
        advance();
        node.field.value.start = token_;
        node.field.value.first = static_cast<std::uint32_t>(tree_.numbers.size());
        node.links_from = links_.size();
        node.in_value = true;
        node.any = false;
        node.bracketed = token_.kind == Kind::open_bracket;
        if (node.bracketed) advance();
        return {};
    }

    // Before an element of the field's value, or at its end.
    Result<void> step_value() {
        OpenNode& node = open_.back();
        const VrmlValue::Kind kind = node.field.value.kind;
        if (node.bracketed ? token_.kind == Kind::close_bracket : node.any && !goes_on(kind)) {
            if (node.bracketed) advance();
            end_value();
            return {};
        }
        if (token_.kind == Kind::number) {
            if (!std::isfinite(token_.number))
                return fail_here("the number " + quoted(token_.text) + " is too large");
            if (node.used) tree_.numbers.push_back(token_.number);
            advance();
            return element_of(VrmlValue::Kind::numbers);
        }
        if (token_.kind == Kind::string) {
            advance();
            return element_of(VrmlValue::Kind::strings);
        }
        if (token_.is("TRUE") || token_.is("FALSE")) {
            node.field.value.truth = token_.text == "TRUE";
            advance();
            return element_of(VrmlValue::Kind::booleans);
        }
        if (token_.is("NULL")) {
            advance();
            return element_of(VrmlValue::Kind::null);
        }
        if (token_.kind != Kind::word) return expected("a value of the field " + quoted(node.field.name));
        if (node.known || token_.is("DEF") || token_.is("USE")) return begin_node();
        const VrmlToken word = token_;
        advance();
        if (token_.kind != Kind::open_brace) return element_of(VrmlValue::Kind::strings);  // its vendor knows
        lexer_.rewind(word);
        advance();
        return begin_node();
    }

    // A value without brackets: several numbers make a vector, rotation or colour; all else stands alone.
    bool goes_on(VrmlValue::Kind kind) const {
        return (kind == VrmlValue::Kind::numbers && token_.kind == Kind::number) ||
               (kind == VrmlValue::Kind::strings && token_.kind == Kind::string);
    }

    // One more element of the innermost value has been read.
    Result<void> element_of(VrmlValue::Kind kind) {
        OpenNode& node = open_.back();
        VrmlValue& value = node.field.value;
        if (node.any && value.kind != kind)
            return fail_here("the list before this place mixes kinds of values");
        value.kind = kind;
        node.any = true;
        return {};
    }

    void end_value() {
        OpenNode& node = open_.back();
        VrmlValue& value = node.field.value;
        if (value.kind == VrmlValue::Kind::numbers) {
            value.count = static_cast<std::uint32_t>(tree_.numbers.size()) - value.first;
        } else {
            value.first = static_cast<std::uint32_t>(tree_.links.size());
            value.count = static_cast<std::uint32_t>(links_.size() - node.links_from);
            if (node.used) {
                tree_.links.insert(tree_.links.end(),
                                   links_.begin() + static_cast<std::ptrdiff_t>(node.links_from),
                                   links_.end());
            }
        }
        links_.resize(node.links_from);
        node.in_value = false;
        if (!node.used) return;
        const auto same = std::find_if(node.fields.begin(), node.fields.end(),
                                       [&](const VrmlField& f) { return f.name == node.field.name; });
        if (same != node.fields.end()) {
            same->value = value;
        } else {
            node.fields.push_back(node.field);
        }
    }

    VrmlLexer lexer_;
    const std::string& source_name_;
    VrmlToken token_;
    VrmlTree tree_;
    std::map<std::string_view, VrmlNodeId> named_;
    std::vector<OpenNode> open_;
    std::vector<VrmlNodeId> links_;  // nodes of the values being read, innermost last
};

}  // namespace

const VrmlValue* VrmlTree::find(VrmlNodeId node, std::string_view field) const {
    const VrmlNode& n = nodes[node];
    for (std::uint32_t i = n.first_field; i < n.first_field + n.fields; ++i) {
        if (fields[i].name == field) return &fields[i].value;
    }
    return nullptr;
}

std::span<const double> VrmlTree::numbers_of(const VrmlValue& value) const {
    if (value.kind != VrmlValue::Kind::numbers) return {};
    return std::span(numbers).subspan(value.first, value.count);
}

std::span<const VrmlNodeId> VrmlTree::nodes_of(const VrmlValue& value) const {
    if (value.kind != VrmlValue::Kind::nodes) return {};
    return std::span(links).subspan(value.first, value.count);
}

Result<VrmlTree> read_vrml_tree(std::string_view text, const std::string& source_name) {
    return TreeParser(text, source_name).parse();
}

}  // namespace tribo::formats
