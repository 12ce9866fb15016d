open Dolphin_semantics
open Dolphin_ltl

module By_running = Hashtbl.Make (struct
    type t = int

    let equal = Int.equal
    let hash running = running
  end)

type t = {
  letters : Valuation.t;
  monitor : Monitor.t;
  questions : (string * string option) list;  (* which plans run *)
  mutable wholes : int array;  (* what holds in configurations that execute nothing, by number; -1 if not known *)
  executing : int array ref By_running.t;  (* what holds in others: by answers to the questions, by shared number *)
}

let create program world f =
  let propositions = Temporal.propositions f in
  let letters = Valuation.create program world propositions in
  let automaton = Automaton.of_formula (Formula.Not (Temporal.formula f)) in
  {
    letters;
    monitor = Monitor.create ~holds:(Valuation.holds letters) automaton;
    questions = List.sort_uniq Stdlib.compare (List.concat_map Proposition.running (Array.to_list propositions));
    wholes = [||];
    executing = By_running.create 16;
  }

let monitor t = t.monitor
let letters t = t.letters

(* {1 What holds in states} *)

let known values n = if n < Array.length values then Array.unsafe_get values n else -1

let with_known values n x =
  let values =
    if n < Array.length values then values else Array.append values (Array.make (max 64 (n + 1)) (-1))
  in
  values.(n) <- x;
  values

(* A bit for each question. *)
let runs t (p : Component.part) =
  let is_asked (task : Core.platform_task) v (plan, vehicle) =
    String.equal task.name plan && Option.fold ~none:true ~some:(String.equal v) vehicle
  in
  let answer bits (Task_rules.Step { offer; _ }) =
    match offer with
    | End_of (task, v) ->
      let bit i question = if is_asked task v question then 1 lsl i else 0 in
      List.fold_left ( lor ) bits (List.mapi bit t.questions)
    | Start _ | Perform _ | Check _ | Measure _ | Expiry_of _ -> bits
  in
  Seq.fold_left answer 0 (Task_rules.steps p.residual)

let running t (s : Layout.t) key =
  if t.questions = [] then 0
  else begin
    let all = ref 0 in
    for i = 0 to Array.length s.families - 1 do
      let p = Encoding.part s key i in
      if p.runs < 0 then p.runs <- runs t p;
      all := !all lor p.runs
    done;
    !all
  end

let state t words key =
  let shapes = Encoding.shapes words in
  let number = Layouts.number shapes key.(0) and above = Layouts.shared shapes key.(0) in
  let look () = Valuation.state t.letters (fst (Encoding.read words key)) in
  if number = 0 then begin
    if known t.wholes above < 0 then t.wholes <- with_known t.wholes above (look ());
    t.wholes.(above)
  end
  else begin
    let running = running t (Layouts.shape shapes number) key in
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

let letter t words action key =
  Valuation.letter t.letters action (if Valuation.asks_states t.letters then state t words key else 0)
