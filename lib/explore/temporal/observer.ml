open Dolphin_semantics

type t = { action : Proposition.observed -> int; valuation : Encoding.t -> int -> int array -> int }

let nothing = 0

let seen observer observed = match observer with None -> nothing | Some t -> t.action observed

let of_transition observer transition =
  match observer with None -> nothing | Some t -> t.action (Proposition.observed transition)

let of_event observer ?ending label = seen observer { label; effects = []; ending }

(* The effects of the end of a run do not depend on the contexts of the task. *)
let of_local_step t ({ outcome; named; asked; _ } : Local_step.t) =
  let ending = match outcome with Ends ending -> Some ending | Goes_on _ | Over -> None in
  t.action { label = named; effects = asked; ending }
