open Dolphin_semantics
open Test_support
module Gen = QCheck2.Gen

let fail format = Printf.ksprintf QCheck2.Test.fail_report format
let label (t : Transition.t) = Format.asprintf "%a" Label.pp t.label

(* The effect of a step, for the message about its fault. *)
let shown (s : Walk.step) = Printf.sprintf "%s (%s)" (label s.transition) (Pure_run.rules s.transition)

let has rules (t : Transition.t) = List.exists (fun r -> List.mem r rules) t.rules

let is_ended (c : Configuration.t) =
  match c.control with Ended _ -> true | Script _ | Waiting _ | Executing _ -> false

(* {1 Walks} *)

let walks = Gen.pair Generate.program Walk.choices

let print (program, choices) =
  let walk = Walk.run ~choices (Generate.compile program) Generate.world in
  Printf.sprintf "%s\n%s" (Generate.print program) (String.concat "\n" (List.map shown walk))

(* [along name property] is the case that [property] holds of each step of walks. *)
let along ?(count = 3_000) name property =
  Property.case ~count name ~print walks (fun (program, choices) ->
      let program = Generate.compile program in
      List.for_all (property program) (Walk.run ~choices program Generate.world))

(* Recruits side by side, of vehicles that fit more than one of them. *)
let recruiting ?(count = 100) name property =
  let program =
    Pure_run.compile_exn
      "execute recruit { type 'UUV' } then { idle(1) } | recruit { type 'UUV' } then { idle(2) }\n\
       | recruit { } then { v -> task('p')[v] }"
  in
  let print _ = "recruits side by side" in
  Property.case ~count name ~print Walk.choices (fun choices ->
      List.for_all (property program) (Walk.run ~choices program Generate.world))

(* {1 Properties of one step} *)

let keeps_the_invariant _ (s : Walk.step) =
  match Configuration.invariant s.transition.next with
  | Ok () -> true
  | Error why -> fail "after %s: %s" (shown s) why

let bound_by = [ Rule.Pick_bind; Release; End; Halt; Fault; Interrupt; Pick_err; Answer_err; Call_err; Execute_err;
                 Alloc_err; Watch_halt; Assert_err ]

let released = function Effect.Release vs -> vs | _ -> []

(* By a handler, vehicles leave B that run nothing, and an effect reports it. *)
let dismissed (s : Walk.step) =
  let gone = List.concat_map released s.transition.effects and { Configuration.shared; _ } = s.transition.next in
  has [ Rule.Watch_ignore; Watch_propagate; Watch_retry; Watch_instead ] s.transition
  && List.filter (fun v -> not (List.mem v gone)) s.before.shared.bound = shared.bound

let b_changes_only_so _ (s : Walk.step) =
  s.before.shared.bound = s.transition.next.shared.bound
  || has bound_by s.transition || dismissed s
  || (has [ Rule.On_interrupt ] s.transition
      && s.transition.next.shared.bound = s.before.shared.bound @ Configuration.recruits s.before)
  || fail "%s changed B" (shown s)

(* The vehicles that tasks recruit and leave, which effects bind and release. *)
let recruits_balance _ (s : Walk.step) =
  let bound = function Effect.Bind vs -> vs | _ -> [] and sorted = List.sort String.compare in
  let all of_effect = List.concat_map of_effect s.transition.effects in
  let had c = c.Configuration.shared.bound @ Configuration.recruits c in
  let before = had s.before and after = had s.transition.next in
  sorted (before @ all bound) = sorted (after @ all released)
  || fail "%s: bound were %s, are %s" (shown s) (String.concat ", " before) (String.concat ", " after)

let pairs n =
  List.concat_map (fun (k, xs) -> List.map (fun x -> Format.asprintf "%a" Value.pp_tuple (k, x)) xs) (Tuples.bindings n)

let deeds_of (l : Label.t) : Code.deed list =
  match l with
  | Check deeds | Act deeds | Cut deeds -> deeds
  | Did deed -> [ deed ]
  | Start _ | Done _ | Fail _ | Time_out | Set_time _ | Make | Allocate _ | Recruit _ | Broken _ | Silent | Pick _
  | Bind _ | No_vehicles _ | Ask _
  | Answer _ | No_answer | Pause _ | Resume | Call _ | Reply _ | No_reply _ | Input _ | Execute | Cannot_execute _
  | End | Halt _
  | Fault _ | Interrupt -> []

(* Handlers, halting code and the code of [during] post and consume unseen by labels. *)
let unseen = [ Rule.Watch_ignore; Watch_propagate; Watch_halt; Watch_retry; Watch_instead; Halt;
               During_set ]

(* The pairs that the parts which run would post if they were cut off. *)
let ensured (c : Configuration.t) =
  let posted : Core.ensured -> _ = function
    | Pair (k, x) -> Some (Format.asprintf "%a" Value.pp_tuple (k, x))
    | Variable _ | Taken -> None
  in
  match c.control with
  | Executing (_, r) -> List.filter_map posted (Residual.ensured r)
  | Script _ | Waiting _ | Ended _ -> []

(* [all] without each of [some], once for each time it is there. *)
let without some all =
  let rec remove x = function [] -> [] | y :: ys -> if String.equal x y then ys else y :: remove x ys in
  List.fold_left (fun all x -> remove x all) all some

(* Pairs of the keys of [fresh] are forgotten. Tasks that end post their ensured pairs; no other task does. *)
let tuples_are_conserved _ (s : Walk.step) =
  let texts = List.map (Format.asprintf "%a" Value.pp_tuple) in
  let posted, consumed =
    List.fold_left
      (fun (posted, consumed) (deed : Code.deed) ->
         match deed with
         | Posted xs -> (texts xs @ posted, consumed)
         | Consumed xs -> (posted, texts xs @ consumed)
         | Said _ | Released _ | Set_connection_timeout _ -> (posted, consumed))
      ([], []) (deeds_of s.transition.label)
  in
  let is_of_fresh pair = Residual.is_key (List.hd (String.split_on_char ':' pair)) in
  let others = List.filter (fun pair -> not (is_of_fresh pair)) in
  let before = pairs s.before.shared.tuples @ posted and after = pairs s.transition.next.shared.tuples @ consumed in
  let may_end = ensured s.before in
  let surely_end = if has [ Rule.Assert_err ] s.transition then [] else without (ensured s.transition.next) may_end in
  let gained = without (others before) (others after) in
  has unseen s.transition
  || (without (others after) (others before) = [] && without (before @ may_end) after = []
      && without may_end gained = [] && without gained (others surely_end) = [])
  || fail "%s: N was {%s}, is {%s}; those that end may post {%s}" (shown s)
    (String.concat ", " (pairs s.before.shared.tuples))
    (String.concat ", " (pairs s.transition.next.shared.tuples))
    (String.concat ", " may_end)

(* The end is the end: nothing is bound, nothing runs, no step follows; and the last effect reports it. *)
let ends_well program (s : Walk.step) =
  let { Transition.next; effects; _ } = s.transition in
  let says_so =
    match List.rev effects with
    | Effect.End e :: earlier ->
      List.for_all (function Effect.End _ -> false | _ -> true) earlier && next.control = Ended e
    | _ -> false
  in
  if is_ended next then
    (says_so || fail "%s: no effect End" (shown s))
    && (next.shared.bound = [] && Vehicle_map.is_empty next.shared.allocation
        || fail "%s: vehicles are left" (shown s))
    && (List.sort compare (List.concat_map released effects) 
        = List.sort compare (s.before.shared.bound @ Configuration.recruits s.before)
        || fail "%s: not released" (shown s))
    && (Graph.outcomes ~interruption:true program Generate.world next = [] || fail "%s: goes on" (shown s))
  else not says_so || fail "%s: ends and goes on" (shown s)

let vehicles_of map = List.map fst (Vehicle_map.bindings map)

(* Starts and stops, applied to the earlier tasks, give the later ones; no vehicle starts twice, and a vehicle that
   stops ran. *)
let starts_and_stops_balance _ (s : Walk.step) =
  let ended = match s.transition.label with Done (v, _) | Fail (v, _, _) -> [ v ] | _ -> [] in
  let running = List.filter (fun v -> not (List.mem v ended)) (vehicles_of s.before.shared.allocation) in
  let carry running (e : Effect.t) =
    match e with
    | Start (v, _) -> if List.mem v running then fail "%s: %s starts twice" (shown s) v else v :: running
    | Stop v ->
      if List.mem v running then List.filter (( <> ) v) running else fail "%s: %s does not run" (shown s) v
    | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
    | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> running
  in
  let running = List.fold_left carry running s.transition.effects in
  List.sort String.compare running = vehicles_of s.transition.next.shared.allocation
  || fail "%s: A differs from what was started and stopped" (shown s)

let timers_of (c : Configuration.t) =
  match c.control with
  | Executing (_, r) -> List.map fst (Residual.waits r)
  | Waiting (_, (Pick _ | Pause _)) -> [ Residual.script_timer ]
  | Waiting (_, (Ask _ | Execute _ | Host_call _)) | Script _ | Ended _ -> []

(* Questions are numbered among the timers, and put, answered and withdrawn as these. *)
let expires (l : Label.t) =
  match l with Time_out | Answer _ | No_answer | Resume | Bind _ | No_vehicles _ -> true | _ -> false

(* A timer that was set runs until it is cancelled, once, or expires; after it expires, a round may set it again. *)
let timers_balance _ (s : Walk.step) =
  let expired = ref (expires s.transition.label) in
  let start timer pending =
    if List.mem timer pending && !expired then (expired := false; pending)
    else if List.mem timer pending then fail "%s: timer %d runs already" (shown s) timer else timer :: pending
  in
  let carry pending (e : Effect.t) =
    match e with
    | Set_timer (timer, _) | Put_question (timer, _) -> start timer pending
    | Look_for _ -> start Residual.script_timer pending
    | Cancel_timer timer | Withdraw_question timer ->
      if List.mem timer pending then List.filter (( <> ) timer) pending
      else fail "%s: timer %d does not run" (shown s) timer
    | Start _ | Stop _ | Bind _ | Release _ | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> pending
  in
  let pending = List.fold_left carry (timers_of s.before) s.transition.effects in
  let after = timers_of s.transition.next in
  let gone = List.filter (fun timer -> not (List.mem timer after)) pending in
  List.for_all (fun timer -> List.mem timer pending) after
  && List.length gone <= (if expires s.transition.label then 1 else 0)
  || fail "%s: timers %s were running, %s are expected to run" (shown s)
    (String.concat ", " (List.map string_of_int pending))
    (String.concat ", " (List.map string_of_int after))

(* Awaited events are accepted, and others are not. *)
let awaits_what_it_accepts program (s : Walk.step) =
  let c = s.before in
  let awaited = Transition.awaited c in
  let accepts e = Result.is_ok (Transition.accept program Generate.world c e) in
  List.for_all
    (fun v ->
       let expected = List.mem (Transition.End_of v) awaited in
       accepts (Vehicle_done v) = expected && accepts (Vehicle_failed (v, "")) = expected
       || fail "before %s: %s is %sawaited" (shown s) v (if expected then "" else "not "))
    [ "a"; "b"; "c"; "d" ]
  && List.for_all
    (fun timer ->
       (not (accepts (Timer_expired timer))) || List.mem (Transition.Expiry_of timer) awaited
       || fail "before %s: timer %d is not awaited" (shown s) timer)
    [ 0; 1; 2; 3; 4; 5 ]

(* {1 Properties of whole walks} *)

let same_run (a : Walk.step list) (b : Walk.step list) =
  List.equal
    (fun (a : Walk.step) (b : Walk.step) ->
       Configuration.equal a.before b.before
       && Configuration.equal a.transition.next b.transition.next
       && Label.equal a.transition.label b.transition.label
       && a.transition.rules = b.transition.rules)
    a b

let is_reproducible (program, choices) =
  let walk () = Walk.run ~choices (Generate.compile program) Generate.world in
  same_run (walk ()) (walk ())

let sign n = Int.compare n 0

(* Of two walks through one program, all configurations with each other. *)
let is_coherent (program, (choices, choices')) =
  let program = Generate.compile program in
  let through choices =
    List.map (fun (s : Walk.step) -> s.transition.next) (Walk.run ~choices program Generate.world)
  in
  let all = through choices @ through choices' in
  let text = Format.asprintf "%a" (Configuration.pp program) in
  let described = List.map (fun c -> (c, Configuration.hash c, text c)) all in
  let agree (c, hash, text) (c', hash', text') =
    let order = Configuration.compare c c' in
    sign order = -sign (Configuration.compare c' c)
    && Configuration.equal c c' = (order = 0)
    && (order <> 0 || (hash = hash' || fail "unequal hashes of %s" text) && (text = text' || fail "%s\n%s" text text'))
  in
  let transitive a b c =
    let ( <= ) (a, _, _) (b, _, _) = Stdlib.( <= ) (Configuration.compare a b) 0 in
    not (a <= b && b <= c) || a <= c
  in
  let few = List.filteri (fun i _ -> i < 15) described in
  List.for_all (fun a -> List.for_all (agree a) described) described
  && List.for_all (fun a -> List.for_all (fun b -> List.for_all (transitive a b) few) few) few

(* {1 Guards are transactions} *)

(* [refused guard] checks that a condition that is false leaves everything as it was, and does not go on. *)
let refused guard () =
  let program = Pure_run.compile_exn (Printf.sprintf "g = 0\npost a: 1\nexecute condition { %s }" guard) in
  let c = Option.get (Pure_run.last (Pure_run.run program)) in
  Alcotest.(check int) "no step" 0 (List.length (Graph.outcomes program Pure_run.fleet c));
  Alcotest.(check (list string)) "N" [ "a:1" ] (pairs c.shared.tuples);
  let values = List.map (fun (_, x) -> Value.to_string x) (Store.bindings c.shared.store) in
  Alcotest.(check (list string)) "store" [ "0" ] values

(* A branch that is not taken leaves nothing to the one that is. *)
let refused_then_taken () =
  let source =
    "g = 0\npost a: 1\n\
     execute oneOf {\n\
     when { post b: 1; g = 7; message 'no'; consume a: 1, c: 1 } then action { message 'first' }\n\
     when { poll(b: 1) } then action { message 'second' }\n\
     when { consume a: 1 } then action { message \"third ${g}\" } }"
  in
  let run = Pure_run.run (Pure_run.compile_exn source) in
  Alcotest.(check (list string)) "said" [ "third 0" ] (Pure_run.said run);
  Alcotest.(check (list string)) "N" [] (pairs (Option.get (Pure_run.last run)).shared.tuples)

(* The rest of a long task has another hash after each part: tables of residuals would be slow otherwise. *)
let hashes_of_long_tasks () =
  let condition = "execute condition { false }" in
  let code =
    match (Pure_run.last (Pure_run.run (Pure_run.compile_exn condition)) : Configuration.t option) with
    | Some { control = Executing (_, Condition code); _ } -> code
    | _ -> Alcotest.fail "no condition waits"
  in
  let rest n = Residual.Sequence (Action code, List.init n (fun _ -> Residual.Action code)) in
  let buckets = List.init 1_000 (fun n -> Residual.hash (rest n) land 0xffff) in
  let different = List.length (List.sort_uniq Int.compare buckets) in
  if different < 950 then Alcotest.failf "1,000 residuals have %d hashes" different

let case name f = Alcotest.test_case name `Quick f

let () =
  let two_walks = Gen.pair Generate.program (Gen.pair Walk.choices Walk.choices) in
  Alcotest.run "invariants"
    [ ( "every step",
        [ along "keeps the invariant of configurations" keeps_the_invariant;
          along "changes B by PICK-BIND, RELEASE, dismiss or the end alone" b_changes_only_so;
          along "binds and releases whom it takes and leaves" recruits_balance;
          recruiting "recruits nobody twice" keeps_the_invariant;
          along "conserves tuples" tuples_are_conserved;
          along "ends well" ends_well;
          along "balances starts and stops" starts_and_stops_balance;
          along "balances timers" timers_balance;
          along "awaits what it accepts" awaits_what_it_accepts ] );
      ( "walks",
        [ Property.case ~count:300 "are reproducible" ~print walks is_reproducible;
          Property.case ~count:150 "have coherent configurations" two_walks is_coherent
            ~print:(fun (program, (choices, _)) -> print (program, choices)) ] );
      ( "guards",
        [ case "false with a post" (refused "post b: 1; false");
          case "false with an assignment" (refused "g = 5; g == 0");
          case "false with a consume" (refused "consume a: 1; false");
          case "one pair of two" (refused "consume a: 1, b: 1");
          case "two consumes" (refused "consume(a: 1) && consume(b: 1)");
          case "the same pair twice" (refused "consume a: 1, a: 1");
          case "refused, then another taken" refused_then_taken ] );
      ("hashes", [ case "of long tasks" hashes_of_long_tasks ]) ]
