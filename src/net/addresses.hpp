// SPDX-License-Identifier: MIT
// What this machine is called by others, and what addresses mean.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo::net {

// An IPv4 or IPv6 address in digits, without brackets or a port.
bool is_address(const std::string& text);
// Nobody but this machine reaches it: 127.0.0.0/8, ::1.
bool is_loopback(const std::string& address);
// All addresses of this machine at once: 0.0.0.0, ::.
bool is_every_address(const std::string& address);
// As it stands in a URL and in Host: IPv6 in brackets.
std::string in_url(const std::string& address);

// Addresses under which other machines may reach this one; none without a network. Those of one link only
// (fe80::) are left out, for browsers take none with a zone.
std::vector<std::string> own_addresses();
// As the system says, in lower case; empty where it has none.
std::string host_name();

// ASCII letters small: names of hosts and schemes do not tell the difference (RFC 3986, 3.2.2).
std::string in_lower_case(std::string_view text);

}  // namespace tribo::net
