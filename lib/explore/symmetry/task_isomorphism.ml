open Dolphin_semantics
open Dolphin_environment
open Core

type context = { options : Environment.options; skeletons : Skeleton.context }

let context numbering options program = { options; skeletons = Skeleton.context numbering program }
let skeletons c = c.skeletons

type label = Task of site | Code of int

(* {1 What is in a residual} *)

type leaf = Of_task of platform_task | Of_code of bool * closure

let rec fold f acc (r : Residual.t) =
  match r with
  (* What is left of the round that runs is in [each]. *)
  | Repeat { round = Some _; again } -> fold f acc (Repeat { round = None; again })
  | r -> Residual.fold ~begun:(fold f) ~later:(fold f) ~leaf:(fold_leaf f) acc r

and fold_leaf f acc : Residual.leaf -> _ = function
  | Plan (p, _) -> f acc (Of_task p)
  | Code c | Maker c -> f acc (Of_code (false, c))
  | Handler c -> f acc (Of_code (true, c))
  | Given _ | Term _ | Held _ | Timer _ -> acc

let label = function Of_task p -> Task p.task_site | Of_code (_, c) -> Code c.lambda.id
let collected f r = List.rev (fold (fun found leaf -> List.rev_append (f leaf) found) [] r)
let labels = collected (fun leaf -> [ label leaf ])
let closures = collected (function Of_task _ -> [] | Of_code (handler, c) -> [ (handler, c) ])

let pairs c r =
  let of_closure (handler, code) = Array.to_list (Skeleton.of_code c.skeletons ~handler code).pairs in
  Array.of_list (List.concat_map of_closure (closures r))

(* {1 Keys} *)

type spelling = { context : context; sorted : bool; pair : int -> string; name : label -> string }

let ending s (p : platform_task) v =
  match Environment.ending s.context.options v p.name with
  | Environment.Succeeds -> "s"
  | May_fail -> "m"
  | Fails -> "f"

let code s ~handler c =
  let skeleton = Skeleton.of_code s.context.skeletons ~handler c in
  let pairs = String.concat "," (List.map s.pair (Array.to_list skeleton.pairs)) in
  Printf.sprintf "%s:%d{%s}" (s.name (Code c.lambda.id)) skeleton.number pairs

let beside s keys = String.concat "|" (if s.sorted then List.sort String.compare keys else keys)

let rec spell s (r : Residual.t) =
  match r with
  | Ready (p, v) -> Printf.sprintf "t%s%s" (ending s p v) (s.name (Task p.task_site))
  | Running (p, v) -> Printf.sprintf "T%s%s" (ending s p v) (s.name (Task p.task_site))
  | Action c -> "a" ^ code s ~handler:false c
  | Condition c -> "c" ^ code s ~handler:false c
  | Sequence (a, rest) -> "(" ^ String.concat ">" (List.map (spell s) (a :: rest)) ^ ")"
  | Parallel bs -> "[" ^ beside s (List.map (spell s) (Branches.to_list bs)) ^ "]"
  | All_of (a, bs) ->
    let running = match a with Some a -> spell s a | None -> "" in
    "all(" ^ running ^ "!" ^ beside s (List.map (spell_branch s) bs) ^ ")"
  | One_of bs -> "one(" ^ beside s (List.map (spell_branch s) bs) ^ ")"
  | Until (e, c, a) -> Printf.sprintf "%s(%s,%s)" (Value.until e) (code s ~handler:false c) (spell s a)
  | Idle { seconds; _ } -> Printf.sprintf "idle%h" seconds
  | Confirm { prompt; _ } -> Printf.sprintf "confirm%S" prompt
  | During { on_cut; duration; started; body; _ } ->
    let time = match duration with Seconds x -> Printf.sprintf "%h" x | Given_by c -> code s ~handler:false c in
    Printf.sprintf "%s(%b,%s,%s)" (Value.during on_cut) started time (spell s body)
  | Watch (a, { code = c; _ }) -> "watch(" ^ code s ~handler:true c ^ "," ^ spell s a ^ ")"
  | Repeat { round; again = { left; until; each; _ } } ->
    let optional f x = Option.fold x ~none:"" ~some:f in
    Printf.sprintf "repeat(%s,%s,%s,%s)" (optional string_of_int left) (optional (code s ~handler:false) until)
      (optional (spell s) round) (spell s each)
  | Made { code = c; _ } -> "made" ^ code s ~handler:false c
  | Recruit { code = c; _ } -> "recruit" ^ code s ~handler:false c
  | Fresh (ns, a) -> Printf.sprintf "fresh(%d,%s)" (List.length ns) (spell s a)
  | Unallocated _ | Hold _ | Recruited _ -> invalid_arg "Task_isomorphism: a task that has begun"
  | Ensure _ -> invalid_arg "Task_isomorphism: a task with an ensure"

and spell_branch s (b : Residual.branch) = code s ~handler:false b.guard ^ "?" ^ spell s b.body

let key context ~sorted ~pair ~label r = spell { context; sorted; pair; name = label } r

(* {1 Matching} *)

let ends_alike e e' =
  match e, e' with Completes _, Completes _ | Fails _, Fails _ -> true | (Completes _ | Fails _), _ -> false

exception Different

let matched context ~rename r r' =
  let spelling pair = { context; sorted = true; pair = (fun n -> string_of_int (pair n)); name = (fun _ -> "") } in
  let before = spelling rename and after = spelling Fun.id in
  let found = ref [] in
  let note l l' = found := (l, l') :: !found in
  let same_code ~handler c c' =
    if code before ~handler c <> code after ~handler c' then raise_notrace Different;
    note (Code c.lambda.id) (Code c'.lambda.id)
  in
  (* Children with equal keys are isomorphic: the first that is left is taken. *)
  let children spell each xs xs' =
    if List.compare_lengths xs xs' <> 0 then raise_notrace Different;
    let left = Hashtbl.create 16 in
    List.iter (fun x' -> Hashtbl.add left (spell after x') x') (List.rev xs');
    let find x =
      let key = spell before x in
      match Hashtbl.find_opt left key with
      | None -> raise_notrace Different
      | Some x' ->
        Hashtbl.remove left key;
        each x x'
    in
    List.iter find xs
  in
  let both f x x' =
    match x, x' with
    | None, None -> ()
    | Some x, Some x' -> f x x'
    | None, Some _ | Some _, None -> raise_notrace Different
  in
  let rec go (r : Residual.t) (r' : Residual.t) =
    match r, r' with
    | Ready (p, v), Ready (p', v') | Running (p, v), Running (p', v') ->
      if ending before p v <> ending after p' v' then raise_notrace Different;
      note (Task p.task_site) (Task p'.task_site)
    | Action c, Action c' | Condition c, Condition c' -> same_code ~handler:false c c'
    | Sequence (a, rest), Sequence (a', rest') ->
      if List.compare_lengths rest rest' <> 0 then raise_notrace Different;
      List.iter2 go (a :: rest) (a' :: rest')
    | Parallel bs, Parallel bs' -> children spell go (Branches.to_list bs) (Branches.to_list bs')
    | All_of (None, bs), All_of (None, bs') | One_of bs, One_of bs' -> children spell_branch branch bs bs'
    | All_of (Some a, bs), All_of (Some a', bs') ->
      go a a';
      children spell_branch branch bs bs'
    | Until (e, c, a), Until (e', c', a') when ends_alike e e' ->
      same_code ~handler:false c c';
      go a a'
    | Watch (a, h), Watch (a', h') ->
      same_code ~handler:true h.code h'.code;
      go a a'
    | Idle { seconds; _ }, Idle { seconds = seconds'; _ } when seconds = seconds' -> ()
    | Confirm { prompt; _ }, Confirm { prompt = prompt'; _ } when String.equal prompt prompt' -> ()
    | During ({ duration = Seconds s; _ } as d), During ({ duration = Seconds s'; _ } as d')
      when s = s' && d.started = d'.started && ends_alike d.on_cut d'.on_cut -> go d.body d'.body
    | During ({ duration = Given_by c; _ } as d), During ({ duration = Given_by c'; _ } as d')
      when d.started = d'.started && ends_alike d.on_cut d'.on_cut ->
      same_code ~handler:false c c';
      go d.body d'.body
    | Fresh (ns, a), Fresh (ns', a') when List.compare_lengths ns ns' = 0 -> go a a'
    | Repeat { round; again }, Repeat { round = round'; again = again' } when again.left = again'.left ->
      both (same_code ~handler:false) again.until again'.until;
      both go round round';
      go again.each again'.each
    | _, _ -> raise_notrace Different
  and branch (b : Residual.branch) (b' : Residual.branch) =
    same_code ~handler:false b.guard b'.guard;
    go b.body b'.body
  in
  match go r r' with () -> Some !found | exception Different -> None
