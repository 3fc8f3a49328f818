// SPDX-License-Identifier: MIT
// Reads every source of the repository and fails on what CONTRIBUTING.md forbids; tries the rules themselves
// on made-up sources first.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

#include "house/house_rules.hpp"
#include "places.hpp"

namespace tribo::house {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = TRIBO_SOURCE_DIR;

std::string read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

template <class Rule>
void expect_no_complaints(Rule rule) {
    int files = 0;
    for (const char* top : {"src", "tests", "fuzz", "bench"}) {
        if (!fs::exists(kRoot / top)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
            const fs::path& path = entry.path();
            const fs::path kind = path.extension();
            if (kind != ".cpp" && kind != ".hpp" && kind != ".inl") continue;
            ++files;
            for (const std::string& complaint :
                 rule(path.lexically_relative(kRoot).generic_string(), read(path)))
                ADD_FAILURE() << complaint;
        }
    }
    EXPECT_GT(files, 40);
}

TEST(House, rooms_include_only_what_the_table_allows) {
    expect_no_complaints(include_complaints);
}

TEST(House, rooms_that_are_hashed_use_nothing_that_differs_between_systems) {
    expect_no_complaints(same_bits_complaints);
}

TEST(House, sources_keep_the_form) {
    expect_no_complaints(form_complaints);
}

TEST(House, helpers_of_neighbours_have_names_of_their_own) {
    // The same kernel twice; sources that are compiled alone.
    static const std::regex alone(R"(.*_(sse2|v3)\.cpp|.*/src/(wasm|devices)/.*)");
    std::map<fs::path, std::map<std::string, std::string>> folders;  // the source of each name
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "src")) {
        const std::string path = entry.path().generic_string();
        if (entry.path().extension() != ".cpp" || std::regex_match(path, alone)) continue;
        for (const std::string& name : helpers_of(read(entry.path()))) {
            const auto [first, is_new] = folders[entry.path().parent_path()].emplace(name, path);
            EXPECT_TRUE(is_new) << name << " stands in " << first->second << " and in " << path
                                << ": write it once, or name it by what it is for";
        }
    }
    EXPECT_GT(folders.size(), 40u);
}

TEST(House, the_table_of_the_readme_is_the_one_that_is_checked) {
    const std::string readme = read(kRoot / "README.md");
    std::size_t at = 0;
    for (const Room& room : rooms()) {
        const std::string start = "\n| `" + room.name + "/` |";
        const std::size_t row = readme.find(start);
        ASSERT_NE(row, std::string::npos) << room.name;
        EXPECT_GE(row, at) << room.name << "/ stands out of order";
        at = row;
        const std::string line = readme.substr(row + 1, readme.find('\n', row + 1) - row - 1);
        EXPECT_TRUE(line.ends_with("| " + room.table_entry + " |")) << line;
    }
    for (const auto& entry : fs::directory_iterator(kRoot / "src")) {
        const std::string row = "| `" + entry.path().filename().string() + "/` |";
        EXPECT_TRUE(!entry.is_directory() || readme.find(row) != std::string::npos) << row;
    }
}

// What is installed can be used: a public header includes public headers alone, and is there.
// What the comment of a public header shows is what tests/package compiles.
TEST(House, examples_in_public_headers_are_lines_of_the_example_programs) {
    const auto trimmed = [](std::string_view line) {
        const std::size_t begin = std::min(line.find_first_not_of(" /"), line.size());
        return std::string(line.substr(begin));
    };
    std::set<std::string> known;
    for (const char* program : {"mill.cpp", "touch.cpp", "hand.cpp"}) {
        std::ifstream file(std::string(TRIBO_SOURCE_DIR "/examples/source/") + program);
        ASSERT_TRUE(file) << program;
        for (std::string line; std::getline(file, line);) known.insert(trimmed(line));
    }
    for (const char* header : {"mill.hpp", "sound.hpp", "touch.hpp"}) {
        std::ifstream file(std::string(TRIBO_SOURCE_DIR "/src/tribo/") + header);
        ASSERT_TRUE(file) << header;
        int shown = 0;
        for (std::string line; std::getline(file, line);) {
            if (!line.starts_with("//     ")) continue;
            ++shown;
            EXPECT_TRUE(known.contains(trimmed(line))) << header << ": " << line;
        }
        EXPECT_GT(shown, 0) << header;
    }
}

TEST(House, public_headers_include_only_public_headers) {
    const std::string list = read(kRoot / "cmake/public_headers.cmake");
    static const std::regex entry(R"re(\n +([a-z_0-9/]+\.(hpp|h)))re");
    static const std::regex include(R"re(#include "([^"]+)")re");
    std::set<std::string> headers;
    for (std::sregex_iterator it(list.begin(), list.end(), entry), end; it != end; ++it)
        headers.insert((*it)[1]);
    ASSERT_GT(headers.size(), 20u);
    for (const std::string& header : headers) {
        ASSERT_TRUE(fs::exists(kRoot / "src" / header)) << header;
        const std::string text = read(kRoot / "src" / header);
        for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it)
            EXPECT_TRUE(headers.contains((*it)[1])) << header << " includes " << (*it)[1];
    }
}

// The version stands in CMakeLists.txt; what else must say it says the same.
TEST(House, the_version_is_one) {
    std::smatch found;
    const std::string cmake = read(kRoot / "CMakeLists.txt");
    ASSERT_TRUE(std::regex_search(cmake, found, std::regex(R"(project\(tribo VERSION ([0-9.]+) )")));
    const std::string version = found[1];
    EXPECT_NE(read(kRoot / "web/touch/package.json").find("\"version\": \"" + version + "\""),
              std::string::npos);
    EXPECT_NE(read(kRoot / "CHANGELOG.md").find("## " + version), std::string::npos);
}

// Every library that the program or the pages are made with stands in NOTICE with its licence.
TEST(House, the_notice_names_what_is_linked_and_bundled) {
    const std::string notice = read(kRoot / "NOTICE");
    const std::map<std::string, std::string> libraries{
        {"libtbb-dev", "oneTBB"},
        {"libcli11-dev", "CLI11"},
        {"libtomlplusplus-dev", "toml++"},
        {"nlohmann-json3-dev", "JSON for Modern C++"},
        {"libtinygltf-dev", "tinygltf"},
        {"libsndfile1-dev", "libsndfile"},
        {"libmysofa-dev", "libmysofa"},
        {"librtaudio-dev", "RtAudio"},
        {"libboost-dev", "Boost"},
        {"libssl-dev", "OpenSSL"},
        {"zlib1g-dev", "zlib"},
        {"libsqlite3-dev", "SQLite"},
        {"libpng-dev", "libpng"},
        {"libjpeg62-turbo-dev", "libjpeg-turbo"},
        {"wasi-libc", "wasi-libc"},
        {"libc++-19-dev-wasm32", "libc++"},
        {"libc++abi-19-dev-wasm32", "libc++"},
        {"libclang-rt-19-dev-wasm32", "compiler-rt"},
        {"libclang-rt-19-dev", "compiler-rt"},
        {"\"three\"", "three.js"},
        {"\"uplot\"", "uPlot"},
    };
    std::istringstream packages(read(kRoot / "packages.txt"));
    std::string line, section;
    while (std::getline(packages, line)) {
        if (line.starts_with("[")) section = line;
        const bool library = line.ends_with("-dev") || line.ends_with("-wasm32") || line == "wasi-libc";
        if (section != "[run]" || !library) continue;
        ASSERT_TRUE(libraries.contains(line)) << line << ": name it in NOTICE and here";
        EXPECT_NE(notice.find(libraries.at(line)), std::string::npos) << line;
    }
    const std::string page = read(kRoot / "web/mill/package.json");
    const std::size_t at = page.find("\"dependencies\"");
    ASSERT_NE(at, std::string::npos);
    const std::string bundled = page.substr(at, page.find('}', at) - at);
    static const std::regex name(R"re("([^"@]+)": "[^"]*[0-9])re");
    for (std::sregex_iterator it(bundled.begin(), bundled.end(), name), end; it != end; ++it) {
        const std::string quoted = "\"" + (*it)[1].str() + "\"";
        ASSERT_TRUE(libraries.contains(quoted)) << quoted << ": name it in NOTICE and here";
        EXPECT_NE(notice.find(libraries.at(quoted)), std::string::npos) << quoted;
    }
}

TEST(House, rooms_include_only_rooms_above_them) {
    std::set<std::string> above;
    for (const Room& room : rooms()) {
        for (const std::string& other : room.may_include)
            EXPECT_TRUE(above.contains(other)) << room.name << " " << other;
        above.insert(room.name);
    }
}

TEST(HouseRules, an_edge_that_is_not_in_the_table_is_found) {
    EXPECT_EQ(include_complaints("src/field/a.cpp", "#include \"base/vec3.hpp\"\n#include \"field/b.hpp\"\n")
                  .size(),
              0u);
    EXPECT_EQ(include_complaints("src/field/a.cpp", "\n#include \"files/files.hpp\"\n"),
              std::vector<std::string>{"src/field/a.cpp:2: field/ may not include files/"});
    EXPECT_EQ(include_complaints("src/base/a.cpp", "#  include \"contact/x.hpp\"").size(), 1u);
    EXPECT_EQ(include_complaints("src/files/a.cpp", "#include \"session/mill.hpp\"").size(), 1u);
    EXPECT_EQ(include_complaints("src/app/a.cpp", "#include \"session/mill.hpp\"").size(), 0u);
    EXPECT_EQ(include_complaints("src/cellar/a.cpp", "").size(), 1u);
}

TEST(HouseRules, a_header_named_from_where_its_reader_stands_is_found) {
    EXPECT_EQ(include_complaints("src/field/a.cpp", "#include \"../base/vec3.hpp\"").size(), 1u);
    EXPECT_EQ(include_complaints("src/field/a.cpp", "#include \"shape.hpp\"").size(), 1u);
}

TEST(HouseRules, what_differs_between_systems_is_found_in_hashed_rooms_alone) {
    for (const char* code :
         {"x = std::sin(y);", "std::pow (x, 2)", "std::atan2(y, x)", "std::log10(x)", "std::acosh(x)",
          "std::unordered_map<int, int> m;", "std::normal_distribution<> d;", "std::thread t;", "throw 1;",
          "#include <iostream>", "std::stod(text)"}) {
        EXPECT_EQ(same_bits_complaints("src/milling/a.cpp", code).size(), 1u) << code;
        EXPECT_EQ(same_bits_complaints("src/files/a.cpp", code).size(), 0u) << code;
    }
    for (const char* code : {"math::sin(x)", "std::sqrt(x)", "std::abs(x)", "// std::sin(x) differs",
                             "retry(x)", "fail(\"bad\", \"try another\")", "'\"', x // catch", "std::logic"})
        EXPECT_EQ(same_bits_complaints("src/milling/a.cpp", code).size(), 0u) << code;
}

TEST(HouseRules, functions_of_the_unnamed_namespace_are_helpers) {
    const std::set<std::string> found = helpers_of(
        "int out() {\n}\nnamespace {\nint a(int x) {\n    return b(x);\n}\ntemplate <class "
        "T>\nstd::vector<T>& c() {\n"
        "}  // namespace\nvoid d() {\n");
    EXPECT_EQ(found, (std::set<std::string>{"a", "c"}));
}

TEST(HouseRules, sources_without_licence_guard_or_end_are_found) {
    const std::string licence = "// SPDX-License-Identifier: MIT\n";
    EXPECT_EQ(form_complaints("src/base/a.cpp", licence).size(), 0u);
    EXPECT_EQ(form_complaints("src/base/a.cpp", "int x;\n").size(), 1u);
    EXPECT_EQ(form_complaints("src/base/a.hpp", licence).size(), 1u);
    EXPECT_EQ(form_complaints("src/base/a.hpp", licence + "#pragma once\n").size(), 0u);
    EXPECT_EQ(form_complaints("src/base/a.cpp", licence + "// TO"
                                                          "DO: the rest\n")
                  .size(),
              1u);
    EXPECT_EQ(form_complaints("src/base/a.cpp", licence + std::string(600, '\n')).size(), 1u);
}

}  // namespace
}  // namespace tribo::house
