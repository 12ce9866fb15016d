open Core
open Checks
open Closures

(* A key as it stands in the operation: a name, or the value of an expression. *)
type key = Written of string Ast.located | Computed of Ast.expression

type wanted =
  | Any                                         (* [k: _] *)
  | Pattern of Ast.closure                      (* [k: { x -> ... }] *)
  | Equal_to of Ast.expression

type pair = { key : key; wanted : wanted; value : Ast.expression }

let wanted (e : Ast.expression) =
  match e.it with Wildcard -> Any | Closure c -> Pattern c | _ -> Equal_to e

let pair : Ast.argument -> (pair, Ast.expression) result = function
  | Named (k, e) -> Ok { key = Written k; wanted = wanted e; value = e }
  | Keyed (k, e) -> Ok { key = Computed k; wanted = wanted e; value = e }
  | Positional e -> Error e

let written p = match p.key with Written k -> Some k.it | Computed _ -> None
let is_pattern p = match p.wanted with Pattern _ -> true | Any | Equal_to _ -> false

(* {1 Checks} *)

let check_own env key at =
  if Residual.is_key key then
    error env No_pairs at "'%s' is a key as fresh gives them: a program may not spell it out" key
      ~hint:"choose another name, or write fresh { k -> ... post((k): 1) ... }"

let check_key env p =
  match p.key with
  | Written k -> check_own env k.it k.at
  | Computed { it = String k; at } -> check_own env k at
  | Computed k -> (
      match known_kind env k with
      | Any | String | Number -> ()
      | found -> error env Wrong_kind k.at "a key is a string, this is %s" (Builtins.describe found))

let check_key_of env a = Result.iter (check_key env) (pair a)

let check_pattern env name p =
  match p.wanted with
  | Pattern { parameters = Some (_ :: second :: _); _ } ->
    error env Wrong_parameters second.Ast.at "a pattern takes one parameter, the value of a pair"
  | Pattern { parameters = Some []; _ } ->
    error env Wrong_parameters p.value.at "a pattern takes one parameter, the value of a pair"
      ~hint:(Printf.sprintf "write %s key: { x -> ... }" name)
  | Pattern _ when env.answer -> error env Deed_in_answer p.value.at "an answer may not contain code { ... }"
  | Pattern _ | Any | Equal_to _ -> ()

(* Patterns choose before anything is taken: two pairs of one key could choose the same. *)
let check_apart env name pairs =
  let rec from = function
    | [] -> ()
    | p :: rest ->
      let meets q =
        (is_pattern p || is_pattern q)
        && (match written p, written q with Some k, Some k' -> k = k' | _, _ -> true)
      in
      (match List.find_opt meets rest with
       | Some q ->
         error env No_pairs q.value.at "of two pairs with one key, or one that is computed, none may have a pattern"
           ~hint:(Printf.sprintf "one after the other: %s(...) && %s(...)" name name)
       | None -> ());
      from rest
  in
  from pairs

let note_order env p =
  match p.wanted, p.key with
  | (Any | Pattern _), Written k -> Scope.note_ordered_key env.program k.it
  | (Any | Pattern _), Computed k -> Scope.note_computed_order env.program k.at
  | Equal_to _, _ -> ()

(* {1 Elaboration} *)

let key_expression env p =
  match p.key with
  | Written k -> constant env k.at (String k.it)
  | Computed k -> elaborate env k

let values_of env at p = apply env at (Builtin Values_of) [ key_expression env p ]

(* The values of the pairs that may be taken for [p], oldest first where order is kept. *)
let matching env p c =
  let at = p.value.at in
  let values = values_of env at p in
  apply env at (Method ("findAll", [ None ])) [ values; closure env at Scope.Plain "the pattern" c ]

(* A computed key is an argument before its value. *)
let argument env p value =
  match p.key with Written _ -> [ value ] | Computed k -> let k = elaborate env k in [ k; value ]

let wanted_value env p =
  match p.wanted with
  | Any -> constant env p.value.at Wildcard
  | Pattern _ | Equal_to _ -> elaborate env p.value

(* [consume k: { x -> C }] is [xs = the values of k with C; if (xs) consume k: xs[0] else false]. *)
let chosen env at pairs rest =
  let choose p =
    match p.wanted with
    | Pattern c ->
      let slot = Scope.new_slot env.code in
      (p, Some (set_local env p.value.at slot (matching env p c), slot))
    | Any | Equal_to _ -> (p, None)
  in
  let pairs = List.map choose pairs in
  let sets = List.filter_map (fun (_, choice) -> Option.map fst choice) pairs in
  let last = rest pairs in
  let is_there (_, choice) last =
    match choice with
    | Some (_, slot) -> expression env at (If (local env at slot, last, constant env at (Boolean false)))
    | None -> last
  in
  let test = List.fold_right is_there pairs last in
  if sets = [] then test else block env at (sets @ [ test ])

let keys pairs = List.map (fun p -> written p) pairs

let consume env at pairs =
  let value (p, choice) =
    match choice with
    | Some (_, slot) -> apply env at Element [ local env at slot; constant env at (Integer 0) ]
    | None -> wanted_value env p
  in
  let taken pairs =
    let arguments = List.concat_map (fun (p, choice) -> argument env p (value (p, choice))) pairs in
    apply env at (Builtin (Consume (keys (List.map fst pairs)))) arguments
  in
  chosen env at pairs taken

let poll env at pairs =
  let others pairs =
    match List.filter_map (function p, None -> Some p | _, Some _ -> None) pairs with
    | [] -> constant env at (Boolean true)
    | plain ->
      let arguments = List.concat_map (fun p -> argument env p (wanted_value env p)) plain in
      apply env at (Builtin (Poll (keys plain))) arguments
  in
  chosen env at pairs others

let post env at pairs =
  let arguments = List.concat_map (fun p -> argument env p (elaborate env p.value)) pairs in
  apply env at (Builtin (Post (keys pairs))) arguments

let count env at p =
  let of_values xs = apply env at (Method ("size", [])) [ xs ] in
  match p.wanted with
  | Any -> of_values (values_of env at p)
  | Pattern c -> of_values (matching env p c)
  | Equal_to e ->
    error env No_pairs e.at "count takes a key and _ or a pattern" ~hint:"write count(key: { it == x })";
    null env at

let no_pairs env at name =
  error env No_pairs at "%s takes pairs of key and value" name ~hint:(Printf.sprintf "write %s key: value" name)

let could_be_map env (e : Ast.expression) =
  match e.it with
  | Map _ -> true
  | Null -> false
  | _ -> known_kind env e = Any

(* [poll(ready)]: such a key is not taken for a misspelt name of the language. *)
let note_missing_key env (e : Ast.expression) =
  match e.it with
  | Variable name ->
    let certain = not (Scope.has_like env.program name) in
    Scope.note_hint env.program ~certain e.at (fun key -> Printf.sprintf "write poll %s: _" key)
  | _ -> ()

let elaborate env at name (construct : Builtins.pairs) arguments =
  let pairs = List.filter_map (fun a -> Result.to_option (pair a)) arguments in
  let positional = List.filter_map (fun a -> match pair a with Error e -> Some e | Ok _ -> None) arguments in
  List.iter (check_key env) pairs;
  if construct <> Post then begin
    List.iter (fun p -> Scope.note_looked_at env.program (written p)) pairs;
    List.iter (check_pattern env name) pairs;
    List.iter (fun p -> match p.key with Written k -> check_value env name k p.value | Computed _ -> ()) pairs
  end;
  let missing (e : Ast.expression) hint =
    match e.it with Variable _ -> Scope.note_hint env.program ~certain:false e.at hint | _ -> () in
  if construct <> Post then
    List.iter
      (fun p -> missing p.value (fun x -> Printf.sprintf "any value is _, as in %s k: _; a text is '%s'" name x))
      pairs;
  match construct, positional, pairs with
  | Poll, [ e ], [] ->
    note_missing_key env e;
    check_kind env name String e;
    Scope.note_looked_at env.program (match e.it with String key -> Some key | _ -> None);
    apply env at (Builtin (Poll [])) [ elaborate env e ]
  | Post, [ e ], [] when could_be_map env e ->
    apply env at (Builtin (Post [])) [ elaborate env e ]
  | _, e :: _, _ ->
    no_pairs env e.at name;
    elaborate env e
  | _, [], [] -> no_pairs env at name; null env at
  | Post, [], pairs -> post env at pairs
  | Poll, [], pairs -> poll env at pairs
  | Consume, [], pairs ->
    check_apart env name pairs;
    List.iter (note_order env) pairs;
    consume env at pairs
  | Count, [], [ p ] -> count env at p
  | Count, [], _ :: _ ->
    error env No_pairs at "count takes one key" ~hint:"write count(key: _)";
    null env at
