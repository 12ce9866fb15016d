#!/bin/sh
# neovim.sh DOLPHIN EDITORS MISSION LUA OUT: runs Neovim without a terminal and its user's settings.
set -eu
export DOLPHIN="$1" EDITORS="$2" MISSION="$3" OUT="$5"
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
HOME=$home XDG_STATE_HOME=$home XDG_DATA_HOME=$home XDG_CONFIG_HOME=$home XDG_CACHE_HOME=$home \
  timeout 120 nvim --headless --clean -n --cmd "set runtimepath^=$EDITORS" \
    -c "filetype plugin indent on" -c "syntax on" -c "luafile $4" </dev/null >"$home/log" 2>&1 || true
[ -s "$OUT" ] || { cat "$home/log"; exit 1; }
