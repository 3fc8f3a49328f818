// SPDX-License-Identifier: MIT
#include "app/run/job_folder.hpp"

#include <sstream>

namespace tribo::test {

Outcome JobFolder::render(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"render", "job.toml", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tribo(arguments, scratch_.path());
}

ForceColumns JobFolder::columns(const std::string& name) const {
    std::istringstream file(get(name));
    std::string line, cell;
    std::vector<std::string> names;
    ForceColumns columns;
    std::getline(file, line);
    for (std::istringstream head(line); std::getline(head, cell, ',');) names.push_back(cell);
    while (std::getline(file, line)) {
        std::istringstream row(line);
        for (const std::string& name : names) {
            std::getline(row, cell, ',');
            columns[name].push_back(std::stod(cell));
        }
    }
    return columns;
}

}  // namespace tribo::test
