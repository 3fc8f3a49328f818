#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# learn.sh TRIBO WORK: makes the synthetic recordings and images in WORK and learns the four materials beside this
# file from them. Needs Node and ImageMagick.
set -euo pipefail
tribo=$1 work=$2 here=$(cd "$(dirname "$0")" && pwd)

node "$here/make_materials.mjs" "$work"
learn() {  # name, K and nu (the paper's), gloss, roughness and pile
    convert "$work/$1.png" -quality 78 "$here/$1.jpg"
    local recordings=()
    for speed in 40 120 360; do recordings+=(--recording "$speed:$work/$1_$speed.wav"); done
    "$tribo" learn "${recordings[@]}" --stiffness "$2" --viscosity "$3" --gloss "$4" --roughness "$5" --pile "$6" --image "$here/$1.jpg" --width-mm 80 \
        --note "synthetic: sound and image were computed by make_materials.mjs, nothing was recorded; K and nu are the touch paper's" \
        --out "$here/$1.json"
}
learn sponge 1.4 0.1 0.02 0.9 0
learn paper 7 0.3 0.05 0.4 0
learn towel 7 0.3 0.02 0.9 0.15
learn carpet 4 0.3 0.03 0.7 0.6
