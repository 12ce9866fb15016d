open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker

module Machines = Interner.Make (struct
    type t = Machine.t

    let equal a b = Machine.compare a b = 0
    let hash m = Machine.hash m land max_int
  end)

module Scripts = Interner.Make (struct
    type t = Configuration.t * Environment.t

    let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'
    let hash (c, e) = (Configuration.hash c + Environment.hash e) land max_int
  end)

type t = {
  components : Components.t;
  program : Core.program;
  shareds : Surroundings.Numbers.t;
  layouts : Layouts.t;
  machines : Machines.t;
  find_symmetry : Residual.t -> Surroundings.t -> Task_group.t option;
  canonical : Configuration.t -> Environment.t -> Configuration.t * Environment.t;
  frames : (int * int, Layout.frame) Hashtbl.t;  (* by numbers of the machine and of the symmetry, 0 for none *)
  scripts : Scripts.t;
  mutable broken : Property.t option array;  (* by number of the configuration *)
}

let create
    ?spare_bits ?(find_symmetry = fun _ _ -> None) ?(canonical = fun c outside -> (c, outside)) components
    shareds program
  =
  {
    components;
    program;
    find_symmetry;
    canonical;
    shareds;
    layouts = Layouts.create ?spare_bits components;
    machines = Machines.create (Components.numbering components);
    frames = Hashtbl.create 16;
    scripts = Scripts.create (Components.numbering components);
    broken = [||];
  }

let layouts t = t.layouts
let shareds t = t.shareds
let outside t n = (Surroundings.Numbers.value t.shareds n).Surroundings.outside
let count_shareds t = Surroundings.Numbers.count t.shareds
let check_fit t = if not (Layouts.fits t.layouts ~shared:(count_shareds t)) then raise Layouts.Outgrown
let widen t ~reserved = Layouts.widen t.layouts ~reserved ~shared:(count_shareds t)

(* {1 Configurations that execute nothing} *)

let script t number = Scripts.value t.scripts number
let broken t number = t.broken.(number)

(* Of the canonical form [c] with [outside]. *)
let canonical_number t rules c outside =
  let known = Scripts.count t.scripts in
  let number = Scripts.number t.scripts (c, outside) in
  if number = known then begin
    if number = Array.length t.broken then t.broken <- Array.append t.broken (Array.make (max 8 number) None);
    t.broken.(number) <- Property.broken_by_end t.program rules c
  end;
  number

let script_number t rules c outside =
  let c, outside = t.canonical c outside in
  canonical_number t rules c outside

let clear key = Array.fill key 0 (Array.length key) 0

let write_script t key number =
  clear key;
  key.(0) <- Layouts.first t.layouts 0 number

(* {1 Executing configurations} *)

let frame t machine symmetry =
  let key = (Machines.number t.machines machine, Option.fold ~none:0 ~some:Task_group.number symmetry) in
  match Hashtbl.find_opt t.frames key with
  | Some frame -> frame
  | None ->
    Numbering.give (Components.numbering t.components);
    let frame : Layout.frame = { number = Hashtbl.length t.frames; machine; symmetry } in
    Hashtbl.add t.frames key frame;
    frame

let family (p : Component.component) = p.family

let write_components t key frame children shared =
  let layout = Layouts.find t.layouts frame (List.map (Component.map family) children) in
  check_fit t;
  clear key;
  key.(0) <- Layouts.first t.layouts layout.number shared;
  List.iteri
    (fun i (p : Component.component) -> Layout.put layout key i p.local)
    (List.concat_map Component.leaves children)

let write t key rules c outside =
  let (c : Configuration.t), outside = t.canonical c outside in
  match c.control with
  | Script _ | Waiting _ | Ended _ ->
    let number = canonical_number t rules c outside in
    write_script t key number;
    number
  | Executing (m, r) ->
    let surroundings = Surroundings.make c.shared outside in
    let frame = frame t m (t.find_symmetry r surroundings) in
    let children = Components.children t.components (Components.root t.components) r in
    write_components t key frame children (Surroundings.Numbers.number t.shareds surroundings);
    -1 - frame.number

(* {1 Reading} *)

let component (layout : Layout.t) key i =
  let family = Array.unsafe_get layout.families i in
  family.members.(Layout.local layout key i)

let residual layout key place = Layout.residual layout place (fun i -> (component layout key i).residual)

let executing (layout : Layout.t) key : Residual.t * Core.platform_task Vehicle_map.t =
  let rs = List.map (residual layout key) layout.top in
  let runs allocation (Task_rules.Step { offer; _ }) =
    match offer with
    | End_of (p, v) -> Vehicle_map.add v p allocation
    | Start _ | Perform _ | Check _ | Guard_false _ | Guard_either _ | Guard_values _ | Measure _ | Make _ | Allocate _
    | Expiry_of _ | Answer_to _ | Recruit_for _ -> allocation
  in
  let of_position allocation i = Seq.fold_left runs allocation (Task_rules.steps (component layout key i).residual) in
  let positions = List.init (Array.length layout.families) Fun.id in
  (Residual.parallel rs, List.fold_left of_position Vehicle_map.empty positions)

let read t key =
  let number = Layouts.number t.layouts key.(0) and above = Layouts.shared t.layouts key.(0) in
  if number = 0 then Scripts.value t.scripts above
  else begin
    let layout = Layouts.layout t.layouts number in
    let { Surroundings.shared; outside } = Surroundings.Numbers.value t.shareds above in
    let r, allocation = executing layout key in
    ({ control = Executing (layout.frame.machine, r); shared = { shared with allocation } }, outside)
  end
