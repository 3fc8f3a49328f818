// SPDX-License-Identifier: MIT
#include "job/assumption.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/decimal.hpp"
#include "job/completion.hpp"
#include "job/program_tools.hpp"
#include "job/solid.hpp"
#include "job/words/stock_words.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::job {
namespace {

constexpr double kSpindleRpm = 10000, kFeedMmPerMin = 600;
// Of tools that nothing describes, mm: the first, and what follows where it has no place.
constexpr std::array kDiametersMm{6.0, 3.0, 2.0, 1.0, 0.5, 0.2};
constexpr const char* kMaterial = "al7075-t6";
// Material below the path, mm.
constexpr double kBelowMm = 3;

double or_else(double given, double assumed) {
    return given > 0 ? given : assumed;
}

// Of the feed moves of the tip; empty without one.
Box3 bounds_of_path(const motion::Program& program) {
    Box3 box;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed) box.include(motion::tip_bounds(move));
    }
    return box;
}

// Where the path reaches below zero, zero is the top, as programs are mostly written; else the top is what
// the highest feed move that is not a plunge touches.
double top_mm(const Box3& path) {
    return path.min.z < 0 ? 0 : std::max(path.max.z, path.min.z + 1);
}

Box3 block_around(const Box3& path, double radius_mm) {
    Box3 box = path.inflated(radius_mm);
    for (int axis = 0; axis < 2; ++axis) {
        box.min[axis] = std::floor(box.min[axis]);
        box.max[axis] = std::ceil(box.max[axis]);
    }
    const double bottom = path.min.z - kBelowMm;
    box.min.z = bottom < 0 ? std::floor(bottom) : std::ceil(bottom);
    box.max.z = top_mm(path);
    return box;
}

// Its top as above, its middle on that of the path.
Box3 block_on(const Box3& path, Vec3 size) {
    const Vec3 middle = path.centre();
    const double top = top_mm(path);
    return {{middle.x - 0.5 * size.x, middle.y - 0.5 * size.y, top - size.z},
            {middle.x + 0.5 * size.x, middle.y + 0.5 * size.y, top}};
}

// The first feed move for which `is_such` is true; null without one.
template <class IsSuch>
const motion::Move* first_feed_move(const motion::Program& program, IsSuch is_such) {
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed && is_such(move)) return &move;
    }
    return nullptr;
}

}  // namespace

Job job_of_program(const std::string& file, PathKind kind, const ProgramInputs& inputs) {
    Job job;
    job.file = file;
    if (inputs.stock) job.stock = inputs.stock->solid;
    job.cutters = inputs.cutters;
    job.material.name = inputs.material.empty() ? kMaterial : inputs.material;
    job.process = {or_else(inputs.process.spindle_rpm, kSpindleRpm),
                   or_else(inputs.process.feed_mm_per_min, kFeedMmPerMin)};
    job.path.kind = kind;
    job.path.file = file;
    job.path.machine = inputs.machine;
    job.path.tools = inputs.tool_table;
    job.path.dialect = inputs.dialect;
    return job;
}

AssumedTools::AssumedTools(const std::vector<int>& numbers, const motion::Program& program)
    : source_(program.source) {
    for (const int number : numbers) tools_.push_back({number, 0, {}});
    if (tools_.empty()) return;
    for (const motion::Move& move : program.moves) {
        if (begins_.empty() || begins_.back().second != move.tool) begins_.emplace_back(move.line, move.tool);
    }
}

void AssumedTools::add_to(Job& job) const {
    for (const Tool& tool : tools_) {
        job.cutters.emplace_back();
        job.cutters.back().number = tool.number;
        job.cutters.back().diameter_mm = kDiametersMm[tool.size];
    }
}

bool AssumedTools::shrink_after(const Error& refusal) {
    std::pair<int, int> begin{0, 0};
    for (const auto& [line, number] : begins_) {
        if (line <= refusal.line && line >= begin.first) begin = {line, number};
    }
    const auto tool = std::ranges::find_if(
        tools_, [&](const Tool& t) { return t.number == begin.second || t.number == 0; });
    if (tool == tools_.end() || tool->size + 1 == kDiametersMm.size()) return false;
    ++tool->size;
    tool->refusal = "line " + std::to_string(refusal.line) + " (" + refusal.cause + ")";
    return true;
}

void AssumedTools::say(Warnings& warnings) const {
    for (std::size_t size = 0; size < kDiametersMm.size(); ++size) {
        milling::Cutter first;
        std::string names, refusal;
        int count = 0;
        for (const Tool& tool : tools_) {
            if (tool.size != size) continue;
            names += (count == 0 ? "T" : ", T") + std::to_string(tool.number);
            if (count++ == 0) first.number = tool.number;
            if (refusal.empty()) refusal = tool.refusal;
        }
        if (count == 0) continue;
        first.diameter_mm = kDiametersMm[size];
        const std::string which = first.number == 0 ? "the tool is"
                                  : count == 1      ? "tool " + names + " is"
                                                    : "the tools " + names + " are";
        std::string text = which + " not described: a flat end mill of ";
        text += format_decimal(first.diameter_mm);
        text += " mm with ";
        text += std::to_string(first.flutes);
        text += " flutes is assumed";
        if (count > 1) text += " for each";
        if (size > 0) text += ", since a larger one is refused at " + refusal;
        text += "; write --tool \"" + tool_words(first);
        text += count == 1 ? "\"" : "\" and so on";
        warnings.push_back({source_, 0, text + ", or a [[cutter]] into a job"});
    }
}

Result<AssumedTools> take_tools(Job& job, const motion::Program& program, Warnings& warnings) {
    if (auto done = take_declared_tools(job, program, warnings); !done) return std::unexpected(done.error());
    const auto called = called_tools(program);
    if (!called) return std::unexpected(called.error());
    std::vector<int> unknown;
    for (const int number : *called) {
        const bool is_described = std::ranges::any_of(job.cutters, [&](const milling::Cutter& c) {
            return c.number == number || number == 0 || (c.number == 0 && job.cutters.size() == 1);
        });
        if (!is_described) unknown.push_back(number);
    }
    return AssumedTools(unknown, program);
}

Result<void> assume_stock(Job& job, const motion::Program& program, const ProgramInputs& inputs,
                          Warnings& warnings) {
    const bool has_size = inputs.stock && inputs.stock->size_mm;
    if (!has_size) {
        if (auto done = take_declared_stock(job, program, warnings); !done) return done;
    }
    if (job.has_stock()) return {};
    const Box3 path = bounds_of_path(program);
    if (path.empty()) {
        return fail_at(program.source, 0, 0, "the program has no feed move: there is nothing to mill",
                       "check that it is the right program; tribo inspect says what it holds");
    }
    double radius_mm = 0;
    for (const milling::Cutter& cutter : job.cutters) radius_mm = std::max(radius_mm, cutter.radius_mm());
    job.stock.box_mm = has_size ? block_on(path, *inputs.stock->size_mm) : block_around(path, radius_mm);
    if (const auto room = check_room(job.stock.box_mm); !room) {
        return fail_at(program.source, 0, 0, "in the assumed block " + room.error().cause,
                       "check the unit of the program; write --stock, or [stock] into a job");
    }
    const std::string what =
        has_size ? "the place of the stock is not given: its middle is assumed on that of the path"
                 : "no stock is described: a block around the path is assumed";
    warnings.push_back({program.source, 0,
                        what + "; write --stock \"" + stock_words(job.stock.box_mm) +
                            "\" (two corners, mm), or [stock] into a job"});
    return {};
}

void say_assumed_process(const Job& job, const motion::Program& program, const ProgramInputs& inputs,
                         Warnings& warnings) {
    const auto* no_speed = first_feed_move(program, [](const auto& move) { return move.spindle_rpm == 0; });
    if (no_speed != nullptr && inputs.process.spindle_rpm == 0) {
        warnings.push_back({program.source, no_speed->line,
                            "no spindle speed so far: " + format_decimal(job.process.spindle_rpm) +
                                " rpm are assumed; write an S word, --spindle-rpm, or spindle_rpm into "
                                "[process] of a job"});
    }
    // The readers of programs warn of a missing feed themselves. Keyframes need none.
    const double feed = job.process.feed_mm_per_min;
    const auto* no_feed =
        first_feed_move(program, [&](const auto& move) { return move.feed_mm_per_min == feed; });
    if (no_feed != nullptr && job.path.kind == PathKind::keyframes && inputs.process.feed_mm_per_min == 0) {
        warnings.push_back({program.source, no_feed->line,
                            "keyframes without a feed run at " + format_decimal(feed) +
                                " mm/min, which is assumed; write --feed-mm-per-min, a column of that name, "
                                "or feed_mm_per_min into [process] of a job"});
    }
    if (inputs.material.empty()) {
        warnings.push_back({program.source, 0,
                            "no material is given: " + job.material.name +
                                " is assumed; write --material NAME, or [material] into a job"});
    }
}

}  // namespace tribo::job
