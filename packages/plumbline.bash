# SPDX-License-Identifier: MIT
# Completes plumbline: commands and options are those that its --help names.
_plumbline() {
  local current=${COMP_WORDS[COMP_CWORD]} command='' word words
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if [[ $word != -* ]]; then command=$word; break; fi
  done
  if [[ $current == -* ]]; then
    words=$(plumbline ${command:+"$command"} --help 2>/dev/null | grep -oE '^ +(-[a-zA-Z],)?--[a-z-]+' |
      grep -oE -- '--[a-z-]+')
  elif [[ -z $command ]]; then
    words=$(plumbline --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
  else
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}
complete -F _plumbline plumbline
