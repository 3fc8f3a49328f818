#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_format.sh [--fix]: clang-format 19 over every C++ source; without --fix, differences fail. With it the pages are formatted too,
# whose own check is in `web.sh test`.
source "$(dirname "$0")/environment.sh"

mode=(--dry-run --Werror)
if [ "${1:-}" = --fix ]; then
    mode=(-i)
    scripts/web.sh format
fi
find . \( -name build -o -name out -o -name node_modules \) -prune -o '(' -name '*.[ch]pp' -o -name '*.inl' ')' -print |
    sort | xargs -r -n 16 -P "$JOBS" clang-format-19 "${mode[@]}"
