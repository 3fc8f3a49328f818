# SPDX-License-Identifier: MIT
# Sourced by test.sh and soak.sh: run steps one after the other, remember how each went, and say so at the end.
SUMMARY=()
COUNTS=()
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

# run_ctest PRESET [ctest option...]: prints failures, or how many tests passed; the summary says the number again.
run_ctest() {
    local preset=$1 log=build/$1/ctest.log count
    shift
    if ctest --preset "$preset" --no-tests=error --timeout 600 -j "$JOBS" "$@" >"$log" 2>&1; then
        count=$(grep -m 1 'tests passed' "$log")
        COUNTS+=("$preset: $count")
        printf '%s\n' "$count"
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
    printf '%s\n' "${SUMMARY[@]}" ${COUNTS[@]+"${COUNTS[@]}"}
    if [ "$FAILED" -ne 0 ]; then fail "not everything passed"; fi
    echo "everything passed"
}
