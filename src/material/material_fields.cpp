// SPDX-License-Identifier: MIT
#include "material/material_fields.hpp"

#include "material/material_schema.hpp"

namespace tribo::material {
namespace {

class FieldList {
  public:
    static constexpr bool kReads = true;

    explicit FieldList(std::vector<Field>& fields) : fields_(fields) {}

    void schema(const char*) { add({.key = "schema", .required = true, .most = kLongestText}); }
    void text(const char* key, std::string&) { add({.key = key, .most = kLongestText}); }
    template <class Number>
    void number(const char* key, Number&, Range range, std::optional<Absent> absent = {}) {
        Field field{.key = key, .kind = FieldKind::number, .range = range, .required = !absent};
        if (absent) field.absent = absent->value;
        add(std::move(field));
    }
    void numbers(const char* key, std::vector<double>&, Range range, std::size_t most) {
        add({.key = key, .kind = FieldKind::numbers, .range = range, .required = true, .most = most});
    }
    void numbers(const char* key, std::optional<std::vector<double>>&, Range range, std::size_t most) {
        add({.key = key, .kind = FieldKind::numbers, .range = range, .most = most});
    }
    void tables(const char* key, std::vector<std::vector<double>>&, Range range, std::size_t most) {
        add({.key = key, .kind = FieldKind::tables, .range = range, .required = true, .most = most});
    }
    template <class T>
    bool object(const char* key, T& value, bool) {
        Field field{.key = key, .kind = FieldKind::object};
        FieldList inner(field.fields);
        describe(inner, value);
        add(std::move(field));
        return true;
    }
    template <class T>
    void object(const char* key, std::optional<T>& value) {
        object(key, value.emplace(), true);
    }
    template <class Item>
    void objects(const char* key, std::size_t most, std::size_t, const Item& item) {
        Field field{.key = key, .kind = FieldKind::objects, .most = most};
        FieldList inner(field.fields);
        item(inner, 0);
        add(std::move(field));
    }
    template <class Part>
    void unheard(const Part& part) {
        heard_ = false;
        part(*this);
        heard_ = true;
    }
    void expect(bool, const char*, const char*, const char*) {}

  private:
    void add(Field field) {
        field.heard = heard_;
        fields_.push_back(std::move(field));
    }

    std::vector<Field>& fields_;
    bool heard_ = true;
};

}  // namespace

const std::vector<Field>& material_fields() {
    static const std::vector<Field> fields = [] {
        std::vector<Field> list;
        FieldList visitor(list);
        Material material;
        describe(visitor, material);
        return list;
    }();
    return fields;
}

}  // namespace tribo::material
