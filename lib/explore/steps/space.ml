open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Component

exception Outgrown = Layouts.Outgrown

type via = Task_group.permutation option
type property = Property.t

type t = {
  options : Environment.options;
  start : Configuration.t * Environment.t;
  reduction : Reduction.t;
  program : Core.program;
  world : World.t;
  components : Components.t;
  encoding : Encoding.t;
  layouts : Layouts.t;
  steps : Memoised_steps.t;
  expansion : Expansion.t;
  quotient : Quotient.t;
  observer : Observer.t option;
  task_groups : Task_groups.t option;
  vehicles : Canonical_vehicles.t option;
  recruiting : Recruiting.t option;  (* for tasks that recruit interchangeable vehicles *)
  mutable unclear : Fault.t option;  (* why it cannot be listed what follows a state *)
  tick : (unit -> unit) ref;  (* while a state of the script is expanded, from which tasks begin: the visitor's *)
}

(* {1 Representatives} *)

let choices t outside c =
  match t.vehicles with
  | Some vehicles -> Canonical_vehicles.choices vehicles outside c
  | None -> Environment.choices t.options t.program t.world outside c

let canonical t c outside =
  match t.vehicles with Some vehicles -> Canonical_vehicles.canonical vehicles c outside | None -> (c, outside)

let program t = t.program
let owes t outside = Environment.owes t.options t.program outside
let has_vehicle_symmetry t = t.vehicles <> None

(* {1 Where nothing executes} *)

let expand_script t number (visitor : via System.visitor) =
  let c, outside = Encoding.script t.encoding number in
  let taken = ref 0 and goes_on = ref false in
  t.tick := visitor.tick;
  let go ((next : Transition.t), outside) =
    visitor.tick ();
    incr taken;
    if not (Environment.is_voluntary next) then goes_on := true;
    Coverage.transition (Components.coverage t.components) c next;
    let action = Observer.of_transition t.observer next in
    let place = Expansion.write_and_visit t.expansion visitor next.rules next.next outside ~action in
    Expansion.follows t.expansion number place
  in
  Seq.iter go (choices t outside c);
  t.tick := ignore;
  if Configuration.has_ended c || not (!goes_on || owes t outside) then visitor.rest ();
  !taken

(* {1 All steps} *)

(* As constants of this module they cost nothing. *)
let unknown = Memoised_steps.unknown
let special = Memoised_steps.special

let is_followed t x step =
  match t.recruiting with None -> true | Some recruiting -> Recruiting.follows recruiting x step

(* Of a step that is possible, and not [special]. *)
let action t step shared =
  match step.dependence with
  | Guarded guard -> guard.actions.(shared)
  | Free -> if step.free_action >= 0 then step.free_action else Memoised_steps.action t.steps step shared
  | Dependent -> Observer.nothing

let take_all t (x : Expansion.source) place steps =
  let taken = ref 0 and is_observed = Option.is_some t.observer and shared = x.shared in
  for k = 0 to Array.length steps - 1 do
    let step = Array.unsafe_get steps k in
    let shared' =
      match step.dependence with
      | Free -> shared
      | Dependent -> special
      | Guarded guard ->
        let known = if shared < Array.length guard.results then Array.unsafe_get guard.results shared else unknown in
        if known <> unknown then known
        else begin
          let result = Memoised_steps.guarded t.steps step guard shared in
          Encoding.check_fit t.encoding;
          result
        end
    in
    if shared' >= 0 then begin
      incr taken;
      let action = if is_observed then action t step shared else Observer.nothing in
      Expansion.go_to x place step.successor ~action shared'
    end
    else if shared' = special && is_followed t x step then taken := !taken + Expansion.take_dependent x place step
  done;
  !taken

let component_at t (x : Expansion.source) position =
  let component = Encoding.component x.layout x.key position in
  if Array.length component.steps = 0 then begin
    Components.reach t.components component;
    Encoding.check_fit t.encoding
  end;
  component

let cuts t (nest : Layout.place) =
  match nest.inside with
  | None -> [||]
  | Some { cuts = Some cuts; _ } -> cuts
  | Some inside ->
    let cuts = Components.cuts t.components inside in
    Encoding.check_fit t.encoding;
    cuts

let expand_all t (x : Expansion.source) =
  let layout = x.layout and taken = ref 0 in
  for position = 0 to Array.length layout.families - 1 do
    let component = component_at t x position in
    taken := !taken + take_all t x (Array.unsafe_get layout.leaves position) component.steps
  done;
  for n = 0 to Array.length layout.nests - 1 do
    let nest = layout.nests.(n) in
    taken := !taken + take_all t x nest (cuts t nest)
  done;
  !taken

(* {1 Steps that are enough} *)

let local_status t (x : Expansion.source) place step : Stubborn.status =
  let move level target rounds : Stubborn.move =
    { level; over = (match target with Gone -> true | Stays _ | Becomes _ | Ends _ -> false); closes = rounds <> [];
      on_event = (match step.event with None | Some (Recruited _) -> false | Some _ -> true) }
  in
  let of_outcome (outcome : outcome) = move outcome.level outcome.target outcome.rounds in
  let dependent () : Stubborn.status =
    match Expansion.outcome x place step with
    | { possible = false; _ } -> Impossible
    | { certain = true; _ } as outcome -> if Memoised_steps.ends_run outcome then Ends else Moves (of_outcome outcome)
    | { certain = false; _ } as outcome ->
      let ends, moves = List.partition Memoised_steps.ends_run (outcome :: outcome.others) in
      Depends { moves = List.map of_outcome moves; ends = ends <> [] }
  in
  match step.dependence with
  | Free -> Moves (move 0 step.successor step.begins)
  | Dependent -> dependent ()
  | Guarded guard ->
    let result = Memoised_steps.guarded t.steps step guard x.shared in
    if result >= 0 then Moves (move 0 step.successor step.begins)
    else if result = special then dependent ()
    else Impossible

let take_step t (x : Expansion.source) place step =
  let go shared' =
    let action = if Option.is_some t.observer then action t step x.shared else Observer.nothing in
    Expansion.go_to x place step.successor ~action shared';
    1
  in
  match step.dependence with
  | Free -> go x.shared
  | Guarded guard ->
    let result = Memoised_steps.guarded t.steps step guard x.shared in
    if result >= 0 then go result else Expansion.take_dependent x place step
  | Dependent -> Expansion.take_dependent x place step

(* From this many components on, the work for one state takes so long that bounds are checked before it. *)
let many_components = 64

(* Components and nests, with their steps. *)
let components t (x : Expansion.source) =
  if Array.length x.layout.leaves >= many_components then x.visitor.tick ();
  let makes_in (nest : Layout.place) =
    match nest.inside with Some path -> path.makes | None -> false
  in
  let makes_at i = (Encoding.component x.layout x.key i).makes_tasks in
  let positions = Array.length x.layout.leaves in
  let rec some_from i = i < positions && (makes_at i || some_from (i + 1)) in
  let makes = some_from 0 || Array.exists makes_in x.layout.nests in
  let component position place =
    let component = component_at t x position in
    ({ Stubborn.place; analysis = Components.footprints t.components ~makes component }, component.steps)
  in
  let nest (place : Layout.place) =
    let steps = cuts t place in
    let of_path path = ({ Stubborn.place; analysis = Components.cut_footprints t.components ~makes path }, steps) in
    if Array.length steps = 0 then None else Option.map of_path place.inside
  in
  Array.append
    (Array.mapi component x.layout.leaves)
    (Array.of_list (List.filter_map nest (Array.to_list x.layout.nests)))

(* The statuses of the steps of [components], each computed once: a choice asks for them again and again. *)
let statuses t x components =
  let known = Array.map (fun (_, steps) -> Array.make (Array.length steps) None) components in
  fun c k ->
    match known.(c).(k) with
    | Some status -> status
    | None ->
      let { Stubborn.place; _ }, steps = components.(c) in
      let status = local_status t x place steps.(k) in
      known.(c).(k) <- Some status;
      status

(* Which steps of [components] are enough, which depends on nothing but the configuration. *)
let choose t (x : Expansion.source) components status =
  let posts = Expansion.upcoming t.expansion x.shared in
  Stubborn.choose (Array.map fst components) ~posts status

(* As [expand_all]. *)
let expand_some t (x : Expansion.source) =
  let components = components t x in
  let status = statuses t x components in
  let choice = choose t x components status in
  let taken = ref 0 in
  let go c ({ Stubborn.place; analysis }, steps) =
    let take k step =
      let is_chosen = (match choice with None -> true | Some chosen -> chosen c k) && is_followed t x step in
      if is_chosen || analysis.ends.(k) then begin
        let status = status c k in
        Encoding.check_fit t.encoding;
        match status with
        | Impossible -> ()
        | Moves _ when not is_chosen -> ()
        | Depends _ when not is_chosen -> taken := !taken + Expansion.take_ends x place step
        | Moves _ | Ends | Depends _ -> taken := !taken + take_step t x place step
      end
    in
    Array.iteri take steps
  in
  Array.iteri go components;
  Encoding.check_fit t.encoding;
  if choice = None then (!taken, Expansion.inputs x) else (!taken, 0)

(* {1 Steps one by one} *)

type possible = { at : int list; name : int list; stays : bool; depends : bool; step : Component.step }
type layers = (int list * Residual.again) list

let inside = -1

(* The contexts of the part at [at], innermost first: each with its place, and the innermost place. *)
let layers_of at contexts =
  let layer (at, layers) context = (at @ [ inside ], (at, context) :: layers) in
  List.fold_left layer (at, []) (List.rev contexts)

(* The place of [place], and the layers around it, the innermost first. *)
let rec place_of (layout : Layout.t) (place : Layout.place) =
  let among places =
    let rec count n = function p :: rest -> if p == place then n else count (n + 1) rest | [] -> n in
    count 0 places
  in
  match place.around with
  | None -> ([ among layout.top ], [])
  | Some nest ->
    let at, layers = place_of layout nest in
    let contexts = match nest.inside with Some path -> path.contexts | None -> [] in
    let at, more = layers_of at contexts in
    (at @ [ among nest.children ], more @ layers)

(* Code of an action, and the ends of tasks, are never waited for in vain; a guard may be. *)
let stays (Task_rules.Step { offer; _ }) =
  match offer with
  | Start _ | Perform _ | Guard_either _ | Measure _ | Make _ | End_of _ | Expiry_of _ | Answer_to _ -> true
  | Check _ | Guard_values _ | Guard_false _ | Allocate _ | Recruit_for _ -> false

let may_cut = function
  | Residual.Body_until _ | Body_during _ -> true
  | In_sequence _ | Branch_of _ | In_watch _ | Round_of _ | Holding _ | In_recruited _ | With_keys _ | Ensuring _ ->
    false

let repeats layers =
  let repeat (at, context) = match context with Residual.Round_of again -> Some (at, again) | _ -> None in
  List.filter_map repeat layers

(* The steps of the part at [place], by index: the place and name of each; and the repeats around. *)
let positions (layout : Layout.t) key (place : Layout.place) =
  let at, around = place_of layout place in
  let cuts layers = List.filter_map (fun (at, context) -> if may_cut context then Some at else None) layers in
  match place.inside with
  | Some path ->
    let _, layers = layers_of at path.contexts in
    let cuts = Array.of_list (cuts layers) in
    ((fun index -> (cuts.(index), [])), repeats (layers @ around))
  | None ->
    let component = Encoding.component layout key place.from in
    let contexts, leaf = Residual.decompose component.residual in
    let inner, layers = layers_of at contexts in
    let cuts = Array.of_list (List.rev (cuts layers)) in
    let n = Array.length cuts in
    let asked = match leaf with Repeat { again; _ } -> [ (inner, again) ] | _ -> [] in
    let name index = [ component.family.number; component.local; index - n ] in
    let position index = if index < n then (cuts.(index), []) else (inner, name index) in
    (position, asked @ repeats (layers @ around))

let may_all_stay_away t key vs =
  let shared = Layouts.shared t.layouts key.(0) in
  let { Surroundings.outside; _ } = Surroundings.Numbers.value (Encoding.shareds t.encoding) shared in
  Environment.may_all_stay_away t.options outside vs

let inputs_at t outside = Environment.keys_of_inputs t.options t.program outside

let examine t key ~possible ~taken visitor =
  let layout = Layouts.layout t.layouts (Layouts.number t.layouts key.(0)) in
  let shared = Layouts.shared t.layouts key.(0) in
  let x = Expansion.source t.expansion ~key ~layout ~shared visitor in
  let components = components t x in
  let status = statuses t x components in
  let choice = if Reduction.by_order t.reduction then choose t x components status else None in
  let follow here place ~is_chosen ~may_end (step : Component.step) layers =
    let each (outcome : outcome) =
      if is_chosen || Memoised_steps.ends_run outcome then begin
        taken here outcome.rounds layers outcome.assumed;
        Expansion.take_outcome x place outcome
      end
    in
    if not (Memoised_steps.is_settled t.steps step x.shared) then begin
      if is_chosen || may_end then
        let outcome = Expansion.outcome x place step in
        List.iter each (outcome :: outcome.others)
    end
    else if is_chosen then begin
      taken here step.begins layers [ [] ];
      ignore (take_step t x place step)
    end
  in
  let go c ({ Stubborn.place; analysis }, steps) =
    let position, layers = positions layout key place in
    let take k (step : Component.step) =
      let status = status c k in
      Encoding.check_fit t.encoding;
      match status with
      | Impossible -> ()
      | Moves _ | Ends | Depends _ ->
        let at, name = position step.index in
        let depends = (match status with Depends _ -> true | Impossible | Moves _ | Ends -> false) in
        let here = { at; name; stays = stays step.source; depends; step } in
        let is_chosen = (match choice with None -> true | Some chosen -> chosen c k) && is_followed t x step in
        possible here;
        follow here place ~is_chosen ~may_end:analysis.ends.(k) step layers
    in
    Array.iteri take steps
  in
  Array.iteri go components

let examine_script t key ~taken (visitor : via System.visitor) =
  let c, outside = Encoding.script t.encoding (Layouts.shared t.layouts key.(0)) in
  let go ((next : Transition.t), outside) =
    let action = Observer.of_transition t.observer next in
    taken next;
    ignore (Expansion.write_and_visit t.expansion visitor next.rules next.next outside ~action)
  in
  Seq.iter go (choices t outside c)

let world t = t.world

(* {1 The system} *)

let words t = Layouts.words t.layouts

let widen t ~reserved =
  let rewritten = Encoding.widen t.encoding ~reserved in
  Expansion.widen t.expansion ~words:(words t);
  rewritten

let numbers t key f =
  let number = Layouts.number t.layouts key.(0) in
  f number;
  f (Layouts.shared t.layouts key.(0));
  if number > 0 then
    let layout = Layouts.layout t.layouts number in
    Array.iteri (fun i _ -> f (Layout.local layout key i)) layout.families

let initial t visitor =
  let c, outside = t.start in
  ignore (Expansion.write_and_visit t.expansion visitor [] c outside ~action:Observer.nothing)

let unsettled program (fault : Fault.t) : Limits.bound =
  match Fault.location program fault with
  | Some at -> Unsettled (Format.asprintf "%a: %s" Dolphin_syntax.Location.pp at fault.message)
  | None -> Unsettled fault.message

(* Whether all that may happen are recruits of vehicles that may stay away. *)
let may_only_wait t key =
  let faults = t.options.faults in
  t.program.recruits
  && (Faults.is_possible faults.join || Faults.is_possible faults.loss)
  &&
  let c, outside = Encoding.read t.encoding key in
  Environment.only_recruits t.options outside (List.of_seq (Seq.map fst (choices t outside c)))

let transitions t key (visitor : via System.visitor) =
  match Layouts.number t.layouts key.(0) with
  | 0 -> expand_script t (Layouts.shared t.layouts key.(0)) visitor
  | number ->
    let layout = Layouts.layout t.layouts number and shared = Layouts.shared t.layouts key.(0) in
    let x = Expansion.source t.expansion ~key ~layout ~shared visitor in
    let taken, posted =
      if Reduction.by_order t.reduction then expand_some t x
      else
        let taken = expand_all t x in
        (taken, Expansion.inputs x)
    in
    if (taken = 0 || may_only_wait t key) && not (owes t (Encoding.outside t.encoding shared)) then visitor.rest ();
    taken + posted + Expansion.interrupt x

let expand t key visitor =
  match transitions t key visitor with
  | taken -> taken
  | exception Environment.Unclear fault ->
    t.unclear <- Some fault;
    raise (Limits.Stop (unsettled t.program fault))

let unclear t = t.unclear

let goes_round t = Components.goes_round t.components
let executes t word = Layouts.number t.layouts word > 0
let is_anchor t word = goes_round t || not (executes t word)

let broken t word =
  if Layouts.number t.layouts word > 0 then None else Encoding.broken t.encoding (Layouts.shared t.layouts word)

let is_end t word =
  (not (executes t word))
  &&
  match (fst (Encoding.script t.encoding (Layouts.shared t.layouts word))).control with
  | Ended _ -> true
  | Script _ | Waiting _ | Executing _ -> false

let may_cycle_in_script t = Expansion.may_cycle t.expansion

let may_cycle t = goes_round t || Expansion.may_cycle t.expansion

let valuation t action key =
  Option.fold ~none:0 ~some:(fun (o : Observer.t) -> o.valuation t.encoding action key) t.observer

(* {1 States} *)

let state t key = Encoding.read t.encoding key

let shared t key =
  if executes t key.(0) then Some (Layouts.shared t.layouts key.(0)) else None

let breadth t key =
  match Layouts.number t.layouts key.(0) with
  | 0 -> 0
  | number -> Array.length (Layouts.layout t.layouts number).families

type view = Exact of Configuration.t * Environment.t | Up_to of Task_group.t * Task_group.state

let view t key =
  let exact () =
    let c, outside = state t key in
    Exact (c, outside)
  in
  match Layouts.number t.layouts key.(0) with
  | 0 -> exact ()
  | number -> (
      let layout = Layouts.layout t.layouts number in
      match layout.frame.symmetry with
      | None -> exact ()
      | Some g -> Up_to (g, Quotient.state t.quotient g layout key (Layouts.shared t.layouts key.(0))))

(* The shared part is compared first: that is cheaper than finding the classes. *)
let is_in_class t g (state : Task_group.state) (c : Configuration.t) outside =
  match c.control with
  | Executing (_, r) ->
    let rs = match r with Residual.Parallel bs -> Branches.to_list bs | r -> [ r ] in
    let shared = Surroundings.Numbers.value (Encoding.shareds t.encoding) state.shared in
    Surroundings.equal (Surroundings.make c.shared outside) shared && Task_group.state g rs state.shared = state
  | Script _ | Waiting _ | Ended _ -> false

(* {1 States for other processes} *)

type portable = { space : t; texts : Portable.t }

let portable ?digest codec t = { space = t; texts = Portable.create ?digest codec t.encoding t.components }
let give p = Portable.give p.texts
let news p = Portable.news p.texts
let to_string p key = Portable.write p.texts key

type source = State of int array | End of Configuration.t * Environment.t

let of_string p text =
  let key = Array.make (words p.space) 0 in
  match Portable.read p.texts key text with None -> State key | Some (c, outside) -> End (c, outside)

let place p key = Portable.place p.texts key

(* {1 Findings} *)

let used_task_symmetry t = Option.fold ~none:false ~some:Task_groups.is_used t.task_groups
let exchanges t = has_vehicle_symmetry t || used_task_symmetry t
let used_vehicle_symmetry t = Option.fold ~none:false ~some:Canonical_vehicles.is_used t.vehicles

(* If an error handler has run in some task, so have those of its orbit, in other runs. *)
let coverage t =
  let coverage = Components.coverage t.components in
  let is_run = function Task_isomorphism.Task _ -> false | Code id -> Coverage.is_run coverage id in
  let cover labels = if List.exists is_run labels then List.iter (Quotient.cover coverage) labels in
  Option.iter (fun groups -> Task_groups.equivalent_handlers groups cover) t.task_groups;
  coverage

let numbering t = Components.numbering t.components
let check_fit t = Encoding.check_fit t.encoding

type findings = { covered : Coverage.t; edges : (int * int) list; rounds : bool; renamed : bool }

let findings t =
  { covered = Coverage.copy (Components.coverage t.components); edges = Expansion.edges t.expansion;
    rounds = Components.goes_round t.components; renamed = used_vehicle_symmetry t }

let add_findings t { covered; edges; rounds; renamed } =
  Coverage.add (Components.coverage t.components) covered;
  List.iter (fun (place, place') -> Expansion.follows t.expansion place place') edges;
  if rounds then Components.set_goes_round t.components;
  if renamed then Option.iter Canonical_vehicles.set_used t.vehicles

(* {1 Beginning} *)

let create
    ?(reduction = Reduction.Whole) ?(symmetry = Symmetry.none) ?(asked = []) ?observer ?spare_bits ?start options
    program world
  =
  let start = Option.value start ~default:(Configuration.initial program, Environment.initial) in
  let reduction = if Environment.may_leave options program then Reduction.Whole else reduction in
  let foreseen = if Reduction.by_order reduction then Some 0 else None in
  let numbering = Numbering.create () in
  let components = Components.create ?foreseen numbering options program world in
  let shareds = Surroundings.Numbers.create numbering in
  let number = Surroundings.Numbers.number shareds and value = Surroundings.Numbers.value shareds in
  let tick = ref ignore in
  let shared_numbers : Task_group.shareds = { numbering; number; value } in
  let task_groups = Task_groups.create ~tick:(fun () -> !tick ()) options program symmetry shared_numbers in
  let vehicles =
    if Vehicle_orbits.is_none symmetry.vehicles then None
    else Some (Canonical_vehicles.create options program ~asked world symmetry)
  in
  let find_symmetry = Option.map Task_groups.find task_groups in
  let canonical = Option.map Canonical_vehicles.canonical vehicles in
  let encoding = Encoding.create ?spare_bits ?find_symmetry ?canonical components shareds program in
  let observe = Option.map Observer.of_local_step observer in
  let steps = Memoised_steps.create ?observe components encoding and quotient = Quotient.create components encoding in
  let expansion = Expansion.create options components encoding steps quotient observer in
  let recruiting =
    if program.recruits then Option.map (fun v -> Recruiting.create v encoding numbering) vehicles else None in
  { options; start; reduction; program; world; components; encoding; layouts = Encoding.layouts encoding; steps;
    expansion; quotient; observer; task_groups; vehicles; recruiting; unclear = None; tick }
