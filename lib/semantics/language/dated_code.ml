open Core
module Ast = Dolphin_syntax.Ast

type clock = Since_start | Time_of_day

(* [now() + later op bound] and [now() - earlier op bound]. *)
type shift = Nothing | Later of expression | Earlier of expression
type comparison = { clock : clock; op : Ast.binary; shift : shift; bound : expression; site : site }

type t = {
  comparisons : comparison list;
  others : site list;  (* where the date is read for another use than printing *)
  asked : bool;  (* whether this may be in code that is asked again and again *)
}

(* {1 What reads the date} *)

let clock e =
  match e.node with
  | Apply (Builtin Now, []) -> Some Since_start
  | Apply (Builtin Time_of_day, []) -> Some Time_of_day
  | _ -> None

let is_date e = clock e <> None
let is_now e = clock e = Some Since_start

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

let rec has_locals e = match e.node with Local _ -> true | _ -> List.exists has_locals (Code_walk.parts e)

(* Expressions of variables at the top of the program and numbers, without any effect. *)
let is_steady e = Code_flow.computes e && not (has_locals e)

(* [e] as the date, earlier or later by something; with the [now()] in it. *)
let shifted e =
  match e.node with
  | Apply (Binary Add, [ a; b ]) when is_now a && is_steady b -> Some (a, Later b)
  | Apply (Binary Add, [ a; b ]) when is_now b && is_steady a -> Some (b, Later a)
  | Apply (Binary Subtract, [ a; b ]) when is_now a && is_steady b -> Some (a, Earlier b)
  | _ -> if is_date e then Some (e, Nothing) else None

(* The comparison that [e] is, for each bound that it may have; with the date in it. *)
let comparison e ~bounds =
  let with_bounds (read, shift) op bound =
    let of_clock its_clock =
      let each bound = { clock = its_clock; op; shift; bound; site = (read : expression).site } in
      Option.map (fun found -> ((read : expression), List.map each found)) (bounds bound)
    in
    Option.bind (clock read) of_clock
  in
  match e.node with
  | Apply (Binary op, [ a; b ]) when is_comparison op -> (
      match shifted a, shifted b with
      | Some found, None -> with_bounds found op b
      | None, Some found -> with_bounds found (mirrored op) a
      | Some _, Some _ | None, None -> None)
  | _ -> None

(* {1 Values that do not change} *)

exception Not_constant

type constants = { assigned : (int, expression) Hashtbl.t; flow : Code_flow.t Lazy.t }

let constants (program : program) =
  let assigned = Hashtbl.create 16 in
  let note e = List.iter (fun (i, e) -> Hashtbl.add assigned i e) (Code_walk.assigned e) in
  Code_walk.iter note (Code_walk.pieces program);
  { assigned; flow = lazy (Code_flow.of_program program) }

(* The expressions without variables that [e], which [owner] has, may stand for. A variable at the top of the program
   that is assigned has no owner to ask: what it is assigned has no locals. *)
let rec possible c ~seen owner e =
  let again x = if List.mem x seen then raise Not_constant else x :: seen in
  match e.node with
  | Constant (Integer _ | Number _ | String _) -> [ e ]
  | Global i ->
    let seen = again (`Global i) in
    List.concat_map (possible c ~seen None) (Hashtbl.find_all c.assigned i)
  | Local i -> (
      let owner = match owner with Some owner -> owner | None -> raise Not_constant in
      let seen = again (`Local (owner.id, i)) in
      match Code_flow.values (Lazy.force c.flow) owner i with
      | Some found -> List.concat_map (fun (owner, e) -> possible c ~seen (Some owner) e) found
      | None -> raise Not_constant)
  | Apply (operation, es) when Code_flow.computes e ->
    let each = List.map (possible c ~seen owner) es in
    let add rest xs = List.concat_map (fun x -> List.map (fun others -> x :: others) rest) xs in
    let arguments = List.fold_left add [ [] ] (List.rev each) in
    List.map (fun es -> { e with node = Apply (operation, es) }) arguments
  | _ -> raise Not_constant

(* What [e], which [owner] has, is compared as: a variable at the top of the program is looked at when it matters. *)
let bounds c owner e =
  if is_steady e then Some [ e ]
  else if not (Code_flow.computes e) then None
  else match possible c ~seen:[] (Some owner) e with found -> Some found | exception Not_constant -> None

(* Those in printed text, on which nothing depends: in texts, and in numbers that are computed for them. *)
let rec said e =
  match e.node with
  | Apply ((Builtin Message | Concatenate | Unary Negate | Binary (Add | Subtract | Multiply | Divide)), es)
  | Apply (Method (("round" | "abs" | "toInteger"), _), es) -> List.concat_map said es
  | _ -> if is_date e then [ e ] else []

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
  let constants = constants program in
  let visit within e =
    (match comparison e ~bounds:(bounds constants within) with
     | Some (read, found) -> comparisons := List.rev_append found !comparisons; known := read :: !known
     | None -> ());
    (match e.node with Apply (Builtin Message, _) -> known := said e @ !known | _ -> ());
    if is_date e then all := (within, e) :: !all
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

(* {1 Dates} *)

type dates = { once : int list; daily : int list  (* each below the length of a day, and that much later each day *) }

let no_dates = { once = []; daily = [] }
let both a b = { once = a.once @ b.once; daily = a.daily @ b.daily }
let remainder n = ((n mod Calendar.day_length) + Calendar.day_length) mod Calendar.day_length

(* The time of day goes back at midnight. *)
let of_day (begins : Calendar.t) op x =
  let times = 0 :: List.filter (fun n -> n > 0 && n < Calendar.day_length) (turns op x) in
  { once = []; daily = List.map (fun n -> remainder (n - begins.second)) times }

let of_clock clock begins op x =
  match clock, begins with
  | Since_start, _ -> { once = turns op x; daily = [] }
  | Time_of_day, Some begins -> of_day begins op x
  | Time_of_day, None -> no_dates

(* The first of [daily] after [n]. *)
let following { once; daily } n =
  let again k = n + 1 + remainder (k - n - 1) in
  match List.sort Int.compare (List.filter (fun k -> k > n) once @ List.map again daily) with
  | [] -> None
  | first :: _ -> Some first

(* {1 The next date} *)

let next t (program : program) world ~now store =
  let number = number program world store in
  let of_comparison { clock; op; shift; bound; site = _ } =
    let around c = { no_dates with once = List.concat_map (fun k -> [ k - 1; k; k + 1 ]) (turns op c) } in
    match number bound, shift with
    | None, _ -> no_dates
    | Some bound, Nothing -> of_clock clock program.begins op bound
    | Some bound, Later e -> Option.fold (number e) ~none:no_dates ~some:(fun x -> around (bound -. x))
    | Some bound, Earlier e -> Option.fold (number e) ~none:no_dates ~some:(fun x -> around (bound +. x))
  in
  let found = List.fold_left (fun found c -> both found (of_comparison c)) no_dates t.comparisons in
  following (if t.asked then { found with once = (now + 1) :: found.once } else found) now

let is_exact t = not t.asked

(* {1 Dates that the program names} *)

let named (program : program) =
  let t = of_program program in
  let constants = constants program in
  let of_comparison { clock; op; shift; bound; site } =
    match clock, shift, possible constants ~seen:[] None bound with
    | Time_of_day, _, _ when program.begins = None -> Error site
    | _, Nothing, es ->
      let numbers = List.filter_map (number program World.empty Store.empty) es in
      Ok (List.map (of_clock clock program.begins op) numbers)
    | _, (Later _ | Earlier _), _ | (exception Not_constant) -> Error site
  in
  match t.others with
  | site :: _ -> Error site
  | [] ->
    let all = Dolphin_results.Results.concat_map of_comparison t.comparisons in
    let in_order keeps dates = List.sort_uniq Int.compare (List.filter keeps dates) in
    let in_order { once; daily } = { once = in_order (fun k -> k > 0) once; daily = in_order (fun _ -> true) daily } in
    Result.map (fun found -> in_order (List.fold_left both no_dates found)) all

let latest { once; daily } n =
  let again k = n - remainder (n - k) in
  List.fold_left max 0 (List.filter (fun k -> k <= n) (once @ List.map again daily))

(* The last day of [once] is followed by days that are alike. *)
let repeated { once; daily } n =
  if daily = [] then n
  else
    let last = List.fold_left max 0 once in
    let first = (last / Calendar.day_length + 1) * Calendar.day_length in
    if n < first + Calendar.day_length then n else first + remainder n
