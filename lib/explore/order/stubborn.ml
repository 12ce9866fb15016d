open Step_footprints

type landing = { level : int; gone : bool }
type status = Impossible | Moves of landing | Ends | Depends of { moves : landing list; ends : bool }
type component = { place : Layout.place; analysis : Step_footprints.t }
type t = { components : component array; status : int -> int -> status }

let landings t x k =
  match t.status x k with Moves landing -> [ landing ] | Depends { moves; _ } -> moves | Impossible | Ends -> []

let moves t x k = landings t x k <> []
let surely_moves t x k = match t.status x k with Moves _ -> true | Impossible | Ends | Depends _ -> false
let may_end t x k = match t.status x k with Ends -> true | Depends { ends; _ } -> ends | Impossible | Moves _ -> false

let exists_step t x p =
  let rec from k = k < Array.length t.components.(x).analysis.footprints && (p k || from (k + 1)) in
  from 0

(* {1 Where components stand} *)

let is_nest (place : Layout.place) = place.inside <> None
let contains (nest : Layout.place) (place : Layout.place) = nest.from <= place.from && place.upto <= nest.upto

(* The nests around [y] that [x] is not in. *)
let apart y x =
  let rec count n (place : Layout.place) =
    match place.around with Some nest when not (contains nest x) -> count (n + 1) nest | Some _ | None -> n
  in
  count 0 y

(* All that [y] may do before [x] takes a step, and what follows then as far as that does not wait for [x]. *)
let future t y x =
  let c = t.components.(y) in
  c.analysis.futures.(apart c.place t.components.(x).place)

(* Whether what stands at [place] is cut off when a step of the component at [own] lands there. *)
let is_cut_off own place { level; _ } = (level > 0 || is_nest own) && contains (Layout.above own level) place

(* Whether a step of [y] may ever cut off [x]. *)
let may_cut_off t y x =
  let { place; analysis } = t.components.(y) and x = t.components.(x).place in
  let rec by_error n (at : Layout.place) =
    match at.around with
    | None -> false
    | Some nest -> (contains nest x && analysis.kills.(n)) || by_error (n + 1) nest
  in
  (is_nest place && contains place x) || by_error 1 place

(* {1 What must be taken along} *)

(* What may be done to a step, or by it. One that ends the run now ends it whatever others do: see below. *)
let touches t x k =
  let { ends; footprints; _ } = t.components.(x).analysis in
  let is_end = ends.(k) && match t.status x k with Ends -> true | Impossible | Moves _ | Depends _ -> false in
  if is_end then Footprint.empty else footprints.(k)

let conflict t x y =
  let f = future t y x in
  let clash k =
    let own = touches t x k in
    (not (Footprint.is_free own)) && Footprint.conflict ~possible:(surely_moves t x k) own f
  in
  (not (Footprint.is_free f)) && exists_step t x clash

(* A step of [x] would cut off [y], which may leave traces before. *)
let cuts_off t x y =
  let cut k = List.exists (is_cut_off t.components.(x).place t.components.(y).place) (landings t x k) in
  exists_step t x cut && not (Footprint.is_traceless (future t y x))

(* {1 Keys}

   Of the steps that are taken, one must be such that whatever others do, it can come first. *)

(* Whether it would cut off [y], or [y] might cut it off and leave a trace of it in the wrong place, or the nest of [y]
   might be over before it cuts what it cuts now. *)
let is_in_the_way t x k y =
  let own = t.components.(x) and other = t.components.(y) in
  let f = own.analysis.footprints.(k) in
  let is_idle_cut (f : Footprint.t) = Footprint.is_traceless f && (not f.breaks) && not f.halts in
  let ends_nest { level; gone } =
    let place = Layout.above own.place level in
    gone && is_nest other.place && other.place != place && contains other.place place
  in
  let landings = landings t x k in
  List.exists (is_cut_off own.place other.place) landings
  || ((not (Footprint.is_traceless f)) && may_cut_off t y x)
  || (List.exists ends_nest landings && not (Array.for_all is_idle_cut other.analysis.footprints))

(* The key of [x] that most others leave alone, with those that do not. Failures elsewhere may use up the ones that a
   failure needs; but the success of the same task comes before it, and is no worse. *)
let key t x =
  let best = ref None in
  let others k =
    List.filter (fun y -> y <> x && is_in_the_way t x k y) (List.init (Array.length t.components) Fun.id)
  in
  let try_step k =
    if moves t x k then
      let others = others k in
      match !best with
      | Some best when List.compare_lengths best others <= 0 -> ()
      | Some _ | None -> best := Some others
  in
  Array.iteri (fun k _ -> try_step k) t.components.(x).analysis.footprints;
  !best

(* {1 Sets} *)

(* All that must be taken along with a key of [seed], if it has one. *)
let closure t seed =
  let along others =
    let n = Array.length t.components in
    let taken = Array.make n false and todo = Stack.create () in
    let take i =
      if not taken.(i) then begin
        taken.(i) <- true;
        Stack.push i todo
      end
    in
    List.iter take (seed :: others);
    while not (Stack.is_empty todo) do
      let x = Stack.pop todo in
      for y = 0 to n - 1 do
        if (not taken.(y)) && (conflict t x y || cuts_off t x y) then take y
      done
    done;
    taken
  in
  Option.map along (key t seed)

(* Whether a step that would end the run here would perhaps not do so later. Those that do whatever is shared are
   outcomes: they are noted here, and nothing follows them. *)
let some_end_depends t =
  let depends x k =
    let { footprints; ends; _ } = t.components.(x).analysis in
    ends.(k) && (not (Footprint.is_blind footprints.(k))) && may_end t x k
  in
  let rec from x = x < Array.length t.components && (exists_step t x (depends x) || from (x + 1)) in
  from 0

(* Nothing that others do has to do with such a component, unless it is cut off. *)
let is_free t x = Array.for_all Footprint.is_free t.components.(x).analysis.footprints

let size t taken =
  let n = ref 0 in
  let count x k = if taken.(x) && moves t x k then incr n in
  Array.iteri (fun x c -> Array.iteri (fun k _ -> count x k) c.analysis.footprints) t.components;
  !n

let is_alone taken = Array.fold_left (fun n is -> if is then n + 1 else n) 0 taken = 1

let free t =
  let n = Array.length t.components in
  let rec from x =
    if x = n then None
    else
      match if is_free t x then closure t x else None with
      | Some taken when is_alone taken -> Some taken
      | Some _ | None -> from (x + 1)
  in
  from 0

(* A branch of an [allOf] that may as well run first, if its guard holds, nothing beside it touches what it does, and
   nothing cuts it off. *)
let branch_first t =
  let n = Array.length t.components in
  let others x p =
    let rec from y = y = n || ((y = x || p y) && from (y + 1)) in
    from 0
  in
  let fits x k f =
    surely_moves t x k
    && (not (Array.exists Fun.id t.components.(x).analysis.kills))
    && others x (fun y -> (not (Footprint.conflict ~possible:true f (future t y x))) && not (may_cut_off t y x))
  in
  let rec from x k =
    if x = n then None
    else if k = Array.length t.components.(x).analysis.alone then from (x + 1) 0
    else
      match t.components.(x).analysis.alone.(k) with
      | Some f when fits x k f -> Some (x, k)
      | Some _ | None -> from x (k + 1)
  in
  from 0 0

(* More seeds cost more than they gain. *)
let most_seeds = 16

let smallest t =
  let best = ref None and seeds = ref 0 in
  let try_seed x _ =
    let is_best = match !best with Some (n, _) -> n = 1 | None -> false in
    if (not is_best) && !seeds < most_seeds then
      match closure t x with
      | None -> ()
      | Some taken -> (
          incr seeds;
          let n = size t taken in
          match !best with
          | Some (least, _) when least <= n -> ()
          | Some _ | None -> best := Some (n, taken))
  in
  Array.iteri try_seed t.components;
  Option.map snd !best

let choose components status =
  let t = { components; status } in
  if some_end_depends t then None
  else
    match free t with
    | Some taken -> Some (fun x _ -> taken.(x))
    | None -> (
        match branch_first t with
        | Some (x, k) -> Some (fun x' k' -> x' = x && k' = k)
        | None -> Option.map (fun taken x _ -> taken.(x)) (smallest t))
