// SPDX-License-Identifier: MIT
#include "material/voice_numbers.hpp"

#include "material/material_schema.hpp"

namespace tribo::material {
namespace {

class NumberReader {
  public:
    static constexpr bool kReads = true;

    NumberReader(std::span<const double> numbers, Refusal& refusal) : left_(numbers), refusal_(refusal) {}

    void number(const char* key, double& value, const Range& range, std::optional<Absent> = {}) {
        value = next(key, range.min, range.max, range.above);
    }
    [[gnu::noinline]] void numbers(const char* key, std::vector<double>& values, const Range& range,
                                   std::size_t most) {
        for (std::size_t n = count(key, most); n > 0; --n) {
            values.push_back(next(key, range.min, range.max, range.above));
        }
    }
    void tables(const char* key, std::vector<std::vector<double>>& tables, const Range& range,
                std::size_t most) {
        for (std::size_t n = count(key, most); n > 0; --n) {
            numbers(key, tables.emplace_back(), range, kLongestTable);
        }
    }
    template <class T>
    bool object(const char* key, T& value, bool) {
        if (count(key, 1) == 0) return false;
        describe(*this, value);
        return true;
    }
    template <class T>
    void object(const char* key, std::optional<T>& value) {
        if (count(key, 1) > 0) describe(*this, value.emplace());
    }
    template <class Item>
    void objects(const char* key, std::size_t most, std::size_t, const Item& item) {
        const std::size_t all = count(key, most);
        for (std::size_t n = 0; n < all && good_; ++n) {
            expect(count(key, 1) == 1, key, "has an entry that is no object", "");
            item(*this, n);
        }
    }
    template <class Part>
    void unheard(const Part&) {}
    [[gnu::noinline]] void expect(bool holds, const char* key, const char* cause, const char*) {
        if (holds || !good_) return;
        good_ = false;
        refusal_ = {key, cause};
    }

    bool good() const { return good_; }
    bool at_end() const { return left_.empty(); }

  private:
    // Returns a value in range even after an error: the caller continues and checks at the end. Single
    // numbers instead of a Range give less code.
    [[gnu::noinline]] double next(const char* key, double min, double max, bool above) {
        expect(!left_.empty(), key, "is missing", "");
        if (!good_) return max;
        const double value = left_.front();
        left_ = left_.subspan(1);
        expect(Range{min, max, above}.contains(value), key, "is out of range", "");
        return good_ ? value : max;
    }
    std::size_t count(const char* key, std::size_t most) {
        const double value = next(key, 0, static_cast<double>(most), false);
        return good_ ? static_cast<std::size_t>(value) : 0;
    }

    std::span<const double> left_;
    Refusal& refusal_;
    bool good_ = true;
};

}  // namespace

std::optional<noise::MaterialVoices> voices_of(std::span<const double> numbers, Refusal& refusal) {
    NumberReader reader(numbers, refusal);
    noise::MaterialVoices voices;
    describe(reader, voices, nullptr);
    reader.expect(!voices.models.empty(), "voices", "are none", "");
    reader.expect(reader.at_end(), "voices", "are followed by more", "");
    if (!reader.good()) return std::nullopt;
    return voices;
}

}  // namespace tribo::material
