// SPDX-License-Identifier: MIT
// The variables of a program: R parameters, and those of DEF and PROC by their names.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tribo::readers::siemens {

// A number (REAL, INT, BOOL, CHAR), or a text (STRING, and the name of an AXIS).
using Value = std::variant<double, std::string>;

enum class Type { real, whole, text };

struct Variable {
    Type type = Type::real;
    std::array<std::size_t, 2> sizes{1, 1};  // of an array
    std::vector<Value> values{Value{0.0}};
};

class Variables {
  public:
    static constexpr int kMostR = 10'000;  // R0 to R9999

    double r(int number) {
        const auto found = r_.find(number);
        if (found != r_.end()) return found->second;
        if (unset_r_.size() < kMostUnset && unset_r_.insert(number).second) read_unset_r_.push_back(number);
        return 0;
    }
    // Returns the R parameters without a value that were read since the last call, each once.
    std::vector<int> take_unset_r() { return std::exchange(read_unset_r_, {}); }
    void set_r(int number, double value) { r_[number] = value; }

    // Names are in upper case. The innermost program's come first; null: there is none.
    Variable* find(const std::string& name) {
        for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
            if (const auto found = level->find(name); found != level->end()) return &found->second;
        }
        return nullptr;
    }
    // As find(), without the innermost program's own.
    const Variable* find_of_caller(const std::string& name) const {
        for (auto level = std::next(levels_.rbegin()); level != levels_.rend(); ++level) {
            if (const auto found = level->find(name); found != level->end()) return &found->second;
        }
        return nullptr;
    }
    // Makes a variable of the innermost program. Returns false if the variables hold too much then.
    bool define(const std::string& name, Variable variable) {
        const auto [place, is_new] = levels_.back().try_emplace(name);
        if (!is_new) elements_ -= place->second.values.size();
        elements_ += variable.values.size();
        place->second = std::move(variable);
        return elements_ <= kMostElements;
    }
    // A program begins and ends.
    void enter() { levels_.emplace_back(); }
    void leave() {
        for (const auto& [name, variable] : levels_.back()) elements_ -= variable.values.size();
        levels_.pop_back();
    }

  private:
    static constexpr std::size_t kMostElements = 1'000'000;

    static constexpr std::size_t kMostUnset = 1000;

    std::map<int, double> r_;
    std::set<int> unset_r_;  // and read
    std::vector<int> read_unset_r_;
    std::vector<std::map<std::string, Variable>> levels_{1};
    std::size_t elements_ = 0;
};

}  // namespace tribo::readers::siemens
