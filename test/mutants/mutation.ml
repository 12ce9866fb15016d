open Parsetree

type kind =
  | Drop_case
  | Other_case
  | Swap_cases
  | Drop_guard
  | Swap_branches
  | Fix_condition
  | Negate
  | Drop_pattern
  | Drop_operand
  | And_or
  | Comparison
  | Off_by_one
  | Drop_term
  | Sign
  | Drop_side
  | Drop_element
  | Drop_statement
  | Keep_field
  | All_some
  | Min_max
  | Some_none
  | Boolean
  | Exchange
  | Forget_call

let described =
  [
    (Drop_case, "drop-case", "a case is missing: a guarded one, or one before a case for all");
    (Other_case, "other-case", "a case does what the case beside it does");
    (Swap_cases, "swap-cases", "two cases beside each other do what the other should");
    (Drop_guard, "drop-guard", "`when g` is missing");
    (Swap_branches, "swap-branches", "`then` and `else` exchange their parts");
    (Fix_condition, "fix-condition", "a condition, comparison, search in a list or `not x` is always true, or always false");
    (Negate, "negate", "`not` before a guard, or before the condition of an `if` without `else`; or `not` is missing");
    (Drop_pattern, "drop-pattern", "one side of a pattern `p | q` is missing");
    (Drop_operand, "drop-operand", "one side of `&&` or `||` is missing");
    (And_or, "and-or", "`&&` for `||`, or the other way round");
    (Comparison, "comparison", "`<` for `<=`, `>` for `>=`, `=` for `<>`, and the other way round");
    (Off_by_one, "off-by-one", "an integer is greater or less by one");
    (Drop_term, "drop-term", "one side of `+`, `-`, `*` or `/` is missing, such as `+ 1`");
    (Sign, "sign", "`+` for `-`, or the other way round; the same for floats");
    (Drop_side, "drop-side", "one side of `::`, of `@` or of a union is missing");
    (Drop_element, "drop-element", "an element of a list is missing");
    (Drop_statement, "drop-statement", "a statement is missing");
    (Keep_field, "keep-field", "a field of a record that is updated keeps its value");
    (All_some, "all-some", "`exists` for `for_all`, or the other way round");
    (Min_max, "min-max", "`min` for `max`, or the other way round");
    (Some_none, "some-none", "`None` for `Some x`");
    (Boolean, "boolean", "`true` for `false`, or the other way round");
    (Exchange, "exchange", "the parts of a pair, two arguments, or the sides of `-` or `@` are exchanged");
    (Forget_call, "forget-call", "`x` for `f x`: the last argument of a function instead of its result");
  ]

let kinds = List.map (fun (kind, _, _) -> kind) described
let row kind = List.find (fun (kind', _, _) -> kind = kind') described
let name kind = let _, name, _ = row kind in name
let meaning kind = let _, _, meaning = row kind in meaning

type t = { kind : kind; line : int; first : int; after : int; replacement : string }

let apply m source =
  String.sub source 0 m.first ^ m.replacement ^ String.sub source m.after (String.length source - m.after)

(* {1 Texts} *)

let first_of (loc : Location.t) = loc.loc_start.pos_cnum
let after_of (loc : Location.t) = loc.loc_end.pos_cnum
let between source first after = String.sub source first (after - first)
let text source (loc : Location.t) = between source (first_of loc) (after_of loc)

let for_all is s = List.for_all is (List.of_seq (String.to_seq s))

(* Whether the parenthesis that [s] begins with closes at its end. Where a text in [s] has parentheses, it may not see
   it. *)
let is_in_parentheses s =
  let last = String.length s - 1 in
  let rec closes depth i =
    let depth = match s.[i] with '(' -> depth + 1 | ')' -> depth - 1 | _ -> depth in
    if depth = 0 then i = last else i < last && closes depth (i + 1)
  in
  last >= 0 && s.[0] = '(' && closes 0 0

(* An expression that may stand anywhere. *)
let closed s =
  let is_word = function 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '_' | '.' | '\'' -> true | _ -> false in
  if for_all is_word s || is_in_parentheses s then s else "(" ^ s ^ ")"

let is_decimal s = s <> "" && for_all (function '0' .. '9' -> true | _ -> false) s

let last_name = function
  | { pexp_desc = Pexp_ident { txt; _ }; _ } -> (match txt with Lident name | Ldot (_, name) -> name | Lapply _ -> "")
  | _ -> ""

(* {1 Names}

   A case can take the body of another one only if it binds the names that this body uses. *)

let names_of iterate part =
  let found = ref [] in
  let pat (self : Ast_iterator.iterator) p =
    (match p.ppat_desc with
     | Ppat_var { txt; _ } | Ppat_alias (_, { txt; _ }) -> found := txt :: !found
     | _ -> ());
    Ast_iterator.default_iterator.pat self p
  in
  let expr (self : Ast_iterator.iterator) e =
    (match e.pexp_desc with Pexp_ident { txt = Lident name; _ } -> found := name :: !found | _ -> ());
    Ast_iterator.default_iterator.expr self e
  in
  let iterator = { Ast_iterator.default_iterator with pat; expr } in
  iterate iterator part;
  !found

let bound case = names_of (fun (iterator : Ast_iterator.iterator) -> iterator.pat iterator) case.pc_lhs
let used case = names_of (fun (iterator : Ast_iterator.iterator) -> iterator.expr iterator) case.pc_rhs

(* [may_do case other]: [case] could have the body of [other]. *)
let may_do case other =
  let mine = bound case and used = used other in
  List.for_all (fun name -> List.mem name mine || not (List.mem name used)) (bound other)

(* {1 The kinds}

   Each function gives the replacements of one place, as locations with their new texts. *)

let rec takes_all p =
  match p.ppat_desc with
  | Ppat_any | Ppat_var _ -> true
  | Ppat_alias (p, _) | Ppat_constraint (p, _) -> takes_all p
  | Ppat_tuple ps -> List.for_all takes_all ps
  | _ -> false

(* From the bar or the keyword before a case to the end of its body. *)
let dropped_case case next =
  let span = { case.pc_lhs.ppat_loc with loc_end = next.pc_lhs.ppat_loc.loc_start } in
  (Drop_case, span, "")

let body_of_case source case other =
  (Other_case, case.pc_rhs.pexp_loc, closed (text source other.pc_rhs.pexp_loc))

let swapped source (first : Location.t) (second : Location.t) =
  let between = between source (after_of first) (first_of second) in
  ({ first with loc_end = second.loc_end }, closed (text source second) ^ between ^ closed (text source first))

let two_cases source case other =
  let one_for_other = if may_do case other then [ body_of_case source case other ] else [] in
  let other_for_one = if may_do other case then [ body_of_case source other case ] else [] in
  let both =
    if one_for_other = [] || other_for_one = [] then []
    else
      let span, exchanged = swapped source case.pc_rhs.pexp_loc other.pc_rhs.pexp_loc in
      [ (Swap_cases, span, exchanged) ]
  in
  one_for_other @ other_for_one @ both

let guard source case =
  match case.pc_guard with
  | None -> []
  | Some g ->
    let span = { case.pc_lhs.ppat_loc with loc_start = case.pc_lhs.ppat_loc.loc_end; loc_end = g.pexp_loc.loc_end } in
    [ (Drop_guard, span, ""); (Negate, g.pexp_loc, "not " ^ closed (text source g.pexp_loc)) ]

let of_cases source cases =
  let takes_the_rest = List.exists (fun case -> case.pc_guard = None && takes_all case.pc_lhs) cases in
  let rec pairs = function
    | case :: (next :: _ as others) ->
      let may_go = takes_the_rest || case.pc_guard <> None in
      (if may_go then [ dropped_case case next ] else []) @ two_cases source case next @ pairs others
    | [] | [ _ ] -> []
  in
  List.concat_map (guard source) cases @ pairs cases

let fixed e = [ (Fix_condition, e.pexp_loc, "true"); (Fix_condition, e.pexp_loc, "false") ]

let of_condition source ~alone c =
  let negated = if alone then [ (Negate, c.pexp_loc, "not " ^ closed (text source c.pexp_loc)) ] else [] in
  fixed c @ negated

(* The elements of a list in brackets. Its inner pairs have no place of their own, unlike those of [x :: xs]. *)
let rec elements e =
  match e.pexp_desc with
  | Pexp_construct ({ txt = Lident "[]"; _ }, None) -> Some []
  | Pexp_construct ({ txt = Lident "::"; _ }, Some { pexp_desc = Pexp_tuple [ x; rest ]; _ }) ->
    if rest.pexp_loc.loc_ghost then Option.map (fun xs -> x :: xs) (elements rest) else None
  | _ -> None

let without i xs = List.filteri (fun j _ -> j <> i) xs

let of_elements source e xs =
  let texts = List.map (fun x -> text source x.pexp_loc) xs in
  let shorter i _ =
    match without i texts with
    | [] -> (Drop_element, e.pexp_loc, "[]")
    | texts -> (Drop_element, e.pexp_loc, "[ " ^ String.concat "; " texts ^ " ]")
  in
  List.mapi shorter xs

let of_update source e record fields =
  let text_of_field ((field : _ Location.loc), value) =
    let last = max (after_of field.loc) (after_of value.pexp_loc) in
    between source (first_of field.loc) last
  in
  let kept i _ =
    match without i (List.map text_of_field fields) with
    | [] -> (Keep_field, e.pexp_loc, closed (text source record.pexp_loc))
    | fields ->
      (Keep_field, e.pexp_loc, Printf.sprintf "{ %s with %s }" (text source record.pexp_loc) (String.concat "; " fields))
  in
  List.mapi kept fields

let exchanges =
  let both kind (a, b) = [ (a, (kind, b)); (b, (kind, a)) ] in
  List.concat_map (both Comparison) [ ("<", "<="); (">", ">="); ("=", "<>"); ("==", "!="); ("<.", "<=.") ]
  @ List.concat_map (both Sign) [ ("+", "-"); ("+.", "-.") ]
  @ both And_or ("&&", "||")
  @ both Min_max ("min", "max")
  @ List.concat_map (both All_some) [ ("for_all", "exists"); ("for_all2", "exists2") ]

(* The name itself, without the path before it, stands at the end of its place. *)
let of_name source f =
  let name = last_name f in
  match List.assoc_opt name exchanges with
  | Some (kind, other) when String.length (text source f.pexp_loc) >= String.length name ->
    let loc_start = { f.pexp_loc.loc_end with pos_cnum = after_of f.pexp_loc - String.length name } in
    let span = { f.pexp_loc with loc_start } in
    if String.equal (text source span) name then [ (kind, span, other) ] else []
  | Some _ | None -> []

let exchanged source a b =
  let span, exchanged = swapped source a.pexp_loc b.pexp_loc in
  [ (Exchange, span, exchanged) ]

let joins = [ "union"; "append"; "rev_append"; "merge" ]

let of_two source e f a b =
  let exchanged = exchanged source a b in
  let a = text source a.pexp_loc and b = text source b.pexp_loc in
  let both kind = [ (kind, e.pexp_loc, closed a); (kind, e.pexp_loc, closed b) ] in
  match last_name f with
  | "&&" -> (Fix_condition, e.pexp_loc, "false") :: both Drop_operand
  | "||" -> (Fix_condition, e.pexp_loc, "true") :: both Drop_operand
  | "<" | "<=" | ">" | ">=" | "=" | "<>" | "==" | "!=" | "mem" | "exists" | "for_all" | "equal" -> fixed e
  | "+" | "*" | "/" | "+." | "*." | "/." -> both Drop_term
  | "-" | "-." -> exchanged @ both Drop_term
  | "@" -> exchanged @ both Drop_side
  | name when List.mem name joins -> both Drop_side
  | _ -> []

(* Functions whose arguments are messages or sizes: nothing within is changed. *)
let is_left_alone f =
  List.mem (last_name f)
    [ "create"; "failwith"; "invalid_arg"; "sprintf"; "printf"; "eprintf"; "kprintf"; "ksprintf"; "fprintf"; "asprintf";
      "pf"; "str"; "kstr"; "kasprintf" ]

(* Forgetting these gives no program that has a type. *)
let never_forgotten = [ "raise"; "raise_notrace"; "ref"; "!"; "ignore"; "fst"; "snd"; "~-"; "~-."; "&&"; "||" ]

let is_operator name = name <> "" && not (match name.[0] with 'a' .. 'z' | 'A' .. 'Z' | '_' -> true | _ -> false)

let rec exchanged_arguments source = function
  | (Asttypes.Nolabel, a) :: ((Asttypes.Nolabel, b) :: _ as others) ->
    exchanged source a b @ exchanged_arguments source others
  | _ :: others -> exchanged_arguments source others
  | [] -> []

let of_call source e f arguments =
  let name = if f.pexp_loc.loc_ghost then "" else last_name f in  (* [xs.(i)] has no function *)
  match List.rev arguments with
  | (Asttypes.Nolabel, x) :: _ when name = "not" -> (Negate, e.pexp_loc, closed (text source x.pexp_loc)) :: fixed e
  | (Nolabel, x) :: (Nolabel, _) :: [] when name = "@@" -> [ (Forget_call, e.pexp_loc, closed (text source x.pexp_loc)) ]
  | (Nolabel, _) :: (Nolabel, x) :: [] when name = "|>" -> [ (Forget_call, e.pexp_loc, closed (text source x.pexp_loc)) ]
  | (Nolabel, x) :: _ when name <> "" && not (is_operator name || List.mem name never_forgotten) ->
    (Forget_call, e.pexp_loc, closed (text source x.pexp_loc)) :: exchanged_arguments source arguments
  | _ -> []

let of_constant source e =
  let s = text source e.pexp_loc in
  if not (is_decimal s) then []
  else
    match int_of_string_opt s with
    | None -> []
    | Some n ->
      let other n = (Off_by_one, e.pexp_loc, string_of_int n) in
      if n = 0 then [ other 1 ] else [ other (n + 1); other (n - 1) ]

let of_statements a b =
  let rest = { a.pexp_loc with loc_end = b.pexp_loc.loc_start } in
  let last = match b.pexp_desc with Pexp_sequence _ -> [] | _ -> [ (Drop_statement, b.pexp_loc, "()") ] in
  (Drop_statement, rest, "") :: last

let of_expression source e =
  match e.pexp_desc with
  | Pexp_ifthenelse (c, yes, Some no) ->
    let span, exchanged = swapped source yes.pexp_loc no.pexp_loc in
    (Swap_branches, span, exchanged) :: of_condition source ~alone:false c
  | Pexp_ifthenelse (c, _, None) -> of_condition source ~alone:true c
  | Pexp_construct ({ txt = Lident "Some"; _ }, Some _) -> [ (Some_none, e.pexp_loc, "None") ]
  | Pexp_construct ({ txt = Lident "true"; _ }, None) -> [ (Boolean, e.pexp_loc, "false") ]
  | Pexp_construct ({ txt = Lident "false"; _ }, None) -> [ (Boolean, e.pexp_loc, "true") ]
  | Pexp_construct ({ txt = Lident "::"; _ }, Some { pexp_desc = Pexp_tuple [ x; rest ]; _ }) -> (
      match elements e with
      | Some xs -> of_elements source e xs
      | None ->
        [ (Drop_side, e.pexp_loc, closed (text source rest.pexp_loc));
          (Drop_side, e.pexp_loc, "[ " ^ text source x.pexp_loc ^ " ]") ])
  | Pexp_record (fields, Some record) -> of_update source e record fields
  | Pexp_sequence (a, b) -> of_statements a b
  | Pexp_tuple [ a; b ] -> exchanged source a b
  | Pexp_constant _ -> of_constant source e
  | Pexp_ident _ -> of_name source e
  | Pexp_apply (f, ([ (Nolabel, a); (Nolabel, b) ] as arguments)) ->
    of_two source e f a b @ of_call source e f arguments
  | Pexp_apply (f, arguments) -> of_call source e f arguments
  | _ -> []

(* {1 All} *)

let is_printer (b : value_binding) =
  match b.pvb_pat.ppat_desc with
  | Ppat_var { txt; _ } | Ppat_constraint ({ ppat_desc = Ppat_var { txt; _ }; _ }, _) ->
    String.length txt >= 2 && String.equal (String.sub txt 0 2) "pp"
  | _ -> false

let parsed source =
  let lexbuf = Lexing.from_string source in
  Lexing.set_filename lexbuf "source";
  Parse.implementation lexbuf

let places source =
  let found = ref [] in
  let add (kind, (loc : Location.t), replacement) =
    if not (String.equal (text source loc) replacement) then
      let line = loc.loc_start.pos_lnum in
      found := { kind; line; first = first_of loc; after = after_of loc; replacement } :: !found
  in
  let expr (self : Ast_iterator.iterator) e =
    if not e.pexp_loc.loc_ghost then List.iter add (of_expression source e);
    match e.pexp_desc with
    | Pexp_apply (f, _) when is_left_alone f -> ()
    | _ -> Ast_iterator.default_iterator.expr self e
  in
  let cases (self : Ast_iterator.iterator) cases =
    List.iter add (of_cases source cases);
    Ast_iterator.default_iterator.cases self cases
  in
  let pat (self : Ast_iterator.iterator) p =
    (match p.ppat_desc with
     | Ppat_or (a, b) -> List.iter (fun part -> add (Drop_pattern, p.ppat_loc, text source part.ppat_loc)) [ a; b ]
     | _ -> ());
    Ast_iterator.default_iterator.pat self p
  in
  let value_binding (self : Ast_iterator.iterator) b =
    if not (is_printer b) then Ast_iterator.default_iterator.value_binding self b
  in
  let iterator = { Ast_iterator.default_iterator with expr; cases; pat; value_binding } in
  iterator.structure iterator (parsed source);
  List.rev !found

(* Of mutations that replace the same bytes by the same text, the first. *)
let all source =
  let seen = Hashtbl.create 64 in
  let is_new m =
    let key = (m.first, m.after, m.replacement) in
    if Hashtbl.mem seen key then false else (Hashtbl.add seen key (); true)
  in
  let by_place a b = compare (a.first, a.after) (b.first, b.after) in
  List.stable_sort by_place (List.filter is_new (places source))

(* {1 Differences} *)

let rec without_common = function
  | a :: before, b :: after when String.equal a b -> without_common (before, after)
  | both -> both

let difference before after =
  let before, after = without_common (String.split_on_char '\n' before, String.split_on_char '\n' after) in
  let before, after = without_common (List.rev before, List.rev after) in
  let marked mark lines = List.rev_map (fun line -> mark ^ line ^ "\n") lines in
  String.concat "" (marked "- " before @ marked "+ " after)
