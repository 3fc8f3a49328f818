#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds what users get: build/release/tribo with its libraries, the modules build/wasm/*.wasm, and the pages in build/web
# where there is a Node.js.
source "$(dirname "$0")/environment.sh"

cmake --preset release >/dev/null
cmake --build --preset release --target product
cmake --preset wasm >/dev/null
cmake --build --preset wasm
scripts/web.sh build
