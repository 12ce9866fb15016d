open Dolphin_semantics
open Dolphin_ltl

module By_running = Hashtbl.Make (struct
    type t = int

    let equal = Int.equal
    let hash running = running
  end)

type t = {
  valuations : Valuation.t;
  monitor : Monitor.t;
  asks_running : bool;  (* functions that formulas may call ask which vehicles run a task *)
  questions : (string * string option) list;  (* which plans run *)
  mutable scripts : int array;  (* of configurations that execute nothing, by number; -1 if not known *)
  executing : int array ref By_running.t;  (* of the others: by answers to the questions, then by shared state *)
  mutable running : int array array;  (* the answers that a component gives, by family, then by number in it; or -1 *)
}

let create program world f =
  let propositions = Temporal.propositions f in
  let valuations = Valuation.create program world propositions in
  let automaton = Automaton.of_formula (Formula.Not (Temporal.formula f)) in
  {
    valuations;
    monitor = Monitor.create ~holds:(Valuation.holds valuations) automaton;
    asks_running = program.Core.asks_running;
    questions = List.sort_uniq Stdlib.compare (List.concat_map Proposition.running (Array.to_list propositions));
    scripts = [||];
    executing = By_running.create 16;
    running = [||];
  }

let monitor t = t.monitor
let valuations t = t.valuations

(* {1 Memoised numbers} *)

let known values n = if n < Array.length values then Array.unsafe_get values n else -1
let grown values n none = Array.append values (Array.make (max 64 (n + 1)) none)

let with_known values n x =
  let values = if n < Array.length values then values else grown values n (-1) in
  values.(n) <- x;
  values

(* {1 Which plans run} *)

(* A bit for each question. *)
let answers t (p : Component.component) =
  let is_asked (task : Core.platform_task) v (plan, vehicle) =
    String.equal task.name plan && Option.fold ~none:true ~some:(String.equal v) vehicle
  in
  let answer bits (Task_rules.Step { offer; _ }) =
    match offer with
    | End_of (task, v) ->
      let bit i question = if is_asked task v question then 1 lsl i else 0 in
      List.fold_left ( lor ) bits (List.mapi bit t.questions)
    | Start _ | Perform _ | Check _ | Guard_false _ | Guard_either _ | Guard_values _ | Measure _ | Make _ | Allocate _
    | Expiry_of _ | Answer_to _ | Recruit_for _ -> bits
  in
  Seq.fold_left answer 0 (Task_rules.steps p.residual)

let running_in t (p : Component.component) =
  let family = p.family.number in
  if family >= Array.length t.running then t.running <- grown t.running family [||];
  if known t.running.(family) p.local < 0 then
    t.running.(family) <- with_known t.running.(family) p.local (answers t p);
  t.running.(family).(p.local)

let running t (layout : Layout.t) key =
  if t.questions = [] then 0
  else begin
    let all = ref 0 in
    for i = 0 to Array.length layout.families - 1 do
      all := !all lor running_in t (Encoding.component layout key i)
    done;
    !all
  end

(* {1 Valuations} *)

let state t encoding key =
  let layouts = Encoding.layouts encoding in
  let number = Layouts.number layouts key.(0) and above = Layouts.shared layouts key.(0) in
  let look () = Valuation.state t.valuations (fst (Encoding.read encoding key)) in
  if number = 0 then begin
    if known t.scripts above < 0 then t.scripts <- with_known t.scripts above (look ());
    t.scripts.(above)
  end
  else if t.asks_running then look ()
  else begin
    let running = running t (Layouts.layout layouts number) key in
    let values =
      match By_running.find_opt t.executing running with
      | Some values -> values
      | None ->
        let values = ref [||] in
        By_running.add t.executing running values;
        values
    in
    if known !values above < 0 then values := with_known !values above (look ());
    !values.(above)
  end

let observer t : Observer.t =
  let valuation encoding action key =
    Valuation.valuation t.valuations action (if Valuation.asks_states t.valuations then state t encoding key else 0)
  in
  { action = Valuation.action_observed t.valuations; valuation }
