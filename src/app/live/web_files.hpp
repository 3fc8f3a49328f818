// SPDX-License-Identifier: MIT
// The built pages, kept in memory while they are served.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "files/files.hpp"
#include "net/server.hpp"

namespace tribo::app {

class WebFiles {
  public:
    // Reads all files in the folder. NAME.br and NAME.gz are compressed forms of NAME.
    static FileResult<WebFiles> read(const std::string& folder);
    // Folder of the pages `name`: beside the program in a build, under share/tribo after installation.
    static std::string folder_of(const std::string& name);

    // "/" is index.html. Only files from read() are served.
    std::optional<net::Page> page(std::string_view path, net::AcceptedEncodings accepted) const;

  private:
    std::map<std::string, std::string, std::less<>> bytes_;  // by "/NAME"
};

}  // namespace tribo::app
