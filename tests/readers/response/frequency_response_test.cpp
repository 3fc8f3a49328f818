// SPDX-License-Identifier: MIT
#include "readers/response/frequency_response.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "readers/refusals.hpp"
#include "readers/response/universal_writer.hpp"

namespace tribo::readers {
namespace {

using Complex = std::complex<double>;

constexpr const char* kHeader = "frequency_hz,re_mm_per_n,im_mm_per_n\n";

FrequencyResponse good(const std::string& bytes, const ResponseOptions& options = {.source_name = "a.uff"}) {
    const auto read = read_frequency_response(bytes, options);
    EXPECT_TRUE(read) << (read ? "" : read.error().text());
    return read ? *read : FrequencyResponse{};
}

void expect_points(const FrequencyResponse& r, const std::vector<double>& hz, const std::vector<Complex>& h) {
    ASSERT_EQ(r.frequency_hz.size(), hz.size());
    for (std::size_t n = 0; n < hz.size(); ++n) {
        EXPECT_DOUBLE_EQ(r.frequency_hz[n], hz[n]);
        EXPECT_NEAR(std::abs(r.receptance_mm_per_n[n] - h[n]), 0, 2e-7 * std::abs(h[n])) << hz[n];
    }
}

TEST(ResponseCsv, reads_columns_in_any_order_with_comments_marks_and_line_ends_of_all_kinds) {
    const auto r = good(
        "\xEF\xBB\xBF# tapped by M\xFCller\r\n"
        "Im_mm_per_N, coherence ,frequency_hz,RE_MM_PER_N\r\n\r\n"
        "-1e-6,1,0,1e-3\r# between\n-2e-6, 0.9, 2.5,-1.5e-3\n");
    expect_points(r, {0, 2.5}, {{1e-3, -1e-6}, {-1.5e-3, -2e-6}});
    EXPECT_EQ(r.derivatives, 0);
    EXPECT_EQ(r.description, "receptance, CSV");
    EXPECT_EQ(r.line, 2);
    EXPECT_TRUE(r.warnings.empty());
}

TEST(ResponseCsv, refuses_what_is_no_response_with_its_place) {
    const std::string h = kHeader;
    const Refusal refusals[] = {
        {"", 1, 0, "no frequency response"},
        {"# nothing\n\n", 2, 0, "no frequency response"},
        {"1,2,3\n", 1, 1, "no column frequency_hz"},
        {"frequency_hz;re_mm_per_n;im_mm_per_n\n", 1, 1, "semicolons"},
        {"frequency_hz,re_mm_per_n\n", 1, 1, "no column im_mm_per_n"},
        {h, 1, 0, "two frequencies, this file has 0"},
        {h + "1,0,0\n", 2, 0, "two frequencies, this file has 1"},
        {h + "1,0,0\n1,0,0\n", 3, 1, "not above that of the line before"},
        {h + "2,0,0\n1,0,0\n", 3, 1, "not above that of the line before"},
        {h + "-1,0,0\n", 2, 1, "frequency of a response of -1 Hz is out of range"},
        {h + "1,0\n", 2, 3, "2 fields, the header 3"},
        {h + "1,0,0,0\n", 2, 7, "4 fields"},
        {h + "1,nan,0\n", 2, 3, "not a number"},
        {h + "1,0,inf\n", 2, 5, "not a number"},
        {h + "1,,0\n", 2, 3, "a number is missing"},
        {h + "1,1e9,0\n", 2, 3, "out of range"},
        {h + "1,0,1e999\n", 2, 5, "not a number"},
    };
    expect_refused(refusals, [](const std::string& text, const char* name) {
        return read_frequency_response(text, {.source_name = name});
    });
    const auto unit =
        read_frequency_response(h + "1,0,0\n2,0,0\n", {.source_name = "a.csv", .unit = &kResponseUnits[1]});
    ASSERT_FALSE(unit);
    EXPECT_NE(unit.error().cause.find("a unit is stated for a CSV table"), std::string::npos);
    const auto many = read_frequency_response(h + "1,0,0\n2,0,0\n3,0,0\n", {.max_points = 2});
    ASSERT_FALSE(many);
    EXPECT_NE(many.error().cause.find("more than 2 frequencies"), std::string::npos);
}

// In m/N.
const std::vector<double> kHz{10, 12, 14};
const std::vector<Complex> kReceptance{{1.5e-6, -2.5e-8}, {-2.25e-6, -1.25e-6}, {3.5e-8, -4.5e-9}};

std::vector<std::vector<double>> rows_of(bool even) {
    std::vector<std::vector<double>> rows;
    for (std::size_t n = 0; n < kHz.size(); ++n) {
        rows.push_back({kReceptance[n].real(), kReceptance[n].imag()});
        if (!even) rows.back().insert(rows.back().begin(), kHz[n]);
    }
    return rows;
}

Dataset58 receptance(bool even = true) {
    Dataset58 d;
    d.even = even;
    d.first = even ? 10 : 0;
    d.step = even ? 2 : 0;
    d.rows = rows_of(even);
    return d;
}

std::vector<Complex> in_mm(double factor = 1e3) {
    std::vector<Complex> h;
    for (const Complex& v : kReceptance) h.push_back(factor * v);
    return h;
}

TEST(UniversalFile, is_read_as_text_and_binary_in_all_forms_of_its_numbers) {
    for (const Bytes bytes : {Bytes::text, Bytes::little, Bytes::big}) {
        for (const int type : {5, 6}) {
            for (const bool even : {true, false}) {
                for (const char* end : {"\n", "\r\n"}) {
                    for (const bool single : {false, true}) {
                        Dataset58 d = receptance(even);
                        d.bytes = bytes;
                        d.type = type;
                        d.line_end = end;
                        d.single_abscissa = single;
                        SCOPED_TRACE(written(d));
                        // Others before and after it do not matter.
                        const auto r = good(kHeader151 + kNodes15 + written(d) + kNodes15);
                        expect_points(r, kHz, in_mm());
                        EXPECT_TRUE(r.warnings.empty()) << r.warnings[0].text;
                        EXPECT_EQ(r.line, 15);
                    }
                }
            }
        }
    }
}

TEST(UniversalFile, may_hold_what_its_binary_numbers_look_like) {
    Dataset58 d = receptance();
    d.bytes = Bytes::little;
    d.type = 6;
    // The end of a dataset.
    d.rows[0] = {std::bit_cast<double>(std::array<char, 8>{'\n', ' ', '-', '1', '\n', 0, 0, 0}), -1e-9};
    EXPECT_EQ(good(written(d)).frequency_hz.size(), 3u);
}

TEST(UniversalFile, is_read_as_a_writer_of_Python_lays_it_out) {
    const auto r = good(
        "    -1\r\n   164\r\n         1SI: Meter (newton)           2\r\n"
        "  1.00000000000000000e+00  1.00000000000000000e+00  1.00000000000000000e+00\r\n"
        "  0.00000000000000000e+00\r\n    -1\r\n"
        "    -1\r\n    58\r\nNONE\r\nNONE\r\n24-Nov-24 10:00:00\r\nNONE\r\nNONE\r\n"
        "    4         0    0         0       NONE         5  -1       NONE         5   1\r\n"
        "         5         2         1  1.00000e+02  5.00000e-01  0.00000e+00\r\n"
        "        18    0    0    0                 NONE                 NONE\r\n"
        "        12    0    0    0                 NONE                 NONE\r\n"
        "        13    0    0    0                 NONE                 NONE\r\n"
        "         0    0    0    0                 NONE                 NONE\r\n"
        "  1.00000e+00  2.00000e+00 -1.00000e+00  5.00000e-01\r\n    -1\r\n");
    const double w = 2 * math::kPi * 100, v = 2 * math::kPi * 100.5;
    // Against each other: the sign is turned; an acceleration is -w^2 times the displacement.
    expect_points(r, {100, 100.5}, {1e3 * Complex(1, 2) / (w * w), 1e3 * Complex(-1, 0.5) / (v * v)});
    EXPECT_EQ(r.derivatives, 2);
    EXPECT_EQ(r.description, "accelerance, dataset 58, response at node 5 -x to a force at node 5 +x");
}

TEST(UniversalFile, is_read_with_numbers_that_touch_and_exponents_without_a_letter) {
    const std::string head =
        "    -1\n    58\n\n\n\n\n\n"
        "    4         0    0         0 tip                1   3 tip                1   3\n"
        "         6         2         0  0.00000D+00  0.00000D+00  0.00000D+00\n"
        "        18    0    0    0 Frequency            Hz\n"
        "         8    0    0    0 Displacement         m\n"
        "        13    0    0    0 Force                N\n"
        "         0\n";
    const auto r = good(head +
                        "  1.00000D+02 -1.250000000000E-06-2.500000000000E-07\n"
                        "  1.10000D+02  1.000000000000-101 0.000000000000E+00\n");
    expect_points(r, {100, 110}, {{-1.25e-3, -2.5e-4}, {1e-98, 0}});
}

TEST(UniversalFile, counts_in_the_units_of_dataset_164) {
    Dataset58 d = receptance();
    d.numerator_unit = "mm";
    d.denominator_unit = "N";
    const auto r = good(kMillimetres164 + written(d));
    expect_points(r, kHz, in_mm(1));
    EXPECT_TRUE(r.warnings.empty());
    // Also where it stands behind.
    expect_points(good(written(d) + kMillimetres164), kHz, in_mm(1));
    // Pounds and feet: 1 / 3.28 m over 1 / 0.2248 N.
    const auto feet = good(
        "    -1\n   164\n         2Foot (pound f)               2\n"
        "  3.28083989501312334D+00  2.24808943099710480D-01  1.79999999999999999D+00\n"
        "  4.59670000000000002D+02\n    -1\n" +
        written(receptance()));
    expect_points(feet, kHz, in_mm(304.8 * 0.224808943099710480));
}

TEST(UniversalFile, says_what_it_takes_from_labels) {
    struct Case {
        const char *label, *unit, *force;
        int numerator;
        double factor;
        int derivatives;
        const char* warning;
    };
    for (const Case& c : {Case{"NONE", "mm", "N", 8, 1, 0, "the numbers are taken to be in 'mm' over 'N'"},
                          Case{"NONE", "in", "lbf", 8, 25.4 / 4.4482216152605, 0, "'in' over 'lbf'"},
                          Case{"Acceleration", "m/s\xB2", "N", 0, 1e3, 2, "it is taken as accelerance"},
                          Case{"NONE", "(m/s\xC2\xB2)/N", "NONE", 1, 1e3, 2, "accelerance"},
                          Case{"Mobility", "NONE", "NONE", 0, 1e3, 1, "mobility"},
                          Case{"Compliance", "NONE", "NONE", 0, 1e3, 0, "receptance"},
                          Case{"NONE", "g", "N", 12, 9806.65, 2, "'g' over 'N'"}}) {
        Dataset58 d = receptance();
        d.numerator = c.numerator;
        d.denominator = c.numerator > 1 ? 13 : 0;
        d.numerator_label = c.label;
        d.numerator_unit = c.unit;
        d.denominator_unit = c.force;
        SCOPED_TRACE(c.unit);
        const auto r = good(written(d));
        EXPECT_EQ(r.derivatives, c.derivatives);
        const double w = std::pow(2 * math::kPi * kHz[1], c.derivatives);
        EXPECT_NEAR(std::abs(r.receptance_mm_per_n[1]), c.factor * std::abs(kReceptance[1]) / w,
                    1e-6 * c.factor * std::abs(kReceptance[1]) / w);
        ASSERT_EQ(r.warnings.size(), 1u);
        EXPECT_NE(r.warnings[0].text.find(c.warning), std::string::npos) << r.warnings[0].text;
        // The call may say it instead.
        const auto said = good(written(d), {.source_name = "a.uff", .unit = &kResponseUnits[2]});
        expect_points(said, kHz, in_mm(1e-3));
        EXPECT_TRUE(said.warnings.empty());
    }
    // The units of the file count more than a label.
    Dataset58 d = receptance();
    d.numerator_unit = "um";
    const auto r = good(kMillimetres164 + written(d));
    expect_points(r, kHz, in_mm(1));
    ASSERT_EQ(r.warnings.size(), 1u);
    EXPECT_NE(r.warnings[0].text.find("these count"), std::string::npos);
}

TEST(UniversalFile, loses_what_lies_at_0_Hz_of_a_mobility) {
    Dataset58 d = receptance();
    d.numerator = 11;
    d.first = 0;
    const auto r = good(written(d));
    const Complex w(0, 2 * math::kPi * 2), v(0, 2 * math::kPi * 4);
    expect_points(r, {2, 4}, {1e3 * kReceptance[1] / w, 1e3 * kReceptance[2] / v});
}

TEST(UniversalFile, gives_the_driving_point_of_the_direction) {
    Dataset58 time = receptance(), coherence = receptance(), transfer = receptance(), x = receptance(),
              y = receptance(), transmissibility = receptance();
    time.kind = 1;
    time.type = 2;
    time.abscissa = 17;
    for (auto& row : time.rows) row.pop_back();
    coherence.kind = 6;
    coherence.type = 2;
    for (auto& row : coherence.rows) row.pop_back();
    transfer.response_node = 2;
    y.response_direction = y.reference_direction = -2;
    y.rows[0][0] = 7e-6;
    transmissibility.denominator = 12;
    const std::string all = written(time) + written(coherence) + written(transmissibility) +
                            written(transfer) + written(x) + written(y);
    const auto first_of = [&](const std::string& bytes, std::optional<Vec3> direction) {
        return good(bytes, {.source_name = "a.uff", .direction = direction});
    };
    const auto along_x = first_of(all, Vec3{2, 0.1, 0}), along_y = first_of(all, Vec3{0, 1, 0});
    EXPECT_NEAR(along_x.receptance_mm_per_n[0].real(), 1.5e-3, 1e-9);
    EXPECT_NEAR(along_y.receptance_mm_per_n[0].real(), 7e-3, 1e-9);
    EXPECT_TRUE(along_x.warnings.empty());
    EXPECT_TRUE(along_y.warnings.empty());
    // None fits, or none is asked for: the first, and why.
    const auto along_z = first_of(all, Vec3{0, 0, 1});
    EXPECT_NEAR(along_z.receptance_mm_per_n[0].real(), 1.5e-3, 1e-9);
    ASSERT_EQ(along_z.warnings.size(), 2u);
    EXPECT_NE(along_z.warnings[0].text.find("of 2 driving points the first is taken"), std::string::npos);
    EXPECT_NE(along_z.warnings[1].text.find("the file says +x"), std::string::npos);
    EXPECT_EQ(first_of(all, {}).warnings.size(), 1u);
    // Not a driving point by its names, but alone.
    const auto alone = first_of(written(time) + written(transfer), Vec3{1, 0, 0});
    ASSERT_EQ(alone.warnings.size(), 1u);
    EXPECT_EQ(alone.warnings[0].text,
              "the response at node 2 +x to a force at node 1 +x is taken as that of a driving point");
}

// The text up to a line, and what follows instead.
std::string with_line(std::string text, int line, const std::string& instead) {
    std::size_t at = 0;
    for (int n = 1; n < line; ++n) at = text.find('\n', at) + 1;
    return text.replace(at, text.find('\n', at) - at, instead);
}

TEST(UniversalFile, is_refused_with_its_place_where_it_is_damaged) {
    const std::string text = written(receptance());
    Dataset58 binary = receptance(), time = receptance(), uneven = receptance(false), unknown = receptance(),
              real = receptance(), other = receptance(), huge = receptance(), falling = receptance(),
              not_finite = receptance(), transfer = receptance();
    binary.bytes = not_finite.bytes = huge.bytes = Bytes::big;
    not_finite.rows[1][1] = std::numeric_limits<double>::quiet_NaN();
    time.kind = 1;
    time.abscissa = 17;
    uneven.rows[2][0] = 12;
    unknown.numerator = unknown.denominator = 0;
    other = unknown;
    other.numerator_label = "Receptance";
    other.numerator_unit = "m/s2";
    real.type = 2;
    for (auto& row : real.rows) row.pop_back();
    huge.points = 99'999'999;
    falling.step = -4;
    transfer.response_node = 2;
    Dataset58 endless = receptance();
    endless.points = 200'000'000;
    Dataset58 many = receptance();
    many.points = 900'000;
    const Refusal refusals[] = {
        {"    -1\n", 1, 1, "no column frequency_hz"},
        {kNodes15, 0, 0, "no dataset 58"},
        {kNodes15 + "nonsense\n", 5, 0, "a dataset begins with a line -1"},
        {kNodes15 + "    -1\n\n", 6, 0, "a dataset has no number"},
        {"    -1\n    58\n", 2, 0, "ends inside dataset 58"},
        {text.substr(0, 300), 11, 0, "ends inside dataset 58"},
        {with_line(text, 8, "  4 what"), 8, 0, "the kind of the function"},
        {with_line(text, 9, "         7         3         1"), 9, 0, "none of 2, 4, 5 and 6"},
        {with_line(text, 9, "         5        -3         1"), 9, 0, "is no count"},
        {with_line(text, 14, "  nan 1 2 3"), 14, 3, "not a number"},
        {with_line(text, 14, "  1E999 1 2 3"), 14, 3, "not a number"},
        {with_line(text, 14, "1 2 3 4 5"), 14, 0, "ends after 5 of the 6 numbers"},
        {with_line(text, 14, "1 2 3 4 5 6 7"), 14, 13, "more numbers than the 6 of the dataset's 3 points"},
        {written(time), 1, 0, "but 1 time responses"},
        {written(real), 1, 0, "but 1 frequency responses without phases"},
        {written(unknown), 1, 0, "does not say what the response is"},
        {written(other), 1, 0, "called 'Receptance' and has the unit 'm/s2'"},
        {written(uneven), 1, 0, "not above the one before at point 3"},
        {written(falling), 1, 0, "not above the one before at point 2"},
        {written(huge), 13, 0, "dataset 58b says 24 bytes, and its 99999999 points need 799999992"},
        {written(endless), 9, 0, "is no count"},
        {written(many), 14, 0, "ends after 6 of the 1800000 numbers"},
        {written(not_finite), 1, 0, "number 4 of the dataset is not finite"},
        {written(binary).substr(0, written(binary).size() - 20), 13, 0, "the file ends inside dataset 58b"},
        {with_line(written(binary), 2, "    58b     3     2          11          24"), 13, 0,
         "the order of its bytes"},
        {with_line(written(binary), 2, "    58b     1     1          11          24"), 13, 0, "IEEE 754"},
        {with_line(written(binary), 2, "    58b     1     2          11          23"), 13, 0,
         "says 23 bytes"},
        {written(transfer) + written(transfer), 1, 0,
         "none of the 2 frequency responses is of a driving point"},
        {with_line(kMillimetres164, 4, "0 0 0") + text, 4, 0, "no factors of length and force"},
        {"    -1\n   164\n", 2, 0, "ends inside dataset 164"},
    };
    expect_refused(refusals, [](const std::string& bytes, const char* name) {
        return read_frequency_response(bytes, {.source_name = name});
    });
}

TEST(UniversalFile, is_told_by_its_first_lines) {
    EXPECT_TRUE(looks_like_response(kNodes15));
    EXPECT_TRUE(looks_like_response("\n    -1\n    58b     1     2\n"));
    EXPECT_TRUE(looks_like_response(kHeader));
    EXPECT_TRUE(looks_like_response("\xEF\xBB\xBF# note\nfrequency_hz,re\n"));
    for (const char* other :
         {"", "\n", "    -1\n", "    -1\nG0 X1\n", "G0 X1\n", "x,y,z,i,j,k\n", "solid a\n"})
        EXPECT_FALSE(looks_like_response(other)) << other;
}

}  // namespace
}  // namespace tribo::readers
