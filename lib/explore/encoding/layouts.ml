exception Outgrown

module Keys = Hashtbl.Make (struct
    type t = int list

    let equal = List.equal Int.equal
    let hash key = List.fold_left (fun h k -> (h * 65599) + k) 0 key land max_int
  end)

type t = {
  components : Components.t;
  spare_bits : int;
  by_key : Layout.t Keys.t;
  mutable layouts : Layout.t array;  (* by number; number 0 is unused *)
  mutable count : int;  (* and one *)
  mutable widths : Layout.widths;
  mutable layout_mask : int;
  mutable shared_shift : int;
  mutable shared_mask : int;
  mutable words : int;
}

let set_widths t (widths : Layout.widths) =
  t.widths <- widths;
  t.layout_mask <- (1 lsl widths.layout) - 1;
  t.shared_shift <- widths.layout + widths.reserved;
  t.shared_mask <- (1 lsl widths.shared) - 1

let least_width = 4

let create ?(spare_bits = 8) components =
  let widths : Layout.widths = { reserved = 0; layout = least_width; shared = least_width } in
  let by_key = Keys.create 64 in
  let t =
    { components; spare_bits; by_key; layouts = [||]; count = 1; widths; layout_mask = 0; shared_shift = 0;
      shared_mask = 0; words = 1 }
  in
  set_widths t widths;
  t

let words t = t.words

(* {1 First words} *)

let number t word = (word lsr t.widths.reserved) land t.layout_mask
let shared t word = if number t word = 0 then word lsr t.shared_shift else (word lsr t.shared_shift) land t.shared_mask
let first t number shared = (number lsl t.widths.reserved) lor (shared lsl t.shared_shift)
let layout t number = Array.unsafe_get t.layouts number

(* {1 Layouts} *)

let lay_out_families (l : Layout.t) =
  Array.iter (fun (f : Component.family) -> if f.width = 0 then Components.lay_out f) l.families

let add t key frame trees =
  Dolphin_checker.Numbering.give (Components.numbering t.components);
  let l = Layout.create ~number:t.count frame trees in
  if t.count >= Array.length t.layouts then begin
    let layouts = Array.make (2 * (t.count + 1)) l in
    Array.blit t.layouts 0 layouts 0 (Array.length t.layouts);
    t.layouts <- layouts
  end;
  t.layouts.(t.count) <- l;
  t.count <- t.count + 1;
  Keys.add t.by_key key l;
  lay_out_families l;
  if Layout.lay_out t.widths l > t.words then raise Outgrown;
  l

let find t frame trees =
  let key = Layout.key frame trees in
  match Keys.find_opt t.by_key key with Some l -> l | None -> add t key frame trees

let without t (l : Layout.t) (place : Layout.place) =
  match l.without.(place.index) with
  | Some l -> l
  | None ->
    let smaller = find t l.frame (Layout.replaced l place []) in
    l.without.(place.index) <- Some smaller;
    smaller

let family (p : Component.component) = p.family

let with_children t (l : Layout.t) place children =
  find t l.frame (Layout.replaced l place (List.map (Component.map family) children))

let becoming t (l : Layout.t) (place : Layout.place) serial children =
  let key = (serial * Array.length l.without) + place.index in
  match Hashtbl.find_opt l.becoming key with
  | Some l -> l
  | None ->
    let other = with_children t l place children in
    Hashtbl.add l.becoming key other;
    other

(* {1 Fields} *)

let fits t ~shared =
  (not (Components.outgrown t.components)) && t.count <= t.layout_mask + 1 && shared <= t.shared_mask + 1

let bits_for n =
  let rec from bits = if 1 lsl bits >= n then bits else from (bits + 1) in
  from 1

let shared_of = shared

let lay_out_all t (widths : Layout.widths) =
  let lay_out words l = max words (Layout.lay_out widths l) in
  Array.fold_left lay_out t.words (if t.count = 1 then [||] else Array.sub t.layouts 1 (t.count - 1))

(* Fields are wider than necessary if states take no more words for it: widening a field means writing all states
   again. *)
let rec with_spare_bits t (needed : Layout.widths) words spare =
  let widths = { needed with layout = needed.layout + spare; shared = needed.shared + spare } in
  if lay_out_all t widths <= words || spare = 0 then widths else with_spare_bits t needed words (spare / 2)

(* A state is read in the old layout and written in the new one. *)
let widen t ~reserved ~shared =
  let before = { t with layouts = Array.map (fun (l : Layout.t) -> { l with number = l.number }) t.layouts } in
  for n = 1 to t.count - 1 do
    Array.iter Components.lay_out t.layouts.(n).families
  done;
  Components.none_outgrown t.components;
  let width n = max least_width (bits_for n) in
  let needed : Layout.widths = { reserved; layout = width t.count; shared = width shared } in
  t.words <- lay_out_all t needed;
  set_widths t (with_spare_bits t needed t.words t.spare_bits);
  fun old fresh ->
    let number = number before old.(0) in
    fresh.(0) <- first t number (shared_of before old.(0));
    if number > 0 then begin
      let was = before.layouts.(number) and l = t.layouts.(number) in
      for i = 0 to Array.length l.families - 1 do
        Layout.put l fresh i (Layout.local was old i)
      done
    end
