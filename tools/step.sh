#!/bin/sh
# Run one step of the set-up so that a person sees that it lives: a line when it begins, the time while it lasts, a line
# when it ends with the seconds it took.
#
#   step.sh WHAT COMMAND...
#
# All lines go to standard error. On a terminal the time is counted in the line itself; elsewhere a line comes every half
# minute. What the command prints is shown only if it fails; the exit code is the command's.
what="$1"
shift
log="$(mktemp)"
began="$(date +%s)"
if [ -t 2 ]; then every=1; else every=30; fi

printf 'edesign: %s ...\n' "$what" >&2
"$@" >"$log" 2>&1 </dev/null &
work=$!
trap 'kill $work 2>/dev/null; rm -f "$log"; exit 130' INT TERM
(
    passed=0
    while sleep 1; do
        passed=$((passed + 1))
        [ $((passed % every)) = 0 ] || continue
        if [ -t 2 ]; then printf '\redesign: %s ... %d s' "$what" "$passed"; else
            printf 'edesign: %s ... %d s\n' "$what" "$passed"
        fi
    done
) >&2 &
clock=$!
wait $work
code=$?
kill $clock 2>/dev/null
wait $clock 2>/dev/null
[ ! -t 2 ] || printf '\r\033[K' >&2
if [ $code = 0 ]; then
    printf 'edesign: %s: done in %d s\n' "$what" $(($(date +%s) - began)) >&2
else
    printf 'edesign: %s: failed after %d s; it said:\n' "$what" $(($(date +%s) - began)) >&2
    tail -n 40 "$log" >&2
fi
rm -f "$log"
exit $code
