// SPDX-License-Identifier: MIT
// What `tribo render` does once its flags are read: files in, a session, files out.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

namespace tribo::app {

struct RenderCall {
    std::string job, out;
    std::optional<double> resolution_mm, until_s;
    int sample_rate_hz = 48000;
    std::set<std::string> only;  // of summary, forces, sound, mesh, report; empty: all
    std::optional<double> memory_mb;
    bool as_published = false;
    int threads = 0;  // 0: as many as there are

    bool wants(const std::string& output) const { return only.empty() || only.contains(output); }
};

// The exit code. Says on stderr what is wrong; prints the summary and where the files are on stdout.
int render(const RenderCall& call);

}  // namespace tribo::app
