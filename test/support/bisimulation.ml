open Dolphin_semantics

(* Both graphs as one: by state, how it ended and its edges by label. *)
type node = { ended : string; edges : (string * int) list }

let ended (c : Configuration.t) =
  match c.control with
  | Ended Completed -> "completed"
  | Ended (Halted message) -> "halted " ^ message
  | Ended (Failed fault) -> "failed " ^ fault.message
  | Ended Interrupted -> "interrupted"
  | Script _ | Waiting _ | Executing _ -> ""

let nodes offset (g : Graph.t) =
  let edge ((t : Transition.t), target) = (Format.asprintf "%a" Label.pp t.label, offset + target) in
  Array.mapi (fun i c -> { ended = ended c; edges = List.map edge g.edges.(i) }) g.states

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

(* Splits classes until no split is left: states stay together if they ended alike and have the same labels to the same
   classes. *)
let refine nodes =
  let rec again (classes, count) =
    let signature i n =
      (classes.(i), List.sort_uniq compare (List.map (fun (l, target) -> (l, classes.(target))) n.edges))
    in
    let finer, count' = numbering (Array.mapi (fun i n -> Digest.string (Marshal.to_string (signature i n) [ No_sharing ])) nodes) in
    if count' = count then (classes, count) else again (finer, count')
  in
  again (numbering (Array.map (fun n -> n.ended) nodes))

let equivalent a b =
  let first = nodes 0 a in
  let offset = Array.length first in
  let classes, _ = refine (Array.append first (nodes offset b)) in
  classes.(0) = classes.(offset)

let classes a = snd (refine (nodes 0 a))
