open Core
open Dolphin_syntax

type t = { name : string; calls : Location.t list }

let location program site =
  if site >= 0 && site < Array.length program.locations then Some program.locations.(site) else None

let is_in_prelude program site =
  match location program site with Some at -> String.equal (Location.file at) Prelude.file | None -> false

(* The code of a function and of the closures in it, without the functions that it calls. *)
let rec has site e =
  e.site = site
  ||
  match e.node with
  | Make_closure (lambda, _) -> has site lambda.code
  | _ -> List.exists (has site) (Code_walk.parts e)

let reaches lambda site =
  let found = ref false in
  Code_walk.iter_within (fun _ e -> if e.site = site then found := true) [ lambda ];
  !found

let by_text a b =
  let key at = (Location.file at, Location.line at, Location.column at) in
  Stdlib.compare (key a) (key b)

let calls program site =
  let found = ref [] in
  let refer lambda at =
    if (not (is_in_prelude program at)) && is_in_prelude program lambda.lambda_site && reaches lambda site then
      found := Option.to_list (location program at) @ !found
  in
  (* A function is called, or handed over as a value. *)
  let value a = match a.node with Constant (Closure { lambda; _ }) -> refer lambda a.site | _ -> () in
  Code_walk.iter
    (fun e ->
       match e.node with
       | Apply (Call _, { node = Constant (Closure { lambda; _ }); _ } :: arguments) ->
         refer lambda e.site;
         List.iter value arguments
       | _ -> List.iter value (Code_walk.parts e))
    (Code_walk.pieces program);
  List.sort_uniq by_text !found

let to_site program site =
  if not (is_in_prelude program site) then None
  else
    let holds (_, lambda) = is_in_prelude program lambda.lambda_site && has site lambda.code in
    Option.map (fun (name, _) -> { name; calls = calls program site }) (List.find_opt holds program.functions)
