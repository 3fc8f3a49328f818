// SPDX-License-Identifier: MIT
#include "app/sweep/finished_cases.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <sys/resource.h>
#include <tuple>

namespace tribo::app {
namespace {

// Files to keep open: more than an array of Slurm has tasks by default. Raises what the system lets this
// process open, as far as it may: often 1,024.
std::size_t most_open() {
    constexpr rlim_t wanted = 2000, for_others = 100;
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 1;
    if (limit.rlim_cur < wanted + for_others) {
        limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, wanted + for_others);
        if (::setrlimit(RLIMIT_NOFILE, &limit) != 0) ::getrlimit(RLIMIT_NOFILE, &limit);
    }
    return limit.rlim_cur > for_others ? std::min(wanted, limit.rlim_cur - for_others) : 1;
}

}  // namespace

FinishedCases::Key FinishedCases::key_of(const CaseId& id) {
    Key key{};
    for (std::size_t n = 0; n < key.size() && 16 * (n + 1) <= id.size(); ++n)
        std::from_chars(id.data() + 16 * n, id.data() + 16 * (n + 1), key[n], 16);
    return key;
}

FileResult<FinishedCases> FinishedCases::read(const std::string& folder) {
    FinishedCases finished;
    auto done = scan_cases(folder, finished.files_, [&](const CaseResult& result, CasePlace place) {
        finished.places_.push_back({key_of(result.id), place.offset, place.file, result.died});
    });
    if (!done) return std::unexpected(done.error());
    // In the order of the files and of their lines; a case that died comes last.
    std::ranges::sort(finished.places_, {},
                      [](const Entry& e) { return std::tuple(e.key, e.died, e.file, e.offset); });
    const auto repeated = std::ranges::unique(finished.places_, {}, &Entry::key);
    finished.repeated_ = repeated.size();
    finished.places_.erase(repeated.begin(), repeated.end());
    return finished;
}

const FinishedCases::Entry* FinishedCases::find(const CaseId& id) const {
    const Key key = key_of(id);
    const auto found = std::ranges::lower_bound(places_, key, {}, &Entry::key);
    return found == places_.end() || found->key != key ? nullptr : &*found;
}

bool FinishedCases::has(const CaseId& id, bool and_died) const {
    const Entry* entry = find(id);
    return entry != nullptr && (and_died || !entry->died);
}

std::ifstream& FinishedCases::opened(std::uint32_t file) const {
    if (open_.empty()) open_.resize(std::min(files_.size(), most_open()));
    OpenFile& open = open_[file % open_.size()];
    if (!open.in.is_open() || open.file != file) open = {file, std::ifstream(files_[file], std::ios::binary)};
    open.in.clear();
    return open.in;
}

FileResult<std::optional<CaseResult>> FinishedCases::result(const CaseId& id) const {
    const Entry* entry = find(id);
    if (entry == nullptr) return std::nullopt;
    const std::string& path = files_[entry->file];
    std::ifstream& in = opened(entry->file);
    std::string line;
    in.seekg(static_cast<std::streamoff>(entry->offset));
    if (!in || !std::getline(in, line)) return files::system_failure(path, "read", errno);
    return read_case(line);
}

}  // namespace tribo::app
