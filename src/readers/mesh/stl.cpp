// SPDX-License-Identifier: MIT
#include "readers/mesh/stl.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "readers/mesh/model_mesh.hpp"
#include "readers/text/model_text.hpp"

namespace tribo::readers {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is copied as it lies in memory");

std::uint32_t u32_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

bool contains_word(std::string_view text, std::string_view word) {
    for (std::size_t i = 0; i + word.size() <= text.size(); ++i) {
        if (equals_ignoring_case(text.substr(i, word.size()), word)) return true;
    }
    return false;
}

bool has_binary_size(std::string_view bytes) {
    return bytes.size() >= kStlHeaderBytes &&
           bytes.size() == kStlHeaderBytes + std::uint64_t{u32_at(bytes, 80)} * kStlFacetBytes;
}

bool is_text_stl(std::string_view bytes) {
    constexpr std::size_t far_enough = 4096;  // beyond the name on the first line
    const std::string_view start = without_byte_order_mark(bytes).substr(0, far_enough);
    if (start.find('\0') != std::string_view::npos) return false;
    return equals_ignoring_case(TextCursor(start).word(), "solid") &&
           (contains_word(start, "facet") || contains_word(start, "endsolid"));
}

class StlTextReader {
  public:
    StlTextReader(std::string_view text, const ModelOptions& options)
        : cursor_(without_byte_order_mark(text)), options_(options) {}

    Result<Model> read() {
        bool inside = false;
        for (;;) {
            const std::string_view word = cursor_.word();
            if (word.empty()) break;
            if (!inside) {
                if (!equals_ignoring_case(word, "solid")) return expected("'solid'", word);
                cursor_.rest_of_line();
                inside = true;
            } else if (equals_ignoring_case(word, "endsolid")) {
                cursor_.rest_of_line();
                inside = false;
            } else if (equals_ignoring_case(word, "facet")) {
                if (auto ok = read_facet(); !ok) return std::unexpected(ok.error());
            } else {
                return expected("'facet' or 'endsolid'", word);
            }
        }
        if (inside) return expected("'endsolid'", {});
        return finish_model(std::move(model_), options_, Weld::exact);
    }

  private:
    std::unexpected<Error> expected(std::string_view what, std::string_view found) {
        if (found.empty()) {
            return fail_at(options_.source_name, cursor_.line(), cursor_.column(),
                           "the file ends where " + std::string(what) + " is due",
                           "the file is cut short; export it again");
        }
        return fail_at(options_.source_name, cursor_.line(), cursor_.column(),
                       "expected " + std::string(what) + ", found " + quoted(found),
                       "export the model again as STL");
    }

    Result<void> expect(std::string_view word) {
        const std::string_view found = cursor_.word();
        if (!equals_ignoring_case(found, word)) return expected("'" + std::string(word) + "'", found);
        return {};
    }

    Result<void> read_facet() {
        if (auto ok = expect("normal"); !ok) return ok;
        for (int i = 0; i < 3; ++i) {  // not used: computed from the corners, as exporters write nan here
            if (cursor_.word().empty()) return expected("a normal", {});
        }
        if (auto ok = expect("outer"); !ok) return ok;
        if (auto ok = expect("loop"); !ok) return ok;
        for (int corner = 0; corner < 3; ++corner) {
            if (auto ok = read_vertex(); !ok) return ok;
        }
        if (auto ok = expect("endloop"); !ok) return ok;
        if (auto ok = expect("endfacet"); !ok) return ok;
        auto& triangles = model_.mesh.triangles;
        if (triangles.size() == options_.max_triangles) {
            return fail_at(options_.source_name, cursor_.line(), 0, too_many_triangles(options_),
                           fewer_triangles(options_));
        }
        const auto end = static_cast<std::uint32_t>(model_.mesh.positions.size());
        triangles.push_back({end - 3, end - 2, end - 1});
        return {};
    }

    Result<void> read_vertex() {
        if (auto ok = expect("vertex"); !ok) return ok;
        double xyz[3];
        for (double& value : xyz) {
            const std::string_view word = cursor_.word();
            const std::optional<double> number = parse_number(word);
            if (!number) return expected("a number", word);
            value = *number;
        }
        const auto position = to_position(xyz[0], xyz[1], xyz[2], options_.unit());
        if (!position) {
            return fail_at(options_.source_name, cursor_.line(), 0, "a vertex is not finite",
                           "repair the model, or check its unit");
        }
        model_.mesh.positions.push_back(*position);
        return {};
    }

    TextCursor cursor_;
    const ModelOptions& options_;
    Model model_{.mesh = {}, .parts = {}, .format = ModelFormat::stl, .warnings = {}};
};

Result<Model> read_binary(std::string_view bytes, const ModelOptions& options) {
    if (bytes.size() < kStlHeaderBytes) {
        return fail_at(options.source_name, 0, 0,
                       "neither text STL nor long enough for binary STL (" + std::to_string(bytes.size()) +
                           " of at least 84 bytes)",
                       "check that the file is complete");
    }
    const std::uint64_t count = u32_at(bytes, 80);
    const std::uint64_t there = (bytes.size() - kStlHeaderBytes) / kStlFacetBytes;
    if (count > there) {
        return fail_at(options.source_name, 0, 0,
                       "as binary STL the header says " + std::to_string(count) +
                           " triangles, but there are bytes for " + std::to_string(there),
                       "the file is cut short or not STL; export it again");
    }
    if (count > options.max_triangles) {
        return fail_at(options.source_name, 0, 0, too_many_triangles(options), fewer_triangles(options));
    }
    Model model{.mesh = {}, .parts = {}, .format = ModelFormat::stl, .warnings = {}};
    model.mesh.positions.reserve(static_cast<std::size_t>(3 * count));
    model.mesh.triangles.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count; ++i) {
        float corners[9];
        constexpr std::size_t normal_bytes = 12;
        std::memcpy(corners, bytes.data() + kStlHeaderBytes + i * kStlFacetBytes + normal_bytes,
                    sizeof corners);
        const auto first = static_cast<std::uint32_t>(model.mesh.positions.size());
        for (std::size_t c = 0; c < 9; c += 3) {
            const auto position =
                to_position(static_cast<double>(corners[c]), static_cast<double>(corners[c + 1]),
                            static_cast<double>(corners[c + 2]), options.unit());
            if (!position) {
                return fail_at(options.source_name, 0, 0,
                               "a vertex of triangle " + std::to_string(i + 1) + " is not finite",
                               "repair the model, or check its unit");
            }
            model.mesh.positions.push_back(*position);
        }
        model.mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const std::uint64_t beyond = bytes.size() - kStlHeaderBytes - count * kStlFacetBytes;
    if (beyond > 0) {
        model.warnings.push_back({options.source_name, 0,
                                  std::to_string(beyond) + " bytes after the last of " +
                                      std::to_string(count) + " triangles were not read"});
    }
    return finish_model(std::move(model), options, Weld::exact);
}

}  // namespace

bool looks_like_stl(std::string_view bytes) {
    return has_binary_size(bytes) || is_text_stl(bytes);
}

Result<Model> read_stl(std::string_view bytes, const ModelOptions& options) {
    if (!has_binary_size(bytes) && is_text_stl(bytes)) return StlTextReader(bytes, options).read();
    return read_binary(bytes, options);
}

std::array<char, kStlHeaderBytes> stl_header(std::uint32_t triangles) {
    std::array<char, kStlHeaderBytes> header{};  // must not start with "solid"
    constexpr std::string_view note = "binary STL, millimetres, written by Tribo";
    std::copy(note.begin(), note.end(), header.begin());
    std::memcpy(header.data() + 80, &triangles, sizeof triangles);
    return header;
}

void put_stl_facet(const Point3f& a, const Point3f& b, const Point3f& c,
                   std::span<char, kStlFacetBytes> out) {
    const Vec3 at{a[0], a[1], a[2]};
    const Vec3 n = normalized(cross(Vec3{b[0], b[1], b[2]} - at, Vec3{c[0], c[1], c[2]} - at), {});
    const std::array<float, 12> values{static_cast<float>(n.x),
                                       static_cast<float>(n.y),
                                       static_cast<float>(n.z),
                                       a[0],
                                       a[1],
                                       a[2],
                                       b[0],
                                       b[1],
                                       b[2],
                                       c[0],
                                       c[1],
                                       c[2]};
    std::memcpy(out.data(), values.data(), sizeof values);
    out[48] = out[49] = 0;
}

bool write_stl(const TriangleMesh& mesh, const ByteSink& sink) {
    const auto header = stl_header(static_cast<std::uint32_t>(mesh.triangles.size()));
    if (!sink({header.data(), header.size()})) return false;
    constexpr std::size_t facets = 64 * 1024 / kStlFacetBytes;
    std::vector<char> buffer(facets * kStlFacetBytes);
    for (std::size_t done = 0; done < mesh.triangles.size();) {
        const std::size_t now = std::min(facets, mesh.triangles.size() - done);
        for (std::size_t i = 0; i < now; ++i) {
            const Triangle& t = mesh.triangles[done + i];
            put_stl_facet(
                mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]],
                std::span<char, kStlFacetBytes>(buffer.data() + i * kStlFacetBytes, kStlFacetBytes));
        }
        if (!sink({buffer.data(), now * kStlFacetBytes})) return false;
        done += now;
    }
    return true;
}

}  // namespace tribo::readers
