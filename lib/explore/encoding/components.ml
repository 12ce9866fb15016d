open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Component

(* A guard is known by its code, and by whether the code's value matters. *)
module Guards = Hashtbl.Make (struct
    type t = bool * Core.closure

    let equal (check, c) (check', c') = check = check' && Value.compare_closure c c' = 0
    let hash (check, c) = (2 * Value.hash_closure c) + Bool.to_int check
  end)

type t = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  root : path;
  guards : guard Guards.t;
  numbering : Numbering.t;
  coverage : Coverage.t;
  context : Step_footprints.context;
  holding : Step_footprints.context;
  dismisses : bool;
  ensures : bool;
  foreseen : int;
  mutable paths : int;
  mutable families : int;
  mutable serial : int;
  mutable goes_round : bool;
  mutable outgrown : bool;
}

(* Stands for the inside where contexts are compared. *)
let hole = Residual.hole

let may_renew : Residual.context -> bool = function
  | Round_of { left = None; _ } | In_watch { anew = Some _; _ } -> true
  | Round_of _ | In_watch _ | In_sequence _ | Branch_of _ | Body_until _ | Body_during _ | Holding _ | In_recruited _
  | With_keys _ | Ensuring _ -> false

let new_path id contexts outer body =
  let components = Residuals.create 16 and inner = Residuals.create 1 in
  { id; contexts; outer; body; components; inner; cuts = None;
    makes = Residual.makes_tasks (Residual.plug contexts hole); renews = List.exists may_renew contexts;
    cut_footprints = None }

let create ?(foreseen = 2_048) numbering options program world =
  let context = Step_footprints.context options program in
  {
    options;
    program;
    world;
    root = new_path 0 [] None hole;
    guards = Guards.create 64;
    numbering;
    coverage = Coverage.create ();
    context;
    holding = Step_footprints.with_holding context;
    dismisses = Footprint.dismisses program;
    ensures = Footprint.all_ensured program <> None;
    foreseen;
    paths = 1;
    families = 0;
    serial = 0;
    goes_round = false;
    outgrown = false;
  }

let options t = t.options
let dismisses t = t.dismisses
let ensures t = t.ensures
let program t = t.program
let world t = t.world
let coverage t = t.coverage
let root t = t.root
let goes_round t = t.goes_round
let set_goes_round t = t.goes_round <- true
let note_rounds t rounds = if rounds <> [] then t.goes_round <- true

(* {1 Trees} *)

let around path r = Residual.plug path.contexts r

let outside path =
  match path.outer with Some outer -> outer | None -> invalid_arg "Components.outside: the root"

let inner t path contexts body =
  let key = Residual.plug contexts hole in
  match Residuals.find_opt path.inner key with
  | Some inside -> inside
  | None ->
    Numbering.give t.numbering;
    let inside = new_path t.paths contexts (Some path) body in
    t.paths <- t.paths + 1;
    Residuals.add path.inner key inside;
    inside

(* Whatever stands in contexts, they are cut in the same ways. *)
let in_contexts t path contexts = inner t path contexts (Residual.Parallel (Branches.of_list [ hole; hole ]))

let rec child t path r =
  match Residual.decompose r with
  | (_ :: _ as contexts), (Residual.Parallel bs as body) ->
    let inside = inner t path contexts body in
    Nest (inside, List.map (child t inside) (Branches.to_list bs))
  | _, _ -> Leaf r

let tree t path (r : Residual.t) =
  match r with Parallel bs -> List.map (child t path) (Branches.to_list bs) | r -> [ child t path r ]

(* {1 Families} *)

let bits_for size =
  let rec from bits = if 1 lsl bits >= size then bits else from (bits + 1) in
  from 1

let lay_out family = family.width <- bits_for family.size
let numbering t = t.numbering
let outgrown t = t.outgrown
let none_outgrown t = t.outgrown <- false

let member t path family residual =
  Numbering.give t.numbering;
  let p =
    { residual; path; family; local = family.size; makes_tasks = Residual.makes_tasks residual;
      steps = [||]; worked_out = None; alone = None;
      footprints = None }
  in
  if family.size = Array.length family.members then begin
    let longer = Array.make (max 8 (2 * family.size)) p in
    Array.blit family.members 0 longer 0 family.size;
    family.members <- longer
  end;
  family.members.(family.size) <- p;
  family.size <- family.size + 1;
  if family.width > 0 && family.size > 1 lsl family.width then t.outgrown <- true;
  Residuals.add path.components residual p;
  p

let new_family t =
  Numbering.give t.numbering;
  t.families <- t.families + 1;
  { number = t.families - 1; members = [||]; size = 0; width = 0 }

let guard t check closure =
  match Guards.find_opt t.guards (check, closure) with
  | Some guard -> guard
  | None ->
    let guard = { results = [||]; actions = [||] } in
    Guards.add t.guards (check, closure) guard;
    guard

(* {1 Steps} *)

let rec nests path = match path.outer with Some outer -> path.contexts :: nests outer | None -> []

let rec component t path residual =
  match Residuals.find_opt path.components residual with
  | Some p -> p
  | None ->
    let family = new_family t in
    let p = member t path family residual in
    let rec foresee i =
      if i < family.size && i < t.foreseen then begin
        ignore (work_out t family.members.(i));
        foresee (i + 1)
      end
    in
    foresee 0;
    p

and grown t path = function
  | Leaf r -> Leaf (component t path r)
  | Nest (inside, children) -> Nest (inside, List.map (grown t inside) children)

and becomes t path tree =
  let children = List.map (grown t path) tree in
  t.serial <- t.serial + 1;
  Becomes { serial = t.serial; children; components = Array.of_list (List.concat_map leaves children) }

and target_of t path family residual =
  match tree t path residual, family with
  | [ Leaf r ], Some family -> (
      match Residuals.find_opt path.components r with
      | Some p when p.family == family -> Stays p.local
      | Some _ -> becomes t path [ Leaf r ]
      | None -> Stays (member t path family r).local)
  | tree, _ -> becomes t path tree

(* Steps that go on in one way, whatever is shared, are settled here; the others per shared state, by
   {!Memoised_steps}. *)
and compile ?cut_of t home kin index (Step { offer; continue; _ } as source : Task_rules.step) =
  let looks = Step_footprints.looks t.context (Task_rules.escaping (nests home) source) in
  let cuts = t.ensures && (kin = None || Task_rules.broken source (Fault.make Fault.unknown_site "") <> None) in
  let dependent event =
    { index; source; looks = looks || cuts; looked = None; event; home; kin; cut_of; dependence = Dependent;
      successor = Gone; begins = []; free_action = -1; outcomes = [||] }
  in
  let certain event dependence change =
    let begins = (change : Task_rules.change).rounds in
    let settled successor = { (dependent event) with dependence; successor; begins } in
    note_rounds t begins;
    match change.outcome with
    | (Next _ | Finished) when Task_rules.changes_shared change || (t.ensures && kin = None) -> dependent event
    | Next r -> settled (target_of t home kin r)
    | Finished -> settled Gone
    | Failed _ | Handling _ -> dependent event
  in
  match offer with
  | Start _ -> [ certain None Free (continue ()) ]
  | Perform _ when looks -> [ dependent None ]
  | Check _ when looks -> [ dependent None ]
  | Perform closure -> [ certain None (Guarded (guard t false closure)) (continue (Ok [])) ]
  | Check closure -> [ certain None (Guarded (guard t true closure)) (continue (Ok [])) ]
  | Guard_values _ | Guard_false _ | Guard_either _ | Measure _ | Make _ | Allocate _ -> [ dependent None ]
  | Recruit_for (number, asked) ->
    let come v = dependent (Some (Transition.Recruited (number, v))) in
    List.map come (Fit.wherever t.world (Shared.initial t.program) asked)
  | Expiry_of timer -> [ certain (Some (Timer_expired timer)) Free (continue ()) ]
  | Answer_to (question, prompt) ->
    let on_reply reply = certain (Some (Transition.Confirmed (question, reply))) Free (continue reply) in
    List.map on_reply (Environment.confirmations t.options prompt)
  | End_of (task, v) ->
    let on_event (event, _) =
      match event with
      | Transition.Vehicle_done _ when not (Environment.endings_remember t.options) ->
        certain (Some event) Free (continue (Ok ()))
      | event -> dependent (Some event)
    in
    List.map on_event (Environment.task_ends t.options Environment.initial v task)

and work_out t p =
  match p.worked_out with
  | Some steps -> steps
  | None ->
    let compiled = List.mapi (compile t p.path (Some p.family)) (List.of_seq (Task_rules.steps p.residual)) in
    let steps = Array.of_list (List.concat compiled) in
    p.worked_out <- Some steps;
    steps

let children t path r = List.map (grown t path) (tree t path r)

(* Code of a component that is reached is run, whatever comes of it. *)
let cover t steps =
  let step { source = Step { offer; _ }; _ } =
    match offer with
    | Start (task, _) -> Coverage.start t.coverage task
    | Perform c -> Coverage.run t.coverage c
    | Check c -> Coverage.run t.coverage c
    | Guard_false c -> Coverage.run t.coverage c
    | Guard_either c -> Coverage.run t.coverage c
    | Guard_values c -> Coverage.run t.coverage c
    | Measure c -> Coverage.run t.coverage c
    | Make (c, _, _) -> Coverage.run t.coverage c
    | Allocate _ | End_of _ | Expiry_of _ | Answer_to _ | Recruit_for _ -> ()
  in
  Array.iter step steps

let reach t p =
  let steps = work_out t p in
  cover t steps;
  p.steps <- steps

(* {1 Footprints} *)

let escaping ?owed step =
  match owed with
  | None -> Task_rules.escaping (nests step.home) step.source
  | Some { inside; beside } ->
    let source =
      match step.cut_of with
      | Some path -> List.nth (Task_rules.cuts path.contexts (Residual.ensuring inside hole)) step.index
      | None -> step.source
    in
    Task_rules.escaping ~beside (nests step.home) source

let footprint_step step : Step_footprints.step =
  { index = step.index; source = escaping step; event = step.event }

let context t ~makes = if makes then t.holding else t.context

let footprints t ~makes p =
  match p.footprints with
  | Some (makes', footprints) when makes = makes' -> footprints
  | Some _ | None ->
    let steps = Array.map footprint_step (work_out t p) in
    let footprints = Step_footprints.of_component (context t ~makes) (nests p.path) p.residual steps in
    p.footprints <- Some (makes, footprints);
    footprints

(* {1 Nests} *)

let cuts t path =
  match path.cuts with
  | Some cuts -> cuts
  | None ->
    (* The ensured deeds inside are not known. *)
    let body = if t.ensures then hole else path.body in
    let compiled = List.mapi (compile ~cut_of:path t (outside path) None) (Task_rules.cuts path.contexts body) in
    let cuts = Array.of_list (List.concat compiled) in
    cover t cuts;
    path.cuts <- Some cuts;
    cuts

let cut_footprints t ~makes path =
  match path.cut_footprints with
  | Some (makes', footprints) when makes = makes' -> footprints
  | Some _ | None ->
    let footprints = Step_footprints.of_cuts (context t ~makes) (nests path) (Array.map footprint_step (cuts t path)) in
    path.cut_footprints <- Some (makes, footprints);
    footprints

let alone t p =
  match p.alone with
  | Some target -> target
  | None ->
    let home = outside p.path in
    let target = becomes t home (tree t home (around p.path p.residual)) in
    p.alone <- Some target;
    target

let landed t step level r =
  let rec up path n = if n = 0 then path else up (outside path) (n - 1) in
  let home = up step.home level in
  target_of t home (if level = 0 then step.kin else None) r
