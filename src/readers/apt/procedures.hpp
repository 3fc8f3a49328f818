// SPDX-License-Identifier: MIT
// Names of numbers and points, formulas, macros, loops, and copies of what was written before: statements
// that an APT processor would have worked out. They are unfolded before the reader runs them.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
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

    // Macros, copies and loops run no more than `most_statements`.
    Procedures(Report& report, std::size_t most_statements)
        : report_(report), most_statements_(most_statements) {}

    // A=5, A=B*2+SINF(30), P1=POINT/x,y[,z], M=MACRO/A,B=2 to TERMAC, CALL/M,A=1, INDEX/n,
    // COPY/n,TRANSL,x,y,z,times and COPY/n,XYROT,angle,times and COPY/n,SAME,times; between LOOPST and LOOPND
    // and in macros also LABEL) before a statement, JUMPTO/LABEL, IF L1,L2,L3 (negative, zero,
    // positive) and IF (A .LT. 5) with a statement behind it; everything else is run as it is, with names and
    // formulas replaced by their values.
    Result<void> take(const Statement& statement, double unit_mm, const Run& run);
    // Refuses a macro or a loop without its end.
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
    Result<bool> define(const Statement& statement);
    Result<void> begin_macro(const std::string& name, const Statement& statement);
    Result<void> call(const Statement& statement, double unit_mm, const Run& run);
    Result<void> copy(const Statement& statement, double unit_mm, const Run& run);
    Result<Frame> step_of(const Statement& statement, double unit_mm) const;
    // The statements of a macro or a loop, in the order of their jumps.
    Result<void> run_block(const std::vector<Statement>& statements, double unit_mm, const Run& run);
    // Where an IF leads: a label, or none if the next statement follows. An IF with a statement behind it
    // runs that, and gives its label if it jumps.
    Result<std::string> run_if(const Statement& statement, double unit_mm, const Run& run);
    Result<std::string> run_in_block(const Statement& statement, double unit_mm, const Run& run);
    std::optional<double> value(std::string_view formula) const;
    Statement replaced(const Statement& statement);
    std::string_view kept(std::string text);
    std::unexpected<Error> refuse_more_statements(const Item& at) const;

    Report& report_;
    std::size_t most_statements_;
    Names names_;
    std::map<std::string, Macro> macros_;
    std::string defining_;         // the macro that is being defined; empty: none
    std::vector<Statement> loop_;  // since LOOPST
    Item loop_at_;                 // the first LOOPST without its LOOPND
    int loops_ = 0;                // how many there are
    bool in_block_ = false;        // a macro or a loop runs
    std::map<int, std::size_t> indices_;
    std::deque<Statement> written_;   // since the first INDEX, without what copies repeat
    std::vector<Recorded> recorded_;  // the same with what copies repeat
    std::deque<std::string> texts_;   // that replaced names
    std::size_t count_ = 0;           // of the statements that macros, copies and loops ran
    int depth_ = 0;
};

}  // namespace tribo::readers::apt
