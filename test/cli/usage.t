  $ dolphin --version
  0.1.0
  $ dolphin exec --help=plain | sed -n '/^EXIT STATUS/,/--seed 7/p' | grep .
  EXIT STATUS
         0   all is well.
         1   the program halted or failed, or got stuck; the reason is on
             standard error.
         2   the program, the fleet or the command line is not right; nothing
             was started.
         3   the platform or the output failed, not the program.
         125 a fault of dolphin itself. Please report it.
         130 the run was interrupted by Ctrl-C, by a request to terminate, or
             because its log has no reader any more.
  FILES
         PROG with the ending .fleet
             The fleet, unless --sim or --fleet names another.
  EXAMPLES
         The mission of the paper, as fast as possible; then at sixty times the
         speed of reality, which shows the board:
           dolphin exec examples/rendezvous.dol
           dolphin exec examples/rendezvous.dol --speed 60
         On another fleet, with another seed, and with an answer to the
         program's question:
           dolphin exec mission.dol --fleet harbour.fleet --seed 7 --answer 2
  $ dolphin exec --help=plain | grep -c '^EXAMPLES\|^FILES\|^OPTIONS\|^DESCRIPTION'
  4
  $ dolphin --help=plain | sed -n '/^WRITE A PROGRAM/,/^EXAMPLES/p' | grep '^       \(check\|exec\|parse\) '
         check [--fleet=FLEET] [--platform=CMD] [--set=NAME=VALUE] [OPTION]…
         parse [OPTION]… PROG
         exec [OPTION]… PROG
