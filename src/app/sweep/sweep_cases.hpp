// SPDX-License-Identifier: MIT
// The cases of a sweep: their inputs, their identities, and the run of one of them. One thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/sweep/case_store.hpp"
#include "app/sweep/sweep_files.hpp"
#include "job/loader.hpp"
#include "job/sweep/job_change.hpp"
#include "job/sweep/sweep.hpp"

namespace tribo::app {

class SweepCases {
  public:
    // Reads the file of the sweep, and lists its folder of programs.
    static FileResult<SweepCases> open(const std::string& file);

    const job::Sweep& sweep() const { return sweep_; }
    // With the axis `program` first, if there is a folder of programs.
    const sweep::Plan& plan() const { return sweep_.plan; }
    // Of the file of the sweep and the version of Tribo: names what belongs to this plan.
    const std::string& digest() const { return digest_; }

    // Digest of the inputs, of what is computed, of the bytes of all files that the case reads, and of the
    // version of Tribo. Cases that differ in no more than numbers read the same files, once.
    CaseId id(std::uint64_t number);
    // Runs the case on this thread. A case that is refused has its reason as its error. An interrupted run
    // gives an error, too, and must not be kept.
    CaseResult run(std::uint64_t number, double memory_bytes);

  private:
    FileResult<job::LoadedJob> load(const std::vector<sweep::Value>& values, double memory_bytes);
    std::vector<job::JobChange> changes(const std::vector<sweep::Value>& values, std::string& program) const;
    const std::string& files_digest(const std::vector<sweep::Value>& values);

    job::Sweep sweep_;
    std::string digest_;
    std::unique_ptr<SweepFiles> files_ = std::make_unique<SweepFiles>();
    std::map<std::string, std::string> files_digests_;  // by the texts among the values
};

}  // namespace tribo::app
