// SPDX-License-Identifier: MIT
#include "net/inbox.hpp"

#include <utility>

namespace tribo::net {

void Inbox::attach(ServerHandlers& handlers) {
    using Kind = Event::Kind;
    handlers.on_connect = [this](ClientId id, const ResumeInfo& resume) {
        put({Kind::connected, id, {}, resume});
    };
    handlers.on_disconnect = [this](ClientId id) { put({Kind::disconnected, id}); };
    handlers.on_overflow = [this](ClientId id) { put({Kind::overflowed, id}); };
    handlers.on_message = [this](ClientId id, std::string_view text) {
        return put({Kind::message, id, std::string(text)});
    };
}

Taken Inbox::put(const Event& event) {
    const std::lock_guard lock(mutex_);
    if (event.kind == Event::Kind::disconnected) {
        std::erase_if(events_, [&](const Event& e) { return e.client == event.client; });
        waiting_.erase(event.client);
    }
    if (event.kind == Event::Kind::message) {
        Waiting& waiting = waiting_[event.client];
        if (waiting.messages == kMostMessages) return Taken::too_many;
        if (waiting.bytes + event.text.size() > kMostBytes) return Taken::too_much;
        ++waiting.messages;
        waiting.bytes += event.text.size();
    }
    events_.push_back(event);
    return Taken::yes;
}

std::deque<Inbox::Event> Inbox::take_all() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    return std::exchange(events_, {});
}

}  // namespace tribo::net
