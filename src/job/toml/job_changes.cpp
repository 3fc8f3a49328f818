// SPDX-License-Identifier: MIT
#include "job/toml/job_changes.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tribo::job {
namespace {

std::vector<std::string_view> parts_of(std::string_view key) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t dot = key.find('.');
        parts.push_back(key.substr(0, dot));
        if (dot == std::string_view::npos) return parts;
        key.remove_prefix(dot + 1);
    }
}

// The place of an element, counted from 1; 0 where the text is no such number.
std::size_t place_of(std::string_view text) {
    std::size_t place = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), place);
    return error == std::errc() && end == text.data() + text.size() ? place : 0;
}

// Integers stay integers: some keys take nothing else.
template <class Set>
void set_value(const JobChange& change, const Set& set) {
    constexpr double kMostWhole = 9e15;
    if (const double* number = std::get_if<double>(&change.value)) {
        if (*number == std::floor(*number) && std::abs(*number) < kMostWhole) {
            set(static_cast<std::int64_t>(*number));
        } else {
            set(*number);
        }
    } else if (const auto* text = std::get_if<std::string>(&change.value)) {
        set(*text);
    } else {
        set(std::get<bool>(change.value));
    }
}

// Walks from the root to the table or array that holds the last part of a key.
class Walk {
  public:
    Walk(const JobChange& change, const std::string& file)
        : change_(change), file_(file), parts_(parts_of(change.key)) {}

    Result<void> set_in(toml::table& root) {
        toml::node* at = &root;
        for (next_ = 0; next_ + 1 < parts_.size(); ++next_) {
            auto below = step(*at);
            if (!below) return std::unexpected(below.error());
            at = *below;
        }
        return set_last(*at);
    }

  private:
    std::unexpected<Error> refuse(const std::string& cause, const std::string& remedy) const {
        return fail_at(file_, 0, 0, "cannot set '" + change_.key + "': " + cause, remedy);
    }

    // The one table of an array of one; else the node itself.
    Result<toml::node*> only(toml::node& node) const {
        toml::array* array = node.as_array();
        if (array == nullptr || place_of(parts_[next_]) > 0) return &node;
        if (array->size() == 1 && array->get(0)->is_table()) return array->get(0);
        return refuse("there are " + std::to_string(array->size()) + " of them",
                      "write its number, counted from 1, before '" + std::string(parts_[next_]) + "'");
    }

    Result<toml::node*> element(toml::array& array) const {
        const std::size_t place = place_of(parts_[next_]);
        if (place == 0 || place > array.size())
            return refuse("there is no element '" + std::string(parts_[next_]) + "'",
                          "count from 1 to " + std::to_string(array.size()));
        return array.get(place - 1);
    }

    Result<toml::node*> step(toml::node& node) const {
        auto at = only(node);
        if (!at) return at;
        if (toml::array* array = (*at)->as_array()) return element(*array);
        toml::table* table = (*at)->as_table();
        // `cutter.1` of a job with one table [cutter].
        if (table != nullptr && place_of(parts_[next_]) == 1 && next_ > 0) return table;
        if (table == nullptr)
            return refuse("'" + std::string(parts_[next_ - 1]) + "' is no table",
                          "name a key of the job, as in process.spindle_rpm");
        if (toml::node* below = table->get(parts_[next_])) return below;
        return &table->insert_or_assign(parts_[next_], toml::table{}).first->second;
    }

    Result<void> set_last(toml::node& node) const {
        auto at = only(node);
        if (!at) return std::unexpected(at.error());
        if (toml::array* array = (*at)->as_array()) {
            if (auto found = element(*array); !found) return std::unexpected(found.error());
            const auto place = array->begin() + static_cast<std::ptrdiff_t>(place_of(parts_[next_]) - 1);
            set_value(change_, [&](const auto& value) { array->replace(place, value); });
            return {};
        }
        toml::table* table = (*at)->as_table();
        if (table == nullptr || parts_[next_].empty())
            return refuse("it is no key of a table", "name a key of the job, as in process.spindle_rpm");
        set_value(change_, [&](const auto& value) { table->insert_or_assign(parts_[next_], value); });
        return {};
    }

    const JobChange& change_;
    const std::string& file_;
    std::vector<std::string_view> parts_;
    std::size_t next_ = 0;
};

}  // namespace

Result<void> apply(std::span<const JobChange> changes, toml::table& job, const std::string& file) {
    for (const JobChange& change : changes) {
        if (auto set = Walk(change, file).set_in(job); !set) return set;
    }
    return {};
}

}  // namespace tribo::job
