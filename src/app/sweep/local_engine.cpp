// SPDX-License-Identifier: MIT
#include "app/sweep/local_engine.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <vector>

#include "app/interrupt.hpp"
#include "app/sweep/child_process.hpp"
#include "app/sweep/sweep_worker.hpp"

namespace tribo::app {
namespace {

// Cases at once for a worker: few enough that the last ones end together.
constexpr std::size_t kMostAtOnce = 64, kSharesPerWorker = 32;
constexpr int kPollMs = 200;

// One worker process, with the cases that it was given and has not finished.
class Worker {
  public:
    FileResult<void> start(std::vector<std::string> arguments) {
        const int error = process_.start("/proc/self/exe", std::move(arguments));
        if (error != 0) return files::system_failure("a worker", "start", error);
        return {};
    }

    int descriptor() const { return process_.output(); }
    bool is_idle() const { return given_.empty(); }
    bool is_over() const { return over_; }

    void give(std::span<const std::uint64_t> numbers) {
        given_.assign(numbers.begin(), numbers.end());
        begun_ = 0;
        std::string line;
        for (const std::uint64_t number : numbers) line += std::to_string(number) + ' ';
        line.back() = '\n';
        process_.write(line);
    }

    // Reads what it says. Returns the number of cases that it has finished since the last call.
    std::uint64_t listen() {
        over_ = !process_.read(text_);
        std::uint64_t finished = 0;
        for (std::size_t end; (end = text_.find('\n')) != std::string::npos; text_.erase(0, end + 1)) {
            finished += begun_ > 0 ? 1 : 0;
            if (text_.starts_with("run ")) {
                ++begun_;
            } else {
                given_.clear();
                begun_ = 0;
            }
        }
        return finished;
    }

    // It finishes and ends. Returns its status.
    int wait() { return process_.wait(); }
    void interrupt() const { process_.signal(SIGTERM); }

    // The case that it was running, and those that it had not begun.
    std::optional<std::uint64_t> running() const {
        return begun_ > 0 && begun_ <= given_.size() ? std::optional(given_[begun_ - 1]) : std::nullopt;
    }
    std::span<const std::uint64_t> not_begun() const {
        return std::span(given_).subspan(std::min(begun_, given_.size()));
    }

  private:
    ChildProcess process_;
    bool over_ = false;
    std::vector<std::uint64_t> given_;
    std::size_t begun_ = 0;  // of given_: so many
    std::string text_;
};

std::string reason_of(int status) {
    if (WIFSIGNALED(status))
        return "the process of the case ended with signal " + std::to_string(WTERMSIG(status)) + " (" +
               ::strsignal(WTERMSIG(status)) + ")";
    return "the process of the case ended with exit code " + std::to_string(WEXITSTATUS(status));
}

class Engine {
  public:
    Engine(SweepCases& cases, std::span<const std::uint64_t> numbers, const LocalEngineOptions& options)
        : cases_(cases), numbers_(numbers), options_(options) {
        const std::size_t shares = kSharesPerWorker * static_cast<std::size_t>(options.workers);
        at_once_ = std::clamp<std::size_t>(numbers.size() / shares, 1, kMostAtOnce);
    }

    FileResult<void> run() {
        for (int n = 0; n < options_.workers; ++n) {
            if (auto started = start(); !started) return started;
        }
        while (!interrupted() && is_busy()) {
            for (auto& worker : workers_)
                if (worker->is_idle()) give(*worker);
            if (auto heard = listen(); !heard) return heard;
        }
        return end();
    }

  private:
    bool has_work() const { return next_ < numbers_.size() || !again_.empty(); }
    bool is_busy() const {
        return has_work() || std::ranges::any_of(workers_, [](const auto& w) { return !w->is_idle(); });
    }

    FileResult<void> start() {
        auto worker = std::make_unique<Worker>();
        const std::string name = own_case_file(cases_.digest(), std::to_string(started_++));
        // The worker adds the ending.
        const std::string file = options_.folder + "/" + name.substr(0, name.rfind('.'));
        std::vector<std::string> call{
            "tribo", kSweepWorkerVerb, options_.sweep, "--digest", cases_.digest(), "--cases", file};
        if (options_.memory_bytes > 0) {
            call.push_back("--memory");
            call.push_back(std::to_string(options_.memory_bytes / 1e6));
        }
        if (auto done = worker->start(std::move(call)); !done) return done;
        workers_.push_back(std::move(worker));
        return {};
    }

    void give(Worker& worker) {
        if (!again_.empty()) {
            const std::vector<std::uint64_t> numbers = std::move(again_);
            again_.clear();
            worker.give(numbers);
            return;
        }
        const std::size_t count = std::min(at_once_, numbers_.size() - next_);
        if (count == 0) return;
        worker.give(numbers_.subspan(next_, count));
        next_ += count;
    }

    FileResult<void> listen() {
        std::vector<pollfd> polled;
        for (const auto& worker : workers_) polled.push_back({worker->descriptor(), POLLIN, 0});
        if (::poll(polled.data(), polled.size(), kPollMs) <= 0) return {};
        for (std::size_t n = 0; n < polled.size(); ++n) {
            if (polled[n].revents == 0) continue;
            const std::uint64_t finished = workers_[n]->listen();
            count(finished);
            if (!workers_[n]->is_over()) continue;
            if (auto replaced = replace(workers_[n]); !replaced) return replaced;
            return {};  // the list has changed
        }
        return {};
    }

    // A worker is gone, while nobody asked it to.
    FileResult<void> replace(std::unique_ptr<Worker>& worker) {
        const int status = worker->wait();
        if (interrupted()) {
            std::erase(workers_, worker);
            return {};
        }
        // It has said why on stderr.
        if (WIFEXITED(status) && WEXITSTATUS(status) != 0) {
            return std::unexpected(
                FileFailure({options_.sweep, 0, 0,
                             "a worker has stopped (exit code " + std::to_string(WEXITSTATUS(status)) + ")",
                             "see its message above, then run the sweep again: finished cases are kept"},
                            WEXITSTATUS(status) == 2 ? FileFault::input : FileFault::system));
        }
        if (const auto running = worker->running()) {
            if (auto noted = note(*running, reason_of(status)); !noted) return noted;
            count(1);
        }
        const auto left = worker->not_begun();
        again_.insert(again_.end(), left.begin(), left.end());
        std::erase(workers_, worker);
        return start();
    }

    FileResult<void> note(std::uint64_t number, const std::string& reason) {
        const std::string path = options_.folder + "/" + own_case_file(cases_.digest(), "ended");
        auto file = CaseFile::open(path);
        if (!file) return std::unexpected(file.error());
        if (auto added = file->add({cases_.id(number), {}, reason, true}); !added) return added;
        return file->sync();
    }

    void count(std::uint64_t finished) {
        if (finished == 0) return;
        done_ += finished;
        if (options_.progress) options_.progress(done_);
    }

    FileResult<void> end() {
        if (interrupted())
            for (const auto& worker : workers_) worker->interrupt();
        FileResult<void> result;
        for (const auto& worker : workers_) {
            const int status = worker->wait();
            if (!interrupted() && status != 0 && result)
                result = std::unexpected(FileFailure({options_.sweep, 0, 0, reason_of(status),
                                                      "see its message above, then run the sweep again"},
                                                     FileFault::system));
        }
        workers_.clear();
        return result;
    }

    SweepCases& cases_;
    std::span<const std::uint64_t> numbers_;
    const LocalEngineOptions& options_;
    std::size_t at_once_ = 1, next_ = 0;
    std::vector<std::uint64_t> again_;  // given to a worker that died before it began them
    std::vector<std::unique_ptr<Worker>> workers_;
    int started_ = 0;
    std::uint64_t done_ = 0;
};

}  // namespace

FileResult<void> run_locally(SweepCases& cases, std::span<const std::uint64_t> numbers,
                             const LocalEngineOptions& options) {
    return Engine(cases, numbers, options).run();
}

}  // namespace tribo::app
