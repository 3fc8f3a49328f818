// SPDX-License-Identifier: MIT
#include "readers/siemens/interpreter.hpp"

#include <algorithm>
#include <utility>

#include "readers/siemens/reader.hpp"
#include "readers/text/length_unit.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace siemens {
namespace {

// Blocks without effect on the path, as a whole.
constexpr std::string_view kSilentBlocks[] = {"EXTERN", "REDEF", "CHANDATA", "PROC"};
// Synchronised actions: they run beside the program.
constexpr std::string_view kActions[] = {"WHEN", "WHENEVER", "EVERY", "FROM", "DO"};

template <std::size_t N>
bool is_one_of(const std::string_view (&words)[N], std::string_view name) {
    return std::find(std::begin(words), std::end(words), name) != std::end(words);
}

}  // namespace

Interpreter::Interpreter(std::string_view bytes, const GcodeOptions& options, MoveSink* sink)
    : source_name_(options.source_name),
      text_(bytes),
      path_(options, sink),
      limit_(path_.options, bytes.size(), path_.moves),
      unit_mm_(mm_per(options.default_unit)) {
    path_.program.dialect = "Siemens";
    number_tools();
}

Result<motion::Program> Interpreter::run() {
    unit_ = &text_.main();
    auto done = run_lines(unit_->begin, unit_->end);
    if (done) {
        auto program = finish();
        if (program && first_refusal(path_.options.refusals) == nullptr) return program;
        if (!program) {
            goes_on_after(program.error());
            done = std::unexpected(program.error());
        }
    }
    if (const Error* first = first_refusal(path_.options.refusals)) return std::unexpected(*first);
    return std::unexpected(done.error());
}

// Runs the lines up to `end`, or to a jump out of them.
Result<void> Interpreter::run_lines(std::size_t begin, std::size_t end) {
    at_ = begin;
    while (at_ >= begin && at_ < end && !ended_ && !returned_) {
        jumped_ = false;
        const int line = line_number();
        auto done = run_line();
        for (const int number : variables_.take_unset_r()) {
            path_.warn(line, "R" + std::to_string(number) +
                                 " has no value so far: 0 is taken; a control keeps the one of the program "
                                 "before");
        }
        if (!done && !goes_on_after(done.error())) return done;
        if (!jumped_) ++at_;
    }
    return {};
}

// Keeps a refusal where the caller wants them all. The reading goes on without the block; where the tool is,
// nobody knows then.
bool Interpreter::goes_on_after(const Error& error) {
    if (!keep_refusal(path_.options.refusals, error) || is_over_) return false;
    path_.lose(error.line);
    contour_ = {};
    spline_.reset();
    return true;
}

Result<void> Interpreter::run_line() {
    const std::string_view text = text_.line(at_);
    if (text.size() > kLongestBlock) {
        return path_.refuse(place(static_cast<int>(kLongestBlock) + 1), too_long_block(text.size()),
                            "write it on several lines");
    }
    if (auto cause = limit_.count(text.size())) {
        is_over_ = true;
        return path_.refuse(place(1), *std::move(cause), RunLimit::kRemedy);
    }
    const std::string_view code = code_of(text);
    read_notes(text, code);
    const Head head = head_of(code);
    Cursor in{code, head.at, line_number(), &source_name_};
    if (in.at_end()) return {};
    if (head.is_deletable && path_.options.skip_deletable_blocks) {
        if (path_.first(kSkipped)) path_.warn(line_number(), "blocks that begin with '/' are skipped");
        return {};
    }
    return execute(in);
}

Result<void> Interpreter::execute(Cursor& in) {
    if (in.peek() == '%') return {};
    began_ = true;
    const std::string word = name_at(in);
    const std::size_t begin = in.at;
    const auto is_structure = run_structure(word, in);
    if (!is_structure) return std::unexpected(is_structure.error());
    if (*is_structure) return {};
    in.at = begin;
    if (is_one_of(kSilentBlocks, word)) return {};
    if (is_one_of(kActions, word)) {
        if (passed_over_.insert("ID").second) {
            path_.warn(line_number(), "synchronised actions (" + word +
                                          ") are passed over: they are taken not to move the tool");
        }
        return {};
    }
    in.at = begin + word.size();
    if (word == "DEF") return define(in);
    if (word == "DEFINE") return define_macro(in);
    if (word == "MCALL") return set_modal(in);
    if (word == "CALL" || word == "PCALL" || word == "EXTCALL") return call_by_text(word, in);
    in.at = begin;
    Words words;
    words.first_column = static_cast<int>(begin) + 1;
    if (auto done = read_words(in, words); !done) return done;
    return run_words(words);
}

// Runs a block: modes, then what it says about frames, feed and tool, the move, the functions at its end, and
// the call of a program.
Result<void> Interpreter::run_words(Words& words) {
    if (auto done = apply_codes(words); !done) return done;
    if (ended_) return {};
    const bool dwells = std::any_of(words.g.begin(), words.g.end(), [](Code c) { return c.number == 4; });
    if (!words.tool_frame.empty()) {
        if (auto done = frame_along_tool(words); !done) return done;
    }
    if (!words.frame.empty()) {
        if (auto done = transform(words); !done) return done;
    } else if (dwells) {
        if (auto done = dwell(words); !done) return done;
    } else if (words.machine_place || words.is_home) {
        if (auto done = leave_for_machine(words); !done) return done;
    } else if (words.moves()) {
        if (auto done = move(words); !done) return done;
    } else if (words.rounding || words.chamfer || words.chamfer_leg) {
        return path_.refuse(place(words.first_column), "a corner without a move",
                            "write it beside X, Y or Z");
    }
    if (auto done = apply_m_after(words); !done) return done;
    if (!words.call) return {};
    words.call->times = words.times.value_or(1);
    const bool is_alone = !words.moves() && words.g.empty() && !words.feed && words.frame.empty();
    if (!is_alone && !words.call->has_list && text_.unit_named(words.call->name) == nullptr &&
        words.call->name[0] != 'L') {
        return path_.refuse(place(words.call->column),
                            "the word " + words.call->name.substr(0, 31) + " is not known",
                            "delete it where it does not move the tool");
    }
    return run_call(*words.call);
}

Result<motion::Program> Interpreter::finish() {
    motion::Program& program = path_.program;
    if (!began_) {
        return path_.refuse({}, "no Siemens program in this file", "check that it is the right one");
    }
    if (auto done = close_contour(); !done) return std::unexpected(done.error());
    if (path_.machine) {
        for (Warning& found : path_.machine->findings(program.source)) {
            program.warnings.push_back(std::move(found));
        }
    }
    if (left_out_ > 0) {
        path_.warn(left_out_line_, std::to_string(left_out_) +
                                       " moves that begin where only the machine knows are left out: write "
                                       "X, Y and Z with G0 before them");
    }
    for (const Unit& unit : text_.units()) {
        if (&unit == &text_.main() || unit.is_subprogram || unit.proc || !path_.first(kOtherPrograms))
            continue;
        path_.warn(static_cast<int>(unit.begin) + 1, "a second program follows: only the first one is run");
    }
    path_.finish_tools(unit_mm_);
    if (path_.moves == 0) path_.warn(0, "the program moves no tool");
    return std::move(program);
}

}  // namespace siemens

Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options) {
    return siemens::Interpreter(bytes, options, nullptr).run();
}

Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options, MoveSink& sink) {
    return siemens::Interpreter(bytes, options, &sink).run();
}

}  // namespace tribo::readers
