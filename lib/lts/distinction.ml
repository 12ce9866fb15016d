module Pairs = Hashtbl.Make (struct
    type t = int * int

    let equal (b, c) (b', c') = b = b' && c = c'

    let hash (b, c) =
      let mixed = ((b * 0x2545f4914f6cdd1d) + c) * 0x1f3d5b79a2c4e683 in
      (mixed lxor (mixed lsr 32)) land max_int
  end)

(* Why a block differs from another: it can do [label] to a state in [next], and of the blocks in [others], where the
   other can get with this label, each differs from [next], and was parted from it earlier. *)
type reason = { label : int; next : int; others : int list }

(* The first is better: it needs fewer conjuncts, or blocks that were parted in earlier rounds. *)
type cost = { conjuncts : int; rounds : int }

let compare_cost x y =
  match Int.compare x.conjuncts y.conjuncts with 0 -> Int.compare x.rounds y.rounds | order -> order

(* The reasons why [b] differs from [c], with their costs. There is one, or there is one why [c] differs from [b]. *)
let reasons g r b c =
  let round = Refinement.parted r b c in
  let b_state = Refinement.member r b and c_state = Refinement.member r c in
  let reason label target =
    let next = Refinement.block r target in
    let others =
      Graph.fold_from g c_state
        (fun others l target -> if l = label then Refinement.block r target :: others else others)
        []
      |> List.sort_uniq Int.compare
    in
    let parted other = if other = next then round else Refinement.parted r next other in
    (* The last parted blocks come first: the formula for them may suit others. *)
    let others = List.sort (fun x y -> compare y x) (List.map (fun other -> (parted other, other)) others) in
    if List.for_all (fun (earlier, _) -> earlier < round) others then
      let rounds = List.fold_left (fun sum (earlier, _) -> sum + earlier) 0 others in
      Some ({ conjuncts = List.length others; rounds }, { label; next; others = List.map snd others })
    else None
  in
  List.rev
    (Graph.fold_from g b_state
       (fun reasons label target -> match reason label target with Some found -> found :: reasons | None -> reasons)
       [])

let best reasons =
  List.fold_left
    (fun best (cost, reason) ->
       match best with
       | Some (least, _) when compare_cost least cost <= 0 -> best
       | None | Some _ -> Some (cost, reason))
    None reasons

(* The steps spent on finding out whether a conjunct does the work of another. *)
let patience = 1000

(* In continuation-passing style, as formulas may be as deep as graphs are; each pair of blocks is treated once. *)
let formula g r b c =
  let known = Pairs.create 64 in
  let rec formula b c return =
    match Pairs.find_opt known (b, c) with
    | Some f -> return f
    | None ->
      let keep f =
        Pairs.replace known (b, c) f;
        return f
      in
      (match (best (reasons g r b c), best (reasons g r c b)) with
       | Some (cost, reason), Some (cost', _) when compare_cost cost cost' <= 0 -> can reason keep
       | Some (_, reason), None -> can reason keep
       | (Some _ | None), Some (_, reason) -> can reason (fun f -> keep (Modal_formula.Not f))
       | None, None -> assert false (* the refinement has parted them *))
  and can { label; next; others } return =
    conjuncts next others [] (fun fs -> return (Modal_formula.Can (Graph.label g label, fs)))
  and conjuncts next others found return =
    match others with
    | [] -> return (List.rev found)
    | other :: others when rejected other found -> conjuncts next others found return
    | other :: others -> formula next other (fun f -> conjuncts next others (f :: found) return)
  and rejected other found =
    List.exists (fun f -> Modal_formula.holds_within ~steps:patience g (Refinement.member r other) f = Some false) found
  in
  formula b c Fun.id
