open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Component

module By_number = Hashtbl.Make (struct
    type t = int

    let equal = Int.equal
    let hash n = (n lxor (n lsr 31)) * 65599 land max_int
  end)

type t = {
  options : Environment.options;
  components : Components.t;
  encoding : Encoding.t;
  layouts : Layouts.t;
  steps : Memoised_steps.t;
  quotient : Quotient.t;
  observer : Observer.t option;
  places : Script_graph.t;
  over : int By_number.t;  (* by frame and shared state: the configuration after the task *)
  posted : (int * int) list By_number.t;  (* by shared state: those after each input, with their actions *)
  upcoming : Footprint.t By_number.t;  (* by shared state: all that may still be posted *)
  interrupted : (int * int) By_number.t;  (* by shared state: the configuration, and the action *)
  mutable successor : int array;  (* scratch: a successor of another layout *)
  mutable representative : int array;  (* scratch: of a successor *)
}

let create options components encoding steps quotient observer =
  {
    options;
    components;
    encoding;
    layouts = Encoding.layouts encoding;
    steps;
    quotient;
    observer;
    places = Script_graph.create ();
    over = By_number.create 64;
    posted = By_number.create 16;
    upcoming = By_number.create 16;
    interrupted = By_number.create 16;
    successor = [| 0 |];
    representative = [| 0 |];
  }

let follows t = Script_graph.follows t.places
let edges t = Script_graph.edges t.places
let may_cycle t = Script_graph.may_cycle t.places

let widen t ~words =
  t.successor <- Array.make words 0;
  t.representative <- Array.make words 0

type source = {
  expansion : t;
  key : int array;
  layout : Layout.t;
  shared : int;
  visitor : Task_group.permutation option System.visitor;
  mutable surroundings : (Layout.place * Memoised_steps.surroundings) list;
}

let source expansion ~key ~layout ~shared visitor = { expansion; key; layout; shared; visitor; surroundings = [] }

(* {1 Visiting} *)

let visit t (visitor : _ System.visitor) (layout : Layout.t) key action =
  match layout.frame.symmetry with
  | None -> visitor.visit key action None
  | Some g ->
    let shared = Layouts.shared t.layouts key.(0) in
    let permutation = Quotient.canonical t.quotient g layout key shared ~into:t.representative in
    visitor.visit t.representative action (Some permutation)

let visit_permuted t (visitor : _ System.visitor) number permutation action =
  Encoding.write_script t.encoding t.successor number;
  visitor.visit t.successor action permutation

let visit_script t visitor number ~action = visit_permuted t visitor number None action

let write_and_visit t (visitor : _ System.visitor) rules c outside ~action =
  let place = Encoding.write t.encoding t.successor rules c outside in
  (match Layouts.number t.layouts t.successor.(0) with
   | 0 -> visitor.visit t.successor action None
   | number -> visit t visitor (Layouts.layout t.layouts number) t.successor action);
  place

(* {1 Ends of tasks} *)

(* The number of the configuration that an outcome ends the executing in. *)
let concluded x shared outcome =
  let encoding = x.expansion.encoding in
  let { Surroundings.shared; outside } = Surroundings.Numbers.value (Encoding.shareds encoding) shared in
  Encoding.script_number encoding [] (Local_step.next x.layout.frame.machine outcome shared) outside

let over x shared =
  let t = x.expansion and frame = x.layout.frame.number in
  let key = (frame lsl 31) lor shared in
  match By_number.find_opt t.over key with
  | Some number -> number
  | None ->
    let number = concluded x shared Over in
    By_number.add t.over key number;
    Script_graph.follows t.places (-1 - frame) number;
    number

(* The script sees what is shared, so each of the states that this one represents goes on by itself. *)
let visit_over x action shared =
  let t = x.expansion in
  match x.layout.frame.symmetry with
  | None -> visit_script t x.visitor (over x shared) ~action
  | Some g ->
    let image (shared, permutation) = visit_permuted t x.visitor (over x shared) (Some permutation) action in
    List.iter image (Task_group.orbit_of_shared g shared)

(* {1 Going to other states} *)

let no_components : component array = [||]

(* [components] replace the part at [place]; that makes [layout']. *)
let replace x (layout' : Layout.t) (place : Layout.place) (components : component array) action shared =
  let t = x.expansion and layout = x.layout in
  Encoding.check_fit t.encoding;
  let key = x.key and successor = t.successor in
  Array.fill successor 0 (Array.length successor) 0;
  successor.(0) <- Layouts.first t.layouts layout'.number shared;
  for j = 0 to place.from - 1 do
    Layout.put layout' successor j (Layout.local layout key j)
  done;
  let more = Array.length components in
  for j = 0 to more - 1 do
    Layout.put layout' successor (place.from + j) components.(j).local
  done;
  for j = place.upto to Array.length layout.families - 1 do
    Layout.put layout' successor (j - place.upto + place.from + more) (Layout.local layout key j)
  done;
  visit t x.visitor layout' successor action

let rec go x (place : Layout.place) target action shared =
  let t = x.expansion and layout = x.layout in
  match target, place.around with
  | Gone, None when place.from = 0 && place.upto = Array.length layout.families -> visit_over x action shared
  | Gone, Some ({ children = [ a; b ]; _ } as nest) -> leave_alone x nest (if a == place then b else a) action shared
  | Gone, (None | Some _) -> replace x (Layouts.without t.layouts layout place) place no_components action shared
  | Becomes { serial; children; components }, _ ->
    replace x (Layouts.becoming t.layouts layout place serial children) place components action shared
  | (Stays _ | Ends _), _ -> invalid_arg "Expansion.go: a target of the same layout, or none"

(* Only [other] is left in a nest, which dissolves then. *)
and leave_alone x nest (other : Layout.place) action shared =
  let t = x.expansion in
  match nest.inside, other.inside with
  | None, _ -> invalid_arg "Expansion.leave_alone: no nest"
  | Some _, None ->
    go x nest (Components.alone t.components (Encoding.component x.layout x.key other.from)) action shared
  | Some inside, Some _ ->
    let r = Components.around inside (Encoding.residual x.layout x.key other) in
    let children = Components.children t.components (Components.outside inside) r in
    let components = Array.of_list (List.concat_map Component.leaves children) in
    replace x (Layouts.with_children t.layouts x.layout nest children) nest components action shared

let go_to x (place : Layout.place) target ~action shared =
  match target with
  | Stays local ->
    let layout = x.layout and key = x.key and position = place.from in
    let word = layout.word.(position) in
    let moved = (local - Layout.local layout key position) lsl layout.shift.(position) in
    let shared_moved = Layouts.first x.expansion.layouts 0 (shared - x.shared) in
    key.(word) <- key.(word) + moved;
    key.(0) <- key.(0) + shared_moved;
    visit x.expansion x.visitor layout key action;
    key.(0) <- key.(0) - shared_moved;
    key.(word) <- key.(word) - moved
  | Gone | Becomes _ | Ends _ -> go x place target action shared

(* Only what is shared changes. *)
let share x ~action shared =
  let key = x.key and moved = Layouts.first x.expansion.layouts 0 (shared - x.shared) in
  key.(0) <- key.(0) + moved;
  visit x.expansion x.visitor x.layout key action;
  key.(0) <- key.(0) - moved

(* {1 Steps that depend on the shared part} *)

(* The components in [place], from left to right. *)
let rec standing x (place : Layout.place) =
  match place.inside with
  | None -> [ (Encoding.component x.layout x.key place.index).residual ]
  | Some inside -> Residual.plug inside.contexts Residual.hole :: List.concat_map (standing x) place.children

(* The contexts around [place], as far as vehicles are held there and timers are numbered. *)
let rec around x (place : Layout.place) =
  let beside children =
    let others = List.concat_map (fun child -> if child == place then [] else standing x child) children in
    Residual.Beside (Lazy.from_val others)
  in
  match place.around with
  | None -> [ beside x.layout.top ]
  | Some nest ->
    let contexts = match nest.inside with Some inside -> List.rev inside.contexts | None -> [] in
    let inside = List.map (fun context -> Residual.Inside context) contexts in
    List.concat [ around x nest; inside; [ beside nest.children ] ]

(* The ensured deeds of the parts that a step at [place] may cut off. *)
let owed x (place : Layout.place) =
  let ensured child = Residual.ensured (Encoding.residual x.layout x.key child) in
  let rec beside (place : Layout.place) =
    let others = List.concat_map (fun child -> if child == place then [] else ensured child) in
    match place.around with
    | None -> [ others x.layout.top ]
    | Some nest -> others nest.children :: beside nest
  in
  let inside = match place.inside with Some _ -> List.concat_map ensured place.children | None -> [] in
  { inside; beside = beside place }

let surroundings x place =
  match List.assq_opt place x.surroundings with
  | Some found -> found
  | None ->
    let around = around x place in
    let asks_running = (Components.program x.expansion.components).asks_running in
    let around = if asks_running then around @ [ Residual.Around (standing x place) ] else around in
    let owed = if Components.ensures x.expansion.components then Some (owed x place) else None in
    let found = Memoised_steps.surroundings x.expansion.steps ?owed around in
    x.surroundings <- (place, found) :: x.surroundings;
    found

let outcome x place step =
  if step.looks then Memoised_steps.look x.expansion.steps step (surroundings x place) x.shared
  else Memoised_steps.outcome x.expansion.steps step x.shared

let take_outcome x place (outcome : outcome) =
  match outcome.target with
  | Ends number -> visit_script x.expansion x.visitor number ~action:outcome.action
  | (Stays _ | Gone | Becomes _) as target ->
    Encoding.check_fit x.expansion.encoding;
    go_to x (Layout.above place outcome.level) target ~action:outcome.action outcome.shared

let take_dependent x place step =
  let outcome = outcome x place step in
  if not outcome.possible then 0
  else begin
    take_outcome x place outcome;
    match outcome.others with
    | [] -> 1
    | others ->
      List.iter (take_outcome x place) others;
      1 + List.length others
  end

let take_ends x place step =
  let outcome = outcome x place step in
  let ends = List.filter Memoised_steps.ends_run (outcome :: outcome.others) in
  List.iter (take_outcome x place) ends;
  List.length ends

(* {1 Inputs} *)

let program t = Components.program t.components

let upcoming t shared =
  if t.options.inputs = [] then Footprint.empty
  else
    match By_number.find_opt t.upcoming shared with
    | Some known -> known
    | None ->
      let outside = Encoding.outside t.encoding shared and program = program t in
      let found = Footprint.of_posts program (Environment.upcoming t.options program outside) in
      By_number.add t.upcoming shared found;
      found

let posted t shared =
  let { Surroundings.shared; outside } = Surroundings.Numbers.value (Encoding.shareds t.encoding) shared in
  let post (k, x, outside) =
    let number = Surroundings.Numbers.number (Encoding.shareds t.encoding) in
    let after = number (Surroundings.make (Shared.post k x shared) outside) in
    (after, Observer.of_event t.observer (Input (k, x)))
  in
  List.map post (Environment.inputs t.options (program t) outside)

let inputs x =
  let t = x.expansion in
  if t.options.inputs = [] then 0
  else begin
    let found =
      match By_number.find_opt t.posted x.shared with
      | Some known -> known
      | None ->
        let found = posted t x.shared in
        By_number.add t.posted x.shared found;
        Encoding.check_fit t.encoding;
        found
    in
    List.iter (fun (shared, action) -> share x ~action shared) found;
    List.length found
  end

(* {1 Interruptions} *)

let recruits x =
  if (program x.expansion).recruits then Residual.recruits (fst (Encoding.executing x.layout x.key)) else []

let ensured x =
  if Components.ensures x.expansion.components then Residual.ensured (fst (Encoding.executing x.layout x.key)) else []

let interruption x =
  let t = x.expansion in
  let { Surroundings.shared; outside } = Surroundings.Numbers.value (Encoding.shareds t.encoding) x.shared in
  let shared = Shared.ensure (ensured x) shared in
  let number, ending =
    match Transition.on_interrupt ~recruits:(recruits x) (program t) shared x.layout.frame.machine with
    | Some next -> (Encoding.script_number t.encoding [ On_interrupt ] next outside, None)
    | None ->
      let after = Surroundings.Numbers.number (Encoding.shareds t.encoding) (Surroundings.make shared outside) in
      (concluded x after (Ends Interrupted), Some Configuration.Interrupted)
  in
  (number, Observer.of_event t.observer ?ending Interrupt)

let interrupt x =
  let t = x.expansion in
  if not (Environment.may_interrupt t.options x.layout.frame.machine) then 0
  else begin
    let number, action =
      match By_number.find_opt t.interrupted x.shared with
      | Some known -> known
      | None ->
        let found = interruption x in
        (* It depends on the recruited vehicles, too, and on ensured deeds. *)
        let depends = (program t).recruits || Components.ensures t.components in
        if not depends then By_number.add t.interrupted x.shared found;
        found
    in
    visit_script t x.visitor number ~action;
    1
  end
