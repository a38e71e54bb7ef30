#!/usr/bin/env bash
# rois-component-test passes both lamps, and finds the broken rule of each lamp of broken_lamp.py.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
bin=$ROIS_BINARY_DIR/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    printf '%s\n' "$1" >&2
    cat "$2" >&2
    exit 1
}

for program in "python3 -B $root/components/sdk/python/lamp.py" "$bin/rois-lamp"; do
    # shellcheck disable=SC2086
    "$bin/rois-component-test" --report "$work/report.xml" $program >"$work/out" 2>"$work/log" || fail "$program: $(<"$work/log")" "$work/out"
    grep -q '<testsuite name="Component lamp"' "$work/report.xml" || fail "no JUnit report" "$work/report.xml"
    grep -q ' 0 found a broken rule' "$work/out" || fail "$program" "$work/out"
done

# find VARIANT CHECK: the check finds the broken rule.
find() {
    local status=0
    "$bin/rois-component-test" --patience 2 python3 -B "$here/broken_lamp.py" "$1" >"$work/$1" 2>/dev/null || status=$?
    [[ $status == 1 ]] && grep -q "BROKEN *$2 " "$work/$1" || fail "$1: expected exit code 1, not $status, and a broken $2" "$work/$1"
}
find answers_twice keeps_its_session
find answers_without_request_id knows_no_session_at_first
find completes_twice completes_start_once
find never_completes completes_start_once
find does_not_halt halts_while_it_runs
find answers_with_a_wrong_type answers_the_query_light
find answers_without_a_result answers_the_query_light
find reports_a_wrong_event completes_blink_once
find reports_without_a_subscription completes_blink_once
find accepts_any_argument refuses_a_wrong_times_of_blink
find runs_what_is_only_checked only_checks_start
find has_no_instance has_a_profile
find joins_under_a_new_instance joins_again_as_the_same_instance
find forgets_what_it_has_sent keeps_what_it_reports_meanwhile
find resumes_any_session knows_no_session_at_first
find never_ends_its_session ends_its_session_after_the_window
find keeps_its_session_for_a_new_engine begins_anew_with_a_restarted_engine
find sends_an_invalid_document opens_a_session
find ignores_the_end ends_on_sigterm
