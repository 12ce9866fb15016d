(* random_missions FOLDER FIRST NUMBER: writes random programs with fleets into FOLDER, for searches that are other
   programs: N.dol, N.fleet and N.options, whose lines are options of [dolphin explore], for N from FIRST on. SEED of
   the environment selects the programs. *)

module Generate = Test_support.Generate
module Calls = Test_support.Calls

(* The world and the replies of the generators' programs. *)
let fleet =
  {|vehicle 'a', { type 'UUV'; payload 'DVL', 'Sidescan', 'Camera'; shows 'T', 12 }
vehicle 'b', { type 'UUV'; payload 'DVL', 'Sidescan', 'Camera'; shows 'T', 12 }
vehicle 'c', { type 'UAV'; payload 'DVL', 'Sidescan', 'Camera'; shows 'T', 12 }

reply 'getSupplier', object('s')
reply 's.level', either(1, 2), 0
reply 't.level', 1, 0
reply 's.ready', either(true, false), true, false
reply 't.ready', fails('closed')
reply 's.next', task('p'), either(task('q'), fails('empty'))
reply 's.self', either(object('s'), object('t')), object('t')
reply 't.self', object('t')
reply 's.add', null
|}

let nested =
  QCheck2.Gen.(
    let* depth = int_range 0 2 in
    map
      (Generate.executing ~before:[ Generate.statement (Generate.post "x" 1) ])
      (Generate.nested ~vehicles:Generate.vehicles ~depth))

let mission =
  QCheck2.Gen.(
    triple
      (frequency [ (3, Generate.program); (2, Calls.within Generate.program); (3, nested) ])
      (frequencyl [ (3, false); (1, true) ])
      (oneofl [ []; [ "--faults=fail=1" ]; [ "--faults=fail=1,loss=1,join=1" ]; [ "--faults=interrupt" ] ]))

let write folder number extension text =
  let out = open_out_bin (Filename.concat folder (Printf.sprintf "%d.%s" number extension)) in
  output_string out text;
  close_out out

let () =
  let folder = Sys.argv.(1) and first = int_of_string Sys.argv.(2) and count = int_of_string Sys.argv.(3) in
  let seed = match Sys.getenv_opt "SEED" with Some n -> int_of_string n | None -> 20_261_125 in
  for number = first to first + count - 1 do
    let rand = Random.State.make [| seed; number |] in
    let program, looped, faults = QCheck2.Gen.generate1 ~rand mission in
    write folder number "dol" (Generate.print (if looped then Generate.for_ever program else program));
    write folder number "fleet" fleet;
    write folder number "options" (String.concat "\n" ([ "--answer=1"; "--answer=2" ] @ faults))
  done
