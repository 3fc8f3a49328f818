#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes docs/film.mp4, with sound, and docs/film.webp, the picture of the README: the first half minute of the mill page. Takes a quarter
# of an hour on a quiet machine. Needs `make build`, Chromium and ffmpeg.
set -euo pipefail
cd "$(dirname "$0")/../web"
for program in ffmpeg chromium; do
    command -v "$program" >/dev/null || { echo "docs/film.sh: $program is missing; try: apt-get install $program" >&2; exit 1; }
done
exec npm run --silent film -w mill
