A manual that does not go to a terminal is plain text.

  $ TERM=xterm dolphin explore --help | grep '^NAME'
  NAME
  $ TERM=xterm dolphin explore --help | od -An -c | grep -c '\\b'
  0
  [1]
