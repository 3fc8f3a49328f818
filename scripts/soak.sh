#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# soak.sh short|long: the tests under the address, undefined-behaviour and thread sanitizers, minutes or an hour of
# sound at random, then every fuzz target for a while from its corpus; long also plays the live view for twenty minutes,
# looks at the golden bits of an optimised clang, and compares builds in two folders.
# What fuzzing finds is left under build/fuzz/crashes/, nothing in the source tree.
source "$(dirname "$0")/environment.sh"
source scripts/presets.sh

# Under the address sanitizer each of them takes half a minute to five. Other tests run the same code.
long_with_addresses=(
    app.CompareVerb.of_render_folders_with_ app.CompareVerb.refuses_what_ app.CutSound.has_the_third_
    app.CutSound.learned_from_a_cut_ app.FeedVerb.is_faster_ app.Freehand/RubRecordings. app.JobCutter.run_out_leaves_
    app.Limits.of_flags_ app.PartMesh.deviates_ app.PartMesh.of_every_example_ app.Program.and_the_job_
    app.RenderChatter.begins_and_ends_ app.RenderChatter.howls_where_ app.RenderChatter.says_that_its_modes_
    app.StabilityVerb.asks_for_ app.StabilityVerb.chooses_ app.StabilityVerb.refuses_ dynamics.ModeFit.finds_two_close_
    dynamics.Stability.of_many_cuts_
    field.Contour.keeps_a_wall_that_ field.Contour.of_wide_layers_ field.ContourMend.of_random_ field.ContourMend.reaches_
    field.ContourRefine.follows_round_ field.ContourRefine.of_random_
    haptics.CarvedPersistence.no_milled_ haptics.PressCycle.no_edge_catches_ job.Loader.keeps_to_the_memory_ milling.MilledMesh.
    milling.NearestPoint.is_the_shortest_of_all_rays_over_a_grid_ noise.Learning.takes_as_many_ noise.Texture.is_the_surfaces_
    readers.GcodeReader.RefusesLoopsByTheCh readers.Heidenhain.RefusesLoopsOf readers.VrmlLimitsDeathTest.
    session.EnergyBalance.holds_for_random_ session.ForceBySteps. session.LiveChanges.TellsTheBands session.ProfileCut.does_the_work_
    surface.NearestDeviation.rest_and_gouge_
)
# Under the thread sanitizer each of them takes ten seconds to eighty. Other tests run the same verbs in the same threads.
long_with_threads=(
    app.CompareVerb.gives_the_flags_ app.CompareVerb.joins_another_ app.CompareVerb.of_a_job_with_itself_ app.CompareVerb.refuses_
    app.CompareVerb.says_what_a_folder_ app.FeedVerb.is_faster_ app.FeedVerb.unrolls_a_loop_in_ app.Press.refuses_
    app.Program.and_the_job_ app.Program.with_wrong_flags_ app.StabilityVerb.asks_for_ app.StabilityVerb.chooses_
    app.StabilityVerb.refuses_ app.Uncertain.refuses_
)
# One group: the regular expressions of ctest take ten at most, and then match nothing.
one_of() {
    local IFS='|'
    printf '^(%s)' "${*//./\\.}"
}
# The same for tests that share a process, which know no room: a filter of GoogleTest.
none_of() {
    local IFS=:
    printf -- '-%s' "${*/%/*}"
}
minutes=$(one_of "${long_with_addresses[@]}")
minutes_filter=$(none_of "${long_with_addresses[@]#*.}")
thread_minutes=$(one_of "${long_with_threads[@]}")

case ${1:-short} in
    short) fuzz_seconds=10 sound=Minutes ;;
    long) fuzz_seconds=900 sound=Hour minutes= minutes_filter='*' thread_minutes= ;;
    *) fail "soak.sh takes short or long" ;;
esac

thread_sanitizer() {
    configure_and_build tsan && TSAN_OPTIONS="suppressions=$PWD/scripts/thread_sanitizer.supp" \
        run_ctest tsan ${thread_minutes:+-E "$thread_minutes"}
}

# Random speeds, places and spindles: no NaN, nothing beyond full scale, no click.
long_sound() {
    build/asan/tests/test_session --gtest_also_run_disabled_tests --gtest_brief=1 --gtest_filter="DISABLED_$sound/LongSound.*"
}

fuzz_one() {
    local reader=$1 seconds=$2 work=build/fuzz/grown/$1 log=build/fuzz/grown/$1.log
    mkdir -p "$work" build/fuzz/crashes
    local seeds=("fuzz/corpus/$reader")
    # Programs in the style of many posts, which a test reads too.
    [[ $reader =~ ^(apt|gcode|heidenhain|siemens)$ ]] && seeds+=(tests/job/posts)
    # Findings go to the first folder; the committed corpus is only read.
    if "build/asan/fuzz/fuzz_$reader" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/crashes/$reader-" "$work" "${seeds[@]}" >"$log" 2>&1; then
        printf '%-12s %s\n' "$reader" "$(sed -n 's/^stat::number_of_executed_units: */runs: /p' "$log")"
    else
        touch "build/fuzz/crashes/$reader.failed"
        return 1
    fi
}
export -f fuzz_one

# Last of all, so that it is not lost above the others: what failed, where, and the input where it is small.
show_findings() {
    local failed reader
    for failed in build/fuzz/crashes/*.failed; do
        reader=$(basename "$failed" .failed)
        say "fuzz_$reader failed; the input is under build/fuzz/crashes/"
        tail -n 60 "build/fuzz/grown/$reader.log"
    done
    return 1
}

fuzz_all() {
    local readers
    mapfile -t readers < <(ls fuzz | sed -n 's/^fuzz_\(.*\)\.cpp$/\1/p')
    if [ ${#readers[@]} -eq 0 ]; then return; fi
    rm -rf build/fuzz/crashes
    configure_and_build asan --target fuzzers &&
        { printf '%s\n' "${readers[@]}" | xargs -P "$JOBS" -I{} bash -c "fuzz_one {} $fuzz_seconds" || show_findings; }
}

# Ten minutes of live play at full speed with clients that never read, ten with a crowd of viewers; a sweep whose node dies.
long_play() {
    configure_and_build release --target test_app &&
        build/release/tests/test_app --gtest_also_run_disabled_tests --gtest_filter='Live*.DISABLED_*:SlurmSweep.DISABLED_*'
}

# Tests that are named DISABLED_, as they take minutes: the whole grid of strokes of a probe over milled stock, ten
# million points of five-axis sweeps, ten thousand rounds of two writers of one file.
long_tests() {
    configure_and_build release --target test_files test_haptics test_milling || return 1
    local room
    for room in files haptics milling; do
        "build/release/tests/test_$room" --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_*' --gtest_brief=1 || return 1
    done
}

say "address sanitizer"
step "asan: build" configure_and_build asan
# Ten long tests together take longer than one may.
asan_options=(--timeout 7200)
# `make test` looks at the golden bits of this build.
[ -z "$minutes" ] || asan_options=(-E "$minutes|^golden\\.")
GTEST_FILTER=$minutes_filter step "asan: tests" run_ctest asan "${asan_options[@]}"
if [ "${1:-short}" = long ]; then
    say "long tests"
    step "long tests" long_tests
fi
say "sound at random: ${sound,,}"
step "long sound" long_sound
say "thread sanitizer"
step "tsan" thread_sanitizer
say "fuzzing, $fuzz_seconds s a target"
step "fuzz" fuzz_all
if [ "${1:-short}" = long ]; then
    say "long play"
    step "long play" long_play
    say "optimised clang"
    step "clang: build" configure_and_build dev --target tribo test_golden
    step "clang: golden bits" run_ctest dev -R '^golden\.'
    say "two builds"
    step "same bits" scripts/check_reproducible.sh
fi
closing_summary
