open Dolphin_semantics
open Dolphin_environment

exception Wrong of string

type 'a part = { write : 'a -> string; read : string -> 'a }

type codec = {
  machine : Machine.t part;
  residual : Residual.t part;
  shared : (Shared.t * Environment.t) part;
  configuration : (Configuration.t * Environment.t) part;
}

type t = {
  codec : codec;
  encoding : Encoding.t;
  components : Components.t;
  (* Written: by numbers of the frame, of what is shared, of family and member, of the path. *)
  frames : (int, string) Hashtbl.t;
  shareds : (int, string) Hashtbl.t;
  members : (int * int, string) Hashtbl.t;
  contexts : (int, string) Hashtbl.t;
  places : (int, string) Hashtbl.t;  (* by number of the frame *)
  (* Read: frames and numbers of what is shared, and by number of the path what stands there. *)
  frames_read : (string, Layout.frame) Hashtbl.t;
  shareds_read : (string, int) Hashtbl.t;
  members_read : (int * string, Component.component) Hashtbl.t;
  contexts_read : (int * string, Component.path) Hashtbl.t;
}

let create codec encoding components =
  let table () = Hashtbl.create 256 in
  { codec; encoding; components; frames = table (); shareds = table (); members = table (); contexts = table ();
    places = table ();
    frames_read = table (); shareds_read = table (); members_read = table (); contexts_read = table () }

let memoised table key find =
  match Hashtbl.find_opt table key with
  | Some known -> known
  | None ->
    let found = find () in
    Hashtbl.add table key found;
    found

(* {1 Writing} *)

let script = 's'
let executing = 'e'
let leaf = 'l'
let nest = 'n'

(* Seven bits a byte, the lowest first. *)
let rec add_number buffer n =
  if n < 128 then Buffer.add_char buffer (Char.unsafe_chr n)
  else begin
    Buffer.add_char buffer (Char.unsafe_chr (128 lor (n land 127)));
    add_number buffer (n lsr 7)
  end

let add_part buffer text =
  add_number buffer (String.length text);
  Buffer.add_string buffer text

let frame_text t (frame : Layout.frame) =
  memoised t.frames frame.number (fun () -> t.codec.machine.write frame.machine)

let shared_text t number =
  let write () =
    let { Surroundings.shared; outside } = Surroundings.Numbers.value (Encoding.shareds t.encoding) number in
    t.codec.shared.write (shared, outside)
  in
  memoised t.shareds number write

let member_text t (c : Component.component) =
  memoised t.members (c.family.number, c.local) (fun () -> t.codec.residual.write c.residual)

let contexts_of (path : Component.path) = Residual.plug path.contexts Residual.hole
let contexts_text t (path : Component.path) =
  memoised t.contexts path.id (fun () -> t.codec.residual.write (contexts_of path))

let rec add_place t buffer layout key (place : Layout.place) =
  match place.inside with
  | None ->
    Buffer.add_char buffer leaf;
    add_part buffer (member_text t (Encoding.component layout key place.from))
  | Some path ->
    Buffer.add_char buffer nest;
    add_part buffer (contexts_text t path);
    add_places t buffer layout key place.children

and add_places t buffer layout key places =
  add_number buffer (List.length places);
  List.iter (add_place t buffer layout key) places

let script_text t number = String.make 1 script ^ t.codec.configuration.write (Encoding.script t.encoding number)

let write t key =
  let layouts = Encoding.layouts t.encoding in
  let number = Layouts.number layouts key.(0) and above = Layouts.shared layouts key.(0) in
  if number = 0 then script_text t above
  else begin
    let layout = Layouts.layout layouts number and buffer = Buffer.create 512 in
    Buffer.add_char buffer executing;
    add_part buffer (frame_text t layout.frame);
    add_part buffer (shared_text t above);
    add_places t buffer layout key layout.top;
    Buffer.contents buffer
  end

(* {1 Reading} *)

let wrong why = raise (Wrong why)

type source = { text : string; mutable at : int }

let byte s =
  if s.at >= String.length s.text then wrong "it ends too early";
  s.at <- s.at + 1;
  s.text.[s.at - 1]

let number s =
  let rec from shift n =
    let b = Char.code (byte s) in
    if shift > 28 then wrong "a number in it is too large";
    let n = n lor ((b land 127) lsl shift) in
    if b < 128 then n else from (shift + 7) n
  in
  from 0 0

let part s =
  let length = number s in
  if length > String.length s.text - s.at then wrong "it ends too early";
  s.at <- s.at + length;
  String.sub s.text (s.at - length) length

(* What is written otherwise than here would be a second text of the same state. *)
let read_part (p : _ part) text =
  let x = p.read text in
  if not (String.equal (p.write x) text) then wrong "a part of it is not written as dolphin writes it";
  x

let frame t text =
  memoised t.frames_read text (fun () -> Encoding.frame t.encoding (read_part t.codec.machine text) None)

let shared t text =
  let read () =
    let shared, outside = read_part t.codec.shared text in
    Surroundings.Numbers.number (Encoding.shareds t.encoding) (Surroundings.make shared outside)
  in
  memoised t.shareds_read text read

let member t (path : Component.path) text =
  let read () =
    match Components.children t.components path (read_part t.codec.residual text) with
    | [ Component.Leaf c ] -> c
    | _ -> wrong "a part of it has parts of its own"
  in
  memoised t.members_read (path.id, text) read

let inside t (path : Component.path) text =
  let read () =
    match Residual.decompose (read_part t.codec.residual text) with
    | (_ :: _ as contexts), hole when Residual.equal hole Residual.hole ->
      Components.in_contexts t.components path contexts
    | _, _ -> wrong "what stands around parts of it is none of contexts"
  in
  memoised t.contexts_read (path.id, text) read

let rec place t path s : Component.component Component.tree =
  match byte s with
  | c when c = leaf -> Leaf (member t path (part s))
  | c when c = nest ->
    let inside = inside t path (part s) in
    Nest (inside, places t inside ~least:2 s)
  | _ -> wrong "a part of it is of no kind"

and places t path ~least s =
  let count = number s in
  if count < least || count > String.length s.text then wrong "it has no such number of parts";
  List.init count (fun _ -> place t path s)

let read t key text =
  let s = { text; at = 0 } in
  match byte s with
  | c when c = script ->
    let text = String.sub text 1 (String.length text - 1) in
    let c, outside = read_part t.codec.configuration text in
    (match (c : Configuration.t).control with
     | Script _ | Waiting _ ->
       Encoding.write_script t.encoding key (Encoding.script_number t.encoding [] c outside);
       None
     | Ended _ -> Some (c, outside)
     | Executing _ -> wrong "a task that executes is not in parts")
  | c when c = executing ->
    let frame = frame t (part s) in
    let shared = shared t (part s) in
    let children = places t (Components.root t.components) ~least:1 s in
    if s.at < String.length text then wrong "it goes on after its end";
    Encoding.write_components t.encoding key frame children shared;
    None
  | _ -> wrong "it is of no kind"

(* {1 Places of the script} *)

let place t key =
  let layouts = Encoding.layouts t.encoding in
  let number = Layouts.number layouts key.(0) and above = Layouts.shared layouts key.(0) in
  if number = 0 then Digest.string (script_text t above)
  else
    let frame = (Layouts.layout layouts number).frame in
    memoised t.places frame.number (fun () -> Digest.string (String.make 1 executing ^ frame_text t frame))
