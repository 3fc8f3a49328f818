// SPDX-License-Identifier: MIT
// The tools that a program calls, and those that it or its tool table declares.
#pragma once

#include <map>
#include <vector>

#include "base/result.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// Largest number of different tools of a program: a magazine holds a few hundred.
inline constexpr std::size_t kMostTools = 1000;

// Returns the numbers of the tools in the order of their first moves. Moves before the first tool call count
// only if no tool is called at all: the number is then 0. Refuses more than kMostTools.
Result<std::vector<int>> called_tools(const motion::Program& program);

// Finds declared tools by number. The program must outlive the object.
class DeclaredTools {
  public:
    explicit DeclaredTools(const motion::Program& program);

    // Returns the first declared tool with a diameter, of any number for 0; null if there is none. Tables
    // stand before what the program says itself. The tool of a table without numbers stands for every number.
    const motion::DeclaredTool* find(int number) const;

  private:
    std::map<int, const motion::DeclaredTool*> tools_;
    const motion::DeclaredTool *first_ = nullptr, *for_all_ = nullptr;
};

}  // namespace tribo::job
