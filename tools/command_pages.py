#!/usr/bin/python3
"""What a package brings beside the program, made from what the program says of itself: the manual page carom.1 and
completions for bash and zsh.

Usage: command_pages.py CAROM FOLDER
"""

import pathlib
import re
import subprocess
import sys
import typing


class Option(typing.NamedTuple):
    flags: str  # "--threads", "-h,--help"
    value: str  # "INT", "" for a switch
    text: str


class Command(typing.NamedTuple):
    name: str
    text: str
    usage: str
    positionals: list
    options: list


def entries(section):
    """(head, text) of the lines of a section of the help: a head of its own line has its text on the next."""
    found = []
    for line in section.splitlines():
        match = re.match(r"^  (\S.*?)(?:  +(\S.*))?$", line)
        if match and len(line) - len(line.lstrip()) == 2:
            found.append([match.group(1), match.group(2) or ""])
        elif found and line.strip():
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return found


def section(help_text, title):
    match = re.search(rf"^{title}:\n(.*?)(?:\n\n|\Z)", help_text, re.DOTALL | re.MULTILINE)
    return match.group(1) if match else ""


def option_of(head, text):
    flags, _, kind = head.partition(" ")
    return Option(flags, re.sub(r":.*| \.\.\.| REQUIRED", "", kind).strip(), text)


def ask(carom, *words):
    return subprocess.run([carom, *words], capture_output=True, text=True, check=True).stdout


def commands_of(carom):
    commands = []
    for name, text in entries(section(ask(carom, "--help"), "Subcommands")):
        own = ask(carom, name, "--help")
        usage = re.search(r"Usage: \S+ (.*)", own).group(1)
        commands.append(Command(name, text, usage, [head.split()[0] for head, _ in entries(section(own, "Positionals"))],
                                [option_of(*entry) for entry in entries(section(own, "Options"))]))
    return commands


def roff(text):
    return text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")


def manual(carom, commands):
    version = ask(carom, "--version").split()[1]
    help_text = ask(carom, "--help")
    codes = re.search(r"Exit codes: (.*)", help_text, re.DOTALL).group(1)
    lines = [f'.TH CAROM 1 "" "carom {version}" "User Commands"', ".SH NAME",
             "carom \\- " + roff(help_text.splitlines()[0].rstrip(".").lower()), ".SH SYNOPSIS", ".B carom", ".I COMMAND",
             "[\\fIOPTIONS\\fR] ...", ".SH DESCRIPTION",
             "Computes impacts of deformable solids: contact forces, waves, and where every joule went. Cases are TOML files; "
             "results are a folder with tables, fields for ParaView and a page, report.html, that needs no network.",
             ".SH COMMANDS"]
    for command in commands:
        lines += [".SS " + roff(f"carom {command.usage}"), roff(command.text) + "."]
        for option in command.options:
            if option.flags != "-h,--help":
                value = f" \\fI{roff(option.value)}\\fR" if option.value else ""
                lines += [".TP", f"\\fB{roff(option.flags)}\\fR{value}", roff(option.text)]
    lines += [".SH EXIT STATUS"]
    for entry in re.split(r"[;.] ?(?=\d )", re.sub(r"\s+", " ", codes)):
        code, _, text = entry.strip().partition(" ")
        lines += [".TP", f"\\fB{code}\\fR", roff(text)]
    return "\n".join([*lines, ".SH SEE ALSO", "/usr/share/doc/carom"]) + "\n"


def takes_folder(command):
    return any(name.startswith("folder") for name in command.positionals)


def bash(commands):
    cases = []
    for command in commands:
        flags = " ".join(flag for option in command.options for flag in option.flags.split(","))
        files = "-d" if takes_folder(command) else "-f"
        cases.append(f"    {command.name}) flags=\"{flags}\" files={files} ;;")
    names = " ".join([*(command.name for command in commands), "--help", "--version"])
    return f"""# bash completion of carom
_carom() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} flags="" files=-f
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{names}" -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{chr(10).join(cases)}
  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$flags" -- "$word")) ;;
    *) compopt -o filenames 2>/dev/null; local IFS=$'\\n'; COMPREPLY=($(compgen "$files" -- "$word")) ;;
  esac
}}
complete -F _carom carom
"""


def zsh(commands):
    def quoted(text):
        return re.sub(r"([\[\]:'`])", r"\\\1", text).replace("\\'", "")

    lines = ["#compdef carom", "local -a commands", "commands=("]
    lines += [f"  '{command.name}:{quoted(command.text)}'" for command in commands]
    lines += [")", "if (( CURRENT == 2 )); then", "  _describe command commands", "  return", "fi",
              "local command=$words[2]", "shift words", "(( CURRENT-- ))", "case $command in"]
    for command in commands:
        lines.append(f"  {command.name}) _arguments \\")
        for option in command.options:
            value = f":{option.value.lower()}:_files" if option.value else ""
            lines += [f"    '{flag}[{quoted(option.text)}]{value}' \\" for flag in option.flags.split(",")]
        lines.append(f"    '*:file:{'_files -/' if takes_folder(command) else '_files'}' ;;")
    return "\n".join([*lines, "esac"]) + "\n"


def main():
    carom, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    commands = commands_of(carom)
    for name, text in (("carom.1", manual(carom, commands)), ("carom.bash", bash(commands)), ("_carom", zsh(commands))):
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
