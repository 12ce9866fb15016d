open Dolphin_semantics
module Machines = Interner.Make (struct
    type t = Machine.t

    let equal a b = Machine.compare a b = 0
    let hash m = Machine.hash m land max_int
  end)

module Wholes = Interner.Make (struct
    type t = Configuration.t * Environment.t

    let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'
    let hash (c, e) = (Configuration.hash c + Environment.hash e) land max_int
  end)

type t = {
  options : Environment.options;
  reduction : Reduction.t;
  program : Core.program;
  world : World.t;
  parts : Parts.t;
  shareds : Parts.Shareds.t;
  machines : Machines.t;
  frames : (int, Shape.frame) Hashtbl.t;  (* by number of the machine *)
  wholes : Wholes.t;  (* configurations that execute nothing *)
  mutable breaks : Property.t option array;  (* by number of such a configuration: what reaching it breaks *)
  by_families : (int * int list, Shape.t) Hashtbl.t;  (* by machine and families *)
  mutable shapes : Shape.t array;  (* by number; the first is none *)
  mutable count_shapes : int;
  mutable widths : Shape.widths;
  mutable shape_mask : int;
  mutable shared_mask : int;
  mutable states : Packed.t;
  mutable key : int array;  (* the state being expanded, changed in place for its successors and changed back *)
  mutable other : int array;  (* successors of another shape *)
  mutable transitions : int;
  broken : int array;  (* by rank in [Property.all]: the first state, or -1 *)
  places : (int * int, unit) Hashtbl.t;  (* which place of the script follows which; executing ones as negative numbers *)
  mutable fresh : int -> int -> unit;  (* what is done with new states, by number and first word *)
  mutable gathering : bool;
  mutable gathered : int list;
}

(* Raised when a number does not fit its field: the state is expanded again after [repack]. *)
exception Outgrown

let rank property =
  let rec from i = function
    | [] -> invalid_arg "Space.rank"
    | p :: rest -> if p = property then i else from (i + 1) rest
  in
  from 0 Property.all

(* {1 Layout} *)

let set_widths t (widths : Shape.widths) =
  t.widths <- widths;
  t.shape_mask <- (1 lsl widths.shape) - 1;
  t.shared_mask <- (1 lsl widths.shared) - 1

let bits_for n =
  let rec from bits = if 1 lsl bits >= n then bits else from (bits + 1) in
  from 1

let fits t =
  (not (Parts.outgrown t.parts))
  && t.count_shapes <= t.shape_mask + 1
  && Parts.Shareds.count t.shareds <= t.shared_mask + 1

let check_fit t = if not (fits t) then raise Outgrown

let local_of (s : Shape.t) key i = (key.(s.word.(i)) lsr s.shift.(i)) land s.mask.(i)

(* Everything in fields that are wide enough. What a state is made of is read in the old layout and written in the new
   one, so the shapes must be laid out twice. *)
let repack t =
  let old_widths = t.widths and old_shape_mask = t.shape_mask and old_shared_mask = t.shared_mask in
  let shapes = if t.count_shapes = 1 then [||] else Array.sub t.shapes 1 (t.count_shapes - 1) in
  let old = Array.map (fun (s : Shape.t) -> { s with number = s.number }) t.shapes in
  let lay_out_families (s : Shape.t) = Array.iter Parts.lay_out s.families in
  Array.iter lay_out_families shapes;
  Parts.none_outgrown t.parts;
  let shape = max t.widths.shape (bits_for t.count_shapes)
  and shared = max t.widths.shared (bits_for (Parts.Shareds.count t.shareds)) in
  set_widths t { shape; shared };
  let needed = Array.fold_left (fun n s -> max n (Shape.lay_out t.widths s)) 1 shapes in
  let words = max needed (Packed.words t.states) in
  let rewritten from fresh =
    let number = from.(0) land old_shape_mask in
    if number = 0 then fresh.(0) <- (from.(0) lsr old_widths.shape) lsl t.widths.shape
    else begin
      let was = old.(number) and s = t.shapes.(number) in
      let shared = (from.(0) lsr old_widths.shape) land old_shared_mask in
      fresh.(0) <- number lor (shared lsl t.widths.shape);
      for i = 0 to Array.length s.families - 1 do
        fresh.(s.word.(i)) <- fresh.(s.word.(i)) lor (local_of was from i lsl s.shift.(i))
      done
    end
  in
  t.states <- Packed.rewrite t.states ~words rewritten;
  t.key <- Array.make words 0;
  t.other <- Array.make words 0

(* {1 Shapes} *)

let frame t machine =
  let i = Machines.number t.machines machine in
  match Hashtbl.find_opt t.frames i with
  | Some frame -> frame
  | None ->
    let frame : Shape.frame = { frame = i; machine = Machines.value t.machines i; over = [||] } in
    Hashtbl.add t.frames i frame;
    frame

let new_shape t key frame families =
  let n = Array.length families in
  let s : Shape.t =
    {
      number = t.count_shapes;
      frame;
      families;
      word = [||];
      shift = [||];
      mask = [||];
      without = Array.make n None;
      becoming = Hashtbl.create 1;
    }
  in
  if t.count_shapes >= Array.length t.shapes then begin
    let shapes = Array.make (2 * (t.count_shapes + 1)) s in
    Array.blit t.shapes 0 shapes 0 (Array.length t.shapes);
    t.shapes <- shapes
  end;
  t.shapes.(t.count_shapes) <- s;
  t.count_shapes <- t.count_shapes + 1;
  Hashtbl.add t.by_families key s;
  Array.iter (fun (f : Parts.family) -> if f.width = 0 then Parts.lay_out f) families;
  let needed = Shape.lay_out t.widths s in
  if needed > Packed.words t.states then raise Outgrown;
  s

let shape t (frame : Shape.frame) families =
  let key = (frame.frame, List.map (fun (f : Parts.family) -> f.number) (Array.to_list families)) in
  match Hashtbl.find_opt t.by_families key with
  | Some s -> s
  | None -> new_shape t key frame families

let without t (s : Shape.t) position =
  match s.without.(position) with
  | Some s -> s
  | None ->
    let keep = List.filteri (fun i _ -> i <> position) (Array.to_list s.families) in
    let smaller = shape t s.frame (Array.of_list keep) in
    s.without.(position) <- Some smaller;
    smaller

let becoming t (s : Shape.t) position serial parts =
  let key = (serial * Array.length s.families) + position in
  match Hashtbl.find_opt s.becoming key with
  | Some s -> s
  | None ->
    let families = Array.map (fun (p : Parts.part) -> p.family) parts in
    let before = Array.sub s.families 0 position in
    let after = Array.sub s.families (position + 1) (Array.length s.families - position - 1) in
    let other = shape t s.frame (Array.concat [ before; families; after ]) in
    Hashtbl.add s.becoming key other;
    other

(* {1 Words of configurations} *)

let clear key = Array.fill key 0 (Array.length key) 0

let write_whole t key number =
  clear key;
  key.(0) <- number lsl t.widths.shape

let put (s : Shape.t) key i local = key.(s.word.(i)) <- key.(s.word.(i)) lor (local lsl s.shift.(i))

let whole t rules c outside =
  let known = Wholes.count t.wholes in
  let number = Wholes.number t.wholes (c, outside) in
  if number = known then begin
    if number = Array.length t.breaks then t.breaks <- Array.append t.breaks (Array.make (max 8 number) None);
    t.breaks.(number) <- Property.broken_by_end rules c
  end;
  number

let write t key rules (c : Configuration.t) outside =
  match c.control with
  | Script _ | Waiting _ | Ended _ ->
    let number = whole t rules c outside in
    write_whole t key number;
    number
  | Executing (m, r) ->
    let frame = frame t m in
    let rs = match r with Residual.Parallel rs -> rs | r -> [ r ] in
    let parts = Array.of_list (List.map (Parts.part t.parts) rs) in
    let s = shape t frame (Array.map (fun (p : Parts.part) -> p.family) parts) in
    let shared = Parts.Shareds.number t.shareds (Shared.of_configuration c outside) in
    check_fit t;
    clear key;
    key.(0) <- s.number lor (shared lsl t.widths.shape);
    Array.iteri (fun i (p : Parts.part) -> put s key i p.local) parts;
    -1 - frame.frame

let executing (s : Shape.t) key : Residual.t * Core.platform_task Configuration.Vehicle_map.t =
  let parts = Array.to_list (Array.mapi (fun i (f : Parts.family) -> f.members.(local_of s key i)) s.families) in
  let rs = List.map (fun (p : Parts.part) -> p.residual) parts in
  let runs allocation (step : Residual.step) =
    match step.offer with
    | End_of (p, v) -> Configuration.Vehicle_map.add v p allocation
    | Start _ | Perform _ | Check _ | Measure _ | Expiry_of _ -> allocation
  in
  let of_part allocation r = Seq.fold_left runs allocation (Residual.steps r) in
  (Residual.parallel rs, List.fold_left of_part Configuration.Vehicle_map.empty rs)

let read t key =
  let number = key.(0) land t.shape_mask in
  if number = 0 then Wholes.value t.wholes (key.(0) lsr t.widths.shape)
  else begin
    let s = t.shapes.(number) in
    let shared = Parts.Shareds.value t.shareds ((key.(0) lsr t.widths.shape) land t.shared_mask) in
    let r, allocation = executing s key in
    ({ (Shared.under (Executing (s.frame.machine, r)) shared) with allocation }, shared.outside)
  end

let state t i =
  let key = Array.make (Packed.words t.states) 0 in
  Packed.load t.states i key;
  read t key

let shared t i =
  let key = Array.make (Packed.words t.states) 0 in
  Packed.load t.states i key;
  if key.(0) land t.shape_mask = 0 then -1 else (key.(0) lsr t.widths.shape) land t.shared_mask

(* {1 Expanding} *)

let note_broken t property i =
  let rank = rank property in
  if t.broken.(rank) < 0 then t.broken.(rank) <- i

let fresh t i word =
  if word land t.shape_mask = 0 then
    Option.iter (fun property -> note_broken t property i) t.breaks.(word lsr t.widths.shape)

let flush t = Packed.flush t.states ~fresh:t.fresh

let visit t key parent =
  if t.gathering then t.gathered <- Packed.find t.states key :: t.gathered
  else Packed.push t.states key ~parent ~fresh:t.fresh

let follows t place place' = if not (Hashtbl.mem t.places (place, place')) then Hashtbl.add t.places (place, place') ()

let expand_whole t i number =
  let c, outside = Wholes.value t.wholes number in
  let choices = Environment.choices t.options t.program t.world outside c in
  let go ((next : Transition.t), outside) =
    Coverage.transition (Parts.coverage t.parts) c next;
    follows t number (write t t.other next.rules next.next outside);
    visit t t.other i
  in
  List.iter go choices;
  (match c.control, choices with
   | Ended _, _ | _, _ :: _ -> ()
   | (Script _ | Waiting _ | Executing _), [] -> note_broken t No_deadlock i);
  List.length choices

(* The configuration that a local outcome ends the executing in, by the transition function. *)
let concluded t (s : Shape.t) shared (outcome : Transition.outcome) =
  let shared = Parts.Shareds.value t.shareds shared in
  let c = Shared.under (Executing (s.frame.machine, Parallel [])) shared in
  let local : Transition.local = { after = c; outcome; derivation = []; named = Silent; asked = []; assumed = [] } in
  let next = Transition.conclude c s.frame.machine local in
  whole t next.rules next.next shared.outside

let over t (s : Shape.t) shared =
  let frame = s.frame in
  if shared >= Array.length frame.over then begin
    let longer = Array.make (max (shared + 1) (2 * Array.length frame.over)) (-1) in
    Array.blit frame.over 0 longer 0 (Array.length frame.over);
    frame.over <- longer
  end;
  if frame.over.(shared) < 0 then begin
    frame.over.(shared) <- concluded t s shared Over;
    follows t (-1 - frame.frame) frame.over.(shared)
  end;
  frame.over.(shared)

(* The part at [position] gives way to [parts] (which may be none), with [shared] after the step. *)
let replace t (s : Shape.t) (s' : Shape.t) position (parts : Parts.part array) shared i =
  let key = t.key and other = t.other in
  clear other;
  other.(0) <- s'.number lor (shared lsl t.widths.shape);
  for j = 0 to position - 1 do
    put s' other j (local_of s key j)
  done;
  let more = Array.length parts in
  for j = 0 to more - 1 do
    put s' other (position + j) parts.(j).local
  done;
  for j = position + 1 to Array.length s.families - 1 do
    put s' other (j + more - 1) (local_of s key j)
  done;
  visit t other i

let no_parts : Parts.part array = [||]

let leave t (s : Shape.t) position shared i =
  if Array.length s.families = 1 then begin
    write_whole t t.other (over t s shared);
    visit t t.other i
  end
  else begin
    let s' = without t s position in
    check_fit t;
    replace t s s' position no_parts shared i
  end

let go_to t (s : Shape.t) position (target : Parts.target) shared shared' i =
  match target with
  | Stays local ->
    let key = t.key and word = s.word.(position) in
    let moved = (local - local_of s key position) lsl s.shift.(position) in
    let shared_moved = (shared' - shared) lsl t.widths.shape in
    key.(word) <- key.(word) + moved;
    key.(0) <- key.(0) + shared_moved;
    visit t key i;
    key.(0) <- key.(0) - shared_moved;
    key.(word) <- key.(word) - moved
  | Gone -> leave t s position shared' i
  | Becomes { serial; parts } ->
    let s' = becoming t s position serial parts in
    check_fit t;
    replace t s s' position parts shared' i
  | Ends _ -> invalid_arg "Space.go_to: an end"

let ends_run (case : Parts.case) = match case.result with Ends _ -> true | Stays _ | Gone | Becomes _ -> false

let take_case t (s : Shape.t) position (case : Parts.case) shared i =
  match case.result with
  | Ends ending ->
    if case.whole < 0 then case.whole <- concluded t s case.shared (Ends ending);
    write_whole t t.other case.whole;
    visit t t.other i
  | (Stays _ | Gone | Becomes _) as target ->
    check_fit t;
    go_to t s position target shared case.shared i

(* The results of these are how many transitions there are. *)
let go_by_case t (s : Shape.t) position (family : Parts.family) (step : Parts.step) shared i =
  let case = Parts.case t.parts family step shared in
  if not case.possible then 0
  else begin
    take_case t s position case shared i;
    List.iter (fun other -> take_case t s position other shared i) case.others;
    1 + List.length case.others
  end

let go_to_ends t (s : Shape.t) position (family : Parts.family) (step : Parts.step) shared i =
  let case = Parts.case t.parts family step shared in
  let ends = List.filter ends_run (case :: case.others) in
  List.iter (fun case -> take_case t s position case shared i) ends;
  List.length ends

(* As constants of this module they cost nothing. *)
let unknown = Parts.unknown
let special = Parts.special

let local_status t (step : Parts.step) family shared : Stubborn.status =
  let by_case () : Stubborn.status =
    match Parts.case t.parts family step shared with
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
    let result = Parts.guarded t.parts step guard shared in
    if result >= 0 then Moves else if result = special then by_case () else Impossible

let take_step t s position family (step : Parts.step) shared i =
  match step.dependence with
  | Free -> go_to t s position step.target shared shared i; 1
  | Guarded guard when Parts.guarded t.parts step guard shared >= 0 ->
    go_to t s position step.target shared (Parts.guarded t.parts step guard shared) i;
    1
  | Guarded _ | By_case -> go_by_case t s position family step shared i

(* As [expand_executing], with steps that are enough. Which they are depends on nothing but the configuration. *)
let expand_some t (s : Shape.t) (parts : Parts.part array) shared i =
  let status position k =
    let part = parts.(position) in
    local_status t part.steps.(k) part.family shared
  in
  let components = Array.map (Parts.components t.parts) parts in
  let choice = Stubborn.choose components status in
  let taken = ref 0 in
  let go position (part : Parts.part) =
    let take k step =
      let is_chosen = match choice with None -> true | Some chosen -> chosen position k in
      if is_chosen || components.(position).ends.(k) then
        let status = status position k in
        check_fit t;
        match status with
        | Impossible -> ()
        | Moves when not is_chosen -> ()
        | Depends _ when not is_chosen ->
          taken := !taken + go_to_ends t s position part.family step shared i
        | Moves | Ends | Depends _ -> taken := !taken + take_step t s position part.family step shared i
    in
    Array.iteri take part.steps
  in
  Array.iteri go parts;
  check_fit t;
  !taken

let expand_part t (s : Shape.t) position (family : Parts.family) (part : Parts.part) shared i =
  let steps = part.steps in
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
          let result = Parts.guarded t.parts step guard shared in
          check_fit t;
          result
        end
    in
    if shared' >= 0 then begin
      incr taken;
      go_to t s position step.target shared shared' i
    end
    else if shared' = special then taken := !taken + go_by_case t s position family step shared i
  done;
  !taken

let part_at t (s : Shape.t) position =
  let family = Array.unsafe_get s.families position in
  let part = family.members.(local_of s t.key position) in
  if Array.length part.steps = 0 then begin
    Parts.reach t.parts part;
    check_fit t
  end;
  part

let expand_executing t i number =
  let s = Array.unsafe_get t.shapes number in
  let shared = (t.key.(0) lsr t.widths.shape) land t.shared_mask in
  let taken =
    match t.reduction with
    | Partial_order -> expand_some t s (Array.init (Array.length s.families) (part_at t s)) shared i
    | Whole ->
      let taken = ref 0 in
      for position = 0 to Array.length s.families - 1 do
        let part = part_at t s position in
        taken := !taken + expand_part t s position part.family part shared i
      done;
      !taken
  in
  if taken = 0 then note_broken t No_deadlock i;
  taken

let rec expand t i =
  match
    Packed.load t.states i t.key;
    let number = t.key.(0) land t.shape_mask in
    if number = 0 then expand_whole t i (t.key.(0) lsr t.widths.shape) else expand_executing t i number
  with
  | taken -> if not t.gathering then t.transitions <- t.transitions + taken
  | exception Outgrown ->
    flush t;
    repack t;
    expand t i

let successors t i =
  t.gathering <- true;
  t.gathered <- [];
  expand t i;
  t.gathering <- false;
  List.rev t.gathered

let create ?(reduction = Reduction.Whole) options program world =
  let foreseen = match reduction with Whole -> None | Partial_order -> Some 0 in
  let parts = Parts.create ?foreseen options program world in
  let t =
    {
      options;
      reduction;
      program;
      world;
      parts;
      shareds = Parts.shareds parts;
      machines = Machines.create ();
      frames = Hashtbl.create 16;
      wholes = Wholes.create ();
      breaks = [||];
      by_families = Hashtbl.create 64;
      shapes = [||];
      count_shapes = 1;
      widths = { shape = 4; shared = 4 };
      shape_mask = 0;
      shared_mask = 0;
      states = Packed.create ~words:1;
      key = [| 0 |];
      other = [| 0 |];
      transitions = 0;
      broken = Array.make (List.length Property.all) (-1);
      places = Hashtbl.create 64;
      fresh = (fun _ _ -> ());
      gathering = false;
      gathered = [];
    }
  in
  set_widths t t.widths;
  ignore (write t t.key [] (Configuration.initial program) Environment.initial);
  t.fresh <- fresh t;
  visit t t.key 0;
  flush t;
  t

(* {1 Findings} *)

let count t = Packed.count t.states
let transitions t = t.transitions
let parent t i = Packed.parent t.states i
let coverage t = Parts.coverage t.parts
let bytes t = Packed.bytes t.states
let bytes_to_grow t = Packed.bytes_to_grow t.states
let words t = Packed.words t.states

let broken t property =
  match t.broken.(rank property) with
  | -1 -> None
  | i -> Some i

(* Places that nothing follows are taken away again and again: what remains if anything does lies on cycles, or leads
   to them. *)
let may_cycle t =
  let before = Hashtbl.create 64 and following = Hashtbl.create 64 in
  let edge (place, place') () =
    Hashtbl.add before place' place;
    let n = Option.value (Hashtbl.find_opt following place) ~default:0 in
    Hashtbl.replace following place (n + 1);
    if not (Hashtbl.mem following place') then Hashtbl.add following place' 0
  in
  Hashtbl.iter edge t.places;
  let ends = Stack.create () and left = ref (Hashtbl.length following) in
  Hashtbl.iter (fun place n -> if n = 0 then Stack.push place ends) following;
  while not (Stack.is_empty ends) do
    decr left;
    let less place =
      let n = Hashtbl.find following place - 1 in
      Hashtbl.replace following place n;
      if n = 0 then Stack.push place ends
    in
    List.iter less (Hashtbl.find_all before (Stack.pop ends))
  done;
  !left > 0

let statistics ppf t =
  Format.fprintf ppf "%d words; widths: shape %d, shared %d; %d shapes, %d shared, %d configurations" (words t)
    t.widths.shape t.widths.shared (t.count_shapes - 1)
    (Parts.Shareds.count t.shareds) (Wholes.count t.wholes)
