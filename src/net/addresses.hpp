// SPDX-License-Identifier: MIT
// Names and addresses of this machine, and tests of addresses.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo::net {

// Whether the text is a numeric IPv4 or IPv6 address, without brackets or port.
bool is_address(const std::string& text);
// Whether only this machine reaches the address: 127.0.0.0/8, ::1.
bool is_loopback(const std::string& address);
// Whether the address means all addresses of this machine: 0.0.0.0, ::.
bool is_every_address(const std::string& address);
// The address as written in a URL and in a Host header: IPv6 in brackets.
std::string in_url(const std::string& address);

// Addresses at which other machines can reach this one; empty without a network. Link-local addresses
// (fe80::) are left out: browsers refuse addresses with a zone.
std::vector<std::string> own_addresses();
// The host name of the system, in lower case; may be empty.
std::string host_name();

// ASCII letters in lower case: host names and schemes are case-insensitive (RFC 3986, 3.2.2).
std::string in_lower_case(std::string_view text);

}  // namespace tribo::net
