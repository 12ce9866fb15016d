open Dolphin_semantics

type t = {
  program : Core.program;
  world : World.t;
  condition : Condition.t;
  seen : (int, unit) Hashtbl.t;  (* by number of what is shared *)
  only_shared : bool;
  mutable broken : int option;
  mutable trouble : string option;
}

let create program world condition =
  let only_shared = Condition.only_shared condition in
  { program; world; condition; seen = Hashtbl.create 64; only_shared; broken = None; trouble = None }

let condition t = t.condition
let broken t = t.broken
let trouble t = t.trouble

let look t space i =
  match Condition.eval t.program t.world t.condition (fst (Space.state space i)) with
  | Holds | Not_yet -> ()
  | Fails -> t.broken <- Some i
  | Broken why -> if t.trouble = None then t.trouble <- Some why

let check t space i =
  if t.broken = None then
    let shared = if t.only_shared then Space.shared space i else -1 in
    if shared < 0 then look t space i
    else if not (Hashtbl.mem t.seen shared) then begin
      Hashtbl.add t.seen shared ();
      look t space i
    end
