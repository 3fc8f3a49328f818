#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_hardening.sh [PROGRAM]: shows that the program is built as cmake/TriboHardening.cmake says. Reads the file itself, so that
# it also tells of an option that the compiler took and did not obey.
source "$(dirname "$0")/environment.sh"

program=${1:-build/release/tribo}
[ -f "$program" ] || fail "$program is not there; build it first"
header=$(readelf -hW "$program")
segments=$(readelf -lW "$program")
dynamic=$(readelf -dW "$program")
imports=$(readelf --dyn-syms -W "$program")
missing=0

# check WHAT COMMAND...: the command succeeds where the program has it.
check() {
    local what=$1
    shift
    if "$@"; then
        printf '  %-26s yes\n' "$what"
    else
        printf '  %-26s NO\n' "$what"
        missing=1
    fi
}
holds() { grep -Eq -- "$2" <<<"$1"; }
lacks() { ! holds "$1" "$2"; }
marks_jump_targets() {
    # The mark is an instruction at the start of a function that may be called by its address.
    case $(uname -m) in
        x86_64) mark=endbr64 ;;
        aarch64) mark='(bti|paciasp)' ;;
        *) return 0 ;;
    esac
    objdump -d --no-show-raw-insn --disassemble=main "$program" | grep -Eq "$mark"
}

echo "$program"
check "any place in memory (PIE)" holds "$header" 'Type: +DYN'
check "... and a program" holds "$segments" 'INTERP'
check "read-only tables (RELRO)" holds "$segments" 'GNU_RELRO'
check "... all of them (NOW)" holds "$dynamic" 'BIND_NOW|FLAGS_1.*NOW'
check "stack not executable" holds "$segments" 'GNU_STACK.* RW '
check "no segment to write and run" lacks "$segments" 'LOAD.* RWE '
check "no code rewritten at start" lacks "$dynamic" 'TEXTREL'
check "no folder to search first" lacks "$dynamic" 'RPATH|RUNPATH'
check "stack protector" holds "$imports" '__stack_chk_fail'
check "checked C calls (FORTIFY)" holds "$imports" '__[a-z]+_chk'
check "jump targets (CET, BTI)" marks_jump_targets
[ "$missing" -eq 0 ] || fail "$program lacks hardening; see cmake/TriboHardening.cmake"
