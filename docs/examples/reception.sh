#!/bin/sh
# The reception scenario of the specification (figure 1) with curl and a POSIX shell:
# wait for a person, go there, find out who it is, give this visitor their message or ask, bow, say goodbye, return to the start.
#
# docs/examples/reception.sh -h prints the usage.
set -eu

use='use: reception.sh [VISITORS]     the number of visitors to receive; default: 1
ROIS_URL is the URL of the gateway; default: http://127.0.0.1:8080 (started by ./dev run).
ROIS_TOKEN is the token that it expects, if it expects one.
The history goes to standard output, one line a visitor; each step goes to standard error.'
visitors=${1-1}
case $visitors in
    -h | --help) printf '%s\n' "$use"; exit 0 ;;
    '' | 0* | *[!0-9]* | ???????*)
        printf "reception.sh: VISITORS is a whole number, 1 to 999999, not '%s'\n" "$visitors" >&2
        exit 2
        ;;
esac
url=${ROIS_URL:-http://127.0.0.1:8080}
url=${url%/}
if [ -n "${ROIS_TOKEN-}" ] && ! printf '%s\n' "$url" | grep -qE '^(https://|http://(localhost|127\.0\.0\.1|\[::1\])(:[0-9]+)?(/|$))'; then
    printf 'reception.sh: a token cannot be sent to %s: use https\n' "$url" >&2
    exit 2
fi
names='xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
session=
answer=         # the last answer
after=0         # the sequence of the last notification that was handled
notification=   # the last notification that was handled
broken=         # the time since which no request is answered; after ten seconds the script ends
news=$(mktemp)  # fetched notifications that are not handled yet, one a line
secret=$(mktemp)  # the header with the token: other users can read the arguments of curl

# The message for a visitor, by permanent id.
message_for() {
    case $1 in
        tanaka) echo 'Mr. Tanaka, your meeting is in room 3.' ;;
        suzuki) echo 'Ms. Suzuki, your taxi is waiting at the entrance.' ;;
    esac
}

log() { printf '%s  %s\n' "$(date +%H:%M:%S)" "$*" >&2; }

# --- Speaking to the engine -----------------------------------------------------------------------------------------

http() { curl -sS --noproxy '*' ${ROIS_TOKEN:+-H "@$secret"} ${session:+-H "RoIS-Session: $session"} "$@"; }

# ask OPERATION [CHILDREN [ATTRIBUTES]]: sends one document, and repeats it if the link breaks. Fails if the answer, $answer, is not OK.
ask() {
    document="<$1 $names ${3:-}>${2:-}</$1>"
    # curl takes a truncated head for one without a body.
    until answer=$(http -m 10 --data-binary "$document" -H 'Content-Type: application/xml' "$url/rois") && [ -n "$answer" ]; do pause; done
    broken=
    case $answer in *return_code=\"OK\"*) return 0 ;; esac
    return 1
}

pause() {
    broken=${broken:-$(date +%s)}
    [ $(($(date +%s) - broken)) -lt 10 ] || { log "$url does not answer."; exit 1; }
    log 'The link broke; asking again.'
    sleep 1
}

# request OPERATION [CHILDREN [ATTRIBUTES]]: like `ask`, but the script ends if the answer is not OK.
request() { ask "$@" || refused "$1"; }
refused() {
    log "The engine refused $1: $answer"
    exit 1
}

# text_of ELEMENT DOCUMENT: the text of the first element of that name.
text_of() { printf '%s' "$2" | sed -n "s/.*<$1>\([^<]*\)<\/$1>.*/\1/p"; }

# values_of RESULT DOCUMENT: the values of the result of that name, one a line.
values_of() {
    printf '%s\n' "$2" | sed 's/<result /\
&/g; s/<\/result>/&\
/g' | sed -n "/^<result rois:name=\"$1\"/p" | sed 's/<rois:value>/\
&/g' | sed -n 's/^<rois:value>\([^<]*\)<.*/\1/p'
}

ref() { printf '<component_ref rois:code="%s"/>' "$1"; }
parameter() {
    printf '<rois:parameter rois:name="%s"><rois:data_type_ref rois:code="%s"/><rois:value>%s</rois:value></rois:parameter>' "$1" "$2" "$3"
}

# command ID COMPONENT TYPE [PARAMETERS]: a command unit.
command() {
    printf '<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="%s" rois:command_id="%s">' "$3" "$1"
    printf '<rois:component_ref rois:code="%s"/>%s</rois:command_unit_list>' "$2" "${4:+<rois:arguments>$4</rois:arguments>}"
}

# execute ID UNIT: if `execute` is rejected, an earlier attempt may have been accepted and its answer lost.
execute() {
    ask execute "<rois:CommandUnitSequence>$2</rois:CommandUnitSequence>" && return
    first=$answer
    ask get_command_result "<command_id>$1</command_id>" || { answer=$first; refused execute; }
}

# --- Notifications of the engine ------------------------------------------------------------------------------------

# fetch SECONDS: adds the waiting notifications to $news, or those that come within this time. A truncated answer has delivered the
# notifications that are complete in it; the next call fetches the rest.
fetch() {
    whole=yes
    fetched=$(http -m $(($1 + 10)) "$url/rois/notifications?after=$after&wait=$1") || whole=
    case $fetched in
        *'</fault>'*) answer=$fetched; refused notifications ;;
        *'<notifications '*) ;;
        *) whole= ;;
    esac
    printf '%s' "$fetched" | tr '\n' ' ' |
        sed 's/<receive_event /\
&/g; s/<receive_error /\
&/g; s/<completed /\
&/g; s/<lost /\
&/g; s/<profile_changed /\
&/g' | sed -n '/^<\([a-z_]*\) sequence=.*<\/\1>/p; /^<[a-z_]* [^<>]*\/>/p' >"$news"
    if [ -n "$whole" ] || [ -s "$news" ]; then broken=; else pause; fi
}

# next_notification SECONDS: moves the next one to $notification. Fails if none comes within this time.
next_notification() {
    [ -s "$news" ] || fetch "$(($1 < 30 ? $1 : 30))"
    [ -s "$news" ] || return 1
    notification=$(sed -n 1p "$news")
    sed 1d "$news" >"$news.rest"
    mv "$news.rest" "$news"
    after=$(printf '%s' "$notification" | sed 's/^[^"]*"\([0-9]*\)".*/\1/')
}

# wait_for PATTERN SECONDS: takes notifications until one matches the shell pattern. Fails if none does within this time.
wait_for() {
    end=$(($(date +%s) + $2))
    while left=$((end - $(date +%s))) && [ "$left" -gt 0 ]; do
        next_notification "$left" || continue
        # shellcheck disable=SC2254  # a pattern, on purpose
        case $notification in $1) return 0 ;; esac
    done
    return 1
}

# run COMPONENT TYPE [PARAMETERS]: executes one command and waits until it has completed. Sets $status, and $why to status and reason.
commands=0
run() {
    commands=$((commands + 1))
    execute "step-$commands" "$(command "step-$commands" "$1" "$2" "${3:-}")"
    wait_for "*<command_id>step-$commands</command_id>*" 120 || { log "$1 $2 did not complete within two minutes"; exit 1; }
    status=$(text_of status "$notification")
    why=$status  # with the engine's reason, if there is one
    [ "$status" = OK ] || ! ask get_command_result "<command_id>step-$commands</command_id>" || why=$why$(values_of reason "$answer" | sed '1s/^/: /')
}

say() {
    log "Robot: \"$1\""
    run speech_synthesis start "$(parameter speech_text string "$1")"
}

go_to() { run navigation start "$(parameter target_position 'string[]' "$1")$(parameter time_limit int 90000)"; }

# --- The states of figure 1 -----------------------------------------------------------------------------------------

wait_for_a_person() {
    log 'Waiting for somebody to come.'
    run person_detection start
    until wait_for '*<event_type>person_detected</event_type>*' 30 && [ "$(values_of number "$notification")" -gt 0 ]; do :; done
    log "There is somebody: $(values_of number "$notification") person(s)."
    run person_detection stop
}

# Measures once. Sets $seen to persons and positions, one a line: "person-1 9500, 7500, -160".
look() {
    seen=
    run person_localization start
    if wait_for '*<event_type>person_localized</event_type>*<rois:value>*' 3; then
        line=0
        for one in $(values_of person_ref "$notification"); do
            line=$((line + 1))
            seen="$seen$one $(values_of position_data "$notification" | sed -n "${line}p")
"
        done
    fi
    run person_localization stop
}

# position_of PERSON SEEN: prints the person's position, or nothing.
position_of() { printf '%s' "$2" | sed -n "s/^$1 //p"; }

# near POSITION POSITION MM: whether the distance is at most MM.
near() { awk -v a="$1" -v b="$2" -v most="$3" 'BEGIN { split(a, p, ","); split(b, q, ",")
    exit ((p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 > most ^ 2) }'; }

# find_standing [PERSON]: waits until this person, or any person who was not received yet, stands: two measurements a second apart
# give the same place. Sets $person and $position. Fails if no person stands still in time, or if the person is out of sight.
find_standing() {
    looks=0
    look
    while [ "$looks" -lt 30 ]; do
        looks=$((looks + 1))
        before=$seen
        sleep 1
        look
        for one in ${1:-$(printf '%s' "$seen" | sed 's/ .*//')}; do
            case $known_persons in *" $one "*) continue ;; esac
            was=$(position_of "$one" "$before")
            is=$(position_of "$one" "$seen")
            [ -z "${1:-}" ] || [ -n "$was$is" ] || return 1
            if [ -n "$was" ] && [ -n "$is" ] && near "$was" "$is" 300; then
                person=$one
                position=$is
                return 0
            fi
        done
    done
    return 1
}

# Goes to 1 m in front of the position, or beside that point if there is no way to it.
go_before() {
    for angle in 0 60 -60 120 -120; do
        go_to "$(printf '%s' "$1" | awk -F, -v turn="$angle" '{ a = ($3 + turn) * 3.14159265 / 180
            printf "%.0f, %.0f, %.0f", $1 + 1000 * cos(a), $2 + 1000 * sin(a), $3 + turn + 180 }')"
        [ "$status" = OK ] && return 0
    done
    return 1
}

# Goes to a standing person, and on to their new position if they have moved, at most five times. Fails if no new person is reached.
go_there() {
    find_standing || { log 'Nobody new stands anywhere.'; return 1; }
    log "$person is at $position (mm, mm, degree); going there."
    for try in 1 2 3 4 5; do
        aim=$position
        go_before "$aim" || { log "No way leads to $person ($why)."; return 1; }
        look
        is=$(position_of "$person" "$seen")
        [ -n "$is" ] && near "$aim" "$is" 600 && { log "Arrived at $person."; return 0; }
        find_standing "$person" || { log "$person is out of sight."; return 1; }
        [ "$try" -eq 5 ] || log "$person is at $position now; going on."
    done
    log "$person does not stay."
    return 1
}

# Sets $visitor to the permanent id of the visitor, or to nothing.
identify() {
    visitor=
    run person_identification start
    if wait_for '*<event_type>person_identified</event_type>*<rois:value>*' 8; then
        visitor=$(values_of person_ref "$notification" | sed -n 1p)
    fi
    run person_identification stop
}

guide() {
    words=
    if [ -z "$visitor" ]; then
        log 'Nobody that is known.'
        message='Welcome. How can I help you?'
        run speech_recognition start
        say "$message"
        if wait_for '*<event_type>speech_recognized</event_type>*' 10; then
            words=$(values_of recognized_text "$notification" | sed -n 1p)
            log "Visitor: \"$words\""
            say 'I shall tell my colleagues at the desk.'
        else
            log 'No answer.'
        fi
        run speech_recognition stop
        return
    fi
    log "This is $visitor."
    message=$(message_for "$visitor")
    message=${message:-Welcome. There is no message for you today.}
    say "$message"
}

receive() {
    wait_for_a_person
    go_there || { go_back; return 1; }  # the hall is seen from the start
    known_persons="$known_persons$person "
    identify
    case $known_visitors in *" ${visitor:-nobody} "*)
        log "This is $visitor, who was received already."
        go_back
        return 1
        ;;
    esac
    known_visitors="$known_visitors$visitor "
    guide
    log 'The robot bows.'
    run reaction start "$(parameter reaction_ref RoISIdentifier 9)"
    say 'Goodbye.'
    printf '%s: told "%s"%s\n' "${visitor:-somebody}" "$message" "${words:+, heard \"$words\"}"
    go_back
}

go_back() {
    log 'Going back to the start.'
    go_to "$start"
    [ "$status" = OK ] || log "The way back ended with $why."
}

leave() {
    [ -z "$session" ] || http -m 10 -o /dev/null --data-binary "<disconnect $names/>" -H 'Content-Type: application/xml' "$url/rois" || true
    rm -f "$news" "$news.rest" "$secret"
}
trap leave EXIT
trap 'exit 130' INT TERM

printf 'Authorization: Bearer %s\n' "${ROIS_TOKEN-}" >"$secret"
request connect
session=$(text_of session "$answer")
for component in person_detection person_localization person_identification speech_recognition speech_synthesis reaction navigation; do
    request bind "$(ref $component)"
done
for event in person_detected person_localized person_identified speech_recognized reached_target; do
    request subscribe "<event_type>$event</event_type>" 'inline_results="true"'
done
request query '<query_type>robot_position</query_type>'
start=$(values_of position_data "$answer" | sed -n 1p)
log "Connected to $url; the robot stands at $start."

received=0
known_persons=' '   # temporary names of received visitors, valid until the robot loses sight of them
known_visitors=' '  # their permanent ids
while [ "$received" -lt "$visitors" ]; do
    if receive; then received=$((received + 1)); fi
done
echo "visitors received: $received"
