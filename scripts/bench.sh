#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Measures and leaves build/bench.json.
source "$(dirname "$0")/environment.sh"

cmake --preset bench >/dev/null
cmake --build --preset bench
build/bench/bench/tribo_bench --json build/bench.json
