open Ast

let located place it = { it; at = Location.make place }

type limit = During_limit of on_cut * expression | Until_limit of on_cut * closure | Ensure_limit of closure

type item = { base : expression; limits : (limit * Lexing.position) list }

let item base = { base; limits = [] }
let limit item limit stop = { item with limits = (limit, stop) :: item.limits }

let apply base limits =
  let apply base (limit, stop) =
    let at = { base.at with stop } in
    match limit with
    | During_limit (on_cut, duration) -> { it = During (on_cut, duration, base); at }
    | Until_limit (on_cut, condition) -> { it = Until (on_cut, condition, base); at }
    | Ensure_limit c -> { it = Ensure (base, c); at }
  in
  List.fold_left apply base (List.rev limits)

let settle { base; limits } = apply base limits

type argument_item =
  | Positional_item of item
  | Named_item of string located * item
  | Keyed_item of expression * item

let argument = function
  | Positional_item item -> Positional (settle item)
  | Named_item (name, item) -> Named (name, settle item)
  | Keyed_item (key, item) -> Keyed (key, settle item)

let is_execute callee =
  match callee.it with
  | Variable name -> name = "execute"
  | _ -> false

let command place callee arguments =
  let call at arguments = { it = Call { callee; arguments = List.rev_map argument arguments }; at } in
  let whole = Location.make place in
  match arguments with
  | last :: rest when not (is_execute callee) ->
    let bare, limits =
      match last with
      | Positional_item { base; limits } -> Positional_item (item base), (base, limits)
      | Named_item (name, { base; limits }) -> Named_item (name, item base), (base, limits)
      | Keyed_item (key, { base; limits }) -> Keyed_item (key, item base), (base, limits)
    in
    let base, limits = limits in
    { base = call { whole with stop = base.at.stop } (bare :: rest); limits }
  | arguments -> item (call whole arguments)

let trailing place call closure =
  match call.it with
  | Call { callee; arguments } ->
    located place (Call { callee; arguments = arguments @ [ Positional closure ] })
  | _ -> located place (Call { callee = call; arguments = [ Positional closure ] })

let give_back = "giveBack"

(* [waitFor { consume K: X } then (T ensure { giveBack() })]. *)
let using place arguments t =
  let call name arguments = located place (Call { callee = located place (Variable name); arguments }) in
  let code e = { parameters = None; body = [ located place (Expression e) ] } in
  let taken = call "consume" (List.rev_map argument arguments) in
  located place (Wait_for (code taken, located place (Ensure (t, code (call give_back [])))))
