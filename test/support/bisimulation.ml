open Dolphin_semantics

(* Both graphs as one: by state, the visible part of it, its ending among others, and its edges by label. *)
type node = { seen : string; edges : (string * int) list }

let ended (c : Configuration.t) =
  match c.control with
  | Ended Completed -> "completed"
  | Ended (Halted message) -> "halted " ^ message
  | Ended (Failed fault) -> "failed " ^ fault.message
  | Ended Interrupted -> "interrupted"
  | Script _ | Waiting _ | Executing _ -> ""

let shared (c : Configuration.t) =
  let variable ppf (i, x) = Format.fprintf ppf "%d=%a" i Value.pp x in
  let running ppf (v, (p : Core.platform_task)) = Format.fprintf ppf "%s->%s" v p.name in
  Format.asprintf "%a; %a; %a; %a" (Fmt.list variable) (Store.bindings c.shared.store) (Fmt.list running)
    (Vehicle_map.bindings c.shared.allocation) (Fmt.list Fmt.string) c.shared.bound Tuples.pp c.shared.tuples

let spelt l = Format.asprintf "%a" Label.pp l

let nodes named observed offset (g : Graph.t) =
  let edge ((t : Transition.t), target) = (named t.label, offset + target) in
  Array.mapi (fun i c -> { seen = ended c ^ "; " ^ observed c; edges = List.map edge g.edges.(i) }) g.states

(* Numbers for equal things. *)
let numbering signatures =
  let numbers = Hashtbl.create 256 in
  let number x =
    match Hashtbl.find_opt numbers x with
    | Some i -> i
    | None ->
      let i = Hashtbl.length numbers in
      Hashtbl.replace numbers x i;
      i
  in
  let classes = Array.map number signatures in
  (classes, Hashtbl.length numbers)

(* Splits classes until no split is left: states stay together if they look alike and have the same labels to the same
   classes. *)
let refine nodes =
  let rec again (classes, count) =
    let signature i n =
      (classes.(i), List.sort_uniq compare (List.map (fun (l, target) -> (l, classes.(target))) n.edges))
    in
    let finer, count' =
      numbering (Array.mapi (fun i n -> Digest.string (Marshal.to_string (signature i n) [ No_sharing ])) nodes)
    in
    if count' = count then (classes, count) else again (finer, count')
  in
  again (numbering (Array.map (fun n -> n.seen) nodes))

let nothing _ = ""

let equivalent ?(named = spelt) ?(observed = nothing) a b =
  let first = nodes named observed 0 a in
  let offset = Array.length first in
  let classes, _ = refine (Array.append first (nodes named observed offset b)) in
  classes.(0) = classes.(offset)

let classes a = snd (refine (nodes spelt nothing 0 a))

(* {1 Weakly} *)

let is_seen : Label.t -> bool = function
  | Start _ | Done _ | Fail _ -> true
  | Check _ | Act _ | Cut _ | Time_out | Set_time _ | Make | Allocate _ | Recruit _ | Broken _ | Did _ | Silent | Pick _
  | Bind _ | No_vehicles _ | Ask _ | Answer _ | No_answer | Pause _ | Resume | Call _ | Reply _ | No_reply _ | Execute
  | Cannot_execute _ | End | Halt _ | Fault _ | Input _ | Interrupt -> false

(* Strong bisimilarity of the relation that any number of hidden steps, a visible step, and any number of hidden
   steps make. *)
let saturated offset (g : Graph.t) =
  let unseen ((t : Transition.t), s) = if is_seen t.label then None else Some s in
  let hidden = Array.map (List.filter_map unseen) g.edges in
  let closure first =
    let reached = Hashtbl.create 16 in
    let rec reach s =
      if not (Hashtbl.mem reached s) then begin
        Hashtbl.replace reached s ();
        List.iter reach hidden.(s)
      end
    in
    reach first;
    List.of_seq (Hashtbl.to_seq_keys reached)
  in
  let closures = Array.init (Array.length g.states) closure in
  let seen s = List.filter (fun ((t : Transition.t), _) -> is_seen t.label) g.edges.(s) in
  let node s =
    let silently = List.map (fun s' -> ("", offset + s')) closures.(s) in
    let is_end s' = ended g.states.(s') <> "" in
    let ends = List.map (fun s' -> (ended g.states.(s'), offset + s')) (List.filter is_end closures.(s)) in
    let after ((t : Transition.t), s') = List.map (fun s'' -> (spelt t.label, offset + s'')) closures.(s') in
    let visibly = List.concat_map (fun s' -> List.concat_map after (seen s')) closures.(s) in
    { seen = ""; edges = List.sort_uniq compare (silently @ ends @ visibly) }
  in
  Array.init (Array.length g.states) node

let weakly_equivalent a b =
  let first = saturated 0 a in
  let offset = Array.length first in
  let classes, _ = refine (Array.append first (saturated offset b)) in
  classes.(0) = classes.(offset)
