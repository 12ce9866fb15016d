open Dolphin_semantics
open Dolphin_environment

exception Wrong of string
exception Ambiguous

type 'a part = { write : 'a -> string; read : string -> 'a }

type codec = {
  machine : Machine.t part;
  residual : Residual.t part;
  shared : (Shared.t * Environment.t) part;
  configuration : (Configuration.t * Environment.t) part;
}

(* By names, which are digests. *)
module Names = Hashtbl.Make (struct
    type t = int

    let equal = Int.equal
    let hash name = name
  end)

(* Places of components, read from a shape. *)
type stand = Component_of of Component.component Names.t * Component.path | Nest_in of Component.path * stand list

type shape = {
  frame : Layout.frame;
  stands : stand list;
  breadth : int;
}

(* Names by small numbers that count from 0: -1 if not numbered yet. *)
type numbered = { mutable names : int array }

type t = {
  codec : codec;
  digest : string -> string;
  encoding : Encoding.t;
  components : Components.t;
  texts : string Names.t;  (* of all parts that are known *)
  mutable news : string list;  (* latest first *)
  (* Already written: by numbers of the frame, of the path, of the layout, of the shared part, of family and member. *)
  frames : numbered;
  contexts : numbered;
  layouts : numbered;
  shareds : numbered;
  mutable members : numbered array;
  places : (int, string) Hashtbl.t;  (* by number of the frame, or -1 less that of the configuration *)
  (* Read: by name, and by number of the path what stands there. *)
  shapes_read : shape Names.t;
  shareds_read : int Names.t;
  members_read : (int, Component.component Names.t) Hashtbl.t;
}

let create ?(digest = Digest.string) codec encoding components =
  let numbered () = { names = [||] } and names () = Names.create 256 in
  { codec; digest; encoding; components; texts = Names.create 256; news = []; frames = numbered ();
    contexts = numbered (); layouts = numbered (); shareds = numbered (); members = [||]; places = Hashtbl.create 16;
    shapes_read = names (); shareds_read = names (); members_read = Hashtbl.create 16 }

(* {1 Parts} *)

(* The name of [text], and whether it is new. *)
let know t text =
  let name = Int64.to_int (String.get_int64_le (t.digest text) 0) land max_int in
  match Names.find_opt t.texts name with
  | Some known when String.equal known text -> (name, false)
  | Some _ -> raise Ambiguous
  | None ->
    Names.add t.texts name text;
    (name, true)

let give t text = ignore (know t text)

let name t text =
  let name, is_new = know t text in
  if is_new then t.news <- text :: t.news;
  name

let news t =
  let news = t.news in
  t.news <- [];
  List.rev news

let grown items i fill =
  let longer = Array.make (max 16 (2 * (i + 1))) fill in
  Array.blit items 0 longer 0 (Array.length items);
  longer

(* [numbered t n i write] is the name that [i] has in [n]: that of the text that [write ()] gives, the first time. *)
let numbered t n i write =
  if i >= Array.length n.names then n.names <- grown n.names i (-1);
  let known = Array.unsafe_get n.names i in
  if known >= 0 then known
  else begin
    let name = name t (write ()) in
    n.names.(i) <- name;
    name
  end

(* {1 Shapes}

   A state in which a task executes is a shape, and names for the parts in it. *)

type tree = Leaf | Nest of int * tree list  (* with the name of its contexts *)

let leaf = 'l'
let nest = 'n'

(* Seven bits a byte, the lowest first. *)
let rec add_number buffer n =
  if n < 128 then Buffer.add_char buffer (Char.unsafe_chr n)
  else begin
    Buffer.add_char buffer (Char.unsafe_chr (128 lor (n land 127)));
    add_number buffer (n lsr 7)
  end

let add_name buffer name = Buffer.add_int64_le buffer (Int64.of_int name)

let rec add_tree buffer = function
  | Leaf -> Buffer.add_char buffer leaf
  | Nest (contexts, trees) ->
    Buffer.add_char buffer nest;
    add_name buffer contexts;
    add_trees buffer trees

and add_trees buffer trees =
  add_number buffer (List.length trees);
  List.iter (add_tree buffer) trees

let shape_text machine trees =
  let buffer = Buffer.create 64 in
  add_name buffer machine;
  add_trees buffer trees;
  Buffer.contents buffer

(* {1 Writing} *)

let script = 's'
let executing = 'e'
let frame_text t (frame : Layout.frame) = t.codec.machine.write frame.machine
let frame_name t (frame : Layout.frame) = numbered t t.frames frame.number (fun () -> frame_text t frame)

let contexts_name t (path : Component.path) =
  numbered t t.contexts path.id (fun () -> t.codec.residual.write (Residual.plug path.contexts Residual.hole))

let shape_name t (layout : Layout.t) =
  let rec tree (place : Layout.place) =
    match place.inside with None -> Leaf | Some path -> Nest (contexts_name t path, List.map tree place.children)
  in
  numbered t t.layouts layout.number (fun () -> shape_text (frame_name t layout.frame) (List.map tree layout.top))

let shared_name t number =
  let write () =
    let { Surroundings.shared; outside } = Surroundings.Numbers.value (Encoding.shareds t.encoding) number in
    t.codec.shared.write (shared, outside)
  in
  numbered t t.shareds number write

let member_name t (c : Component.component) =
  let family = c.family.number in
  if family >= Array.length t.members then begin
    let before = Array.length t.members in
    t.members <- grown t.members family { names = [||] };
    for i = before to Array.length t.members - 1 do t.members.(i) <- { names = [||] } done
  end;
  numbered t t.members.(family) c.local (fun () -> t.codec.residual.write c.residual)

let script_text t number = String.make 1 script ^ t.codec.configuration.write (Encoding.script t.encoding number)

let write t key =
  let layouts = Encoding.layouts t.encoding in
  let number = Layouts.number layouts key.(0) and above = Layouts.shared layouts key.(0) in
  if number = 0 then script_text t above
  else begin
    let layout = Layouts.layout layouts number in
    let breadth = Array.length layout.families in
    let text = Bytes.create (1 + (8 * (2 + breadth))) in
    let put i name = Bytes.set_int64_le text (1 + (8 * i)) (Int64.of_int name) in
    Bytes.set text 0 executing;
    put 0 (shape_name t layout);
    put 1 (shared_name t above);
    for i = 0 to breadth - 1 do
      put (2 + i) (member_name t (Encoding.component layout key i))
    done;
    Bytes.unsafe_to_string text
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

let unknown () = wrong "it names a part that was not given"

let name_at text at =
  let word = String.get_int64_le text at in
  let name = Int64.to_int word in
  if name >= 0 && Int64.equal (Int64.of_int name) word then name else unknown ()

let read_name s =
  if String.length s.text - s.at < 8 then wrong "it ends too early";
  s.at <- s.at + 8;
  name_at s.text (s.at - 8)

let rec read_tree s =
  match byte s with
  | c when c = leaf -> Leaf
  | c when c = nest ->
    let contexts = read_name s in
    Nest (contexts, read_trees s ~least:2)
  | _ -> wrong "a part of it is of no kind"

and read_trees s ~least =
  let count = number s in
  if count < least || count > String.length s.text then wrong "it has no such number of parts";
  List.init count (fun _ -> read_tree s)

let text_of t name = match Names.find_opt t.texts name with Some text -> text | None -> unknown ()

let written_otherwise () = wrong "a part of it is not written as dolphin writes it"

(* Any other spelling would be a second text of the same state. *)
let read_part t (p : _ part) name =
  let text = text_of t name in
  let x = p.read text in
  if not (String.equal (p.write x) text) then written_otherwise ();
  x

let memoised table name find =
  match Names.find_opt table name with
  | Some known -> known
  | None ->
    let found = find () in
    Names.add table name found;
    found

let inside t (path : Component.path) name =
  match Residual.decompose (read_part t t.codec.residual name) with
  | (_ :: _ as contexts), hole when Residual.equal hole Residual.hole ->
    Components.in_contexts t.components path contexts
  | _, _ -> wrong "the surroundings of its parts are not contexts"

let members_at t (path : Component.path) =
  match Hashtbl.find_opt t.members_read path.id with
  | Some members -> members
  | None ->
    let members = Names.create 16 in
    Hashtbl.add t.members_read path.id members;
    members

let rec breadth_of trees =
  List.fold_left (fun n -> function Leaf -> n + 1 | Nest (_, trees) -> n + breadth_of trees) 0 trees

let shape t name =
  let read () =
    let s = { text = text_of t name; at = 0 } in
    let machine = read_name s in
    let trees = read_trees s ~least:1 in
    if not (String.equal (shape_text machine trees) s.text) then written_otherwise ();
    let rec stand path = function
      | Leaf -> Component_of (members_at t path, path)
      | Nest (contexts, trees) ->
        let path = inside t path contexts in
        Nest_in (path, List.map (stand path) trees)
    in
    let stands = List.map (stand (Components.root t.components)) trees in
    let frame = Encoding.frame t.encoding (read_part t t.codec.machine machine) None in
    { frame; stands; breadth = breadth_of trees }
  in
  memoised t.shapes_read name read

let shared t name =
  let read () =
    let shared, outside = read_part t t.codec.shared name in
    Surroundings.Numbers.number (Encoding.shareds t.encoding) (Surroundings.make shared outside)
  in
  memoised t.shareds_read name read

let member t members path name =
  let read () =
    match Components.children t.components path (read_part t t.codec.residual name) with
    | [ Component.Leaf c ] -> c
    | _ -> wrong "a part of it has parts of its own"
  in
  memoised members name read

let read_executing t key text =
  let length = String.length text in
  if length < 17 || (length - 1) land 7 <> 0 then wrong "it ends too early";
  let shape = shape t (name_at text 1) in
  if length <> 1 + (8 * (2 + shape.breadth)) then wrong "it has not as many parts as its shape";
  let shared = shared t (name_at text 9) and position = ref 0 in
  let rec component : stand -> Component.component Component.tree = function
    | Component_of (members, path) ->
      let name = name_at text (17 + (8 * !position)) in
      incr position;
      Leaf (member t members path name)
    | Nest_in (path, stands) -> Nest (path, List.map component stands)
  in
  Encoding.write_components t.encoding key shape.frame (List.map component shape.stands) shared

let read t key text =
  match if text = "" then wrong "it ends too early" else text.[0] with
  | c when c = script ->
    let text = String.sub text 1 (String.length text - 1) in
    let c, outside = t.codec.configuration.read text in
    if not (String.equal (t.codec.configuration.write (c, outside)) text) then written_otherwise ();
    (match (c : Configuration.t).control with
     | Script _ | Waiting _ ->
       Encoding.write_script t.encoding key (Encoding.script_number t.encoding [] c outside);
       None
     | Ended _ -> Some (c, outside)
     | Executing _ -> wrong "a task that executes is not in parts")
  | c when c = executing ->
    read_executing t key text;
    None
  | _ -> wrong "it is of no kind"

(* {1 Places of the script} *)

let place t key =
  let layouts = Encoding.layouts t.encoding in
  let number = Layouts.number layouts key.(0) and above = Layouts.shared layouts key.(0) in
  let digest i text =
    match Hashtbl.find_opt t.places i with
    | Some place -> place
    | None ->
      let place = Digest.string (text ()) in
      Hashtbl.add t.places i place;
      place
  in
  if number = 0 then digest (-1 - above) (fun () -> script_text t above)
  else
    let frame = (Layouts.layout layouts number).frame in
    digest frame.number (fun () -> String.make 1 executing ^ frame_text t frame)
