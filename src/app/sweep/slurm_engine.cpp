// SPDX-License-Identifier: MIT
#include "app/sweep/slurm_engine.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <sys/wait.h>
#include <system_error>
#include <thread>

#include "app/interrupt.hpp"
#include "app/sweep/child_process.hpp"
#include "app/sweep/sweep_worker.hpp"
#include "files/files.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

// Slurm's default; sites set their own.
constexpr std::uint64_t kDefaultArraySize = 1001;
// More tasks than this gain nothing: each starts a process and keeps a file.
constexpr std::uint64_t kMostTasks = 4000;
// Starting a task takes Slurm about a second: it should have that much to do, s.
constexpr double kTaskS = 30;
constexpr auto kAskEvery = std::chrono::seconds(1);

struct CommandOutcome {
    bool is_found = true;
    int exit_code = 0;
    std::string out;  // with what it said on stderr
};

CommandOutcome run_command(const std::vector<std::string>& arguments) {
    ChildProcess process;
    CommandOutcome outcome;
    if (process.start(arguments.front(), arguments, true) != 0) {
        outcome.is_found = false;
        return outcome;
    }
    while (process.read(outcome.out)) {
    }
    const int status = process.wait();
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

std::string in_shell_quotes(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::uint64_t number_after(const std::string& text, std::string_view key, std::uint64_t otherwise) {
    std::size_t at = text.find(key);
    if (at == std::string::npos) return otherwise;
    at = text.find_first_of("0123456789", at + key.size());
    if (at == std::string::npos) return otherwise;
    std::uint64_t number = otherwise;
    std::from_chars(text.data() + at, text.data() + text.size(), number);
    return number;
}

// The array of a sweep that was submitted last; its number stands in a file beside the cases.
class SlurmArray {
  public:
    SlurmArray(const std::string& folder, const std::string& digest)
        : folder_(folder + "/slurm"), name_(digest.substr(0, 8)) {}

    std::string file(const std::string& ending) const { return folder_ + "/" + name_ + ending; }
    const std::string& folder() const { return folder_; }

    std::string job() const {
        const auto text = files::read_file(file(".job"));
        return text ? text->substr(0, text->find('\n')) : std::string();
    }
    // Tasks that wait or run. No value: Slurm does not answer.
    std::optional<std::uint64_t> tasks_left() const {
        const std::string number = job();
        if (number.empty()) return 0;
        const CommandOutcome queue = run_command({"squeue", "-h", "-r", "-j", number, "-o", "%i"});
        if (!queue.is_found) return 0;
        // A job that has left the queue for long is unknown.
        if (queue.exit_code != 0)
            return queue.out.find("Invalid job id") != std::string::npos ? std::optional<std::uint64_t>(0)
                                                                         : std::nullopt;
        return static_cast<std::uint64_t>(std::ranges::count(queue.out, '\n'));
    }

  private:
    std::string folder_, name_;
};

// Runs one case here, and keeps it. Returns the time that it took, s.
FileResult<double> time_one(SweepCases& cases, std::uint64_t number, const std::string& folder) {
    const auto begin = std::chrono::steady_clock::now();
    const CaseResult result = cases.run(number, 0);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (interrupted()) return passed.count();
    auto file = CaseFile::open(folder + "/cases/" + own_case_file(cases.digest(), "first"));
    if (!file) return std::unexpected(file.error());
    if (auto added = file->add(result); !added) return std::unexpected(added.error());
    return passed.count();
}

FileResult<void> submit(const SlurmArray& array, const std::string& digest,
                        std::span<const std::uint64_t> numbers, double case_s,
                        const SlurmEngineOptions& options, std::uint64_t& tasks) {
    const CommandOutcome settings = run_command({"scontrol", "show", "config"});
    if (!settings.is_found)
        return std::unexpected(
            FileFailure({options.sweep, 0, 0, "scontrol and sbatch of Slurm are not in PATH",
                         "run this on a machine that submits to the cluster, or leave --engine slurm out"},
                        FileFault::system));
    const std::uint64_t most = number_after(settings.out, "MaxArraySize", kDefaultArraySize);
    const double wanted = static_cast<double>(numbers.size()) * case_s / kTaskS;
    tasks =
        std::min<std::uint64_t>({numbers.size(), most, kMostTasks, static_cast<std::uint64_t>(wanted) + 1});
    std::error_code error;
    fs::create_directories(array.folder(), error);
    if (error) return files::system_failure(array.folder(), "make the folder", error.value());
    std::string bytes(numbers.size_bytes(), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    if (auto done = files::write_file(array.file(".numbers"), bytes); !done) return done;

    const std::string own = fs::read_symlink("/proc/self/exe", error).string();
    std::string script =
        "#!/bin/sh\n#SBATCH --job-name=tribo-sweep\n#SBATCH --requeue\n#SBATCH --ntasks=1\n"
        "#SBATCH --open-mode=append\n";
    script += "#SBATCH --array=0-" + std::to_string(tasks - 1);
    if (options.workers > 0) script += "%" + std::to_string(options.workers);
    script += "\n#SBATCH --output=" + array.folder() + "/%A_%a.log\n";
    if (options.memory_mb > 0)
        script += "#SBATCH --mem=" + std::to_string(static_cast<std::uint64_t>(options.memory_mb)) + "M\n";
    script += "exec " + in_shell_quotes(own) + " " + kSweepWorkerVerb + " " + in_shell_quotes(options.sweep) +
              " --digest " + digest + " --cases " +
              in_shell_quotes(options.folder + "/cases/" + digest.substr(0, 8)) +
              "-$SLURM_ARRAY_JOB_ID-$SLURM_ARRAY_TASK_ID --restart ${SLURM_RESTART_COUNT:-0} --numbers " +
              in_shell_quotes(array.file(".numbers")) + " --first $SLURM_ARRAY_TASK_ID --of " +
              std::to_string(tasks) + "\n";
    if (auto done = files::write_file(array.file(".sh"), script); !done) return done;
    const CommandOutcome sent =
        run_command({"sbatch", "--parsable", "--chdir", fs::current_path(error).string(), array.file(".sh")});
    if (!sent.is_found || sent.exit_code != 0)
        return std::unexpected(FileFailure(
            {array.file(".sh"), 0, 0,
             sent.is_found ? "sbatch refuses: " + sent.out.substr(0, sent.out.find_last_not_of('\n') + 1)
                           : "sbatch is not in PATH",
             "correct what it says, or submit this file yourself and run the sweep again"},
            FileFault::system));
    // NUMBER, or NUMBER;CLUSTER.
    return files::write_file(array.file(".job"), sent.out.substr(0, sent.out.find_first_of(";\n")) + "\n");
}

}  // namespace

FileResult<void> run_on_slurm(SweepCases& cases, std::span<const std::uint64_t> numbers,
                              const SlurmEngineOptions& given) {
    SlurmEngineOptions options = given;
    options.folder = fs::absolute(given.folder).lexically_normal().string();
    const SlurmArray array(options.folder, cases.digest());
    auto left = array.tasks_left();
    std::uint64_t tasks = left.value_or(0);
    if (left == 0) {
        const auto case_s = time_one(cases, numbers.front(), options.folder);
        if (!case_s) return std::unexpected(case_s.error());
        numbers = numbers.subspan(1);
        if (numbers.empty() || interrupted()) return {};
        if (auto done = submit(array, cases.digest(), numbers, *case_s, options, tasks); !done) return done;
    }
    // One wrong answer of a busy controller is no end.
    for (left = std::nullopt; left != 0 && !interrupted();) {
        std::this_thread::sleep_for(kAskEvery);
        left = array.tasks_left();
        if (left && options.progress) options.progress(tasks - std::min(*left, tasks), tasks);
    }
    return {};
}

std::uint64_t slurm_tasks(const std::string& folder, const std::string& digest) {
    return SlurmArray(fs::absolute(folder).lexically_normal().string(), digest).tasks_left().value_or(0);
}

}  // namespace tribo::app
