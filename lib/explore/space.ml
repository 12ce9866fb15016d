open Dolphin_semantics
open Part

module Numbered = Hashtbl.Make (struct
    type t = int * int

    let equal (a, b) (a', b') = Int.equal a a' && Int.equal b b'
    let hash (a, b) = ((a * 65599) + b) * 65599 land max_int
  end)

type t = {
  options : Environment.options;
  reduction : Reduction.t;
  program : Core.program;
  world : World.t;
  parts : Parts.t;
  cases : Cases.t;
  words : Words.t;
  shapes : Shapes.t;
  mutable states : States.t;
  mutable key : int array;  (* the state being expanded, changed in place for its successors and changed back *)
  mutable other : int array;  (* successors of another shape *)
  mutable transitions : int;
  broken : int array;  (* by rank in [Property.all]: the first state, or -1 *)
  script : Script_graph.t;
  mutable fresh : int -> int -> unit;  (* what is done with new states, by number and first word *)
  mutable gathering : bool;
  mutable gathered : (int * Symmetry.permutation option) list;
  symmetry : Symmetry.finder option;
  kinds : int Numbered.t;  (* of parts, by symmetry, family and place there *)
  parts_of_kinds : part Numbered.t;  (* by symmetry and kind *)
  mutable folded : int array;  (* a state's canonical form *)
  reserve : int -> unit;
}

let rank property =
  let rec from i = function
    | [] -> invalid_arg "Space.rank"
    | p :: rest -> if p = property then i else from (i + 1) rest
  in
  from 0 Property.all

(* {1 States} *)

let load t i =
  let key = Array.make (States.words t.states) 0 in
  States.load t.states i key;
  key

let state t i = Words.read t.words (load t i)

let shared t i =
  let first = (load t i).(0) in
  if Shapes.number t.shapes first = 0 then -1 else Shapes.shared t.shapes first

(* Everything in fields that are wide enough. *)
let repack t =
  let rewritten = Words.widened t.words in
  let words = Shapes.words t.shapes in
  t.states <- States.rewrite t.states ~words rewritten;
  t.key <- Array.make words 0;
  t.other <- Array.make words 0;
  t.folded <- Array.make words 0

let note_broken t property i =
  let rank = rank property in
  if t.broken.(rank) < 0 then t.broken.(rank) <- i

let fresh t i word =
  if Shapes.number t.shapes word = 0 then
    Option.iter (fun property -> note_broken t property i) (Words.broken t.words (Shapes.shared t.shapes word))

let flush t = States.flush t.states ~fresh:t.fresh

let add t key permutation parent =
  if t.gathering then t.gathered <- (States.find t.states key, permutation) :: t.gathered
  else States.push t.states key ~parent ~fresh:t.fresh

(* {1 Symmetry} *)

let kind_of t g (part : part) =
  let key = ((Symmetry.number g lsl 31) lor part.family.number, part.local) in
  match Numbered.find_opt t.kinds key with
  | Some kind -> kind
  | None ->
    let kind = Symmetry.kind g part.residual in
    Numbered.add t.kinds key kind;
    kind

let coverage_of_label coverage = function
  | Alike.Task site -> Coverage.reach coverage site
  | Code id -> Coverage.reach_code coverage id

(* What a part of a state begins, those that the state stands for begin as well. *)
let reach_alike t g (part : part) =
  let reach label = List.iter (coverage_of_label (Parts.coverage t.parts)) (Symmetry.together g label) in
  let step (step : Residual.step) =
    match step.offer with
    | Start (p, _) -> reach (Alike.Task p.task_site)
    | Perform c | Check c | Measure c -> reach (Alike.Code c.lambda.id)
    | End_of _ | Expiry_of _ -> ()
  in
  Seq.iter step (Residual.steps part.residual)

let part_of_kind t g kind =
  let key = (Symmetry.number g, kind) in
  match Numbered.find_opt t.parts_of_kinds key with
  | Some part -> part
  | None -> (
      match Parts.children t.parts (Parts.root t.parts) (Symmetry.residual g kind) with
      | [ Leaf part ] ->
        reach_alike t g part;
        Numbered.add t.parts_of_kinds key part;
        part
      | _ -> invalid_arg "Space.part_of_kind: no part")

let kinds t g (s : Shape.t) key = Array.init (Array.length s.families) (fun i -> kind_of t g (Words.part s key i))

(* Few shapes are enough if parts stand in an order of their families. *)
let by_family (a : part) (b : part) =
  match Int.compare a.family.number b.family.number with 0 -> Int.compare a.local b.local | order -> order

let write_folded t frame g (state : Symmetry.state) =
  let parts = List.map (part_of_kind t g) (Array.to_list state.kinds) in
  let leaves = List.map (fun part -> Leaf part) (List.sort by_family parts) in
  Words.write_parts t.words t.folded frame leaves state.shared

let visit t key parent =
  match Shapes.number t.shapes key.(0) with
  | 0 -> add t key None parent
  | number -> (
      let s = Shapes.shape t.shapes number in
      match s.frame.symmetry with
      | None -> add t key None parent
      | Some g ->
        let state, permutation = Symmetry.canonical g (kinds t g s key) (Shapes.shared t.shapes key.(0)) in
        write_folded t s.frame g state;
        add t t.folded (Some permutation) parent)

(* {1 Where nothing executes} *)

let expand_whole t i number =
  let c, outside = Words.value t.words number in
  let choices = Environment.choices t.options t.program t.world outside c in
  let go ((next : Transition.t), outside) =
    Coverage.transition (Parts.coverage t.parts) c next;
    Script_graph.follows t.script number (Words.write t.words t.other next.rules next.next outside);
    visit t t.other i
  in
  List.iter go choices;
  (match c.control, choices with
   | Ended _, _ | _, _ :: _ -> ()
   | (Script _ | Waiting _ | Executing _), [] -> note_broken t No_deadlock i);
  List.length choices

(* The configuration that a local outcome ends the executing in, by the transition function. *)
let concluded t (s : Shape.t) shared (outcome : Transition.outcome) =
  let shared = Cases.Shareds.value (Cases.shareds t.cases) shared in
  let c = Shared.under (Executing (s.frame.machine, Parallel [])) shared in
  let local : Transition.local = { after = c; outcome; derivation = []; named = Silent; asked = [] } in
  let next = Transition.conclude c s.frame.machine local in
  Words.whole t.words next.rules next.next shared.outside

let over t (s : Shape.t) shared =
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
let replace t (s : Shape.t) (s' : Shape.t) (place : Shape.place) (parts : part array) shared i =
  Words.check_fit t.words;
  let key = t.key and other = t.other in
  Array.fill other 0 (Array.length other) 0;
  other.(0) <- Shapes.first t.shapes s'.number shared;
  for j = 0 to place.from - 1 do
    Shape.put s' other j (Shape.local s key j)
  done;
  let more = Array.length parts in
  for j = 0 to more - 1 do
    Shape.put s' other (place.from + j) parts.(j).local
  done;
  for j = place.upto to Array.length s.families - 1 do
    Shape.put s' other (j - place.upto + place.from + more) (Shape.local s key j)
  done;
  visit t other i

let no_parts : part array = [||]

let finish t number permutation i =
  Words.write_whole t.words t.other number;
  add t t.other permutation i

(* The task is over: the script sees what is shared, so each state that this one stands for goes on by itself. *)
let all_over t (s : Shape.t) shared i =
  match s.frame.symmetry with
  | None -> finish t (over t s shared) None i
  | Some g ->
    let image (shared, permutation) = finish t (over t s shared) (Some permutation) i in
    List.iter image (Symmetry.images g shared)

let rec go t (s : Shape.t) (place : Shape.place) target shared i =
  match target, place.around with
  | Gone, None when place.from = 0 && place.upto = Array.length s.families -> all_over t s shared i
  | Gone, Some ({ children = [ a; b ]; _ } as nest) -> leave_alone t s nest (if a == place then b else a) shared i
  | Gone, (None | Some _) -> replace t s (Shapes.without t.shapes s place) place no_parts shared i
  | Becomes { serial; children; parts }, _ ->
    replace t s (Shapes.becoming t.shapes s place serial children) place parts shared i
  | (Stays _ | Ends _), _ -> invalid_arg "Space.go: no target elsewhere"

(* Only [other] is left in a nest, which is none then. *)
and leave_alone t s nest (other : Shape.place) shared i =
  match nest.inside, other.inside with
  | None, _ -> invalid_arg "Space.leave_alone: no nest"
  | Some _, None -> go t s nest (Parts.alone t.parts (Words.part s t.key other.from)) shared i
  | Some inside, Some _ ->
    let r = Parts.around inside (Words.residual s t.key other) in
    let children = Parts.children t.parts (Parts.outside inside) r in
    let parts = Array.of_list (List.concat_map Part.leaves children) in
    replace t s (Shapes.with_children t.shapes s nest children) nest parts shared i

let go_to t (s : Shape.t) (place : Shape.place) target shared shared' i =
  match target with
  | Stays local ->
    let position = place.from in
    let key = t.key and word = s.word.(position) in
    let moved = (local - Shape.local s key position) lsl s.shift.(position) in
    let shared_moved = Shapes.first t.shapes 0 (shared' - shared) in
    key.(word) <- key.(word) + moved;
    key.(0) <- key.(0) + shared_moved;
    visit t key i;
    key.(0) <- key.(0) - shared_moved;
    key.(word) <- key.(word) - moved
  | Gone | Becomes _ | Ends _ -> go t s place target shared' i

let rec above (place : Shape.place) level =
  match place.around with
  | Some nest when level > 0 -> above nest (level - 1)
  | Some _ | None -> place

let ends_run (case : case) = match case.result with Ends _ -> true | Stays _ | Gone | Becomes _ -> false

let take_case t (s : Shape.t) place (case : case) shared i =
  match case.result with
  | Ends ending ->
    if case.whole < 0 then case.whole <- concluded t s case.shared (Ends ending);
    finish t case.whole None i
  | (Stays _ | Gone | Becomes _) as target ->
    Words.check_fit t.words;
    go_to t s (above place case.level) target shared case.shared i

(* The results of these are how many transitions there are. *)
let go_by_case t (s : Shape.t) place step shared i =
  let case = Cases.case t.cases step shared in
  if not case.possible then 0
  else begin
    take_case t s place case shared i;
    List.iter (fun other -> take_case t s place other shared i) case.others;
    1 + List.length case.others
  end

let go_to_ends t (s : Shape.t) place step shared i =
  let case = Cases.case t.cases step shared in
  let ends = List.filter ends_run (case :: case.others) in
  List.iter (fun case -> take_case t s place case shared i) ends;
  List.length ends

(* {1 All steps} *)

(* As constants of this module they cost nothing. *)
let unknown = Cases.unknown
let special = Cases.special

let take_all t (s : Shape.t) place steps shared i =
  let taken = ref 0 in
  for k = 0 to Array.length steps - 1 do
    let step = Array.unsafe_get steps k in
    let shared' =
      match step.dependence with
      | Free -> shared
      | By_case -> special
      | Guarded guard ->
        let known = if shared < Array.length guard.results then Array.unsafe_get guard.results shared else unknown in
        if known <> unknown then known
        else begin
          let result = Cases.guarded t.cases step guard shared in
          Words.check_fit t.words;
          result
        end
    in
    if shared' >= 0 then begin
      incr taken;
      go_to t s place step.target shared shared' i
    end
    else if shared' = special then taken := !taken + go_by_case t s place step shared i
  done;
  !taken

let part_at t (s : Shape.t) position =
  let part = Words.part s t.key position in
  if Array.length part.steps = 0 then begin
    Parts.reach t.parts part;
    Words.check_fit t.words
  end;
  part

let cuts t (nest : Shape.place) =
  match nest.inside with
  | None -> [||]
  | Some { cuts = Some cuts; _ } -> cuts
  | Some inside ->
    let cuts = Parts.cuts t.parts inside in
    Words.check_fit t.words;
    cuts

let expand_all t (s : Shape.t) shared i =
  let taken = ref 0 in
  for position = 0 to Array.length s.families - 1 do
    let part = part_at t s position in
    taken := !taken + take_all t s (Array.unsafe_get s.leaves position) part.steps shared i
  done;
  for n = 0 to Array.length s.nests - 1 do
    let nest = s.nests.(n) in
    taken := !taken + take_all t s nest (cuts t nest) shared i
  done;
  !taken

(* {1 Steps that are enough} *)

let local_status t step shared : Stubborn.status =
  let by_case () : Stubborn.status =
    match Cases.case t.cases step shared with
    | { possible = false; _ } -> Impossible
    | { certain = true; _ } as case -> if ends_run case then Ends else Moves
    | { certain = false; _ } as case ->
      let ends, moves = List.partition ends_run (case :: case.others) in
      Depends { moves = moves <> []; ends = ends <> [] }
  in
  match step.dependence with
  | Free -> Moves
  | By_case -> by_case ()
  | Guarded guard ->
    let result = Cases.guarded t.cases step guard shared in
    if result >= 0 then Moves else if result = special then by_case () else Impossible

let take_step t s place step shared i =
  match step.dependence with
  | Free -> go_to t s place step.target shared shared i; 1
  | Guarded guard when Cases.guarded t.cases step guard shared >= 0 ->
    go_to t s place step.target shared (Cases.guarded t.cases step guard shared) i;
    1
  | Guarded _ | By_case -> go_by_case t s place step shared i

(* As [expand_all]. Which steps are enough depends on nothing but the configuration. *)
let expand_some t (s : Shape.t) shared i =
  let parts = Array.init (Array.length s.families) (part_at t s) in
  let status position k = local_status t parts.(position).steps.(k) shared in
  let components = Array.map (Parts.components t.parts) parts in
  let choice = Stubborn.choose components status in
  let taken = ref 0 in
  let go position (part : part) =
    let take k step =
      let is_chosen = match choice with None -> true | Some chosen -> chosen position k in
      if is_chosen || components.(position).ends.(k) then begin
        let status = status position k in
        Words.check_fit t.words;
        match status with
        | Impossible -> ()
        | Moves when not is_chosen -> ()
        | Depends _ when not is_chosen -> taken := !taken + go_to_ends t s s.leaves.(position) step shared i
        | Moves | Ends | Depends _ -> taken := !taken + take_step t s s.leaves.(position) step shared i
      end
    in
    Array.iteri take part.steps
  in
  Array.iteri go parts;
  Words.check_fit t.words;
  !taken

(* {1 Expanding} *)

let expand_executing t i number =
  let s = Shapes.shape t.shapes number and shared = Shapes.shared t.shapes t.key.(0) in
  let taken =
    if Reduction.by_order t.reduction then expand_some t s shared i else expand_all t s shared i
  in
  if taken = 0 then note_broken t No_deadlock i;
  taken

let rec expand t i =
  match
    States.load t.states i t.key;
    let number = Shapes.number t.shapes t.key.(0) in
    if number = 0 then expand_whole t i (Shapes.shared t.shapes t.key.(0)) else expand_executing t i number
  with
  | taken -> if not t.gathering then t.transitions <- t.transitions + taken
  | exception Shapes.Outgrown ->
    flush t;
    (* Once this has begun it must not fail. *)
    t.reserve (States.bytes_to_rewrite t.states ~words:(States.words t.states + 1));
    repack t;
    expand t i

let steps t i =
  t.gathering <- true;
  t.gathered <- [];
  expand t i;
  t.gathering <- false;
  List.rev t.gathered

let successors t i = List.map fst (steps t i)

type view = Exact of Configuration.t * Environment.t | Up_to of Symmetry.t * Symmetry.state

let view t i =
  let key = load t i in
  let number = Shapes.number t.shapes key.(0) in
  let exact () =
    let c, outside = Words.read t.words key in
    Exact (c, outside)
  in
  if number = 0 then exact ()
  else
    let s = Shapes.shape t.shapes number in
    match s.frame.symmetry with
    | None -> exact ()
    | Some g ->
      let kinds = kinds t g s key in
      Array.sort Int.compare kinds;
      Up_to (g, { kinds; shared = Shapes.shared t.shapes key.(0) })

let folded t g (c : Configuration.t) outside : Symmetry.state option =
  match c.control with
  | Executing (_, r) ->
    let rs = match r with Parallel rs -> rs | r -> [ r ] in
    let shared = Cases.Shareds.number (Cases.shareds t.cases) (Shared.of_configuration c outside) in
    Some (Symmetry.state g rs shared)
  | Script _ | Waiting _ | Ended _ -> None

let breaks t i =
  let key = load t i in
  if Shapes.number t.shapes key.(0) > 0 then None else Words.broken t.words (Shapes.shared t.shapes key.(0))

let create ?(reduction = Reduction.Whole) ?(compress = false) ?(reserve = ignore) options program world =
  let foreseen = if Reduction.by_order reduction then Some 0 else None in
  let parts = Parts.create ?foreseen ~flat:(reduction <> Whole) options program world in
  let cases = Cases.create parts in
  let shareds = Cases.shareds cases in
  let symmetry =
    (* Where the outside remembers vehicles, they are not alike. *)
    if Reduction.by_symmetry reduction && not (Environment.endings_remember options) then
      let number = Cases.Shareds.number shareds and value = Cases.Shareds.value shareds in
      Some (Symmetry.finder options program { number; value })
    else None
  in
  let words = Words.create ?find_symmetry:(Option.map Symmetry.find symmetry) parts cases in
  let t =
    {
      options;
      reduction;
      program;
      world;
      parts;
      cases;
      words;
      shapes = Words.shapes words;
      states = States.create ~compress ~words:1;
      key = [| 0 |];
      other = [| 0 |];
      transitions = 0;
      broken = Array.make (List.length Property.all) (-1);
      script = Script_graph.create ();
      fresh = (fun _ _ -> ());
      gathering = false;
      gathered = [];
      symmetry;
      kinds = Numbered.create 64;
      parts_of_kinds = Numbered.create 64;
      folded = [| 0 |];
      reserve;
    }
  in
  ignore (Words.write words t.key [] (Configuration.initial program) Environment.initial);
  t.fresh <- fresh t;
  visit t t.key 0;
  flush t;
  t

(* {1 Findings} *)

let count t = States.count t.states
let transitions t = t.transitions
let parent t i = States.parent t.states i
let used_symmetry t = Option.fold ~none:false ~some:Symmetry.is_used t.symmetry

(* Handlers of errors are noted when they have run, in whatever task: see [Symmetry.Unclear]. *)
let coverage t =
  let coverage = Parts.coverage t.parts in
  let is_reached = function Alike.Task site -> Coverage.is_started coverage site | Code id -> Coverage.is_run coverage id in
  let alike labels = if List.exists is_reached labels then List.iter (coverage_of_label coverage) labels in
  Option.iter (fun finder -> Symmetry.handlers_alike finder alike) t.symmetry;
  coverage

let bytes t = States.bytes t.states
let bytes_to_grow t ~by = States.bytes_to_grow t.states ~by
let forget_waiting t = States.forget_waiting t.states
let words t = States.words t.states
let may_cycle t = Script_graph.may_cycle t.script

let broken t property =
  match t.broken.(rank property) with
  | -1 -> None
  | i -> Some i

let statistics ppf t =
  let widths = Shapes.widths t.shapes in
  Format.fprintf ppf "%d words; widths: shape %d, shared %d; %d shapes, %d shared, %d configurations" (words t)
    widths.shape widths.shared (Shapes.count t.shapes)
    (Cases.Shareds.count (Cases.shareds t.cases))
    (Words.count_wholes t.words)
