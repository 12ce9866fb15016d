(* The names of the library of plans that some folders of the semantics use, found in the compiler's typed trees (cmt
   files). The terms and the rules know of a plan its name, its requirements, its place and its extent: neither
   maneuvers, nor items of missions, nor fences. *)

let folders = [ "lib/semantics/terms/"; "lib/semantics/rules/"; "lib/environment/"; "lib/checker/" ]
let found : (string, unit) Hashtbl.t = Hashtbl.create 16

(* [Dolphin_plans__Inline_plan.t] and [Dolphin_plans.Inline_plan.t] are [Inline_plan.t]. *)
let note folder name =
  let after prefix =
    let n = String.length prefix in
    if String.starts_with ~prefix name then Some (String.sub name n (String.length name - n)) else None
  in
  let add name = Hashtbl.replace found (folder ^ " " ^ name) () in
  Option.iter add (match after "Dolphin_plans__" with Some name -> Some name | None -> after "Dolphin_plans.")

let of_type folder (ty : Types.type_expr) =
  match (Ctype.repr ty).desc with
  | Tconstr (path, _, _) -> note folder (Path.name path ^ ", its constructors or fields")
  | _ -> ()

let iterator folder =
  let usual = Tast_iterator.default_iterator in
  let expr self (e : Typedtree.expression) =
    (match e.exp_desc with
     | Texp_ident (path, _, _) -> note folder (Path.name path)
     | Texp_construct (_, c, _) -> of_type folder c.cstr_res
     | Texp_field (_, _, field) | Texp_setfield (_, _, field, _) -> of_type folder field.lbl_res
     | Texp_record { fields; _ } -> Array.iter (fun (field, _) -> of_type folder field.Types.lbl_res) fields
     | _ -> ());
    usual.expr self e
  in
  let pat : type k. Tast_iterator.iterator -> k Typedtree.general_pattern -> unit = fun self p ->
    (match p.pat_desc with
     | Tpat_construct (_, c, _, _) -> of_type folder c.cstr_res
     | Tpat_record (fields, _) -> List.iter (fun (_, field, _) -> of_type folder field.Types.lbl_res) fields
     | _ -> ());
    usual.pat self p
  in
  let typ self (t : Typedtree.core_type) =
    (match t.ctyp_desc with Ttyp_constr (path, _, _) -> note folder (Path.name path) | _ -> ());
    usual.typ self t
  in
  let module_expr self (m : Typedtree.module_expr) =
    (match m.mod_desc with Tmod_ident (path, _) -> note folder (Path.name path ^ ", the module") | _ -> ());
    usual.module_expr self m
  in
  { usual with expr; pat; typ; module_expr }

let read path =
  let tree = Cmt_format.read_cmt path in
  let source = Option.value tree.cmt_sourcefile ~default:"" in
  match List.find_opt (fun prefix -> String.starts_with ~prefix source) folders, tree.cmt_annots with
  | Some folder, Implementation structure ->
    let iterator = iterator folder in
    iterator.structure iterator structure
  | Some folder, Interface signature ->
    let iterator = iterator folder in
    iterator.signature iterator signature
  | _, _ -> ()

let () =
  List.iter read (Typed_trees.below ~interfaces:true (List.tl (Array.to_list Sys.argv)));
  let names = Hashtbl.fold (fun name () names -> name :: names) found [] in
  List.iter print_endline (List.sort String.compare names)
