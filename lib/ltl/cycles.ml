type 'label graph = {
  successors : int -> (int * 'label) list;
  sets : int;
  is_in : int -> int -> bool;
}

type component = { first : int; members : (int, unit) Hashtbl.t }

let first c = c.first
let mem c i = Hashtbl.mem c.members i

(* {1 Components} *)

(* Which nodes were seen: bits. *)
module Seen = struct
  type t = { mutable bits : Bytes.t }

  let create () = { bits = Bytes.make 1_024 '\000' }
  let byte t i = if i lsr 3 < Bytes.length t.bits then Bytes.get_uint8 t.bits (i lsr 3) else 0
  let mem t i = byte t i land (1 lsl (i land 7)) <> 0

  let add t i =
    let length = Bytes.length t.bits in
    if i lsr 3 >= length then t.bits <- Bytes.cat t.bits (Bytes.make (max length ((i lsr 3) + 1 - length)) '\000');
    Bytes.set_uint8 t.bits (i lsr 3) (byte t i lor (1 lsl (i land 7)))
end

(* A component as far as it is known: its nodes are those of the path from place [from] on, up to the next root. *)
type root = { from : int; met : int list;  (* sets, in order *) is_cycle : bool }

let rec union xs ys =
  match xs, ys with
  | [], zs | zs, [] -> zs
  | x :: xs', y :: ys' ->
    if x < y then x :: union xs' ys else if y < x then y :: union xs ys' else x :: union xs' ys'

type 'label frame = { node : int; mutable rest : (int * 'label) list }

exception Found of int

(* The path is the nodes whose components are not finished, in the order in which they came. [leaves ~is_cycle] is
   called with each node of a component that is finished. A component that meets all sets is [Found] if there is one,
   unless [to_end]; the path has its nodes then. *)
let search ~tick ~to_end ~leaves g starts =
  let seen = Seen.create () and places = Hashtbl.create 1_000 in
  let path = Stack.create () and roots = Stack.create () and frames = Stack.create () in
  let all = List.init g.sets Fun.id in
  let enter i =
    tick ();
    Seen.add seen i;
    Hashtbl.replace places i (Stack.length path);
    Stack.push { from = Stack.length path; met = List.filter (g.is_in i) all; is_cycle = false } roots;
    Stack.push i path;
    Stack.push { node = i; rest = g.successors i } frames
  in
  let rec merge place met =
    let root = Stack.pop roots in
    let met = union root.met met in
    if root.from > place then merge place met
    else begin
      Stack.push { root with met; is_cycle = true } roots;
      if (not to_end) && List.compare_lengths met all = 0 then raise_notrace (Found root.from)
    end
  in
  let leave i =
    let root = Stack.top roots in
    if Hashtbl.find places i = root.from then begin
      ignore (Stack.pop roots);
      while Stack.length path > root.from do
        let j = Stack.pop path in
        Hashtbl.remove places j;
        leaves ~is_cycle:root.is_cycle j
      done
    end
  in
  let step frame =
    match frame.rest with
    | [] ->
      ignore (Stack.pop frames);
      leave frame.node
    | (j, _) :: rest ->
      frame.rest <- rest;
      if not (Seen.mem seen j) then enter j
      else Option.iter (fun place -> merge place []) (Hashtbl.find_opt places j)
  in
  let explore i =
    if not (Seen.mem seen i) then begin
      enter i;
      while not (Stack.is_empty frames) do
        step (Stack.top frames)
      done
    end
  in
  (path, fun () -> List.iter explore starts)

let find ?(tick = ignore) g starts =
  let path, go = search ~tick ~to_end:false ~leaves:(fun ~is_cycle:_ _ -> ()) g starts in
  match go () with
  | () -> None
  | exception Found from ->
    let members = Hashtbl.create 100 and first = ref max_int in
    while Stack.length path > from do
      let i = Stack.pop path in
      first := min !first i;
      Hashtbl.replace members i ()
    done;
    Some { first = !first; members }

let on_cycles ?(tick = ignore) g starts =
  let found = Seen.create () in
  let leaves ~is_cycle i = if is_cycle then Seen.add found i in
  let _, go = search ~tick ~to_end:true ~leaves g starts in
  go ();
  Seen.mem found

(* {1 Ways} *)

let way g ~within ~goal firsts =
  let before = Hashtbl.create 100 and queue = Queue.create () in
  let arrive parent (i, label) =
    if within i && not (Hashtbl.mem before i) then begin
      Hashtbl.add before i (parent, label);
      Queue.add i queue
    end
  in
  let rec back i rest =
    let parent, label = Hashtbl.find before i in
    let rest = (i, label) :: rest in
    match parent with None -> rest | Some parent -> back parent rest
  in
  let rec go () =
    match Queue.take_opt queue with
    | None -> None
    | Some i when goal i -> Some (back i [])
    | Some i ->
      List.iter (arrive (Some i)) (g.successors i);
      go ()
  in
  List.iter (arrive None) firsts;
  go ()

let rec last = function
  | [ (i, _) ] -> i
  | _ :: rest -> last rest
  | [] -> invalid_arg "Cycles.last: an empty way"

let around g component start =
  let go_on from goal =
    match way g ~within:(mem component) ~goal (g.successors from) with
    | Some way -> way
    | None -> invalid_arg "Cycles.around: no component"
  in
  (* The sets that the cycle has not met yet; the start counts at the end. *)
  let rec meet from missing cycle =
    match missing with
    | [] -> cycle
    | set :: missing ->
      let part = go_on from (fun i -> g.is_in i set) in
      let is_met set = List.exists (fun (i, _) -> g.is_in i set) part in
      meet (last part) (List.filter (fun set -> not (is_met set)) missing) (cycle @ part)
  in
  let missing = List.filter (fun set -> not (g.is_in start set)) (List.init g.sets Fun.id) in
  match meet start missing [] with
  | _ :: _ as cycle when last cycle = start -> cycle
  | [] -> go_on start (fun i -> i = start)
  | cycle -> cycle @ go_on (last cycle) (fun i -> i = start)
