#!/usr/bin/env bash
# Makes the book: docs/build/index.html. Needs the programs (cargo build --release -p delone-cli -p delone-lab) and
# pip install sphinx myst-parser furo.
set -euo pipefail
cd "$(dirname "$0")/.."
delone=${DELONE:-target/release/delone}
lab=${LAB:-target/release/delone-lab}

# What every command of a program takes, as it says itself, under headings that begin so.
helps() {
    local program=$1 heading=$2 command
    # Lines of the list between "Commands:" and the next heading begin with the name of a command.
    for command in $("$program" --help | awk '/^Commands:/ { on = 1; next } /^[A-Z]/ { on = 0 } on && /^  [a-z]/ { print $1 }'); do
        [ "$command" = help ] && continue
        printf '\n## %s%s\n\n```text\n' "$heading" "$command"
        COLUMNS=100 "$program" "$command" --help
        printf '```\n'
    done
}
{
    printf '# Commands\n\nWhat `delone COMMAND --help` prints, and `delone-lab COMMAND --help`.\n'
    helps "$delone" ""
    helps "$lab" "delone-lab "
} > docs/reference/commands.md

sphinx-build -q -W -n -b html docs docs/build "$@"
echo docs/build/index.html
