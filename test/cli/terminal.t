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
  $ grep -o 'left-1 .*left .*%' typescript | head -1 | sed 's/0:[0-9]*/TIME/; s/[0-9.]*, -[0-9.]*/POSITION/'
  left-1   left   TIME  POSITION  100%
  $ grep -c 'starts left' typescript
  1

It is redrawn at most ten times a second.

  $ [ "$(grep -c '2 vehicles' typescript)" -le 14 ] && echo few
  few

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
