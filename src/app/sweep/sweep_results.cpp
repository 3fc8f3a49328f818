// SPDX-License-Identifier: MIT
#include "app/sweep/sweep_results.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <sqlite3.h>
#include <unistd.h>

#include "app/sweep/sweep_statistics.hpp"
#include "base/text/decimal.hpp"
#include "files/unfinished.hpp"
#include "report/sweep/sweep_report.hpp"

namespace tribo::app {
namespace {

std::string cell_text(const sweep::Value& value) {
    if (const double* number = std::get_if<double>(&value)) return format_decimal(*number);
    if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    return std::get<std::string>(value);
}

// A field of CSV (RFC 4180), and a name of SQL: both double the quotes inside.
std::string quoted(const std::string& text) {
    std::string field = "\"";
    for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + '"';
}
std::string csv_field(const std::string& text) {
    return text.find_first_of("\",\r\n") == std::string::npos ? text : quoted(text);
}

// The value of a result, or null where the case has none of this name.
const double* find(const CaseResult& result, const std::string& name) {
    const auto found = std::ranges::find(result.values, name, &std::pair<std::string, double>::first);
    return found == result.values.end() ? nullptr : &found->second;
}

// One table `cases` in a file that appears when it is whole.
class CaseDatabase {
  public:
    CaseDatabase(std::string path, const std::vector<std::string>& inputs,
                 const std::vector<std::string>& outputs)
        : path_(std::move(path)), partial_(path_ + ".part-" + std::to_string(::getpid())) {
        files::note_unfinished(partial_, files::Removal::with_contents);
        std::remove(partial_.c_str());
        code_ = ::sqlite3_open(partial_.c_str(), &database_);
        std::string columns = "\"case\" INTEGER PRIMARY KEY", marks = "?";
        for (const std::string& name : inputs) columns += ", " + quoted(name), marks += ",?";
        for (const std::string& name : outputs) columns += ", " + quoted(name) + " REAL", marks += ",?";
        run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN; CREATE TABLE cases (" + columns +
            ", error TEXT)");
        const std::string insert = "INSERT INTO cases VALUES (" + marks + ",?)";
        if (code_ == SQLITE_OK)
            code_ = ::sqlite3_prepare_v2(database_, insert.c_str(), -1, &insert_, nullptr);
    }
    CaseDatabase(const CaseDatabase&) = delete;
    CaseDatabase& operator=(const CaseDatabase&) = delete;
    ~CaseDatabase() {
        close();
        std::remove(partial_.c_str());
        files::forget_unfinished(partial_);
    }

    void add(std::uint64_t number, const std::vector<sweep::Value>& inputs,
             const std::vector<std::string>& outputs, const CaseResult& result) {
        if (code_ != SQLITE_OK) return;
        int column = 0;
        ::sqlite3_bind_int64(insert_, ++column, static_cast<sqlite3_int64>(number));
        for (const sweep::Value& value : inputs) {
            if (const double* real = std::get_if<double>(&value)) {
                ::sqlite3_bind_double(insert_, ++column, *real);
            } else {
                bind(++column, cell_text(value));
            }
        }
        for (const std::string& name : outputs) {
            if (const double* value = find(result, name)) {
                ::sqlite3_bind_double(insert_, ++column, *value);
            } else {
                ::sqlite3_bind_null(insert_, ++column);
            }
        }
        if (!result.error.empty()) bind(++column, result.error);
        if (::sqlite3_step(insert_) != SQLITE_DONE) code_ = ::sqlite3_errcode(database_);
        ::sqlite3_reset(insert_);
        ::sqlite3_clear_bindings(insert_);
    }

    FileResult<void> finish() {
        run("COMMIT");
        const std::string why = code_ == SQLITE_OK ? "" : ::sqlite3_errstr(code_);
        close();
        if (!why.empty())
            return std::unexpected(FileFailure(
                {path_, 0, 0, "cannot write: " + why, "make room, then run the sweep again: cases are kept"},
                FileFault::system));
        if (std::rename(partial_.c_str(), path_.c_str()) != 0)
            return files::system_failure(path_, "write", errno);
        return {};
    }

  private:
    void run(const std::string& sql) {
        if (code_ == SQLITE_OK) code_ = ::sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr);
    }
    void bind(int column, const std::string& text) {
        ::sqlite3_bind_text(insert_, column, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    }
    void close() {
        ::sqlite3_finalize(insert_);
        ::sqlite3_close(database_);
        insert_ = nullptr;
        database_ = nullptr;
    }

    std::string path_, partial_;
    int code_ = SQLITE_OK;
    sqlite3* database_ = nullptr;
    sqlite3_stmt* insert_ = nullptr;
};

std::string words_of(const sweep::Axis& axis) {
    if (axis.distribution) {
        const sweep::Distribution& d = *axis.distribution;
        const std::string a = format_decimal(d.a), b = format_decimal(d.b);
        switch (d.kind) {
            case sweep::DistributionKind::uniform:
                return "uniform from " + a + " to " + b;
            case sweep::DistributionKind::normal:
                return "normal, mean " + a + ", standard deviation " + b;
            case sweep::DistributionKind::lognormal:
                return "lognormal, median " + a + ", 9 of 10 within a factor of 1 + " + b;
        }
    }
    constexpr std::size_t kShown = 12;
    std::string words;
    for (std::size_t n = 0; n < std::min(axis.values.size(), kShown); ++n)
        words += (n > 0 ? ", " : "") + cell_text(axis.values[n]);
    return axis.values.size() > kShown ? words + " ... (" + std::to_string(axis.values.size()) + ")" : words;
}

}  // namespace

FileResult<SweepCounts> write_results(SweepCases& cases, const FinishedCases& finished,
                                      const std::string& folder) {
    const sweep::Plan& plan = cases.plan();
    const std::uint64_t count = plan.cases();
    SweepStatistics statistics(plan);
    for (std::uint64_t n = 0; n < count; ++n) {
        auto result = finished.result(cases.id(n));
        if (!result) return std::unexpected(result.error());
        statistics.add(n, *result);
    }
    std::vector<std::string> inputs;
    for (const sweep::Axis& axis : plan.axes) inputs.push_back(axis.key);
    const std::vector<std::string>& outputs = statistics.names();

    auto csv = files::FileWriter::create(folder + "/results.csv");
    if (!csv) return std::unexpected(csv.error());
    CaseDatabase database(folder + "/results.sqlite", inputs, outputs);
    std::string line = "case";
    for (const std::string& name : inputs) line += "," + csv_field(name);
    for (const std::string& name : outputs) line += "," + csv_field(name);
    csv->write(line + ",error\n");
    for (std::uint64_t n = 0; n < count; ++n) {
        const auto result = finished.result(cases.id(n));
        if (!result) return std::unexpected(result.error());
        if (!*result) continue;
        const std::vector<sweep::Value> values = plan.values(n);
        line = std::to_string(n);
        for (const sweep::Value& value : values) line += "," + csv_field(cell_text(value));
        for (const std::string& name : outputs) {
            const double* value = find(**result, name);
            line += "," + (value != nullptr ? format_decimal(*value) : std::string());
        }
        csv->write(line + "," + csv_field((*result)->error) + "\n");
        database.add(n, values, outputs, **result);
    }
    if (auto done = csv->finish(); !done) return std::unexpected(done.error());
    if (auto done = database.finish(); !done) return std::unexpected(done.error());

    report::SweepReport page{cases.sweep().file,   TRIBO_VERSION,        count, statistics.finished(), {},
                             statistics.outputs(), statistics.failures()};
    for (const sweep::Axis& axis : plan.axes) page.inputs.push_back({axis.key, words_of(axis)});
    if (auto done = files::write_file(folder + "/report.html", report::sweep_report(page)); !done)
        return std::unexpected(done.error());
    return SweepCounts{count, statistics.finished(), statistics.failed()};
}

}  // namespace tribo::app
