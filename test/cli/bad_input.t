Whatever is given, the answer is a sentence and status 2, never an exception.

  $ dolphin exec missing.dol
  dolphin: missing.dol: No such file or directory
  [2]
  $ dolphin check missing.dol
  dolphin: missing.dol: No such file or directory
  [2]
  $ dolphin parse missing.dol
  dolphin: missing.dol: No such file or directory
  [2]
  $ mkdir folder
  $ dolphin exec folder
  dolphin: folder: this is a directory, not a file
  [2]
  $ dolphin exec ''
  dolphin: the name of the file is empty
  [2]
  $ echo "message 'hello'" > hello.dol
  $ dolphin exec hello.dol/deeper
  dolphin: hello.dol/deeper: Not a directory
  [2]

Files that are no text.

  $ printf 'message 1\nx = \000\001\002\n' > zero.dol
  $ dolphin exec zero.dol
  zero.dol:2:5: error: this file is not text: a zero byte stands here
    2 | x = ???
      |     ^
      hint: save the program as UTF-8 text
  [2]
  $ printf 'message "\377\376"\n' > latin.dol
  $ dolphin exec latin.dol
  latin.dol:1:10: error: this file is not UTF-8 text: byte 0xFF stands here
    1 | message "??"
      |          ^
      hint: save the program as UTF-8 text
  [2]
  $ head -c 100000 "$(command -v dolphin)" > binary.dol
  $ dolphin check binary.dol > told.txt 2>&1
  [2]
  $ grep -c Fatal told.txt
  0
  [1]

Syntax errors, several at once.

  $ cat > syntax.dol <<'EOF'
  > v = pick { type 'UUV'
  > execute v: imcPlan('a') >>
  > EOF
  $ dolphin exec syntax.dol
  syntax.dol:1:10: error: this '{' is never closed
    1 | v = pick { type 'UUV'
      |          ^
      hint: a '}' is missing
  [2]
  $ cat > two.dol <<'EOF'
  > x = = 1
  > message 'fine'
  > y = )
  > EOF
  $ dolphin check two.dol
  two.dol:1:5: error: unexpected '='
    1 | x = = 1
      |     ^
      hint: an expression is expected here
  two.dol:3:5: error: unexpected ')'
    3 | y = )
      |     ^
      hint: no '(' is open here
  two.dol: 2 errors
  [2]

Unknown names.

  $ cat > unknown.dol <<'EOF'
  > survey = imcPlan('survey')
  > exceute survey
  > execute surve
  > setConectionTimeout 1.minute
  > EOF
  $ dolphin check unknown.dol
  unknown.dol:2:1: error: unknown name 'exceute'
    2 | exceute survey
      | ^^^^^^^
      hint: did you mean 'execute'?
  unknown.dol:3:9: error: unknown name 'surve'
    3 | execute surve
      |         ^^^^^
      hint: did you mean 'survey'?
  unknown.dol:4:1: error: unknown name 'setConectionTimeout'
    4 | setConectionTimeout 1.minute
      | ^^^^^^^^^^^^^^^^^^^
      hint: did you mean 'setConnectionTimeout'?
  unknown.dol: 3 errors
  [2]

Wrong types that can be seen beforehand, and those that cannot.

  $ echo 'release 3' > release.dol
  $ dolphin exec release.dol
  release.dol:1:9: error: release takes a vehicle set, this is a number
    1 | release 3
      |         ^
  [2]
  $ printf 'v = 3\nrelease v\n' > release_later.dol
  $ dolphin exec release_later.dol
     0:00  program     fails: expected a vehicle set to release, found a number, 3
  release_later.dol:2:1: error: expected a vehicle set to release, found a number, 3
    2 | release v
      | ^^^^^^^^^
  [1]
  $ echo 'execute imcPlan(7)' > plan.dol
  $ dolphin exec plan.dol
  plan.dol:1:17: error: imcPlan takes a string, this is a number
    1 | execute imcPlan(7)
      |                 ^
  [2]
  $ printf 'n = 7\nexecute imcPlan(n)\n' > plan_later.dol
  $ dolphin exec plan_later.dol
     0:00  program     fails: expected the name of a plan, a string, found a number, 7
  plan_later.dol:2:9: error: expected the name of a plan, a string, found a number, 7
    2 | execute imcPlan(n)
      |         ^^^^^^^^^^
  [1]

What belongs to the script, in a task.

  $ echo "execute action { release pick { type 'UUV' } }" > blocking.dol
  $ dolphin check blocking.dol
  blocking.dol:1:18: error: release belongs to the script: the code of action is part of a task and cannot wait
    1 | execute action { release pick { type 'UUV' } }
      |                  ^^^^^^^
      hint: do it before execute, or split the task
  blocking.dol:1:26: error: pick belongs to the script: the code of action is part of a task and cannot wait
    1 | execute action { release pick { type 'UUV' } }
      |                          ^^^^^^^^^^^^^^^^^^^
      hint: do it before execute, or split the task
  blocking.dol: 2 errors
  [2]

A hundred thousand parentheses.

  $ python3 -c 'print("x = " + "(" * 100000 + "1" + ")" * 100000)' > deep.dol
  $ dolphin check deep.dol
  deep.dol:1:1005: error: brackets nest deeper than 1000 here
    1 | ...((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((...
      |                                                      ^
      hint: give the inner parts names
  deep.dol: 1 error
  [2]
  $ python3 -c 'print("x = " + "(" * 100000)' > open.dol
  $ dolphin check open.dol 2>&1 | cut -c 1-100
  open.dol:1:1005: error: brackets nest deeper than 1000 here
    1 | ...(((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((
      |                                                      ^
      hint: give the inner parts names
  open.dol: 1 error
  $ python3 -c 'print("x = " + " + ".join(["1"] * 100000))' > long.dol
  $ dolphin check long.dol
  long.dol:1:360009: error: the program nests deeper than 10000 here
    1 | ...+ 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + ...
      |                                                      ^
      hint: give parts of it names
  long.dol: 1 error
  [2]
  $ python3 -c 'print("def f(n) { n == 0 ? 0 : 1 + f(n - 1) }\nmessage f(100000)")' > recursion.dol
  $ dolphin exec recursion.dol
     0:00  program     fails: calls nest more than 10000 deep: does f call itself without end?
  recursion.dol:1:29: error: calls nest more than 10000 deep: does f call itself without end?
    1 | def f(n) { n == 0 ? 0 : 1 + f(n - 1) }
      |                             ^^^^^^^^
  [1]

Vehicles that are not there.

  $ cat > pick.dol <<'EOF'
  > v = pick { type 'ROV'; payload 'Arm' }
  > EOF
  $ dolphin exec pick.dol
     0:10  program     fails: could not pick 1 vehicle of type 'ROV' with payload Arm: noptilus-1 is a UUV; noptilus-2 is a UUV; noptilus-3 is a UUV; x8-02 is a UAV
  pick.dol:1:5: error: could not pick 1 vehicle of type 'ROV' with payload Arm: noptilus-1 is a UUV; noptilus-2 is a UUV; noptilus-3 is a UUV; x8-02 is a UAV
    1 | v = pick { type 'ROV'; payload 'Arm' }
      |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  [1]

More tasks at once than vehicles.

  $ cat > crowd.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute v: imcPlan('a') | imcPlan('b')
  > EOF
  $ dolphin exec crowd.dol
  crowd.dol:2:9: error: 'v' is one vehicle, and the task needs 2 at the same time
    2 | execute v: imcPlan('a') | imcPlan('b')
      |         ^
      hint: tasks of one vehicle follow each other by >>
  [2]

Fleets that are not right.

  $ dolphin exec hello.dol --fleet missing.fleet
  dolphin: missing.fleet: No such file or directory
  [2]
  $ cat > twice.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'a', { type 'UAV' }
  > EOF
  $ dolphin exec hello.dol --fleet twice.fleet
  twice.fleet:2:9: error: vehicle 'a' stands twice
    2 | vehicle 'a', { type 'UAV' }
      |         ^^^
      hint: the first is on line 1
  [2]
  $ dolphin check hello.dol --fleet twice.fleet
  twice.fleet:2:9: error: vehicle 'a' stands twice
    2 | vehicle 'a', { type 'UAV' }
      |         ^^^
      hint: the first is on line 1
  twice.fleet: 1 error
  hello.dol: no errors
  [2]
  $ echo "vehicle 'a', { tipe 'UUV' }" > hello.fleet
  $ dolphin exec hello.dol
  hello.fleet:1:9: error: vehicle 'a' has no type
    1 | vehicle 'a', { tipe 'UUV' }
      |         ^^^
      hint: add its type: type 'UUV'
  hello.fleet:1:16: error: a vehicle has no setting 'tipe'
    1 | vehicle 'a', { tipe 'UUV' }
      |                ^^^^
      hint: did you mean 'type'?
  [2]

Usage.

  $ dolphin > told.txt 2>&1
  [2]
  $ sed 's/, must be .*//' told.txt
  dolphin: required COMMAND name is missing
  Usage: dolphin COMMAND …
  Try 'dolphin --help' for more information.
  $ dolphin exec
  dolphin: required argument PROG is missing
  Usage: dolphin exec [OPTION]… PROG
  Try 'dolphin exec --help' or 'dolphin --help' for more information.
  [2]
  $ dolphin fly hello.dol > told.txt 2>&1
  [2]
  $ head -1 told.txt | sed 's/, must be .*//'
  dolphin: unknown command 'fly', did you mean either 'tla' or 'fmt'?
  $ dolphin exec hello.dol --sped 2
  dolphin: unknown option '--sped', did you mean either '--speed' or '--seed'?
  Usage: dolphin exec [OPTION]… PROG
  Try 'dolphin exec --help' or 'dolphin --help' for more information.
  [2]
  $ dolphin exec hello.dol --speed 0
  dolphin: option '--speed': '0' is not a number greater than 0
  Usage: dolphin exec [OPTION]… PROG
  Try 'dolphin exec --help' or 'dolphin --help' for more information.
  [2]
  $ dolphin exec hello.dol --seed many
  dolphin: option '--seed': invalid value 'many', expected an integer
  Usage: dolphin exec [OPTION]… PROG
  Try 'dolphin exec --help' or 'dolphin --help' for more information.
  [2]
  $ dolphin exec hello.dol another.dol
  dolphin: too many arguments, don't know what to do with 'another.dol'
  Usage: dolphin exec [OPTION]… PROG
  Try 'dolphin exec --help' or 'dolphin --help' for more information.
  [2]

A fleet in place of a program.

  $ echo "vehicle 'a', { type 'UUV' }" > a.fleet
  $ dolphin exec a.fleet
  dolphin: a.fleet: this is a fleet: name a program, and the fleet by --fleet a.fleet
  [2]

Control characters in a source or in a file's name never reach the terminal.

  $ printf 'message "a\033[31mb\302\233c" + nothing_there\n' > control.dol
  $ dolphin check control.dol 2>&1
  control.dol:1:23: error: unknown name 'nothing_there'
    1 | message "a?[31mb?c" + nothing_there
      |                       ^^^^^^^^^^^^^
  control.dol: 1 error
  [2]
  $ dolphin check "$(printf 'a\033[31mb.dol')" 2>&1
  dolphin: a?[31mb.dol: No such file or directory
  [2]
  $ cp control.dol "$(printf 'a\033[31mb.dol')"
  $ dolphin check "$(printf 'a\033[31mb.dol')" 2>&1
  a?[31mb.dol:1:23: error: unknown name 'nothing_there'
    1 | message "a?[31mb?c" + nothing_there
      |                       ^^^^^^^^^^^^^
  a?[31mb.dol: 1 error
  [2]

The programs that ran did what the semantics allows.

  $ check-journals
