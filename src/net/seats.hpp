// SPDX-License-Identifier: MIT
// The connections that are open, and who leaves when there are too many: the one that has been idle for the
// longest time, of all or of its address. Uses no sockets and no clock. One thread at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace tribo::net {

class Seats {
  public:
    using Time = std::chrono::steady_clock::time_point;
    using Id = std::uint64_t;

    // At most `most` at once, `most_per_address` of one address.
    Seats(std::size_t most, std::size_t most_per_address)
        : most_(most), most_per_address_(most_per_address) {}

    // Makes room for one more of this address. If that needs it, the longest idle one is removed and its
    // `dismiss` is called. False: there is no room, and nobody is idle.
    bool make_room(const std::string& address, Time now);
    // Takes a seat, which counts as idle from `idle_from` on.
    Id take(const std::string& address, Time idle_from, std::function<void()> dismiss);
    void set_idle_from(Id id, Time idle_from);
    // Unknown ids are ignored: the seat was given to another.
    void leave(Id id) { seats_.erase(id); }
    std::size_t taken() const { return seats_.size(); }

  private:
    struct Seat {
        std::string address;
        Time idle_from;
        std::function<void()> dismiss;
    };
    std::size_t most_, most_per_address_;
    std::map<Id, Seat> seats_;
    Id next_ = 1;
};

}  // namespace tribo::net
