// SPDX-License-Identifier: MIT
#include "net/addresses.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <ifaddrs.h>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <optional>
#include <unistd.h>

namespace tribo::net {
namespace {

std::optional<in_addr> v4(const std::string& text) {
    in_addr address{};
    if (::inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
    return address;
}

std::optional<in6_addr> v6(const std::string& text) {
    in6_addr address{};
    if (::inet_pton(AF_INET6, text.c_str(), &address) != 1) return std::nullopt;
    return address;
}

}  // namespace

bool is_address(const std::string& text) {
    return v4(text) || v6(text);
}

bool is_loopback(const std::string& address) {
    if (const auto four = v4(address)) return ntohl(four->s_addr) >> 24 == 127;
    const auto six = v6(address);
    return six && IN6_IS_ADDR_LOOPBACK(&*six);
}

bool is_every_address(const std::string& address) {
    if (const auto four = v4(address)) return four->s_addr == INADDR_ANY;
    const auto six = v6(address);
    return six && IN6_IS_ADDR_UNSPECIFIED(&*six);
}

std::string in_url(const std::string& address) {
    return v6(address) ? "[" + address + "]" : address;
}

std::vector<std::string> own_addresses() {
    std::vector<std::string> found;
    ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0) return found;
    const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> list(first, &::freeifaddrs);
    for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
        if (one->ifa_addr == nullptr || (one->ifa_flags & IFF_UP) == 0 ||
            (one->ifa_flags & IFF_LOOPBACK) != 0)
            continue;
        std::array<char, INET6_ADDRSTRLEN> text{};
        if (one->ifa_addr->sa_family == AF_INET) {
            const auto* four = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
            ::inet_ntop(AF_INET, &four->sin_addr, text.data(), text.size());
        } else if (one->ifa_addr->sa_family == AF_INET6) {
            const auto* six = reinterpret_cast<const sockaddr_in6*>(one->ifa_addr);
            if (IN6_IS_ADDR_LINKLOCAL(&six->sin6_addr)) continue;
            ::inet_ntop(AF_INET6, &six->sin6_addr, text.data(), text.size());
        } else {
            continue;
        }
        if (std::find(found.begin(), found.end(), text.data()) == found.end())
            found.emplace_back(text.data());
    }
    return found;
}

std::string host_name() {
    std::array<char, 256> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return {};
    return in_lower_case(name.data());
}

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

}  // namespace tribo::net
