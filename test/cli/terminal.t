On a terminal a line for each vehicle stands under the log, and is gone at the end. The pseudo-terminal of script(1)
stands in for one.

  $ cat > mission.dol <<'EOF'
  > vs = pick { count 2; type 'UUV' }
  > execute imcPlan('left') | imcPlan('right')
  > EOF
  $ cat > mission.fleet <<'EOF'
  > vehicle 'left-1', { type 'UUV' }
  > vehicle 'right-1', { type 'UUV' }
  > plan 'left', { duration 30.seconds }
  > plan 'right', { duration 1.min }
  > EOF
  $ TERM=xterm script -q -c 'dolphin exec mission.dol --speed 60' typescript > /dev/null
  $ grep -o 'left-1 .*left .*%.*' typescript | head -1 | sed 's/0:[0-9]*/TIME/; s/[0-9.]*, -[0-9.]*/POSITION/; s/ *.$//'
  left-1   left   TIME  100%  POSITION
  $ grep -c 'starts left' typescript
  1

It is redrawn at most ten times a second.

  $ [ "$(grep -c '2 vehicles' typescript)" -le 14 ] && echo few
  few

At the end stands what became of the run.

  $ grep -a -A 2 'completed after' typescript | tr -d '\r' | sed 's/.*completed after .*/completed after TIME/; s/journal .*/journal FILE/'
  completed after TIME
    tasks    2 done
    journal FILE

What is typed does not show, and does not move the board.

  $ cat > types.py <<'EOF'
  > import os, pty
  > pid, terminal = pty.fork()
  > if pid == 0:
  >     os.environ["TERM"] = "xterm"
  >     os.execvp("dolphin", ["dolphin", "exec", "mission.dol", "--speed", "20"])
  > text = b""
  > def until(what):
  >     global text
  >     while what not in text: text += os.read(terminal, 65536)
  > until(b"2 vehicles")
  > os.write(terminal, b"typed\n\n")
  > until(b"completed after")
  > print(b"typed" in text)
  > EOF
  $ timeout 120 python3 types.py
  False

Colours are for terminals, and for whoever wants them.

  $ NO_COLOR=1 TERM=xterm script -q -c 'dolphin exec mission.dol --speed 600' typescript > /dev/null
  $ grep -c "$(printf '\033\\[[0-9]*m')" typescript
  0
  [1]
  $ dolphin exec mission.dol --color always | grep -c "$(printf '\033\\[1m')"
  1

Of the log one may have less.

  $ dolphin exec mission.dol --quiet | sed 's/journal .*/journal FILE/'
     1:00  program     ends
  completed after 1:00
    tasks    2 done
    journal FILE
  $ dolphin exec mission.dol --only left-1
     0:00  program     picks left-1, right-1
     0:00  left-1      starts left
     0:30  left-1      ends left
     1:00  program     releases left-1, right-1
     1:00  program     ends
  $ dolphin exec mission.dol --only left-2
  dolphin: --only: the fleet has no vehicle 'left-2' (did you mean 'left-1'?)
  [2]

Ctrl-Z and what follows it do no harm: the board goes, and comes back.

  $ cat > stops.py <<'EOF'
  > import os, pty
  > pid, terminal = pty.fork()
  > if pid == 0:
  >     os.environ["TERM"] = "xterm"
  >     os.execvp("bash", ["bash", "-mc", "dolphin exec mission.dol --speed 20; echo back in the shell; fg"])
  > def until(what):
  >     text = b""
  >     while what not in text: text += os.read(terminal, 65536)
  >     print(what.decode())
  > until(b"2 vehicles")
  > os.write(terminal, b"\x1a")
  > until(b"back in the shell")
  > until(b"2 vehicles")
  > until(b"completed after")
  > EOF
  $ timeout 120 python3 stops.py
  2 vehicles
  back in the shell
  2 vehicles
  completed after

Between Ctrl-Z and `bg` the program makes no step, and nothing is written. In the background the board is off, and the
run comes to its end.

  $ cat > background.py <<'EOF'
  > import os, pty
  > script = """dolphin exec mission.dol --speed 10 --journal stop.run; cp stop.run then.run; sleep 2
  > cmp stop.run then.run && echo no step mean'while'; bg; wait"""
  > pid, terminal = pty.fork()
  > if pid == 0:
  >     os.environ["TERM"] = "xterm"
  >     os.execvp("bash", ["bash", "-mc", script])
  > def until(what):
  >     text = b""
  >     while what not in text: text += os.read(terminal, 65536)
  >     print(what.decode())
  >     return text[text.index(what):]
  > until(b"2 vehicles")
  > os.write(terminal, b"\x1a")
  > after = until(b"no step meanwhile") + until(b"completed after")
  > print("a board" if b"2 vehicles" in after else "no board")
  > EOF
  $ timeout 120 python3 background.py
  2 vehicles
  no step meanwhile
  completed after
  no board
  $ dolphin trace check mission.dol stop.run | head -n 1
  stop.run: a run, of 8 transitions in 1:00; completed

Elsewhere there is no trace of it.

  $ dolphin exec mission.dol | grep -c "$(printf '\033')"
  0
  [1]
  $ TERM=dumb script -q -c 'dolphin exec mission.dol' typescript > /dev/null
  $ grep -c "$(printf '\033')" typescript
  0
  [1]

The programs that ran did what the semantics allows.

  $ check-journals
