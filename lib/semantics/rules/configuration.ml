open Core

type ending = Completed | Halted of string | Failed of Fault.t | Interrupted

type control =
  | Script of Machine.t
  | Waiting of Machine.t * Code.request
  | Executing of Machine.t * Residual.t
  | Ended of ending

type t = { control : control; shared : Shared.t }

let site c =
  match c.control with
  | Script m | Waiting (m, _) | Executing (m, _) -> Machine.site m
  | Ended _ -> Fault.unknown_site

let waits c =
  match c.control with
  | Executing (_, r) -> Residual.waits r
  | Waiting (_, (Pick _ | Pause _)) -> [ (Residual.script_timer, Residual.Time 0.) ]
  | Waiting (_, (Ask _ | Execute _ | Host_call _)) | Script _ | Ended _ -> []

let recruits c =
  match c.control with Executing (_, r) -> Residual.recruits r | Waiting _ | Script _ | Ended _ -> []

let initial program =
  { control = Script (Machine.call { lambda = program.main; captured = [||] } []); shared = Shared.initial program }

let rank = function Script _ -> 0 | Waiting _ -> 1 | Executing _ -> 2 | Ended _ -> 3

let compare_ending a b =
  match a, b with
  | Halted m, Halted m' -> String.compare m m'
  | Failed f, Failed f' -> Order.both (String.compare f.message f'.message) (fun () -> Int.compare f.site f'.site)
  | (Completed | Halted _ | Failed _ | Interrupted), _ ->
    let rank = function Completed -> 0 | Halted _ -> 1 | Failed _ -> 2 | Interrupted -> 3 in
    Int.compare (rank a) (rank b)

let compare_control a b =
  match a, b with
  | Script m, Script m' -> Machine.compare m m'
  | Waiting (m, r), Waiting (m', r') ->
    Order.both (Machine.compare_request r r') (fun () -> Machine.compare m m')
  | Executing (m, r), Executing (m', r') -> Order.both (Residual.compare r r') (fun () -> Machine.compare m m')
  | Ended e, Ended e' -> compare_ending e e'
  | (Script _ | Waiting _ | Executing _ | Ended _), _ -> Int.compare (rank a) (rank b)

let compare c c' =
  if c == c' then 0
  else Order.both (compare_control c.control c'.control) (fun () -> Shared.compare c.shared c'.shared)

let equal c c' = compare c c' = 0

let hash c =
  let control =
    match c.control with
    | Script m -> Order.mix 1 (Machine.hash m)
    | Waiting (m, _) -> Order.mix 2 (Machine.hash m)
    | Executing (m, r) -> Order.mix (Order.mix 3 (Machine.hash m)) (Residual.hash r)
    | Ended _ -> 4
  in
  Order.mix control (Shared.hash c.shared) land max_int

let pp_ending program ppf = function
  | Completed -> Format.pp_print_string ppf "completed"
  | Interrupted -> Format.pp_print_string ppf "interrupted"
  | Halted message -> Format.fprintf ppf "halted %a" Value.pp (String message)
  | Failed fault -> (
      match Fault.location program fault with
      | Some at -> Format.fprintf ppf "failed at %a: %s" Dolphin_syntax.Location.pp at fault.message
      | None -> Format.fprintf ppf "failed: %s" fault.message)

let pp program ppf c =
  let at m = match Fault.location program (Fault.make (Machine.site m) "") with
    | Some at -> Format.asprintf "%a" Dolphin_syntax.Location.pp at
    | None -> "?"
  in
  (match c.control with
   | Script m -> Format.fprintf ppf "script at %s" (at m)
   | Waiting (m, _) -> Format.fprintf ppf "waiting at %s" (at m)
   | Executing (m, r) -> Format.fprintf ppf "executing at %s: %a" (at m) Residual.pp r
   | Ended e -> pp_ending program ppf e);
  Format.fprintf ppf "; %a" (Shared.pp program) c.shared

(* Whether no vehicle is named twice in parallel parts. *)
let rec are_apart (r : Residual.t) =
  let apart_here =
    match r with
    | Parallel bs ->
      let names = List.concat_map Residual.named (Branches.to_list bs) in
      List.length (List.sort_uniq String.compare names) = List.length names
    | _ -> true
  in
  apart_here && List.for_all are_apart (Residual.parts r)

let is_apart c = match c.control with Executing (_, r) -> are_apart r | Script _ | Waiting _ | Ended _ -> true

let has_ended c = match c.control with Ended _ -> true | Script _ | Waiting _ | Executing _ -> false

let invariant c =
  let running = match c.control with Executing (_, r) -> Residual.running r | Script _ | Waiting _ | Ended _ -> [] in
  let allocated = List.map fst (Vehicle_map.bindings c.shared.allocation) in
  let recruits = recruits c in
  let is_bound v = List.mem v c.shared.bound || List.mem v recruits in
  if not (List.for_all is_bound allocated) then Error "A has a vehicle that is not in B"
  else if List.length (List.sort_uniq String.compare running) <> List.length running then
    Error "a vehicle runs two tasks"
  else if not (is_apart c) then Error "two tasks side by side hold one vehicle"
  else if List.length (List.sort_uniq String.compare recruits) <> List.length recruits then
    Error "a vehicle was recruited twice"
  else if List.exists (fun v -> List.mem v c.shared.bound) recruits then Error "a recruited vehicle is in B"
  else if List.sort String.compare running <> allocated then Error "A is not what the control runs"
  else if has_ended c && c.shared.bound <> [] then Error "B is not empty after the end"
  else Ok ()
