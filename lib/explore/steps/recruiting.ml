open Dolphin_semantics

type t = {
  vehicles : Canonical_vehicles.t;
  encoding : Encoding.t;
  outside_of_task : (int * int, Vehicle_set.t) Hashtbl.t;  (* by frame and shared state *)
  in_component : (int * int, Vehicle_set.t) Hashtbl.t;  (* by family, and number in the family *)
  in_contexts : (int, Vehicle_set.t) Hashtbl.t;  (* of a nest, by its path *)
  numbering : Dolphin_checker.Numbering.t;
  turns : (Residual.timer, int) Hashtbl.t;
  mutable last : (Expansion.source * Vehicle_set.t) option;  (* the vehicles named in the state that is being
                                                                expanded *)
}

let create vehicles encoding numbering =
  { vehicles; encoding; numbering; outside_of_task = Hashtbl.create 64; in_component = Hashtbl.create 64;
    in_contexts = Hashtbl.create 16; turns = Hashtbl.create 16; last = None }

let memoised table key find =
  match Hashtbl.find_opt table key with
  | Some found -> found
  | None ->
    let found = Vehicle_set.of_list (find ()) in
    Hashtbl.add table key found;
    found

(* Everything outside the task: the machine, the store, B, N, and the environment's memory. *)
let outside_of_task t (x : Expansion.source) =
  let known () =
    let { Surroundings.shared; outside } = Surroundings.Numbers.value (Encoding.shareds t.encoding) x.shared in
    let c = { Configuration.control = Executing (x.layout.frame.machine, Residual.hole); shared } in
    Canonical_vehicles.known t.vehicles c outside
  in
  memoised t.outside_of_task (x.layout.frame.number, x.shared) known

let in_component t (p : Component.component) =
  memoised t.in_component (p.family.number, p.local) (fun () ->
      Canonical_vehicles.known_in_task t.vehicles p.residual)

let in_nest t (nest : Layout.place) =
  match nest.inside with
  | None -> Vehicle_set.empty
  | Some { id; contexts; _ } ->
    memoised t.in_contexts id (fun () ->
        Canonical_vehicles.known_in_task t.vehicles (Residual.plug contexts Residual.hole))

let known t (x : Expansion.source) =
  match t.last with
  | Some (x', known) when x' == x -> known
  | Some _ | None ->
    let of_component i _ = in_component t (Encoding.component x.layout x.key i) in
    let components = Array.mapi of_component x.layout.families and nests = Array.map (in_nest t) x.layout.nests in
    let union = Array.fold_left Vehicle_set.union in
    let known = union (union (outside_of_task t x) components) nests in
    t.last <- Some (x, known);
    known

(* Recruits side by side begin with different vehicles of an orbit. If each took the first that is free, they would come
   to have the same ones in all orders: states that differ in names only. *)
let turn t number =
  match Hashtbl.find_opt t.turns number with
  | Some turn -> turn
  | None ->
    Dolphin_checker.Numbering.give t.numbering;
    let turn = Hashtbl.length t.turns in
    Hashtbl.add t.turns number turn;
    turn

let follows t x (step : Component.step) =
  match step.source, step.event with
  | Step { offer = Recruit_for (number, asked); _ }, Some (Recruited (_, v)) ->
    let is_known u = Vehicle_set.mem u (known t x) in
    Canonical_vehicles.follows_recruit t.vehicles asked ~turn:(turn t number) ~is_known v
  | _, _ -> true
