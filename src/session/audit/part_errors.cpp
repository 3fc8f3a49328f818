// SPDX-License-Identifier: MIT
#include "session/audit/part_errors.hpp"

#include <algorithm>
#include <map>

namespace tribo::session {
namespace {

void take_larger(PartErrors::Largest& largest, const PartErrors::Largest& other) {
    largest.gouge_mm = std::max(largest.gouge_mm, other.gouge_mm);
    largest.scallop_mm = std::max(largest.scallop_mm, other.scallop_mm);
}

}  // namespace

PartErrors::PartErrors(const MillSession& session, const surface::DeviationReport& deviation) {
    std::map<std::size_t, Largest> of_move;
    const auto add = [&](Vec3 machined_mm, const Largest& error) {
        const auto move = session.move_at(machined_mm);
        if (move) take_larger(of_move[*move], error);
        return move;
    };
    double deepest = 0;
    for (const surface::GougedPoint& gouged : deviation.gouges) {
        const auto move = add(gouged.machined_mm, {gouged.mm, 0});
        if (gouged.mm < deepest) continue;
        deepest = gouged.mm;
        gouge_line_ = move ? session.setup().moves[*move].line : 0;
    }
    for (const surface::Crest& crest : deviation.crests) {
        for (const Vec3 place : crest.machined_mm) add(place, {0, crest.height_mm});
    }
    const MillSetup& setup = session.setup();
    std::map<int, double> of_line;
    moves_.reserve(of_move.size());
    for (const auto& [move, largest] : of_move) {
        moves_.push_back({session.schedule().moves[move].start_s, setup.cutter_of_move[move], largest});
        double& gouge_mm = of_line[setup.moves[move].line];
        gouge_mm = std::max(gouge_mm, largest.gouge_mm);
    }
    for (const auto& [line, mm] : of_line) {
        if (mm > 0) gouges_.push_back({line, mm});
    }
    std::ranges::sort(
        gouges_, [](const Gouge& a, const Gouge& b) { return a.mm != b.mm ? a.mm > b.mm : a.line < b.line; });
    if (gouges_.size() > kWorstLines) gouges_.resize(kWorstLines);
}

PartErrors::Largest PartErrors::between(double from_s, double to_s) const {
    Largest all;
    for (auto at = std::ranges::lower_bound(moves_, from_s, {}, &OfMove::start_s);
         at != moves_.end() && at->start_s < to_s; ++at)
        take_larger(all, at->largest);
    return all;
}

void PartErrors::describe(Audit& audit) const {
    for (LoadTally& tool : audit.tools) {
        Largest all;
        for (const OfMove& move : moves_) {
            if (move.cutter == tool.cutter) take_larger(all, move.largest);
        }
        tool.gouge_mm = all.gouge_mm;
        tool.scallop_mm = all.scallop_mm;
    }
    for (LoadTally& line : audit.worst) {
        const Largest of_line = between(line.start_s, line.end_s);
        line.gouge_mm = of_line.gouge_mm;
        line.scallop_mm = of_line.scallop_mm;
    }
}

}  // namespace tribo::session
