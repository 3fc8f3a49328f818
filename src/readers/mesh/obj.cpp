// SPDX-License-Identifier: MIT
#include "readers/mesh/obj.hpp"

#include <algorithm>
#include <array>

#include "readers/mesh/model_mesh.hpp"
#include "readers/mesh/model_polygon.hpp"
#include "readers/text/model_text.hpp"

namespace tribo::readers {
namespace {

using namespace std::string_view_literals;

// Statements without effect on the surface.
constexpr std::array kPassedOver{"vt"sv,         "vn"sv,       "vp"sv,     "g"sv,        "o"sv,
                                 "s"sv,          "mg"sv,       "mtllib"sv, "usemtl"sv,   "lod"sv,
                                 "bevel"sv,      "maplib"sv,   "usemap"sv, "c_interp"sv, "d_interp"sv,
                                 "shadow_obj"sv, "trace_obj"sv};
// Statements of free-form curves and surfaces, and of other files.
constexpr std::array kRefused{"cstype"sv, "deg"sv,  "bmat"sv,  "step"sv,  "curv"sv, "curv2"sv,
                              "surf"sv,   "parm"sv, "trim"sv,  "hole"sv,  "scrv"sv, "sp"sv,
                              "end"sv,    "con"sv,  "ctech"sv, "stech"sv, "bzp"sv,  "bsp"sv,
                              "cdc"sv,    "cdp"sv,  "res"sv,   "call"sv,  "csh"sv};

template <class List>
bool is_one_of(std::string_view word, const List& list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

class ObjReader {
  public:
    ObjReader(std::string_view text, const ModelOptions& options)
        : cursor_(without_byte_order_mark(text)), options_(options) {}

    Result<Model> read() {
        while (!cursor_.at_end()) {
            if (auto ok = read_statement(next_word()); !ok) return std::unexpected(ok.error());
            cursor_.next_line();
        }
        if (lines_ > 0) {
            model_.warnings.push_back(
                {options_.source_name, first_line_,
                 std::to_string(lines_) + " statements of points or lines have no surface and were skipped"});
        }
        warn_of_crossing_faces(model_, options_, triangulator_.crossing_faces());
        return finish_model(std::move(model_), options_, Weld::no);
    }

  private:
    std::unexpected<Error> fail_here(std::string cause, std::string remedy) const {
        return fail_at(options_.source_name, cursor_.line(), cursor_.column(), std::move(cause),
                       std::move(remedy));
    }

    // Returns the next word of the statement, across lines that end with a backslash, up to a comment.
    std::string_view next_word() {
        for (;;) {
            const std::string_view word = cursor_.word_on_line();
            if (word.starts_with('#')) {
                cursor_.rest_of_line();
                return {};
            }
            if (word != "\\") return word;
            cursor_.next_line();
        }
    }

    Result<void> read_statement(std::string_view word) {
        if (word.empty() || is_one_of(word, kPassedOver)) return {};
        if (word == "v") return read_vertex();
        if (word == "f" || word == "fo") return read_face();
        if (word == "l" || word == "p") {
            if (lines_++ == 0) first_line_ = cursor_.line();
            return {};
        }
        if (is_one_of(word, kRefused)) {
            return fail_here("the OBJ statement " + quoted(word) + " is not read",
                             "export the model as polygons");
        }
        return fail_here(quoted(word) + " is not an OBJ statement", "export the model again as OBJ");
    }

    Result<void> read_vertex() {
        std::array<double, 3> xyz{};
        for (double& value : xyz) {
            const std::string_view word = next_word();
            const std::optional<double> number = parse_number(word);
            if (!number) {
                return fail_here(
                    word.empty() ? "a vertex needs x, y and z" : "expected a number, found " + quoted(word),
                    "export the model again as OBJ");
            }
            value = *number;
        }
        const auto position = to_position(xyz[0], xyz[1], xyz[2], options_.unit());
        if (!position) return fail_here("a vertex is not finite", "repair the model, or check its unit");
        model_.mesh.positions.push_back(*position);
        return {};
    }

    Result<void> read_face() {
        corners_.clear();
        points_.clear();
        for (;;) {
            const std::string_view word = next_word();
            if (word.empty()) break;
            const auto index = parse_integer(word.substr(0, word.find('/')));
            if (!index) return fail_here("expected a vertex number, found " + quoted(word), "export again");
            const auto read = static_cast<long long>(model_.mesh.positions.size());
            const long long from_start = *index < 0 ? read + *index : *index - 1;
            if (from_start < 0 || from_start >= read) {
                return fail_here("a face uses vertex " + std::to_string(*index) + ", but " +
                                     std::to_string(read) + " were read so far",
                                 "vertices count from 1 and stand before their faces; export again");
            }
            corners_.push_back(static_cast<std::uint32_t>(from_start));
            points_.push_back(model_.mesh.position(corners_.back()));
        }
        if (corners_.size() < 3) return fail_here("a face needs three corners", "export again");
        if (model_.mesh.triangles.size() + corners_.size() - 2 > options_.max_triangles) {
            return fail_here(too_many_triangles(options_), fewer_triangles(options_));
        }
        if (!triangulator_.append(corners_, points_, model_.mesh.triangles)) {
            return fail_here(PolygonTriangulator::kTooConcave, PolygonTriangulator::kTooConcaveRemedy);
        }
        return {};
    }

    TextCursor cursor_;
    const ModelOptions& options_;
    Model model_{.mesh = {}, .parts = {}, .format = ModelFormat::obj, .warnings = {}};
    PolygonTriangulator triangulator_;
    std::vector<std::uint32_t> corners_;
    std::vector<Vec3> points_;
    std::size_t lines_ = 0;
    int first_line_ = 0;
};

}  // namespace

bool looks_like_obj(std::string_view bytes) {
    constexpr std::array starts{"v"sv, "vn"sv, "vt"sv, "f"sv, "o"sv, "g"sv, "s"sv, "mtllib"sv, "usemtl"sv};
    TextCursor cursor(without_byte_order_mark(bytes));
    while (!cursor.at_end()) {
        const std::string_view word = cursor.word_on_line();
        if (!word.empty() && !word.starts_with('#')) return is_one_of(word, starts);
        cursor.next_line();
    }
    return false;
}

Result<Model> read_obj(std::string_view bytes, const ModelOptions& options) {
    return ObjReader(bytes, options).read();
}

}  // namespace tribo::readers
