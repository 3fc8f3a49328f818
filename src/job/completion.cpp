// SPDX-License-Identifier: MIT
#include "job/completion.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "base/text/decimal.hpp"
#include "job/program_tools.hpp"
#include "job/solid.hpp"
#include "job/words/tool_words.hpp"
#include "milling/tool/cutter_shape.hpp"

namespace tribo::job {
namespace {

// A tool of a kind with a profile.
Result<milling::Cutter> shaped_cutter(const motion::DeclaredTool& tool, milling::Cutter cutter) {
    const auto& words = milling::kCutterKindWords;
    const auto word = std::find(words.begin(), words.end(), tool.kind);
    if (word == words.end())
        return fail("it is a " + tool.kind + ", which is no kind of cutter",
                    "describe it as a [[cutter]] of the job");
    cutter.kind = static_cast<milling::CutterKind>(word - words.begin());
    const std::array sizes{tool.corner_mm, tool.tip_mm,    tool.point_deg, tool.taper_deg,
                           tool.side_mm,   tool.height_mm, tool.neck_mm};  // in the order of kShapeKeys
    static_assert(sizes.size() == milling::kShapeKeys.size());
    for (std::size_t n = 0; n < sizes.size(); ++n) {
        const milling::ShapeKey& key = milling::kShapeKeys[n];
        if (milling::is_shape_key(cutter.kind, key.name)) cutter.*key.value = sizes[n];
    }
    cutter.helix_deg = milling::usual_helix_deg(cutter.kind);
    cutter.length_mm = tool.edge_mm;
    if (auto made = milling::make_profile(cutter); !made) return std::unexpected(made.error());
    return cutter;
}

// The shank and the holder that a library gives, where they fit the edges.
void add_holder(const motion::DeclaredTool& tool, milling::Cutter& cutter) {
    if (tool.shank_mm > 0) cutter.shank_mm = tool.shank_mm;
    if (!(tool.stickout_mm > 0)) return;
    if (!(tool.edge_mm > 0) && !milling::has_own_length(cutter.kind))
        cutter.length_mm = std::max(std::min(cutter.length_mm, tool.stickout_mm), cutter.corner_radius_mm());
    if (tool.stickout_mm < cutter.length_mm) return;
    cutter.stickout_mm = tool.stickout_mm;
    for (const motion::DeclaredStep& step : tool.holder)
        cutter.holder.push_back({step.diameter_mm, step.length_mm});
}

Result<milling::Cutter> cutter_of(const motion::DeclaredTool& tool, int number) {
    milling::Cutter cutter;
    cutter.number = number;
    cutter.diameter_mm = tool.diameter_mm;
    if (tool.flutes > 0) cutter.flutes = tool.flutes;
    if (!tool.kind.empty()) return shaped_cutter(tool, std::move(cutter));
    if (2 * tool.corner_mm >= tool.diameter_mm) {
        cutter.kind = milling::CutterKind::ball;
    } else if (tool.corner_mm > 0) {
        cutter.kind = milling::CutterKind::bull;
        cutter.corner_mm = tool.corner_mm;
    }
    cutter.length_mm =
        std::max(tool.edge_mm > 0 ? tool.edge_mm : cutter.length_mm, cutter.corner_radius_mm());
    return cutter;
}

std::string description(const milling::Cutter& cutter, const motion::DeclaredTool& tool) {
    std::string text = std::string(kCutterKindWords[static_cast<std::size_t>(cutter.kind)]) + " D" +
                       format_decimal(cutter.diameter_mm) + shape_words(cutter);
    if (cutter.stickout_mm > 0) text += " stick-out " + format_decimal(cutter.stickout_mm);
    if (!cutter.holder.empty()) text += " in a holder of " + std::to_string(cutter.holder.size()) + " steps";
    text += tool.flutes > 0 ? ", " + std::to_string(cutter.flutes) + " flutes; " : "; ";
    if (tool.flutes == 0) text += std::to_string(cutter.flutes) + " flutes, ";
    const bool has_length = tool.edge_mm > 0 || milling::has_own_length(cutter.kind);
    text += "helix " + format_decimal(cutter.helix_deg) + " deg";
    if (!has_length) text += " and " + format_decimal(cutter.length_mm) + " mm of edge";
    return text + (has_length && tool.flutes > 0 ? " is" : " are") + " assumed; write --tool \"" +
           tool_words(cutter) + "\", or a [[cutter]] into a job, to say otherwise";
}

Result<void> add_cutter(Job& job, const motion::Program& program, const DeclaredTools& declared, int number,
                        Warnings& warnings) {
    const bool described = std::any_of(job.cutters.begin(), job.cutters.end(),
                                       [&](const milling::Cutter& c) { return c.number == number; });
    const motion::DeclaredTool* tool = described ? nullptr : declared.find(number);
    if (tool == nullptr) return {};
    auto made = cutter_of(*tool, number);
    if (made) add_holder(*tool, *made);
    const std::string name = number > 0 ? "tool T" + std::to_string(number) : "the tool";
    const bool from_table = !tool->table.empty();
    const std::string& source = from_table ? tool->table : program.source;
    const Result<void> good = made ? milling::check(*made) : std::unexpected(made.error());
    if (!good) return fail_at(source, tool->line, 0, name + ": " + good.error().cause, good.error().remedy);
    const milling::Cutter& cutter = *made;
    warnings.push_back({source, tool->line,
                        name + " is taken from the " + (from_table ? "tool table" : "program") + ": " +
                            description(cutter, *tool)});
    job.cutters.push_back(cutter);
    return {};
}

}  // namespace

Result<void> take_declared_stock(Job& job, const motion::Program& program, Warnings& warnings) {
    if (job.has_stock() || !program.stock) return {};
    job.stock.box_mm = program.stock->box_mm;
    if (const auto room = check_room(job.stock.box_mm); !room) {
        return fail_at(program.source, program.stock->line, 0, room.error().cause, room.error().remedy);
    }
    warnings.push_back(
        {program.source, program.stock->line,
         std::string("the stock is taken from the program (") +
             (program.dialect == name_of(readers::Dialect::siemens) ? "WORKPIECE)" : "BLK FORM)")});
    return {};
}

Result<void> take_declared_tools(Job& job, const motion::Program& program, Warnings& warnings) {
    const bool one_for_all = job.cutters.size() == 1 && job.cutters[0].number == 0;
    if (one_for_all) return {};
    const auto tools = called_tools(program);
    if (!tools) return std::unexpected(tools.error());
    const DeclaredTools declared(program);
    for (const int tool : *tools) {
        if (auto done = add_cutter(job, program, declared, tool, warnings); !done) return done;
    }
    return {};
}

Result<void> complete_job(Job& job, const motion::Program& program, Warnings& warnings) {
    if (auto done = take_declared_stock(job, program, warnings); !done) return done;
    if (!job.has_stock()) {
        return fail_at(job.file, 0, 0, "the job has no [stock], and the program declares none",
                       "add [stock] with box_mm or mesh");
    }
    if (auto done = take_declared_tools(job, program, warnings); !done) return done;
    if (!job.cutters.empty()) return {};
    return fail_at(job.file, 0, 0,
                   "the job has no [cutter], and neither tool table nor program describes a tool",
                   "add [cutter] with kind and diameter_mm");
}

}  // namespace tribo::job
