Questions are answered by the command line, then by the fleet, then on standard input.

  $ cat > ask.dol <<'EOF'
  > a = 5
  > for (i in 1..3) {
  >     b = ask 'b?'
  >     message "b=${b}"
  > }
  > c = ask 'c?'
  > EOF
  $ cat > ask.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > answer 'b?', a * a + 1
  > EOF
  $ echo '[1, 2]' | dolphin exec ask.dol --answer 2
     0:00  program     asks: b? 2
     0:00  program     says: b=2
     0:00  program     asks: b? a * a + 1
     0:00  program     says: b=26
     0:00  program     asks: b? a * a + 1
     0:00  program     says: b=26
     0:00  program     asks: c? [1, 2]
     0:00  program     ends

Bad answers are asked for again.

  $ dolphin exec ask.dol --answer 'a +' --answer 1 --answer 'aa' --answer '"two"' --answer 'halt()' --answer 3 --answer 4
     0:00  program     asks: b? a +
     0:00  program     cannot take this answer: unexpected end of the text (an expression is expected here)
     0:00  program     asks: b? 1
     0:00  program     says: b=1
     0:00  program     asks: b? aa
     0:00  program     cannot take this answer: unknown name 'aa' (did you mean 'a'?)
     0:00  program     asks: b? "two"
     0:00  program     says: b=two
     0:00  program     asks: b? halt()
     0:00  program     cannot take this answer: an answer may only compute a value
     0:00  program     asks: b? 3
     0:00  program     says: b=3
     0:00  program     asks: c? 4
     0:00  program     ends

  $ dolphin exec ask.dol --answer '' --answer 0 --answer 0 --answer 0 --answer 0 | sed -n 1,3p
     0:00  program     asks: b? 
     0:00  program     cannot take this answer: unexpected end of the text (an expression is expected here)
     0:00  program     asks: b? 0
  $ printf '\n1\n' | dolphin exec ask.dol --answer 0 --answer 0 --answer 0 | tail -4
     0:00  program     asks: c? 
     0:00  program     cannot take this answer: unexpected end of the text (an expression is expected here)
     0:00  program     asks: c? 1
     0:00  program     ends

So are those of the fleet: what comes next is standard input.

  $ cat > bad.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > answer 'b?', 1 / 0
  > EOF
  $ printf '1\n2\n3\n4' | dolphin exec ask.dol --fleet bad.fleet
     0:00  program     asks: b? 1 / 0
     0:00  program     cannot take this answer: division by zero
     0:00  program     asks: b? 1
     0:00  program     says: b=1
     0:00  program     asks: b? 2
     0:00  program     says: b=2
     0:00  program     asks: b? 3
     0:00  program     says: b=3
     0:00  program     asks: c? 4
     0:00  program     ends

The end of the input is no answer.

  $ dolphin exec ask.dol --answer 1 --answer 2 --answer 3 < /dev/null
     0:00  program     asks: b? 1
     0:00  program     says: b=1
     0:00  program     asks: b? 2
     0:00  program     says: b=2
     0:00  program     asks: b? 3
     0:00  program     says: b=3
     0:00  program     asks: c? 
     0:00  program     fails: no answer to 'c?': end of input
  ask.dol:6:5: error: no answer to 'c?': end of input
    6 | c = ask 'c?'
      |     ^^^^^^^^
  [1]

The programs that ran did what the semantics allows.

  $ check-journals

Yes and no are what people type for truth values. `confirm` asks until it hears one of them.

  $ cat > confirm.dol <<'EOF'
  > y = false
  > n = 'a name'
  > for (i in 1..4) message(ask 'b?')
  > message confirm('Retrieve now?')
  > message(confirm('Surely?') ? 'sure' : 'not sure')
  > place = ask 'Where?'
  > EOF
  $ printf 'y\nNo\nn\nYES\nn + 1\nperhaps\nyes\nfalse\nnorth\n"north"\n' | dolphin exec confirm.dol --sim
     0:00  program     asks: b? y
     0:00  program     says: true
     0:00  program     asks: b? No
     0:00  program     says: false
     0:00  program     asks: b? n
     0:00  program     says: false
     0:00  program     asks: b? YES
     0:00  program     says: true
     0:00  program     asks: Retrieve now? n + 1
     0:00  program     asks: Retrieve now? (yes or no) perhaps
     0:00  program     cannot take this answer: unknown name 'perhaps' (a text stands in quotes: 'perhaps')
     0:00  program     asks: Retrieve now? (yes or no) yes
     0:00  program     says: true
     0:00  program     asks: Surely? false
     0:00  program     says: not sure
     0:00  program     asks: Where? north
     0:00  program     cannot take this answer: unknown name 'north' (a text stands in quotes: 'north')
     0:00  program     asks: Where? "north"
     0:00  program     ends
