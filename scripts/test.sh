#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every test: form, g++ (release preset), clang (dev preset), WebAssembly in Node. Runs all, then says how each went.
source "$(dirname "$0")/environment.sh"
source scripts/presets.sh

say "form of the sources"
step "clang-format" scripts/check_format.sh
test_preset release
test_preset dev
test_preset wasm
closing_summary
