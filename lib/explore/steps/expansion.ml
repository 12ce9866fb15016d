open Dolphin_semantics
open Dolphin_environment
open Component

type arrival = { into : int; by : Task_group.permutation option; letter : int }

type t = {
  options : Environment.options;
  reduction : Reduction.t;
  program : Core.program;
  world : World.t;
  parts : Components.t;
  cases : Memoised_steps.t;
  words : Encoding.t;
  shapes : Layouts.t;
  mutable states : Dolphin_checker.States.t;
  mutable key : int array;  (* the state being expanded, changed in place for its successors and changed back *)
  mutable other : int array;  (* successors of another shape *)
  mutable transitions : int;
  broken : int array;  (* by rank in [Property.all]: the first state, or -1 *)
  script : Script_graph.t;
  mutable fresh : int -> int -> unit;  (* what is done with new states, by number and first word *)
  mutable gathering : bool;
  mutable gathered : arrival list;
  watch : Product.t option;
  mutable watched : int;  (* what the watch knows of the state being expanded *)
  mutable action : int;  (* of the step being taken, for the watch *)
  mutable shown : int;  (* the first state that shows a violation, or -1 *)
  task_groups : Task_groups.t option;
  quotient : Quotient.t;
  interrupted : (int, int * int) Hashtbl.t;  (* by number of what is shared: the end, and the action for the watch *)
  mutable canonical : int array;  (* a state's canonical form *)
  vehicles : Canonical_vehicles.t option;
  reserve : int -> unit;
}

let rank property =
  let rec from i = function
    | [] -> invalid_arg "Expansion.rank"
    | p :: rest -> if p = property then i else from (i + 1) rest
  in
  from 0 Property.all

(* {1 States} *)

let load t i =
  let key = Array.make (Dolphin_checker.States.words t.states) 0 in
  Dolphin_checker.States.load t.states i key;
  key

(* Everything in fields that are wide enough. *)
let repack t =
  let watched = match t.watch with None -> 0 | Some w -> Dolphin_ltl.Monitor.count (Product.monitor w) in
  let rewritten = Encoding.widened t.words ~watched in
  let words = Layouts.words t.shapes in
  t.states <- Dolphin_checker.States.rewrite t.states ~words rewritten;
  t.key <- Array.make words 0;
  t.other <- Array.make words 0;
  t.canonical <- Array.make words 0

let note_broken t property i =
  let rank = rank property in
  if t.broken.(rank) < 0 then t.broken.(rank) <- i

let broken t property =
  match t.broken.(rank property) with
  | -1 -> None
  | i -> Some i

let note_shown t i = if t.shown < 0 then t.shown <- i

let fresh t i word =
  (match t.watch with
   | Some w when Dolphin_ltl.Monitor.is_certain (Product.monitor w) (Layouts.watched t.shapes word) -> note_shown t i
   | Some _ | None -> ());
  if Layouts.number t.shapes word = 0 then
    Option.iter (fun property -> note_broken t property i) (Encoding.broken t.words (Layouts.shared t.shapes word))

let flush t = Dolphin_checker.States.flush t.states ~fresh:t.fresh

let put t key by letter parent =
  if t.gathering then t.gathered <- { into = Dolphin_checker.States.find t.states key; by; letter } :: t.gathered
  else Dolphin_checker.States.push t.states key ~parent ~fresh:t.fresh

let put_watched t w key by parent =
  let letter = Product.letter w t.words t.action key in
  let watched = Dolphin_ltl.Monitor.next (Product.monitor w) t.watched letter in
  if watched >= 0 then begin
    let word = key.(0) in
    key.(0) <- Layouts.watching t.shapes word watched;
    put t key by letter parent;
    key.(0) <- word
  end

let add t key by parent =
  match t.watch with
  | None -> put t key by 0 parent
  | Some w -> put_watched t w key by parent

let note_stays t i =
  let stays w = Dolphin_ltl.Monitor.stays (Product.monitor w) t.watched (Product.letter w t.words Valuation.nothing t.key) in
  if Option.fold ~none:false ~some:stays t.watch then note_shown t i

let visit t key parent =
  match Layouts.number t.shapes key.(0) with
  | 0 -> add t key None parent
  | number -> (
      let s = Layouts.shape t.shapes number in
      match s.frame.symmetry with
      | None -> add t key None parent
      | Some g ->
        let shared = Layouts.shared t.shapes key.(0) in
        let permutation = Quotient.canonical t.quotient g s key shared ~into:t.canonical in
        add t t.canonical (Some permutation) parent)

(* {1 Ends of tasks} *)

(* The number of the configuration that an outcome ends the executing in. *)
let concluded t (s : Layout.t) shared outcome =
  let { Surroundings.shared; outside } = Memoised_steps.Shareds.value (Memoised_steps.shareds t.cases) shared in
  Encoding.whole t.words [] (Local_step.next s.frame.machine outcome shared) outside

let over t (s : Layout.t) shared =
  let frame = s.frame in
  if shared >= Array.length frame.over then begin
    let longer = Array.make (max (shared + 1) (2 * Array.length frame.over)) (-1) in
    Array.blit frame.over 0 longer 0 (Array.length frame.over);
    frame.over <- longer
  end;
  if frame.over.(shared) < 0 then begin
    frame.over.(shared) <- concluded t s shared Over;
    Script_graph.follows t.script (-1 - frame.frame) frame.over.(shared)
  end;
  frame.over.(shared)

(* {1 Going to other states} *)

(* What stands at [place] gives way to [parts] (which may be none), with [shared] after the step. *)
let replace t (s : Layout.t) (s' : Layout.t) (place : Layout.place) (parts : part array) shared i =
  Encoding.check_fit t.words;
  let key = t.key and other = t.other in
  Array.fill other 0 (Array.length other) 0;
  other.(0) <- Layouts.first t.shapes s'.number shared;
  for j = 0 to place.from - 1 do
    Layout.put s' other j (Layout.local s key j)
  done;
  let more = Array.length parts in
  for j = 0 to more - 1 do
    Layout.put s' other (place.from + j) parts.(j).local
  done;
  for j = place.upto to Array.length s.families - 1 do
    Layout.put s' other (j - place.upto + place.from + more) (Layout.local s key j)
  done;
  visit t other i

let no_parts : part array = [||]

let finish t number permutation i =
  Encoding.write_whole t.words t.other number;
  add t t.other permutation i

(* The task is over: the script sees what is shared, so each state that this one stands for goes on by itself. *)
let all_over t (s : Layout.t) shared i =
  match s.frame.symmetry with
  | None -> finish t (over t s shared) None i
  | Some g ->
    let image (shared, permutation) = finish t (over t s shared) (Some permutation) i in
    List.iter image (Task_group.orbit_of_shared g shared)

let rec go t (s : Layout.t) (place : Layout.place) target shared i =
  match target, place.around with
  | Gone, None when place.from = 0 && place.upto = Array.length s.families -> all_over t s shared i
  | Gone, Some ({ children = [ a; b ]; _ } as nest) -> leave_alone t s nest (if a == place then b else a) shared i
  | Gone, (None | Some _) -> replace t s (Layouts.without t.shapes s place) place no_parts shared i
  | Becomes { serial; children; parts }, _ ->
    replace t s (Layouts.becoming t.shapes s place serial children) place parts shared i
  | (Stays _ | Ends _), _ -> invalid_arg "Expansion.go: no target elsewhere"

(* Only [other] is left in a nest, which is none then. *)
and leave_alone t s nest (other : Layout.place) shared i =
  match nest.inside, other.inside with
  | None, _ -> invalid_arg "Expansion.leave_alone: no nest"
  | Some _, None -> go t s nest (Components.alone t.parts (Encoding.part s t.key other.from)) shared i
  | Some inside, Some _ ->
    let r = Components.around inside (Encoding.residual s t.key other) in
    let children = Components.children t.parts (Components.outside inside) r in
    let parts = Array.of_list (List.concat_map Component.leaves children) in
    replace t s (Layouts.with_children t.shapes s nest children) nest parts shared i

let go_to t (s : Layout.t) (place : Layout.place) target shared shared' i =
  match target with
  | Stays local ->
    let position = place.from in
    let key = t.key and word = s.word.(position) in
    let moved = (local - Layout.local s key position) lsl s.shift.(position) in
    let shared_moved = Layouts.first t.shapes 0 (shared' - shared) in
    key.(word) <- key.(word) + moved;
    key.(0) <- key.(0) + shared_moved;
    visit t key i;
    key.(0) <- key.(0) - shared_moved;
    key.(word) <- key.(word) - moved
  | Gone | Becomes _ | Ends _ -> go t s place target shared' i

let ends_run (case : case) = match case.result with Ends _ -> true | Stays _ | Gone | Becomes _ -> false

let take_case t (s : Layout.t) place (case : case) shared i =
  t.action <- case.action;
  match case.result with
  | Ends ending ->
    if case.whole < 0 then case.whole <- concluded t s case.shared (Ends ending);
    finish t case.whole None i
  | (Stays _ | Gone | Becomes _) as target ->
    Encoding.check_fit t.words;
    go_to t s (Layout.above place case.level) target shared case.shared i

(* The results of these are how many transitions there are. *)
let go_by_case t (s : Layout.t) place step shared i =
  let case = Memoised_steps.case t.cases step shared in
  if not case.possible then 0
  else begin
    take_case t s place case shared i;
    List.iter (fun other -> take_case t s place other shared i) case.others;
    1 + List.length case.others
  end

let go_to_ends t (s : Layout.t) place step shared i =
  let case = Memoised_steps.case t.cases step shared in
  let ends = List.filter ends_run (case :: case.others) in
  List.iter (fun case -> take_case t s place case shared i) ends;
  List.length ends

let interrupt t s shared i =
  if not t.options.interruptions then 0
  else begin
    let number, action =
      match Hashtbl.find_opt t.interrupted shared with
      | Some known -> known
      | None ->
        let observed : Proposition.observed = { label = Interrupt; effects = []; ending = Some Interrupted } in
        let action w = Valuation.action_observed (Product.letters w) observed in
        let found = (concluded t s shared (Ends Interrupted), Option.fold ~none:Valuation.nothing ~some:action t.watch) in
        Hashtbl.add t.interrupted shared found;
        found
    in
    t.action <- action;
    finish t number None i;
    1
  end

(* {1 Beginning} *)

let create ?(reduction = Reduction.Whole) ?(symmetry = Symmetry.none) ?(asked = []) ?(compress = false)
    ?(reserve = ignore) ?watch options program world =
  let foreseen = if Reduction.by_order reduction then Some 0 else None in
  let parts = Components.create ?foreseen options program world in
  let observe = Option.map (fun w -> Valuation.action_of_local (Product.letters w)) watch in
  let cases = Memoised_steps.create ?observe parts in
  let shareds = Memoised_steps.shareds cases in
  let number = Memoised_steps.Shareds.number shareds and value = Memoised_steps.Shareds.value shareds in
  let task_groups = Task_groups.create options program symmetry { number; value } in
  let vehicles =
    if Vehicle_orbits.is_none symmetry.vehicles then None
    else Some (Canonical_vehicles.create options program ~asked world symmetry)
  in
  let find_symmetry = Option.map Task_groups.find task_groups
  and canonical = Option.map Canonical_vehicles.canonical vehicles in
  let words = Encoding.create ?find_symmetry ?canonical ?watched:(Option.map (fun _ -> 1) watch) parts cases in
  let t =
    {
      options;
      reduction;
      program;
      world;
      parts;
      cases;
      words;
      shapes = Encoding.shapes words;
      states = Dolphin_checker.States.create ~compress ~words:1;
      key = [| 0 |];
      other = [| 0 |];
      transitions = 0;
      broken = Array.make (List.length Property.all) (-1);
      script = Script_graph.create ();
      fresh = (fun _ _ -> ());
      gathering = false;
      gathered = [];
      watch;
      watched = Dolphin_ltl.Monitor.start;
      action = Valuation.nothing;
      shown = -1;
      task_groups;
      quotient = Quotient.create parts words;
      interrupted = Hashtbl.create 16;
      canonical = [| 0 |];
      vehicles;
      reserve;
    }
  in
  ignore (Encoding.write words t.key [] (Configuration.initial program) Environment.initial);
  t.fresh <- fresh t;
  visit t t.key 0;
  flush t;
  t
