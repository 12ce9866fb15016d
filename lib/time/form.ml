let mix a b = ((a * 0x2545f491) + b + (a lsr 17)) land max_int

module Lists = Dolphin_checker.Interner.Make (struct
    type t = int list

    let equal = List.equal Int.equal
    let hash = List.fold_left mix 1
  end)

type numbers = Lists.t

let numbers = Lists.create

(* {1 Trees} *)

(* A closed part has a number of its own: it has neither names nor items. *)
type tree =
  | Closed of int
  | Open of { head : int; item : int option; names : int list; ordered : bool; parts : tree list }

let tree numbers ?item ?(names = []) ?(ordered = true) head parts =
  let closed = List.filter_map (function Closed n -> Some n | Open _ -> None) parts in
  if item = None && List.for_all (fun n -> n < 0) names && List.compare_lengths closed parts = 0 then
    Closed (Lists.number numbers (head :: names @ if ordered then closed else List.sort Int.compare closed))
  else Open { head; item; names; ordered; parts }

(* {1 Colours of names} *)

type shape = { hash : int; named : int list; in_order : bool; inside : shape list }

let rec shape ~color ~name = function
  | Closed n -> { hash = mix 3 n; named = []; in_order = true; inside = [] }
  | Open { head; item; names; ordered; parts } ->
    let inside = List.map (shape ~color ~name) parts in
    let add h s = if ordered then mix h s.hash else h + mix 7 s.hash in
    let own = List.fold_left (fun h n -> mix h (name n)) (mix head (Option.fold item ~none:0 ~some:color)) names in
    { hash = mix 3 (List.fold_left add own inside); named = names; in_order = ordered; inside }

(* [note n h] is called for each name [n], with its surroundings. *)
let rec around note at s =
  let at = mix at s.hash in
  List.iteri (fun i n -> note n (mix at i)) s.named;
  List.iteri (fun i part -> around note (mix at (if s.in_order then i else part.hash)) part) s.inside

(* Colours distinguish names with different roles: first by [orbits], then by their surroundings. *)
let colours ~orbits ~color ~placed tree =
  let count colours = List.length (List.sort_uniq Int.compare (Array.to_list colours)) in
  let rec refine colours before =
    if before = Array.length colours then colours
    else begin
      let found = Array.map (fun _ -> 0) colours in
      let note n h = if n >= 0 then found.(n) <- found.(n) + h in
      around note 1 (shape ~color ~name:(fun n -> if n < 0 then n else colours.(n)) tree);
      List.iter (fun (n, place) -> note n (mix 5 place)) placed;
      let next = Array.map2 (fun colour sum -> mix colour (sum land max_int)) colours found in
      let now = count next in
      if now > before then refine next now else next
    end
  in
  refine orbits (count orbits)

(* {1 Numbers} *)

type written = { number : int; items : (int * int) list  (* each with its colour *) }

let rec write numbers ~color ~colored ~name = function
  | Closed number -> { number; items = [] }
  | Open { head; item; names; ordered; parts } ->
    let written = List.map (write numbers ~color ~colored ~name) parts in
    let by_colour (a, _) (b, _) = Int.compare a b in
    let compare a b =
      match Int.compare a.number b.number with 0 -> List.compare by_colour a.items b.items | order -> order in
    let written = if ordered then written else List.sort compare written in
    let own = List.map (fun i -> (color i, i)) (Option.to_list item) in
    let colours = if colored then List.map fst own else [] in
    { number = Lists.number numbers ((head :: List.map name names) @ colours @ List.map (fun w -> w.number) written);
      items = own @ List.concat_map (fun w -> w.items) written }

type t = { number : int; items : int list }

let make numbers ~orbits ~colors ~colored ~placed constants tree =
  let color i = colors.(i) in
  let colours = colours ~orbits ~color ~placed tree in
  let compare m n = match Int.compare colours.(m) colours.(n) with 0 -> Int.compare m n | order -> order in
  (* Each by its orbit and its rank. *)
  let count = Array.length orbits in
  let own = Array.make count 0 in
  List.iteri (fun rank n -> own.(n) <- (rank * 2 * count) + orbits.(n)) (List.sort compare (List.init count Fun.id));
  let name n = if n < 0 then n else own.(n) in
  let written = write numbers ~color ~colored ~name tree in
  let placed = List.sort Stdlib.compare (List.map (fun (n, place) -> (name n, place)) placed) in
  let number =
    Lists.number numbers (written.number :: List.concat_map (fun (n, place) -> [ n; place ]) placed @ constants) in
  { number; items = List.map snd written.items }
