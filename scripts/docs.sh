#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# docs.sh: the API reference of the headers that are installed (cmake/public_headers.cmake) into build/docs/html. What Doxygen
# warns of fails it.
source "$(dirname "$0")/environment.sh"

command -v doxygen >/dev/null || fail "doxygen is missing: make docs installs it"
headers=$(grep -oE '^ +[a-z_0-9/]+\.hp*' cmake/public_headers.cmake | sed 's#^ *#src/#')
mkdir -p build/docs
{
    cat docs/Doxyfile
    echo "PROJECT_NUMBER = $(sed -n 's/^project(tribo VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
    echo "OUTPUT_DIRECTORY = build/docs"
    echo "INPUT = src/tribo/README.md" ${headers//$'\n'/ }
} | doxygen -
echo "build/docs/html/index.html"
