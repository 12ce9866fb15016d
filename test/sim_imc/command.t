Vehicles on the network, for as long as is said. The numbers of the ports depend on what else runs.

  $ cat > two.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > vehicle 'x8-02', { type 'UAV' }
  > END
  $ alias sim='dolphin sim --imc --for 0.1 --discovery-ports 21120-21139 --port 21140'
  $ sim two.fleet --log log.jsonl | sed 's/port [0-9]*/port N/'
  noptilus-1 (UUV): IMC system 0x3001, UDP port N
  x8-02 (UAV): IMC system 0x3002, UDP port N
  $ cat log.jsonl

Without a fleet, the built-in one.

  $ sim --first-id 0x20 | sed 's/port [0-9]*/port N/'
  noptilus-1 (UUV): IMC system 0x0020, UDP port N
  noptilus-2 (UUV): IMC system 0x0021, UDP port N
  noptilus-3 (UUV): IMC system 0x0022, UDP port N
  x8-02 (UAV): IMC system 0x0023, UDP port N

Ctrl-C, or a request to terminate.

  $ dolphin sim two.fleet --imc --discovery-ports 21120-21139 --port 21140 > lines & pid=$!
  $ until [ -s lines ]; do sleep 0.05; done; kill $pid; wait $pid
  [130]

Usage.

  $ dolphin sim two.fleet
  dolphin: give --imc or --platform, the protocol of the simulated vehicles
  [2]
  $ sim none.fleet
  dolphin: none.fleet: No such file or directory
  [2]
  $ sim two.fleet --refuse nobody=why
  dolphin: the fleet has no vehicle 'nobody'
  [2]
  $ sim two.fleet --loss 30
  dolphin: option '--loss': '30' is not a number from 0 to 1
  Usage: dolphin sim [OPTION]… [FLEET]
  Try 'dolphin sim --help' or 'dolphin --help' for more information.
  [2]
  $ sim two.fleet --delay 0.5-0.1
  dolphin: option '--delay': '0.5-0.1' is not a delay such as 0.2 or 0.1-0.5
  Usage: dolphin sim [OPTION]… [FLEET]
  Try 'dolphin sim --help' or 'dolphin --help' for more information.
  [2]
  $ sim two.fleet --block x8-02=10
  dolphin: option '--block': 'x8-02=10' is not of the form
           VEHICLE=FROM,LASTING, both in seconds
  Usage: dolphin sim [OPTION]… [FLEET]
  Try 'dolphin sim --help' or 'dolphin --help' for more information.
  [2]
  $ sim two.fleet --vanish x8-02
  dolphin: option '--vanish': 'x8-02' is not of the form VEHICLE=FROM or
           VEHICLE=FROM,LASTING
  Usage: dolphin sim [OPTION]… [FLEET]
  Try 'dolphin sim --help' or 'dolphin --help' for more information.
  [2]
  $ sim two.fleet --vanish nobody=10,5
  dolphin: the fleet has no vehicle 'nobody'
  [2]
  $ sim two.fleet --log no/such/log
  dolphin: the log cannot be written: no/such/log: No such file or directory
  [3]
  $ dolphin sim --help=plain | grep '^[A-Z]'
  NAME
  SYNOPSIS
  DESCRIPTION
  ARGUMENTS
  OPTIONS
  FAULTS
  NETWORK
  COMMON OPTIONS
  EXIT STATUS
  EXAMPLES
  SEE ALSO
