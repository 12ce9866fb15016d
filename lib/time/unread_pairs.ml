open Dolphin_semantics
open Core
module Names = Set.Make (String)

type use = { posted : Names.t; read : Names.t; reads_any : bool }

let note use { node; _ } =
  let read found = function
    | Some key -> { found with read = Names.add key found.read }
    | None -> { found with reads_any = true }
  in
  let posted found key = { found with posted = Names.add key found.posted } in
  match node with
  | Apply (Builtin (Poll [] | Values_of), [ { node = Constant (String key); _ } ]) -> read use (Some key)
  | Apply (Builtin (Poll [] | Values_of), _) -> read use None
  | Apply (Builtin (Poll keys | Consume keys), _) -> List.fold_left read use keys
  | Apply (Builtin (Post keys), _) -> List.fold_left posted use (List.filter_map Fun.id keys)
  | Apply (Builtin (Make_ensure forms), _) ->
    List.fold_left posted use (List.filter_map (function Pair_of key -> key | _ -> None) forms)
  | _ -> use

let keys (p : program) =
  let use = ref { posted = Names.of_list p.inputs; read = Names.empty; reads_any = false } in
  Code_walk.iter (fun e -> use := note !use e) (Code_walk.pieces p);
  let { posted; read; reads_any } = !use in
  if reads_any then [] else Names.elements (Names.diff posted read)
