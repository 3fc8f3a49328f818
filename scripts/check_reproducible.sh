#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_reproducible.sh: the committed sources, built in two folders without the compiler's cache, give the same program, bit by bit.
source "$(dirname "$0")/environment.sh"

export CCACHE_DISABLE=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for folder in one a/longer/two; do
    git clone --quiet . "$work/$folder"
    (
        cd "$work/$folder"
        cmake --preset release -DTRIBO_TESTS=OFF >/dev/null
        cmake --build --preset release --target tribo
    )
done
cmp "$work/one/build/release/tribo" "$work/a/longer/two/build/release/tribo" ||
    fail "two builds of the same sources differ; look for paths, times and random names in the program"
sha256sum <"$work/one/build/release/tribo"
