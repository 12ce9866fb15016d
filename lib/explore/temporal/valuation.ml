open Dolphin_semantics

exception Broken of string

(* By place of the propositions. *)
module Valuations = Dolphin_checker.Interner.Make (struct
    type t = bool array

    let equal = ( = )
    let hash = Array.fold_left (fun h b -> ((2 * h) + Bool.to_int b) land max_int) 1
  end)

type t = {
  program : Core.program;
  world : World.t;
  propositions : Proposition.t array;
  asks_states : bool;
  actions : Valuations.t;
  states : Valuations.t;
  combined : Valuations.t;
  mutable pairs : int array array;  (* by action, then state: the valuation, or -1 *)
}

let create program world propositions =
  (* These numbers may differ between processes: no state contains them. *)
  let numbering = Dolphin_checker.Numbering.create () in
  let valuations () =
    let valuations = Valuations.create numbering in
    ignore (Valuations.number valuations (Array.map (fun _ -> false) propositions));
    valuations
  in
  let asks_states = Array.exists (fun p -> not (Proposition.needs_action p)) propositions in
  { program; world; propositions; asks_states; actions = valuations (); states = valuations ();
    combined = Valuations.create numbering; pairs = [||] }

let asks_states t = t.asks_states

let action_observed t observed =
  let holds p = Proposition.needs_action p && Proposition.holds_after p observed in
  Valuations.number t.actions (Array.map holds t.propositions)

let action t transition = action_observed t (Proposition.observed transition)

let state t c =
  if not t.asks_states then 0
  else
    let holds p = match Proposition.holds_in t.program t.world p c with Ok b -> b | Error why -> raise (Broken why) in
    Valuations.number t.states (Array.map holds t.propositions)

let find t action state =
  let a = Valuations.value t.actions action and s = Valuations.value t.states state in
  Valuations.number t.combined (Array.map2 ( || ) a s)

let grown xs length x = Array.append xs (Array.make (max (length - Array.length xs) (Array.length xs)) x)

let valuation t action state =
  if action >= Array.length t.pairs then t.pairs <- grown t.pairs (action + 1) [||];
  let row = t.pairs.(action) in
  if state < Array.length row && row.(state) >= 0 then row.(state)
  else begin
    if state >= Array.length row then t.pairs.(action) <- grown row (state + 1) (-1);
    t.pairs.(action).(state) <- find t action state;
    t.pairs.(action).(state)
  end

let holds t valuation place = (Valuations.value t.combined valuation).(place)
