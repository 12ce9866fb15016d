type reduction = Nothing | Inert_ends | Inert_ends_and_canonical_states

type successor = {
  step : Clocked.step;
  inert : Inert.item list Lazy.t;
  spelled : Canonical_state.execution -> Canonical_state.spelled;
}

type t = {
  options : Clocked.options;
  course : Course.t option;
  ends : Inert.t option;
  likeness : Canonical_state.t option;
  unread : string list;  (* keys *)
  known : successor list Clocked.Table.t;
  mutable tick : unit -> unit;
}

let create ?course reduction (options : Clocked.options) =
  let apart = Option.map Course.vehicle course in
  { options; course; known = Clocked.Table.create 1_000; tick = ignore;
    unread = Unread_pairs.keys options.program;
    ends = (if reduction = Nothing then None else Some (Inert.create options));
    likeness =
      (if reduction = Inert_ends_and_canonical_states && not options.program.reads_now then
         Some (Canonical_state.create ?apart options)
       else None) }

let options t = t.options
let course t = t.course
let likeness t = t.likeness

(* The end of the vehicle that is observed is followed. *)
let inert t state =
  let is_observed (i : Inert.item) =
    match t.course with Some c -> i.awaited = Task (Course.vehicle c) | None -> false in
  match t.ends with
  | Some ends -> List.filter (fun i -> not (is_observed i)) (Inert.of_state ends state)
  | None -> []

let successor t (step : Clocked.step) =
  let step = { step with next = Clocked.without_pairs t.unread step.next } in
  let inert = lazy (inert t step.next) and known = ref [] in
  let spelled e =
    match List.assq_opt e !known with
    | Some spelled -> spelled
    | None ->
      t.tick ();
      let spelled = Canonical_state.spell (Option.get t.likeness) e (Lazy.force inert) step.next in
      known := (e, spelled) :: !known;
      spelled
  in
  { step; inert; spelled }

(* Of long searches, more would take more memory than what is asked again is worth. *)
let most = 10_000

let all t state =
  match Clocked.Table.find_opt t.known state with
  | Some successors -> successors
  | None ->
    let successors = List.map (successor t) (Clocked.all_steps ~tick:t.tick t.options state) in
    if Clocked.Table.length t.known < most then Clocked.Table.add t.known state successors;
    successors

let tick t () = t.tick ()

let ticking t tick f =
  t.tick <- tick;
  Fun.protect ~finally:(fun () -> t.tick <- ignore) f

let followed t state = Clocked.enough t.options (fun s -> s.step) (all t state)

let steps t state = List.map (fun s -> s.step) (followed t state)
