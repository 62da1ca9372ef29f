#!/usr/bin/env python3
"""What bash, zsh and fish offer with the completions of this build, and what man shows of its pages. Shells that are
not installed are left out.

usage: help_test.py BUILD
"""
import gzip
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

HELP = pathlib.Path(sys.argv[1]) / "install/help"
# Command line, words that are offered, words that are not.
CASES = [
    ("yars sta", {"status"}, {"scan"}),
    ("yars ", {"scan", "status", "help"}, {"--session"}),
    ("yars terrain ", {"generate", "info", "pack"}, {"scan"}),
    ("yars --session a terrain in", {"info"}, {"generate"}),
    ("yars scan --co", {"--color", "--config"}, {"--force"}),
    ("yars scan --color ", {"green", "gray"}, {"--color"}),
    ("yars scan --fidelity dr", {"draft"}, {"standard"}),
    ("yars scan --lat 37 --sess", {"--session"}, set()),
    ("yars help te", {"terrain"}, {"scan"}),
    ("yars scene generate --kind ", {"airfield", "harbour", "bridge", "town"}, set()),
    ("yars terrain profile --from 1 2 --st", {"--step"}, set()),
    ("yars scan --terrain ", {"cells"}, {"a.guf"}),
    ("yars --config ", {"a.guf"}, {"green"}),
    ("yars scan --out=a", {"a.guf"}, set()),
    ("flight-model --source csv:a", {"a.guf"}, set()),
    ("yars config check a", {"a.guf"}, set()),
    ("yars inject fr", {"freeze"}, {"power"}),
    ("radar-display --hea", {"--headless"}, set()),
    ("radar-model --log-level d", {"debug"}, {"info"}),
    ("input-monitor --source ", {"auto", "terminal", "script:"}, set()),
    ("flight-model --source ro", {"route:"}, {"csv:"}),
    ("yars-start --no-", {"--no-flight", "--no-input"}, set()),
    ("yars-start --terrain ", {"cells"}, {"a.guf"}),
]
faults = []


def bash(line, folder):
    name = line.split()[0]
    script = f"""
      . {shlex.quote(str(HELP / "bash-completion/completions" / name))}
      compopt() {{ :; }}
      COMP_LINE='{line}' COMP_POINT={len(line)} COMPREPLY=()
      $(complete -p {name} | sed 's/.*-F \\([^ ]*\\) .*/\\1/')
      printf '%s\\n' "${{COMPREPLY[@]}}"
    """
    done = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, timeout=60, cwd=folder)
    return {word.rstrip("/") for word in done.stdout.split()}, done


ZSH_SETUP = """
autoload -Uz compinit; compinit -u -d {dump}
zstyle ':completion:*' list-colors ''
bindkey '^I' expand-or-complete
setopt no_beep
PROMPT='READY>'
unset zle_bracketed_paste
compadd() {{
  local -a found; builtin compadd -O found "$@"
  print -rl -- $found >>{out}
  builtin compadd "$@"
}}
"""


def zsh(line, folder):
    """zsh completes in a line editor alone: in a terminal of its own (zpty)."""
    out = pathlib.Path(folder, "zsh.out")
    out.write_text("")
    setup = pathlib.Path(folder, ".zsh_setup")
    setup.write_text(ZSH_SETUP.format(dump=pathlib.Path(folder, ".zcompdump"), out=out))
    script = f"""
      zmodload zsh/zpty
      zpty one {shlex.quote(f"FPATH={shlex.quote(str(HELP))}/zsh/vendor-completions:$FPATH zsh -f -i")}
      zpty -w one ". {setup}"
      zpty -r -m one junk '*READY>*'
      zpty -w -n one $'{line}\\t'
      sleep {{}}
      zpty -d one
    """
    for wait in ("0.5", "4"):  # on a loaded machine again
        done = subprocess.run(["zsh", "-f", "-c", script.format(wait)], capture_output=True, text=True, timeout=120,
                              cwd=folder)
        words = {word.rstrip("/") for word in out.read_text().split("\n") if word}
        if words:
            break
    return words, done


def fish(line, folder):
    script = f"source {shlex.quote(str(HELP))}/fish/vendor_completions.d/{line.split()[0]}.fish; complete -C '{line}'"
    done = subprocess.run(["fish", "-c", script], capture_output=True, text=True, timeout=60, cwd=folder)
    # fish repeats the whole word: --out=a.guf, csv:a.guf.
    return {re.sub("^(--[a-z]+=|[a-z]+:(?=.))", "", row.split("\t")[0]).rstrip("/")
            for row in done.stdout.splitlines()}, done


def check_pages():
    """Each page is without a fault, and has the options of its program."""
    for program, words in (("yars", ("yars scan", "range-nm")), ("radar-model", ("fidelity",)),
                           ("yars-start", ("web",)), ("yars-station", ("port",))):
        text = gzip.open(HELP / f"man/man1/{program}.1.gz", "rt").read()
        for word in words:
            if word not in text:
                faults.append(f"{program}.1: expected {word}, found none")
    if shutil.which("mandoc"):
        for page in sorted(HELP.rglob("man/*/*.gz")):
            text = gzip.open(page, "rt").read()
            done = subprocess.run(["mandoc", "-T", "lint", "-W", "error"], input=text, capture_output=True, text=True,
                                  timeout=60, check=False)
            if done.returncode:
                faults.append(f"{page.name}: {done.stdout[:500]}")


def main():
    check_pages()
    os.environ["TERM"] = "dumb"
    shells = [shell for shell in (bash, zsh, fish) if shutil.which(shell.__name__)]
    with tempfile.TemporaryDirectory() as folder:
        os.environ["HOME"] = folder
        pathlib.Path(folder, "cells").mkdir()
        pathlib.Path(folder, "a.guf").write_text("")
        for shell in shells:
            for line, offered, absent in CASES:
                found, done = shell(line, folder)
                if not offered <= found or absent & found:
                    faults.append(f"{shell.__name__}: {line!r}: expected {offered} without {absent}, "
                                  f"found {sorted(found)[:20]} {done.stderr[-300:]}")
    print("\n".join(faults) or f"{len(CASES)} lines in {', '.join(shell.__name__ for shell in shells)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
