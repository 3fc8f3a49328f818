// SPDX-License-Identifier: MIT
#include "job/words/stock_words.hpp"

#include <algorithm>
#include <vector>

#include "base/text/decimal.hpp"
#include "base/text/file_names.hpp"
#include "job/solid.hpp"
#include "job/words/lengths.hpp"
#include "readers/mesh/model.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::job {
namespace {

constexpr const char* kRemedy = "write a size, as in '80 60 20', two corners, or the name of a model";

bool names_a_file(std::string_view text) {
    if (readers::detect_model_format("", text)) return true;
    const char first = text[0];
    return !readers::is_digit(first) && first != '-' && first != '+' && first != '.';
}

Result<std::vector<double>> lengths_of(std::string_view text) {
    const auto items = items_of(text);
    if (!items) return std::unexpected(items.error());
    // A unit that stands at the end alone is that of all numbers: 3 x 2 x 1 in.
    const auto has_unit = [](const Item& item) { return item.unit != Unit::none; };
    const bool at_end =
        !items->empty() && std::ranges::count_if(*items, has_unit) == 1 && has_unit(items->back());
    std::vector<double> lengths;
    for (Item item : *items) {
        if (item.word == "x") continue;  // 80 x 60 x 20
        if (at_end) item.unit = items->back().unit;
        if (!item.is_number() || item.unit == Unit::degree)
            return fail("'" + std::string(item.text) + "' is no length", kRemedy);
        lengths.push_back(item.mm());
    }
    return lengths;
}

}  // namespace

Result<StockInput> parse_stock_words(std::string_view text) {
    text = readers::trimmed(text);
    if (text.empty()) return fail("the stock is empty", kRemedy);
    StockInput stock;
    if (extension_of(text) == ".toml") {
        return fail("a stock that another job leaves needs a job",
                    "write [stock] from = \"" + std::string(text) + "\" into a job file");
    }
    if (names_a_file(text)) {
        stock.solid.model = readers::ModelFile{std::string(text), {}};
        return stock;
    }
    const auto found = lengths_of(text);
    if (!found) return std::unexpected(found.error());
    const std::vector<double>& l = *found;
    if (l.size() == 3) {
        stock.size_mm = Vec3{l[0], l[1], l[2]};
        if (auto room = check_edges(*stock.size_mm); !room) return std::unexpected(room.error());
        return stock;
    }
    if (l.size() != 6) {
        return fail(
            "a block has 3 numbers (its size) or 6 (two corners), and these are " + std::to_string(l.size()),
            kRemedy);
    }
    Box3& box = stock.solid.box_mm;
    box.include(Vec3{l[0], l[1], l[2]});
    box.include(Vec3{l[3], l[4], l[5]});
    if (auto room = check_room(box); !room) return std::unexpected(room.error());
    return stock;
}

std::string stock_words(const Box3& box_mm) {
    std::string text;
    for (const Vec3& corner : {box_mm.min, box_mm.max}) {
        for (int axis = 0; axis < 3; ++axis) text += (text.empty() ? "" : " ") + format_decimal(corner[axis]);
    }
    return text;
}

}  // namespace tribo::job
