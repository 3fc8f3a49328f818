#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every test: form, g++ (release preset), WebAssembly in Node.js, the pages in Chromium; with clang (dev preset) the
# golden bits, for soak.sh runs every test with clang. Runs all, then says how each went.
source "$(dirname "$0")/environment.sh"
source scripts/presets.sh

say "form of the sources"
step "clang-format" scripts/check_format.sh
test_preset release
step "hardening" scripts/check_hardening.sh
say "dev"
step "dev: build" configure_and_build dev --target tribo test_golden
step "dev: golden bits" run_ctest dev -R '^golden\.'
step "clang-tidy" scripts/tidy.sh --changed
step "API reference" scripts/docs.sh
say "wasm"
step "wasm: build" configure_and_build wasm
say "web"
step "web: build and tests" scripts/web.sh test
closing_summary
