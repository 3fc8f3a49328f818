// SPDX-License-Identifier: MIT
#include "job/words/tool_words.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "base/text/nearest.hpp"
#include "job/words/lengths.hpp"

namespace tribo::job {
namespace {

using milling::Cutter;
using milling::CutterKind;

enum class Meaning {
    kind,
    end_mill,
    filler,
    number,
    diameter,
    flutes,
    corner,
    helix,
    length,
    core,
    tip,
    point,
    angle,
    side,
    height,
    neck
};

struct Word {
    std::string_view text;
    Meaning meaning;
    CutterKind kind = CutterKind::flat;
};
// The first words are those that messages suggest.
constexpr std::size_t kSuggested = 27;
constexpr std::array kWords{
    Word{"flat", Meaning::kind, CutterKind::flat},
    Word{"ball", Meaning::kind, CutterKind::ball},
    Word{"bull", Meaning::kind, CutterKind::bull},
    Word{"T", Meaning::number},
    Word{"diameter", Meaning::diameter},
    Word{"flutes", Meaning::flutes},
    Word{"corner", Meaning::corner},
    Word{"helix", Meaning::helix},
    Word{"length", Meaning::length},
    Word{"core", Meaning::core},
    Word{"taper", Meaning::kind, CutterKind::taper},
    Word{"v", Meaning::kind, CutterKind::v},
    Word{"drill", Meaning::kind, CutterKind::drill},
    Word{"chamfer", Meaning::kind, CutterKind::chamfer},
    Word{"countersink", Meaning::kind, CutterKind::countersink},
    Word{"dovetail", Meaning::kind, CutterKind::dovetail},
    Word{"lens", Meaning::kind, CutterKind::lens},
    Word{"barrel", Meaning::kind, CutterKind::barrel},
    Word{"lollipop", Meaning::kind, CutterKind::lollipop},
    Word{"thread", Meaning::kind, CutterKind::thread},
    Word{"engraver", Meaning::kind, CutterKind::engraver},
    Word{"tip", Meaning::tip},
    Word{"point", Meaning::point},
    Word{"angle", Meaning::angle},
    Word{"side", Meaning::side},
    Word{"height", Meaning::height},
    Word{"neck", Meaning::neck},
    Word{"bit", Meaning::filler},
    Word{"square", Meaning::kind, CutterKind::flat},
    Word{"ballnose", Meaning::kind, CutterKind::ball},
    Word{"ballend", Meaning::kind, CutterKind::ball},
    Word{"bullnose", Meaning::kind, CutterKind::bull},
    Word{"torus", Meaning::kind, CutterKind::bull},
    Word{"toroidal", Meaning::kind, CutterKind::bull},
    Word{"end", Meaning::end_mill},
    Word{"mill", Meaning::end_mill},
    Word{"endmill", Meaning::end_mill},
    Word{"nose", Meaning::filler},
    Word{"cutter", Meaning::filler},
    Word{"tool", Meaning::filler},
    Word{"with", Meaning::filler},
    Word{"number", Meaning::number},
    Word{"d", Meaning::diameter},
    Word{"dia", Meaning::diameter},
    Word{"diametermm", Meaning::diameter},
    Word{"fl", Meaning::flutes},
    Word{"flute", Meaning::flutes},
    Word{"teeth", Meaning::flutes},
    Word{"r", Meaning::corner},
    Word{"cr", Meaning::corner},
    Word{"cornermm", Meaning::corner},
    Word{"helixdeg", Meaning::helix},
    Word{"lengthmm", Meaning::length},
    Word{"coremm", Meaning::core},
    Word{"tipmm", Meaning::tip},
    Word{"pointdeg", Meaning::point},
    Word{"taperdeg", Meaning::angle},
    Word{"sidemm", Meaning::side},
    Word{"heightmm", Meaning::height},
    Word{"neckmm", Meaning::neck},
};

// In the order of milling::kShapeKeys.
constexpr std::array kShapeMeanings{Meaning::corner, Meaning::tip,    Meaning::point, Meaning::angle,
                                    Meaning::side,   Meaning::height, Meaning::neck};
constexpr std::array<std::string_view, kShapeMeanings.size()> kShapeWords{
    "corner", "tip", "point", "angle", "side", "height", "neck"};
static_assert(kShapeMeanings.size() == milling::kShapeKeys.size());

Result<Word> meaning_of(const Item& item) {
    for (const Word& word : kWords) {
        if (item.word == word.text || (item.word == "t" && word.text == "T")) return word;
    }
    std::vector<std::string_view> known;
    for (std::size_t n = 0; n < kSuggested; ++n) known.push_back(kWords[n].text);
    return fail("'" + std::string(item.text) + "' is no word of a tool", suggestion(item.text, known));
}

// What the words said so far; absent where they did not.
class ToolText {
  public:
    Result<Cutter> read(std::string_view text) {
        const auto items = items_of(text);
        if (!items) return std::unexpected(items.error());
        for (std::size_t n = 0; n < items->size(); ++n) {
            const auto used = take(*items, n);
            if (!used) return std::unexpected(used.error());
            n += *used - 1;
        }
        return cutter();
    }

  private:
    // Returns the number of items that were read from `n` on.
    Result<std::size_t> take(const std::vector<Item>& items, std::size_t n) {
        const Item& item = items[n];
        const auto is_number = [&](std::size_t at) { return at < items.size() && items[at].is_number(); };
        if (item.is_number()) {
            // `3 flutes`, but the 6 of `6 flutes 3` is the diameter.
            const bool has_word = n + 1 < items.size() && !is_number(n + 1) && !is_number(n + 2);
            const auto next = has_word ? meaning_of(items[n + 1]) : Result<Word>(Word{"", Meaning::filler});
            const bool counts = next && next->meaning == Meaning::flutes;
            if (auto set = put(counts ? Meaning::flutes : Meaning::diameter, item); !set)
                return std::unexpected(set.error());
            return counts ? 2 : 1;
        }
        const auto word = meaning_of(item);
        if (!word) return std::unexpected(word.error());
        const Meaning meaning = word->meaning;
        if (meaning == Meaning::filler) return 1;
        if (meaning == Meaning::end_mill) {
            is_end_mill_ = true;
            return 1;
        }
        if (meaning == Meaning::kind) {
            if (kind_ && *kind_ != word->kind)
                return fail("a tool has one kind, and this one two", "keep one");
            kind_ = word->kind;
            return 1;
        }
        if (!is_number(n + 1)) {
            return fail("'" + std::string(item.text) + "' has no number behind it",
                        "write '" + std::string(item.text) + " 2', for example");
        }
        if (auto set = put(meaning, items[n + 1]); !set) return std::unexpected(set.error());
        return 2;
    }

    Result<void> put(Meaning meaning, const Item& item) {
        std::optional<double>& value = values_[static_cast<std::size_t>(meaning)];
        const std::string number(item.text);
        if (value) {
            return meaning == Meaning::diameter
                       ? fail("the number " + number + " has no word before it",
                              "write its word: diameter, flutes, corner, helix, length or core")
                       : fail("the number " + number + " says the same thing again", "keep one of them");
        }
        const bool is_count = meaning == Meaning::number || meaning == Meaning::flutes;
        const bool is_angle =
            meaning == Meaning::helix || meaning == Meaning::point || meaning == Meaning::angle;
        const bool is_length = item.unit == Unit::millimetre || item.unit == Unit::inch;
        if ((is_count && item.unit != Unit::none) || (is_angle && is_length) ||
            (!is_angle && item.unit == Unit::degree)) {
            return fail("the unit behind " + number + " does not fit", "leave it out");
        }
        if (is_count) {
            const Limit& limit = meaning == Meaning::number ? kLimits.tool_number : kLimits.flutes;
            if (!limit.range.contains(item.value))
                return fail(out_of_range(limit, item.value), range_remedy(limit));
            if (item.value != std::floor(item.value))
                return fail(number + " is no count", "write a whole number");
        }
        value = item.mm();
        return {};
    }

    std::optional<double> value(Meaning meaning) const { return values_[static_cast<std::size_t>(meaning)]; }

    Result<Cutter> cutter() const {
        const auto diameter = value(Meaning::diameter);
        const double corner = value(Meaning::corner).value_or(0);
        if (!diameter) return fail("the tool has no diameter", "write it in mm, as in 'flat 6'");
        Cutter c;
        c.diameter_mm = *diameter;
        if (kind_) {
            c.kind = *kind_;
        } else if (value(Meaning::corner)) {
            c.kind = corner == 0               ? CutterKind::flat
                     : 2 * corner == *diameter ? CutterKind::ball
                                               : CutterKind::bull;
        } else if (!is_end_mill_) {
            return fail("the tool has no kind",
                        "write flat, ball or bull, as in 'flat " + format_decimal(*diameter) + "'");
        }
        if (c.kind == CutterKind::flat && corner != 0)
            return fail("a flat tool has no corner", "write bull, or leave the corner out");
        if (c.kind == CutterKind::ball && value(Meaning::corner) && 2 * corner != *diameter)
            return fail("the corner of a ball is its radius", "write bull, or leave the corner out");
        if (c.kind == CutterKind::bull) {
            if (!value(Meaning::corner)) return fail("a bull tool has no corner here", "add 'corner 1'");
            c.corner_mm = corner;
        }
        c.number = static_cast<int>(value(Meaning::number).value_or(0));
        c.flutes = static_cast<int>(value(Meaning::flutes).value_or(c.flutes));
        c.helix_deg = value(Meaning::helix).value_or(milling::usual_helix_deg(c.kind));
        c.core_mm = value(Meaning::core).value_or(c.core_mm);
        if (auto shaped = take_shape(c); !shaped) return std::unexpected(shaped.error());
        if (auto good = milling::check(c); !good) return std::unexpected(good.error());
        return c;
    }

    // Length, and for a kind with a profile its sizes.
    Result<void> take_shape(Cutter& c) const {
        const auto length = value(Meaning::length);
        const std::string kind(kCutterKindWords[static_cast<std::size_t>(c.kind)]);
        for (std::size_t n = 0; n < kShapeMeanings.size(); ++n) {
            const milling::ShapeKey& key = milling::kShapeKeys[n];
            const auto size = value(kShapeMeanings[n]);
            if (!size || (kShapeMeanings[n] == Meaning::corner && !c.has_profile())) continue;
            if (!milling::is_shape_key(c.kind, key.name))
                return fail("a " + kind + " tool has no " + std::string(kShapeWords[n]), "leave it out");
            if (!key.limit.range.contains(*size))
                return fail(out_of_range(key.limit, *size), range_remedy(key.limit));
            c.*key.value = *size;
        }
        if (!c.has_profile()) {
            c.length_mm = length.value_or(c.length_mm);
            return {};
        }
        c.length_mm = milling::has_own_length(c.kind) ? 0 : length.value_or(0);
        if (auto made = milling::make_profile(c); !made) return made;
        if (length && std::abs(*length - c.length_mm) > 1e-6)
            return fail("the edges of this " + kind + " are " + format_decimal(c.length_mm) + " mm long",
                        "leave the length out");
        return {};
    }

    std::optional<CutterKind> kind_;
    bool is_end_mill_ = false;
    std::array<std::optional<double>, static_cast<std::size_t>(Meaning::neck) + 1> values_;
};

}  // namespace

Result<Cutter> parse_tool_words(std::string_view text) {
    return ToolText().read(text);
}

std::string shape_words(const Cutter& cutter) {
    std::string text;
    for (std::size_t n = 0; n < kShapeWords.size(); ++n) {
        const milling::ShapeKey& key = milling::kShapeKeys[n];
        const double value = cutter.*key.value;
        if (value == 0 || !milling::is_shape_key(cutter.kind, key.name)) continue;
        text += " " + std::string(kShapeWords[n]) + " " + format_decimal(value);
    }
    return text;
}

std::string tool_words(const Cutter& cutter) {
    const Cutter usual;
    std::string text = cutter.number > 0 ? "T" + std::to_string(cutter.number) + " " : "";
    text += kCutterKindWords[static_cast<std::size_t>(cutter.kind)];
    text += " " + format_decimal(cutter.diameter_mm);
    text += shape_words(cutter) + " flutes " + std::to_string(cutter.flutes);
    if (cutter.helix_deg != milling::usual_helix_deg(cutter.kind))
        text += " helix " + format_decimal(cutter.helix_deg);
    if (cutter.length_mm != usual.length_mm && !milling::has_own_length(cutter.kind))
        text += " length " + format_decimal(cutter.length_mm);
    if (cutter.core_mm != usual.core_mm) text += " core " + format_decimal(cutter.core_mm);
    return text;
}

}  // namespace tribo::job
