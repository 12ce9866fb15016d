open Dolphin_semantics
open Test_support
module Gen = QCheck2.Gen

(* {1 As lists are} *)

(* A branch is a number here, which determines its marks. *)
let marks n : Branches.mark list =
  let own : Branches.mark list =
    match n mod 5 with
    | 0 -> [ Alone ]
    | 1 -> [ End_on (string_of_int (n / 5)) ]
    | 2 -> [ Number (n / 5); Recruits ]
    | 3 -> [ Alone; Number (n / 5) ]
    | _ -> []
  in
  if n mod 7 = 0 then Branches.Within :: own else own

let is_marked m n =
  let is_same m' = Branches.compare_marks m m' = 0 in
  List.exists is_same (marks n)

let all_marks = Branches.[ Alone; Recruits; End_on "3"; End_on "40"; Number 3; Number 40 ]

(* At the place of one branch, known by its number modulo theirs, come others. *)
type change = { at : int; come : int list }

let changes =
  let open Gen in
  let branch = int_bound 400 in
  let come = frequency [ (3, return []); (4, map (fun n -> [ n ]) branch); (2, list_size (int_range 2 5) branch) ] in
  let anywhere = map2 (fun at come -> { at; come }) (int_bound 1000) come in
  (* No gap is wide enough for a place that is divided again and again. *)
  let divided at = map2 (fun n m -> { at; come = [ n; m ] }) branch branch in
  let many = frequency [ (3, list_size (int_bound 60) anywhere);
                         (1, int_bound 3 >>= fun at -> list_size (int_range 45 90) (divided at)) ] in
  pair (list_size (int_range 2 40) branch) many

let print (rs, cs) =
  let list ns = String.concat " " (List.map string_of_int ns) in
  let change { at; come } = Printf.sprintf "%d: %s" at (list come) in
  Printf.sprintf "%s\n%s" (list rs) (String.concat "\n" (List.map change cs))

let changed at come rs = List.concat (List.mapi (fun i r -> if i = at then come else [ r ]) rs)
let but at rs = changed at [] rs

let is_as bs rs =
  let branches found = List.of_seq (Seq.map fst found) in
  let beside = List.of_seq (Seq.map (fun (_, place) -> Branches.beside place) (Branches.places bs)) in
  Branches.to_list bs = rs
  && branches (Branches.places bs) = rs
  && beside = List.mapi (fun i _ -> but i rs) rs
  && Branches.only bs = (match rs with [ r ] -> Some r | _ -> None)
  && List.for_all (fun m -> branches (Branches.marked is_marked m bs) = List.filter (is_marked m) rs) all_marks

let as_lists (rs, cs) =
  let apply (bs, rs) { at; come } =
    if rs = [] then (bs, rs)
    else
      let at = at mod List.length rs in
      let _, place = List.nth (List.of_seq (Branches.places bs)) at in
      let bs' = Branches.put ~marks place come and rs' = changed at come rs in
      if not (is_as bs rs) then QCheck2.Test.fail_report "a change changes the branches before it";
      (bs', rs')
  in
  let after (bs, rs) = List.fold_left apply (bs, rs) cs in
  let is_as (bs, rs) = is_as bs rs in
  is_as (after (Branches.begun ~marks rs, rs)) && is_as (after (Branches.of_list rs, rs))

(* {1 With an index and without} *)

let rec listed r =
  Residual.map
    { part = listed; code = Fun.id; handler = Fun.id; maker = Fun.id; value = Fun.id; term = Fun.id; vehicle = Fun.id }
    r

let task name : Core.platform_task = { name; plan = None; task_site = Fault.unknown_site }

(* Branches that wait, enough for an index. *)
let waiting first : Residual.t list =
  List.init 20 (fun i : Residual.t ->
      if i mod 2 = 0 then Running (task "w", Printf.sprintf "w%d" (first + i))
      else Idle { timer = first + i; seconds = 9.; site = Fault.unknown_site })

(* [r] among branches with an index, of which one has an index of its own, and has [r] in it too or not. *)
let among ~deep r : Residual.t =
  let inner = Residual.parallel (if deep then waiting 9_000 @ [ r ] else waiting 9_000) in
  let nest : Residual.t =
    During { on_cut = Completes Fault.unknown_site; timer = 8_999; duration = Seconds 9.; started = true; body = inner }
  in
  let around = if deep then [ nest ] else [ nest; r ] in
  let whole, _ = Residual.activate (Residual.parallel (waiting 8_000 @ around)) in
  if not (Residual.equal whole (listed whole)) then QCheck2.Test.fail_report "an index makes a difference";
  whole

let event : Transition.awaited -> Transition.event list = function
  | End_of v -> [ Vehicle_done v; Vehicle_failed (v, "lost") ]
  | Expiry_of n -> [ Timer_expired n ]
  | Answer_to (n, _) -> [ Confirmed (n, Ok true); Confirmed (n, Error "silence") ]
  | Recruit_for (n, _) -> List.map (fun v -> Transition.Recruited (n, v)) [ "va"; "vb"; "vc" ]
  | Answer | Reply -> []

let effect_text = Format.asprintf "%a" Effect.pp

let same (t : Transition.t) (t' : Transition.t) =
  Label.equal t.label t'.label && Configuration.equal t.next t'.next && t.rules = t'.rules
  && List.map effect_text t.effects = List.map effect_text t'.effects

let check what ts ts' =
  if not (List.compare_lengths ts ts' = 0 && List.for_all2 same ts ts') then
    QCheck2.Test.fail_reportf "with an index, %s: %d transitions instead of %d, or others" what (List.length ts)
      (List.length ts')

let agree program (c : Configuration.t) machine r =
  let within r = { c with control = Executing (machine, r) } in
  let c = within r and c' = within (listed r) in
  let world = Generate.world in
  let internal c = List.of_seq (Transition.internal program world c) in
  check "by themselves" (internal c) (internal c');
  let awaited = Transition.awaited c' in
  if awaited <> Transition.awaited c then QCheck2.Test.fail_report "other events are awaited";
  let on event =
    let accept c = Option.to_list (Result.to_option (Transition.accept program world c event)) in
    check "on an event" (accept c) (accept c')
  in
  List.iter on (Transition.Vehicle_done "stranger" :: List.concat_map event awaited);
  if Residual.awaits Recruits r <> Residual.awaits Recruits (listed r) then
    QCheck2.Test.fail_report "recruits are overlooked"

let along_walks =
  Property.case ~count:150 "the same transitions" ~print:(fun (p, _) -> Generate.print p)
    (Gen.pair Generate.program Walk.choices) (fun (program, choices) ->
        let program = Generate.compile program in
        let judge (s : Walk.step) =
          match s.before.control with
          | Executing (m, r) ->
            agree program s.before m (among ~deep:false r);
            agree program s.before m (among ~deep:true r)
          | Script _ | Waiting _ | Ended _ -> ()
        in
        List.iter judge (Walk.run ~choices program Generate.world);
        true)

(* {1 Growth} *)

(* Bytes for each transition of [n] vehicles with two plans each, after their task has begun. *)
let bytes_of_transition n =
  let program =
    Pure_run.compile_exn
      (Printf.sprintf
         "pick { count %d }\ndef each(i) { return task('p') >> task('q') }\nt = each(1)\n\
          for (i in 2..%d) { t = t | each(i) }\nexecute t" n n)
  in
  let world = Pure_run.world (List.init n (fun i -> Pure_run.vehicle (Printf.sprintf "v%d" i))) in
  let internal c = Seq.fold_left (fun _ t -> t) None (fun () ->
      match Transition.internal program world c () with Seq.Nil -> Seq.Nil | Cons (t, _) -> Cons (Some t, Seq.empty))
  in
  let running = Queue.create () and count = ref 0 and bytes = ref 0. in
  let rec go (c : Configuration.t) =
    let is_executing = match c.control with Executing _ -> true | Script _ | Waiting _ | Ended _ -> false in
    let before = Gc.allocated_bytes () in
    let next =
      match internal c with
      | Some t -> Some t
      | None when Queue.is_empty running -> None
      | None -> Result.to_option (Transition.accept program world c (Vehicle_done (Queue.pop running)))
    in
    if is_executing then bytes := !bytes +. (Gc.allocated_bytes () -. before);
    match next with
    | None -> c
    | Some t ->
      if is_executing then incr count;
      (match t.label with Start (v, _) -> Queue.push v running | _ -> ());
      go t.next
  in
  let last = go (Configuration.initial program) in
  Alcotest.(check string) "ends" "completed" (match last.control with Ended Completed -> "completed" | _ -> "goes on");
  Alcotest.(check int) "transitions" (4 * n) !count;
  !bytes /. float !count

(* A list of branches that is copied takes sixteen times as many bytes for sixteen times as many branches. *)
let is_linear () =
  let few = bytes_of_transition 50 and many = bytes_of_transition 800 in
  if many > 2. *. few then Alcotest.failf "%.0f bytes a transition for 50 branches, %.0f for 800" few many

let () =
  Alcotest.run "branches"
    [ ("branches", [ Property.case ~count:300 "as lists are" ~print changes as_lists ]);
      ("transitions", [ along_walks ]);
      ("growth", [ Alcotest.test_case "plans side by side" `Quick is_linear ]) ]
