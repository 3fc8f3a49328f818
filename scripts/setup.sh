#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# setup.sh SECTION...: installs the Debian packages of those sections of packages.txt that are missing; with `test` or
# `page` also a Node.js of at least 20.19, unless one is there: `page` does without where none can be had. Calls apt only
# when something is missing.
source "$(dirname "$0")/environment.sh"

packages_of() {
    awk -v wanted="[$1]" '/^\[/ { on = $0 == wanted; next } on && NF && !/^#/ { print $1 }' packages.txt
}
missing_of() {
    local installed
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' || true)
    printf '%s\n' "$@" | grep -vxF "$installed" || true
}
install_packages() {
    [ $# -gt 0 ] || return 0
    local root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; } ||
            fail "root is needed once; run: apt-get install --no-install-recommends $*"
        root=(sudo)
    fi
    say "installing $*"
    "${root[@]}" apt-get update -qq || echo "apt-get update failed; trying with the lists that are there" >&2
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$@" >/dev/null
}
node_is_new_enough() {
    command -v node >/dev/null &&
        node -e 'const [a, b] = process.versions.node.split(".").map(Number); process.exit(a > 20 || (a === 20 && b >= 19) ? 0 : 1)'
}

command -v dpkg-query >/dev/null ||
    fail "this is not Debian; install what packages.txt names by hand and call cmake --preset release"
wanted=()
for section in "$@"; do mapfile -t -O ${#wanted[@]} wanted < <(packages_of "$section"); done
mapfile -t missing < <(missing_of "${wanted[@]}")
install_packages "${missing[@]}"

install_node() {
    command -v npm >/dev/null || install_packages npm
    say "installing Node.js 20 under build/node"
    npm install --loglevel=error --no-audit --no-fund --prefix "$LOCAL_NODE" node@20 >/dev/null ||
        fail "npm could not fetch Node.js 20; install one by hand, at least 20.19, and run this again"
    PATH=$LOCAL_NODE/node_modules/.bin:$PATH
    node_is_new_enough || fail "Node.js 20.19 or newer is needed and npm did not give one"
}
if [[ " $* " == *" test "* ]] && ! node_is_new_enough; then
    install_node
elif [[ " $* " == *" page "* ]] && ! node_is_new_enough; then
    (install_node) || echo "going on without Node.js: the pages are left out" >&2
fi
