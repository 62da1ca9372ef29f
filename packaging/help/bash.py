"""Completion for bash: a table of a program's command line, and a function that looks it up."""
from shapes import MADE, NOTHING, identifier, options_of, shape

ENGINE = r'''
# Reply for the word at the cursor. The words before it are split at blanks.
_yars_complete() {
  local table=$1 words word path option="" left=0 cur
  read -ra words <<<"${COMP_LINE:0:COMP_POINT}"
  [[ ${COMP_LINE:0:COMP_POINT} == *[[:blank:]] ]] && words+=("")
  cur=${words[-1]} path=${words[0]##*/}
  for word in "${words[@]:1:${#words[@]}-2}"; do
    if ((left > 0)); then
      ((left--))
      continue
    fi
    case $word in
      --*=*) ;;
      -*) option=$word left=$("$table" count "$path $word") ;;
      *) [[ " $("$table" commands "$path") " == *" $word "* ]] && path+=" $word" ;;
    esac
  done
  if [[ $cur == --*=* ]]; then
    _yars_reply "$("$table" value "$path ${cur%%=*}")" "${cur#*=}"
  elif ((left > 0)); then
    _yars_reply "$("$table" value "$path $option")" "$cur"
  elif [[ $cur == -* ]]; then
    _yars_reply "words $("$table" options "$path")" "$cur"
  else
    word=$("$table" commands "$path")
    _yars_reply "${word:+words $word}${word:-$("$table" argument "$path")}" "$cur"
  fi
}

_yars_reply() {
  local shape=$1 cur=$2 names
  COMPREPLY=()
  case $shape in
    *:*) # What follows route: and the like is a file. bash takes a colon for the end of a word.
      if [[ $cur == *:* ]]; then
        shape=files cur=${cur#*:}
        [[ $COMP_WORDBREAKS == *:* ]] || names=${2%%:*}:
      fi ;;
  esac
  [[ $cur != \~/* || $shape != f* ]] || cur=$HOME${cur#\~}
  case $shape in
    words*)
      mapfile -t COMPREPLY < <(compgen -W "${shape#words}" -- "$cur")
      [[ ${COMPREPLY[*]} != *: ]] || compopt -o nospace ;;
    files)
      compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -P "${names-}" -f -- "$cur") ;;
    folders)
      compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -d -- "$cur") ;;
    sessions)
      names=(/dev/shm/yars."$UID".*)
      mapfile -t COMPREPLY < <(compgen -W "${names[*]#/dev/shm/yars."$UID".}" -- "$cur") ;;
  esac
} 2>/dev/null
'''


def written(what):
    return "words " + " ".join(what) if isinstance(what, list) else what


def rows_of(program):
    """{question: {key: answer}}"""
    rows = {question: {} for question in ("commands", "options", "argument", "value", "count")}
    for command in program.walk():
        path = " ".join(command.words)
        rows["commands"][path] = " ".join(below.words[-1] for below in command.below)
        rows["options"][path] = " ".join(name for entry in options_of(program, command) for name in entry.names
                                         if name.startswith("--"))
        rows["argument"][path] = written(shape(command.arguments[0])) if command.arguments else NOTHING
        for entry in options_of(program, command):
            for name in entry.names if entry.count else []:
                rows["value"][f"{path} {name}"] = written(shape(entry))
                rows["count"][f"{path} {name}"] = str(entry.count)
    for command in program.walk():  # help takes the words of all commands
        if program.below and command.below:
            rows["commands"][" ".join([program.words[0], "help", *command.words[1:]])] = (
                rows["commands"][" ".join(command.words)])
    return rows


def case_of(question, answers):
    """A case of the lookup function; keys with the same answer share a line."""
    default = {"count": "0", "commands": "", "options": ""}.get(question, NOTHING)
    keys_of = {}
    for key, answer in answers.items():
        if answer != default:
            keys_of.setdefault(answer, []).append(f'"{key}"')
    text = f"    {question}) case $2 in\n"
    for answer, keys in keys_of.items():
        text += "      " + "|\\\n        ".join(keys) + f")\n        echo '{answer}' ;;\n"
    return text + (f"      *) echo {default} ;;\n" if default else "") + "    esac ;;\n"


def files_of(programs):
    for program in programs:
        name = program.words[0]
        table, call = f"_yars_table_{identifier([name])}", f"_yars_call_{identifier([name])}"
        text = f"# bash completion of {name}. {MADE}\n\n{table}() {{\n  case $1 in\n"
        text += "".join(case_of(*row) for row in rows_of(program).items()) + "  esac\n}\n" + ENGINE
        yield f"bash/{name}", text + f"\n{call}() {{ _yars_complete {table}; }}\ncomplete -F {call} {name}\n"
