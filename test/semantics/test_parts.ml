open Dolphin_semantics
open Test_support

(* {1 Residuals} *)

let constructor : Residual.t -> string = function
  | Ready _ -> "Ready" | Running _ -> "Running" | Action _ -> "Action" | Condition _ -> "Condition"
  | Sequence _ -> "Sequence" | Parallel _ -> "Parallel" | All_of _ -> "All_of" | One_of _ -> "One_of"
  | Until _ -> "Until" | Idle _ -> "Idle" | Confirm _ -> "Confirm" | During _ -> "During" | Watch _ -> "Watch"
  | Repeat _ -> "Repeat" | Made _ -> "Made" | Unallocated _ -> "Unallocated" | Hold _ -> "Hold"
  | Recruit _ -> "Recruit" | Recruited _ -> "Recruited" | Fresh _ -> "Fresh" | Ensure _ -> "Ensure"

(* A part that both views see, compared by identity. *)
type seen = Residual of Residual.t | Code of string * Core.closure | Value of Core.value | Term of Core.task
          | Vehicle of Core.vehicle

let same a b =
  match a, b with
  | Residual a, Residual b -> a == b
  | Code (kind, a), Code (kind', b) -> String.equal kind kind' && a == b
  | Value a, Value b -> a == b
  | Term a, Term b -> a == b
  | Vehicle a, Vehicle b -> String.equal a b
  | (Residual _ | Code _ | Value _ | Term _ | Vehicle _), _ -> false

let folded r =
  let residual found r = Residual r :: found in
  let leaf found (leaf : Residual.leaf) =
    match leaf with
    | Plan (_, v) | Held v -> Vehicle v :: found
    | Code c -> Code ("code", c) :: found
    | Handler c -> Code ("handler", c) :: found
    | Maker c -> Code ("maker", c) :: found
    | Given x -> Value x :: found
    | Term t -> Term t :: found
    | Timer _ -> found
  in
  List.rev (Residual.fold ~begun:residual ~later:residual ~leaf [] r)

let mapped r =
  let found = ref [] in
  let note seen x =
    found := seen x :: !found;
    x
  in
  let code kind = note (fun c -> Code (kind, c)) in
  let image =
    Residual.map
      { part = note (fun r -> Residual r); code = code "code"; handler = code "handler"; maker = code "maker";
        value = note (fun x -> Value x); term = note (fun t -> Term t); vehicle = note (fun v -> Vehicle v) }
      r
  in
  (image, List.rev !found)

(* Only [map] has the vehicles that a task made later may be given. *)
let has_a_request (r : Residual.t) =
  match r with Made _ | Unallocated _ | Watch (_, { anew = Some _; _ }) -> true | _ -> false

let without_vehicles = List.filter (function Vehicle _ -> false | Residual _ | Code _ | Value _ | Term _ -> true)

let views_agree r =
  let image, mapped = mapped r in
  let mapped, folded =
    if has_a_request r then without_vehicles mapped, without_vehicles (folded r) else mapped, folded r
  in
  let fail what = QCheck2.Test.fail_reportf "%s: %a" what Residual.pp r in
  if not (List.equal same mapped folded) then fail "fold and map differ";
  if not (Residual.equal r image) then fail "the identity maps to another residual"

(* {1 Tasks} *)

(* The task inside of code is not in a task: that of each [repeat] is, for instance. *)
let rec parts_are_smaller t =
  let all = Task.parts t in
  let image = Task.map { part = Fun.id; code = Fun.id; value = Fun.id; vehicle = Fun.id } t in
  if Value.compare_task t image <> 0 then QCheck2.Test.fail_reportf "the identity maps a task to another";
  List.iter parts_are_smaller all;
  let shown t = String.length (Value.to_string (Core.Task t)) in
  if List.exists (fun part -> shown part > shown t) all then QCheck2.Test.fail_reportf "a part is larger than its whole"

(* {1 Along walks} *)

let seen = Hashtbl.create 32

let judge (c : Configuration.t) =
  match c.control with
  | Executing (_, r) ->
    let node () r =
      Hashtbl.replace seen (constructor r) ();
      views_agree r
    in
    Residual.fold_all node () r;
    let counted = List.length (Residual.fold_all (fun all r -> r :: all) [] r) in
    let rec count r = 1 + List.fold_left (fun n r -> n + count r) 0 (Residual.parts r) in
    if counted <> count r then QCheck2.Test.fail_reportf "fold_all misses parts of %a" Residual.pp r
  | Waiting (_, Execute t) -> parts_are_smaller t
  | Script _ | Waiting (_, (Pick _ | Ask _ | Pause _ | Host_call _)) | Ended _ -> ()

let walks = QCheck2.Gen.pair Generate.program Walk.choices

let along_walks =
  Property.case ~count:1_000 "the views see the same parts" ~print:(fun (p, _) -> Generate.print p) walks
    (fun (program, choices) ->
       let walk = Walk.run ~choices (Generate.compile program) Generate.world in
       List.iter (fun (s : Walk.step) -> judge s.before) walk;
       true)

let all =
  [ "Ready"; "Running"; "Action"; "Condition"; "Sequence"; "Parallel"; "All_of"; "One_of"; "Until"; "Idle"; "Confirm";
    "During"; "Watch"; "Repeat"; "Made"; "Unallocated"; "Hold"; "Recruit"; "Recruited"; "Fresh"; "Ensure" ]

let every_constructor () =
  let missing = List.filter (fun name -> not (Hashtbl.mem seen name)) all in
  Alcotest.(check (list string)) "constructors that no walk met" [] missing

(* {1 Limits}

   No vehicle is bound, so a task that is walked fails for another reason. *)

let idle = Core.Idle { seconds = 1.; site = Fault.unknown_site }
let plan = Core.Platform { name = "p"; plan = None; task_site = Fault.unknown_site }

(* A task of [n] parts, an odd number. Equal parts of it are one value. *)
let of_parts n =
  let known = Hashtbl.create 64 in
  let rec make n =
    match Hashtbl.find_opt known n with
    | Some t -> t
    | None ->
      let first = (n - 1) / 4 * 2 + 1 in
      let t = if n = 1 then idle else Core.Sequence (make first, make (n - 1 - first)) in
      Hashtbl.add known n t;
      t
  in
  make n

let rec nested depth t = if depth = 0 then t else nested (depth - 1) (Core.Sequence (t, idle))

let is_refused t =
  match Allocation.allocate World.empty [] { tasks = []; numbers = Seq.empty } t with
  | Ok (Error fault) ->
    String.equal fault.message "the task has more than 1000000 parts, or is nested more than 10000 deep"
  | Ok (Ok _) | Error _ -> Alcotest.fail "the plan has a vehicle"

let limits () =
  let check expected name t = Alcotest.(check bool) name expected (is_refused t) in
  check false "999,999 parts" (Sequence (plan, of_parts 999_997));
  check true "1,000,001 parts" (Sequence (plan, of_parts 999_999));
  check false "10,000 deep" (nested 10_000 plan);
  check true "10,001 deep" (nested 10_001 plan)

let () =
  let quick name test = Alcotest.test_case name `Quick test in
  Alcotest.run "parts"
    [ ("views", [ along_walks; quick "every constructor was met" every_constructor ]);
      ("limits", [ quick "tasks that are too large are refused" limits ]) ]
