// SPDX-License-Identifier: MIT
#include "readers/heidenhain/interpreter.hpp"

#include <algorithm>
#include <utility>

#include "readers/heidenhain/din_iso.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/text/length_unit.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace heidenhain {
namespace {

constexpr int kLargestTool = 32'767;  // of a tool table (TNC 640, Conversational Programming)
// Blocks without effect on the path. What SEL and CONTOUR choose is refused where it is called.
constexpr std::string_view kSilentBlocks[] = {"OPEN",       "CLOSE", "SEL", "CONTOUR",
                                              "MONITORING", "COUNT", "AFC", "SECTION"};

// A block of one line, not a list of parameters: a comment behind it may go on in the next line.
bool is_statement(std::string_view text) {
    constexpr std::string_view begins[] = {"Q", "FN", "L ", "C ", "CC", "CR", "CT", "LP", "CP", "CALL LBL"};
    return std::ranges::any_of(begins, [&](std::string_view begin) {
        return std::ranges::equal(text.substr(0, begin.size()), begin, {}, to_upper);
    });
}

// BEGIN PGM NAME MM, in upper case.
std::string name_of_program(std::string_view text) {
    text = trimmed(text.substr(std::min<std::size_t>(text.find_first_of("mM") + 1, text.size())));
    std::string name(text.substr(0, text.find_first_of(" \t")));
    std::transform(name.begin(), name.end(), name.begin(), to_upper);
    return name;
}

}  // namespace

Interpreter::Interpreter(std::string_view bytes, const GcodeOptions& options, MoveSink* sink)
    : source_name_(options.source_name),
      path_(options, sink),
      limit_(path_.options, bytes.size(), path_.moves) {
    path_.program.dialect = "Heidenhain";
    path_.notes.number_up_to(kLargestTool);
    TextLines text(bytes);
    for (int number = 1; auto line = text.next(); ++number) {
        for (std::size_t end = line->find(kNextBlock); end != line->npos; end = line->find(kNextBlock)) {
            lines_.push_back(line->substr(0, end));
            numbers_.push_back(number);
            line->remove_prefix(end + 1);
        }
        lines_.push_back(*line);
        numbers_.push_back(number);
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Line line = line_at(i);
        if (line.text.size() < 4) continue;
        LineReader in(line, source_name_, parameters_);
        if (in.take("BEGIN") && in.take("PGM")) {
            programs_.push_back({name_of_program(line.text), i});
            continue;
        }
        if (!in.take("LBL")) continue;
        if (const auto label = in.label(); label && *label != "0")
            labels_.try_emplace(label_key(*label, i), i + 1);
    }
    number_tools();
}

Result<motion::Program> Interpreter::run() {
    parameters_.take_unset();  // of the search for labels and tools
    for (; at_ < lines_.size() && !ended_; ++at_) {
        const auto done = run_line();
        for (const int index : parameters_.take_unset()) {
            path_.warn(line_.number, Parameters::name(index) + " has no value so far: 0 is taken");
        }
        if (!done && !goes_on_after(done.error())) return std::unexpected(done.error());
    }
    auto program = finish();
    if (!program) goes_on_after(program.error());
    if (const Error* first = first_refusal(path_.options.refusals)) return std::unexpected(*first);
    return program;
}

Result<void> Interpreter::run_line() {
    if (auto taken = take_line(); !taken) return taken;
    read_notes(lines_[at_]);
    if (line_.text.empty()) return skip_text();
    if (line_.text[0] == '/' && path_.options.skip_deletable_blocks) {
        if (path_.first(kSkipped)) path_.warn(line_.number, "blocks that begin with '/' are skipped");
        return skip_text();
    }
    if (line_.comment_goes_on && is_statement(line_.text)) {
        for (Line rest = line_; rest.goes_on && at_ + 1 < lines_.size(); rest = line_at(at_)) ++at_;
        line_.goes_on = false;
    }
    LineReader in(line_, source_name_, parameters_);
    return execute(in);
}

// Keeps a refusal where the caller wants them all. The reading goes on without the block; where the tool is,
// nobody knows then.
bool Interpreter::goes_on_after(const Error& error) {
    if (!keep_refusal(path_.options.refusals, error) || is_over_) return false;
    while (line_.goes_on && at_ + 1 < lines_.size()) {
        ++at_;
        line_ = line_at(at_);
    }
    contour_ = {};
    free_.reset();
    path_.lose(error.line);
    return true;
}

// Makes the line at at_ the running line, and counts it.
Result<void> Interpreter::take_line() {
    const std::string_view text = lines_[at_];
    const int number = numbers_[at_];
    if (text.size() > kLongestBlock) {
        return path_.refuse({number, static_cast<int>(kLongestBlock) + 1}, too_long_block(text.size()),
                            "write it on several lines");
    }
    line_ = line_of(text, number);
    auto cause = limit_.count(text.size());
    if (!cause) return {};
    is_over_ = true;
    return path_.refuse(place(1), *std::move(cause), RunLimit::kRemedy);
}

// Moves to the line joined by '~'. Returns false if there is none.
Result<bool> Interpreter::goes_on() {
    if (!line_.goes_on || at_ + 1 >= lines_.size()) return false;
    ++at_;
    if (auto taken = take_line(); !taken) return std::unexpected(taken.error());
    return true;
}

// Appends the items of the block, with those of the lines joined by '~'.
Result<void> Interpreter::all_items(LineReader& in, std::vector<Item>& items) {
    if (auto done = in.items(items); !done) return done;
    for (;;) {
        const auto more = goes_on();
        if (!more) return std::unexpected(more.error());
        if (!*more) return {};
        LineReader next(line_, source_name_, parameters_);
        if (auto done = next.items(items); !done) return done;
    }
}

// Leaves out a block that does not change the path, with one warning for each kind.
Result<void> Interpreter::pass_over(const std::string& what) {
    if (passed_over_.insert(what).second) {
        path_.warn(line_.number, what + " is passed over: it is taken not to move the tool");
    }
    return skip_continuation();
}

Result<void> Interpreter::skip_continuation() {
    for (;;) {
        const auto more = goes_on();
        if (!more) return std::unexpected(more.error());
        if (!*more) return {};
    }
}

// Leaves out the lines joined by '~' to a comment or a skipped block. A line with a number is a block of its
// own, and a comment that ends with ~~ is a rule drawn across the page.
Result<void> Interpreter::skip_text() {
    while (line_.goes_on && at_ + 1 < lines_.size()) {
        const std::string_view next = trimmed(lines_[at_ + 1]);
        if (trimmed(lines_[at_]).ends_with("~~") || (!next.empty() && is_digit(next[0]))) return {};
        if (const auto more = goes_on(); !more) return std::unexpected(more.error());
    }
    return {};
}

Result<void> Interpreter::execute(LineReader& in) {
    if (free_ && !keeps_free_contour()) {
        if (auto done = close_free_contour(); !done) return done;
    }
    const char first = line_.text[0];
    if (first == '*' || first == '%' || first == '?' || first == '(') return skip_text();
    if (to_upper(first) == 'Q') return assign(in);
    if (in.take("BEGIN")) return begin();
    if (in.take("END")) {
        end_program();
        return {};
    }
    if (!std::exchange(begun_, true) && path_.first(kNoUnit)) {
        path_.warn(line_.number,
                   "no BEGIN PGM with MM or INCH before the first block: millimetres are taken");
    }
    if (in.take("BLK")) return blank_form(in);
    if (in.take("TOOL")) return in.take("CALL") ? call_tool(in) : define_tool(in);
    if (in.take("LBL")) {
        const auto label = in.label();
        if (!label) return std::unexpected(label.error());
        return *label == "0" ? end_label() : Result<void>{};
    }
    if (in.take("CALL")) return call(in);
    if (in.take("CYCL") || in.take("CYCLE")) {
        if (in.take("DEF")) return define_cycle(in);
        if (!in.take("CALL")) return in.refuse(in.column(), "CYCL without DEF or CALL", "write CYCL CALL");
        return call_cycle(in);
    }
    if (in.take("FN")) return function(in);
    if (in.take("FUNCTION")) return machine_function(in);
    if (in.take("PLANE")) return plane(in);
    if (in.take("TRANS")) return transform(in);
    if (in.take("PATTERN")) return define_pattern(in);
    if (in.take("GLOBAL")) {
        if (!in.take("DEF")) return in.refuse(in.column(), "GLOBAL without DEF", "write GLOBAL DEF");
        Cycle values;
        if (auto done = read_parameters(in, values); !done) return done;
        for (const auto& [q, value] : values.q) general_[q] = value;
        return {};
    }
    if (in.take("TCH")) {
        path_.warn(line_.number, "the touch probe's moves are left out, and its results are not known");
        for (int q = 150; q < 200; ++q) parameters_.forget(q);
        if (auto done = close_contour(); !done) return done;
        contour_.leave();
        path_.lose(line_.number);
        return pass_over("TCH PROBE");
    }
    if (in.take("PRESET")) {
        if (!in.take("SELECT"))
            return in.refuse(in.column(), "only PRESET SELECT is read",
                             "write the place of the zero with TRANS DATUM");
        return take_preset("PRESET SELECT");
    }
    if (in.take("DECLARE")) return in.take("STRING") ? assign_text(in) : pass_over("DECLARE");
    for (const std::string_view word : kSilentBlocks) {
        if (in.take(word)) return pass_over(std::string(word));
    }
    return execute_path(in);
}

Result<void> Interpreter::execute_path(LineReader& in) {
    if (in.take("LN")) return line_with_vectors(in);
    if (in.take("LP")) return line(in, true);
    if (in.take("L")) return line(in, false);
    if (in.take("CC")) return pole(in);
    if (in.take("CP")) return polar_circle(in);
    if (in.take("CR")) return circle_of_radius(in);
    if (in.take("CTP")) return tangent_circle(in, true);
    if (in.take("CT")) return tangent_circle(in, false);
    if (in.take("C")) return circle(in);
    if (in.take("RND")) return corner(in, false);
    if (in.take("CHF")) return corner(in, true);
    if (in.take("APPR")) return approach(in);
    if (in.take("DEP")) return depart(in);
    for (const std::string_view word : {"FL", "FLT", "FC", "FCT"}) {
        if (in.take(word)) return free_block(in, std::string(word));
    }
    if (in.take("FPOL")) return free_pole(in);
    if (in.take("FSELECT")) return select_free_contour(in);
    for (const std::string_view word : {"SPL", "POLY"}) {
        if (!in.take(word)) continue;
        return in.refuse(line_.column, std::string(word) + " is not read",
                         "let the control or the CAM system write the path with L, C and CC");
    }
    // A block with miscellaneous functions only.
    if (in.take("STOP") || to_upper(line_.text[0]) == 'M') {
        const auto words = read_words(in, "M");
        if (!words) return std::unexpected(words.error());
        return miscellaneous(*words);
    }
    // Z+0 R0 F200: a move along axes, as the axis keys of old controls write it.
    const auto character = [&](std::size_t at) {
        return at < line_.text.size() ? to_upper(line_.text[at]) : ' ';
    };
    const std::size_t first = character(0) == 'I' ? 1 : 0;
    const bool is_axis = std::string_view("XYZABCUVW").find(character(first)) != std::string_view::npos;
    const char behind = character(first + 1);
    if (is_axis && (behind == '+' || behind == '-' || behind == '.' || is_digit(behind)))
        return line(in, false);
    const std::size_t blank = line_.text.find_first_of(" \t");
    std::string word(line_.text.substr(0, std::min<std::size_t>(blank, 12)));
    for (char& c : word) {
        if (c < ' ' || c > '~') c = '?';
    }
    return in.refuse(line_.column, "the block '" + word + "' is not known",
                     "check that this is a conversational program");
}

// BEGIN PGM NAME MM
Result<void> Interpreter::begin() {
    begun_ = true;
    std::string text(line_.text);
    std::transform(text.begin(), text.end(), text.begin(), to_upper);
    if (text.ends_with("INCH") || text.ends_with(" IN")) {
        unit_mm_ = mm_per(LengthUnit::inch);
        path_.rotary_feed.degree_mm = feed_unit_mm();
    } else if (!text.ends_with("MM") && path_.first(kNoUnit)) {
        path_.warn(line_.number, "BEGIN PGM names no unit: millimetres are taken");
    }
    return {};
}

Result<motion::Program> Interpreter::finish() {
    motion::Program& program = path_.program;
    if (!begun_) {
        return path_.refuse({}, "no conversational program in this file", "check that it is the right one");
    }
    if (auto done = close_free_contour(); !done) return std::unexpected(done.error());
    if (auto done = close_contour(); !done) return std::unexpected(done.error());
    if (path_.machine) {
        for (Warning& found : path_.machine->findings(program.source)) {
            program.warnings.push_back(std::move(found));
        }
    }
    if (left_out_ > 0) {
        const std::string since =
            left_out_since_ > 0 ? " since line " + std::to_string(left_out_since_) : std::string();
        path_.warn(left_out_line_, "moves that begin at a place that only the machine knows" + since +
                                       " are left out (" + std::to_string(left_out_) +
                                       " in all): write X, Y and Z with FMAX before them");
    }
    path_.finish_tools(unit_mm_);
    if (path_.moves == 0) path_.warn(0, "the program moves no tool");
    return std::move(program);
}

}  // namespace heidenhain

Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options) {
    return heidenhain::Interpreter(bytes, options, nullptr).run();
}

Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options, MoveSink& sink) {
    return heidenhain::Interpreter(bytes, options, &sink).run();
}

}  // namespace tribo::readers
