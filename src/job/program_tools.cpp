// SPDX-License-Identifier: MIT
#include "job/program_tools.hpp"

#include <set>
#include <string>
#include <utility>

namespace tribo::job {

Result<std::vector<int>> called_tools(const motion::Program& program) {
    std::vector<int> tools;
    std::set<int> known;
    int last = -1;
    for (const motion::Move& move : program.moves) {
        if (std::exchange(last, move.tool) == move.tool) continue;
        if (move.tool == 0 || !known.insert(move.tool).second) continue;
        if (tools.size() == kMostTools) {
            return fail_at(program.source, move.line, 0,
                           "the program calls more than " + std::to_string(kMostTools) + " different tools",
                           "split it, or number tools of one kind alike");
        }
        tools.push_back(move.tool);
    }
    if (tools.empty() && !program.moves.empty()) tools.push_back(0);
    return tools;
}

DeclaredTools::DeclaredTools(const motion::Program& program) {
    for (const motion::DeclaredTool& tool : program.tools) {
        if (!(tool.diameter_mm > 0)) continue;
        if (first_ == nullptr) first_ = &tool;
        if (tool.number == 0 && !tool.table.empty() && for_all_ == nullptr) for_all_ = &tool;
        tools_.emplace(tool.number, &tool);
    }
}

const motion::DeclaredTool* DeclaredTools::find(int number) const {
    if (number == 0) return first_;
    const auto found = tools_.find(number);
    return found == tools_.end() ? for_all_ : found->second;
}

}  // namespace tribo::job
