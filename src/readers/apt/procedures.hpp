// SPDX-License-Identifier: MIT
// Names of numbers and points, macros, and copies of what was written before: statements that an APT
// processor would have worked out. They are unfolded before the reader runs them.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "readers/apt/frames.hpp"
#include "readers/apt/lexer.hpp"
#include "readers/apt/report.hpp"

namespace tribo::readers::apt {

class Procedures {
  public:
    // Runs one plain statement in the copy of the program at `frame`.
    using Run = std::function<Result<void>(const Statement& statement, const Frame& frame)>;

    // Macros and copies that run more than `most_statements` are refused.
    Procedures(Report& report, std::size_t most_statements)
        : report_(report), most_statements_(most_statements) {}

    // A=5, P1=POINT/x,y[,z], M=MACRO/A,B=2 to TERMAC, CALL/M,A=1, INDEX/n, COPY/n,TRANSL,x,y,z,times and
    // COPY/n,XYROT,angle,times and COPY/n,SAME,times; everything else is run as it is, with names replaced.
    Result<void> take(const Statement& statement, double unit_mm, const Run& run);
    // Refuses a macro without its end.
    Result<void> finish() const;

  private:
    struct Macro {
        std::vector<std::string> names;
        std::map<std::string, std::string> values;  // that the definition gives
        std::vector<Statement> statements;
        Item at;
    };
    struct Recorded {
        const Statement* statement;  // of written_
        Frame frame;
    };
    using Names = std::map<std::string, std::vector<std::string>>;  // a number, or the three of a point

    Result<void> run_one(const Statement& statement, const Run& run);
    Result<void> record(const Recorded& recorded);
    std::unexpected<Error> refuse_endless(const Item& at) const;
    Result<bool> define(const Statement& statement);
    Result<void> begin_macro(const std::string& name, const Statement& statement);
    Result<void> call(const Statement& statement, double unit_mm, const Run& run);
    Result<void> copy(const Statement& statement, double unit_mm, const Run& run);
    Result<Frame> step_of(const Statement& statement, double unit_mm) const;
    Statement replaced(const Statement& statement);
    std::string_view kept(std::string text);

    Report& report_;
    std::size_t most_statements_;
    Names names_;
    std::map<std::string, Macro> macros_;
    std::string defining_;  // the macro that is being defined; empty: none
    std::map<int, std::size_t> indices_;
    std::deque<Statement> written_;   // since the first INDEX, without what copies repeat
    std::vector<Recorded> recorded_;  // the same with what copies repeat
    std::deque<std::string> texts_;   // that replaced names
    std::size_t count_ = 0;           // of the statements that macros and copies ran
    int depth_ = 0;
};

}  // namespace tribo::readers::apt
