#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tidy.sh [ROOM...]: clang-tidy 19 over those rooms, or over all; slow, so not part of `make test`.
source "$(dirname "$0")/environment.sh"

cmake --preset dev >/dev/null
pattern="/src/($(IFS='|'; echo "${*:-[a-z]+}"))/"
run-clang-tidy-19 -quiet -p build/dev -j "$JOBS" "$pattern"
