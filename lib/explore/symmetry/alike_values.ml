open Dolphin_semantics
open Dolphin_environment
open Core

exception Looked_at

(* A key by its name, or as a parameter of the code of a [fresh]: then it stands for all keys that this has been. *)
type key = Named of string | Fresh of Code_flow.key

module Keys = Set.Make (struct
    type t = key

    let compare a b =
      match a, b with
      | Named k, Named k' -> String.compare k k'
      | Named _, Fresh _ -> -1
      | Fresh _, Named _ -> 1
      | Fresh a, Fresh b ->
        (match Int.compare a.code b.code with 0 -> Int.compare a.parameter b.parameter | order -> order)
  end)

let computed flow lambda k =
  match k.node, Code_flow.key flow lambda k with
  | Constant (String k), _ -> Named k
  | _, Some k -> Fresh k
  | _, None -> raise Looked_at

(* The pairs of a [Post], [Consume] or [Poll]: each key, with the expression of its value. *)
let pairs flow lambda keys arguments =
  if keys = [] then raise Looked_at;
  let key = function Code_walk.Written k -> Named k | Computed k -> computed flow lambda k in
  List.map (fun (k, x) -> (key k, x)) (Code_walk.pairs keys arguments)

(* {1 What becomes of a value}

   The result of an expression, as far as it depends on the value: nothing, the value itself, a text with it, or a
   task (or its code). *)

type given = Other | Value | Text | Task

(* The parameters of a handler: the error's text, the vehicle that failed, which does not depend on the value, and
   the name of the failed task. *)
let of_error = function 1 -> Other | _ -> Text

let bound (lambda : lambda) arguments = List.init lambda.parameters (fun slot -> (slot, arguments slot))
let both a b = if a = Other then b else if b = Other || a = b then a else raise Looked_at

type code = {
  flow : Code_flow.t;
  lambda : lambda;  (* which this is a run of *)
  slots : (int * given) list;
  mutable returned : given;
  mutable posted : Keys.t;  (* keys that the value is posted with *)
  plans : string list;  (* plans that do not end as all others do *)
  inside : lambda list;  (* the value being traced *)
}

(* Whether a name of this form may be that of one of the plans. *)
let may_name plans parts =
  let fixed part = match part.node with Constant (String text) -> Some text | _ -> None in
  let starts, ends =
    match parts, List.rev parts with
    | first :: _, last :: _ -> (fixed first, fixed last)
    | _, _ -> (None, None)
  in
  let is_suffix suffix text =
    let n = String.length suffix and m = String.length text in
    n <= m && String.sub text (m - n) n = suffix
  in
  let is_it name =
    Option.fold starts ~none:true ~some:(fun prefix -> String.starts_with ~prefix name)
    && Option.fold ends ~none:true ~some:(fun suffix -> is_suffix suffix name)
  in
  List.exists is_it plans

let rec value_of code e =
  match e.node with
  | Constant _ | Global _ | Break | Continue -> Other
  | Local slot -> Option.value (List.assoc_opt slot code.slots) ~default:Other
  | Set_local (slot, e) ->
    if List.mem_assoc slot code.slots then raise Looked_at;
    nothing code e
  | Set_global (_, e) -> nothing code e
  | If (a, b, c) ->
    ignore (nothing code a);
    both (value_of code b) (value_of code c)
  | Block es -> List.fold_left (fun _ e -> value_of code e) Other es
  | While (a, b) ->
    ignore (nothing code a);
    ignore (value_of code b);
    Other
  | For (slot, range, body) ->
    if List.mem_assoc slot code.slots then raise Looked_at;
    ignore (nothing code range);
    ignore (value_of code body);
    Other
  | Return e ->
    code.returned <- both code.returned (value_of code e);
    Other
  | Make_closure (lambda, captured) -> made code lambda captured ~arguments:(fun _ -> Other)
  | Apply (Builtin Make_watch, [ t; { node = Make_closure (lambda, captured); _ } ]) ->
    let t = value_of code t and handler = made code lambda captured ~arguments:of_error in
    task [ t; handler ]
  | Apply (operation, arguments) -> applied code operation arguments (List.map (value_of code) arguments)

and nothing code e = if value_of code e = Other then Other else raise Looked_at

and task given =
  if List.for_all (fun g -> g = Other || g = Task) given then List.fold_left both Other given else raise Looked_at


(* Code with its captured values; it is run for its effects, or gives a task. *)
and made code lambda captured ~arguments =
  let captured = List.map (fun slot -> Option.value (List.assoc_opt slot code.slots) ~default:Other) captured in
  let parameters = bound lambda arguments in
  if List.for_all (( = ) Other) captured && List.for_all (fun (_, given) -> given = Other) parameters then Other
  else begin
    let inner = List.combine (Array.to_list lambda.captures) captured in
    match body code lambda (parameters @ inner) with
    | Other | Task -> if List.for_all (( = ) Other) captured then Other else Task
    | Value | Text -> raise Looked_at
  end

and body code lambda slots =
  if List.memq lambda code.inside then raise Looked_at;
  let slots = List.filter (fun (_, given) -> given <> Other) slots in
  let inner = { code with lambda; slots; returned = Other; inside = lambda :: code.inside } in
  let last = value_of inner lambda.code in
  code.posted <- Keys.union code.posted inner.posted;
  both last inner.returned

and applied code operation arguments given =
  if List.for_all (( = ) Other) given then Other
  else
    match operation, arguments, given with
    | Concatenate, _, _ -> if List.mem Task given then raise Looked_at else Text
    | Builtin Platform_task, [ { node = Apply (Concatenate, parts); _ } ], [ Text ] ->
      let is_text part = match part.node with Constant (String text) -> text <> "" | _ -> false in
      if may_name code.plans parts || not (List.exists is_text parts) then raise Looked_at else Task
    | Builtin (Message | Halt | Fail), [ _ ], [ Text ] -> Other
    | Builtin (Post keys), _, _ ->
      let given = List.combine arguments given in
      let post (k, x) =
        match List.assq x given with
        | Other -> ()
        | Value -> code.posted <- Keys.add k code.posted
        | Text | Task -> raise Looked_at
      in
      List.iter post (pairs code.flow code.lambda keys arguments);
      Other
    | ( (Builtin
           (Make_watch | Make_fresh | Make_until _ | Make_during _ | Make_wait_for | Make_action | Make_condition
           | Make_repeat _)
        | Binary (Sequence | Parallel | Divide)), _, _ ) -> task given
    | Element, _, [ Task; Other ] | Make_recruit, _, [ Other; Task ] -> Task
    | Call names, callee :: _, Other :: given when List.for_all (( = ) None) names ->
      let called lambda =
        if List.length given <> lambda.parameters then raise Looked_at;
        body code lambda (List.mapi (fun slot g -> (slot, g)) given)
      in
      let callees = Option.value (Code_flow.callees code.flow code.lambda callee) ~default:[] in
      if callees = [] then raise Looked_at;
      List.fold_left (fun result lambda -> both result (called lambda)) Other callees
    | _, _, _ -> raise Looked_at

(* The tuples that [lambda] posts, of the values it gets. *)
let posted_by (flow, plans) (lambda : lambda) arguments =
  let code = { flow; lambda; slots = []; returned = Other; posted = Keys.empty; plans; inside = [] } in
  match body code lambda (bound lambda arguments) with
  | Other | Task -> code.posted
  | Value | Text -> raise Looked_at

(* {1 Keys} *)

let expressions program =
  let found = ref [] in
  Code_walk.iter_within (fun lambda e -> found := (lambda, e) :: !found) (Code_walk.pieces program);
  !found

(* The keys that an expression looks into, beyond taking or asking for any value. *)
let looked_into flow (lambda, e) =
  let wanted (k, x) = match x.node with Constant Wildcard -> None | _ -> Some k in
  match e.node with
  | Apply (Builtin (Consume keys | Poll (_ :: _ as keys)), arguments) ->
    List.filter_map wanted (pairs flow lambda keys arguments)
  | Apply (Builtin (Post keys), arguments) ->
    ignore (pairs flow lambda keys arguments);
    []
  | Apply (Builtin (Make_ensure forms), _) ->
    (* Its values are not made one. *)
    let posted = function
      | Pair_of (Some k) -> [ Named k ]
      | Pair_of None | Taken_pairs -> raise Looked_at
      | Variable_of _ -> []
    in
    List.concat_map posted forms
  | _ -> []

(* [poll 'k'] is [poll(k: _)]. *)
let asks_some_key (_, e) =
  match e.node with
  | Apply (Builtin (Poll []), [ { node = Constant (String _); _ } ]) -> false
  | Apply (Builtin (Poll []), _) -> true
  | _ -> false

(* Of [count(k: _)] only the number of pairs matters. *)
let values_looked_into flow all =
  let is_values e = match e.node with Apply (Builtin Values_of, _) -> true | _ -> false in
  let counted e = match e.node with Apply (Method ("size", _), [ xs ]) when is_values xs -> Some xs | _ -> None in
  let counted = List.filter_map (fun (_, e) -> counted e) all in
  let key (lambda, e) =
    match e.node with
    | Apply (Builtin Values_of, [ k ]) ->
      let k = computed flow lambda k in
      if List.memq e counted then None else Some k
    | _ -> None
  in
  List.filter_map key all

(* The keys taken by a guard; code that it calls may take any. *)
let taken_by flow (guard : expression) =
  match guard.node with
  | Make_closure (lambda, _) ->
    let found = ref Keys.empty in
    let visit lambda e =
      match e.node with
      | Apply (Builtin (Consume keys), arguments) ->
        let taken = List.map fst (pairs flow lambda keys arguments) in
        found := Keys.union !found (Keys.of_list taken)
      | Apply (Call _, _) -> raise Looked_at
      | _ -> ()
    in
    Code_walk.iter_within visit [ lambda ];
    !found
  | _ -> raise Looked_at

(* By guards with their branches: the keys that are taken, and the keys that the values are posted with; [None] for
   any other use. *)
let makers (flow, _ as known) program =
  let maker guard body =
    let taken = taken_by flow guard in
    match body.node with
    | Make_closure (lambda, captured) when captured = [] || Array.length lambda.captures = List.length captured -> (
        match posted_by known lambda (fun _ -> Value) with
        | posted -> (taken, Some posted)
        | exception Looked_at -> (taken, None))
    | _ -> (taken, None)
  in
  let of_expression (_, e) =
    match e.node with
    | Apply (Make_branch, [ _; guard; body ]) | Apply (Builtin Make_wait_for, [ guard; body ]) ->
      Some (maker guard body)
    | Apply (Make_branch, _) | Apply (Builtin Make_wait_for, _) -> raise Looked_at
    | _ -> None
  in
  List.filter_map of_expression (expressions program)

(* The text of an error names the plan: handlers may only print it. *)
let check_handlers known program =
  let check (_, e) =
    match e.node with
    | Apply (Builtin Make_watch, [ _; { node = Make_closure (lambda, _); _ } ]) ->
      ignore (posted_by known lambda of_error)
    | Apply (Builtin Make_watch, _) -> raise Looked_at
    | _ -> ()
  in
  List.iter check (expressions program)

let keys flow (options : Environment.options) program =
  let known = (flow, options.plans) in
  check_handlers known program;
  let makers = makers known program in
  let all = expressions program in
  let looked_into = Keys.of_list (List.concat_map (looked_into flow) all @ values_looked_into flow all) in
  if List.exists asks_some_key all then raise Looked_at;
  (* A key is looked into, too, if its values are posted with one that is. *)
  let rec closed looked =
    let more looked (taken, posted) =
      match posted with
      | Some posted when Keys.disjoint posted looked -> looked
      | Some _ | None -> Keys.union taken looked
    in
    let next = List.fold_left more looked makers in
    if Keys.equal next looked then looked else closed next
  in
  (* Inputs add values of their own: the program may post equal ones. *)
  let brought = Keys.of_list (List.map (fun (i : Environment.input) -> Named i.key) options.inputs) in
  let looked = closed (Keys.union looked_into brought) in
  let given = List.fold_left (fun found (taken, _) -> Keys.union taken found) Keys.empty makers in
  Keys.diff given looked

(* {1 One value} *)

let one = String "any"

(* [_] is not a value to be posted: it remains a fault. *)
let unified_value (lambda : lambda) e =
  let slot = lambda.slots in
  lambda.slots <- slot + 1;
  let at node = { e with node } in
  let is_wildcard = at (Apply (Binary Equal, [ at (Local slot); at (Constant Wildcard) ])) in
  at (Block [ at (Set_local (slot, e)); at (If (is_wildcard, at (Local slot), at (Constant one))) ])

let unified flow keys program =
  let copies = ref [] in
  let rec lambda_of lambda =
    match List.assq_opt lambda !copies with
    | Some lambda -> lambda
    | None ->
      let copy = { lambda with label = lambda.label } in
      copies := (lambda, copy) :: !copies;
      copy.code <- expression copy lambda.code;
      copy
  and expression within e =
    let go = expression within in
    let node =
      match e.node with
      | Constant (Closure c) -> Constant (Closure { c with lambda = lambda_of c.lambda })
      | (Constant _ | Local _ | Global _ | Break | Continue) as node -> node
      | Make_closure (lambda, slots) -> Make_closure (lambda_of lambda, slots)
      | Set_local (slot, e) -> Set_local (slot, go e)
      | Set_global (i, e) -> Set_global (i, go e)
      | Return e -> Return (go e)
      | Block es -> Block (List.map go es)
      | If (a, b, c) -> If (go a, go b, go c)
      | While (a, b) -> While (go a, go b)
      | For (slot, a, b) -> For (slot, go a, go b)
      | Apply (Builtin (Post names), arguments) ->
        let alike = List.filter (fun (k, _) -> Keys.mem k keys) (pairs flow within names arguments) in
        let part e = if List.exists (fun (_, x) -> x == e) alike then unified_value within (go e) else go e in
        Apply (Builtin (Post names), List.map part arguments)
      | Apply (operation, arguments) -> Apply (operation, List.map go arguments)
    in
    { e with node }
  in
  let functions = List.map (fun (name, lambda) -> (name, lambda_of lambda)) program.functions in
  { program with main = lambda_of program.main; functions; on_interrupt = Option.map lambda_of program.on_interrupt }

let unify options program =
  if program.reads_sensors || program.reads_now then None
  else
    let flow = Code_flow.of_program program in
    match keys flow options program with
    | found when Keys.is_empty found -> None
    | found -> Some (unified flow found program)
    | exception Looked_at -> None
