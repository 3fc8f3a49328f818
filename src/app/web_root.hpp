// SPDX-License-Identifier: MIT
// Where the built pages lie, for the verbs that hand them on.
#pragma once

#include <string>

#include "io/files.hpp"

namespace tribo::app {

// The folder `part` of the web files: under `web_root` where the user names one, else beside the program as
// `make install` puts it (../share/tribo/web) or as `make build` does (../web). Refused where there is none.
io::FileResult<std::string> find_web_files(const std::string& web_root, const std::string& part);

}  // namespace tribo::app
