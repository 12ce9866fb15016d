open Dolphin_semantics
open Part

module Numbered = Hashtbl.Make (struct
    type t = int * int

    let equal (a, b) (a', b') = Int.equal a a' && Int.equal b b'
    let hash (a, b) = ((a * 65599) + b) * 65599 land max_int
  end)

type t = {
  parts : Parts.t;
  kinds : int Numbered.t;  (* of parts, by symmetry, family and place there *)
  parts_of_kinds : part Numbered.t;  (* by symmetry and kind *)
}

let create parts = { parts; kinds = Numbered.create 64; parts_of_kinds = Numbered.create 64 }

let kind_of t g (part : part) =
  let key = ((Symmetry.number g lsl 31) lor part.family.number, part.local) in
  match Numbered.find_opt t.kinds key with
  | Some kind -> kind
  | None ->
    let kind = Symmetry.kind g part.residual in
    Numbered.add t.kinds key kind;
    kind

let reach coverage = function
  | Alike.Task site -> Coverage.reach coverage site
  | Code id -> Coverage.reach_code coverage id

(* What a part of a state begins, those that the state stands for begin as well. *)
let reach_alike t g (part : part) =
  let reach label = List.iter (reach (Parts.coverage t.parts)) (Symmetry.together g label) in
  let step (step : Residual.step) =
    match step.offer with
    | Start (p, _) -> reach (Alike.Task p.task_site)
    | Perform c | Check c | Measure c -> reach (Alike.Code c.lambda.id)
    | End_of _ | Expiry_of _ -> ()
  in
  Seq.iter step (Residual.steps part.residual)

let part_of_kind t g kind =
  let key = (Symmetry.number g, kind) in
  match Numbered.find_opt t.parts_of_kinds key with
  | Some part -> part
  | None -> (
      match Parts.children t.parts (Parts.root t.parts) (Symmetry.residual g kind) with
      | [ Leaf part ] ->
        reach_alike t g part;
        Numbered.add t.parts_of_kinds key part;
        part
      | _ -> invalid_arg "Space.part_of_kind: no part")

let kinds t g (s : Shape.t) key = Array.init (Array.length s.families) (fun i -> kind_of t g (Words.part s key i))

(* Few shapes are enough if parts stand in an order of their families. *)
let by_family (a : part) (b : part) =
  match Int.compare a.family.number b.family.number with 0 -> Int.compare a.local b.local | order -> order

let write t words key frame g (state : Symmetry.state) =
  let parts = List.map (part_of_kind t g) (Array.to_list state.kinds) in
  let leaves = List.map (fun part -> Leaf part) (List.sort by_family parts) in
  Words.write_parts words key frame leaves state.shared
