// SPDX-License-Identifier: MIT
#include "session/live/force_look_ahead.hpp"

#include "session/feel/feel_session.hpp"
#include "session/live/live_force_source.hpp"

namespace tribo::session {

ForceLookAhead::ForceLookAhead(MillSetup setup, ParallelFor parallel)
    : parallel_(std::move(parallel)), session_(std::move(setup), parallel_) {}

bool ForceLookAhead::run(const std::function<bool()>& has_time) {
    MillSinks sinks;
    sinks.row = [this](const milling::CutRow& row, const milling::RowForce&) { record_.add(row); };
    sinks.progress = [&](double) { return has_time(); };
    return session_.run(sinks);
}

contact::ForceTable ForceLookAhead::table(const CutChange& change,
                                          const contact::ForceTableOptions& options) const {
    auto stretches = force_stretches(record_, session_.setup(), change, parallel_);
    to_program_time(stretches, change.feed_factor);
    return contact::build_force_table(contact::force_function(stretches, options), options);
}

haptics::TextureMap ForceLookAhead::textures() const {
    return texture_map(record_.rows(), session_.stock(), parallel_);
}

}  // namespace tribo::session
