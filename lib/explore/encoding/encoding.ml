open Dolphin_semantics
open Dolphin_environment

module Machines = Dolphin_checker.Interner.Make (struct
    type t = Machine.t

    let equal a b = Machine.compare a b = 0
    let hash m = Machine.hash m land max_int
  end)

module Wholes = Dolphin_checker.Interner.Make (struct
    type t = Configuration.t * Environment.t

    let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'
    let hash (c, e) = (Configuration.hash c + Environment.hash e) land max_int
  end)

type t = {
  parts : Components.t;
  shareds : Memoised_steps.Shareds.t;
  shapes : Layouts.t;
  machines : Machines.t;
  find_symmetry : Residual.t -> Surroundings.t -> Task_group.t option;
  canonical : Configuration.t -> Environment.t -> Configuration.t * Environment.t;
  frames : (int * int, Layout.frame) Hashtbl.t;  (* by numbers of the machine and of the symmetry, 0 for none *)
  wholes : Wholes.t;
  mutable breaks : Property.t option array;  (* by number of such a configuration: what reaching it breaks *)
}

let create ?(find_symmetry = fun _ _ -> None) ?(canonical = fun c outside -> (c, outside)) ?watched parts cases =
  {
    parts;
    find_symmetry;
    canonical;
    shareds = Memoised_steps.shareds cases;
    shapes = Layouts.create ?watched parts;
    machines = Machines.create ();
    frames = Hashtbl.create 16;
    wholes = Wholes.create ();
    breaks = [||];
  }

let shapes t = t.shapes
let check_fit t = if not (Layouts.fits t.shapes ~shared:(Memoised_steps.Shareds.count t.shareds)) then raise Layouts.Outgrown
let widened t ~watched = Layouts.widened t.shapes ~watched ~shared:(Memoised_steps.Shareds.count t.shareds)

(* {1 Configurations that execute nothing} *)

let value t number = Wholes.value t.wholes number
let broken t number = t.breaks.(number)
let count_wholes t = Wholes.count t.wholes

let whole t rules c outside =
  let known = Wholes.count t.wholes in
  let number = Wholes.number t.wholes (t.canonical c outside) in
  if number = known then begin
    if number = Array.length t.breaks then t.breaks <- Array.append t.breaks (Array.make (max 8 number) None);
    t.breaks.(number) <- Property.broken_by_end rules c
  end;
  number

let clear key = Array.fill key 0 (Array.length key) 0

let write_whole t key number =
  clear key;
  key.(0) <- Layouts.first t.shapes 0 number

(* {1 Words} *)

let frame t machine symmetry =
  let key = (Machines.number t.machines machine, Option.fold ~none:0 ~some:Task_group.number symmetry) in
  match Hashtbl.find_opt t.frames key with
  | Some frame -> frame
  | None ->
    let frame : Layout.frame = { frame = Hashtbl.length t.frames; machine; symmetry; over = [||] } in
    Hashtbl.add t.frames key frame;
    frame

let family (p : Component.part) = p.family

let write_parts t key frame children shared =
  let s = Layouts.find t.shapes frame (List.map (Component.map family) children) in
  check_fit t;
  clear key;
  key.(0) <- Layouts.first t.shapes s.number shared;
  List.iteri (fun i (p : Component.part) -> Layout.put s key i p.local) (List.concat_map Component.leaves children)

let write t key rules (c : Configuration.t) outside =
  match c.control with
  | Script _ | Waiting _ | Ended _ ->
    let number = whole t rules c outside in
    write_whole t key number;
    number
  | Executing (m, r) ->
    let surroundings = Surroundings.make c.shared outside in
    let frame = frame t m (t.find_symmetry r surroundings) in
    let children = Components.children t.parts (Components.root t.parts) r in
    write_parts t key frame children (Memoised_steps.Shareds.number t.shareds surroundings);
    -1 - frame.frame

let part (s : Layout.t) key i =
  let family = Array.unsafe_get s.families i in
  family.members.(Layout.local s key i)

let residual s key place = Layout.residual s place (fun i -> (part s key i).residual)

let executing (s : Layout.t) key : Residual.t * Core.platform_task Vehicle_map.t =
  let rs = List.map (residual s key) s.top in
  let runs allocation (Task_rules.Step { offer; _ }) =
    match offer with
    | End_of (p, v) -> Vehicle_map.add v p allocation
    | Start _ | Perform _ | Check _ | Measure _ | Expiry_of _ -> allocation
  in
  let of_position allocation i = Seq.fold_left runs allocation (Task_rules.steps (part s key i).residual) in
  let positions = List.init (Array.length s.families) Fun.id in
  (Residual.parallel rs, List.fold_left of_position Vehicle_map.empty positions)

let read t key =
  let number = Layouts.number t.shapes key.(0) and above = Layouts.shared t.shapes key.(0) in
  if number = 0 then Wholes.value t.wholes above
  else begin
    let s = Layouts.shape t.shapes number in
    let { Surroundings.shared; outside } = Memoised_steps.Shareds.value t.shareds above in
    let r, allocation = executing s key in
    ({ control = Executing (s.frame.machine, r); shared = { shared with allocation } }, outside)
  end
