#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Renders the main example, says where its files are, and on a terminal shows it being milled in a browser.
source "$(dirname "$0")/environment.sh"

build/release/tribo render examples/bowl/bowl.toml --out out/bowl
say "summary"
cat out/bowl/summary.json
say "files"
ls -l out/bowl | awk 'NR > 1 { printf "out/bowl/%-16s %9.1f kB\n", $NF, $5 / 1000 }'
echo "open out/bowl/report.html in a browser"

if [ -t 0 ] && [ -t 1 ]; then
    if [ -e build/web/viewer/index.html ]; then
        say "the same cut, live; Ctrl-C ends it"
        code=0
        build/release/tribo live examples/bowl/bowl.toml --open || code=$?
        [ "$code" -eq 130 ] || exit "$code"
    else
        echo "no Node.js, no page: install Node.js 20.19 or newer for the live view, or run 'make setup'"
    fi
fi
