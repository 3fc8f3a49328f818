#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Renders the main example and says where its files are.
source "$(dirname "$0")/environment.sh"

build/release/tribo render examples/bowl/bowl.toml --out out/bowl
say "summary"
cat out/bowl/summary.json
say "files"
ls -l out/bowl | awk 'NR > 1 { printf "out/bowl/%-16s %9.1f kB\n", $NF, $5 / 1000 }'
echo "open out/bowl/report.html in a browser"
