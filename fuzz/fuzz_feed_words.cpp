// SPDX-License-Identifier: MIT
// The first byte names a language, the rest is a program. With other feeds only feed words differ, and a
// program whose lines run in order reads again as the same path; so does one that is written out. Not APT,
// whose feeds are statements.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "readers/gcode/reader.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/rewrite/feed_words.hpp"
#include "readers/rewrite/unrolled.hpp"
#include "readers/siemens/reader.hpp"
#include "readers/text/text_lines.hpp"

namespace {

using namespace tribo;

readers::GcodeOptions bounded() {
    readers::GcodeOptions options;
    options.source_name = "fuzz.nc";
    options.max_steps = 2'000;
    options.max_moves = 20'000;
    return options;
}

// Without blanks, and without numbers behind an F.
std::string without_feeds(std::string_view text) {
    std::string rest;
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (readers::is_blank(text[n])) continue;
        rest += text[n];
        if (readers::to_upper(text[n]) != 'F') continue;
        std::size_t at = n + 1;
        // Heidenhain: FU per turn, FZ per tooth.
        if (at < text.size() && (readers::to_upper(text[at]) == 'U' || readers::to_upper(text[at]) == 'Z'))
            ++at;
        while (at < text.size() && (readers::is_blank(text[at]) || text[at] == '=')) ++at;
        if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
        std::size_t end = at;
        while (end < text.size() && (readers::is_digit(text[end]) || text[end] == '.' || text[end] == ','))
            ++end;
        if (end == at) continue;
        rest.pop_back();
        n = end - 1;
    }
    return rest;
}

double factor_of(int line) {
    return 0.1 + 0.37 * (line % 7);
}

void expect_words_alone(std::string_view text, readers::FeedLanguage language) {
    std::vector<readers::LineFeed> feeds;
    readers::TextLines lines(text);
    while (lines.next())
        if (lines.number() % 3 > 0) feeds.push_back({lines.number(), factor_of(lines.number())});
    const auto written = readers::with_feeds(text, language, feeds, "fuzz.nc");
    if (!written) {
        if (written.error().cause.empty() || written.error().remedy.empty()) std::abort();
    } else if (language != readers::FeedLanguage::apt && without_feeds(*written) != without_feeds(text)) {
        std::abort();
    }
}

// Moves of no length, as a chamfer at no corner leaves them, are not written.
bool same_path(const motion::Program& a, const motion::Program& b, double most_mm) {
    const auto goes = std::views::filter([](const motion::Move& move) {
        return move.arc || move.kind == motion::MoveKind::dwell ||
               distance(move.start.tip_mm, move.end.tip_mm) > 1e-9;
    });
    return std::ranges::equal(
        a.moves | goes, b.moves | goes, [&](const motion::Move& x, const motion::Move& y) {
            const double size = 1 + length(x.end.tip_mm);
            return x.kind == y.kind && distance(x.end.tip_mm, y.end.tip_mm) <= most_mm * size;
        });
}

Result<motion::Program> read(std::string_view text, readers::FeedLanguage language) {
    if (language == readers::FeedLanguage::siemens) return readers::read_siemens(text, bounded());
    if (language == readers::FeedLanguage::heidenhain) return readers::read_heidenhain(text, bounded());
    return readers::read_gcode(text, bounded());
}

void expect_same_path(std::string_view text, readers::FeedLanguage language) {
    const auto program = read(text, language);
    if (!program) return;
    std::vector<readers::LineFeed> feeds;
    bool in_order = true;
    for (const motion::Move& move : program->moves) {
        in_order = in_order && (feeds.empty() || move.line >= feeds.back().line);
        if (move.kind == motion::MoveKind::feed && (feeds.empty() || move.line != feeds.back().line))
            feeds.push_back({move.line, factor_of(move.line)});
    }
    if (in_order) {
        const auto written = readers::with_feeds(text, language, feeds, "fuzz.nc");
        if (written) {
            const auto again = read(*written, language);
            // The verb compares, and refuses another path; but a path must come.
            if (again && !same_path(*program, *again, 0)) std::abort();
        }
    }
    const auto unrolled = readers::unrolled_program(*program, {.language = language});
    if (!unrolled) {
        if (unrolled.error().cause.empty() || unrolled.error().remedy.empty()) std::abort();
        return;
    }
    const auto again = read(*unrolled, language);
    if (!again || !same_path(*program, *again, 1e-9)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t largest = 1 << 16;
    if (size == 0 || size > largest) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const auto language = static_cast<readers::FeedLanguage>(data[0] % 4);
    expect_words_alone(text, language);
    if (language != readers::FeedLanguage::apt) expect_same_path(text, language);
    return 0;
}
