// SPDX-License-Identifier: MIT
#include "harness.hpp"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace tribo::bench {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}

}  // namespace

double wall_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double thread_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double memory_s_per_mb() {
    constexpr std::size_t kBytes = 64 << 20;
    std::vector<char> from(kBytes, 1), to(kBytes, 2);
    return median_of(5, [&] {
        const double start = thread_s();
        std::memcpy(to.data(), from.data(), kBytes);
        keep(to);
        return (thread_s() - start) / (2e-6 * kBytes);
    });
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

std::optional<double> Entry::ratio() const {
    if (!peer_value || !(value > 0) || !(*peer_value > 0)) return {};
    return better == Better::lower ? *peer_value / value : value / *peer_value;
}

bool Entry::met() const {
    return !goal || (better == Better::lower ? value <= *goal : value >= *goal);
}

void Report::section(const std::string& title) {
    std::printf("\n%s\n", title.c_str());
}

void Report::note(const std::string& text) {
    std::printf("  %s\n", text.c_str());
}

void Report::add(Entry entry) {
    std::printf("  %-66s %10.4g %-8s", entry.name.c_str(), entry.value, entry.unit.c_str());
    if (entry.goal) {
        std::printf("  goal %s %-6g %s", entry.better == Better::lower ? "<=" : ">=", *entry.goal,
                    entry.met() ? "met   " : "MISSED");
    }
    if (entry.peer_value) std::printf("  %s %.4g", entry.peer.c_str(), *entry.peer_value);
    if (const auto ratio = entry.ratio()) std::printf(" (%.3g times)", *ratio);
    std::printf("\n");
    std::fflush(stdout);
    entries_.push_back(std::move(entry));
}

std::string Report::json() const {
    std::string text = "[\n";
    for (std::size_t n = 0; n < entries_.size(); ++n) {
        const Entry& e = entries_[n];
        text += R"(  {"name": ")" + e.name + R"(", "value": )" + number(e.value) + R"(, "unit": ")" + e.unit +
                R"(", "better": ")" + (e.better == Better::lower ? "lower" : "higher") + '"';
        if (e.goal) text += R"(, "goal": )" + number(*e.goal);
        if (!e.peer.empty()) text += R"(, "peer": ")" + e.peer + '"';
        if (e.peer_value) text += R"(, "peer_value": )" + number(*e.peer_value);
        if (const auto ratio = e.ratio()) text += R"(, "ratio": )" + number(*ratio);
        text += n + 1 < entries_.size() ? "},\n" : "}\n";
    }
    return text + "]\n";
}

}  // namespace tribo::bench
