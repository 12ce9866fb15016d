open Step_footprints

type move = { level : int; over : bool; closes : bool; on_event : bool }
type status = Impossible | Moves of move | Ends | Depends of { moves : move list; ends : bool }
type component = { place : Layout.place; analysis : Step_footprints.t }
type t = {
  components : component array;
  posts : Footprint.t;  (* of all that may come from outside *)
  status : int -> int -> status;
}

let moves_of t x k =
  match t.status x k with Moves move -> [ move ] | Depends { moves; _ } -> moves | Impossible | Ends -> []

let may_move t x k = moves_of t x k <> []
let surely_moves t x k = match t.status x k with Moves _ -> true | Impossible | Ends | Depends _ -> false
let may_end t x k = match t.status x k with Ends -> true | Depends { ends; _ } -> ends | Impossible | Moves _ -> false

let exists_step t x p =
  let rec from k = k < Array.length t.components.(x).analysis.footprints && (p k || from (k + 1)) in
  from 0

(* {1 Where components stand} *)

let is_nest (place : Layout.place) = place.inside <> None
let contains (nest : Layout.place) (place : Layout.place) = nest.from <= place.from && place.upto <= nest.upto

(* How many nests around [y] do not contain [x]. *)
let apart y x =
  let rec count n (place : Layout.place) =
    match place.around with Some nest when not (contains nest x) -> count (n + 1) nest | Some _ | None -> n
  in
  count 0 y

(* All that [y] may do before [x] takes a step, and the steps after that which do not wait for [x]. *)
let future t y x =
  let c = t.components.(y) in
  c.analysis.futures.(apart c.place t.components.(x).place)

(* Whether a step of the component at [own] that moves so cuts off what stands at [place]. *)
let is_cut_off own place ({ level; _ } : move) = (level > 0 || is_nest own) && contains (Layout.above own level) place

(* Whether a step of [y] may ever cut off [x]. *)
let may_cut_off t y x =
  let { place; analysis } = t.components.(y) and x = t.components.(x).place in
  let rec by_error n (at : Layout.place) =
    match at.around with
    | None -> false
    | Some nest -> (contains nest x && analysis.cut_by_error.(n)) || by_error (n + 1) nest
  in
  (is_nest place && contains place x) || by_error 1 place

(* {1 Dependence} *)

(* The footprint of a step, as far as others depend on it. A step that ends the run now is followed in any case. *)
let touches t x k =
  let { ends; footprints; _ } = t.components.(x).analysis in
  let is_end = ends.(k) && match t.status x k with Ends -> true | Impossible | Moves _ | Depends _ -> false in
  if is_end then Footprint.empty else footprints.(k)

let conflict t x y =
  let f = future t y x in
  let clash k =
    let own = touches t x k in
    (not (Footprint.touches_nothing own)) && Footprint.conflict ~possible:(surely_moves t x k) own f
  in
  (not (Footprint.touches_nothing f)) && exists_step t x clash

(* Whether an input may make a difference to a step of [x]. *)
let meets_inputs t x =
  let clash k = Footprint.conflict ~possible:(surely_moves t x k) (touches t x k) t.posts in
  (not (Footprint.touches_nothing t.posts)) && exists_step t x clash

(* Whether a step of [x] would cut off [y], which may leave a trace before. *)
let cuts_off t x y =
  let cut k = List.exists (is_cut_off t.components.(x).place t.components.(y).place) (moves_of t x k) in
  exists_step t x cut && not (Footprint.leaves_no_trace (future t y x))

(* {1 Keys}

   One of the steps that are taken must be possible first, whatever others do. *)

(* Whether the key would cut off [y]; or [y] may cut it off, and its trace would be in the wrong place; or the nest of
   [y] may be over before it cuts what it cuts now. *)
let is_in_the_way t x k y =
  let own = t.components.(x) and other = t.components.(y) in
  let f = own.analysis.footprints.(k) in
  let is_idle_cut (f : Footprint.t) = Footprint.leaves_no_trace f && (not f.breaks) && not f.halts in
  let ends_nest { level; over; _ } =
    let place = Layout.above own.place level in
    over && is_nest other.place && other.place != place && contains other.place place
  in
  let moves = moves_of t x k in
  List.exists (is_cut_off own.place other.place) moves
  || ((not (Footprint.leaves_no_trace f)) && may_cut_off t y x)
  || (List.exists ends_nest moves && not (Array.for_all is_idle_cut other.analysis.footprints))

(* The key of [x] with the fewest components in its way, as these. Failures elsewhere may use up the number of
   failures that this one needs; but the success of the same task comes before it, and is no worse. *)
let key t x =
  let best = ref None in
  let others k =
    List.filter (fun y -> y <> x && is_in_the_way t x k y) (List.init (Array.length t.components) Fun.id)
  in
  let try_step k =
    if may_move t x k && not t.components.(x).analysis.put_off.(k) then
      let others = others k in
      match !best with
      | Some best when List.compare_lengths best others <= 0 -> ()
      | Some _ | None -> best := Some others
  in
  Array.iteri (fun k _ -> try_step k) t.components.(x).analysis.footprints;
  !best

(* {1 Sets} *)

let exists_taken p taken =
  let rec from x = x < Array.length taken && ((taken.(x) && p x) || from (x + 1)) in
  from 0

(* The smallest set that has a key of [seed] and all that it depends on, if [seed] has a key. It is [None] if it
   would depend on inputs. *)
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
  match Option.map along (key t seed) with
  | Some taken when exists_taken (meets_inputs t) taken -> None
  | found -> found

(* Whether some step would end the run here, and perhaps not later. Those that end it whatever is shared are outcomes:
   nothing follows them. *)
let some_end_depends t =
  let depends x k =
    let { footprints; ends; _ } = t.components.(x).analysis in
    ends.(k) && (not (Footprint.reads_nothing footprints.(k))) && may_end t x k
  in
  let rec from x = x < Array.length t.components && (exists_step t x (depends x) || from (x + 1)) in
  from 0

(* Whether some step of [x] may close a cycle here. *)
let may_close t x = exists_step t x (fun k -> List.exists (fun { closes; _ } -> closes) (moves_of t x k))

(* Whether endless rounds start the part at [place] again, also through other components' steps. *)
let rec is_renewed (place : Layout.place) =
  match place.around with
  | Some ({ inside = Some { renews; _ }; _ } as nest) -> renews || is_renewed nest
  | Some ({ inside = None; _ } as nest) -> is_renewed nest
  | None -> false

let moves_on_event t x = exists_step t x (fun k -> List.exists (fun { on_event; _ } -> on_event) (moves_of t x k))
let moves_by_itself t x = exists_step t x (fun k -> List.exists (fun m -> not m.on_event) (moves_of t x k))

(* Whether events would be taken again and again, and a run without any would not be found. *)
let hides_spin t taken =
  exists_taken (fun x -> is_renewed t.components.(x).place && moves_on_event t x) taken
  && exists_taken (moves_by_itself t) (Array.map (fun _ -> true) taken)

(* A set that may close a cycle is not enough: steps outside it could be put off without end. *)
let is_open t taken = not (exists_taken (may_close t) taken || hides_spin t taken)

(* Such a component depends on no other, unless it is cut off. *)
let is_independent t x = Array.for_all Footprint.touches_nothing t.components.(x).analysis.footprints

let size t taken =
  let n = ref 0 in
  let count x k = if taken.(x) && may_move t x k then incr n in
  Array.iteri (fun x c -> Array.iteri (fun k _ -> count x k) c.analysis.footprints) t.components;
  !n

let is_single taken = Array.fold_left (fun n is -> if is then n + 1 else n) 0 taken = 1

let independent t =
  let n = Array.length t.components in
  let rec from x =
    if x = n then None
    else
      match if is_independent t x then closure t x else None with
      | Some taken when is_single taken && is_open t taken -> Some taken
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
    && (not (Array.exists Fun.id t.components.(x).analysis.cut_by_error))
    && (not (Footprint.conflict ~possible:true f t.posts))
    && others x (fun y -> (not (Footprint.conflict ~possible:true f (future t y x))) && not (may_cut_off t y x))
  in
  let rec from x k =
    if x = n then None
    else if k = Array.length t.components.(x).analysis.runs_first then from (x + 1) 0
    else
      match t.components.(x).analysis.runs_first.(k) with
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
    if (not is_best) && !seeds < most_seeds && not (may_close t x) then
      match closure t x with
      | Some taken when not (is_open t taken) -> incr seeds
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

let choose components ~posts status =
  let t = { components; posts; status } in
  if some_end_depends t then None
  else
    match independent t with
    | Some taken -> Some (fun x _ -> taken.(x))
    | None -> (
        match branch_first t with
        | Some (x, k) -> Some (fun x' k' -> x' = x && k' = k)
        | None -> Option.map (fun taken x _ -> taken.(x)) (smallest t))
