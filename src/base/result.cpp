// SPDX-License-Identifier: MIT
#include "base/result.hpp"

#include "base/text/printable.hpp"

namespace tribo {
namespace {

std::string place(const std::string& file, int line, int column) {
    std::string text = file;
    if (line > 0) text += (text.empty() ? "line " : ":") + std::to_string(line);
    if (line > 0 && column > 0) text += ":" + std::to_string(column);
    if (!text.empty()) text += ": ";
    return text;
}

}  // namespace

std::string Error::text() const {
    return printable(place(file, line, column) + "error: " + cause + (remedy.empty() ? "" : "; " + remedy));
}

std::string Warning::message() const {
    return printable(place(file, line, 0) + "warning: " + text);
}

}  // namespace tribo
