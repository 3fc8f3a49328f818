#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tidy.sh [ROOM...]: clang-tidy 19 over those rooms, or over all; slow. tidy.sh --changed [COMMIT]: over the sources of src/ that
# differ from COMMIT, the one before HEAD by default; `make test` runs this.
source "$(dirname "$0")/environment.sh"

cmake --preset dev >/dev/null
if [ "${1:-}" != --changed ]; then
    pattern="/src/($(IFS='|'; echo "${*:-[a-z]+}"))/"
    exec run-clang-tidy-19 -quiet -p build/dev -j "$JOBS" "$pattern"
fi
if ! base=$(git rev-parse --verify --quiet "${2:-HEAD~1}^{commit}"); then
    echo "no commit to compare with: clang-tidy is left out"
    exit 0
fi
# What was moved without a change is not looked at again.
mapfile -t changed < <(git diff --find-renames=95% --diff-filter=AM --name-only "$base" -- 'src/*.cpp' | grep -v '^src/wasm/' || true)
echo "${#changed[@]} sources differ from $(git log -1 --format=%h "$base")"
[ ${#changed[@]} -gt 0 ] || exit 0
printf '%s\n' "${changed[@]}" | xargs -P "$JOBS" -n 2 clang-tidy-19 -quiet -p build/dev
