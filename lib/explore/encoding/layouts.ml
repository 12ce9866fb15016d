exception Outgrown

module Keys = Hashtbl.Make (struct
    type t = int list

    let equal = List.equal Int.equal
    let hash key = List.fold_left (fun h k -> (h * 65599) + k) 0 key land max_int
  end)

type t = {
  parts : Components.t;
  by_key : Layout.t Keys.t;
  mutable shapes : Layout.t array;  (* by number; the first is none *)
  mutable count : int;  (* and one *)
  mutable widths : Layout.widths;
  mutable shape_mask : int;
  mutable watched_mask : int;
  mutable shared_shift : int;
  mutable shared_mask : int;
  mutable words : int;
}

let set_widths t (widths : Layout.widths) =
  t.widths <- widths;
  t.shape_mask <- (1 lsl widths.shape) - 1;
  t.watched_mask <- (1 lsl widths.watched) - 1;
  t.shared_shift <- widths.shape + widths.watched;
  t.shared_mask <- (1 lsl widths.shared) - 1

let create ?(watched = 0) parts =
  let widths : Layout.widths = { shape = 4; watched; shared = 4 } in
  let by_key = Keys.create 64 in
  let t =
    { parts; by_key; shapes = [||]; count = 1; widths; shape_mask = 0; watched_mask = 0; shared_shift = 0;
      shared_mask = 0; words = 1 }
  in
  set_widths t widths;
  t

let count t = t.count - 1
let words t = t.words
let widths t = t.widths

(* {1 First words} *)

let number t word = word land t.shape_mask
let shared t word = if number t word = 0 then word lsr t.shared_shift else (word lsr t.shared_shift) land t.shared_mask
let first t number shared = number lor (shared lsl t.shared_shift)
let watched t word = (word lsr t.widths.shape) land t.watched_mask

let watching t word n =
  if n > t.watched_mask then raise Outgrown;
  word land lnot (t.watched_mask lsl t.widths.shape) lor (n lsl t.widths.shape)

let shape t number = Array.unsafe_get t.shapes number

(* {1 Shapes} *)

let lay_out_families (s : Layout.t) =
  Array.iter (fun (f : Component.family) -> if f.width = 0 then Components.lay_out f) s.families

let add t key frame trees =
  let s = Layout.create ~number:t.count frame trees in
  if t.count >= Array.length t.shapes then begin
    let shapes = Array.make (2 * (t.count + 1)) s in
    Array.blit t.shapes 0 shapes 0 (Array.length t.shapes);
    t.shapes <- shapes
  end;
  t.shapes.(t.count) <- s;
  t.count <- t.count + 1;
  Keys.add t.by_key key s;
  lay_out_families s;
  if Layout.lay_out t.widths s > t.words then raise Outgrown;
  s

let find t frame trees =
  let key = Layout.key frame trees in
  match Keys.find_opt t.by_key key with Some s -> s | None -> add t key frame trees

let without t (s : Layout.t) (place : Layout.place) =
  match s.without.(place.index) with
  | Some s -> s
  | None ->
    let smaller = find t s.frame (Layout.replaced s place []) in
    s.without.(place.index) <- Some smaller;
    smaller

let family (p : Component.part) = p.family

let with_children t (s : Layout.t) place children =
  find t s.frame (Layout.replaced s place (List.map (Component.map family) children))

let becoming t (s : Layout.t) (place : Layout.place) serial children =
  let key = (serial * Array.length s.without) + place.index in
  match Hashtbl.find_opt s.becoming key with
  | Some s -> s
  | None ->
    let other = with_children t s place children in
    Hashtbl.add s.becoming key other;
    other

(* {1 Fields} *)

let fits t ~shared =
  (not (Components.outgrown t.parts)) && t.count <= t.shape_mask + 1 && shared <= t.shared_mask + 1

let bits_for n =
  let rec from bits = if 1 lsl bits >= n then bits else from (bits + 1) in
  from 1

let shared_of = shared
let watched_of = watched

(* What a state is made of is read in the old layout and written in the new one. *)
let widened t ~watched ~shared =
  let before = { t with shapes = Array.map (fun (s : Layout.t) -> { s with number = s.number }) t.shapes } in
  let shapes = if t.count = 1 then [||] else Array.sub t.shapes 1 (t.count - 1) in
  Array.iter (fun (s : Layout.t) -> Array.iter Components.lay_out s.families) shapes;
  Components.none_outgrown t.parts;
  let at_least width n = if n = 0 then width else max width (bits_for n) in
  set_widths t
    { shape = at_least t.widths.shape t.count; watched = at_least t.widths.watched watched;
      shared = at_least t.widths.shared shared };
  let lay_out words s = max words (Layout.lay_out t.widths s) in
  t.words <- Array.fold_left lay_out t.words shapes;
  fun old fresh ->
    let number = number before old.(0) in
    fresh.(0) <- watching t (first t number (shared_of before old.(0))) (watched_of before old.(0));
    if number > 0 then begin
      let was = before.shapes.(number) and s = t.shapes.(number) in
      for i = 0 to Array.length s.families - 1 do
        Layout.put s fresh i (Layout.local was old i)
      done
    end
