// SPDX-License-Identifier: MIT
#include "readers/vrml/parser.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "readers/text/model_text.hpp"

namespace tribo::readers {
namespace {

using Kind = VrmlTokenKind;

constexpr VrmlNodeType kInstanceType{"", VrmlRole::instance};

bool is_one_of(std::string_view word, std::span<const std::string_view> list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

// Open nodes are kept in a list instead of by recursion: the stack of a WebAssembly module is small.
class Parser {
  public:
    Parser(VrmlTree& tree, VrmlFiles& files, std::uint32_t file)
        : tree_(tree), files_(files), file_(file), lexer_(tree.files[file].text) {
        scopes_.emplace_back();
        advance();
    }

    Result<VrmlTop> parse() {
        while (!open_.empty() || token_.kind != Kind::end) {
            if (auto ok = step(); !ok) return std::unexpected(ok.error());
        }
        return std::move(top_);
    }

  private:
    enum class Form : std::uint8_t { node, interface, body };

    // A node, an interface or a body of a prototype whose end is not read yet, and its current field.
    struct Open {
        Form form = Form::node;
        const VrmlNodeType* type = nullptr;
        VrmlToken start;
        std::string_view defined_name;
        std::uint32_t prototype = 0;    // of an instance
        std::vector<VrmlField> fields;  // of an interface: all declared fields
        VrmlField field;
        bool used = false, known = false;  // the value of the field is kept; the node has such a field
        bool in_value = false, bracketed = false, any = false;
        std::size_t links_from = 0;
    };

    // A prototype whose definition is not complete.
    struct Pending {
        std::string_view name;
        VrmlPlace place;
        bool in_body = false;
        VrmlNodeId body_from = 0;
        std::vector<VrmlField> interface;
        std::optional<VrmlNodeId> first;
    };

    // Names are valid from their definition to the end of their body or file.
    struct Scope {
        std::map<std::string_view, VrmlNodeId> nodes;
        std::map<std::string_view, std::uint32_t> prototypes;
    };

    void advance() { token_ = lexer_.next(); }

    VrmlPlace place_of(const VrmlToken& token) const {
        return {file_, token.line, token.column, token.offset};
    }

    std::unexpected<Error> fail_here(std::string cause, std::string remedy = "export the model again") const {
        return tree_.refuse(place_of(token_), std::move(cause), std::move(remedy));
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

    Result<std::string_view> take_word(const std::string& what) {
        if (token_.kind != Kind::word && token_.kind != Kind::number) return expected(what);
        const std::string_view word = token_.text;
        advance();
        return word;
    }

    Result<void> step() {
        if (open_.empty()) return step_statement();
        if (open_.back().in_value) return step_value();
        switch (open_.back().form) {
            case Form::node:
                return step_node();
            case Form::interface:
                return step_interface();
            case Form::body:
                break;
        }
        if (token_.kind != Kind::close_brace) return step_statement();
        return end_body();
    }

    // Reads one item at the top of a file or body: a prototype, a route or a node.
    Result<void> step_statement() {
        if (token_.is("ROUTE")) return skip_route();
        if (token_.is("PROTO")) return begin_prototype();
        if (token_.is("EXTERNPROTO")) return external_prototype();
        return begin_node();
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

    bool in_template() const { return !pending_.empty() && pending_.back().in_body; }

    VrmlNodeId add_node(const VrmlNodeType& type, const VrmlToken& at, const std::vector<VrmlField>& fields) {
        const VrmlNodeId id = tree_.add(type, place_of(at), fields);
        tree_.nodes[id].is_template = in_template();
        return id;
    }

    // Adds a finished node to its parent.
    Result<void> deliver(VrmlNodeId node, std::string_view defined_name) {
        if (!defined_name.empty()) scopes_.back().nodes[defined_name] = node;  // now: none contains itself
        if (open_.empty()) {
            top_.roots.push_back(node);
            return {};
        }
        if (open_.back().form == Form::body) {
            if (!pending_.back().first) pending_.back().first = node;
            return {};
        }
        links_.push_back(node);
        return element_of(VrmlValue::Kind::nodes);
    }

    Result<void> check_nesting() const {
        if (open_.size() < kMaxVrmlNesting) return {};
        return fail_here("nodes are nested more than " + std::to_string(kMaxVrmlNesting) + " deep",
                         "flatten the model's groups");
    }

    std::optional<std::uint32_t> find_prototype(std::string_view name) const {
        for (std::size_t i = scopes_.size(); i-- > 0;) {
            const auto found = scopes_[i].prototypes.find(name);
            if (found != scopes_[i].prototypes.end()) return found->second;
        }
        return std::nullopt;
    }

    // node: [DEF name] type { body } | USE name
    Result<void> begin_node() {
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
        if (auto ok = check_nesting(); !ok) return ok;
        for (const Pending& pending : pending_) {
            if (pending.name == start.text) {
                return fail_here("the prototype " + quoted(start.text) + " contains itself",
                                 "break the circle");
            }
        }
        advance();
        if (token_.kind != Kind::open_brace) return expected("'{' after " + quoted(start.text));
        const auto prototype = find_prototype(start.text);
        const VrmlNodeType* type = prototype ? &kInstanceType : find_vrml_node(start.text);
        const bool is_missing = prototype && files_.prototypes()[*prototype].is_missing;
        if (is_missing) {
            tree_.warn_once(place_of(start), "the node " + quoted(start.text) +
                                                 " was skipped: the file of its EXTERNPROTO is not there");
        } else if (!type) {
            tree_.warn_once(place_of(start), "the unknown node " + quoted(start.text) + " was skipped");
        }
        if (!type || is_missing || type->role == VrmlRole::script) {
            if (auto ok = skip_braces(); !ok) return ok;
            return deliver(add_node(skipped_vrml_node(), start, {}), name);
        }
        if (type->role == VrmlRole::no_surface) {
            tree_.warn_once(place_of(start), std::string(type->name) + " has no surface and was skipped");
        }
        advance();
        Open node;
        node.type = type;
        node.start = start;
        node.defined_name = name;
        node.prototype = prototype.value_or(0);
        open_.push_back(std::move(node));
        return {};
    }

    Result<void> use() {
        advance();
        if (token_.kind != Kind::word && token_.kind != Kind::number) return expected("a name");
        const auto found = scopes_.back().nodes.find(token_.text);
        if (found == scopes_.back().nodes.end()) {
            return fail_here("USE of " + quoted(token_.text) + ", which is not defined before this place");
        }
        advance();
        return deliver(found->second, {});
    }

    // Skips from '{' to after its '}', whatever is inside. Names defined inside stand for empty nodes.
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
            if (defines && token_.kind == Kind::word) {
                scopes_.back().nodes[token_.text] = add_node(skipped_vrml_node(), token_, {});
            }
        } while (depth > 0);
        return {};
    }

    // PROTO name [ interface ] { body }
    Result<void> begin_prototype() {
        Pending pending;
        pending.place = place_of(token_);
        if (auto ok = check_nesting(); !ok) return ok;
        advance();
        const auto name = take_word("the prototype's name");
        if (!name) return std::unexpected(name.error());
        pending.name = *name;
        if (token_.kind != Kind::open_bracket) return expected("'[' after " + quoted(*name));
        advance();
        pending_.push_back(std::move(pending));
        scopes_.emplace_back();
        Open interface;
        interface.form = Form::interface;
        open_.push_back(std::move(interface));
        return {};
    }

    // (field | exposedField) type name value | (eventIn | eventOut) type name
    Result<void> step_interface() {
        if (token_.kind == Kind::close_bracket) return end_interface();
        const bool has_value = token_.is("field") || token_.is("exposedField");
        if (!has_value && !token_.is("eventIn") && !token_.is("eventOut")) {
            return expected("'field', 'exposedField', 'eventIn', 'eventOut' or ']'");
        }
        advance();
        if (auto type = take_word("the field's type"); !type) return std::unexpected(type.error());
        const auto name = take_word("the field's name");
        if (!name) return std::unexpected(name.error());
        Open& interface = open_.back();
        if (interface.fields.size() == kMaxVrmlInterface) {
            return fail_here("the prototype " + quoted(pending_.back().name) + " declares more than " +
                                 std::to_string(kMaxVrmlInterface) + " fields",
                             "export the model without prototypes");
        }
        if (!has_value) {
            interface.fields.push_back({*name, {}});
            return {};
        }
        interface.used = interface.known = true;
        begin_value(*name);
        return {};
    }

    Result<void> end_interface() {
        advance();
        if (token_.kind != Kind::open_brace) return expected("'{' after the prototype's interface");
        advance();
        Pending& pending = pending_.back();
        pending.interface = std::move(open_.back().fields);
        pending.in_body = true;
        pending.body_from = static_cast<VrmlNodeId>(tree_.nodes.size());
        open_.back() = {};
        open_.back().form = Form::body;
        return {};
    }

    Result<void> end_body() {
        advance();
        open_.pop_back();
        scopes_.pop_back();
        Pending pending = std::move(pending_.back());
        pending_.pop_back();
        // A body that begins with a USE of a node from its interface has no first node of its own.
        if (pending.first && !tree_.nodes[*pending.first].is_template) pending.first.reset();
        const auto number = files_.prototypes().define(pending.name, std::move(pending.interface),
                                                       pending.body_from, pending.first, pending.place);
        if (!number) return std::unexpected(number.error());
        name_prototype(pending.name, *number);
        return {};
    }

    void name_prototype(std::string_view name, std::uint32_t number) {
        scopes_.back().prototypes[name] = number;
        if (scopes_.size() == 1) top_.prototypes.emplace_back(name, number);
    }

    // EXTERNPROTO name [ interface without values ] urls
    Result<void> external_prototype() {
        const VrmlPlace at = place_of(token_);
        advance();
        const auto name = take_word("the prototype's name");
        if (!name) return std::unexpected(name.error());
        if (token_.kind != Kind::open_bracket) return expected("'[' after " + quoted(*name));
        advance();
        while (token_.kind != Kind::close_bracket) {
            if (auto word = take_word("a field of the prototype or ']'"); !word)
                return std::unexpected(word.error());
        }
        advance();
        std::vector<std::string_view> urls;
        const bool bracketed = token_.kind == Kind::open_bracket;
        if (bracketed) advance();
        while (token_.kind == Kind::string) {
            urls.push_back(token_.text);
            advance();
            if (!bracketed) break;
        }
        if (bracketed ? token_.kind != Kind::close_bracket : urls.empty())
            return expected("the url of the prototype's file");
        if (bracketed) advance();
        const auto number = files_.read_external(urls, at);
        name_prototype(*name, number ? *number : files_.prototypes().define_missing(*name));
        return {};
    }

    // Runs between the fields of the innermost open node.
    Result<void> step_node() {
        Open& node = open_.back();
        if (token_.kind == Kind::close_brace) return end_node();
        if (token_.is("ROUTE")) return skip_route();
        if (token_.is("PROTO")) return begin_prototype();
        if (token_.is("EXTERNPROTO")) return external_prototype();
        const bool is_instance = node.type->role == VrmlRole::instance;
        const std::string type_name(is_instance ? node.start.text : node.type->name);
        if (token_.kind != Kind::word) return expected("a field of " + type_name + " or '}'");
        if (is_instance) {
            const auto& interface = files_.prototypes()[node.prototype].interface;
            node.used = std::any_of(interface.begin(), interface.end(),
                                    [&](const VrmlField& f) { return f.name == token_.text; });
            node.known = node.used;
        } else {
            node.used = is_one_of(token_.text, node.type->used);
            node.known = node.used || node.type->used.empty() || is_one_of(token_.text, node.type->passed);
        }
        if (!node.known) {
            tree_.warn_once(place_of(token_),
                            "the unknown field " + quoted(token_.text) + " of " + type_name + " was skipped");
        }
        const std::string_view name = token_.text;
        advance();
        if (token_.is("IS")) return bind(name);
        begin_value(name);
        return {};
    }

    Result<void> end_node() {
        advance();
        const Open closed = std::move(open_.back());
        open_.pop_back();
        if (closed.type->role == VrmlRole::instance && !in_template()) {
            const auto unfolded =
                files_.prototypes().unfold(closed.prototype, closed.fields, place_of(closed.start));
            if (!unfolded) return std::unexpected(unfolded.error());
            return deliver(*unfolded, closed.defined_name);
        }
        if (closed.type->role == VrmlRole::inline_file && !in_template()) {
            return deliver(files_.add_inline(*closed.type, place_of(closed.start), closed.fields),
                           closed.defined_name);
        }
        const VrmlNodeId id = add_node(*closed.type, closed.start, closed.fields);
        if (closed.type->role == VrmlRole::instance) tree_.nodes[id].number = closed.prototype;
        return deliver(id, closed.defined_name);
    }

    // name IS declared
    Result<void> bind(std::string_view name) {
        if (!in_template()) return fail_here("IS outside of a prototype");
        VrmlField field{name, {}};
        field.value.kind = VrmlValue::Kind::bound;
        field.value.start = place_of(token_);
        advance();
        const VrmlToken declared = token_;
        if (auto word = take_word("the name of a field of the prototype"); !word)
            return std::unexpected(word.error());
        const auto& interface = pending_.back().interface;
        const auto found = std::find_if(interface.begin(), interface.end(),
                                        [&](const VrmlField& f) { return f.name == declared.text; });
        if (found == interface.end()) {
            return tree_.refuse(place_of(declared),
                                "the prototype " + quoted(pending_.back().name) + " declares no field " +
                                    quoted(declared.text),
                                "correct the name");
        }
        field.value.first = static_cast<std::uint32_t>(found - interface.begin());
        if (open_.back().used) keep_field(field);
        return {};
    }

    void begin_value(std::string_view name) {
        Open& node = open_.back();
        node.field = {name, {}};
        node.field.value.start = place_of(token_);
        node.links_from = links_.size();
        node.in_value = true;
        node.any = false;
        node.bracketed = token_.kind == Kind::open_bracket;
        if (node.bracketed) advance();
    }

    // Runs before an element of the value of the field, or at its end.
    Result<void> step_value() {
        Open& node = open_.back();
        VrmlValue& value = node.field.value;
        if (node.bracketed ? token_.kind == Kind::close_bracket : node.any && !goes_on(value.kind)) {
            if (node.bracketed) advance();
            end_value();
            return {};
        }
        if (token_.kind == Kind::number) {
            if (!std::isfinite(token_.number))
                return fail_here("the number " + quoted(token_.text) + " is too large");
            if (node.used) {
                if (value.count++ == 0) value.first = static_cast<std::uint32_t>(tree_.numbers.size());
                tree_.numbers.push_back(token_.number);
            }
            advance();
            return element_of(VrmlValue::Kind::numbers);
        }
        if (token_.kind == Kind::string) {
            if (node.used) {
                if (value.count++ == 0) value.first = static_cast<std::uint32_t>(tree_.strings.size());
                tree_.strings.push_back(token_.text);
            }
            advance();
            return element_of(VrmlValue::Kind::strings);
        }
        if (token_.is("TRUE") || token_.is("FALSE")) {
            value.truth = token_.text == "TRUE";
            advance();
            return element_of(VrmlValue::Kind::booleans);
        }
        if (token_.is("NULL")) {
            advance();
            return element_of(VrmlValue::Kind::null);
        }
        if (token_.is("PROTO")) return begin_prototype();
        if (token_.is("EXTERNPROTO")) return external_prototype();
        if (token_.kind != Kind::word) return expected("a value of the field " + quoted(node.field.name));
        if (node.known || token_.is("DEF") || token_.is("USE")) return begin_node();
        const VrmlToken word = token_;
        advance();
        if (token_.kind != Kind::open_brace) return element_of(VrmlValue::Kind::strings);  // unknown word
        lexer_.rewind(word);
        advance();
        return begin_node();
    }

    // True when a value without brackets continues: several numbers are a vector, rotation or colour. Other
    // values have one element.
    bool goes_on(VrmlValue::Kind kind) const {
        return (kind == VrmlValue::Kind::numbers && token_.kind == Kind::number) ||
               (kind == VrmlValue::Kind::strings && token_.kind == Kind::string);
    }

    // Called after one more element of the innermost value.
    Result<void> element_of(VrmlValue::Kind kind) {
        Open& node = open_.back();
        VrmlValue& value = node.field.value;
        if (node.any && value.kind != kind)
            return fail_here("the list before this place mixes kinds of values");
        value.kind = kind;
        node.any = true;
        return {};
    }

    void end_value() {
        Open& node = open_.back();
        VrmlValue& value = node.field.value;
        if (value.kind == VrmlValue::Kind::nodes && node.used) {
            value.first = static_cast<std::uint32_t>(tree_.links.size());
            value.count = static_cast<std::uint32_t>(links_.size() - node.links_from);
            tree_.links.insert(tree_.links.end(),
                               links_.begin() + static_cast<std::ptrdiff_t>(node.links_from), links_.end());
        }
        links_.resize(node.links_from);
        node.in_value = false;
        if (node.used) keep_field(node.field);
    }

    // Sets the field; the value given last is used.
    void keep_field(const VrmlField& field) {
        std::vector<VrmlField>& fields = open_.back().fields;
        const auto same = std::find_if(fields.begin(), fields.end(),
                                       [&](const VrmlField& f) { return f.name == field.name; });
        if (same != fields.end()) {
            same->value = field.value;
        } else {
            fields.push_back(field);
        }
    }

    VrmlTree& tree_;
    VrmlFiles& files_;
    std::uint32_t file_;
    VrmlLexer lexer_;
    VrmlToken token_;
    VrmlTop top_;
    std::vector<Scope> scopes_;
    std::vector<Pending> pending_;
    std::vector<Open> open_;
    std::vector<VrmlNodeId> links_;  // nodes of the open values, innermost last
};

}  // namespace

Result<VrmlTop> parse_vrml(VrmlTree& tree, VrmlFiles& files, std::uint32_t file) {
    return Parser(tree, files, file).parse();
}

}  // namespace tribo::readers
