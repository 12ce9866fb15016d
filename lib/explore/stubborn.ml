open Components

type status = Impossible | Moves | Ends | Depends of { moves : bool; ends : bool }

let may_move = function Moves | Depends { moves = true; _ } -> true | Impossible | Ends | Depends _ -> false
let may_end = function Ends | Depends { ends = true; _ } -> true | Impossible | Moves | Depends _ -> false

(* A component of the configuration: of the part at this position. *)
type place = { position : int; component : component }

(* Whether a step that would end the run here would perhaps not do so later. Those that do whatever is shared are
   outcomes: they are noted here, and nothing follows them. *)
let some_end_depends parts status =
  let depends position part k (f : Footprint.t) =
    part.ends.(k) && (not (Footprint.is_blind f)) && may_end (status position k)
  in
  let found = ref false in
  let look position part =
    Array.iteri (fun k f -> if (not !found) && depends position part k f then found := true) part.footprints
  in
  Array.iteri look parts;
  !found

let moves status place k = may_move (status place.position k)
let surely_moves status place k = status place.position k = Moves

(* Nothing that others do has to do with such a component. *)
let is_free parts place =
  let part = parts.(place.position) in
  Array.for_all (fun k -> Footprint.is_free part.footprints.(k)) place.component.steps

(* What may be done to the step, or by it. One that ends the run now ends it whatever others do: see above. *)
let touches parts status place k =
  let part = parts.(place.position) in
  match if part.ends.(k) then status place.position k else Moves with
  | Ends -> Footprint.empty
  | Impossible | Moves | Depends _ -> part.footprints.(k)

let conflicts parts status place f =
  let clash k =
    let own = touches parts status place k in
    (not (Footprint.is_free own)) && Footprint.conflict ~possible:(surely_moves status place k) own f
  in
  Array.exists clash place.component.steps

(* A branch of an [allOf] that may as well run first, if its guard holds and nothing beside it touches what it does. *)
let branch_first parts status place =
  let part = parts.(place.position) in
  let clash f f' = Footprint.conflict ~possible:true f f' in
  let fits i k =
    place.component.alone.(i)
    && surely_moves status place k
    &&
    let f = part.branches.(k) in
    (not (clash f place.component.beside))
    &&
    let beside = ref false in
    Array.iteri (fun j other -> if j <> place.position && clash f other.future then beside := true) parts;
    not !beside
  in
  let rec from i =
    if i = Array.length place.component.steps then None
    else
      let k = place.component.steps.(i) in
      if fits i k then Some k else from (i + 1)
  in
  from 0

(* All that must be taken along with [seed]: every part, or every component of the same part, that may ever do something
   that conflicts with what is taken. *)
let closure parts status places seed =
  let n = Array.length places in
  let taken = Array.make n false and todo = Stack.create () in
  let take i =
    if not taken.(i) then begin
      taken.(i) <- true;
      Stack.push i todo
    end
  in
  take seed;
  while not (Stack.is_empty todo) do
    let place = places.(Stack.pop todo) in
    let together = Hashtbl.create 4 in
    if conflicts parts status place place.component.beside then Hashtbl.replace together place.position ();
    let other position part =
      if position <> place.position && conflicts parts status place part.future then
        Hashtbl.replace together position ()
    in
    Array.iteri other parts;
    if Hashtbl.length together > 0 then
      Array.iteri (fun i place -> if Hashtbl.mem together place.position then take i) places
  done;
  taken

let count_moves status place =
  Array.fold_left (fun n k -> if moves status place k then n + 1 else n) 0 place.component.steps

(* More seeds cost more than they gain. *)
let most_seeds = 16

let smallest parts status places =
  let size taken =
    let n = ref 0 in
    Array.iteri (fun i place -> if taken.(i) then n := !n + count_moves status place) places;
    !n
  in
  let best = ref None and seeds = ref 0 in
  let try_seed i place =
    let is_best = match !best with Some (n, _) -> n = 1 | None -> false in
    if (not is_best) && !seeds < most_seeds && count_moves status place > 0 then begin
      incr seeds;
      let taken = closure parts status places i in
      let n = size taken in
      match !best with
      | Some (least, _) when least <= n -> ()
      | Some _ | None -> best := Some (n, taken)
    end
  in
  Array.iteri try_seed places;
  Option.map snd !best

let place_of parts =
  let of_part position part =
    Array.map (fun component -> { position; component }) part.components
  in
  Array.concat (Array.to_list (Array.mapi of_part parts))

let find_first p xs =
  let rec from i = if i = Array.length xs then None else if p xs.(i) then Some xs.(i) else from (i + 1) in
  from 0

let choose parts status =
  if some_end_depends parts status then None
  else
    let places = place_of parts in
    let is_step_of place position k =
      place.position = position && Array.exists (fun k' -> k' = k) place.component.steps
    in
    match find_first (fun place -> is_free parts place && count_moves status place > 0) places with
    | Some place -> Some (is_step_of place)
    | None -> (
        let first place = Option.map (fun k -> (place.position, k)) (branch_first parts status place) in
        let found = Array.fold_left (fun found place -> if found = None then first place else found) None places in
        match found with
        | Some (position, k) -> Some (fun position' k' -> position' = position && k' = k)
        | None ->
          let chosen taken position k =
            let is_chosen = ref false in
            Array.iteri (fun i place -> if taken.(i) && is_step_of place position k then is_chosen := true) places;
            !is_chosen
          in
          Option.map chosen (smallest parts status places))
