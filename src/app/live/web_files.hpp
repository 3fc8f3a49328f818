// SPDX-License-Identifier: MIT
// The built pages, held in memory for as long as they are served.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "files/files.hpp"
#include "net/server.hpp"

namespace tribo::app {

class WebFiles {
  public:
    // All files directly in the folder; NAME.br and NAME.gz beside NAME are its compressed forms.
    static FileResult<WebFiles> read(const std::string& folder);
    // Where this program finds the pages of `name`: beside it in a build, under share/tribo where installed.
    static std::string folder_of(const std::string& name);

    // "/" is index.html. Nothing beyond the files that were read.
    std::optional<net::Page> page(std::string_view path, net::AcceptedEncodings accepted) const;

  private:
    std::map<std::string, std::string, std::less<>> bytes_;  // by "/NAME"
};

}  // namespace tribo::app
