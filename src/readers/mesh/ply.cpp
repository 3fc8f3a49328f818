// SPDX-License-Identifier: MIT
#include "readers/mesh/ply.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include "readers/mesh/model_mesh.hpp"
#include "readers/mesh/model_polygon.hpp"
#include "readers/mesh/ply_header.hpp"

namespace tribo::readers {
namespace {

template <class T>
double as_double(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

// Reads one value after the other, in any encoding.
class ValueReader {
  public:
    ValueReader(TextCursor cursor, PlyEncoding encoding)
        : cursor_(cursor), bytes_(cursor.rest()), encoding_(encoding) {}

    bool is_text() const { return encoding_ == PlyEncoding::text; }
    // Number of unread bytes, and the smallest size of a value.
    std::size_t left() const { return is_text() ? cursor_.rest().size() : bytes_.size() - at_; }
    std::size_t least_size(PlyType type) const { return is_text() ? 1 : size_of(type); }
    int line() const { return is_text() ? cursor_.line() : 0; }
    int column() const { return is_text() ? cursor_.column() : 0; }
    // The word that is not a number; empty at the end of the file.
    std::string_view refused() const { return refused_; }

    std::optional<double> next(PlyType type) {
        if (is_text()) {
            refused_ = cursor_.word();
            const auto number = parse_number(refused_);
            if (number && is_integer(type) && std::trunc(*number) != *number) return std::nullopt;
            return number;
        }
        const std::size_t size = size_of(type);
        if (bytes_.size() - at_ < size) return std::nullopt;
        char value[8];
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t from = encoding_ == PlyEncoding::big_endian ? size - 1 - i : i;
            value[i] = bytes_[at_ + from];
        }
        at_ += size;
        switch (type) {
            case PlyType::int8:
                return as_double<std::int8_t>(value);
            case PlyType::uint8:
                return as_double<std::uint8_t>(value);
            case PlyType::int16:
                return as_double<std::int16_t>(value);
            case PlyType::uint16:
                return as_double<std::uint16_t>(value);
            case PlyType::int32:
                return as_double<std::int32_t>(value);
            case PlyType::uint32:
                return as_double<std::uint32_t>(value);
            case PlyType::float32:
                return as_double<float>(value);
            case PlyType::float64:
                return as_double<double>(value);
            case PlyType::none:
                break;
        }
        return std::nullopt;
    }

  private:
    static_assert(std::endian::native == std::endian::little);
    TextCursor cursor_;
    std::string_view bytes_, refused_;
    std::size_t at_ = 0;
    PlyEncoding encoding_;
};

class PlyReader {
  public:
    PlyReader(const PlyHeader& header, TextCursor cursor, const ModelOptions& options)
        : header_(header), values_(cursor, header.encoding), options_(options) {}

    Result<Model> read() {
        bool has_vertices = false, has_faces = false;
        for (const PlyElement& element : header_.elements) {
            if (auto ok = check_count(element); !ok) return std::unexpected(ok.error());
            Result<void> ok;
            if (element.name == "vertex") {
                has_vertices = true;
                ok = read_vertices(element);
            } else if (element.name == "face") {
                if (!has_vertices) return refuse(element, "faces before the vertices are not read");
                has_faces = true;
                ok = read_faces(element);
            } else if (element.name == "tristrips") {
                return refuse(element, "triangle strips are not read");
            } else {
                ok = skip(element);
            }
            if (!ok) return std::unexpected(ok.error());
        }
        if (!has_faces) {
            return fail_at(options_.source_name, 0, 0,
                           "the PLY file has no faces: a point cloud is no surface",
                           "export the model as a mesh");
        }
        warn_of_crossing_faces(model_, options_, triangulator_.crossing_faces());
        return finish_model(std::move(model_), options_, Weld::no);
    }

  private:
    std::unexpected<Error> refuse(const PlyElement& element, std::string cause) const {
        return fail_at(options_.source_name, element.line, 0, std::move(cause),
                       "export the model as polygons or triangles");
    }

    std::unexpected<Error> fail_in(const PlyElement& element, std::uint64_t row, std::string cause) const {
        return fail_at(options_.source_name, values_.line(), values_.column(),
                       std::string(element.name) + " " + std::to_string(row) + ": " + std::move(cause),
                       "the file is damaged; export it again");
    }

    std::unexpected<Error> no_value(const PlyElement& element, std::uint64_t row) const {
        if (!values_.is_text() || values_.refused().empty())
            return fail_in(element, row, "the file ends here");
        return fail_in(element, row, "expected a number, found " + quoted(values_.refused()));
    }

    // Refuses a count that the rest of the file cannot contain, before memory is reserved for it.
    Result<void> check_count(const PlyElement& element) const {
        std::uint64_t row = 0;
        for (const PlyProperty& p : element.properties) {
            row += values_.least_size(p.is_list() ? p.count_type : p.type);
        }
        if (row == 0 || element.count <= values_.left() / row) return {};
        return fail_at(options_.source_name, element.line, 0,
                       "the header says " + std::to_string(element.count) + " of " + quoted(element.name) +
                           ", but the file has bytes for " + std::to_string(values_.left() / row),
                       "the file is cut short; export it again");
    }

    // Reads the length of a list and compares it with the remaining bytes.
    Result<std::size_t> read_length(const PlyElement& element, std::uint64_t row, const PlyProperty& p) {
        const auto length = values_.next(p.count_type);
        if (!length) return no_value(element, row);
        if (*length < 0 ||
            *length * static_cast<double>(values_.least_size(p.type)) > static_cast<double>(values_.left())) {
            return fail_in(element, row, "a list's length does not fit the file");
        }
        return static_cast<std::size_t>(*length);
    }

    Result<void> skip_property(const PlyElement& element, std::uint64_t row, const PlyProperty& p) {
        std::size_t values = 1;
        if (p.is_list()) {
            const auto length = read_length(element, row, p);
            if (!length) return std::unexpected(length.error());
            values = *length;
        }
        for (std::size_t i = 0; i < values; ++i) {
            if (!values_.next(p.type)) return no_value(element, row);
        }
        return {};
    }

    Result<void> skip(const PlyElement& element) {
        if (element.properties.empty()) return {};
        for (std::uint64_t row = 0; row < element.count; ++row) {
            for (const PlyProperty& p : element.properties) {
                if (auto ok = skip_property(element, row, p); !ok) return ok;
            }
        }
        return {};
    }

    Result<void> read_vertices(const PlyElement& element) {
        const int axes[3] = {element.find("x"), element.find("y"), element.find("z")};
        for (const int axis : axes) {
            if (axis < 0 || element.properties[static_cast<std::size_t>(axis)].is_list()) {
                return refuse(element, "the vertices need the properties x, y and z");
            }
        }
        model_.mesh.positions.reserve(static_cast<std::size_t>(element.count));
        std::vector<double> row_values(element.properties.size());
        for (std::uint64_t row = 0; row < element.count; ++row) {
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& p = element.properties[i];
                if (p.is_list()) {
                    if (auto ok = skip_property(element, row, p); !ok) return ok;
                    continue;
                }
                const auto value = values_.next(p.type);
                if (!value) return no_value(element, row);
                row_values[i] = *value;
            }
            const auto at = [&](int axis) { return row_values[static_cast<std::size_t>(axis)]; };
            const auto position = to_position(at(axes[0]), at(axes[1]), at(axes[2]), options_.unit());
            if (!position) return fail_in(element, row, "the position is not finite");
            model_.mesh.positions.push_back(*position);
        }
        return {};
    }

    Result<void> read_faces(const PlyElement& element) {
        int list = element.find("vertex_indices");
        if (list < 0) list = element.find("vertex_index");
        if (list < 0 || !element.properties[static_cast<std::size_t>(list)].is_list() ||
            !is_integer(element.properties[static_cast<std::size_t>(list)].type)) {
            return refuse(element, "the faces need a list of integers vertex_indices");
        }
        for (std::uint64_t row = 0; row < element.count; ++row) {
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const auto ok = static_cast<int>(i) == list
                                    ? read_face(element, row, element.properties[i])
                                    : skip_property(element, row, element.properties[i]);
                if (!ok) return ok;
            }
        }
        return {};
    }

    Result<void> read_face(const PlyElement& element, std::uint64_t row, const PlyProperty& p) {
        const auto length = read_length(element, row, p);
        if (!length) return std::unexpected(length.error());
        if (model_.mesh.triangles.size() + *length > options_.max_triangles + 2) {
            return fail_at(options_.source_name, values_.line(), values_.column(),
                           too_many_triangles(options_), fewer_triangles(options_));
        }
        corners_.clear();
        points_.clear();
        for (std::size_t i = 0; i < *length; ++i) {
            const auto index = values_.next(p.type);
            if (!index) return no_value(element, row);
            if (!(*index >= 0 && *index < static_cast<double>(model_.mesh.positions.size()))) {
                return fail_in(element, row,
                               "corner " + std::to_string(i + 1) + " is not one of the " +
                                   std::to_string(model_.mesh.positions.size()) + " vertices");
            }
            corners_.push_back(static_cast<std::uint32_t>(*index));
            points_.push_back(model_.mesh.position(corners_.back()));
        }
        if (corners_.size() < 3) return fail_in(element, row, "a face needs three corners");
        if (!triangulator_.append(corners_, points_, model_.mesh.triangles)) {
            return fail_at(options_.source_name, values_.line(), values_.column(),
                           "face " + std::to_string(row) + ": " + PolygonTriangulator::kTooConcave,
                           PolygonTriangulator::kTooConcaveRemedy);
        }
        return {};
    }

    const PlyHeader& header_;
    ValueReader values_;
    const ModelOptions& options_;
    Model model_{.mesh = {}, .parts = {}, .format = ModelFormat::ply, .warnings = {}};
    PolygonTriangulator triangulator_;
    std::vector<std::uint32_t> corners_;
    std::vector<Vec3> points_;
};

}  // namespace

bool looks_like_ply(std::string_view bytes) {
    TextCursor cursor(bytes.substr(0, 16));
    return bytes.starts_with("ply") && cursor.word() == "ply";
}

Result<Model> read_ply(std::string_view bytes, const ModelOptions& options) {
    TextCursor cursor(bytes);
    if (!looks_like_ply(bytes)) {
        return fail_at(options.source_name, 1, 1, "a PLY file starts with the line 'ply'",
                       "check that this is a PLY file");
    }
    const auto header = read_ply_header(cursor, options.source_name);
    if (!header) return std::unexpected(header.error());
    return PlyReader(*header, cursor, options).read();
}

}  // namespace tribo::readers
