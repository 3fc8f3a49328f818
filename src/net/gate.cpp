// SPDX-License-Identifier: MIT
#include "net/gate.hpp"

#include <algorithm>
#include <utility>

#include "net/addresses.hpp"
#include "net/secret.hpp"

namespace tribo::net {
namespace {

// More than the connections that there can be; the oldest go first.
constexpr std::size_t kMostResumes = 1000;

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

Gate::Gate(GateOptions options) : options_(std::move(options)) {
    for (std::string& name : options_.names) name = in_lower_case(name);
}

bool Gate::goes_by(std::string_view host, std::string_view asked_address) const {
    const std::string name = in_lower_case(name_of(host));
    if (name.empty()) return false;
    // An address in digits cannot be rebound: it means the one that was asked, or not this server.
    if (name == "localhost" || name == asked_address) return true;
    return std::find(options_.names.begin(), options_.names.end(), name) != options_.names.end();
}

std::expected<Admission, std::string> Gate::admit(const Knock& knock, Time now) {
    if (!goes_by(knock.host, knock.asked_address))
        return std::unexpected("this server does not go by that name");
    // A page's origin must be the very host that it asks.
    const std::string own = (options_.secure ? "https://" : "http://") + in_lower_case(knock.host);
    if (in_lower_case(knock.origin) != own) return std::unexpected("the page is not this server's");
    if (knock.subprotocol != options_.subprotocol)
        return std::unexpected("the subprotocol is not " + options_.subprotocol);
    const std::string_view to_resume = query_value(knock.target, "resume");
    if (!to_resume.empty()) return resume(to_resume, own, now);
    if (!same_secret(query_value(knock.target, "token"), options_.token))
        return std::unexpected("the token is wrong");
    return Admission{};
}

std::expected<Admission, std::string> Gate::resume(std::string_view token, std::string_view origin,
                                                   Time now) {
    forget_old(now);
    // All are looked at, whichever is right.
    Resume* found = nullptr;
    for (Resume& one : resumes_) {
        if (same_secret(one.token, token)) found = &one;
    }
    if (found == nullptr) return std::unexpected("the resume token is unknown or too old");
    // Whoever brings it has it: it is good for nobody any more, whatever comes of this.
    if (std::exchange(found->used, true)) return std::unexpected("the resume token was used before");
    if (found->origin != origin) return std::unexpected("the resume token belongs to another origin");
    return Admission{true, found->client};
}

std::string Gate::resume_token(ClientId client, std::string_view origin, Time now) {
    forget_old(now);
    if (resumes_.size() >= kMostResumes) resumes_.pop_front();
    resumes_.push_back({random_token(), in_lower_case(origin), client, true, false, now});
    return resumes_.back().token;
}

void Gate::left(ClientId client, Time now) {
    for (Resume& one : resumes_) {
        if (one.client != client || !one.here) continue;
        one.here = false;
        one.good_until = now + kResumeTime;
    }
}

void Gate::forget_old(Time now) {
    std::erase_if(resumes_, [&](const Resume& one) { return !one.here && now >= one.good_until; });
}

}  // namespace tribo::net
