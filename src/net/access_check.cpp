// SPDX-License-Identifier: MIT
#include "net/access_check.hpp"

#include <algorithm>
#include <utility>

#include "net/addresses.hpp"
#include "net/secret.hpp"

namespace tribo::net {
namespace {

// More than the largest number of connections. The oldest are dropped first.
constexpr std::size_t kMostResumeTokens = 1000;

// "name", "name:port", "[::1]:port" without the port and without brackets.
std::string_view name_of(std::string_view host) {
    const std::size_t colon = host.rfind(':');
    if (colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos)
        host = host.substr(0, colon);
    if (host.size() >= 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    return host;
}

// The value of `name` in the query of a target, undecoded: tokens need no coding.
std::string_view query_value(std::string_view target, std::string_view name) {
    std::size_t at = target.find('?');
    while (at != std::string_view::npos) {
        const std::size_t end = target.find('&', at + 1);
        const std::string_view pair =
            target.substr(at + 1, end == std::string_view::npos ? end : end - at - 1);
        if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=')
            return pair.substr(name.size() + 1);
        at = end;
    }
    return {};
}

}  // namespace

AccessCheck::AccessCheck(AccessOptions options) : options_(std::move(options)) {
    for (std::string& name : options_.names) name = in_lower_case(name);
}

bool AccessCheck::is_own_name(std::string_view host, std::string_view local_address) const {
    const std::string name = in_lower_case(name_of(host));
    if (name.empty()) return false;
    // A numeric address cannot be rebound: it must be the address of this connection.
    if (name == "localhost" || name == local_address) return true;
    return std::find(options_.names.begin(), options_.names.end(), name) != options_.names.end();
}

std::expected<Admission, std::string> AccessCheck::admit(const Credentials& credentials, Time now) {
    if (!is_own_name(credentials.host, credentials.local_address))
        return std::unexpected("this server does not go by that name");
    // The origin of the page must be the host of the request.
    const std::string own = (options_.secure ? "https://" : "http://") + in_lower_case(credentials.host);
    if (in_lower_case(credentials.origin) != own) return std::unexpected("the page is not this server's");
    if (credentials.subprotocol != options_.subprotocol)
        return std::unexpected("the subprotocol is not " + options_.subprotocol);
    const std::string_view to_resume = query_value(credentials.target, "resume");
    if (!to_resume.empty()) return resume(to_resume, own, now);
    if (!same_secret(query_value(credentials.target, "token"), options_.token))
        return std::unexpected("the token is wrong");
    return Admission{};
}

std::expected<Admission, std::string> AccessCheck::resume(std::string_view token, std::string_view origin,
                                                          Time now) {
    drop_expired(now);
    // Compares with all tokens, so that the time does not depend on the position of a match.
    ResumeToken* found = nullptr;
    for (ResumeToken& one : resume_tokens_) {
        if (same_secret(one.token, token)) found = &one;
    }
    if (found == nullptr) return std::unexpected("the resume token is unknown or too old");
    // The token is now known to its sender. It becomes invalid even if this request is refused.
    if (std::exchange(found->used, true)) return std::unexpected("the resume token was used before");
    if (found->origin != origin) return std::unexpected("the resume token belongs to another origin");
    return Admission{true, found->client};
}

std::string AccessCheck::resume_token(ClientId client, std::string_view origin, Time now) {
    drop_expired(now);
    if (resume_tokens_.size() >= kMostResumeTokens) resume_tokens_.pop_front();
    resume_tokens_.push_back({random_token(), in_lower_case(origin), client, true, false, now});
    return resume_tokens_.back().token;
}

void AccessCheck::on_disconnect(ClientId client, Time now) {
    for (ResumeToken& one : resume_tokens_) {
        if (one.client != client || !one.connected) continue;
        one.connected = false;
        one.expires_at = now + kResumeTime;
    }
}

void AccessCheck::drop_expired(Time now) {
    std::erase_if(resume_tokens_,
                  [&](const ResumeToken& one) { return !one.connected && now >= one.expires_at; });
}

}  // namespace tribo::net
