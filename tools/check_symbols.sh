#!/bin/bash
# check_symbols.sh LIBLOBE.A LIBLOBE.SO: both define lobe_ symbols only, and the shared library needs
# nothing but the few functions of the C library listed here.
set -eu

archive=$1
shared=$2
needed='abort|getenv|mem(cpy|move|set|cmp)|str(cmp|ncmp|len)|__assert_fail|__stack_chk_fail'
startup='_ITM_(de)?registerTMCloneTable|__cxa_finalize|__gmon_start__'

status=0
# complain TITLE: fails when standard input has a line.
complain() {
    local lines
    lines=$(cat)
    if [ -n "$lines" ]; then
        printf '%s\n' "$lines" | sed "s|^|$1: |"
        status=1
    fi
}

defined=$(nm -D --defined-only --format=posix "$shared" | awk '{ print $1 }')
complain "exported without lobe_" < <(grep -v '^lobe_' <<<"$defined")
complain "global without lobe_" < <(nm -g --defined-only --format=posix "$archive" |
    awk 'NF > 2 && $1 !~ /^lobe_/ { print $1 }')
complain "needed from outside" < <(nm -D --undefined-only --format=posix "$shared" |
    awk '{ sub(/@.*/, "", $1); print $1 }' | grep -vxE "$needed|$startup")

count=$(grep -c '^lobe_' <<<"$defined") || true
echo "symbols: $count exported"
[ $status = 0 ] && [ "$count" -gt 0 ]
