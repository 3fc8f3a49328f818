// SPDX-License-Identifier: MIT
// The child process that reads a SOFA file, and its parent.
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files/sound/hrir_file.hpp"

extern char** environ;

namespace tribo::files {

Result<sound::HrirSet> hrirs_of_sofa(const std::string& path);

namespace {

// The reply is "ok" and the set, or "no" and the reason.
constexpr std::string_view kGood = "TRIBO-HRIR-1 ok\n", kBad = "TRIBO-HRIR-1 no\n";
constexpr std::size_t kMostReply = std::size_t{600} << 20;
constexpr std::size_t kMostReason = 400;
// The address sanitizer reserves terabytes of address space.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kCanLimitMemory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kCanLimitMemory = false;
#else
constexpr bool kCanLimitMemory = true;
#endif
#else
constexpr bool kCanLimitMemory = true;
#endif

void limit(int resource, rlim_t most) {
    const rlimit both{most, most};
    setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

class Unpacking {
  public:
    explicit Unpacking(std::string_view bytes) : bytes_(bytes) {}
    template <class T>
    bool take(T* values, std::size_t count) {
        if (bytes_.size() / sizeof(T) < count) return false;
        if (count == 0) return true;  // the pointer may be null then
        std::memcpy(values, bytes_.data(), count * sizeof(T));
        bytes_.remove_prefix(count * sizeof(T));
        return true;
    }
    template <class T>
    bool take(std::vector<T>& values, std::size_t count) {
        if (bytes_.size() / sizeof(T) < count) return false;
        values.resize(count);
        return take(values.data(), count);
    }
    bool done() const { return bytes_.empty(); }

  private:
    std::string_view bytes_;
};

void write_all(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = write(STDOUT_FILENO, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
}

// Runs the child to its end. Returns its output, or the reason of a failure.
Result<std::string> output_of(const std::string& program, const std::string& verb, const std::string& path) {
    const std::string remedy = "try another SOFA file, or leave 'hrtf' out for the built-in set";
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return fail("no pipe for the reader of SOFA files", "try again");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    std::string words[3] = {program, verb, path.starts_with('-') ? "./" + path : path};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t child = 0;
    const int failed = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (failed != 0) {
        close(ends[0]);
        return fail("the reader of SOFA files does not start: " + std::string(std::strerror(failed)),
                    "leave 'hrtf' out for the built-in set");
    }
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(kMostSofaSeconds);
    std::string reply;
    bool late = false, whole = false;
    std::array<char, 65536> block;
    while (!whole && !late && reply.size() < kMostReply) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd waiting{ends[0], POLLIN, 0};
        const int ready = left <= 0 ? 0 : poll(&waiting, 1, static_cast<int>(left));
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) {
            late = true;
            break;
        }
        const ssize_t n = read(ends[0], block.data(), block.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            whole = true;
        } else {
            reply.append(block.data(), static_cast<std::size_t>(n));
        }
    }
    close(ends[0]);
    if (!whole) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (late) return fail("takes longer to read than head responses may", remedy);
    if (!whole) return fail("is larger than head responses may be", remedy);
    if (WIFSIGNALED(status)) {
        const int by = WTERMSIG(status);
        return fail(by == SIGXCPU || by == SIGKILL
                        ? "takes longer to read than head responses may"
                        : "is damaged: its reader crashed (signal " + std::to_string(by) + ")",
                    remedy);
    }
    return reply;
}

}  // namespace

std::string packed_hrirs(const sound::HrirSet& set) {
    std::string bytes(kGood);
    const std::uint64_t sizes[] = {static_cast<std::uint64_t>(set.taps), set.directions.size()};
    append(bytes, &set.sample_rate_hz, 1);
    append(bytes, sizes, 2);
    append(bytes, set.directions.data(), set.directions.size());
    append(bytes, set.extra_delays_s.data(), set.extra_delays_s.size());
    append(bytes, set.responses.data(), set.responses.size());
    return bytes;
}

Result<sound::HrirSet> unpacked_hrirs(std::string_view bytes) {
    if (bytes.starts_with(kBad)) {
        std::string reason;
        for (const char c : bytes.substr(kBad.size(), kMostReason)) {
            if (c >= ' ' && c <= '~') reason += c;
        }
        return fail(reason, "try another SOFA file, or leave 'hrtf' out for the built-in set");
    }
    const auto garbled = [] {
        return fail("is damaged: its reader did not finish",
                    "try another SOFA file, or leave 'hrtf' out for the built-in set");
    };
    if (!bytes.starts_with(kGood)) return garbled();
    Unpacking unpacking(bytes.substr(kGood.size()));
    sound::HrirSet set;
    std::uint64_t sizes[2];
    constexpr std::uint64_t kMost = 1 << 20;
    if (!unpacking.take(&set.sample_rate_hz, 1) || !unpacking.take(sizes, 2) || sizes[0] > kMost ||
        sizes[1] > kMost) {
        return garbled();
    }
    set.taps = static_cast<int>(sizes[0]);
    if (!unpacking.take(set.directions, sizes[1]) || !unpacking.take(set.extra_delays_s, 2 * sizes[1]) ||
        !unpacking.take(set.responses, 2 * sizes[1] * sizes[0]) || !unpacking.done()) {
        return garbled();
    }
    if (auto ok = sound::check_hrirs(set); !ok) return std::unexpected(ok.error());
    return set;
}

int serve_hrirs(const std::string& path) {
    if (kCanLimitMemory) limit(RLIMIT_AS, kMostSofaBytes);
    limit(RLIMIT_CPU, static_cast<rlim_t>(kMostSofaSeconds));
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_CORE, 0);
    std::string reply;
    try {
        const Result<sound::HrirSet> set = hrirs_of_sofa(path);
        reply = set ? packed_hrirs(*set) : std::string(kBad) + set.error().cause;
    } catch (const std::bad_alloc&) {
        reply = std::string(kBad) + "needs more memory than a set of head responses may";
    }
    write_all(reply);
    return 0;
}

FileResult<sound::HrirSet> read_hrirs(const std::string& path, const std::string& program,
                                      const std::string& verb) {
    const auto refused = [&](Error error) {
        error.file = path;
        return std::unexpected(FileFailure(std::move(error)));
    };
    struct stat info;
    if (stat(path.c_str(), &info) != 0) return system_failure(path, "read", errno);
    if (!S_ISREG(info.st_mode)) return refused({{}, 0, 0, "is not a file", "name a SOFA file"});
    auto reply = output_of(program, verb, path);
    if (!reply) return refused(reply.error());
    auto set = unpacked_hrirs(*reply);
    if (!set) return refused(set.error());
    return std::move(*set);
}

}  // namespace tribo::files
