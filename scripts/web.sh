#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# web.sh build|test|format: the web component, the static site (build/web/site, out of touch.wasm and learn.wasm of build/wasm) and the
# live view's page (build/web/viewer). `test` also checks types, lint and format; `format` mends the format. Without a Node.js that is new
# enough `build` and `format` say so and leave them out.
source "$(dirname "$0")/environment.sh"

if ! command -v npm >/dev/null ||
    ! node -e 'const [a, b] = process.versions.node.split(".").map(Number); process.exit(a > 20 || (a === 20 && b >= 19) ? 0 : 1)'; then
    [ "$1" != test ] || fail "the web tests need Node.js 20.19 or newer and npm"
    echo "no Node.js 20.19 or npm: the pages of \`tribo live\` and \`tribo site\` are left out (\`make test\` installs both)"
    exit 0
fi

cd web
installed() { [ -e node_modules/.package-lock.json ] && [ ! package-lock.json -nt node_modules/.package-lock.json ]; }
installed || npm ci --loglevel=error --no-audit --no-fund
if [ "$1" = format ]; then
    npm run --silent format
    exit 0
fi
npm run --silent build
[ "$1" = test ] || exit 0
npm run --silent check
# What failed is said once more at the end, where it is looked for.
log=$PWD/../build/web/tests.log
npm test --silent 2>&1 | tee "$log" && exit 0
grep -a ' FAIL ' "$log"
exit 1
