open Dolphin_semantics

type t = {
  program : Core.program;
  world : World.t;
  condition : Condition.t;
  seen : (int, unit) Hashtbl.t;  (* by number of the shared state *)
  only_shared : bool;
  mutable broken : int option;
  mutable trouble : string option;
}

let create program world condition =
  let only_shared = Condition.only_shared condition && not program.Core.asks_running in
  { program; world; condition; seen = Hashtbl.create 64; only_shared; broken = None; trouble = None }

let condition t = t.condition
let broken t = t.broken
let trouble t = t.trouble

let look t graph i =
  match Condition.eval t.program t.world t.condition (fst (State_graph.state graph i)) with
  | Holds | Not_yet -> ()
  | Fails -> t.broken <- Some (State_graph.keep graph i)
  | Broken why -> if t.trouble = None then t.trouble <- Some why

let told t = Marshal.to_string (t.broken, t.trouble) []

let hear t ~first text =
  let (broken, trouble) : int option * string option = Marshal.from_string text 0 in
  let number = Option.value ~default:(-1) in
  (match first (number t.broken) (number broken) with -1 -> () | i -> t.broken <- Some i);
  if t.trouble = None then t.trouble <- trouble

let check t graph i =
  if t.broken = None then
    match if t.only_shared then State_graph.shared graph i else None with
    | None -> look t graph i
    | Some shared ->
      if not (Hashtbl.mem t.seen shared) then begin
        Hashtbl.add t.seen shared ();
        look t graph i
      end
