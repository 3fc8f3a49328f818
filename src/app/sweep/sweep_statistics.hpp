// SPDX-License-Identifier: MIT
// Statistics of the results of a sweep, from a stream of its cases in order. Memory is bounded.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/sweep/case_store.hpp"
#include "report/sweep/sweep_report.hpp"
#include "sweep/plan.hpp"
#include "sweep/sensitivity.hpp"

namespace tribo::app {

class SweepStatistics {
  public:
    explicit SweepStatistics(const sweep::Plan& plan) : plan_(plan) {}

    // `result`: none where the case is not finished.
    void add(std::uint64_t number, const std::optional<CaseResult>& result);

    // Names of the results, in the order in which they first came.
    const std::vector<std::string>& names() const { return names_; }
    std::uint64_t finished() const { return finished_; }
    std::uint64_t failed() const { return failed_; }
    std::vector<report::SweepOutput> outputs() const;
    std::vector<report::SweepFailure> failures() const;

  private:
    struct Output {
        std::vector<double> values;  // at most kMostKept of them, evenly over the cases
        std::uint64_t count = 0, stride = 1;
        double sum = 0, least = 0, most = 0;
        std::uint64_t least_case = 0, most_case = 0;
        std::optional<sweep::Sensitivity> sensitivity;
        std::vector<double> block;

        void add(std::uint64_t number, double value);
    };
    Output& output(const std::string& name);

    const sweep::Plan& plan_;
    std::vector<std::string> names_;
    std::map<std::string, Output> outputs_;
    std::map<std::string, report::SweepFailure> failures_;
    std::uint64_t finished_ = 0, failed_ = 0;
};

}  // namespace tribo::app
