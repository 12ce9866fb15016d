type t = {
  initial : int;
  rows : Int_vector.t;  (* the first transition of each state, and the number of transitions *)
  edge_labels : Int_vector.t;
  edge_targets : Int_vector.t;
  names : string array;
  text : (int -> string) option;
}

let initial g = g.initial
let states g = Int_vector.length g.rows - 1
let transitions g = Int_vector.length g.edge_labels
let labels g = Array.length g.names
let label g l = g.names.(l)
let text g = g.text
let first g s = Int_vector.get g.rows s
let label_of g e = Int_vector.get g.edge_labels e
let target g e = Int_vector.get g.edge_targets e
let degree g s = first g (s + 1) - first g s

let iter_from g s f =
  for e = first g s to first g (s + 1) - 1 do
    f (label_of g e) (target g e)
  done

let fold_from g s f start =
  let last = first g (s + 1) in
  let rec go e accumulated = if e = last then accumulated else go (e + 1) (f accumulated (label_of g e) (target g e)) in
  go (first g s) start

let iter g f =
  for s = 0 to states g - 1 do
    iter_from g s (f s)
  done

let to_list g =
  let all = ref [] in
  iter g (fun s l s' -> all := (s, g.names.(l), s') :: !all);
  List.rev !all

(* The graph of the transitions [(sources.(i), edge_labels.(i), targets.(i))], in any order: sorted by target, then
   stably by label, then by source, so that doubles are neighbours: one of them is kept, or all. *)
let assemble ?(doubles = false) ~initial ~states ~names ~text sources edge_labels targets =
  let count = Int_vector.length sources in
  let order = Int_vector.make count in
  for i = 0 to count - 1 do
    Int_vector.set order i i
  done;
  let order =
    order
    |> Int_vector.order_by (Int_vector.get targets) ~keys:states
    |> Int_vector.order_by (Int_vector.get edge_labels) ~keys:(Array.length names)
    |> Int_vector.order_by (Int_vector.get sources) ~keys:states
  in
  let same i j =
    Int_vector.get sources i = Int_vector.get sources j
    && Int_vector.get edge_labels i = Int_vector.get edge_labels j
    && Int_vector.get targets i = Int_vector.get targets j
  in
  let doubled k = (not doubles) && k > 0 && same (Int_vector.get order k) (Int_vector.get order (k - 1)) in
  let left_out = ref 0 in
  for k = 0 to count - 1 do
    if doubled k then incr left_out
  done;
  let rows = Int_vector.make (states + 1) in
  let sorted_labels = Int_vector.make (count - !left_out) and sorted_targets = Int_vector.make (count - !left_out) in
  let filled = ref 0 in
  for k = 0 to count - 1 do
    if not (doubled k) then begin
      let i = Int_vector.get order k in
      let row = Int_vector.get sources i + 1 in
      Int_vector.set rows row (Int_vector.get rows row + 1);
      Int_vector.set sorted_labels !filled (Int_vector.get edge_labels i);
      Int_vector.set sorted_targets !filled (Int_vector.get targets i);
      incr filled
    end
  done;
  for s = 1 to states do
    Int_vector.set rows s (Int_vector.get rows s + Int_vector.get rows (s - 1))
  done;
  { initial; rows; edge_labels = sorted_labels; edge_targets = sorted_targets; names; text }

module Builder = struct
  type t = {
    numbers : (string, int) Hashtbl.t;
    mutable names : string list;  (* the last first *)
    sources : Int_vector.Growing.t;
    edge_labels : Int_vector.Growing.t;
    targets : Int_vector.Growing.t;
    mutable least_states : int;
  }

  let create () =
    let growing = Int_vector.Growing.create in
    let numbers = Hashtbl.create 64 in
    { numbers; names = []; sources = growing (); edge_labels = growing (); targets = growing (); least_states = 1 }

  let label b text =
    match Hashtbl.find_opt b.numbers text with
    | Some l -> l
    | None ->
      let l = Hashtbl.length b.numbers in
      Hashtbl.add b.numbers text l;
      b.names <- text :: b.names;
      l

  let check_state s =
    if s < 0 || s >= Int_vector.limit then invalid_arg (Printf.sprintf "Graph: there can be no state %d" s)

  let mention b s =
    check_state s;
    if s >= b.least_states then b.least_states <- s + 1

  let add_numbered b s l s' =
    mention b s;
    mention b s';
    if l < 0 || l >= Hashtbl.length b.numbers then invalid_arg (Printf.sprintf "Graph: there is no label %d" l);
    Int_vector.Growing.add b.sources s;
    Int_vector.Growing.add b.edge_labels l;
    Int_vector.Growing.add b.targets s'

  let add b s text s' = add_numbered b s (label b text) s'

  let finish ?doubles ?(initial = 0) ?(states = 1) ?text b =
    check_state initial;
    let states = max (max states b.least_states) (initial + 1) in
    let names = Array.of_list (List.rev b.names) in
    let contents = Int_vector.Growing.contents in
    assemble ?doubles ~initial ~states ~names ~text (contents b.sources) (contents b.edge_labels) (contents b.targets)
end

let of_list ?initial ?states transitions =
  let b = Builder.create () in
  List.iter (fun (s, text, s') -> Builder.add b s text s') transitions;
  Builder.finish ?initial ?states b

let with_text f g = { g with text = Some f }

(* [g]'s transitions from [shift] on, with other labels; [renamed.(l)] is the number of [l] in [b]. *)
let add_all b ~shift f g =
  let renamed = Array.map (fun name -> Builder.label b (f name)) g.names in
  iter g (fun s l s' -> Builder.add_numbered b (s + shift) renamed.(l) (s' + shift))

let map_labels f g =
  let b = Builder.create () in
  add_all b ~shift:0 f g;
  Builder.finish ~initial:g.initial ~states:(states g) ?text:g.text b

let union g h =
  let b = Builder.create () and shift = states g in
  add_all b ~shift:0 Fun.id g;
  add_all b ~shift Fun.id h;
  let text =
    match (g.text, h.text) with
    | None, None -> None
    | of_g, of_h ->
      let say text s = match text with Some f -> f s | None -> "" in
      Some (fun s -> if s < shift then say of_g s else say of_h (s - shift))
  in
  Builder.finish ~initial:g.initial ~states:(shift + states h) ?text b

(* For each transition, its source. *)
let sources g =
  let sources = Int_vector.make (transitions g) in
  for s = 0 to states g - 1 do
    for e = first g s to first g (s + 1) - 1 do
      Int_vector.set sources e s
    done
  done;
  sources

let reverse g =
  assemble ~initial:g.initial ~states:(states g) ~names:g.names ~text:g.text g.edge_targets g.edge_labels (sources g)

let without_doubles g = reverse (reverse g)

let equal g h =
  initial g = initial h
  && states g = states h
  && transitions g = transitions h
  &&
  (* Labels may be numbered differently, so rows are compared in the order of their texts. *)
  let row graph s =
    List.sort compare (fold_from graph s (fun row l s' -> (label graph l, s') :: row) [])
  in
  let rec same s = s = states g || (row g s = row h s && same (s + 1)) in
  same 0

let pp ppf g =
  Fmt.pf ppf "@[<v>initial %d of %d states" g.initial (states g);
  iter g (fun s l s' -> Fmt.pf ppf "@,%d --%s--> %d" s g.names.(l) s');
  Fmt.pf ppf "@]"
