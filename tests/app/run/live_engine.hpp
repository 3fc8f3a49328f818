// SPDX-License-Identifier: MIT
// `tribo live` with a job of its own, for soaks.
#pragma once

#include <csignal>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "app/run/program.hpp"

namespace tribo::test {

// Mills a plate in zigzag, 45 s of program.
class LiveEngine {
  public:
    LiveEngine() {
        scratch_.put("job.toml",
                     "[stock]\nbox_mm = [[0,0,-5],[40,30,0]]\n[cutter]\nkind = \"ball\"\ndiameter_mm = 6\n"
                     "flutes = 2\nhelix_deg = 30\nlength_mm = 15\n[material]\nname = \"al7075-t6\"\n"
                     "[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 1200\n[path]\ngcode = \"p.nc\"\n");
        scratch_.put("p.nc", zigzag());
        scratch_.put("index.html", "<p>page");
        engine_.emplace(std::vector<std::string>{"live", "job.toml", "--resolution", "0.5", "--port", "0",
                                                 "--web-root", "."},
                        scratch_.path());
        const std::string out = engine_->out_with("Ctrl-C");
        port_ = static_cast<std::uint16_t>(std::stoi(out.substr(out.find("127.0.0.1:") + 10)));
    }
    std::uint16_t port() const { return port_; }
    double resident_mb() const {
        std::ifstream status("/proc/" + std::to_string(engine_->pid()) + "/status");
        for (std::string line; std::getline(status, line);) {
            if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
        }
        return 0;
    }
    Outcome stop(int signal) { return engine_->stop(signal); }

  private:
    static std::string zigzag() {
        std::string text = "G21 G90\nG0 X-5 Y0 Z2\nG1 Z-1\n";
        for (int n = 0; n <= 15; ++n) {
            text += std::string("G1 X") + (n % 2 == 0 ? "45" : "-5") + " Y" + std::to_string(2 * n) +
                    "\nG1 Y" + std::to_string(2 * n + 2) + "\n";
        }
        return text;
    }

    Scratch scratch_;
    std::optional<RunningTribo> engine_;
    std::uint16_t port_ = 0;
};

}  // namespace tribo::test
