// SPDX-License-Identifier: MIT
#include "field/carved/field_reader.hpp"

namespace tribo::field {

FieldReader::FieldReader(CarvedField& field)
    : show_(field.begin_show()), reading_(show_.take()), field_(field) {}

FieldReader::~FieldReader() {
    field_.end_show();
}

bool FieldReader::refresh() {
    const ShownField* newest = show_.take();
    if (newest != nullptr) reading_ = newest;
    return newest != nullptr;
}

}  // namespace tribo::field
