// SPDX-License-Identifier: MIT
// A folder with a job file and what it names, rendered by the built program, and its results as numbers.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/run/program.hpp"

namespace tribo::test {

// A CSV file: the columns by their names, one number a row each.
using ForceColumns = std::map<std::string, std::vector<double>>;

class JobFolder {
  public:
    void put(const std::string& name, const std::string& text) const { scratch_.put(name, text); }
    // Renders `job.toml` into `out`; `more` are further arguments.
    Outcome render(const std::vector<std::string>& more = {}) const;
    std::string get(const std::string& name) const { return scratch_.get("out/" + name); }
    std::string file(const std::string& name) const { return scratch_.get(name); }
    ForceColumns forces() const { return columns("forces.csv"); }
    ForceColumns columns(const std::string& name) const;  // of a file in `out`
    nlohmann::json summary() const { return nlohmann::json::parse(get("summary.json")); }
    const std::string& path() const { return scratch_.path(); }

  private:
    Scratch scratch_;
};

}  // namespace tribo::test
