// SPDX-License-Identifier: MIT
#include "net/seats.hpp"

#include <algorithm>
#include <utility>

namespace tribo::net {

bool Seats::make_room(const std::string& address, Time now) {
    const auto of_address = [&](const auto& entry) { return entry.second.address == address; };
    const bool full_address = static_cast<std::size_t>(std::count_if(seats_.begin(), seats_.end(),
                                                                     of_address)) >= most_per_address_;
    if (!full_address && seats_.size() < most_) return true;
    auto longest = seats_.end();
    for (auto it = seats_.begin(); it != seats_.end(); ++it) {
        if (it->second.idle_from > now || (full_address && !of_address(*it))) continue;
        if (longest == seats_.end() || it->second.idle_from < longest->second.idle_from) longest = it;
    }
    if (longest == seats_.end()) return false;
    const auto dismiss = std::move(longest->second.dismiss);
    seats_.erase(longest);
    dismiss();
    return true;
}

Seats::Id Seats::take(const std::string& address, Time idle_from, std::function<void()> dismiss) {
    seats_[next_] = {address, idle_from, std::move(dismiss)};
    return next_++;
}

void Seats::set_idle_from(Id id, Time idle_from) {
    if (const auto found = seats_.find(id); found != seats_.end()) found->second.idle_from = idle_from;
}

}  // namespace tribo::net
