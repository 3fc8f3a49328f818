// SPDX-License-Identifier: MIT
// Walks the tables of words in docs/machines.md: each row has samples in control_words.txt that hold every
// word of its first cell, and each sample comes out as it says.
#include <cctype>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "places.hpp"
#include "readers/apt/reader.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/siemens/reader.hpp"

namespace tribo::readers {
namespace {

struct Sample {
    int line = 0;
    bool is_fanuc = false;
    std::string outcome;   // ok, said, no
    std::string fragment;  // of the warning or refusal
    std::string text;
    bool is_whole = false;
};
struct Row {
    std::string begin;  // of its first cell
    std::vector<Sample> samples;
};
using Tables = std::map<std::string, std::vector<Row>>;  // by a part of the heading

std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::string unescaped(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size()) {
            out += text[++i] == 'n' ? '\n' : text[i];
        } else {
            out += text[i];
        }
    }
    return out;
}

Tables read_samples(const std::filesystem::path& path) {
    Tables tables;
    std::vector<Row>* table = nullptr;
    int number = 0;
    for (const std::string& line : lines_of(path)) {
        ++number;
        if (line.starts_with("== ")) {
            table = &tables[line.substr(3)];
        } else if (line.starts_with("@ ")) {
            table->push_back({line.substr(2), {}});
        } else if (const std::size_t bar = line.find(" |"); table != nullptr && bar != std::string::npos) {
            Sample sample;
            sample.line = number;
            const std::size_t blank = std::min(line.find(' '), bar);
            sample.outcome = line.substr(0, blank);
            if (blank < bar) sample.fragment = line.substr(blank + 1, bar - blank - 1);
            const std::string marks = line.substr(bar + 2, line.find(' ', bar + 2) - bar - 2);
            sample.is_fanuc = marks.find('F') != std::string::npos;
            sample.is_whole = marks.find('!') != std::string::npos;
            sample.text = unescaped(line.substr(line.find(' ', bar + 2) + 1)) + "\n";
            table->back().samples.push_back(sample);
        }
    }
    return tables;
}

// First cells of the rows of each table, by the part of the heading that samples name.
std::map<std::string, std::vector<std::string>> read_cells(const std::filesystem::path& path,
                                                           const Tables& tables) {
    std::map<std::string, std::vector<std::string>> cells;
    std::string heading;
    for (const std::string& line : lines_of(path)) {
        if (line.starts_with("## ")) heading = line;
        if (!line.starts_with("| ") || line.starts_with("| word")) continue;
        for (const auto& [name, rows] : tables) {
            if (heading.find(name) != std::string::npos)
                cells[name].push_back(line.substr(2, line.find(" | ") - 2));
        }
    }
    return cells;
}

// Words of two characters or more in capitals.
std::set<std::string> words_of(const std::string& cell) {
    std::set<std::string> words;
    std::string word;
    for (const char c : cell + " ") {
        if (std::isupper(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) ||
            c == '.' || c == '_' || (std::islower(static_cast<unsigned char>(c)) && !word.empty())) {
            word += c;
            continue;
        }
        while (word.ends_with('.')) word.pop_back();
        bool is_word = word.size() > 1 && std::isupper(static_cast<unsigned char>(word[0]));
        for (const char w : word) is_word = is_word && !std::islower(static_cast<unsigned char>(w));
        if (is_word) words.insert(word);
        word.clear();
    }
    return words;
}

Result<motion::Program> run(const std::string& table, const Sample& sample) {
    GcodeOptions options;
    options.source_name = "sample";
    options.dialect = sample.is_fanuc ? GcodeDialect::fanuc : GcodeDialect::linuxcnc;
    const auto text = [&](const char* start) { return (sample.is_whole ? "" : start) + sample.text; };
    if (table == "Heidenhain") {
        return read_heidenhain(text("0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S9 F9\n2 L X+0 Y+0 Z+5 R0 FMAX M3\n"),
                               options);
    }
    if (table == "Siemens") {
        return read_siemens(text("G71 G90 G17 F100 S100 M3\nG0 X0 Y0 Z0\n"), options);
    }
    if (table == "APT CLDATA")
        return read_apt(text("UNITS/MM\nFEDRAT/100\nGOTO/0,0,0\n"), {.source_name = "sample"});
    return read_gcode(text("G21 G90 M3 S1000 F100\nG0 X0 Y0 Z5\n"), options);
}

void expect_outcome(const std::string& table, const Sample& sample) {
    const std::string where = "control_words.txt:" + std::to_string(sample.line) + ": ";
    const auto program = run(table, sample);
    if (sample.outcome == "no") {
        ASSERT_FALSE(program.has_value()) << where << "is read";
        EXPECT_NE(program.error().text().find(sample.fragment), std::string::npos)
            << where << program.error().text();
        return;
    }
    ASSERT_TRUE(program.has_value()) << where << program.error().text();
    if (sample.outcome == "ok") return;
    std::string warnings;
    for (const Warning& warning : program->warnings) warnings += warning.text + "\n";
    EXPECT_NE(warnings.find(sample.fragment), std::string::npos) << where << "is not said; but:\n"
                                                                 << warnings;
}

TEST(WordTables, say_what_happens_to_each_word) {
    const std::filesystem::path root = TRIBO_SOURCE_DIR;
    const Tables tables = read_samples(root / "tests/readers/control_words.txt");
    ASSERT_EQ(tables.size(), 4U);
    const auto cells = read_cells(root / "docs/machines.md", tables);
    for (const auto& [name, rows] : tables) {
        ASSERT_TRUE(cells.contains(name)) << name;
        ASSERT_EQ(rows.size(), cells.at(name).size()) << name;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::string& cell = cells.at(name)[i];
            ASSERT_TRUE(cell.starts_with(rows[i].begin))
                << name << ": " << cell << "\nis not: " << rows[i].begin;
            EXPECT_FALSE(rows[i].samples.empty()) << cell;
            std::string all;
            for (const Sample& sample : rows[i].samples) {
                all += sample.text;
                expect_outcome(name, sample);
            }
            for (const std::string& word : words_of(cell)) {
                EXPECT_NE(all.find(word), std::string::npos)
                    << name << ": no sample of " << word << " in " << cell;
            }
        }
    }
}

}  // namespace
}  // namespace tribo::readers
