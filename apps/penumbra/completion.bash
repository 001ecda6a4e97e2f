# SPDX-License-Identifier: Apache-2.0
# bash completion for penumbra. It asks the command itself, so that it knows what the command knows.

_penumbra_subcommands() {
    "$1" --help 2>/dev/null | sed -n '/^Subcommands:/,$ s/^  \([a-z]\+\) .*/\1/p'
}

_penumbra_names() {
    "$1" list "$2" 2>/dev/null | awk '{ print $1 }'
}

# What stands after the flag $1 or $2 in the line so far.
_penumbra_value_of() {
    local i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        [[ ${COMP_WORDS[i]} == "$1" || ${COMP_WORDS[i]} == "$2" ]] && echo "${COMP_WORDS[i + 1]}"
    done
}

# The keys of the first technique of -t, or of the default.
_penumbra_parameters() {
    local technique
    technique=$(_penumbra_value_of -t --technique)
    technique=${technique:-auto}
    "$1" list parameters "${technique%%[,:]*}" 2>/dev/null | sed -n 's/^  \([a-z][a-z0-9_]*=\).*/\1/p'
}

_penumbra_cameras() {
    "$1" info "${COMP_WORDS[2]}" 2>/dev/null | sed -n 's/^camera *//p'
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
        local before=
        [[ $word == *,* ]] && before=${word%,*},
        mapfile -t COMPREPLY < <(compgen -P "$before" -W "$(_penumbra_names "$command" techniques) all" -- "${word##*,}")
        return
        ;;
    --set)
        compopt -o nospace
        mapfile -t COMPREPLY < <(compgen -W "$(_penumbra_parameters "$command")" -- "$word")
        return
        ;;
    --camera)
        mapfile -t COMPREPLY < <(IFS=$'\n' compgen -W "$(_penumbra_cameras "$command")" -- "$word")
        return
        ;;
    -o | --output | --visibility | --lights | --points | --csv | --merge)
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        return
        ;;
    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$command" "$subcommand" --help 2>/dev/null |
            grep -oE -- '--[a-z][a-z-]*' | sort -u)" -- "$word")
    elif [ "$subcommand" = list ]; then
        mapfile -t COMPREPLY < <(compgen -W "techniques parameters scenes devices" -- "$word")
    elif [ "$subcommand" = reproduce ]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$command" reproduce --help 2>/dev/null |
            sed -n 's/.*one of: //p' | tr -d ,)" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -W "$(_penumbra_names "$command" scenes)" -- "$word"; compgen -f -- "$word")
    fi
}

complete -o filenames -F _penumbra penumbra
