// SPDX-License-Identifier: MIT
#include "readers/response/frequency_response.hpp"

#include <cmath>

#include "base/limits.hpp"
#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "readers/response/response_function.hpp"
#include "readers/response/universal_file.hpp"
#include "readers/text/number_table.hpp"

namespace tribo::readers {
namespace {

constexpr std::array kColumns{NumberColumn{"frequency_hz", kLimits.response_frequency},
                              NumberColumn{"re_mm_per_n", kLimits.receptance},
                              NumberColumn{"im_mm_per_n", kLimits.receptance}};

Result<FrequencyResponse> read_csv(std::string_view bytes, const ResponseOptions& options) {
    FrequencyResponse response;
    response.description = "receptance, CSV";
    NumberTable table(bytes, options.source_name, kColumns, "frequency response");
    if (auto header = table.read_header(); !header) return std::unexpected(header.error());
    response.line = table.line();
    if (options.unit) {
        return table.refuse_line("a unit is stated for a CSV table, whose columns name theirs",
                                 "leave the unit out, and give mm/N");
    }
    std::array<double, kColumns.size()> values{};
    for (;;) {
        const auto more = table.next(values);
        if (!more) return std::unexpected(more.error());
        if (!*more) break;
        if (!response.frequency_hz.empty() && !(values[0] > response.frequency_hz.back())) {
            return table.refuse_at(0, "the frequency is not above that of the line before",
                                   "sort the lines by frequency, each once");
        }
        if (response.frequency_hz.size() == options.max_points) {
            return table.refuse_line("more than " + std::to_string(options.max_points) + " frequencies",
                                     "leave out those beyond the band");
        }
        response.frequency_hz.push_back(values[0]);
        response.receptance_mm_per_n.emplace_back(values[1], values[2]);
    }
    if (response.frequency_hz.size() < 2) {
        return table.refuse_line("a frequency response needs two frequencies, this file has " +
                                     std::to_string(response.frequency_hz.size()),
                                 "add the missing lines");
    }
    return response;
}

// From the unit of the file to mm/N, with derivatives undone; what lies at 0 Hz then is lost.
Result<void> add_points(const UniversalFunction& function, const std::vector<double>& numbers,
                        const ResponseUnit& unit, double sign, const std::string& source,
                        FrequencyResponse& response) {
    const std::size_t per_point = function.is_even ? 2 : 3;
    const auto refuse = [&](std::size_t n, const std::string& cause, const std::string& remedy) {
        return fail_at(source, function.line, 0,
                       cause + " at point " + std::to_string(n + 1) + " of the dataset", remedy);
    };
    for (std::size_t n = 0; n < function.points; ++n) {
        const double* at = &numbers[n * per_point];
        const double hz = function.is_even ? function.first + static_cast<double>(n) * function.step : *at++;
        if (!kLimits.response_frequency.range.contains(hz)) {
            return refuse(n, out_of_range(kLimits.response_frequency, hz),
                          range_remedy(kLimits.response_frequency));
        }
        if (!response.frequency_hz.empty() && !(hz > response.frequency_hz.back()))
            return refuse(n, "the frequency is not above the one before", "sort the points, each once");
        if (hz == 0 && unit.derivatives > 0) continue;
        const double w = 2 * math::kPi * hz, factor = sign * unit.mm_per_n;
        std::complex<double> h(factor * at[0], factor * at[1]);
        if (unit.derivatives == 1) h = {h.imag() / w, -h.real() / w};
        if (unit.derivatives == 2) h = {-h.real() / (w * w), -h.imag() / (w * w)};
        for (const double part : {h.real(), h.imag()})
            if (!kLimits.receptance.range.contains(part))
                return refuse(n, out_of_range(kLimits.receptance, part), "check the unit of the response");
        response.frequency_hz.push_back(hz);
        response.receptance_mm_per_n.push_back(h);
    }
    if (response.frequency_hz.size() < 2) {
        return fail_at(source, function.line, 0,
                       "a frequency response needs two frequencies, this dataset has " +
                           std::to_string(response.frequency_hz.size()),
                       "measure again");
    }
    return {};
}

Result<FrequencyResponse> read_universal(std::string_view bytes, const ResponseOptions& options) {
    const std::string& source = options.source_name;
    const auto functions = read_functions(bytes, source);
    if (!functions) return std::unexpected(functions.error());
    FrequencyResponse response;
    const auto chosen = choose_response(*functions, options, response.warnings);
    if (!chosen) return std::unexpected(chosen.error());
    const UniversalFunction& function = *chosen->function;
    if (function.points > options.max_points) {
        return fail_at(source, function.line, 0,
                       "more than " + std::to_string(options.max_points) + " frequencies",
                       "export only the band");
    }
    const auto numbers = read_numbers(function, source);
    if (!numbers) return std::unexpected(numbers.error());
    response.line = function.line;
    response.derivatives = chosen->unit.derivatives;
    response.description = chosen->description;
    if (auto done = add_points(function, *numbers, chosen->unit, chosen->sign, source, response); !done)
        return std::unexpected(done.error());
    return response;
}

}  // namespace

bool looks_like_response(std::string_view bytes) {
    if (is_universal_file(bytes)) return true;
    CsvLines lines(bytes, {});
    std::vector<CsvField> fields;
    if (!lines.next(fields)) return false;
    for (const CsvField& field : fields)
        if (is_csv_column(field.text, kColumns[0].name) || is_csv_column(field.text, kColumns[1].name))
            return true;
    return false;
}

Result<FrequencyResponse> read_frequency_response(std::string_view bytes, const ResponseOptions& options) {
    return is_universal_file(bytes) ? read_universal(bytes, options) : read_csv(bytes, options);
}

}  // namespace tribo::readers
