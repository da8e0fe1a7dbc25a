#!/usr/bin/env bash
# Makes the book: docs/build/index.html. Needs the program (cargo build --release) and
# pip install sphinx myst-parser furo.
set -euo pipefail
cd "$(dirname "$0")/.."
delone=${DELONE:-target/release/delone}

# What every command takes, as it says itself.
{
    printf '# Commands\n\nWhat `delone COMMAND --help` prints.\n'
    # Lines of the list between "Commands:" and the next heading begin with the name of a command.
    for command in $("$delone" --help | awk '/^Commands:/ { on = 1; next } /^[A-Z]/ { on = 0 } on && /^  [a-z]/ { print $1 }'); do
        [ "$command" = help ] && continue
        printf '\n## %s\n\n```text\n' "$command"
        COLUMNS=100 "$delone" "$command" --help
        printf '```\n'
    done
} > docs/reference/commands.md

sphinx-build -q -W -n -b html docs docs/build "$@"
echo docs/build/index.html
