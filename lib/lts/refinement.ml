(* The states of block [b] are [elements] from [start.(b)] to [start.(b) + size.(b) - 1]. The first [dirty.(b)] of them
   are to be visited again: they have a transition to a state whose block changed, or were never visited.
   The others, which are clean, all have the same signature, and none that a dirty state can have: the signature of a
   dirty state speaks of a block that is new. *)
type t = {
  graph : Graph.t;
  reverse : Graph.t;
  counting : bool;
  elements : int array;
  position : int array;  (* of each state in [elements] *)
  block : int array;
  start : int array;
  size : int array;
  dirty : int array;
  parent : int array;  (* the block that each was split off *)
  born : int array;  (* and the round in which *)
  mutable blocks : int;
  mutable rounds : int;
  mutable dirty_blocks : int list;
  signatures : Signatures.t;
  group : int array;  (* in a round, the group of each dirty state; the groups of a block are numbered in sequence *)
  scratch : int array;
}

let block r s = r.block.(s)

let block_after r ~round s =
  let rec climb b = if r.born.(b) <= round then b else climb r.parent.(b) in
  climb r.block.(s)

let blocks r = r.blocks
let rounds r = r.rounds
let size r b = r.size.(b)

let iter_block r b f =
  for i = r.start.(b) to r.start.(b) + r.size.(b) - 1 do
    f r.elements.(i)
  done

let member r b = r.elements.(r.start.(b))

let create ?(counting = false) graph =
  let n = Graph.states graph in
  let zeros () = Array.make n 0 in
  let size = zeros () and dirty = zeros () in
  size.(0) <- n;
  dirty.(0) <- n;
  {
    graph;
    reverse = Graph.reverse graph;
    counting;
    elements = Array.init n Fun.id;
    position = Array.init n Fun.id;
    block = zeros ();
    start = zeros ();
    size;
    dirty;
    parent = zeros ();
    born = zeros ();
    blocks = 1;
    rounds = 0;
    dirty_blocks = [ 0 ];
    signatures = Signatures.create ();
    group = zeros ();
    scratch = zeros ();
  }

let copy r =
  {
    r with
    elements = Array.copy r.elements;
    position = Array.copy r.position;
    block = Array.copy r.block;
    start = Array.copy r.start;
    size = Array.copy r.size;
    dirty = Array.copy r.dirty;
    parent = Array.copy r.parent;
    born = Array.copy r.born;
    group = Array.copy r.group;
    scratch = Array.copy r.scratch;
    signatures = Signatures.create ();
  }

let place r i s =
  r.elements.(i) <- s;
  r.position.(s) <- i

let mark r s =
  let b = r.block.(s) in
  let clean = r.start.(b) + r.dirty.(b) in
  if r.size.(b) > 1 && r.position.(s) >= clean then begin
    if r.dirty.(b) = 0 then r.dirty_blocks <- b :: r.dirty_blocks;
    place r r.position.(s) r.elements.(clean);
    place r clean s;
    r.dirty.(b) <- r.dirty.(b) + 1
  end

(* The groups of a split block: those of its dirty states, and its clean states if it has any. *)
type split = { of_block : int; first_group : int; groups : int }

let signature r s =
  Signatures.start r.signatures r.block.(s);
  Graph.iter_from r.graph s (fun label target -> Signatures.add r.signatures ~label ~block:r.block.(target));
  Signatures.finish ~counting:r.counting r.signatures

(* Gives each dirty state of block [b] its group. *)
let group_block r b =
  let count () = Signatures.count r.signatures in
  let first_group = count () in
  for i = r.start.(b) to r.start.(b) + r.dirty.(b) - 1 do
    r.group.(r.elements.(i)) <- signature r r.elements.(i)
  done;
  { of_block = b; first_group; groups = count () - first_group }

(* Sorts the dirty states of a block by group: the place where each group ends. *)
let sort_by_group r { of_block = b; first_group; groups } =
  let start = r.start.(b) and dirty = r.dirty.(b) in
  let ends = Array.make groups 0 in
  for i = start to start + dirty - 1 do
    let group = r.group.(r.elements.(i)) - first_group in
    ends.(group) <- ends.(group) + 1
  done;
  let place_of_group = Array.make groups start in
  for group = 1 to groups - 1 do
    place_of_group.(group) <- place_of_group.(group - 1) + ends.(group - 1)
  done;
  Array.blit r.elements start r.scratch 0 dirty;
  for i = 0 to dirty - 1 do
    let s = r.scratch.(i) in
    let group = r.group.(s) - first_group in
    place r place_of_group.(group) s;
    place_of_group.(group) <- place_of_group.(group) + 1
  done;
  place_of_group

(* Splits a block; [changed] gets the new blocks. *)
let split_block r ~changed ({ of_block = b; groups; _ } as split) =
  let start = r.start.(b) and size = r.size.(b) and dirty = r.dirty.(b) in
  if groups > 1 || dirty < size then begin
    let ends = sort_by_group r split in
    let start_of part = if part = 0 then start else ends.(part - 1) in
    let end_of part = if part = groups then start + size else ends.(part) in
    let size_of part = end_of part - start_of part in
    (* Part [groups] is the clean states, perhaps none. *)
    let largest = ref groups in
    for part = groups - 1 downto 0 do
      if size_of part > size_of !largest then largest := part
    done;
    for part = 0 to groups do
      if part <> !largest && size_of part > 0 then begin
        let fresh = r.blocks in
        r.blocks <- fresh + 1;
        r.start.(fresh) <- start_of part;
        r.size.(fresh) <- size_of part;
        r.parent.(fresh) <- b;
        r.born.(fresh) <- r.rounds;
        iter_block r fresh (fun s -> r.block.(s) <- fresh);
        changed fresh
      end
    done;
    r.start.(b) <- start_of !largest;
    r.size.(b) <- size_of !largest
  end;
  r.dirty.(b) <- 0

(* Marking moves states about in their block, which may be [fresh]. *)
let mark_before r fresh =
  Array.blit r.elements r.start.(fresh) r.scratch 0 r.size.(fresh);
  for i = 0 to r.size.(fresh) - 1 do
    Graph.iter_from r.reverse r.scratch.(i) (fun _ before -> mark r before)
  done

(* Splits blocks, and marks the states that may differ now: whether there was anything to split. *)
let split_all r splits =
  r.rounds <- r.rounds + 1;
  r.dirty_blocks <- [];
  let fresh_blocks = ref [] in
  List.iter (split_block r ~changed:(fun fresh -> fresh_blocks := fresh :: !fresh_blocks)) splits;
  List.iter (mark_before r) !fresh_blocks;
  if !fresh_blocks = [] then r.rounds <- r.rounds - 1

let run r =
  while r.dirty_blocks <> [] do
    Signatures.clear r.signatures;
    (* All signatures of a round are taken before any block is split. *)
    split_all r (List.rev_map (group_block r) r.dirty_blocks)
  done

let separate_few r states =
  List.iter (mark r) states;
  List.iter (fun s -> r.group.(s) <- 0) states;
  match states with
  | [] -> ()
  | s :: _ -> split_all r [ { of_block = r.block.(s); first_group = 0; groups = 1 } ]

let parted r b c =
  let rec climb b c =
    if r.born.(b) < r.born.(c) then climb c b
    else if r.parent.(b) = c then r.born.(b)
    else climb r.parent.(b) c
  in
  climb b c
