// SPDX-License-Identifier: MIT
#include "app/sweep/sweep_worker.hpp"

#include <cstdio>
#include <cstring>
#include <iostream>
#include <set>
#include <sstream>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/sweep/sweep_cases.hpp"

namespace tribo::app {
namespace {

class Worker {
  public:
    Worker(SweepCases cases, CaseFile file, double memory_bytes)
        : cases_(std::move(cases)), file_(std::move(file)), memory_bytes_(memory_bytes) {
        done_.insert(file_.ids().begin(), file_.ids().end());
    }
    void add_done(const std::vector<CaseId>& ids) { done_.insert(ids.begin(), ids.end()); }

    std::uint64_t count() const { return cases_.plan().cases(); }

    FileResult<void> run(std::uint64_t number) {
        if (number >= count() || done_.contains(cases_.id(number))) return {};
        const CaseResult result = cases_.run(number, memory_bytes_);
        if (interrupted()) return {};
        done_.insert(result.id);
        return file_.add(result);
    }
    FileResult<void> sync() { return file_.sync(); }

  private:
    SweepCases cases_;
    CaseFile file_;
    double memory_bytes_;
    std::set<CaseId> done_;
};

int follow_stdin(Worker& worker) {
    std::string line;
    while (!interrupted() && std::getline(std::cin, line)) {
        std::istringstream numbers(line);
        for (std::uint64_t number; !interrupted() && numbers >> number;) {
            std::printf("run %llu\n", static_cast<unsigned long long>(number));
            std::fflush(stdout);
            if (auto done = worker.run(number); !done) return report(done.error());
        }
        std::printf("done\n");
        std::fflush(stdout);
    }
    if (auto done = worker.sync(); !done) return report(done.error());
    return interrupted() ? interrupted_exit_code() : kDone;
}

int follow_file(Worker& worker, const SweepWorkerCall& call) {
    const auto bytes = files::read_file(call.numbers);
    if (!bytes) return report(bytes.error());
    for (std::uint64_t n = call.first; !interrupted() && n < bytes->size() / sizeof(std::uint64_t);
         n += call.of) {
        std::uint64_t number = 0;
        std::memcpy(&number, bytes->data() + n * sizeof number, sizeof number);
        if (auto done = worker.run(number); !done) return report(done.error());
    }
    if (auto done = worker.sync(); !done) return report(done.error());
    return interrupted() ? interrupted_exit_code() : kDone;
}

}  // namespace

int sweep_worker(const SweepWorkerCall& call) {
    auto cases = SweepCases::open(call.sweep);
    if (!cases) return report(cases.error());
    if (!call.digest.empty() && cases->digest() != call.digest)
        return report(Error{call.sweep, 0, 0, "the sweep has changed since it began", "start it again"});
    const auto name = [&](int restart) { return call.cases + "-" + std::to_string(restart) + ".cases"; };
    auto file = CaseFile::open(name(call.restart));
    if (!file) return report(file.error());
    Worker worker(*std::move(cases), *std::move(file), call.memory_bytes);
    for (int n = 0; n < call.restart; ++n) {
        // The process of that start may still live, on a node that only seems dead: its file is not touched.
        const auto ids = ids_in(name(n));
        if (!ids) return report(ids.error());
        worker.add_done(*ids);
    }
    return call.numbers.empty() ? follow_stdin(worker) : follow_file(worker, call);
}

}  // namespace tribo::app
