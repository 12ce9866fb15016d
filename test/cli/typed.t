Who types at a terminal sees what each question takes. What was typed before a question was shown never answers it.

  $ cat > mission.dol <<'END'
  > input 'go'
  > v = pick { type 'UUV' }
  > def gate() { execute condition { consume go: true } }
  > gate()
  > message 'many: ' + ask('How many?')
  > gate()
  > message 'sure: ' + confirm('Sure?')
  > gate()
  > execute confirm('Fire the thruster?') >> action { message 'fired' }
  > gate()
  > message 'again: ' + ask('Where?')
  > END
  $ cat > mission.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > END
  $ cat > types.py <<'END'
  > import os, pty, re, sys
  > pid, terminal = pty.fork()
  > if pid == 0:
  >     os.environ["TERM"] = sys.argv[1]
  >     os.execvp("dolphin", ["dolphin", "exec", "mission.dol", "--speed", "1", "--color", "never"])
  > text = ""
  > def until(what):
  >     global text
  >     while what not in text: text += os.read(terminal, 65536).decode().replace("\r", "")
  >     seen, text = text.split(what, 1)
  > def types(lines): os.write(terminal, lines.encode())
  > def asked(question, answer):
  >     until("asks: " + question)
  >     types(answer + "\n")
  > def asks(early, question, answer):
  >     # The lines before and behind the input are there before the question is.
  >     types(early + "\ngo: true\n" + early + "\n")
  >     asked(question, answer)
  > until("picks a")
  > asks("7", "How many? (a value: 2, 'text', yes or no) ", "south")
  > until("cannot take this answer: unknown name 'south' (a text stands in quotes: 'south')")
  > asked("How many? (a value: 2, 'text', yes or no) ", "12")
  > until("says: many: 12")
  > asks("yes", "Sure? (yes or no) ", "13")
  > asked("Sure? (yes or no) ", "no")
  > until("says: sure: false")
  > asks("no", "Fire the thruster? (yes or no) ", "perhaps")
  > until("cannot take this answer: it takes yes or no")
  > asked("Fire the thruster? (yes or no) ", "yes")
  > until("says: fired")
  > asks("'here'", "Where? (a value: 2, 'text', yes or no) ", "'there'")
  > until("says: again: there")
  > until("ends")
  > os.waitpid(pid, 0)
  > print("done")
  > END
  $ timeout 120 python3 types.py dumb
  done

So it is with a board under the log.

  $ timeout 120 python3 types.py xterm
  done

The programs that ran did what the semantics allows.

  $ check-journals
