// SPDX-License-Identifier: MIT
#include "readers/vrml/fields.hpp"

#include "readers/text/decimal_text.hpp"

namespace tribo::readers {

std::unexpected<Error> VrmlFields::refuse(const VrmlValue& value, std::string cause) const {
    return tree_.refuse(value.start, std::move(cause), "export the model again");
}

std::unexpected<Error> VrmlFields::refuse_field(std::string_view field, std::string cause) const {
    const VrmlValue* value = tree_.find(node_, field);
    return tree_.refuse(value ? value->start : tree_.nodes[node_].place, std::move(cause),
                        "export the model again");
}

Result<void> VrmlFields::read_flag(std::string_view field, bool& out) const {
    const VrmlValue* value = tree_.find(node_, field);
    if (!value) return {};
    if (value->kind != VrmlValue::Kind::booleans)
        return refuse(*value, quoted(field) + " must be TRUE or FALSE");
    out = value->truth;
    return {};
}

Result<void> VrmlFields::read_size(std::string_view field, double& out, double least,
                                   bool may_be_least) const {
    const VrmlValue* value = tree_.find(node_, field);
    if (!value) return {};
    const auto numbers = tree_.numbers_of(*value);
    if (numbers.size() != 1 || numbers[0] < least || (numbers[0] == least && !may_be_least)) {
        return refuse(*value, quoted(field) + " must be one number" + (may_be_least ? ", " : " above ") +
                                  short_decimal(least) + (may_be_least ? " or more" : ""));
    }
    out = numbers[0];
    return {};
}

Result<std::span<const double>> VrmlFields::read_list(std::string_view field, std::size_t width) const {
    const VrmlValue* value = tree_.find(node_, field);
    if (!value || value->kind == VrmlValue::Kind::null) return std::span<const double>{};
    const auto numbers = tree_.numbers_of(*value);
    if (numbers.empty() || numbers.size() % width != 0) {
        constexpr std::string_view words[] = {"numbers", "numbers", "two numbers", "three numbers",
                                              "four numbers"};
        return refuse(*value, quoted(field) + " must hold " + std::string(words[width]) +
                                  (width > 1 ? " for each of its values" : ""));
    }
    return numbers;
}

VrmlPlace VrmlFields::place_of_number(const VrmlValue& list, std::size_t at) const {
    VrmlLexer lexer(tree_.files[list.start.file].text);
    VrmlToken token;
    token.offset = list.start.offset;
    token.line = list.start.line;
    token.column = list.start.column;
    lexer.rewind(token);
    token = lexer.next();
    for (std::size_t numbers = 0; token.kind != VrmlTokenKind::end; token = lexer.next()) {
        if (token.kind == VrmlTokenKind::number && numbers++ == at) break;
    }
    return {list.start.file, token.line, token.column, token.offset};
}

}  // namespace tribo::readers
