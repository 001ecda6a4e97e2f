#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What bash completes after `penumbra`: completion_test.sh COMPLETION_FILE COMMAND
set -euo pipefail
source "$1"
command=$2
failed=0

# expect WANTED WORD...: WANTED is among what the last word can become.
expect() {
    local wanted=$1
    shift
    COMP_WORDS=("$command" "$@") COMP_CWORD=$#
    COMPREPLY=()
    _penumbra "$command" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}" 2>/dev/null || true
    printf '%s\n' "${COMPREPLY[@]}" | grep -qxF -- "$wanted" && return
    echo "'$*' is not completed to '$wanted', but to: ${COMPREPLY[*]}"
    failed=1
}

expect measure mea
expect soft-volumes render primitives -t so
expect hard,exact compare primitives -t hard,ex
expect samples= render primitives -t exact --set sa
expect max_error= render primitives --set max
expect schwaerzler2012 reproduce sch
expect primitives render prim
expect --plane measure primitives --pl
expect parameters list pa
camera=$("$command" info primitives | sed -n 's/^camera *//p' | head -n 1)
expect "$camera" render primitives --camera "${camera:0:1}"
exit $failed
