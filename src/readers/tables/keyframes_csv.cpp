// SPDX-License-Identifier: MIT
#include "readers/tables/keyframes_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "readers/text/csv_fields.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::array<std::string_view, 6> kPoseColumns{"x", "y", "z", "i", "j", "k"};
constexpr std::string_view kWeightColumn = "weight", kFeedColumn = "feed_mm_per_min";
constexpr const char* kHeaderRemedy = "start with the line x,y,z,i,j,k[,weight][,feed_mm_per_min]";
// Shorter axes have no reliable direction.
constexpr double kShortestAxis = 1e-9;

// A vector that is unit up to rounding stays unchanged, so that written tables read back the same.
Vec3 to_unit(Vec3 axis) {
    constexpr double rounding = 1e-15;
    const double squared = squared_length(axis);
    return std::abs(squared - 1) <= rounding ? axis : axis / std::sqrt(squared);
}

class KeyframesReader {
  public:
    KeyframesReader(std::string_view bytes, const KeyframeOptions& options)
        : lines_(bytes, options.source_name), options_(options) {}

    Result<std::vector<motion::Keyframe>> read() {
        if (auto header = read_header(); !header) return std::unexpected(header.error());
        while (lines_.next(fields_)) {
            const auto keyframe = read_row();
            if (!keyframe) return std::unexpected(keyframe.error());
            if (!keyframes_.empty() && keyframes_.back().pose == keyframe->pose) {
                return lines_.refuse(1, "the pose is that of the line before", "delete one of the two");
            }
            if (keyframes_.size() >= options_.max_keyframes) {
                return lines_.refuse(1, "more than " + std::to_string(options_.max_keyframes) + " keyframes",
                                     "split the motion");
            }
            keyframes_.push_back(*keyframe);
        }
        if (keyframes_.size() < 2) {
            return lines_.refuse(
                0, "a motion needs two keyframes, this file has " + std::to_string(keyframes_.size()),
                "add the missing lines");
        }
        return std::move(keyframes_);
    }

  private:
    Result<void> read_header() {
        if (!lines_.next(fields_)) return lines_.refuse(0, "the file holds no keyframes", kHeaderRemedy);
        if (fields_.size() == 1 && fields_[0].text.find(';') != std::string_view::npos) {
            return lines_.refuse(1, "the columns are separated by semicolons", "separate them by commas");
        }
        for (std::size_t i = 0; i < fields_.size(); ++i) {
            const CsvField& field = fields_[i];
            if (i < kPoseColumns.size()) {
                if (is_csv_column(field.text, kPoseColumns[i])) continue;
                return lines_.refuse(
                    field.column,
                    "column " + std::to_string(i + 1) + " is not " + std::string(kPoseColumns[i]),
                    kHeaderRemedy);
            }
            const bool weight = is_csv_column(field.text, kWeightColumn);
            auto& place = weight ? weight_ : feed_;
            if ((!weight && !is_csv_column(field.text, kFeedColumn)) || place) {
                return lines_.refuse(
                    field.column,
                    "column " + std::to_string(i + 1) + " is neither weight nor feed_mm_per_min",
                    kHeaderRemedy);
            }
            place = i;
        }
        columns_ = fields_.size();
        if (columns_ < kPoseColumns.size()) {
            return lines_.refuse(fields_.back().column, "the header has too few columns", kHeaderRemedy);
        }
        return {};
    }

    // `scale`: of the column's unit in that of the limit.
    Result<double> number(std::size_t i, const Limit& limit, double scale = 1) const {
        const CsvField& field = fields_[i];
        const auto value = number_of(field.text);
        if (!value) {
            return lines_.refuse(field.column,
                                 field.text.empty() ? "a number is missing" : "this is not a number",
                                 "write a decimal number with a point");
        }
        if (!limit.range.contains(*value * scale))
            return lines_.refuse(field.column, out_of_range(limit, *value * scale), range_remedy(limit));
        return *value * scale;
    }

    Result<motion::Keyframe> read_row() const {
        if (fields_.size() != columns_) {
            return lines_.refuse(fields_.back().column,
                                 "the line has " + std::to_string(fields_.size()) + " fields, the header " +
                                     std::to_string(columns_),
                                 "give every line a field per column");
        }
        motion::Keyframe keyframe;
        keyframe.line = lines_.number();
        for (int axis = 0; axis < 3; ++axis) {
            const auto place = number(static_cast<std::size_t>(axis), kLimits.coordinate, options_.unit_mm);
            if (!place) return std::unexpected(place.error());
            keyframe.pose.tip_mm[axis] = *place;
            const auto direction = number(static_cast<std::size_t>(axis) + 3, kLimits.direction);
            if (!direction) return std::unexpected(direction.error());
            keyframe.pose.axis[axis] = *direction;
        }
        if (length(keyframe.pose.axis) < kShortestAxis) {
            return lines_.refuse(fields_[3].column, "the axis i,j,k has no length",
                                 "give the direction from tip to shank");
        }
        keyframe.pose.axis = to_unit(keyframe.pose.axis);
        if (weight_ && !fields_[*weight_].text.empty()) {
            const auto weight = number(*weight_, kLimits.weight);
            if (!weight) return std::unexpected(weight.error());
            keyframe.weight = *weight;
        }
        // 0 stands where none is given.
        if (feed_ && !fields_[*feed_].text.empty() && number_of(fields_[*feed_].text) != 0.0) {
            const auto feed = number(*feed_, kLimits.feed);
            if (!feed) return std::unexpected(feed.error());
            keyframe.feed_mm_per_min = *feed;
        }
        return keyframe;
    }

    CsvLines lines_;
    const KeyframeOptions& options_;
    std::vector<CsvField> fields_;
    std::vector<motion::Keyframe> keyframes_;
    std::size_t columns_ = 0;
    std::optional<std::size_t> weight_, feed_;
};

}  // namespace

Result<std::vector<motion::Keyframe>> read_keyframes(std::string_view bytes, const KeyframeOptions& options) {
    return KeyframesReader(bytes, options).read();
}

std::string write_keyframes(const std::vector<motion::Keyframe>& keyframes) {
    const bool weights = std::ranges::any_of(keyframes, [](const auto& k) { return k.weight != 1; });
    const bool feeds = std::ranges::any_of(keyframes, [](const auto& k) { return k.feed_mm_per_min != 0; });
    std::string csv = "x,y,z,i,j,k";
    if (weights) csv += ",weight";
    if (feeds) csv += ",feed_mm_per_min";
    csv += '\n';
    for (const motion::Keyframe& keyframe : keyframes) {
        const Vec3 tip = keyframe.pose.tip_mm, axis = keyframe.pose.axis;
        append_decimal(csv, tip.x);
        for (const double value : {tip.y, tip.z, axis.x, axis.y, axis.z}) {
            csv += ',';
            append_decimal(csv, value);
        }
        if (weights) {
            csv += ',';
            append_decimal(csv, keyframe.weight);
        }
        if (feeds) {
            csv += ',';
            append_decimal(csv, keyframe.feed_mm_per_min);
        }
        csv += '\n';
    }
    return csv;
}

}  // namespace tribo::readers
