# Tab completion of `indurop` for bash. Installed as bash-completion/completions/indurop; or: source this file.

_indurop_words() { COMPREPLY=($(compgen -W "$1" -- "$cur")); }

# Variable names hold ':', which bash takes for a word break: complete only what follows the last one.
_indurop_variables() {
  _indurop_words "$(indurop vars --names -q 2>/dev/null)"
  if declare -F __ltrim_colon_completions >/dev/null; then
    __ltrim_colon_completions "$cur"
  fi
}

_indurop_modules() { _indurop_words "$(indurop status -o csv -q 2>/dev/null | sed 1d | cut -d, -f1)"; }

_indurop_xml() { COMPREPLY=($(compgen -f -X '!*.xml' -- "$cur") $(compgen -d -- "$cur")); }

_indurop() {
  local cur prev verb word
  local verbs="new check plan plc keys doctor run stop start restart reset clean status nodes ps vars get set force unforce forces watch chart hz typeof jitter overruns log deploy rollback history boards help"
  if declare -F _get_comp_words_by_ref >/dev/null; then
    _get_comp_words_by_ref -n : cur prev
  else
    cur=${COMP_WORDS[COMP_CWORD]}
    prev=${COMP_WORDS[COMP_CWORD - 1]}
  fi
  verb=
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case $word in
      -*) ;;
      *) verb=$word; break ;;
    esac
  done
  COMPREPLY=()
  case $prev in
    --node) _indurop_words "$(indurop nodes --names -q 2>/dev/null)"; return ;;
    -o | --output) _indurop_words "table json csv svg"; return ;;
    --color) _indurop_words "auto always never"; return ;;
    --quantity) _indurop_words "jitter latency exec response all"; return ;;
    -f | --file | --svg | --trace | --report) COMPREPLY=($(compgen -f -- "$cur")); return ;;
  esac
  if [[ -z $verb ]]; then
    _indurop_words "$verbs --help --version"
    return
  fi
  if [[ $cur == -* ]]; then
    _indurop_words "$(indurop help "$verb" 2>/dev/null | grep -oE '^ +(-[a-zA-Z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+')"
    return
  fi
  case $verb in
    check | plan | run | deploy) _indurop_xml ;;
    plc)
      case $prev in
        plc) _indurop_words "build check print watch" ;;
        *) COMPREPLY=($(compgen -f -- "$cur")) ;;
      esac ;;
    keys)
      if [[ $prev == init ]]; then _indurop_xml; else _indurop_words "init add list renew revoke"; fi ;;
    get | set | force | unforce | watch | vars | hz | typeof) _indurop_variables ;;
    chart) mapfile -t COMPREPLY < <(compgen -f -X '!*.csv' -- "$cur") ;;
    jitter | overruns | log | stop | start | restart) _indurop_modules ;;
    help) _indurop_words "$verbs" ;;
  esac
}
complete -F _indurop indurop
