#!/bin/sh
# one_printer.sh ROOT: fails if a command prints text other than by Safe_print, which makes it fit for terminals. JSON,
# the messages of the language server and programs are data.
cd "$1" || exit 1
found=$(grep -rnE '\b(print_endline|Printf\.printf|Format\.printf)\b' bin lib/app --include=*.ml |
    grep -vE 'Canonical\.|if json then print_endline|Successor_service\.greeting|Content-Length|Format\.printf "%!"|Print\.program')
if [ -n "$found" ]; then
    echo "$found"
    echo "use Dolphin_display.Safe_print"
    exit 1
fi
