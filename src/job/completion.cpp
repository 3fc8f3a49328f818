// SPDX-License-Identifier: MIT
#include "job/completion.hpp"

#include <algorithm>
#include <string>

#include "base/text/decimal.hpp"
#include "job/program_tools.hpp"
#include "job/solid.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::job {
namespace {

milling::Cutter cutter_of(const motion::DeclaredTool& tool, int number) {
    milling::Cutter cutter;
    cutter.number = number;
    cutter.diameter_mm = tool.diameter_mm;
    if (tool.flutes > 0) cutter.flutes = tool.flutes;
    if (2 * tool.corner_mm >= tool.diameter_mm) {
        cutter.kind = milling::CutterKind::ball;
    } else if (tool.corner_mm > 0) {
        cutter.kind = milling::CutterKind::bull;
        cutter.corner_mm = tool.corner_mm;
    }
    cutter.length_mm = std::max(cutter.length_mm, cutter.corner_radius_mm());
    return cutter;
}

std::string description(const milling::Cutter& cutter, const motion::DeclaredTool& tool) {
    std::string text = std::string(kCutterKindWords[static_cast<std::size_t>(cutter.kind)]) + " D" +
                       format_decimal(cutter.diameter_mm);
    if (cutter.kind == milling::CutterKind::bull) text += " corner " + format_decimal(cutter.corner_mm);
    text += tool.flutes > 0 ? ", " + std::to_string(cutter.flutes) + " flutes; " : "; ";
    if (tool.flutes == 0) text += std::to_string(cutter.flutes) + " flutes, ";
    return text + "helix " + format_decimal(cutter.helix_deg) + " deg and " +
           format_decimal(cutter.length_mm) + " mm of edge are assumed; write --tool \"" +
           tool_words(cutter) + "\", or a [[cutter]] into a job, to say otherwise";
}

Result<void> add_cutter(Job& job, const motion::Program& program, const DeclaredTools& declared, int number,
                        Warnings& warnings) {
    const bool described = std::any_of(job.cutters.begin(), job.cutters.end(),
                                       [&](const milling::Cutter& c) { return c.number == number; });
    const motion::DeclaredTool* tool = described ? nullptr : declared.find(number);
    if (tool == nullptr) return {};
    const milling::Cutter cutter = cutter_of(*tool, number);
    const std::string name = number > 0 ? "tool T" + std::to_string(number) : "the tool";
    const bool from_table = !tool->table.empty();
    const std::string& source = from_table ? tool->table : program.source;
    if (const auto good = milling::check(cutter); !good)
        return fail_at(source, tool->line, 0, name + ": " + good.error().cause, good.error().remedy);
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
        {program.source, program.stock->line, "the stock is taken from the program (BLK FORM)"});
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
