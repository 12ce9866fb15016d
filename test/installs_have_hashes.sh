#!/bin/sh
# Scripts install packages of PyPI by lists with hashes, or without PyPI, and packages of npm by lock files. Arguments:
# the scripts.
status=0
for script; do
  # A command may go on in the next line.
  commands=$(sed -e ':a' -e '/\\$/{N;s/\\\n//;ba' -e '}' "$script" | grep -v '^ *#')
  if echo "$commands" | grep 'pip install' | grep -v -e '--require-hashes' -e '--no-index'; then
    echo "$script: pip installs without --require-hashes"; status=1
  fi
  if echo "$commands" | grep -E 'npm (install|i) '; then
    echo "$script: npm installs without a lock file: npm ci"; status=1
  fi
done
exit $status
