// SPDX-License-Identifier: MIT
// Free contours: FPOL, FL, FLT, FC, FCT and FSELECT. Their blocks wait until it is known where they lie.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

using Of = FreeCondition::Of;

constexpr std::size_t kMostElements = 10'000;
// What the search of one element may cost, in characters of a program that runs without end.
constexpr std::size_t kCostOfElement = 2'000;

bool is_free_word(LineReader& in) {
    for (const std::string_view word : {"FL", "FLT", "FC", "FCT", "FPOL", "FSELECT"}) {
        if (in.take(word)) return true;
    }
    return false;
}

}  // namespace

// True if a free contour goes on behind the block: the block is an element or a corner, or moves nothing.
bool Interpreter::keeps_free_contour() const {
    const char first = line_.text[0];
    if (first == '*' || first == '%' || first == '?' || to_upper(first) == 'Q') return true;
    LineReader in(line_, source_name_, parameters_);
    if (is_free_word(in)) return true;
    for (const std::string_view word : {"RND", "CHF", "FN", "LBL", "DECLARE"}) {
        if (in.take(word)) return true;
    }
    return in.take("CALL") && in.take("LBL");
}

// FPOL X+20 Y+15: the pole of the polar words of free blocks.
Result<void> Interpreter::free_pole(LineReader& in) {
    const auto words = read_words(in, "FPOL");
    if (!words) return std::unexpected(words.error());
    if (!words->axis[0] || !words->axis[1])
        return in.refuse(words->first_column, "FPOL without X and Y", "write both");
    free_pole_ = Vec3{*words->axis[0], *words->axis[1], 0};
    return {};
}

// The element that the block `number` (as written before it) describes.
Result<std::size_t> Interpreter::free_reference(const LineReader& in, const Item& item) const {
    const auto found = item.value ? free_numbers_.find(static_cast<long>(*item.value)) : free_numbers_.end();
    if (found != free_numbers_.end()) return found->second;
    return in.refuse(item.column, item.name + " names no block of this free contour",
                     "write the number of an FL, FLT, FC or FCT block before it");
}

// Reads a word that only free blocks have. Returns false if it is none.
Result<bool> Interpreter::free_word(LineReader& in, const std::vector<Item>& items, std::size_t i,
                                    FreeWords& free) {
    const Item& item = items[i];
    std::string name = item.name;
    if (name == "CLSD" && item.sign != 0) {
        free.closing = item.sign;
        return true;
    }
    const bool is_auxiliary = i > 0 && items[i - 1].name == "P" && items[i - 1].value;
    if (name == "P" && item.value && i + 1 < items.size()) return true;
    if (!item.value) return false;
    const double value = *item.value, mm = value * unit_mm_;
    if (auto good = in.in_range(kLimits.coordinate, mm, item.column); !good)
        return std::unexpected(good.error());
    if ((is_auxiliary && (name == "X" || name == "Y")) || name == "PDX" || name == "PDY") {
        // P1X, P1Y to P3X, P3Y, and PDX, PDY with the distance D
        const std::size_t point =
            is_auxiliary ? static_cast<std::size_t>(std::clamp(*items[i - 1].value, 1.0, 3.0)) : 0;
        (name.back() == 'X' ? free.points[point].x : free.points[point].y) = mm;
        free.has_point[point] = true;
        return true;
    }
    if (name == "R" && value == 0) return false;
    const bool is_reference = name.size() > 1 && name[0] == 'R' && name != "RL" && name != "RR";
    if (is_reference || name == "PAR") {
        const auto reference = free_reference(in, item);
        if (!reference) return std::unexpected(reference.error());
        free.references[is_reference ? name.substr(1) : name] = *reference;
        return true;
    }
    const bool is_increment = name[0] == 'I';
    if (is_increment) name.erase(0, 1);
    constexpr std::string_view lengths[] = {"X", "Y", "PR", "LEN", "R", "CCX", "CCY", "CCPR", "DP", "D"};
    constexpr std::string_view angles[] = {"PA", "AN", "CCA", "CCPA"};
    const bool is_length = std::find(std::begin(lengths), std::end(lengths), name) != std::end(lengths);
    if (!is_length && std::find(std::begin(angles), std::end(angles), name) == std::end(angles)) return false;
    free.values[name] = {is_length ? mm : value * math::kRadPerDeg, is_increment, item.column};
    return true;
}

// The conditions of a point: of the end, or with CC before their names of the centre.
Result<void> Interpreter::free_point(const LineReader& in, const FreeWords& free, bool of_centre,
                                     FreeElement& element) const {
    constexpr struct {
        const char *of_end, *of_centre;
        Of of;
    } kinds[] = {
        {"X", "CCX", Of::x}, {"Y", "CCY", Of::y}, {"PR", "CCPR", Of::polar}, {"PA", "CCPA", Of::ray}};
    for (const auto& kind : kinds) {
        const std::string name = of_centre ? kind.of_centre : kind.of_end;
        const auto found = free.values.find(name);
        if (found == free.values.end()) continue;
        const FreeWord& word = found->second;
        FreeCondition condition;
        condition.of = kind.of;
        condition.of_centre = of_centre;
        condition.value = word.value;
        const bool is_polar = kind.of == Of::polar || kind.of == Of::ray;
        if (is_polar && !free_pole_)
            return in.refuse(word.column, name + " without a pole", "write FPOL before the free contour");
        if (is_polar) condition.point = *free_pole_;
        const auto reference = free.references.find(name);
        if (reference != free.references.end()) {
            condition.reference = reference->second;
        } else if (word.is_increment && free_->contour.size() > 0) {
            condition.reference = free_->contour.size() - 1;
        } else if (word.is_increment) {
            const Vec3 from = free_->start - condition.point;
            condition.value += kind.of == Of::x     ? from.x
                               : kind.of == Of::y   ? from.y
                               : kind.of == Of::ray ? math::atan2(from.y, from.x)
                                                    : length(Vec3{from.x, from.y, 0});
        }
        element.conditions.push_back(condition);
    }
    return {};
}

// AN, IAN, PAR and DP: the direction of the element.
Result<void> Interpreter::free_direction(const LineReader& in, const FreeWords& free,
                                         FreeElement& element) const {
    const auto parallel = free.references.find("PAR");
    if (parallel != free.references.end()) {
        FreeCondition condition;
        condition.of = Of::parallel;
        condition.reference = parallel->second;
        element.conditions.push_back(condition);
        if (const auto apart = free.values.find("DP"); apart != free.values.end()) {
            condition.of = Of::from_line;
            condition.value = std::abs(apart->second.value);
            element.conditions.push_back(condition);
        }
    }
    const auto found = free.values.find("AN");
    if (found == free.values.end()) return {};
    const FreeWord& word = found->second;
    const auto named = free.references.find("AN");
    if (!word.is_increment && named == free.references.end()) {
        element.direction = word.value;
        return {};
    }
    const std::size_t count = free_->contour.size();
    if (count == 0 && named == free.references.end()) {
        return in.refuse(word.column, "IAN in the first block of a free contour has nothing to count from",
                         "write AN");
    }
    FreeCondition condition;
    condition.of = Of::direction;
    condition.value = word.value;
    condition.reference = named != free.references.end() ? named->second : count - 1;
    element.conditions.push_back(condition);
    return {};
}

Result<FreeElement> Interpreter::free_element(const LineReader& in, const Words& words, const FreeWords& free,
                                              bool is_arc, bool is_tangent) const {
    FreeElement element;
    element.is_arc = is_arc;
    element.is_tangent = is_tangent;
    element.turning = words.direction;
    const auto value = [&](const char* name) -> std::optional<double> {
        const auto found = free.values.find(name);
        return found == free.values.end() ? std::nullopt : std::optional(found->second.value);
    };
    for (const char* of_arc : {"R", "CCA", "CCX", "CCY", "CCPR", "CCPA"}) {
        if (!is_arc && value(of_arc))
            return in.refuse(free.values.at(of_arc).column, std::string(of_arc) + " in a line",
                             "write FC or FCT");
    }
    if (const auto radius = value("R")) element.radius = std::abs(*radius);
    if (const auto angle = value("CCA")) element.size = std::abs(*angle);
    if (const auto length = value("LEN"); length && !is_arc) {
        element.size = std::abs(*length);
    } else if (length) {
        FreeCondition chord;
        chord.of = Of::chord;
        chord.value = std::abs(*length);
        element.conditions.push_back(chord);
    }
    for (const bool of_centre : {false, true}) {
        if (auto done = free_point(in, free, of_centre, element); !done) return std::unexpected(done.error());
    }
    if (auto done = free_direction(in, free, element); !done) return std::unexpected(done.error());
    for (std::size_t k = 0; k < free.points.size(); ++k) {
        if (!free.has_point[k]) continue;
        FreeCondition passes;
        passes.of = Of::passes_point;
        passes.point = free.points[k];
        passes.value = k == 0 ? std::abs(value("D").value_or(0)) : 0;
        element.conditions.push_back(passes);
    }
    if (free.closing < 0) {
        for (const Of of : {Of::x, Of::y}) {
            FreeCondition closes;
            closes.of = of;
            closes.reference = free_->closed_from.value_or(0);
            closes.from_start = true;
            element.conditions.push_back(closes);
        }
    }
    return element;
}

// FL, FLT, FC and FCT.
Result<void> Interpreter::free_block(LineReader& in, const std::string& name) {
    if (!free_) {
        if (scale_ != Vec3{1, 1, 1} || mirror_ != Vec3{1, 1, 1}) {
            return in.refuse(line_.column, "a free contour in a mirrored or scaled frame is not read",
                             "end CYCL DEF 8, 11 and 26 before it");
        }
        if (is_lost())
            return in.refuse(line_.column, "a free contour begins at an unknown place",
                             "write L X Y before it");
        assume_start();
        std::optional<double> direction;
        const bool is_flat = math::hypot(tangent_.x, tangent_.y) > 1e-9;
        if (is_flat && !contour_.has_approach()) direction = math::atan2(tangent_.y, tangent_.x);
        const Vec3 start{here().x, here().y, 0};
        free_.emplace(FreeRun{FreeContour(start, direction), start, direction.has_value(), {}, {}});
        free_numbers_.clear();
    }
    FreeWords free;
    const auto words = read_words(in, name, &free);
    if (!words) return std::unexpected(words.error());
    const bool is_tangent = name.back() == 'T';
    const std::size_t count = free_->contour.size();
    if (is_tangent && count == 0 && !free_->has_direction) {
        return in.refuse(line_.column, name + " with nothing before it to be tangent to",
                         "begin the contour with FL or FC");
    }
    if (count >= kMostElements)
        return in.refuse(line_.column, "the free contour has too many elements", "write an L block between");
    if (free.closing > 0) free_->closed_from = count;
    const auto element = free_element(in, *words, free, name[1] == 'C', is_tangent);
    if (!element) return std::unexpected(element.error());
    if (auto cause = limit_.count(kCostOfElement)) {
        is_over_ = true;
        return path_.refuse(place(1), *std::move(cause), RunLimit::kRemedy);
    }
    const auto state = free_->contour.add(*element);
    if (state == FreeContour::State::contradictory) {
        return in.refuse(line_.column, "no element fits what " + name + " and the blocks before it state",
                         "correct them");
    }
    const long number = std::atol(std::string(trimmed(lines_[at_])).c_str());
    free_numbers_[number] = count;
    free_->blocks.push_back({line_, *words, FreeBlock::Kind::element});
    const bool ends = std::any_of(words->m.begin(), words->m.end(),
                                  [](int m) { return m == 2 || m == 30 || m == 89 || m == 99; });
    return ends ? close_free_contour() : Result<void>{};
}

// FSELECT 2: one of several contours that fit. The control numbers them as it draws them, which no manual
// says; they are counted from the shortest on.
Result<void> Interpreter::select_free_contour(LineReader& in) {
    const auto number = in.number();
    if (!number) return std::unexpected(number.error());
    if (!free_) return in.refuse(line_.column, "FSELECT without a free contour", "write FL or FC before it");
    const std::size_t choices = free_->contour.choices();
    if (choices < 2) return {};
    if (!*number || !(**number >= 1) || **number > static_cast<double>(choices)) {
        return in.refuse(line_.column,
                         "FSELECT chooses none of the " + std::to_string(choices) + " contours that fit",
                         "write a number from 1 to " + std::to_string(choices));
    }
    if (path_.first(kFreeChoice)) {
        path_.warn(line_.number,
                   "the order of the contours that FSELECT chooses from is the control's own: "
                   "they are counted from the shortest on; state more of the contour to be sure");
    }
    free_->contour.choose(static_cast<std::size_t>(**number) - 1);
    return {};
}

// Moves the tool along the free contour, all of whose elements must be known now.
Result<void> Interpreter::close_free_contour() {
    if (!free_) return {};
    FreeRun run = std::move(*free_);
    free_.reset();
    if (run.contour.size() == 0) return {};
    const bool had_end = run.contour.has_end();
    const FreeBlock& last = *std::find_if(run.blocks.rbegin(), run.blocks.rend(), [](const FreeBlock& block) {
        return block.kind == FreeBlock::Kind::element;
    });
    const Place where{last.line.number, last.line.column};
    if (!run.contour.is_complete()) {
        return path_.refuse(where, "the free contour does not say where this element lies",
                            "state more of it, for example its end X and Y");
    }
    if (run.contour.choices() > 1) {
        return path_.refuse(
            where,
            std::to_string(run.contour.choices()) + " contours fit what the free blocks up to here state",
            "state more of it, for example an end X or Y, or choose with FSELECT");
    }
    if (!had_end && path_.first(kFreeCircle))
        path_.warn(where.line, "an arc about a known centre without an end is taken as a full circle");
    const std::vector<FreePiece> pieces = run.contour.pieces();
    const Line now = line_;
    auto done = run_free_blocks(run.blocks, pieces);
    if (done) line_ = now;
    corner_next_.reset();
    return done;
}

Result<void> Interpreter::run_free_blocks(const std::vector<FreeBlock>& blocks,
                                          const std::vector<FreePiece>& pieces) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const FreeBlock& block = blocks[i];
        line_ = block.line;
        corner_next_ = i + 1 < blocks.size() && blocks[i + 1].kind != FreeBlock::Kind::element;
        if (block.kind != FreeBlock::Kind::element) {
            if (auto done = add_corner(block.words, block.kind == FreeBlock::Kind::chamfer); !done)
                return done;
            continue;
        }
        const FreePiece& piece = pieces[next++];
        const Vec3 to{piece.end.x, piece.end.y, here().z};
        std::optional<motion::Arc> arc;
        if (piece.turning != 0) {
            arc.emplace();
            arc->centre_mm = {piece.centre.x, piece.centre.y, here().z};
            arc->normal = {0, 0, static_cast<double>(piece.turning)};
            arc->turn_rad = piece.size;
        }
        if (auto done = travel(block.words, to, arc, path_.rotary_rad()); !done) return done;
    }
    return {};
}

}  // namespace tribo::readers::heidenhain
