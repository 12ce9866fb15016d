type side = Left | Right
type traces = Only of side * string list | Same | Not_known
type difference = { formula : Modal_formula.t; traces : traces }

let effort = 4_000_000

(* The quotient of [g], the blocks being its states. *)
let quotient g r =
  let b = Graph.Builder.create () in
  let renamed = Array.init (Graph.labels g) (fun l -> Graph.Builder.label b (Graph.label g l)) in
  for block = 0 to Refinement.blocks r - 1 do
    Graph.iter_from g (Refinement.member r block) (fun l target ->
        Graph.Builder.add_numbered b block renamed.(l) (Refinement.block r target))
  done;
  Graph.Builder.finish ~states:(Refinement.blocks r) b

let strong left right =
  let left = Reachability.trim left and right = Reachability.trim right in
  let both = Graph.union left right in
  let r = Refinement.create both in
  Refinement.run r;
  let block_left = Refinement.block r (Graph.initial left) in
  let block_right = Refinement.block r (Graph.states left + Graph.initial right) in
  if block_left = block_right then Ok ()
  else
    let traces =
      match Trace_difference.find ~effort (quotient both r) block_left block_right with
      | First_only trace -> Only (Left, trace)
      | Second_only trace -> Only (Right, trace)
      | None -> Same
      | Not_known -> Not_known
    in
    Error { formula = Distinction.formula both r block_left block_right; traces }

let isomorphic = Isomorphism.check
let pp_side ppf side = Fmt.string ppf (match side with Left -> "left" | Right -> "right")

let pp_traces ppf = function
  | Only (side, trace) ->
    let label = Fmt.using Dolphin_utf8.Utf8.line Fmt.string in
    Fmt.pf ppf "Only the %a one has the trace@;<1 2>@[<hov>%a@]" pp_side side Fmt.(list ~sep:sp label) trace
  | Same -> Fmt.string ppf "They have the same traces, but choose at different times."
  | Not_known -> Fmt.string ppf "Whether they have the same traces was not found out within the limit of effort."

let pp_difference ppf { formula; traces } =
  Fmt.pf ppf "@[<v>Only the left one satisfies %a@,@[%a@]@]" Modal_formula.pp formula pp_traces traces
