#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every test: form, g++ (release preset), WebAssembly in Node.js, the pages in Chromium; with clang (asan preset) the
# golden bits, for soak.sh runs every test of that build. Runs all, then says how each went.
source "$(dirname "$0")/environment.sh"
source scripts/presets.sh

say "form of the sources"
step "clang-format" scripts/check_format.sh
test_preset release
step "hardening" scripts/check_hardening.sh
say "clang"
step "clang: build" configure_and_build asan --target tribo test_golden
step "clang: golden bits" run_ctest asan -R '^golden\.'
step "clang-tidy" scripts/tidy.sh --changed
step "API reference" scripts/docs.sh
say "wasm"
step "wasm: build" configure_and_build wasm
say "web"
step "web: build and tests" scripts/web.sh test
closing_summary
