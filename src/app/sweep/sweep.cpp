// SPDX-License-Identifier: MIT
#include "app/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <span>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/sweep/local_engine.hpp"
#include "app/sweep/slurm_engine.hpp"
#include "app/sweep/sweep_results.hpp"
#include "base/text/decimal.hpp"
#include "base/text/printable.hpp"
#include "files/memory.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

// The folder of a sweep: finished cases of all its plans, and the results of the last one. One run at a time.
class SweepFolder {
  public:
    // Makes it where it is missing. Refuses one that holds something else, and one in which a sweep runs.
    static FileResult<SweepFolder> open(const std::string& path) {
        SweepFolder folder;
        folder.path_ = path;
        std::error_code error;
        if (fs::exists(path, error) && !fs::is_directory(path, error))
            return refuse(path, "is no folder", "name a folder");
        if (fs::exists(path, error) && !fs::is_empty(path, error) && !fs::exists(folder.cases(), error))
            return refuse(path, "the folder holds something, and no cases of a sweep", "name another folder");
        fs::create_directories(folder.cases(), error);
        if (error) return files::system_failure(path, "make the folder", error.value());
        folder.lock_ = ::open(folder.cases().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder.lock_ < 0) return files::system_failure(path, "read", errno);
        if (::flock(folder.lock_, LOCK_EX | LOCK_NB) != 0)
            return refuse(path, "a sweep is running in this folder",
                          "wait for its end, or name another folder");
        return folder;
    }
    SweepFolder(SweepFolder&& other) noexcept
        : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)) {}
    SweepFolder& operator=(SweepFolder&&) = delete;
    ~SweepFolder() {
        if (lock_ >= 0) ::close(lock_);
    }

    const std::string& path() const { return path_; }
    std::string cases() const { return path_ + "/cases"; }

  private:
    SweepFolder() = default;
    static std::unexpected<FileFailure> refuse(const std::string& path, std::string cause,
                                               std::string remedy) {
        return std::unexpected(FileFailure({path, 0, 0, std::move(cause), std::move(remedy)}));
    }

    std::string path_;
    int lock_ = -1;
};

// The cases without a result, each identity once, in the order of their numbers.
std::vector<std::uint64_t> missing_cases(SweepCases& cases, const FinishedCases& finished) {
    struct Missing {
        std::array<char, 32> id;
        std::uint64_t number;
    };
    std::vector<Missing> missing;
    const std::uint64_t count = cases.plan().cases();
    for (std::uint64_t n = 0; n < count && !interrupted(); ++n) {
        const CaseId id = cases.id(n);
        if (finished.has(id)) continue;
        Missing& one = missing.emplace_back();
        std::ranges::copy(id, one.id.begin());
        one.number = n;
    }
    std::ranges::sort(missing, {}, [](const Missing& one) { return std::pair(one.id, one.number); });
    const auto repeated = std::ranges::unique(missing, {}, &Missing::id);
    missing.erase(repeated.begin(), repeated.end());
    std::vector<std::uint64_t> numbers;
    for (const Missing& one : missing) numbers.push_back(one.number);
    std::ranges::sort(numbers);
    return numbers;
}

double memory_of_worker(int workers) {
    return static_cast<double>(files::default_memory_budget_bytes()) / workers;
}

void print(const char* what, const std::string& value) {
    std::printf("%-16s %s\n", what, value.c_str());
}

std::string duration(double seconds) {
    char text[48];
    if (seconds < 120) {
        std::snprintf(text, sizeof text, "%.3g s", seconds);
    } else if (seconds < 7200) {
        std::snprintf(text, sizeof text, "%.3g min", seconds / 60);
    } else {
        std::snprintf(text, sizeof text, "%.3g hours", seconds / 3600);
    }
    return text;
}

int run_one(SweepCases& cases, std::uint64_t number) {
    if (number >= cases.plan().cases())
        return report(Error{cases.sweep().file, 0, 0, "there is no case " + std::to_string(number),
                            "name one from 0 to " + std::to_string(cases.plan().cases() - 1)});
    const std::vector<sweep::Value> values = cases.plan().values(number);
    const CaseResult result = cases.run(number, memory_of_worker(1));
    if (interrupted()) return interrupted_exit_code();
    for (std::size_t n = 0; n < values.size(); ++n) {
        const double* real = std::get_if<double>(&values[n]);
        const bool* flag = std::get_if<bool>(&values[n]);
        print(cases.plan().axes[n].key.c_str(), real   ? format_decimal(*real)
                                                : flag ? (*flag ? "true" : "false")
                                                       : printable(std::get<std::string>(values[n])));
    }
    for (const auto& [name, value] : result.values) print(name.c_str(), format_decimal(value));
    if (result.error.empty()) return kDone;
    std::fprintf(stderr, "%s\n", result.error.c_str());
    return kWrongInput;
}

// Runs the first and the middle case to tell how long all of them take.
int foretell(SweepCases& cases, std::uint64_t missing, int workers) {
    const std::uint64_t count = cases.plan().cases();
    print("cases", std::to_string(count) + ", of which " + std::to_string(missing) + " have no result");
    if (missing == 0) return kDone;
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    std::size_t bytes = 0;
    const std::uint64_t tried[]{0, count / 2};
    for (const std::uint64_t number : tried) {
        const CaseResult result = cases.run(number, memory_of_worker(workers));
        if (interrupted()) return interrupted_exit_code();
        if (!result.error.empty()) print("no result", "case " + std::to_string(number) + ": " + result.error);
        bytes += line_of(result).size();
    }
    const double one_s = std::chrono::duration<double>(Clock::now() - begin).count() / 2;
    const auto cases_left = static_cast<double>(missing);
    print("a case takes", duration(one_s) + ", measured on two of them");
    print("all take",
          duration(cases_left * one_s / workers) + " with " + std::to_string(workers) + " workers");
    // Results stand once as lines, once in each of the two tables.
    char megabytes[32];
    std::snprintf(megabytes, sizeof megabytes, "%.3g MB",
                  2.5 * cases_left * static_cast<double>(bytes) / 2e6);
    print("results take", std::string("about ") + megabytes);
    return kDone;
}

int print_status(SweepCases& cases, const FinishedCases& finished, const std::string& folder) {
    std::uint64_t done = 0, died = 0;
    const std::uint64_t count = cases.plan().cases();
    for (std::uint64_t n = 0; n < count && !interrupted(); ++n) {
        const CaseId id = cases.id(n);
        done += finished.has(id) ? 1 : 0;
        died += !finished.has(id) && finished.has(id, true) ? 1 : 0;
    }
    print("cases", std::to_string(count));
    print("finished", std::to_string(done));
    if (died > 0) print("died", std::to_string(died) + "; the next run tries them again");
    print("to do", std::to_string(count - done));
    if (const std::uint64_t tasks = slurm_tasks(folder, cases.digest()); tasks > 0)
        print("in Slurm's queue", std::to_string(tasks) + " tasks");
    return kDone;
}

FileResult<void> run_missing(const SweepCall& call, SweepCases& cases, const std::string& folder,
                             std::span<const std::uint64_t> missing, int workers) {
    Progress progress;
    if (call.engine == SweepEngine::slurm) {
        return run_on_slurm(
            cases, missing,
            {call.workers, folder, call.file, 0, [&](std::uint64_t ended, std::uint64_t tasks) {
                 progress.update("tasks", static_cast<double>(ended) / static_cast<double>(tasks));
             }});
    }
    const auto count = static_cast<double>(missing.size());
    const int most = static_cast<int>(std::min<std::size_t>(missing.size(), kMaxThreads));
    return run_locally(
        cases, missing,
        {std::min(workers, most), folder + "/cases", call.file, memory_of_worker(workers),
         [&](std::uint64_t done) { progress.update("cases", static_cast<double>(done) / count); }});
}

int run_all(const SweepCall& call, SweepCases& cases, SweepFolder& folder, const FinishedCases& before,
            int workers) {
    const std::vector<std::uint64_t> missing = missing_cases(cases, before);
    if (interrupted()) return interrupted_exit_code();
    if (!missing.empty()) {
        if (auto done = run_missing(call, cases, folder.path(), missing, workers); !done)
            return report(done.error());
    }
    if (interrupted()) {
        std::fprintf(stderr, "finished cases are kept%s; the same call goes on with the others\n",
                     call.engine == SweepEngine::slurm ? ", and the jobs in the queue go on" : "");
        return interrupted_exit_code();
    }
    const auto finished = FinishedCases::read(folder.cases());
    if (!finished) return report(finished.error());
    const auto counts = write_results(cases, *finished, folder.path());
    if (!counts) return report(counts.error());
    print("cases", std::to_string(counts->planned) + ", " + std::to_string(missing.size()) + " of them new");
    if (counts->failed > 0)
        print("no result", std::to_string(counts->failed) + "; report.html groups their reasons");
    if (finished->repeated() > before.repeated())
        print("ran twice", std::to_string(finished->repeated() - before.repeated()));
    print("files", printable(folder.path()));
    if (counts->finished == counts->planned) return kDone;
    return report(FileFailure(
        {folder.path(), 0, 0,
         std::to_string(counts->planned - counts->finished) + " cases have neither a result nor a reason",
         "see the logs in its folder slurm, then run the sweep again: it goes on"},
        FileFault::system));
}

}  // namespace

int sweep(const SweepCall& call) {
    auto cases = SweepCases::open(call.file);
    if (!cases) return report(cases.error());
    const int workers = call.workers > 0 ? call.workers : available_threads();
    if (call.only_case) return run_one(*cases, *call.only_case);
    if (call.out.empty()) {
        if (call.dry_run) return foretell(*cases, cases->plan().cases(), workers);
        return report(Error{call.file, 0, 0, "no folder is named for the results", "add --out DIR"});
    }
    // A look needs no folder, and takes none from a sweep that runs.
    if (call.dry_run || call.status) {
        const auto finished = FinishedCases::read(call.out + "/cases");
        if (!finished) return report(finished.error());
        if (call.status) return print_status(*cases, *finished, call.out);
        return foretell(*cases, missing_cases(*cases, *finished).size(), workers);
    }
    auto folder = SweepFolder::open(call.out);
    if (!folder) return report(folder.error());
    const auto finished = FinishedCases::read(folder->cases());
    if (!finished) return report(finished.error());
    return run_all(call, *cases, *folder, *finished, workers);
}

}  // namespace tribo::app
