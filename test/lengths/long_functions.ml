(* Functions of more than 60 lines, the height of a screen, found in the compiler's typed trees (cmt files) below the
   folders that are named. Prints each with its file. Those that are accepted are tables with a row for each construct,
   and a search whose loops share their state. *)

let most = 60

(* Not read by people. *)
let generated = [ "lib/imc/message.ml"; "lib/syntax/scanner.ml"; "lib/syntax/grammar.ml" ]

let found = ref []

let binding self (b : Typedtree.value_binding) =
  let first = b.vb_loc.loc_start and last = b.vb_loc.loc_end in
  let lines = last.pos_lnum - first.pos_lnum + 1 in
  (match b.vb_expr.exp_desc, b.vb_pat.pat_desc with
   | Texp_function _, Tpat_var (name, _) when lines > most && not b.vb_loc.loc_ghost ->
     if not (List.mem first.pos_fname generated) then
       found := Printf.sprintf "%s: %s" first.pos_fname (Ident.name name) :: !found
   | _, _ -> ());
  Tast_iterator.default_iterator.value_binding self b

let measure path =
  match (Cmt_format.read_cmt path).cmt_annots with
  | Implementation structure ->
    let iterator = { Tast_iterator.default_iterator with value_binding = binding } in
    iterator.structure iterator structure
  | _ -> ()

let () =
  List.iter measure (Typed_trees.below (List.tl (Array.to_list Sys.argv)));
  List.iter print_endline (List.sort_uniq String.compare !found)
