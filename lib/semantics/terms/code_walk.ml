open Core

let parts e =
  match e.node with
  | Constant _ | Local _ | Global _ | Make_closure _ | Break | Continue -> []
  | Set_local (_, e) | Set_global (_, e) | Return e -> [ e ]
  | Apply (_, es) | Block es -> es
  | If (a, b, c) -> [ a; b; c ]
  | While (a, b) | For (_, a, b) -> [ a; b ]

let rec ensured forms arguments =
  match forms, arguments with
  | Pair_of (Some _) :: forms, _ :: arguments | Pair_of None :: forms, _ :: _ :: arguments -> ensured forms arguments
  | Taken_pairs :: forms, arguments -> ensured forms arguments
  | Variable_of (i, _) :: forms, e :: arguments -> (i, e) :: ensured forms arguments
  | _, _ -> []

let assigned e =
  match e.node with
  | Set_global (i, e) -> [ (i, e) ]
  | Apply (Builtin (Make_ensure forms), _ :: arguments) -> ensured forms arguments
  | _ -> []

type key = Written of string | Computed of expression

let rec pairs keys arguments =
  match keys, arguments with
  | Some k :: keys, x :: arguments -> (Written k, x) :: pairs keys arguments
  | None :: keys, k :: x :: arguments -> (Computed k, x) :: pairs keys arguments
  | _, _ -> []

(* [visit] of the expressions of one piece of code; [enter] of the code that it makes or holds. *)
let rec walk ~visit ~enter e =
  visit e;
  match e.node with
  | Constant (Closure { lambda; _ }) | Make_closure (lambda, _) -> enter lambda
  | _ -> List.iter (walk ~visit ~enter) (parts e)

let pieces (program : program) =
  (program.main :: List.map snd program.functions) @ Option.to_list program.on_interrupt

let entering visit =
  let seen = ref [] in
  let rec enter lambda =
    if not (List.memq lambda !seen) then begin
      seen := lambda :: !seen;
      walk ~visit:(visit lambda) ~enter lambda.code
    end
  in
  enter

let iter_within visit lambdas = List.iter (entering visit) lambdas
let iter visit = iter_within (fun _ -> visit)

let iter_called visit (program : program) =
  let enter = entering (fun _ -> visit) in
  walk ~visit:ignore ~enter program.main.code;
  Option.iter enter program.on_interrupt;
  List.iter (fun (_, lambda) -> enter lambda) program.functions
