// SPDX-License-Identifier: MIT
#include "readers/response/universal_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/text/decimal.hpp"
#include "readers/response/fortran_fields.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::string_view kEnd = "-1";
constexpr double kLargestNode = 1e15;
constexpr double kMostPoints = 1e8;  // of a function; more are no measurement

class FileReader {
  public:
    FileReader(std::string_view bytes, const std::string& source_name)
        : lines_(bytes), source_name_(source_name) {}

    Result<std::vector<UniversalFunction>> read() {
        while (const auto line = lines_.next()) {
            if (trimmed(*line).empty()) continue;
            if (trimmed(*line) != kEnd) {
                return refuse("a dataset begins with a line -1, and this is none",
                              "export the file again as a Universal File");
            }
            const int begin = number();
            const auto name = lines_.next();
            if (!name) break;  // an end too many
            const std::vector<std::string_view> words = words_of(*name);
            if (words.empty()) return refuse("a dataset has no number", "write its number, as in 58");
            Result<void> done;
            if (words[0] == "58") {
                done = read_function(begin, {});
            } else if (words[0] == "58b" || words[0] == "58B") {
                done = read_function(begin, words);
            } else if (words[0] == "164") {
                done = read_units();
            } else {
                pass_over();
            }
            if (!done) return std::unexpected(done.error());
        }
        for (UniversalFunction& f : functions_)
            if (!f.units) f.units = units_.empty() ? std::nullopt : std::optional(units_[0]);
        return std::move(functions_);
    }

  private:
    int number() const { return passed_ + lines_.number(); }

    std::unexpected<Error> refuse(std::string cause, std::string remedy) const {
        return fail_at(source_name_, std::max(1, number()), 0, std::move(cause), std::move(remedy));
    }
    std::unexpected<Error> too_short(const char* dataset) const {
        return refuse(std::string("the file ends inside dataset ") + dataset, "export it again");
    }

    // Up to the end of a dataset.
    void pass_over() {
        while (const auto line = lines_.next())
            if (trimmed(*line) == kEnd) return;
    }

    Result<void> read_units() {
        const auto code = lines_.next(), factors = lines_.next();
        if (!code || !factors) return too_short("164");
        const auto values = fortran_numbers(*factors, std::array{25, 25, 25});
        if (!values || !((*values)[0] > 0) || !((*values)[1] > 0))
            return refuse("dataset 164 has no factors of length and force above 0",
                          "correct it, or delete it");
        units_.push_back({(*values)[0], (*values)[1]});
        pass_over();
        return {};
    }

    static UniversalAxis axis_of(std::string_view line) {
        UniversalAxis axis;
        const auto words = words_of(line);
        if (!words.empty())
            if (const auto type = fortran_number(words[0])) axis.type = whole(*type);
        axis.label = trimmed(columns(line, 26, 20));
        axis.unit = trimmed(columns(line, 47, 20));
        return axis;
    }

    static int whole(double value) {
        return std::abs(value) < 1e9 && value == std::floor(value) ? static_cast<int>(value) : -1;
    }

    // Record 6: what stands in columns, or words where the columns are others.
    static bool read_places(std::string_view line, UniversalFunction& function) {
        const auto kind = fortran_number(columns(line, 0, 5));
        const auto point = [&](std::size_t at) -> std::optional<UniversalPoint> {
            const auto node = fortran_number(columns(line, at + 10, 10));
            const auto direction = fortran_number(columns(line, at + 20, 4));
            if (!node || !direction || std::abs(*node) > kLargestNode) return std::nullopt;
            return UniversalPoint{trimmed(columns(line, at, 10)), static_cast<long long>(*node),
                                  whole(*direction)};
        };
        const auto response = point(31), reference = point(56);
        if (kind && response && reference) {
            function.kind = whole(*kind);
            function.response = *response;
            function.reference = *reference;
            return true;
        }
        const auto words = words_of(line);
        if (words.size() != 10) return false;
        std::array<double, 10> values{};
        for (const std::size_t n : std::array<std::size_t, 5>{0, 5, 6, 8, 9}) {
            const auto value = fortran_number(words[n]);
            if (!value || std::abs(*value) > kLargestNode) return false;
            values[n] = *value;
        }
        function.kind = whole(values[0]);
        function.response = {words[4], static_cast<long long>(values[5]), whole(values[6])};
        function.reference = {words[7], static_cast<long long>(values[8]), whole(values[9])};
        return true;
    }

    Result<void> read_form(std::string_view line, UniversalFunction& function) const {
        const auto values = fortran_numbers(line, std::array{10, 10, 10, 13, 13});
        const int type = values ? whole((*values)[0]) : 0;
        if (type != 2 && type != 4 && type != 5 && type != 6) {
            return refuse("the type of the numbers of dataset 58 is none of 2, 4, 5 and 6",
                          "export it as real or complex numbers of single or double precision");
        }
        function.is_complex = type >= 5;
        function.is_double = type == 4 || type == 6;
        const double points = (*values)[1];
        if (!(points >= 0 && points <= kMostPoints && points == std::floor(points)))
            return refuse("the number of points of dataset 58 is no count", "export it again");
        function.points = static_cast<std::size_t>(points);
        function.is_even = (*values)[2] == 1;
        function.first = (*values)[3];
        function.step = (*values)[4];
        return {};
    }

    // `binary`: the words of the line of a dataset 58b.
    Result<void> read_function(int begin, std::span<const std::string_view> binary) {
        UniversalFunction function;
        function.line = begin;
        function.number = static_cast<int>(functions_.size()) + 1;
        if (!units_.empty()) function.units = units_.back();
        constexpr int kRecords = 11;
        for (int record = 1; record <= kRecords; ++record) {
            const auto line = lines_.next();
            if (!line) return too_short("58");
            switch (record) {
                case 6:
                    if (!read_places(*line, function)) {
                        return refuse(
                            "this line should hold the kind of the function, and where it was measured",
                            "export it again");
                    }
                    break;
                case 7:
                    if (auto done = read_form(*line, function); !done) return done;
                    break;
                case 8:
                    function.abscissa = axis_of(*line);
                    break;
                case 9:
                    function.numerator = axis_of(*line);
                    break;
                case 10:
                    function.denominator = axis_of(*line);
                    break;
                default:
                    break;
            }
        }
        function.data_line = number() + 1;
        if (!binary.empty()) return take_binary(binary, function);
        const std::string_view rest = lines_.rest();
        std::size_t left = rest.size();
        while (const auto line = lines_.next()) {
            if (trimmed(*line) != kEnd) {
                left = lines_.rest().size();
                continue;
            }
            break;
        }
        function.data = rest.substr(0, rest.size() - left);
        functions_.push_back(function);
        return {};
    }

    Result<void> take_binary(std::span<const std::string_view> words, UniversalFunction function) {
        std::array<double, 4> values{};  // byte order, format, lines, bytes
        for (std::size_t n = 0; n < values.size(); ++n) {
            const auto value = n + 1 < words.size() ? fortran_number(words[n + 1]) : std::nullopt;
            if (value) values[n] = *value;
        }
        if (values[0] != 1 && values[0] != 2)
            return refuse("dataset 58b does not say the order of its bytes", "export it again, or as text");
        if (values[1] != 2)
            return refuse("the numbers of dataset 58b are not of the IEEE 754 format", "export it as text");
        function.is_binary = true;
        function.is_big_endian = values[0] == 2;
        const std::size_t size = function.is_double ? 8 : 4;
        const std::size_t values_bytes = function.points * size * (function.is_complex ? 2 : 1);
        std::size_t bytes = values_bytes + (function.is_even ? 0 : function.points * size);
        // As in the text, the abscissa beside double numbers may be single.
        const std::size_t with_single = values_bytes + function.points * 4;
        if (!function.is_even && values[3] == static_cast<double>(with_single)) {
            function.has_single_abscissa = true;
            bytes = with_single;
        }
        const std::string points = std::to_string(function.points) + " points";
        if (values[3] > 0 && values[3] != static_cast<double>(bytes)) {
            return refuse("dataset 58b says " + format_decimal(values[3]) + " bytes, and its " + points +
                              " need " + std::to_string(bytes),
                          "export it again, or as text");
        }
        const std::string_view rest = lines_.rest();
        if (bytes > rest.size())
            return refuse("the file ends inside dataset 58b, which should hold " + points, "export it again");
        function.data = rest.substr(0, bytes);
        passed_ = number();
        lines_ = TextLines(rest.substr(bytes));
        functions_.push_back(function);
        pass_over();
        return {};
    }

    TextLines lines_;
    int passed_ = 0;  // lines before those of lines_
    const std::string& source_name_;
    std::vector<UniversalUnits> units_;
    std::vector<UniversalFunction> functions_;
};

double binary_number(std::string_view bytes, bool is_double, bool is_big_endian) {
    std::uint64_t bits = 0;
    const std::size_t size = is_double ? 8 : 4;
    for (std::size_t n = 0; n < size; ++n) {
        const std::size_t at = is_big_endian ? n : size - 1 - n;
        bits = bits << 8 | static_cast<unsigned char>(bytes[at]);
    }
    return is_double ? std::bit_cast<double>(bits)
                     : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

}  // namespace

bool is_universal_file(std::string_view bytes) {
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        if (trimmed(*line) != kEnd) return false;
        const auto name = lines.next();
        const auto words = name ? words_of(*name) : std::vector<std::string_view>();
        return !words.empty() && is_digit(words[0][0]);
    }
    return false;
}

Result<std::vector<UniversalFunction>> read_functions(std::string_view bytes,
                                                      const std::string& source_name) {
    return FileReader(bytes, source_name).read();
}

Result<std::vector<double>> read_numbers(const UniversalFunction& function, const std::string& source_name) {
    const std::size_t count =
        function.points * ((function.is_complex ? 2u : 1u) + (function.is_even ? 0u : 1u));
    std::vector<double> numbers;
    const auto refuse = [&](int line, int column, std::string cause, std::string remedy) {
        return fail_at(source_name, line, column, std::move(cause), std::move(remedy));
    };
    if (function.is_binary) {
        const std::size_t of_point = count / std::max<std::size_t>(1, function.points);
        numbers.reserve(count);
        std::size_t at = 0;
        for (std::size_t n = 0; n < count; ++n) {
            const bool is_single = !function.is_double || (function.has_single_abscissa && n % of_point == 0);
            const std::size_t size = is_single ? 4 : 8;
            const double value =
                binary_number(function.data.substr(at, size), !is_single, function.is_big_endian);
            at += size;
            if (!std::isfinite(value)) {
                return refuse(function.line, 0,
                              "number " + std::to_string(n + 1) + " of the dataset is not finite",
                              "measure again, or export it as text");
            }
            numbers.push_back(value);
        }
        return numbers;
    }
    // A number takes at least two characters, so that a wrong count takes no memory.
    numbers.reserve(std::min(count, function.data.size() / 2));
    TextLines lines(function.data);
    while (const auto line = lines.next()) {
        const int here = function.data_line + lines.number() - 1;
        for (std::size_t at = 0; at < line->size();) {
            if (is_blank((*line)[at])) {
                ++at;
                continue;
            }
            double value = 0;
            const std::size_t length = next_fortran_number(line->substr(at), value);
            const int column = static_cast<int>(at) + 1;
            if (length == 0 || !std::isfinite(value))
                return refuse(here, column, "this is not a number", "write a decimal number with a point");
            if (numbers.size() == count) {
                return refuse(here, column,
                              "there are more numbers than the " + std::to_string(count) +
                                  " of the dataset's " + std::to_string(function.points) + " points",
                              "export it again");
            }
            numbers.push_back(value);
            at += length;
        }
    }
    if (numbers.size() < count) {
        return refuse(function.data_line + std::max(0, lines.number() - 1), 0,
                      "the dataset ends after " + std::to_string(numbers.size()) + " of the " +
                          std::to_string(count) + " numbers of its points",
                      "export it again");
    }
    return numbers;
}

}  // namespace tribo::readers
