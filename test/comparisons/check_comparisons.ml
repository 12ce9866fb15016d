(* Polymorphic comparison and hashing at abstract types, found in the compiler's typed trees (cmt files) below the
   folders that are named. Equal values of an abstract type may differ in their parts: its module compares them. Each
   use is printed with its place and the abstract type; the exit status is then 1. *)

(* Of what they compare, this argument. Tables and sets of the standard library are recognised by the type of their
   key. *)
let compared =
  [ ("compare", 0); ("=", 0); ("<>", 0); ("<", 0); (">", 0); ("<=", 0); (">=", 0); ("min", 0); ("max", 0);
    ("List.mem", 0); ("List.assoc", 0); ("List.assoc_opt", 0); ("List.mem_assoc", 0); ("List.remove_assoc", 0);
    ("Array.mem", 0); ("Hashtbl.hash", 0); ("Hashtbl.add", 1); ("Hashtbl.replace", 1); ("Hashtbl.mem", 1);
    ("Hashtbl.find", 1); ("Hashtbl.find_opt", 1); ("Hashtbl.remove", 1) ]

(* Their values are atoms, or compared part by part in the usual way. *)
let transparent = [ "Unix.inet_addr"; "Unix.file_descr"; "S.property" ]

let argument = function
  | Path.Pdot (Path.Pident stdlib, name) when Ident.name stdlib = "Stdlib" -> List.assoc_opt name compared
  | Pdot (Pdot (Pident stdlib, m), name) when Ident.name stdlib = "Stdlib" -> List.assoc_opt (m ^ "." ^ name) compared
  | path -> (
      match String.split_on_char '_' (Path.name path) with
      | [ "Stdlib"; ""; rest ] -> List.assoc_opt (String.capitalize_ascii rest) compared
      | _ -> None)

let desc ty = (Ctype.repr ty).Types.desc

(* The abstract types in [ty], and functions. *)
let opaque env ty =
  let seen = Hashtbl.create 16 and found = ref [] in
  let note name = if not (List.mem name !found) then found := name :: !found in
  let rec walk ty =
    let ty = try Ctype.expand_head env ty with _ -> ty in
    match desc ty with
    | Tvar _ | Tunivar _ | Tnil | Tvariant _ | Tpackage _ | Tobject _ | Tfield _ -> ()
    | Tarrow _ -> note "a function"
    | Ttuple ts -> List.iter walk ts
    | Tconstr (path, args, _) ->
      List.iter walk args;
      if not (Hashtbl.mem seen path) then begin
        Hashtbl.add seen path ();
        declared path
      end
    | Tlink ty | Tsubst (ty, _) | Tpoly (ty, _) -> walk ty
  and declared path =
    let is_predefined = List.exists (fun (_, id) -> Path.same path (Path.Pident id)) Predef.builtin_idents in
    match Env.find_type path env with
    | exception Not_found -> note (Path.name path ^ " (not found)")
    | { type_kind = Type_abstract; type_manifest = None; _ } ->
      if not (is_predefined || List.mem (Path.name path) transparent) then note (Path.name path)
    | { type_kind = Type_abstract; type_manifest = Some ty; _ } -> walk ty
    | { type_kind = Type_open; _ } -> ()
    | { type_kind = Type_record (fields, _); _ } ->
      List.iter (fun (f : Types.label_declaration) -> walk f.ld_type) fields
    | { type_kind = Type_variant (cases, _); _ } ->
      let of_case (c : Types.constructor_declaration) =
        match c.cd_args with
        | Cstr_tuple ts -> List.iter walk ts
        | Cstr_record fields -> List.iter (fun (f : Types.label_declaration) -> walk f.ld_type) fields
      in
      List.iter of_case cases
  in
  walk ty;
  List.rev !found

let rec nth_argument env n ty =
  match desc (try Ctype.expand_head env ty with _ -> ty) with
  | Tarrow (_, a, rest, _) -> if n = 0 then Some a else nth_argument env (n - 1) rest
  | _ -> None

let uses = ref []

let judge (e : Typedtree.expression) path n =
  let env =
    try Envaux.env_of_only_summary e.exp_env
    with Envaux.Error error -> failwith (Format.asprintf "%a" Envaux.report_error error)
  in
  let found = Option.fold ~none:[] ~some:(opaque env) (nth_argument env n e.exp_type) in
  let at = e.exp_loc.loc_start in
  let line = Printf.sprintf "%s:%d: %s of %s" at.pos_fname at.pos_lnum (Path.last path) (String.concat ", " found) in
  if found <> [] && not (List.mem line !uses) then uses := line :: !uses

(* Comparisons with a constant, or with a constructor without arguments, are allowed. *)
let is_constant (_, argument) =
  match argument with
  | Some { Typedtree.exp_desc = Texp_construct (_, _, []) | Texp_constant _ | Texp_variant (_, None); _ } -> true
  | _ -> false

let expr self (e : Typedtree.expression) =
  let default () = Tast_iterator.default_iterator.expr self e in
  match e.exp_desc with
  | Texp_apply ({ exp_desc = Texp_ident (path, _, _); _ }, arguments)
    when List.mem (Path.last path) [ "="; "<>" ] && argument path <> None && List.exists is_constant arguments ->
    List.iter (fun (_, argument) -> Option.iter (self.Tast_iterator.expr self) argument) arguments
  | Texp_ident (path, _, _) ->
    Option.iter (judge e path) (argument path);
    default ()
  | _ -> default ()

let iterator = { Tast_iterator.default_iterator with expr }

(* Each with the modules that it was compiled with. A typed tree names their folders relative to the root of the build.
   The root is an argument: the tree's own record of it is the folder of the clone that filled dune's shared cache. *)
let check root path =
  let tree = Cmt_format.read_cmt path in
  Env.reset_cache ();
  Envaux.reset_cache ();
  let from_here folder =
    if Filename.is_relative folder then Filename.concat root folder else folder
  in
  Load_path.init (List.map from_here tree.cmt_loadpath);
  match tree.cmt_annots with
  | Implementation structure -> iterator.structure iterator structure
  | _ -> ()

let () =
  let root, folders =
    match Array.to_list Sys.argv with
    | _ :: root :: folders -> root, folders
    | _ -> failwith "arguments: the root of the build, then folders"
  in
  List.iter (check root) (Typed_trees.below folders);
  List.iter print_endline (List.sort String.compare !uses);
  if !uses <> [] then exit 1
