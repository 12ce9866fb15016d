open Dolphin_syntax
open Dolphin_semantics
open QCheck2.Gen

let statements text =
  match Parse.program ~file:"calls.dol" text with
  | Ok statements -> statements
  | Error _ -> invalid_arg ("Calls.statements: " ^ text)

let call =
  frequencyl
    [ (4, "g = s.level"); (3, "if (s.ready(g)) { post x: 1 } else { consume x: _ }"); (4, "execute s.next()");
      (2, "execute (s.next() | action { post y: 1 })"); (2, "s = s.self"); (1, "message s"); (1, "post z: s");
      (1, "s.add(g)"); (1, "consume z: s.self"); (1, "h = [s.level, s.self]\nif (s in h) { g = g + 1 }");
      (1, "execute watch action { g = s.level } onError { ignore() }");
      (1, "execute watch condition { s.ready() } onError { message(it); ignore() }"); (1, "g = s.nothing") ]

let rec split first = function
  | s :: rest when Generate.stands_first s -> split (s :: first) rest
  | rest -> (List.rev first, rest)

let insert statements rest =
  let* place = int_bound (List.length rest) in
  return (List.filteri (fun i _ -> i < place) rest @ statements @ List.filteri (fun i _ -> i >= place) rest)

let within programs =
  let* program = programs in
  let first, rest = split [] program in
  let* calls = list_size (int_range 1 3) call in
  let* rest = List.fold_left (fun rest call -> Fun.flip ( >>= ) (insert (statements call)) rest) (return rest) calls in
  (* Assigned twice, [s] is not known to be the supplier, so its calls in code of tasks are faults of the run. *)
  return (first @ statements "s = getSupplier()\ns = s" @ rest)

let task name = Ok (Core.Task (Platform { name; plan = None; task_site = Fault.unknown_site }))

let known =
  [ ("getSupplier", [ [ Ok (Core.Host "s") ] ]);
    ("s.level", [ [ Ok (Integer 1); Ok (Integer 2) ]; [ Ok (Integer 0) ] ]);
    ("t.level", [ [ Ok (Integer 1) ]; [ Ok (Integer 0) ] ]);
    ("s.ready", [ [ Ok (Boolean true); Ok (Boolean false) ]; [ Ok (Boolean true) ]; [ Ok (Boolean false) ] ]);
    ("t.ready", [ [ Error "closed" ] ]);
    ("s.next", [ [ task "p" ]; [ task "q"; Error "empty" ] ]);
    ("t.next", [ [ task "p"; task "q" ] ]);
    ("s.self", [ [ Ok (Host "s"); Ok (Host "t") ]; [ Ok (Host "t") ] ]);
    ("t.self", [ [ Ok (Host "t") ] ]);
    ("s.add", [ [ Ok Null ] ]) ]

let names = List.map fst known
let replies call = Option.value (List.assoc_opt call known) ~default:[]

let answering : Dolphin_environment.Environment.options =
  { Dolphin_environment.Environment.default with answers = (fun _ -> [ [ "1"; "2" ]; [ "0" ] ]); replies }
