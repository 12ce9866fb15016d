(* Items that have no doc comment, in the interfaces (mli files) below the folders that are named. Each is printed with
   its place; the exit status is then 1.

   A comment may stand elsewhere: at the head of an interface or module for its type [t], at each of a type's
   constructors or fields for the type, at the other module for a second name of it. *)

(* Made by Menhir. *)
let generated = [ "grammar.mli" ]

(* Folders of the compiler's outputs begin with a point. *)
let rec interfaces folder =
  let of_name name =
    let path = Filename.concat folder name in
    if name.[0] = '.' || List.mem name generated then []
    else if Filename.check_suffix name ".mli" then [ path ]
    else if Sys.is_directory path then interfaces path
    else []
  in
  List.concat_map of_name (List.sort String.compare (Array.to_list (Sys.readdir folder)))

let parsed path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in channel)
    (fun () ->
       let text = Lexing.from_channel channel in
       Lexing.set_filename text path;
       Parse.interface text)

let has_comment attributes =
  let is_comment (a : Parsetree.attribute) = a.attr_name.txt = "ocaml.doc" in
  List.exists is_comment attributes

(* That each part of the type has a comment. *)
let has_comments (t : Parsetree.type_declaration) =
  let is_commented (c : Parsetree.constructor_declaration) = has_comment c.pcd_attributes in
  let is_explained (f : Parsetree.label_declaration) = has_comment f.pld_attributes in
  match t.ptype_kind with
  | Ptype_variant constructors -> List.for_all is_commented constructors
  | Ptype_record fields -> List.for_all is_explained fields
  | Ptype_abstract | Ptype_open -> false

(* That the interface begins with a comment, which no item has. *)
let is_headed = function
  | { Parsetree.psig_desc = Psig_attribute { attr_name = { txt = "ocaml.text"; _ }; _ }; _ } :: _ -> true
  | _ -> false

let found = ref 0

let judge path is_commented kind name (at : Location.t) =
  if not is_commented then begin
    incr found;
    Printf.printf "%s:%d: %s %s\n" path at.loc_start.pos_lnum kind name
  end

(* [is_headed] is whether the items are those of something with a comment. *)
let rec judge_items path ~is_headed items = List.iter (judge_item path ~is_headed) items

and judge_item path ~is_headed (item : Parsetree.signature_item) =
  let judge is_commented kind name = judge path is_commented kind name item.psig_loc in
  match item.psig_desc with
  | Psig_value v -> judge (has_comment v.pval_attributes) "val" v.pval_name.txt
  | Psig_type (_, types) ->
    let of_type (t : Parsetree.type_declaration) =
      let name = t.ptype_name.txt in
      judge (has_comment t.ptype_attributes || has_comments t || (is_headed && name = "t")) "type" name
    in
    List.iter of_type types
  | Psig_exception { ptyexn_constructor = c; ptyexn_attributes; _ } ->
    judge (has_comment c.pext_attributes || has_comment ptyexn_attributes) "exception" c.pext_name.txt
  | Psig_module { pmd_type = { pmty_desc = Pmty_alias _; _ }; _ } -> ()
  | Psig_module m ->
    judge (has_comment m.pmd_attributes) "module" (Option.value ~default:"_" m.pmd_name.txt);
    judge_type path ~is_headed:(has_comment m.pmd_attributes) m.pmd_type
  | Psig_modtype m ->
    judge (has_comment m.pmtd_attributes) "module type" m.pmtd_name.txt;
    Option.iter (judge_type path ~is_headed:(has_comment m.pmtd_attributes)) m.pmtd_type
  | _ -> ()

and judge_type path ~is_headed (t : Parsetree.module_type) =
  match t.pmty_desc with
  | Pmty_signature items -> judge_items path ~is_headed items
  | Pmty_functor (_, result) -> judge_type path ~is_headed result
  | Pmty_with (t, _) -> judge_type path ~is_headed t
  | _ -> ()

let () =
  let check path =
    let items = parsed path in
    judge_items path ~is_headed:(is_headed items) items
  in
  match List.concat_map interfaces (List.tl (Array.to_list Sys.argv)) with
  | [] -> failwith "no interfaces"
  | paths ->
    List.iter check paths;
    if !found > 0 then exit 1
