# SPDX-License-Identifier: Apache-2.0
# bash completion for penumbra. It asks the command itself, so that it knows what the command knows.

_penumbra_subcommands() {
    "$1" --help 2>/dev/null | sed -n '/^Subcommands:/,$ s/^  \([a-z]\+\) .*/\1/p'
}

_penumbra_names() {
    "$1" list "$2" 2>/dev/null | awk '{ print $1 }'
}

_penumbra() {
    local command=$1 word=$2 previous=$3 subcommand=${COMP_WORDS[1]}
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_penumbra_subcommands "$command") --help --version" -- "$word")
        return
    fi
    case $previous in
    -t | --technique)
        mapfile -t COMPREPLY < <(compgen -W "$(_penumbra_names "$command" techniques) all" -- "$word")
        return
        ;;
    -o | --output | --visibility | --lights)
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        return
        ;;
    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$command" "$subcommand" --help 2>/dev/null |
            grep -oE -- '--[a-z][a-z-]*' | sort -u)" -- "$word")
    elif [ "$subcommand" = list ]; then
        mapfile -t COMPREPLY < <(compgen -W "techniques scenes devices" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -W "$(_penumbra_names "$command" scenes)" -- "$word"; compgen -f -- "$word")
    fi
}

complete -o filenames -F _penumbra penumbra
