open Dolphin_results
open Core
open Code

(* The rest of a loop: elements from an index on, or numbers up to and with the last, up or down. *)
type items = Items of value array * int | Counting of int * int

type frame =
  | Arguments of { operation : operation; at : site; evaluated : value list; remaining : expression list }
  | Assign_local of int
  | Assign_global of int
  | Choose of expression * expression
  | Rest of expression list
  | Loop_test of expression * expression
  | Loop_body of expression * expression
  | Next_item of int * items * expression
  | Leave of value array
  | Iterate of {
      iteration : iteration;
      closure : closure;
      subject : value;
      items : value array;
      index : int;  (* of the item whose result is awaited *)
      gathered : value list;  (* latest first *)
      at : site;
    }

type focus = Evaluate of expression | Give of value

type t = { focus : focus; locals : value array; stack : frame list; calls : int; at : site }

let site m = match m.focus with Evaluate e -> e.site | Give _ -> m.at

(* Order. An expression is known by its site, which elaboration makes unique. *)

let compare_expression (e : expression) (e' : expression) = Int.compare e.site e'.site

let compare_values = Order.array Value.compare
let compare_lists xs ys = Order.both (List.compare_lengths xs ys) (fun () -> List.compare Value.compare xs ys)

let compare_items a b =
  match a, b with
  | Items (xs, i), Items (ys, j) -> Order.both (Int.compare i j) (fun () -> compare_values xs ys)
  | Counting (i, n), Counting (j, m) -> Order.both (Int.compare i j) (fun () -> Int.compare n m)
  | Items _, Counting _ -> -1
  | Counting _, Items _ -> 1

let rank_frame = function
  | Arguments _ -> 0 | Assign_local _ -> 1 | Assign_global _ -> 2 | Choose _ -> 3 | Rest _ -> 4 | Loop_test _ -> 5
  | Loop_body _ -> 6 | Next_item _ -> 7 | Leave _ -> 8 | Iterate _ -> 9

let compare_frame a b =
  match a, b with
  | Arguments a, Arguments b ->
    Order.both (Int.compare a.at b.at) (fun () ->
        Order.both (List.compare_lengths a.remaining b.remaining) (fun () ->
            compare_lists a.evaluated b.evaluated))
  | Assign_local i, Assign_local j | Assign_global i, Assign_global j -> Int.compare i j
  | Choose (e, _), Choose (e', _) | Loop_test (e, _), Loop_test (e', _) | Loop_body (e, _), Loop_body (e', _) ->
    compare_expression e e'
  | Rest es, Rest es' -> List.compare compare_expression es es'
  | Next_item (i, items, e), Next_item (j, items', e') ->
    Order.both (Int.compare i j) (fun () ->
        Order.both (compare_expression e e') (fun () -> compare_items items items'))
  | Leave xs, Leave ys -> compare_values xs ys
  | Iterate a, Iterate b ->
    Order.both (Int.compare a.at b.at) (fun () ->
        Order.both (Int.compare a.index b.index) (fun () ->
            Order.both (Value.compare_closure a.closure b.closure) (fun () ->
                Order.both (compare_values a.items b.items) (fun () ->
                    compare_lists a.gathered b.gathered))))
  | ( ( Arguments _ | Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _ | Next_item _
      | Leave _ | Iterate _ ),
      _ ) -> Int.compare (rank_frame a) (rank_frame b)

let compare_focus a b =
  match a, b with
  | Evaluate e, Evaluate e' -> compare_expression e e'
  | Give x, Give y -> Value.compare x y
  | Evaluate _, Give _ -> -1
  | Give _, Evaluate _ -> 1

let compare m m' =
  if m == m' then 0
  else
    Order.both (compare_focus m.focus m'.focus) (fun () ->
        Order.both (Int.compare m.at m'.at) (fun () ->
            Order.both (compare_values m.locals m'.locals) (fun () ->
                List.compare compare_frame m.stack m'.stack)))

let hash m =
  let focus = match m.focus with Evaluate e -> e.site | Give x -> Value.hash x in
  let frame h = function
    | Arguments a -> (h * 31) + a.at
    | Next_item (_, Items (_, i), _) | Next_item (_, Counting (i, _), _) -> (h * 31) + i
    | Iterate i -> (h * 31) + i.index
    | (Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _ | Leave _) as f ->
      (h * 31) + rank_frame f
  in
  (List.fold_left frame focus m.stack * 65599) + Value.hash (List (Vector.of_array m.locals)) + m.at

let name_of_call ~subject ~member =
  match subject with None -> member | Some subject -> subject ^ "." ^ member

let compare_request a b =
  match a, b with
  | Pick a, Pick b -> Settings.compare_pick a b
  | Ask a, Ask b -> String.compare a b
  | Pause a, Pause b -> Float.compare a b
  | Execute a, Execute b -> Value.compare_task a b
  | Host_call a, Host_call b ->
    let arguments = Option.compare compare_lists in
    Order.both (Option.compare String.compare a.subject b.subject) (fun () ->
        Order.both (String.compare a.member b.member) (fun () -> arguments a.arguments b.arguments))
  | (Pick _ | Ask _ | Pause _ | Execute _ | Host_call _), _ ->
    let rank = function Pick _ -> 0 | Ask _ -> 1 | Pause _ -> 2 | Execute _ -> 3 | Host_call _ -> 4 in
    Int.compare (rank a) (rank b)

type stop =
  | Exhausted
  | Finished of value
  | Left_off
  | Did of deed
  | Waits of request
  | Halted of string
  | Faulted of Fault.t

let maximum_calls = 10_000

let locals_of closure arguments =
  let { lambda; captured } = closure in
  let locals = Array.make lambda.slots Null in
  List.iteri (fun i x -> if i < lambda.parameters then locals.(i) <- x) arguments;
  Array.iteri (fun i slot -> locals.(slot) <- captured.(i)) lambda.captures;
  locals

let call closure arguments =
  let code = closure.lambda.code in
  { focus = Evaluate code; locals = locals_of closure arguments; stack = []; calls = 0; at = code.site }

let give x m = { m with focus = Give x }

let rec last = function [] -> None | [ frame ] -> Some frame | _ :: frames -> last frames

(* The task of [onInterrupt] is the argument of its end, so that is at the bottom of the stack all along. *)
let is_leaving m =
  match last m.stack, m.focus with
  | Some (Arguments { operation = Builtin Interrupted; _ }), _ -> true
  | None, Evaluate { node = Apply (Builtin Interrupted, _); _ } -> true
  | (Some _ | None), _ -> false

let arity_fault (lambda : lambda) n =
  if n = lambda.parameters || (lambda.implicit && n = 0) then None
  else
    Some
      (Printf.sprintf "%s takes %d argument%s, not %d" lambda.label lambda.parameters
         (if lambda.parameters = 1 then "" else "s")
         n)

(* {1 The loop} *)

let machine focus locals stack calls at = { focus; locals; stack; calls; at }
let fault context m at message = Decision.Decided (Faulted (Fault.make at message), m, context)

let set_local locals slot x =
  let locals = Array.copy locals in
  locals.(slot) <- x;
  locals

let rec evaluate context fuel (e : expression) locals stack calls : (stop * t * context) Decision.t =
  if fuel <= 0 then Decision.Decided (Exhausted, machine (Evaluate e) locals stack calls e.site, context)
  else
    let fuel = fuel - 1 in
    let continue x = proceed context fuel x locals stack calls e.site in
    match e.node with
    | Constant x -> continue x
    | Local slot -> continue locals.(slot)
    | Global i -> (
        match Store.find i context.store with
        | Some x -> continue x
        | None ->
          let m = machine (Evaluate e) locals stack calls e.site in
          fault context m e.site
            (Printf.sprintf "'%s' has no value yet" context.program.global_names.(i)))
    | Set_local (slot, e) -> evaluate context fuel e locals (Assign_local slot :: stack) calls
    | Set_global (i, e) -> evaluate context fuel e locals (Assign_global i :: stack) calls
    | Apply (operation, []) -> perform context fuel operation e.site [] locals stack calls
    | Apply (operation, first :: remaining) ->
      evaluate context fuel first locals
        (Arguments { operation; at = e.site; evaluated = []; remaining } :: stack)
        calls
    | Make_closure (lambda, slots) -> (
        match Results.map (fun slot -> Reading.settled e.site locals.(slot)) slots with
        | Ok captured -> continue (Closure { lambda; captured = Array.of_list captured })
        | Error fault -> Unclear fault)
    | If (test, yes, no) -> evaluate context fuel test locals (Choose (yes, no) :: stack) calls
    | Block [] -> continue Null
    | Block [ last ] -> evaluate context fuel last locals stack calls
    | Block (first :: rest) -> evaluate context fuel first locals (Rest rest :: stack) calls
    | While (test, body) -> evaluate context fuel test locals (Loop_test (test, body) :: stack) calls
    | For (slot, range, body) ->
      evaluate context fuel range locals (Next_item (slot, Items ([||], -1), body) :: stack) calls
    | Return e -> evaluate context fuel e locals (leave stack) calls
    | Break -> proceed context fuel Null locals (after_loop stack) calls e.site
    | Continue -> proceed context fuel Null locals (to_loop stack) calls e.site

(* Frames between here and the end of the function, or of the script, are dropped. *)
and leave = function
  | (Leave _ :: _ | []) as stack -> stack
  | _ :: stack -> leave stack

and after_loop = function
  | (Loop_body _ | Next_item _) :: stack -> stack
  | _ :: stack -> after_loop stack
  | [] -> []

and to_loop = function
  | (Loop_body _ | Next_item _) :: _ as stack -> stack
  | _ :: stack -> to_loop stack
  | [] -> []

and proceed context fuel x locals stack calls at : (stop * t * context) Decision.t =
  match stack with
  | [] -> Decided (Finished x, machine (Give x) locals [] calls at, context)
  | frame :: stack -> (
      match frame with
      | Arguments { operation; at; evaluated; remaining = [] } ->
        perform context fuel operation at (List.rev (x :: evaluated)) locals stack calls
      | Arguments ({ evaluated; remaining = next :: remaining; _ } as a) ->
        evaluate context fuel next locals
          (Arguments { a with evaluated = x :: evaluated; remaining } :: stack)
          calls
      | Assign_local slot -> proceed context fuel x (set_local locals slot x) stack calls at
      | Assign_global i ->
        proceed { context with store = Store.set i x context.store } fuel x locals stack calls at
      | Choose (yes, no) -> choose context fuel x yes no locals stack calls at
      | Rest [] -> proceed context fuel x locals stack calls at
      | Rest [ last ] -> evaluate context fuel last locals stack calls
      | Rest (next :: rest) -> evaluate context fuel next locals (Rest rest :: stack) calls
      | Loop_test (test, body) -> (
          match Reading.settled at x with
          | Ok (Unknown u) -> needs context u locals stack calls at
          | Ok x when Value.truth x -> evaluate context fuel body locals (Loop_body (test, body) :: stack) calls
          | Ok _ -> proceed context fuel Null locals stack calls at
          | Error fault -> Unclear fault)
      | Loop_body (test, body) -> evaluate context fuel test locals (Loop_test (test, body) :: stack) calls
      | Next_item (slot, Items (_, -1), body) -> begin_loop context fuel x slot body locals stack calls at
      | Next_item (slot, items, body) -> next_item context fuel slot items body locals stack calls at
      | Leave callers -> proceed context fuel x callers stack (calls - 1) at
      | Iterate i -> (
          let item = i.items.(i.index) in
          let settled =
            match i.iteration with
            | Each -> Ok x
            | (Sort | Greatest | Least) when World.is_open context.world && Rest.has_some_rest x ->
              Error (Rest.in_doubt i.at)
            | _ -> Reading.settled i.at x
          in
          match Result.map (fun x -> (x, Iteration.early i.iteration item x)) settled with
          | Error fault -> Unclear fault
          | Ok (_, Some result) -> proceed context fuel result locals stack calls i.at
          | Ok (x, None) ->
            iterate context fuel
              (Iterate { i with gathered = x :: i.gathered; index = i.index + 1 })
              locals stack calls))

(* [a && b] is [if a then b else false], [a || b] is [if a then true else b]. *)
and choose context fuel x yes no locals stack calls at : (stop * t * context) Decision.t =
  match Reading.settled at x with
  | Error fault -> Unclear fault
  | Ok (Unknown u as x) -> (
      match yes.node, no.node with
      | _, Constant (Boolean false) -> proceed context fuel x locals stack calls at
      | Constant (Boolean true), _ ->
        evaluate context fuel no locals
          (Arguments { operation = Binary Or; at; evaluated = [ x ]; remaining = [] } :: stack)
          calls
      | _, _ -> needs context u locals stack calls at)
  | Ok x -> evaluate context fuel (if Value.truth x then yes else no) locals stack calls

and needs context u locals stack calls at : (stop * t * context) Decision.t =
  Decided (Faulted (Fault.unknown at u), machine (Give (Unknown u)) locals stack calls at, context)

and begin_loop context fuel x slot body locals stack calls at : (stop * t * context) Decision.t =
  let start items = next_item context fuel slot items body locals stack calls at in
  match Reading.settled at x with
  | Error fault -> Unclear fault
  | Ok (Range (first, last)) -> start (Counting (first, last))
  | Ok Null -> proceed context fuel Null locals stack calls at
  | Ok x -> (
      match Value.items x with
      | Some items -> start (Items (items, 0))
      | None ->
        let m = machine (Give x) locals stack calls at in
        fault context m at (Operators.instead_of "a list, range, map, string or vehicle set to loop over" x))

and next_item context fuel slot items body locals stack calls at =
  let go x items =
    evaluate context fuel body (set_local locals slot x) (Next_item (slot, items, body) :: stack) calls
  in
  match items with
  | Items (xs, i) when i < Array.length xs -> go xs.(i) (Items (xs, i + 1))
  | Counting (i, last) when i = last -> go (Integer i) (Items ([||], 0))
  | Counting (i, last) -> go (Integer i) (Counting ((if i < last then i + 1 else i - 1), last))
  | Items _ -> proceed context fuel Null locals stack calls at

and iterate context fuel frame locals stack calls =
  match frame with
  | Iterate i when i.index < Array.length i.items ->
    let item = i.items.(i.index) in
    let arguments = Iteration.arguments i.iteration i.closure i.subject item i.index i.gathered in
    enter context fuel i.closure arguments i.at locals (frame :: stack) calls
  | Iterate i ->
    let outcome =
      match Unknown.iterated i.iteration i.gathered with
      | Ok (Some x) -> Value x
      | Ok None -> Procedures.of_result (Iteration.conclude i.iteration i.subject i.items i.gathered)
      | Error u -> Wrong_at (Fault.unknown i.at u)
    in
    settle_outcome context fuel outcome i.at locals stack calls
  | _ -> invalid_arg "Machine.iterate"

and enter context fuel closure arguments at locals stack calls =
  match arity_fault closure.lambda (List.length arguments) with
  | Some message -> fault context (machine (Give Null) locals stack calls at) at message
  | None when calls >= maximum_calls ->
    fault context
      (machine (Give Null) locals stack calls at)
      at
      (Printf.sprintf "calls nest more than %d deep: does %s call itself without end?" maximum_calls
         closure.lambda.label)
  | None ->
    (* A call in tail position needs no frame of its own: its caller's locals are not looked at again. *)
    let stack, calls =
      match stack with Leave _ :: _ -> (stack, calls) | [] | _ :: _ -> (Leave locals :: stack, calls + 1)
    in
    evaluate context fuel closure.lambda.code (locals_of closure arguments) stack calls

and perform context fuel operation at arguments locals stack calls =
  let fuel = fuel - Work.of_operation operation arguments in
  settle_outcome context fuel (Operation.apply context at operation arguments) at locals stack calls

and settle_outcome context fuel (outcome : outcome) at locals stack calls : (stop * t * context) Decision.t =
  let stopped focus = machine focus locals stack calls at in
  match outcome with
  | Value x -> proceed context fuel x locals stack calls at
  | Done (deed, context, x) -> (
      let context = { context with deeds = deed :: context.deeds } in
      match context.mode with
      | Script -> Decided (Did deed, stopped (Give x), context)
      | Task_code | Handler _ -> proceed context fuel x locals stack calls at)
  | Judged verdict -> proceed { context with mode = Handler verdict } fuel Null locals stack calls at
  | Enter (closure, arguments) -> enter context fuel closure arguments at locals stack calls
  | Walk (iteration, closure, subject, gathered) ->
    let items = Iteration.items subject in
    iterate context fuel
      (Iterate { iteration; closure; subject; items; index = 0; gathered; at })
      locals stack calls
  | Wait request -> Decided (Waits request, stopped (Give Null), context)
  | Stop message -> Decided (Halted message, stopped (Give Null), context)
  | Leave_off -> Decided (Left_off, stopped (Give Null), context)
  | Wrong message -> fault context (stopped (Give Null)) at message
  | Wrong_at f -> Decided (Faulted f, stopped (Give Null), context)
  | Refuted message -> Decided (Faulted (Fault.assertion at message), stopped (Give Null), context)
  | Asks (question, answered) ->
    let go_on world = settle_outcome { context with world } fuel (answered world) at locals stack calls in
    Decision.ask context.world question go_on
  | Unclear fault -> Unclear fault

(* {1 Readings} *)

(* As [List.mapi], of lists of any length. *)
let mapi f xs = Array.to_list (Array.mapi f (Array.of_list xs))

(* A kept reading is known by its place: readings that were made in different steps are seldom the same. *)
let keep_readings m =
  let keep where i x = match x with Reading r -> Reading { r with text = Printf.sprintf "%s %d" where i } | x -> x in
  let frame depth = function
    | Arguments a ->
      Arguments { a with evaluated = mapi (keep (Printf.sprintf "argument at %d:" depth)) a.evaluated }
    | Leave callers -> Leave (Array.mapi (keep (Printf.sprintf "local at %d:" depth)) callers)
    | ( Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _ | Next_item _
      | Iterate _ ) as frame -> frame
  in
  let focus = match m.focus with Give x -> Give (keep "value" 0 x) | Evaluate _ as focus -> focus in
  let depth = List.length m.stack in
  { m with
    focus;
    locals = Array.mapi (keep "local") m.locals;
    stack = mapi (fun i f -> frame (depth - i) f) m.stack }

let run ~fuel context m =
  match m.focus with
  | Evaluate e -> evaluate context fuel e m.locals m.stack m.calls
  | Give x -> proceed context fuel x m.locals m.stack m.calls m.at
