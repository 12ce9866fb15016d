open Core
module Ast = Dolphin_syntax.Ast

(* [now() + later op bound] and [now() - earlier op bound]. *)
type shift = Nothing | Later of expression | Earlier of expression
type comparison = { op : Ast.binary; shift : shift; bound : expression; site : site }

type t = {
  comparisons : comparison list;
  others : site list;  (* where the date is read for another use than printing *)
  asked : bool;  (* whether this may be in code that is asked again and again *)
}

(* {1 What reads the date} *)

let is_now e = match e.node with Apply (Builtin Now, []) -> true | _ -> false

let mirrored : Ast.binary -> Ast.binary = function
  | Less -> Greater
  | Less_equal -> Greater_equal
  | Greater -> Less
  | Greater_equal -> Less_equal
  | op -> op

let is_comparison : Ast.binary -> bool = function
  | Less | Less_equal | Greater | Greater_equal | Equal | Not_equal -> true
  | Sequence | Append | Add | Subtract | Multiply | Divide | Remainder | Power | Around | Intersect | Parallel | And
  | Or | Member_of -> false

(* Expressions of variables and numbers, without any effect. *)
let rec is_steady e =
  match e.node with
  | Constant (Integer _ | Number _) | Global _ -> true
  | Apply ((Unary Negate | Binary (Add | Subtract | Multiply | Divide | Remainder | Power) | Property _), es)
  | Apply (Builtin (Math _), es) -> List.for_all is_steady es
  | _ -> false

(* [e] as the date, earlier or later by something; with the [now()] in it. *)
let shifted e =
  match e.node with
  | Apply (Binary Add, [ a; b ]) when is_now a && is_steady b -> Some (a, Later b)
  | Apply (Binary Add, [ a; b ]) when is_now b && is_steady a -> Some (b, Later a)
  | Apply (Binary Subtract, [ a; b ]) when is_now a && is_steady b -> Some (a, Earlier b)
  | _ -> if is_now e then Some (e, Nothing) else None

let comparison e =
  match e.node with
  | Apply (Binary op, [ a; b ]) when is_comparison op -> (
      match shifted a, shifted b with
      | Some (now, shift), None when is_steady b -> Some (now, { op; shift; bound = b; site = now.site })
      | None, Some (now, shift) when is_steady a ->
        Some (now, { op = mirrored op; shift; bound = a; site = now.site })
      | _, _ -> None)
  | _ -> None

(* Those in printed text, on which nothing depends: in texts, and in numbers that are computed for them. *)
let rec said e =
  match e.node with
  | Apply ((Builtin Message | Concatenate | Unary Negate | Binary (Add | Subtract | Multiply | Divide)), es)
  | Apply (Method (("round" | "abs" | "toInteger"), _), es) -> List.concat_map said es
  | _ -> if is_now e then [ e ] else []

(* The code that runs once and for all: it reads the values of that moment. *)
let running_once (program : program) =
  let found = ref [ program.main ] in
  let note e =
    match e.node with
    | Apply (Builtin Make_action, [ { node = Make_closure (lambda, _) | Constant (Closure { lambda; _ }); _ } ])
    | Apply (Builtin Make_watch, [ _; { node = Make_closure (lambda, _) | Constant (Closure { lambda; _ }); _ } ]) ->
      found := lambda :: !found
    | _ -> ()
  in
  Code_walk.iter note (Code_walk.pieces program);
  !found

let of_program (program : program) =
  let comparisons = ref [] and known = ref [] and all = ref [] in
  let visit within e =
    (match comparison e with
     | Some (now, found) -> comparisons := found :: !comparisons; known := now :: !known
     | None -> ());
    (match e.node with Apply (Builtin Message, _) -> known := said e @ !known | _ -> ());
    if is_now e then all := (within, e) :: !all
  in
  if not program.reads_now then { comparisons = []; others = []; asked = false }
  else begin
    Code_walk.iter_within visit (Code_walk.pieces program);
    let others = List.filter (fun (_, e) -> not (List.memq e !known)) !all in
    let once = running_once program in
    { comparisons = List.rev !comparisons;
      others = List.rev_map (fun (_, (e : expression)) -> e.site) others;
      asked = List.exists (fun (within, _) -> not (List.memq within once)) others }
  end

(* {1 Values} *)

let fuel = 10_000

(* The number that [e] is, if it is one. *)
let number program world store e =
  let lambda =
    { id = -1; label = ""; parameters = 0; implicit = false; captures = [||]; slots = 0; code = e;
      lambda_site = e.site }
  in
  let context : Code.context =
    { program; world; allocation = Vehicle_map.empty; bound = []; held = lazy []; needed = lazy []; store;
      tuples = Tuples.empty Tuple_space.no_key; mode = Task_code; deeds = [] }
  in
  match Machine.run ~fuel context (Machine.call { lambda; captured = [||] } []) with
  | Decided (Finished x, _, _) -> Value.to_number x
  | Decided ((Faulted _ | Exhausted | Did _ | Waits _ | Halted _ | Left_off), _, _) | Open _ | Unclear _ -> None

let latest = 1e15

(* The dates at which the date turns to be, or not to be, [op x]. *)
let turns (op : Ast.binary) x =
  if not (Float.abs x <= latest) then []
  else
    let reached = int_of_float (Float.ceil x) and passed = int_of_float (Float.floor x) + 1 in
    match op with
    | Less | Greater_equal -> [ reached ]
    | Less_equal | Greater -> [ passed ]
    | _ -> [ reached; passed ]

(* {1 The next date} *)

let next t program world ~now store =
  let number = number program world store in
  let of_comparison { op; shift; bound; site = _ } =
    let around c = List.concat_map (fun k -> [ k - 1; k; k + 1 ]) (turns op c) in
    match number bound, shift with
    | None, _ -> []
    | Some bound, Nothing -> turns op bound
    | Some bound, Later e -> Option.fold (number e) ~none:[] ~some:(fun x -> around (bound -. x))
    | Some bound, Earlier e -> Option.fold (number e) ~none:[] ~some:(fun x -> around (bound +. x))
  in
  let later = List.filter (fun k -> k > now) (List.concat_map of_comparison t.comparisons) in
  let later = if t.asked then (now + 1) :: later else later in
  match List.sort Int.compare later with [] -> None | first :: _ -> Some first

let is_exact t = not t.asked

(* {1 Dates that the program names} *)

exception Not_constant

(* The expressions without variables that [e] may stand for. *)
let rec possible assigned seen e =
  match e.node with
  | Constant (Integer _ | Number _) -> [ e ]
  | Global i when not (List.mem i seen) ->
    List.concat_map (possible assigned (i :: seen)) (Hashtbl.find_all assigned i)
  | Apply (operation, es) when is_steady e ->
    let each = List.map (possible assigned seen) es in
    let add rest xs = List.concat_map (fun x -> List.map (fun others -> x :: others) rest) xs in
    let arguments = List.fold_left add [ [] ] (List.rev each) in
    List.map (fun es -> { e with node = Apply (operation, es) }) arguments
  | _ -> raise Not_constant

let named (program : program) =
  let t = of_program program in
  let assigned = Hashtbl.create 16 in
  let note e = List.iter (fun (i, e) -> Hashtbl.add assigned i e) (Code_walk.assigned e) in
  Code_walk.iter note (Code_walk.pieces program);
  let of_comparison { op; shift; bound; site } =
    match shift, possible assigned [] bound with
    | Nothing, es ->
      let numbers = List.filter_map (number program World.empty Store.empty) es in
      Ok (List.concat_map (turns op) numbers)
    | (Later _ | Earlier _), _ | (exception Not_constant) -> Error site
  in
  match t.others with
  | site :: _ -> Error site
  | [] ->
    let dates = Dolphin_results.Results.concat_map of_comparison t.comparisons in
    Result.map (fun dates -> List.sort_uniq Int.compare (List.filter (fun k -> k > 0) dates)) dates
