# SPDX-License-Identifier: MIT
# Sourced by the other scripts: strict shell, repository root, compiler cache, parallel jobs, the Node.js to use.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
JOBS=${JOBS:-$(nproc)}
export CMAKE_BUILD_PARALLEL_LEVEL=$JOBS

# What scripts/setup.sh installed where the system has no Node.js that is new enough.
LOCAL_NODE=$PWD/build/node
if [ -x "$LOCAL_NODE/node_modules/.bin/node" ]; then PATH=$LOCAL_NODE/node_modules/.bin:$PATH; fi

say() { printf '\n== %s\n' "$*"; }
fail() { printf 'error: %s\n' "$*" >&2; exit 1; }
