#!/bin/sh
# Runs $1 commands (default: 500), each with 20 events, with the functions of docs/examples/reception.sh, while the caller cuts the link to
# ROIS_URL. Prints the outcome as JSON; web/client/tests/gateway/shell.test.ts checks it.
set -eu
wanted=${1:-500}
events_each=20
program=$(dirname "$0")/../../docs/examples/reception.sh
seen=$(mktemp)  # all notifications read, one a line
news=
trap 'rm -f "$seen" "$news" "$news.rest"' EXIT

set --  # the program reads its arguments
eval "$(sed '/^# --- The states of figure 1/,$d' "$program")"

request connect
session=$(text_of session "$answer")
request bind "$(ref navigation)"
request subscribe '<event_type>reached_target</event_type>' 'inline_results="true"'

# Targets at the robot's own position, so that it need not move; each has another number.
places() {
    place=$(($1 * events_each))
    last=$((place + events_each))
    printf '<rois:parameter rois:name="target_position"><rois:data_type_ref rois:code="string[]"/>'
    while [ "$place" -lt "$last" ]; do
        printf '<rois:value>4000, 5000, %de-9</rois:value>' "$place"
        place=$((place + 1))
    done
    printf '</rois:parameter>'
}

sent=0
while [ "$sent" -lt "$wanted" ]; do
    execute "go-$sent" "$(command "go-$sent" navigation start "$(places "$sent")")"
    until case $notification in *"<command_id>go-$sent</command_id>"*) ;; *) false ;; esac; do
        if next_notification 30; then printf '%s\n' "$notification" >>"$seen"; fi
    done
    sent=$((sent + 1))
done
request disconnect

awk '
    match($0, /sequence="[0-9]+"/) {
        sequence = substr($0, RSTART + 10, RLENGTH - 11) + 0
        if (sequence <= last) ++twice
        if (sequence > last + 1 && !/^<lost /) missed += sequence - last - 1
        last = sequence
    }
    /^<lost / { ++lost }
    /^<receive_event / {
        match($0, /[0-9]+e-9/)
        if (substr($0, RSTART, RLENGTH - 3) + 0 != events) ++disorder
        ++events
    }
    /^<completed / {
        ++completed
        if (/<status>OK</) ++good
        match($0, /<command_id>[^<]*/)
        if (names[substr($0, RSTART, RLENGTH)]++) ++again
    }
    END {
        printf "{\"good\": %d, \"events\": %d, \"out_of_order\": %d, ", good, events, disorder
        printf "\"completed\": %d, \"completed_twice\": %d, ", completed, again
        printf "\"twice\": %d, \"missed\": %d, \"lost\": %d}\n", twice, missed, lost
    }' "$seen"
