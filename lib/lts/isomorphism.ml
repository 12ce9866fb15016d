type side = Left | Right

type reason =
  | Enabled of { trace : string list; left : string list; right : string list }
  | Merged of { side : side; trace : string list; other : string list }
  | Unmatched of { side : side; trace : string list option; left : int; right : int; steps : int }
  | No_matching
  | Undecided

type difference = { states : int * int; transitions : int * int; reason : reason }

let effort = 200_000_000

(* Both graphs in one, with the same numbers for the same labels: the right states come from [shift] on. *)
type pair = { both : Graph.t; shift : int; right_initial : int }

let is_left pair s = s < pair.shift

(* {1 Walking side by side} *)

type walk = Differ of reason | All_paired | Cannot_tell

exception Stop of walk

let unpaired = -1
let labels_of g s = List.rev (Graph.fold_from g s (fun labels l _ -> Graph.label g l :: labels) [])

(* Whether the transitions of [s] all have different labels: they are in order. *)
let deterministic g s =
  let rec go e =
    e + 1 >= Graph.first g (s + 1) || (Graph.label_of g e <> Graph.label_of g (e + 1) && go (e + 1))
  in
  go (Graph.first g s)

let same_labels g s t =
  let d = Graph.degree g s and at_s = Graph.first g s and at_t = Graph.first g t in
  let rec go i = i = d || (Graph.label_of g (at_s + i) = Graph.label_of g (at_t + i) && go (i + 1)) in
  d = Graph.degree g t && go 0

let walk { both = g; right_initial; _ } =
  let partner = Array.make (Graph.states g) unpaired in
  let came_from = Array.make (Graph.states g) unpaired and came_by = Array.make (Graph.states g) 0 in
  let trace s =
    let rec back s labels =
      if came_from.(s) = unpaired then labels else back came_from.(s) (Graph.label g came_by.(s) :: labels)
    in
    back s []
  in
  let queue = Queue.create () in
  let pair s t =
    partner.(s) <- t;
    partner.(t) <- s;
    Queue.add (s, t) queue
  in
  let merged side ~from l known =
    let trace_here = List.rev (Graph.label g l :: List.rev (trace from)) in
    raise_notrace (Stop (Differ (Merged { side; trace = trace_here; other = trace known })))
  in
  let reach ~from l s t =
    if partner.(s) = unpaired && partner.(t) = unpaired then begin
      came_from.(s) <- from;
      came_by.(s) <- l;
      came_from.(t) <- partner.(from);
      came_by.(t) <- l;
      pair s t
    end
    else if partner.(s) = unpaired then merged Right ~from l t
    else if partner.(s) <> t then merged Left ~from l s
  in
  let step (s, t) =
    if not (same_labels g s t) then
      raise_notrace (Stop (Differ (Enabled { trace = trace s; left = labels_of g s; right = labels_of g t })));
    if not (deterministic g s) then raise_notrace (Stop Cannot_tell);
    for i = 0 to Graph.degree g s - 1 do
      let e = Graph.first g s + i in
      reach ~from:s (Graph.label_of g e) (Graph.target g e) (Graph.target g (Graph.first g t + i))
    done
  in
  try
    pair (Graph.initial g) right_initial;
    while not (Queue.is_empty queue) do
      step (Queue.pop queue)
    done;
    if Array.mem unpaired partner then Cannot_tell else All_paired
  with Stop result -> result

(* {1 Colours} *)

(* The transitions of both graphs, forwards and back, and a mark on the initial states. *)
let surroundings { both; right_initial; _ } =
  let b = Graph.Builder.create () in
  let forwards = Array.init (Graph.labels both) (fun l -> Graph.Builder.label b (Fmt.str "forwards %d" l)) in
  let back = Array.init (Graph.labels both) (fun l -> Graph.Builder.label b (Fmt.str "back %d" l)) in
  Graph.iter both (fun s l s' ->
      Graph.Builder.add_numbered b s forwards.(l) s';
      Graph.Builder.add_numbered b s' back.(l) s);
  List.iter (fun s -> Graph.Builder.add b s "initial" s) [ Graph.initial both; right_initial ];
  Graph.Builder.finish ~states:(Graph.states both) b

(* How many left states each block has after [round], and how many right ones. *)
let census pair r ~round =
  let left = Array.make (Refinement.blocks r) 0 and right = Array.make (Refinement.blocks r) 0 in
  for s = 0 to Graph.states pair.both - 1 do
    let b = Refinement.block_after r ~round s in
    let count = if is_left pair s then left else right in
    count.(b) <- count.(b) + 1
  done;
  (left, right)

let balanced pair r ~round =
  let left, right = census pair r ~round in
  left = right

(* The first round after which blocks are not balanced, if they are not in the end: they stay so. Before the first
   round there is but one block. *)
let first_unbalanced pair r =
  let rec search low high =
    (* not balanced after [high], and balanced before [low] *)
    if low = high then low
    else
      let middle = (low + high) / 2 in
      if balanced pair r ~round:middle then search (middle + 1) high else search low middle
  in
  search 1 (Refinement.rounds r)

let unmatched pair r =
  let round = first_unbalanced pair r in
  let left, right = census pair r ~round in
  let block = Refinement.block_after r ~round in
  let nearest from more fewer =
    Reachability.shortest ~from pair.both (fun s -> more.(block s) > fewer.(block s))
    |> Option.map (fun run -> (Reachability.trace run, Reachability.finish run))
  in
  let reason side trace s = Unmatched { side; trace; left = left.(block s); right = right.(block s); steps = round } in
  match (nearest (Graph.initial pair.both) left right, nearest pair.right_initial right left) with
  | Some (trace, s), Some (trace', _) when List.compare_lengths trace trace' <= 0 -> reason Left (Some trace) s
  | Some (trace, s), None -> reason Left (Some trace) s
  | _, Some (trace, s) -> reason Right (Some trace) s
  | None, None ->
    let rec first s = if left.(block s) <> right.(block s) then s else first (s + 1) in
    let s = first 0 in
    reason (if is_left pair s then Left else Right) None s

(* {1 Breaking symmetry} *)

(* A block, from [b] on, that has more than one state on a side. *)
let rec ambiguous r b =
  if b = Refinement.blocks r then None else if Refinement.size r b > 2 then Some b else ambiguous r (b + 1)

let members pair r b =
  let left = ref [] and right = ref [] in
  Refinement.iter_block r b (fun s -> if is_left pair s then left := s :: !left else right := s :: !right);
  (!left, !right)

let last_balanced pair r = balanced pair r ~round:(Refinement.rounds r)

let match_up r s t =
  Refinement.separate_few r [ s; t ];
  Refinement.run r

(* Takes the first match that offers itself, each time: whether that matches all states. If it does, states of one
   block have transitions to the same blocks, and as each block is a left state and a right one, that is it. *)
let greedy pair r =
  let rec go b =
    match ambiguous r b with
    | None -> last_balanced pair r
    | Some b -> (
        match members pair r b with
        | s :: _, t :: _ ->
          match_up r s t;
          go b
        | _ -> false)
  in
  go 0

(* Tries all matches. *)
let search pair r =
  let left_over = ref effort in
  let rec go r =
    if not (last_balanced pair r) then Some No_matching
    else
      match ambiguous r 0 with
      | None -> None
      | Some b -> (
          match members pair r b with
          | s :: _, candidates -> first_of r s candidates
          | [], _ -> Some No_matching)
  and first_of r s = function
    | [] -> Some No_matching
    | t :: candidates -> (
        left_over := !left_over - Graph.states pair.both;
        if !left_over < 0 then Some Undecided
        else
          let attempt = Refinement.copy r in
          match_up attempt s t;
          match go attempt with Some No_matching -> first_of r s candidates | (Some _ | None) as decided -> decided)
  in
  go r

let refine pair =
  let r = Refinement.create ~counting:true (surroundings pair) in
  Refinement.run r;
  if not (last_balanced pair r) then Some (unmatched pair r)
  else if ambiguous r 0 = None || greedy pair (Refinement.copy r) then None
  else search pair r

let check left right =
  let shift = Graph.states left in
  let pair = { both = Graph.union left right; shift; right_initial = shift + Graph.initial right } in
  let reason =
    match walk pair with
    | All_paired -> None
    | Differ reason -> Some reason
    | Cannot_tell -> refine pair
  in
  match reason with
  | None -> Ok ()
  | Some reason ->
    let states = (Graph.states left, Graph.states right) in
    Error { states; transitions = (Graph.transitions left, Graph.transitions right); reason }

(* {1 In words} *)

let pp_side ppf side = Fmt.string ppf (match side with Left -> "left" | Right -> "right")
let pp_labels ppf = function [] -> Fmt.string ppf "nothing" | labels -> Fmt.(list ~sep:comma string) ppf labels

let pp_trace ppf = function
  | [] -> Fmt.string ppf "At the start"
  | trace -> Fmt.pf ppf "After @[<hov>%a@]" Fmt.(list ~sep:sp string) trace

let pp_reason ppf = function
  | Enabled { trace; left; right } ->
    Fmt.pf ppf "%a@ the left one can do %a,@ the right one %a." pp_trace trace pp_labels left pp_labels right
  | Merged { side; trace; other } ->
    Fmt.pf ppf "%a@ the %a one is in the same state as after %a,@ the other is not." pp_trace trace pp_side side
      Fmt.(list ~sep:sp string) other
  | Unmatched { side; trace; left; right; steps } ->
    let pp_place ppf = function
      | Some trace -> Fmt.pf ppf "%a@ the %a one is in a state" pp_trace trace pp_side side
      | None -> Fmt.pf ppf "The %a one has a state that cannot be reached," pp_side side
    in
    Fmt.pf ppf "%a@ with %d similar states on the left and %d on the right,@ compared over %d steps." pp_place
      trace left right steps
  | No_matching -> Fmt.string ppf "Each state has its like in the other, but they cannot all be matched at once."
  | Undecided -> Fmt.string ppf "Whether they match was not found out within the limit of effort."

let pp_difference ppf { states = left, right; transitions = left', right'; reason } =
  Fmt.pf ppf "@[<v>left: %d states, %d transitions; right: %d states, %d transitions@,@[%a@]@]" left left' right right'
    pp_reason reason
