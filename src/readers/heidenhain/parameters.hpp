// SPDX-License-Identifier: MIT
// The Q parameters of a conversational program: Q0 to Q1999, QL and QR 0 to 499, and the texts QS.
#pragma once

#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tribo::readers::heidenhain {

// Indices: Q0 is 0, QL0 is kLocal, QR0 is kRemanent.
inline constexpr int kLocal = 2000, kRemanent = 2500, kParameters = 3000;
inline constexpr int kRadiusParameter = 108;  // the control sets Q108 to the radius of the tool

class Parameters {
  public:
    static bool has(int index) { return index >= 0 && index < kParameters; }
    double get(int index) const { return values_[static_cast<std::size_t>(index)]; }
    void set(int index, double value) {
        values_[static_cast<std::size_t>(index)] = value;
        unknown_.reset(static_cast<std::size_t>(index));
        set_.set(static_cast<std::size_t>(index));
    }
    // Marks a value that only the machine knows.
    void forget(int index) { unknown_.set(static_cast<std::size_t>(index)); }
    bool knows(int index) const { return !unknown_[static_cast<std::size_t>(index)]; }
    // Call it where the program reads a value. Keeps the parameters that hold none, each once.
    void note_read(int index) const {
        const auto n = static_cast<std::size_t>(index);
        if (set_[n] || unset_[n]) return;
        unset_.set(n);
        read_unset_.push_back(index);
    }
    // Returns the parameters without a value that were read since the last call.
    std::vector<int> take_unset() const { return std::exchange(read_unset_, {}); }

    static std::string name(int index) {
        return index >= kRemanent ? "QR" + std::to_string(index - kRemanent)
               : index >= kLocal  ? "QL" + std::to_string(index - kLocal)
                                  : "Q" + std::to_string(index);
    }

    std::map<int, std::string> texts;  // QS

  private:
    std::array<double, kParameters> values_{};
    std::bitset<kParameters> unknown_, set_;
    mutable std::bitset<kParameters> unset_;  // and read
    mutable std::vector<int> read_unset_;
};

}  // namespace tribo::readers::heidenhain
