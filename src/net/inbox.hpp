// SPDX-License-Identifier: MIT
// Queue from the thread of a server to the thread that answers. Of each client only so much may wait: the
// queue stays small whatever the clients do. Any thread.
#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "net/server.hpp"

namespace tribo::net {

class Inbox {
  public:
    // What may wait of one client. One that sends more is disconnected (ServerHandlers::on_message).
    static constexpr std::size_t kMostMessages = 1000, kMostBytes = 1'000'000;

    struct Event {
        enum class Kind { connected, overflowed, message, disconnected } kind;
        ClientId client;
        std::string text = {};   // of a message
        ResumeInfo resume = {};  // of `connected`
    };
    // Sets the handlers that put events here. The inbox must outlive the server.
    void attach(ServerHandlers& handlers);
    // `disconnected` also removes what waits of the client.
    Taken put(const Event& event);
    // Returns all events since the last call, in their order.
    std::deque<Event> take_all();

  private:
    struct Waiting {
        std::size_t messages = 0, bytes = 0;
    };
    std::mutex mutex_;
    std::deque<Event> events_;
    std::map<ClientId, Waiting> waiting_;
};

}  // namespace tribo::net
