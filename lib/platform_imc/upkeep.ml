open Dolphin_runtime
open Station_state

(* The time after its first announcement when a vehicle that never spoke to us gets eager heartbeats; and the time
   after its last sign of life when one that fell silent gets heartbeats. *)
let contact_patience = 15.
let silence_patience = 300.
let most_queries = 50

(* It has announced itself and not spoken to us: it may have missed our announcement. *)
let is_awaited ~now (n : Node.t) =
  Node.is_vehicle n && n.last_heard = neg_infinity && n.address <> None && now -. n.first_announced < contact_patience

let is_kept ~now (n : Node.t) =
  Node.is_vehicle n && n.address <> None
  && (now -. Node.last_sign n < silence_patience || not (Execution.idle n.execution))

(* Entity lists that did not come are asked for again: programs pick vehicles by their payload. *)
let lacks_entities ~now (n : Node.t) =
  n.entities = None && n.last_heard > neg_infinity && n.queries > 0 && n.queries < most_queries
  && not (Node.silent ~now ~timeout:5. n)

let beat ~now s =
  let listens = listens ~now s in
  let awaited = listens || Systems.exists (fun n -> is_awaited ~now n || lacks_entities ~now n) s.systems in
  let presence, heartbeats = Presence.beat ~now ~awaited s.presence in
  let is_due =
    match heartbeats with
    | All -> is_kept ~now
    | Awaited -> is_awaited ~now
    | Nobody -> fun _ -> false
  in
  let s, beaten =
    for_each (fun n s -> (s, if is_due n then to_node ~now n Heartbeat s else [])) { s with presence }
  in
  if heartbeats = Nobody then (s, [])
  else
    let s, queried = for_each (fun n s -> if lacks_entities ~now n then query ~now n s else (s, [])) s in
    let held = holds ~now s in
    (* The last one reports that nothing is held. *)
    let is_free = s.settings.run = "" && Name_set.is_empty held && Name_set.is_empty s.claimed in
    let is_due = (heartbeats = All || listens) && not is_free in
    let claims = if is_due then claims ~now s else [] in
    ({ s with claimed = held }, claims @ beaten @ queried)

let announce ~now s =
  let awaited = listens ~now s || Systems.exists (is_awaited ~now) s.systems in
  let presence, is_due = Presence.announce ~now ~awaited s.presence in
  ({ s with presence }, if is_due then [ Announce (announcement ~now s) ] else [])

let expire ~now s =
  let expired, timers = Timers.expired ~now s.timers in
  List.fold_left (fun s timer -> push (Timer timer) s) { s with timers } expired

let was_connected (n : Node.t) s =
  match Outbox.told n.name s.outbox with Some state -> state.connected | None -> false

let seconds x = if x = 1. then "1 second" else Printf.sprintf "%.0f seconds" x
let no_word name s = Printf.sprintf "no word from the vehicle for %s" (seconds (timeout_of name s))

(* When the silence of [n] will have lasted too long, if that matters. *)
let end_of_link (n : Node.t) s =
  if was_connected n s || Execution.owes n.execution then n.last_heard +. timeout_of n.name s else infinity

(* When the known state of [n] becomes old, and its new state then: that it was busy, its place, that another has its
   address; and its holdings. *)
let turns (n : Node.t) =
  let rested = Option.fold n.freed ~none:infinity ~some:(fun at -> at +. Node.rest) in
  let unlocated = Option.fold n.located ~none:infinity ~some:(fun at -> at +. Node.currency) in
  let unshared = Option.fold n.shared ~none:infinity ~some:(fun at -> at +. Node.absence) in
  let unclaimed = Option.fold n.claim ~none:infinity ~some:(fun (at, _) -> at +. Claim.patience) in
  ([ (rested, Node.rested); (unlocated, Node.unlocated); (unshared, Node.unshared) ], unclaimed)

let turn ~now (n : Node.t) s =
  let changes, unclaimed = turns n in
  let turned s (at, change) =
    if now < at then s
    else
      let n = change (again n s) in
      tell ~now n (update n s)
  in
  let s = List.fold_left turned s changes in
  if now < unclaimed then s
  else
    let held = held_by n in
    tell_all ~now held (Listening.let_go ~now held (with_claims (update (Node.unclaimed (again n s)) s)))

let check ~now (n : Node.t) s =
  let s = turn ~now n s in
  let n = again n s in
  let timeout = timeout_of n.name s in
  let s, more = if Execution.due n.execution <= now then command ~now Tick n s else (s, []) in
  let n = again n s in
  let s, lost =
    if not (Execution.owes n.execution && Node.silent ~now ~timeout n) then (s, [])
    else command ~now (Lost (no_word n.name s)) n s
  in
  let n = again n s in
  let s = if was_connected n s && Node.silent ~now ~timeout n then tell ~now n s else s in
  (s, lost @ more)

let give_up ~now s =
  let late, expected = Expected.give_up ~now s.expected in
  let fail s (v, _) = push (Task_failed (v, no_word v s)) s in
  let keep (v, note) = Option.map (fun note -> Keep (v, note)) note in
  (List.fold_left fail { s with expected } late, List.filter_map keep late)

(* It is known by now who holds what. *)
let look_again ~now s =
  if now < s.wary_until then (s, [])
  else if s.wary_until = neg_infinity then (s, [])
  else for_each (Listening.take_over ~now) { s with wary_until = neg_infinity; resuming = false }

let tick ~now s =
  let s = awake ~now s in
  let s, resumed = look_again ~now s in
  let s, announced = announce ~now s in
  let s, beaten = beat ~now s in
  let s, checked = for_each (check ~now) s in
  let s, given_up = give_up ~now s in
  (expire ~now s, given_up @ resumed @ announced @ beaten @ checked)

let due s =
  let of_node time (n : Node.t) = Float.min time (Float.min (Execution.due n.execution) (end_of_link n s)) in
  let of_node time n =
    let changes, unclaimed = turns n in
    List.fold_left (fun time (at, _) -> Float.min at time) (Float.min (of_node time n) unclaimed) changes
  in
  let first v _ time = Float.min time (deferred_until v s) in
  let wary = if s.wary_until = neg_infinity then infinity else s.wary_until in
  let own = Names.fold first s.deferred wary in
  let own = Float.min own (Float.min (Presence.due s.presence) 
                             (Float.min (Timers.first s.timers) (Expected.due s.expected))) in
  List.fold_left of_node own (Systems.to_list s.systems)
