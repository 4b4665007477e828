#!/usr/bin/env python3
"""from_help.py PROGRAM FOLDER: man page and shell completions out of the program's own --help.

Writes FOLDER/pinocchio.1, FOLDER/pinocchio.bash and FOLDER/_pinocchio (zsh).
"""
import pathlib
import re
import subprocess
import sys

ITEM = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")  # an option or a verb, and what it is
MORE = re.compile(r"^ {20,}(\S.*)$")  # what it is, on a line of its own
CHOICES = re.compile(r"^[a-z0-9.]+(\|[a-z0-9.]+)+$")


def help_of(program, *words):
    return subprocess.run([program, *words, "--help"], check=True, capture_output=True, text=True).stdout


def sections(text):
    """Title -> [[item, what it is]], of CLI11's help."""
    found, items = {}, None
    for line in text.splitlines():
        if line.endswith(":") and not line.startswith(" "):
            items = found.setdefault(line[:-1], [])
        elif items is not None and (more := MORE.match(line)):
            items[-1][1] = more[1]
        elif items is not None and (item := ITEM.match(line)):
            items.append([item[1], item[2] or ""])
    return found


def groups(verb):
    """The titles of a verb's groups of options."""
    return [title for title in verb if title not in ("Positionals", "Subcommands")]


def options(verb, titles=None):
    """(names, type, what it is) of each option of a verb, or of some of its groups."""
    for item, what in (item for title in titles or groups(verb) for item in verb[title]):
        names, _, kind = item.partition(" ")
        yield [re.sub(r"\{.*\}", "", name) for name in names.split(",")], kind, what


def choices(kind):
    braces = re.match(r"^TEXT:\{(.*)\}$", kind)
    if braces:
        return braces[1].split(",")
    return kind.split("|") if CHOICES.match(kind) else []


def roff(text):
    return text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")


def man_page(version, verbs, about):
    lines = [f'.TH PINOCCHIO 1 "" "pinocchio {version}"', ".SH NAME", f"pinocchio \\- {roff(about)}", ".SH SYNOPSIS",
             ".B pinocchio\n.I VERB\n[options]"]
    for name, (what, verb) in verbs.items():
        lines += [f'.SH "{name.upper()}"', roff(what)]
        for item, text in verb.get("Positionals", []):
            lines += [".TP", f".I {roff(item.split(' ')[0])}", roff(text)]
        for title in groups(verb):
            lines += [f'.SS "{title}"']
            for names, kind, text in options(verb, [title]):
                lines += [".TP", f".B {roff(', '.join(names))} {roff(kind)}".rstrip(), roff(text)]
    lines += [".SH EXIT STATUS", "0 done, 1 failed while running, 2 wrong usage, 3 no OpenGL context, 4 scene cannot be "
              "read, 5 compare above a limit, 130 interrupted.", ".SH ENVIRONMENT",
              "PINOCCHIO_BACKEND, PINOCCHIO_DEVICE: which OpenGL context, as \\-\\-backend and \\-\\-device."]
    return "\n".join(lines) + "\n"


def bash(verbs):
    lines = ["# bash completion of pinocchio, made from its --help", "_pinocchio() {",
             '  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]}',
             f'  if [ "$COMP_CWORD" = 1 ]; then COMPREPLY=($(compgen -W "{" ".join(verbs)} --help --version" -- "$word")); return; fi',
             '  case "$verb $before" in']
    for name, (_, verb) in verbs.items():
        for names, kind, _ in options(verb):
            if choices(kind):
                patterns = "|".join(f'"{name} {option}"' for option in names)
                lines.append(f'    {patterns}) COMPREPLY=($(compgen -W "{" ".join(choices(kind))}" -- "$word")); return ;;')
    lines += ["  esac", '  case "$word" in -*) case "$verb" in']
    for name, (_, verb) in verbs.items():
        words = " ".join(option for names, _, _ in options(verb) for option in names)
        lines.append(f'    {name}) COMPREPLY=($(compgen -W "{words}" -- "$word")); return ;;')
    lines += ["  esac ;; esac", '  COMPREPLY=($(compgen -f -- "$word"))', "}",
              "complete -o filenames -F _pinocchio pinocchio"]
    return "\n".join(lines) + "\n"


def zsh_text(text):
    return text.replace("\\", "\\\\").replace("'", "'\\''").replace("[", "\\[").replace("]", "\\]").replace(":", "\\:")


def zsh(verbs):
    lines = ["#compdef pinocchio", "# made from pinocchio --help", "local -a verbs=("]
    lines += [f"  '{name}:{zsh_text(what)}'" for name, (what, _) in verbs.items()]
    lines += [")", "if (( CURRENT == 2 )); then _describe verb verbs; return; fi", "local verb=$words[2]", "shift words",
              "(( CURRENT-- ))", "case $verb in"]
    for name, (_, verb) in verbs.items():
        lines.append(f"  {name}) _arguments \\")
        for names, kind, what in options(verb):
            action = ""
            if kind:
                action = f":value:({' '.join(choices(kind))})" if choices(kind) else ":value:_files"
            lines += [f"    '*{option}[{zsh_text(what)}]{action}' \\" for option in names]
        lines.append("    '*:file:_files' ;;")
    return "\n".join(lines + ["esac"]) + "\n"


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    text = help_of(program)
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[-1]
    verbs = {name: (what, sections(help_of(program, name))) for name, what in sections(text)["Subcommands"]}
    about = text.splitlines()[0].split(": ", 1)[1]
    (folder / "pinocchio.1").write_text(man_page(version, verbs, about), encoding="utf-8")
    (folder / "pinocchio.bash").write_text(bash(verbs), encoding="utf-8")
    (folder / "_pinocchio").write_text(zsh(verbs), encoding="utf-8")


if __name__ == "__main__":
    main()
