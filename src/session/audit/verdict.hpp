// SPDX-License-Identifier: MIT
// From the loads of a run to one sentence: will it live? Where the band of a load spans its limit there is no
// verdict, and the sentence says so.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/audit/auditor.hpp"
#include "session/chatter/program_chatter.hpp"

namespace tribo::session {

enum class Outcome { nothing_cut, within, undecided, over };
// "nothing cut", "within", "undecided", "over".
std::string_view name_of(Outcome outcome);

// Which side of the limit the whole band is on.
Outcome outcome_of(const RatioBand& ratio);

// What is, or may be, over a limit.
struct Finding {
    Outcome outcome = Outcome::over;
    std::string text;  // a clause that begins with the place
    int line = 0;      // 0: none
    std::optional<RatioBand> ratio;
};

struct Verdict {
    Outcome outcome = Outcome::within;
    std::string sentence;
    std::vector<Finding> findings;  // the worst first
};

// What is known besides the loads.
struct AuditFacts {
    std::optional<double> chatter_probability{};  // of the worst row; absent: the modes are exact
    // Of the finished part, where they are known, mm.
    std::optional<double> gouge_mm{}, left_mm{}, overcut_mm{};  // the last two by bending
    int gouge_line = 0, left_line = 0, overcut_line = 0;
};

// The run of the model's setup is finished.
Verdict verdict(const Audit& audit, const LoadModel& model, const MillSession& session,
                const AuditFacts& facts);

// "0.42", or "0.42 to 0.9" where the ends of the band differ.
std::string in_words(const RatioBand& ratio);

}  // namespace tribo::session
