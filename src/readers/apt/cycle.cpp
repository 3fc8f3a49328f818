// SPDX-License-Identifier: MIT
#include "readers/apt/cycle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "readers/text/length_unit.hpp"

namespace tribo::readers::apt {
namespace {

// After a peck the tool returns to this distance above the reached depth; a chip is broken by a retract of
// this length, mm. Value of LinuxCNC; other controls have a parameter that no program states.
constexpr double kPeckGapMm = 0.254;
constexpr double kMostPecks = 10'000;

struct Kind {
    std::string_view word;
    Cycle::Way way;
};
constexpr std::array kKinds{
    Kind{"DRILL", Cycle::Way::through},    Kind{"DEEP", Cycle::Way::peck},
    Kind{"DEEPCL", Cycle::Way::peck},      Kind{"RIGID", Cycle::Way::bore},
    Kind{"BRKCHP", Cycle::Way::chip},      Kind{"CHIP", Cycle::Way::chip},
    Kind{"BREAK", Cycle::Way::chip},       Kind{"TAP", Cycle::Way::bore},
    Kind{"REAM", Cycle::Way::bore},        Kind{"BORE", Cycle::Way::bore},
    Kind{"FACE", Cycle::Way::through},     Kind{"CSINK", Cycle::Way::through},
    Kind{"CBORE", Cycle::Way::through},    Kind{"CENTER", Cycle::Way::through},
    Kind{"DEEPHL", Cycle::Way::peck},      Kind{"DEEPBR", Cycle::Way::chip},
    Kind{"STANDARD", Cycle::Way::through}, Kind{"SPOT", Cycle::Way::through},
    Kind{"CDRILL", Cycle::Way::through},   Kind{"NODRAG", Cycle::Way::through},
    Kind{"DRAG", Cycle::Way::bore},        Kind{"BOREOS", Cycle::Way::through},
};

// `aside`: a value that moves no tool in the depth, such as the angle at which the spindle stops.
enum class Key { depth, clear, approach, retract, first_peck, peck, dwell, feed, threads, back, aside };
struct Word {
    std::string_view text;
    Key key;
};
constexpr std::array kWords{
    Word{"FEDTO", Key::depth},        Word{"DEPTH", Key::depth},    Word{"RAPTO", Key::approach},
    Word{"CLEAR", Key::clear},        Word{"RTRCTO", Key::retract}, Word{"RETURN", Key::retract},
    Word{"1STPECK", Key::first_peck}, Word{"SUBPECK", Key::peck},   Word{"STEP", Key::peck},
    Word{"STEP1", Key::peck},         Word{"PECK", Key::peck},      Word{"INCR", Key::peck},
    Word{"DWELL", Key::dwell},        Word{"TPI", Key::threads},    Word{"BACK", Key::back},
    Word{"ORIENT", Key::aside},       Word{"RPM", Key::aside},
};

// Some processors number their kinds: BORE9.
const Kind* find_kind(std::string_view text) {
    while (!text.empty() && is_digit(text.back())) text.remove_suffix(1);
    const auto found = std::ranges::find_if(kKinds, [&](const Kind& k) { return matches(text, k.word); });
    return found == kKinds.end() ? nullptr : &*found;
}

const Word* find_word(std::string_view text) {
    static constexpr Word feed{{}, Key::feed};
    if (feed_unit(text)) return &feed;
    const auto found = std::ranges::find_if(kWords, [&](const Word& w) { return matches(text, w.text); });
    return found == kWords.end() ? nullptr : &*found;
}

class CycleReader {
  public:
    CycleReader(const Statement& statement, const Path& path, Report& report)
        : items_(statement.items), path_(path), report_(report), unit_mm_(path.settings.unit_mm) {
        cycle_.at = statement.word;
    }

    Result<Cycle> read() {
        if (auto ok = read_kind(); !ok) return std::unexpected(ok.error());
        const bool by_place = at_ < items_.size() && number_of(items_[at_].text).has_value();
        if (auto ok = by_place ? read_places() : read_words(); !ok) return std::unexpected(ok.error());
        if (cycle_.depth_mm <= 0) {
            return report_.refuse(cycle_.at, "a cycle without a depth", "write FEDTO or DEPTH and the depth");
        }
        // With both words RAPTO counts from CLEAR down: the tool goes on at rapid.
        cycle_.clearance_mm = approach_mm_.value_or(clear_mm_.value_or(0));
        if (clear_mm_ && approach_mm_) cycle_.clearance_mm = *clear_mm_ - *approach_mm_;
        if (!has_retract_) cycle_.retract_mm = clear_mm_.value_or(cycle_.clearance_mm);
        if (cycle_.first_peck_mm == 0) cycle_.first_peck_mm = cycle_.peck_mm;
        if (cycle_.peck_mm == 0) cycle_.peck_mm = cycle_.first_peck_mm;
        const bool pecks = cycle_.way == Cycle::Way::peck || cycle_.way == Cycle::Way::chip;
        if (pecks && cycle_.peck_mm == 0) {
            report_.warn(cycle_.at.line, "a cycle with pecks that states none: the hole is made in one go");
            cycle_.way = Cycle::Way::through;
        }
        if (pecks && cycle_.peck_mm > 0 && cycle_.depth_mm / cycle_.peck_mm > kMostPecks)
            return report_.refuse(cycle_.at, "more than 10000 pecks for one hole", "correct the peck");
        return cycle_;
    }

  private:
    // DRILL; NX adds the kind: DRILL,DEEP or DRILL,BRKCHP or BORE,NODRAG.
    Result<void> read_kind() {
        if (items_.empty()) return report_.refuse(cycle_.at, "CYCLE without a kind", "write CYCLE/DRILL");
        for (; at_ < items_.size(); ++at_) {
            const Item& item = items_[at_];
            const Kind* kind = find_kind(item.text);
            if (!kind) break;
            cycle_.way = kind->way;
        }
        if (at_ > 0) return {};
        return report_.refuse(items_[0], quoted(items_[0].text) + " is not a cycle that is read",
                              "let the CAM system write its moves");
    }

    Result<double> take_number(const Range& range) {
        if (at_ == items_.size())
            return report_.refuse(items_[at_ - 1], "a number is missing after this", "write it");
        return report_.number(items_[at_++], range);
    }

    Result<void> read_words() {
        while (at_ < items_.size()) {
            const Item& item = items_[at_++];
            const Word* word = find_word(item.text);
            if (!word) {
                return report_.refuse(item, quoted(item.text) + " is not known in a cycle",
                                      "let the CAM system write the moves of this cycle");
            }
            if (auto ok = read_value(word->key, item); !ok) return ok;
        }
        return {};
    }

    Result<void> read_value(Key key, const Item& word) {
        if (key == Key::retract && at_ < items_.size() && matches(items_[at_].text, "AUTO")) {
            ++at_;
            return {};
        }
        if (key == Key::dwell) return read_dwell();
        if (key == Key::feed || key == Key::threads) {
            const auto value = take_number(Range{});
            if (!value) return std::unexpected(value.error());
            if (key == Key::feed) return set_feed(*value, word);
            return set_threads(*value, word);
        }
        if (key == Key::aside) {
            if (at_ < items_.size() && number_of(items_[at_].text)) ++at_;
            return {};
        }
        Range range = lengths(unit_mm_);
        if (key == Key::depth || key == Key::retract) range.min = -range.max;
        const auto value = take_number(range);
        if (!value) return std::unexpected(value.error());
        const double mm = *value * unit_mm_;
        switch (key) {
            case Key::depth:
                cycle_.depth_mm = std::abs(mm);  // NX writes the upward distance, which is negative
                break;
            case Key::clear:
                clear_mm_ = mm;
                break;
            case Key::approach:
                approach_mm_ = mm;
                break;
            case Key::back:
                cycle_.chip_mm = mm;
                break;
            case Key::retract:
                // RETURN,0 leads to the plane of CLEAR.
                has_retract_ = mm != 0 || !matches(word.text, "RETURN");
                cycle_.retract_mm = mm;
                break;
            case Key::first_peck:
                cycle_.first_peck_mm = mm;
                break;
            default:
                cycle_.peck_mm = mm;
                break;
        }
        return {};
    }

    Result<void> read_dwell() {
        const bool turns = at_ < items_.size() && matches(items_[at_].text, "REV");
        if (turns) ++at_;
        const auto value = take_number(kLimits.dwell.range);
        if (!value) return std::unexpected(value.error());
        if (turns && path_.settings.spindle_rpm == 0) {
            return report_.refuse(items_[at_ - 1], "a dwell in turns with the spindle speed unknown",
                                  "add SPINDL with a speed before it");
        }
        cycle_.dwell_s = turns ? *value * 60 / path_.settings.spindle_rpm : *value;
        return {};
    }

    Result<void> set_feed(double value, const Item& word) {
        const FeedUnit& unit = *feed_unit(word.text);
        const auto feed = feed_of(word, value * (unit.mm > 0 ? unit.mm : unit_mm_), unit.per_turn, report_);
        if (!feed) return std::unexpected(feed.error());
        cycle_.feed = *feed;
        return {};
    }

    // The threads in an inch give the feed of a tap.
    Result<void> set_threads(double per_inch, const Item& word) {
        const auto feed = feed_of(word, mm_per(LengthUnit::inch) / per_inch, true, report_);
        if (!feed) return std::unexpected(feed.error());
        cycle_.feed = *feed;
        return {};
    }

    // depth, feed (with its unit before or after it), clearance. A deep hole has its peck as the last number,
    // or before the feed; a tap has its threads in an inch after the feed.
    Result<void> read_places() {
        const bool pecks = cycle_.way == Cycle::Way::peck || cycle_.way == Cycle::Way::chip;
        const bool taps = matches(items_[0].text, "TAP");
        const std::size_t most = pecks || taps ? 4 : 3;
        std::array<double, 4> value{};
        std::size_t count = 0, at_unit = 0;
        const Item* unit = nullptr;
        for (; at_ < items_.size(); ++at_) {
            const Item& item = items_[at_];
            const Word* word = find_word(item.text);
            if (word && word->key == Key::feed && !unit) {
                unit = &item;
                at_unit = count;
            } else if (word && count >= 2) {
                break;
            } else if (count == most) {
                return report_.refuse(item, "more numbers than depth, feed and clearance",
                                      "name them: FEDTO, MMPM, RAPTO, ...");
            } else {
                const auto number = report_.number(item, lengths(unit_mm_));
                if (!number) return std::unexpected(number.error());
                value[count++] = *number;
            }
        }
        cycle_.depth_mm = value[0] * unit_mm_;
        if (count == 4 && at_unit == 3) {
            std::rotate(value.begin() + 1, value.begin() + 2, value.end());  // depth, peck, feed, clearance
        } else if (count == 4 && taps) {
            std::swap(value[2], value[3]);
        }
        if (count > 2) approach_mm_ = value[2] * unit_mm_;
        if (count == 4 && pecks) cycle_.peck_mm = value[3] * unit_mm_;
        if (unit && count >= 2) {
            if (auto ok = set_feed(value[1], *unit); !ok) return ok;
        } else if (count >= 2) {
            return report_.refuse(cycle_.at, "the cycle's feed has no unit", "write MMPM or IPM before it");
        }
        return read_words();
    }

    const std::vector<Item>& items_;
    const Path& path_;
    Report& report_;
    double unit_mm_;
    Cycle cycle_;
    std::size_t at_ = 0;
    std::optional<double> clear_mm_, approach_mm_;
    bool has_retract_ = false;
};

}  // namespace

void change_words(const Statement& on, std::vector<Item>& changes) {
    const auto is_word = [](const Item& item) { return find_word(item.text) != nullptr; };
    for (auto at = on.items.begin() + 1; at != on.items.end();) {
        const auto next = std::find_if(at + 1, on.items.end(), is_word);
        const auto old =
            std::ranges::find_if(changes, [&](const Item& item) { return matches(item.text, at->text); });
        if (old != changes.end()) changes.erase(old, std::find_if(old + 1, changes.end(), is_word));
        changes.insert(changes.end(), at, next);
        at = next;
    }
}

Result<Cycle> read_cycle(const Statement& statement, const Path& path, Report& report) {
    return CycleReader(statement, path, report).read();
}

Result<void> drill(const Cycle& cycle, const motion::ToolPose& point, const Item& at, Path& path,
                   Report& report) {
    using motion::MoveKind;
    const auto go = [&](double height, MoveKind kind) {
        return path.go({point.tip_mm + height * point.axis, point.axis}, kind, at, {}, cycle.feed);
    };
    const double chip = cycle.chip_mm > 0 ? cycle.chip_mm : kPeckGapMm;
    const double top = std::max(cycle.retract_mm, cycle.clearance_mm);
    if (auto ok = go(top, MoveKind::rapid); !ok) return ok;
    if (auto ok = go(cycle.clearance_mm, MoveKind::rapid); !ok) return ok;
    const bool pecks = cycle.way == Cycle::Way::peck || cycle.way == Cycle::Way::chip;
    double depth = pecks ? std::min(cycle.first_peck_mm, cycle.depth_mm) : cycle.depth_mm;
    if (pecks && depth < cycle.depth_mm && report.first(Note::pecks)) {
        report.warn(cycle.at.line,
                    "pecks go back to, or by, 0.254 mm: the program does not say what the control does");
    }
    for (;;) {
        if (auto ok = go(-depth, MoveKind::feed); !ok) return ok;
        if (depth >= cycle.depth_mm) break;
        const double back = cycle.way == Cycle::Way::chip ? -depth + chip : cycle.clearance_mm;
        if (auto ok = go(std::min(back, cycle.clearance_mm), MoveKind::rapid); !ok) return ok;
        if (cycle.way == Cycle::Way::peck) {
            const double near = std::min(-depth + kPeckGapMm, cycle.clearance_mm);
            if (auto ok = go(near, MoveKind::rapid); !ok) return ok;
        }
        depth = std::min(depth + cycle.peck_mm, cycle.depth_mm);
    }
    if (auto ok = path.dwell(cycle.dwell_s, at); !ok) return ok;
    if (cycle.way == Cycle::Way::bore) {
        if (auto ok = go(cycle.clearance_mm, MoveKind::feed); !ok) return ok;
    }
    return go(cycle.retract_mm, MoveKind::rapid);
}

}  // namespace tribo::readers::apt
