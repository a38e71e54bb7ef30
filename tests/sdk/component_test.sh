#!/usr/bin/env bash
# Both lamps and a robot pass rois-component-test. It detects the broken rule of each variant of broken_lamp.py.
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

# judge NAME PROGRAM...: runs rois-component-test in the background, at most 12 at once. Writes its exit code to NAME.status.
judge() {
    local name=$1
    shift
    while (($(jobs -rp | wc -l) >= 12)); do wait -n; done
    {
        "$bin/rois-component-test" --patience 3 --report "$work/$name.xml" "$@" >"$work/$name" 2>"$work/$name.log" && echo 0 || echo $?
    } >"$work/$name.status" &
}
# breaks VARIANT CHECK: expects that CHECK detects the broken rule of VARIANT.
checks=()
breaks() {
    judge "$1" --only "$2" python3 -B "$here/broken_lamp.py" "$1"
    checks+=("$1 $2")
}

judge python python3 -B "$root/components/sdk/python/lamp.py"
judge cpp "$bin/rois-lamp"
judge robot --only answers_ "$bin/rois-test-robot"
breaks answers_twice keeps_its_session_after_a_second_connect
breaks answers_without_request_id opens_a_session
breaks completes_twice completes_start_once
breaks never_completes completes_start_once
breaks does_not_halt stop_ends_a_running_start
breaks answers_with_a_wrong_type answers_the_query_light
breaks answers_with_another_declared_type answers_the_query_light
breaks answers_without_a_result answers_the_query_light
breaks reports_a_wrong_event completes_start_once
breaks reports_without_a_subscription reports_no_event_without_a_subscription
breaks accepts_any_argument refuses_an_invalid_times_of_blink
breaks runs_what_is_only_checked does_not_run_start_with_check_only
breaks has_no_instance has_a_profile
breaks joins_under_a_new_instance rejoins_as_the_same_instance
breaks forgets_what_it_has_sent knows_its_commands_when_the_link_returns
breaks forgets_how_a_command_has_ended knows_its_commands_when_the_link_returns
breaks drops_notifications_while_the_link_is_down keeps_completions_while_the_link_is_down
breaks drops_events_while_the_link_is_down keeps_events_while_the_link_is_down
breaks forgets_its_subscriptions_with_the_link keeps_its_subscriptions_while_the_link_is_down
breaks halts_when_the_link_is_lost goes_on_while_the_link_is_down
breaks resumes_any_session refuses_to_resume_an_unknown_session
breaks never_ends_its_session ends_its_session_after_the_window
breaks keeps_its_session_for_a_new_engine opens_a_new_session_for_a_restarted_engine
breaks sends_an_invalid_document keeps_its_session_after_a_second_connect
breaks ignores_the_end ends_on_sigterm
breaks keeps_its_session_after_disconnect ends_its_session_on_disconnect
breaks goes_on_after_its_session disconnect_ends_blink
breaks goes_on_after_release release_ends_blink
breaks goes_on_after_stop stop_ends_blink
breaks reports_no_active_function reports_in_active_whether_start_began_a_function
breaks switches_on_when_it_checks does_not_run_blink_with_check_only
breaks accepts_a_fraction refuses_an_invalid_times_of_blink
breaks drops_requests_behind_a_query answers_requests_behind_the_query_light
breaks reports_each_event_twice completes_start_once
breaks ignores_pings answers_a_ping
breaks moves_without_signs_of_life is_halted_without_signs_of_life
judge session_end --only ends_its_session_after_the_window python3 -B "$here/broken_lamp.py" goes_on_after_its_session
judge resets --only keeps_active_functions python3 -B "$here/broken_lamp.py" halts_when_the_link_is_lost
judge ended true
judge missing "$work/missing"
judge not_executable "$here/broken_lamp.py"
judge stays_on --only reports_in_active python3 -B "$here/broken_lamp.py" stays_on_after_stop
judge moving --only is_halted python3 -B "$here/broken_lamp.py" moves
wait

# The commands of the lamp in C++ complete at once.
declare -A unobserved=([python]=0 [cpp]=3)
for lamp in python cpp; do
    [[ $(<"$work/$lamp.status") == 0 ]] || fail "the lamp in $lamp: exit code $(<"$work/$lamp.status")" "$work/$lamp"
    grep -q " 0 found a broken rule, 0 not played, ${unobserved[$lamp]} not observable" "$work/$lamp" || fail "the lamp in $lamp" "$work/$lamp"
    grep -q '<testsuite name="Component lamp"' "$work/$lamp.xml" || fail "no JUnit report" "$work/$lamp.xml"
done
grep -q ' checks held, 0 found a broken rule' "$work/robot" || fail "the robot" "$work/robot"
grep -q 'BROKEN *ends_its_session_after_the_window ' "$work/session_end" || fail "goes_on_after_its_session" "$work/session_end"
grep -q 'BROKEN *keeps_active_functions_while_the_link_is_down ' "$work/resets" || fail "halts_when_the_link_is_lost" "$work/resets"
grep -q 'BROKEN *ends_on_sigterm ' "$work/ended" || fail "a program that ends at once" "$work/ended"
for each in missing not_executable; do
    [[ $(<"$work/$each.status") == 2 ]] || fail "$each program: expected exit code 2, not $(<"$work/$each.status")" "$work/$each.log"
    grep -q 'cannot start' "$work/$each.log" || fail "$each program: expected a reason" "$work/$each.log"
done
grep -q 'not observable *reports_in_active_whether_start_began_a_function ' "$work/stays_on" || fail "stays_on_after_stop" "$work/stays_on"
grep -q 'holds *is_halted_without_signs_of_life ' "$work/moving" || fail "moves" "$work/moving"
for each in "${checks[@]}"; do
    read -r variant check <<<"$each"
    grep -q "BROKEN *$check " "$work/$variant" || fail "$variant: expected a broken $check" "$work/$variant"
    [[ $(<"$work/$variant.status") == 1 ]] || fail "$variant: expected exit code 1, not $(<"$work/$variant.status")" "$work/$variant"
done
