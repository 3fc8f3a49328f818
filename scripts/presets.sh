# SPDX-License-Identifier: MIT
# Sourced by test.sh and soak.sh: run steps one after the other, remember how each went, and say so at the end.
SUMMARY=()
FAILED=0

# step NAME COMMAND...: runs on after a failure.
step() {
    local name=$1 begin=$SECONDS result=passed
    shift
    "$@" || { result=FAILED; FAILED=1; }
    SUMMARY+=("$(printf '%-22s %-7s %4d s' "$name" "$result" $((SECONDS - begin)))")
}

configure_and_build() {
    local preset=$1
    shift
    cmake --preset "$preset" >/dev/null && cmake --build --preset "$preset" "$@"
}

# run_ctest PRESET [ctest option...]: prints failures and the closing lines only.
run_ctest() {
    local preset=$1 log=build/$1/ctest.log
    shift
    if ctest --preset "$preset" --no-tests=error --timeout 600 -j "$JOBS" "$@" >"$log" 2>&1; then
        tail -n 4 "$log"
    else
        grep -v ' Passed ' "$log" | tail -n 200
        return 1
    fi
}

# test_preset PRESET [ctest option...]
test_preset() {
    say "$1"
    step "$1: build" configure_and_build "$1"
    step "$1: tests" run_ctest "$@"
}

closing_summary() {
    say "summary"
    printf '%s\n' "${SUMMARY[@]}"
    if [ "$FAILED" -ne 0 ]; then fail "not everything passed"; fi
    echo "everything passed"
}
