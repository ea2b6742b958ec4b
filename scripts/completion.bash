# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Completes `insitu COMMAND [SITE] [OPTIONS]`. What can be said is asked of the programs themselves.

_insitu() {
  local cur words cword
  _init_completion || return
  local commands stage options
  commands=$(insitu --help 2>/dev/null | sed -n 's/^  \([a-z-]\+\) .*/\1/p')
  if [[ $cword -eq 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$cur")
  elif [[ $cur == --*.* && ${words[1]} == montage ]]; then
    stage=${cur#--} stage=${stage%%.*}
    options=$(insitu "$stage" --list-options 2>/dev/null | sed "s/^--\([^ ]*\).*/--$stage.\1/")
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur")
  elif [[ $cur == -* ]]; then
    options=$(insitu "${words[1]}" --list-options 2>/dev/null | sed 's/ .*//')
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur")
  else
    _filedir
  fi
}
complete -F _insitu insitu
