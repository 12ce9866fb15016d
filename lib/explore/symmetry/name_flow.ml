open Dolphin_semantics
open Core

type t = {
  names : site option;
  readings : site option;
  places : bool;
  sensors : bool;
  abilities : bool;
  picks : bool;
  leaks : bool;
  texts : string list;
}

(* {1 Contents}

   The possible contents of a value: a set of these, as bits. Of tasks, only vehicles count. *)

let vehicles = 1
let text = 2
let map = 4
let reading = 8
let code = 16
let key = 32  (* of [fresh]; also of code and tasks that contain one *)
let nothing = 0
let has content k = k land content <> 0
let all = List.fold_left ( lor ) nothing

(* A supplier may name vehicles too, but these are fixed then: see [Canonical_vehicles.check_replies]. *)
let replies = text lor map

let rec of_value = function
  | String _ -> text
  | Vehicles _ -> vehicles
  | List xs -> List.fold_left (fun k x -> k lor of_value x) nothing (Vector.to_list xs)
  | Map entries -> List.fold_left (fun k (_, x) -> k lor of_value x) map entries
  | Reading _ -> reading
  | Unknown _ -> vehicles
  | Task _ -> vehicles
  | Closure _ -> code
  | Settings _ -> vehicles lor text lor map lor code
  | Host _ -> replies
  | Null | Boolean _ | Integer _ | Number _ | Wildcard | Symbol _ | Range _ | Position _ | Area _ -> nothing

(* {1 What is known so far} *)

type place = Variable of int | Slot of int * int  (** of a lambda *) | Result of int | Posted

type knowledge = {
  contents : (place, int) Hashtbl.t;
  lambdas : (int, lambda) Hashtbl.t;
  values : (int, lambda) Hashtbl.t;  (** those that may be called as the value of some expression *)
  handlers : (int, unit) Hashtbl.t;
  mutable grown : bool;
  mutable found : t;
}

let content w place = Option.value (Hashtbl.find_opt w.contents place) ~default:nothing

let add w place k =
  let before = content w place in
  if before lor k <> before then begin
    w.grown <- true;
    Hashtbl.replace w.contents place (before lor k)
  end

let note w (lambda : lambda) =
  if not (Hashtbl.mem w.lambdas lambda.id) then begin
    w.grown <- true;
    Hashtbl.add w.lambdas lambda.id lambda
  end

let note_value w (lambda : lambda) =
  note w lambda;
  if not (Hashtbl.mem w.values lambda.id) then begin
    w.grown <- true;
    Hashtbl.add w.values lambda.id lambda
  end

let uses_name w at = if w.found.names = None then w.found <- { w.found with names = Some at }
let uses_reading w at = if w.found.readings = None then w.found <- { w.found with readings = Some at }
let reads_places w = w.found <- { w.found with places = true }
let reads_sensors w = w.found <- { w.found with sensors = true }
let travels w = w.found <- { w.found with places = true; abilities = true }

let note_text w s =
  if not (List.mem s w.found.texts) then w.found <- { w.found with texts = s :: w.found.texts }

(* A value with this content becomes part of a text. *)
let put_into_text w at k =
  if has vehicles k then uses_name w at;
  if has reading k then uses_reading w at

(* The content of a call's result, [given slot] being that of the argument for [slot]. *)
let call w (lambda : lambda) given =
  for slot = 0 to lambda.parameters - 1 do add w (Slot (lambda.id, slot)) (given slot) done;
  content w (Result lambda.id)

(* Functions that are only called by their names are not among the code that a value may be. *)
let call_any w given = Hashtbl.fold (fun _ lambda results -> results lor call w lambda given) w.values nothing

(* The same for a call of the value of [e], with content [k], if it may be code. *)
let call_value w e k given =
  match e.node with
  | Make_closure (lambda, _) | Constant (Closure { lambda; _ }) -> call w lambda given
  | _ -> if has code k then call_any w given else nothing

(* {1 Methods} *)

(* Methods of sets of vehicles, and of values that contain vehicles, whose result does not depend on their names. *)
let of_numbers = [ "size"; "length"; "isEmpty"; "empty"; "contains"; "equals"; "indexOf"; "duration"; "energy"; "rest" ]
let of_texts = [ "getType"; "type"; "getPayload"; "payload" ]
let of_elements =
  [ "first"; "last"; "head"; "tail"; "get"; "add"; "push"; "leftShift"; "addAll"; "remove"; "removeAt"; "removeElement";
    "clear"; "reverse"; "unique"; "take"; "drop"; "toList" ]

let calling =
  [ "each"; "eachWithIndex"; "collect"; "collectWithIndex"; "findAll"; "filter"; "find"; "inject"; "any"; "every";
    "count"; "times" ]

(* A property or method with this name may look at a sensor of a vehicle: places and batteries contain no vehicles. *)
let looks w name =
  match Reading.subject name with
  | Some Position -> reads_places w; true
  | Some (Sensor _) -> reads_sensors w; true
  | None -> false

(* [k] is the content of the subject and the arguments; [calls given] calls the code among them with [given]. *)
let called_method w at name k calls =
  let shown = if has map k then k lor reading else reading in
  let is_one_of = List.mem name in
  let looks = looks w name in
  let given = if has map k then k lor text else k in
  (* The code in a map may be called by any name. *)
  let results = if name = "call" || is_one_of calling || has map k then calls given else nothing in
  (* [inject] passes results on. *)
  let results = if name = "inject" then calls (given lor results) else results in
  if looks then shown lor results
  else if has map k && has vehicles k && is_one_of [ "get"; "contains"; "remove" ] then (uses_name w at; k)
  else if is_one_of of_numbers then results
  else if is_one_of of_texts then text lor results
  else if is_one_of of_elements then k lor results
  else if is_one_of calling then given lor results
  else if name = "call" then results
  else begin
    let results = calls given in
    if has vehicles (k lor results) then uses_name w at;
    k lor text lor map lor results
  end

(* {1 Code} *)

let named_arguments names = if List.exists Option.is_some names then map else nothing

let rec constants e =
  match e.node with
  | Constant (String _) -> true
  | Apply (Make_list, es) -> List.for_all constants es
  | _ -> false

let rec value w (lambda : lambda) e =
  let value_of = value w lambda in
  let values es = all (List.map value_of es) in
  match e.node with
  | Constant x ->
    (match x with String s -> note_text w s | Closure c -> note_value w c.lambda | _ -> ());
    of_value x
  | Local 0 when Hashtbl.mem w.handlers lambda.id && lambda.parameters > 0 -> uses_name w e.site; text
  | Local slot -> content w (Slot (lambda.id, slot))
  | Global i -> content w (Variable i)
  | Set_local (slot, e) ->
    let k = value_of e in
    add w (Slot (lambda.id, slot)) k;
    k
  | Set_global (i, e) ->
    let k = value_of e in
    add w (Variable i) k;
    k
  | Make_closure (inner, slots) ->
    note_value w inner;
    let capture slot outer =
      if outer = 0 && Hashtbl.mem w.handlers lambda.id && lambda.parameters > 0 then uses_name w e.site;
      add w (Slot (inner.id, slot)) (content w (Slot (lambda.id, outer)))
    in
    List.iter2 capture (Array.to_list inner.captures) slots;
    code lor (all (List.map (fun slot -> content w (Slot (lambda.id, slot))) slots) land key)
  | If (test, yes, no) ->
    ignore (value_of test);
    let k = value_of yes in
    k lor value_of no
  | Block es -> List.fold_left (fun _ e -> value_of e) nothing es
  | While (test, body) -> ignore (values [ test; body ]); nothing
  | For (slot, range, body) ->
    let k = value_of range in
    add w (Slot (lambda.id, slot)) (if has map k then k lor text else k);
    ignore (value_of body);
    nothing
  | Return e -> add w (Result lambda.id) (value_of e); nothing
  | Break | Continue -> nothing
  | Apply (operation, arguments) -> applied w lambda e.site operation arguments

and applied w lambda at operation arguments =
  let value_of = value w lambda in
  let values es = all (List.map value_of es) in
  match operation, arguments with
  | Builtin (Message | Halt | Assert), [ e ] -> said w lambda e; nothing
  | Concatenate, es ->
    let k = values es in
    put_into_text w at k;
    text lor (k land key)
  | Builtin Ask, es -> put_into_text w at (values es); text lor map
  | Builtin Make_confirm, es -> put_into_text w at (values es); nothing
  | Builtin Get_supplier, _ -> replies
  | Binary Add, [ a; b ] ->
    let k = value_of a in
    let k' = value_of b in
    if has text (k lor k') then put_into_text w at (k lor k');
    k lor k'
  | Binary (Equal | Not_equal), es ->
    let k = values es in
    if has vehicles k then if has reading k then uses_reading w at;
    nothing
  | Binary Member_of, [ x; xs ] ->
    let k = value_of x in
    if has map (value_of xs) && has vehicles k then uses_name w at;
    nothing
  | Binary Parallel, [ x; y ] ->
    let k = value_of x in
    let k' = value_of y in
    ignore (call_value w y k' (fun _ -> k));
    k lor k'
  | Binary Divide, es -> values es land lnot code
  | Binary (Less | Less_equal | Greater | Greater_equal), es -> ignore (values es); nothing
  | (Element | Replace_element), x :: i :: rest ->
    let k = value_of x in
    let k' = value_of i in
    if has map k && has vehicles k' then uses_name w at;
    k lor k' lor values rest
  | Replace_member _, es -> map lor values es
  | Make_map keys, es ->
    let k = values es in
    if List.mem None keys && has vehicles k then uses_name w at;
    map lor k
  | Property ("id" | "ids"), [ x ] ->
    let k = value_of x in
    if has vehicles k then uses_name w at;
    k lor text
  | Property name, [ x ] ->
    let k = value_of x in
    let shown = if has map k then k lor reading else reading in
    if looks w name then shown else k lor text
  | Method (name, names), es ->
    let ks = List.map value_of es in
    let asks_how_far = Dolphin_semantics.Travel.quantity name <> None && List.compare_length_with es 1 > 0 in
    if asks_how_far then travels w;
    if name = "rest" then reads_sensors w;
    let calls given = all (List.map2 (fun e k -> call_value w e k (fun _ -> given)) es ks) in
    let result = called_method w at name (all ks lor named_arguments names) calls in
    if asks_how_far then result lor reading else result
  | Call names, callee :: es ->
    let k =
      match callee.node with
      | Constant (Closure { lambda; _ }) -> note w lambda; code
      | _ -> value_of callee
    in
    let ks = List.map value_of es in
    let given =
      if List.for_all Option.is_none names then fun slot -> Option.value (List.nth_opt ks slot) ~default:nothing
      else fun _ -> all ks lor map
    in
    call_value w callee k given
  | Builtin Make_watch, [ t; { node = Make_closure (handler, _); _ } as code ] ->
    if not (Hashtbl.mem w.handlers handler.id) then begin
      w.grown <- true;
      Hashtbl.add w.handlers handler.id ();
      (* The vehicle and the task of the error. *)
      add w (Slot (handler.id, 1)) vehicles;
      add w (Slot (handler.id, 2)) text
    end;
    values [ t; code ] land (vehicles lor key)
  | (Builtin Make_wait_for | Make_branch), es ->
    (* Code in the place of a task gets what the guard took. *)
    let taken = content w Posted in
    let give e k = ignore (call_value w e k (fun _ -> taken)) in
    let ks = List.map value_of es in
    List.iter2 give es ks;
    all ks land (vehicles lor key)
  | Builtin (Make_ensure forms), t :: es ->
    let k = value_of t in
    let k' = ensured w lambda at forms es in
    (k lor k') land (vehicles lor key)
  | Builtin Make_fresh, [ c ] ->
    (* Its keys are known to its task alone, unless that passes them on. *)
    call_value w c (value_of c) (fun _ -> text lor key) land vehicles
  | ( ( Builtin (Platform_task | Make_action | Make_condition | Make_until _ | Make_idle | Make_during _
                | Make_watch | Make_fresh | Make_ensure _ | Make_repeat _) ),
      es ) -> values es land (vehicles lor key)
  | Make_recruit, [ settings; code ] ->
    w.found <- { w.found with picks = true };
    ignore (value_of settings);
    let k = value_of code in
    let k = k lor call_value w code k (fun _ -> vehicles) in
    vehicles lor (k land key)
  | Builtin (Post keys), es ->
    let k = posted w lambda keys es in
    if List.mem None keys && has vehicles k then uses_name w at;
    add w Posted (if keys = [] then k lor text else k);
    nothing
  | Builtin (Consume keys | Poll keys), es ->
    if List.mem None keys && has vehicles (values es) then uses_name w at else ignore (values es);
    nothing
  | Builtin Values_of, es ->
    ignore (values es);
    let k = content w Posted in
    if has vehicles k then uses_name w at;
    k
  | Builtin Position_of, es -> ignore (values es); reads_places w; reading
  | Builtin (Sensor_of _ | Reading_of), es -> ignore (values es); reads_sensors w; reading
  | Builtin (Now | Time_of_day), _ -> reading
  | Builtin (Is_running | Is_a _), es -> ignore (values es); nothing
  | Builtin Eta, es -> ignore (values es); travels w; reading
  | Add_setting (name, _), so_far :: es ->
    let k = value_of so_far in
    let given = values es in
    if name = "region" then reads_places w;
    if name = "vehicles" then (if not (List.for_all constants es) then uses_name w at)
    else if has vehicles given then uses_name w at;
    k
  | Build (builder, _), es -> built w builder (values es)
  | Pick_if_any, es -> built w Pick (values es)
  | Unary Not, es -> ignore (values es); nothing
  | ( ( Unary _ | Binary _ | Make_list | Make_range _ | Element | Replace_element | Property _ | Call _ | Builtin _
      | Add_setting _ | Make_recruit ),
      es ) -> values es

(* Values that the task holds, keys too. *)
and ensured w lambda at forms es =
  match forms, es with
  | Pair_of (Some _) :: forms, x :: es ->
    let k = value w lambda x in
    add w Posted k;
    k lor ensured w lambda at forms es
  | Pair_of None :: forms, k :: x :: es ->
    let k = value w lambda k in
    if has vehicles k then uses_name w at;
    let k' = value w lambda x in
    add w Posted k';
    k lor k' lor ensured w lambda at forms es
  | Variable_of (i, _) :: forms, x :: es ->
    let k = value w lambda x in
    add w (Variable i) k;
    k lor ensured w lambda at forms es
  | Taken_pairs :: forms, es -> ensured w lambda at forms es
  | _, _ -> nothing

(* The content posted under these keys; the keys themselves are not passed on. *)
and posted w lambda keys es =
  match keys, es with
  | Some _ :: keys, x :: es ->
    let k = value w lambda x in
    k lor posted w lambda keys es
  | None :: keys, k :: x :: es ->
    let k = value w lambda k land lnot key in
    let k' = value w lambda x in
    k lor k' lor posted w lambda keys es
  | _, es -> all (List.map (value w lambda) es)

and built w builder k =
  match (builder : Dolphin_syntax.Ast.builder) with
  | Pick ->
    w.found <- { w.found with picks = true };
    vehicles
  | Imc_plan | Mission -> reads_places w; nothing
  | Pos -> nothing
  | All_of | One_of | Recruit -> k land (vehicles lor key)

(* Texts for people may contain names. *)
and said w lambda e =
  let say = said w lambda in
  match e.node with
  | Local (0 | 1 | 2) when Hashtbl.mem w.handlers lambda.id && lambda.parameters > 0 -> ()
  | Apply ((Concatenate | Binary Add), es) -> List.iter say es
  | Apply ((Method (("getId" | "getIds" | "toString" | "join"), _) | Property ("id" | "ids")), es) -> List.iter say es
  | If (test, yes, no) ->
    ignore (value w lambda test);
    say yes;
    say no
  | _ -> ignore (value w lambda e)

let of_program (program : program) ~asked =
  let found =
    { names = None; readings = None; places = false; sensors = false; abilities = false; picks = false; leaks = false;
      texts = [] }
  in
  let w =
    { contents = Hashtbl.create 64; lambdas = Hashtbl.create 16; values = Hashtbl.create 16;
      handlers = Hashtbl.create 8; grown = true; found }
  in
  List.iter (note w) (program.main :: List.map snd program.functions);
  (* Conditions have no closures; they get numbers that no code of the program has. *)
  List.iteri (fun i (c : closure) -> note w { c.lambda with id = -1 - i }) asked;
  let walk id (lambda : lambda) = add w (Result id) (value w lambda lambda.code) in
  while w.grown do
    w.grown <- false;
    Hashtbl.iter walk (Hashtbl.copy w.lambdas)
  done;
  let leaks place k found = found || (match place with Posted | Variable _ -> has key k | Slot _ | Result _ -> false) in
  { w.found with leaks = Hashtbl.fold leaks w.contents false }

let rec computes e =
  match e.node with
  | Constant (Null | Boolean _ | Integer _ | Number _ | String _ | Symbol _) -> true
  | Apply ((Unary _ | Binary _ | Make_list | Make_map _ | Make_range _ | Concatenate), es) ->
    List.for_all computes es
  | Block es -> List.for_all computes es
  | If (a, b, c) -> List.for_all computes [ a; b; c ]
  | _ -> false
