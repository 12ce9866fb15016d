Every command has a manual page.

  $ for command in "" check conform console doctor exec explore fleet fmt help lsp lts new parse plan platform "platform check" post runs "runs list" "runs show" sim step successors time tla trace walk "trace check" "trace show" "trace draw" "trace export"; do
  >   dolphin $command --help=plain > page || echo "dolphin $command --help: status $?"
  >   grep -q '^NAME' page || echo "dolphin $command --help: no page"
  >   ! grep '^ *12[34] ' page || echo "dolphin $command --help: a status that dolphin does not have"
  > done

The files that manual pages name as examples are there.

  $ for command in "" check conform console exec explore fleet fmt help lsp lts parse plan post sim step successors time tla trace walk; do
  >   dolphin $command --help=plain | grep -o 'examples/[a-z_]*\.[a-z]*'
  > done | grep -v '\.aut$' | sort -u | while read -r file; do test -e "../../$file" || echo "$file: no such file"; done

The table of exit statuses in docs/command.md is that of the manual pages.

  $ for command in check conform console doctor exec explore fleet fmt help lsp lts new parse plan "platform check" post sim step successors time tla walk runs "runs show" "trace check" "trace show" "trace draw" "trace export"; do
  >   dolphin $command --help=plain | sed -n '/^EXIT STATUS/,/^[A-Z]/p' | grep -o '^       [0-9]\+' | sed "s/ *//; s/^/$command /"
  > done | sort -u > in-manuals
  $ for command in check conform console doctor exec explore fleet fmt help lsp lts new parse plan "platform check" post sim step successors time tla walk runs "runs show" "trace check" "trace show" "trace draw" "trace export"; do
  >   grep -E '^\| [0-9]+ \|' ../../docs/command.md | grep -e '| all |' -e "\`$command\`" | sed "s/^| \([0-9]*\) .*/$command \1/"
  > done | sort -u | diff in-manuals - && wc -l < in-manuals
  128
