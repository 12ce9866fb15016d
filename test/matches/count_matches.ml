(* Matches that list every constructor of a type of constructs, counted in the compiler's typed trees (cmt files) below
   the folders that are named. A new construct changes all of them, so a function that only traverses uses the views of
   [Residual], [Task] and [Code_walk] instead. Prints the number for each type, or with [--list] the places. The exit
   status is 1 if a number exceeds its limit. *)

(* The types, each with the largest number of such matches. *)
let limits =
  [ ("Residual.t", 16); ("Core.task", 10); ("Core.node", 13); ("Task_rules.offer", 21); ("Transition.event", 10) ]

(* [Dolphin_semantics__Residual] is [Residual]. *)
let plain name =
  let rec from i =
    if i < 0 then name
    else if i + 1 < String.length name && name.[i] = '_' && name.[i + 1] = '_' then
      String.sub name (i + 2) (String.length name - i - 2)
    else from (i - 1)
  in
  from (String.length name - 1)

(* Of a type, as its module and its name. *)
let type_name here = function
  | Path.Pident id -> here ^ "." ^ Ident.name id
  | Pdot (path, name) -> plain (Path.last path) ^ "." ^ name
  | Papply _ as path -> Path.name path

let found : (string, string) Hashtbl.t = Hashtbl.create 64

(* The constructors at the top of a pattern, each with its place in a tuple. *)
let rec heads : type k. int list -> k Typedtree.general_pattern -> (int list * Types.constructor_description) list =
  fun place p ->
  match p.pat_desc with
  | Tpat_construct (_, c, _, _) -> [ (place, c) ]
  | Tpat_or (a, b, _) -> heads place a @ heads place b
  | Tpat_alias (p, _, _) -> heads place p
  | Tpat_value p -> heads place (p :> Typedtree.value Typedtree.general_pattern)
  | Tpat_tuple ps -> List.concat (List.mapi (fun i p -> heads (i :: place) p) ps)
  | Tpat_any | Tpat_var _ | Tpat_constant _ | Tpat_variant _ | Tpat_record _ | Tpat_array _ | Tpat_lazy _
  | Tpat_exception _ -> []

let judge here (at : Location.t) heads =
  let of_type (c : Types.constructor_description) =
    match (Ctype.repr c.cstr_res).desc with Tconstr (path, _, _) -> type_name here path | _ -> ""
  in
  let all (name, _) =
    let heads = List.filter (fun (_, c) -> of_type c = name) heads in
    let lists_all (place, (c : Types.constructor_description)) =
      let there = List.filter (fun (place', _) -> place' = place) heads in
      let name (_, (c : Types.constructor_description)) = c.cstr_name in
      let names = List.sort_uniq String.compare (List.map name there) in
      List.length names = c.cstr_consts + c.cstr_nonconsts
    in
    if List.exists lists_all heads then
      Hashtbl.add found name (Printf.sprintf "%s:%d" at.loc_start.pos_fname at.loc_start.pos_lnum)
  in
  List.iter all limits

let expr here self (e : Typedtree.expression) =
  let of_cases cases = List.concat_map (fun (c : _ Typedtree.case) -> heads [] c.c_lhs) cases in
  (match e.exp_desc with
   | Texp_match (_, cases, _) -> judge here e.exp_loc (of_cases cases)
   | Texp_function { cases; _ } -> judge here e.exp_loc (of_cases cases)
   | _ -> ());
  Tast_iterator.default_iterator.expr self e

let count path =
  let tree = Cmt_format.read_cmt path in
  match tree.cmt_annots with
  | Implementation structure ->
    let iterator = { Tast_iterator.default_iterator with expr = expr (plain tree.cmt_modname) } in
    iterator.structure iterator structure
  | _ -> ()

let () =
  let folders = List.filter (( <> ) "--list") (List.tl (Array.to_list Sys.argv)) in
  List.iter count (Typed_trees.below folders);
  let report (name, limit) =
    let places = List.sort String.compare (Hashtbl.find_all found name) in
    let number = List.length places in
    if Array.mem "--list" Sys.argv then List.iter (Printf.printf "%s: %s\n" name) places
    else Printf.printf "%s: %d matches list all constructors, at most %d may\n" name number limit;
    number <= limit
  in
  if not (List.for_all Fun.id (List.map report limits)) then exit 1
