// SPDX-License-Identifier: MIT
#include "readers/mesh/ply_header.hpp"

#include <array>
#include <utility>

namespace tribo::readers {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames{{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

// Largest number of elements and properties in a header; real files have a dozen.
constexpr std::size_t kMaxEntries = 256;

PlyType type_named(std::string_view word) {
    for (const auto& [name, type] : kTypeNames) {
        if (name == word) return type;
    }
    return PlyType::none;
}

class HeaderReader {
  public:
    HeaderReader(TextCursor& cursor, const std::string& source_name)
        : cursor_(cursor), source_name_(source_name) {}

    Result<PlyHeader> read() {
        cursor_.word_on_line();  // "ply", checked before
        cursor_.next_line();
        bool format_known = false;
        while (!cursor_.at_end()) {
            const std::string_view word = cursor_.word_on_line();
            Result<void> ok;
            if (word == "end_header") {
                cursor_.next_line();
                if (!format_known) return fail_here("the PLY header has no format line");
                return std::move(header_);
            }
            if (word == "format") {
                ok = read_format();
                format_known = true;
            } else if (word == "element") {
                ok = read_element();
            } else if (word == "property") {
                ok = read_property();
            } else if (!word.empty() && word != "comment" && word != "obj_info") {
                ok = fail_here(quoted(word) + " is not a PLY header word");
            }
            if (!ok) return std::unexpected(ok.error());
            cursor_.next_line();
        }
        return fail_here("the file ends inside its PLY header");
    }

  private:
    std::unexpected<Error> fail_here(std::string cause) const {
        return fail_at(source_name_, cursor_.line(), cursor_.column(), std::move(cause),
                       "export the model again as PLY");
    }

    Result<void> read_format() {
        const std::string_view encoding = cursor_.word_on_line();
        if (encoding == "ascii") {
            header_.encoding = PlyEncoding::text;
        } else if (encoding == "binary_little_endian") {
            header_.encoding = PlyEncoding::little_endian;
        } else if (encoding == "binary_big_endian") {
            header_.encoding = PlyEncoding::big_endian;
        } else {
            return fail_here("the PLY format " + quoted(encoding) + " is not known");
        }
        const std::string_view version = cursor_.word_on_line();
        if (version != "1.0") return fail_here("the PLY version " + quoted(version) + " is not known");
        return {};
    }

    Result<void> read_element() {
        PlyElement element;
        element.name = cursor_.word_on_line();
        element.line = cursor_.line();
        const std::string_view word = cursor_.word_on_line();
        const auto count = parse_integer(word);
        if (!count || *count < 0) return fail_here("expected a number of elements, found " + quoted(word));
        if (++entries_ > kMaxEntries) return fail_here("the PLY header is longer than 256 entries");
        element.count = static_cast<std::uint64_t>(*count);
        header_.elements.push_back(std::move(element));
        return {};
    }

    Result<PlyType> read_type() {
        const std::string_view word = cursor_.word_on_line();
        const PlyType type = type_named(word);
        if (type == PlyType::none) return fail_here("the PLY type " + quoted(word) + " is not known");
        return type;
    }

    Result<void> read_property() {
        if (header_.elements.empty()) return fail_here("a property stands before the first element");
        if (++entries_ > kMaxEntries) return fail_here("the PLY header is longer than 256 entries");
        PlyProperty property;
        const TextCursor before = cursor_;
        if (cursor_.word_on_line() == "list") {
            const auto count_type = read_type();
            if (!count_type) return std::unexpected(count_type.error());
            if (!is_integer(*count_type)) return fail_here("the length of a list must have an integer type");
            property.count_type = *count_type;
        } else {
            cursor_ = before;
        }
        const auto type = read_type();
        if (!type) return std::unexpected(type.error());
        property.type = *type;
        property.name = cursor_.word_on_line();
        if (property.name.empty()) return fail_here("a property has no name");
        header_.elements.back().properties.push_back(property);
        return {};
    }

    TextCursor& cursor_;
    const std::string& source_name_;
    PlyHeader header_;
    std::size_t entries_ = 0;
};

}  // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
        case PlyType::int8:
        case PlyType::uint8:
            return 1;
        case PlyType::int16:
        case PlyType::uint16:
            return 2;
        case PlyType::int32:
        case PlyType::uint32:
        case PlyType::float32:
            return 4;
        case PlyType::float64:
            return 8;
        case PlyType::none:
            break;
    }
    return 0;
}

int PlyElement::find(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
        if (properties[i].name == property) return static_cast<int>(i);
    }
    return -1;
}

Result<PlyHeader> read_ply_header(TextCursor& cursor, const std::string& source_name) {
    return HeaderReader(cursor, source_name).read();
}

}  // namespace tribo::readers
