Texts of the command line, of traces, of graphs, of conformance cases and of choices may have control characters, or
bytes that are not UTF-8. None of them reaches the terminal.

  $ esc=$(printf '\033') bad=$(printf '\377')
  $ judged() { "$@" > out 2>&1; LC_ALL=C grep -c "[$(printf '\001-\010\013-\037')]" out; iconv -f UTF-8 -t UTF-8 out > /dev/null && echo UTF-8; }
  $ echo "post a: 1" > m.dol

  $ judged dolphin explore m.dol --faults="all$esc[2J$bad"; cat out
  0
  UTF-8
  dolphin: option '--faults': unknown fault 'all?[2J?': there are fail, loss,
           join, all and interrupt
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  $ judged dolphin lts m.dol --set="$esc$bad"
  0
  UTF-8
  $ judged dolphin "$esc$bad"
  0
  UTF-8

  $ judged dolphin explore m.dol --ltl="F
  > done('p$esc$bad')"; grep "^formula" out
  0
  UTF-8
  formula F done('p??'): violated after 2 steps: it does not hold
  formula F done('p??'): a shortest run in which it does not hold
  $ dolphin explore m.dol --strict --trace run > /dev/null
  [1]
  $ sed -i "s/no leftover tuples/broken\\\\u001b/" run
  $ judged dolphin exec m.dol --follow run; head -n 1 out
  0
  UTF-8
  breaks: broken?
  $ choose() { printf '\033\377\n' | dolphin walk m.dol --trace run; }
  $ judged choose; tail -n 3 out
  0
  UTF-8
  0> ??
  '??' is not known here: type a number, or help
  0> 

  $ printf 'des (0, 1, 2)\n(0, a\033\377, 1)\n' > a.aut
  $ printf 'des (0, 1, 2)\n(0, b, 1)\n' > b.aut
  $ judged dolphin lts a.aut --compare b.aut; cat out
  0
  UTF-8
  not bisimilar
  Only the left one satisfies <a��>
  Only the left one has the trace a��
  $ judged dolphin lts a.aut --format dot; tail -n 2 out
  0
  UTF-8
    0 -> 1 [label="a��"];
  }

  $ printf '{"title": "x\\u001b", "covers": ["END"], "fleet": [], "program": ["post a: 1"], "expect": {"trace": ["\\u001b[2J"]}}' > case.json
  $ judged dolphin conform case.json; cat out
  0
  UTF-8
  failed case.json: trace
    x?
    trace: step 1: the label: expected ?[2J, seen post a:1
  0 passed, 1 failed

The name of a program may have them, too: as a comment of a model, and in JSON.

  $ name=$(printf 'n\302\233\377\nm').dol; echo "v = pick { type 'UUV' }" > "$name"
  $ dolphin tla "$name" -o model > /dev/null && judged cat model/MC.tla; sed -n 2p out
  0
  UTF-8
  \* n?? m.dol in its world. Made by dolphin tla: generate it again rather than edit it.
  $ for command in 'time --json' 'explore --json' 'exec --json --runs 2'; do
  >   judged dolphin $command "$name"; LC_ALL=C grep -c "$(printf '\302')[$(printf '\200-\237')]" out || true
  > done
  0
  UTF-8
  0
  0
  UTF-8
  0
  0
  UTF-8
  0
