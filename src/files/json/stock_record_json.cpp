// SPDX-License-Identifier: MIT
#include "files/json/stock_record_json.hpp"

#include <charconv>
#include <cmath>

#include "files/json/json.hpp"

namespace tribo::files {
namespace {

constexpr const char* kKey = "stock_record";
constexpr std::uint64_t kLargestSummaryBytes = std::uint64_t{64} << 20;

// Keeps the few words that are wanted; a whole summary of this size would take gigabytes.
bool is_wanted(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::key && depth == 1) return parsed == "schema" || parsed == "version" || parsed == kKey;
    return depth < 2 || (event != Event::object_start && event != Event::array_start);
}

// Sixteen hexadecimal digits.
std::optional<std::uint64_t> hash_of(const Json& record, const char* key) {
    const auto found = record.find(key);
    if (found == record.end() || !found->is_string()) return {};
    const auto& text = found->get_ref<const std::string&>();
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.size() != 16 || error != std::errc{} || end != text.data() + 16) return {};
    return value;
}

std::string text_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

FileResult<job::StockRecord> read_stock_record(const std::string& folder) {
    const auto refuse = [&](std::string cause, std::string remedy) {
        return std::unexpected(FileFailure({folder, 0, 0, std::move(cause), std::move(remedy)}));
    };
    const auto text = read_file(folder + "/summary.json", kLargestSummaryBytes, Pipes::refuse);
    if (!text && text.error().fault == FileFault::system) return std::unexpected(text.error());
    const Json json = text ? Json::parse(*text, is_wanted, false) : Json();
    if (!json.is_object() || !text_of(json, "schema").starts_with("tribo.summary/")) {
        return refuse("is no folder that tribo render wrote (no summary.json of its own in it)",
                      "name an earlier job (.toml) or the folder of its render");
    }
    const auto found = json.find(kKey);
    if (found == json.end() || !found->is_object()) {
        return refuse("was rendered from a program without a job, or by an early version",
                      "render it again with --job-out FIRST.toml, or name the job itself");
    }
    job::StockRecord record;
    record.version = text_of(json, "version");
    record.job = text_of(*found, "job");
    const auto stock = hash_of(*found, "stock"), cutters = hash_of(*found, "cutters"),
               moves = hash_of(*found, "moves");
    const auto until = found->find("until_s");
    const bool ends = until != found->end();
    if (ends && until->is_number()) record.until_s = until->get<double>();
    if (record.job.empty() || record.job.find('\0') != std::string::npos || !stock || !cutters || !moves ||
        (ends && !(record.until_s && std::isfinite(*record.until_s) && *record.until_s >= 0))) {
        return refuse("holds a summary.json whose stock_record is damaged",
                      "render its job again, or name the job itself");
    }
    record.stock = *stock;
    record.cutters = *cutters;
    record.moves = *moves;
    return record;
}

}  // namespace tribo::files
