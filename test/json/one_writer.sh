#!/bin/sh
# one_writer.sh ROOT: fails if a source other than the writer of JSON makes texts of JSON by Yojson, whose texts may be
# neither UTF-8 nor JSON.
cd "$1" || exit 1
found=$(grep -rnE 'Yojson\.[A-Za-z]+\.(to_string|to_channel|to_output|to_buffer|to_file|pretty_to_[a-z]+|write_[a-z_]+|std_to)' \
    lib bin --include=*.ml --include=*.mll --include=*.mly | grep -v '^lib/json_text/canonical.ml:')
if [ -n "$found" ]; then
    echo "$found"
    echo "use Dolphin_json.Canonical, or Dolphin_json_text.Canonical"
    exit 1
fi
