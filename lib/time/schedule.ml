type link = { pending : Timed.pending; from : int; until : int; lasts : int }
type t = { dates : int array; chain : link list }

(* That the date of step [later] is at most [by] after that of step [sooner]; [by] may be negative. *)
type constraint_ = { sooner : int; later : int; by : int; due_to : Timed.pending option }

let find item (s : Timed.state) = List.find_opt (fun (p : Timed.pending) -> p.item = item) s.pending

(* The constraints of step [k], taken from [s], where [begun] says with which step each item began. *)
let constraints options k (s : Timed.state) begun (step : Timed.step) =
  let at_most item most =
    { sooner = List.assoc item begun; later = k; by = most; due_to = find item s } in
  let at_least item least =
    { sooner = k; later = List.assoc item begun; by = -least; due_to = find item s } in
  let order = { sooner = k; later = k - 1; by = 0; due_to = None } in
  if step.urgent then [ order; { sooner = k - 1; later = k; by = 0; due_to = None } ]
  else
    let due =
      match step.due with
      | Some (item, Within { least; most }) -> [ at_least item least; at_most item most ]
      | Some (_, (Some_time | Never)) | None -> []
    in
    (order :: due) @ List.map (fun (item, most) -> at_most item most) (Timed.holds_up (Timed.steps options s))

let all options start steps =
  let add (k, s, begun, found) (step : Timed.step) =
    let found = constraints options k s begun step @ found in
    let still (p : Timed.pending) =
      (p.item, if List.mem p.item step.fresh then k else List.assoc p.item begun)
    in
    (k + 1, step.next, List.map still step.next.pending, found)
  in
  let begun = List.map (fun (p : Timed.pending) -> (p.item, 0)) start.Timed.pending in
  let _, _, _, found = List.fold_left add (1, start, begun, []) steps in
  found

(* Shortest ways from 0 by [constraints], each with the last constraint of one (Bellman and Ford). The run exists, so no
   way around is negative. *)
let shortest n constraints =
  let distance = Array.make (n + 1) max_int and last = Array.make (n + 1) None in
  distance.(0) <- 0;
  let rec go () =
    let relax changed c =
      if distance.(c.sooner) <> max_int && distance.(c.sooner) + c.by < distance.(c.later) then begin
        distance.(c.later) <- distance.(c.sooner) + c.by;
        last.(c.later) <- Some c;
        true
      end
      else changed
    in
    if List.fold_left relax false constraints then go ()
  in
  go ();
  (distance, last)

let chain last n =
  let rec back links k =
    match last.(k) with
    | None -> links
    | Some { sooner; by; due_to = Some pending; later } when by > 0 ->
      back ({ pending; from = sooner; until = later; lasts = by } :: links) sooner
    | Some { sooner; _ } -> back links sooner
  in
  back [] n

let make (goal : Timed_system.goal) options start steps =
  let n = List.length steps in
  let constraints = List.rev (all options start steps) in
  match goal with
  | Latest ->
    let distance, last = shortest n constraints in
    if Array.exists (fun d -> d = max_int) distance then None
    else Some { dates = Array.sub distance 1 n; chain = chain last n }
  | Earliest ->
    (* Backwards in time. *)
    let turned = List.map (fun c -> { c with sooner = c.later; later = c.sooner }) constraints in
    let distance, _ = shortest n turned in
    Some { dates = Array.init n (fun i -> -distance.(i + 1)); chain = [] }
