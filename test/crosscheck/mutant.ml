type t = { name : string; file : string; pattern : string; replacement : string }

let rules = "Dolphin.tla"
let machine = "DolphinMachine.tla"
let values = "DolphinValues.tla"

let all =
  [ { name = "PAR-ERR leaves the siblings running";
      file = rules;
      pattern = {|  By([ s EXCEPT !.S = WithoutA(@, Range(Flatten(Each(Without(rs, j), Running)))) ], "PAR-ERR", s.out)|};
      replacement = {|  By(s, "PAR-ERR", s.out)|} };
    { name = "PAR-ERR lets the siblings go on";
      file = rules;
      pattern = {|    [] IsErr(s) -> PAR_ERR(s, rs, j)|};
      replacement = {|    [] IsErr(s) -> PAR_2(s, rs, j)|} };
    { name = "UNTIL-CUT stops nothing";
      file = rules;
      pattern = {|Program, Cut(run.S, r), Done_, run.deeds)|};
      replacement = {|Program, run.S, Done_, run.deeds)|} };
    { name = "a fault of an until's condition stops nothing";
      file = rules;
      pattern = {|Broken("UNTIL-ERR", Cut(S, r), fault)|};
      replacement = {|Broken("UNTIL-ERR", S, fault)|} };
    { name = "DURING-CUT stops nothing";
      file = rules;
      pattern = {|<< "timer", r.timer >>, Cut(S, r.body), Done_, << >>)|};
      replacement = {|<< "timer", r.timer >>, S, Done_, << >>)|} };
    { name = "a handler that breaks leaves what it did before";
      file = rules;
      pattern = {|result(m, "fault", m.stop[2], Knowing(S, m.sees), << >>)|};
      replacement = {|result(m, "fault", m.stop[2], After(S, m), << >>)|} };
    { name = "a guard that is false takes effect";
      file = rules;
      pattern = {|    [] ~Truth(run.value) -> << >>|};
      replacement =
        {|    [] ~Truth(run.value) ->
         IF run.deeds = << >> THEN << >> ELSE << Step("CONDITION", "check", Program, run.S, Next_(r), << >>) >>|} };
    { name = "consume takes some of the pairs if not all are there";
      file = machine;
      pattern = {|          THEN LET y == Taken(N, k, x) IN TakeAll(WithoutPair(N, k, y), Tail(pairs), Append(taken, << k, y >>))
          ELSE << >>|};
      replacement =
        {|          THEN LET y == Taken(N, k, x) IN TakeAll(WithoutPair(N, k, y), Tail(pairs), Append(taken, << k, y >>))
          ELSE TakeAll(N, Tail(pairs), taken)|} };
    { name = "consume takes the newest pair";
      file = machine;
      pattern = {|Taken(N, k, x) == IF x = Wildcard THEN Head(N.queue[k]) ELSE x|};
      replacement = {|Taken(N, k, x) == IF x = Wildcard THEN Last(N.queue[k]) ELSE x|} };
    { name = "N is a set";
      file = machine;
      pattern = {|  ELSE [ N EXCEPT !.bag = @ (+) SetToBag({ << k, x >> }) ]|};
      replacement = {|  ELSE IF BagIn(<< k, x >>, N.bag) THEN N ELSE [ N EXCEPT !.bag = @ (+) SetToBag({ << k, x >> }) ]|} };
    { name = "an error passes a watch";
      file = rules;
      pattern = {|    [] IsErr(s) -> Handled(s, h)|};
      replacement = {|    [] IsErr(s) -> << WATCH_PROPAGATE(s, s.out[2]) >>|} };
    { name = "handlers ignore unless they propagate";
      file = rules;
      pattern = {|          [] run.verdict = "ignore" -> WATCH_IGNORE(after(run))|};
      replacement = {|          [] TRUE -> WATCH_IGNORE(after(run))|} };
    { name = "what a handler posts is lost";
      file = rules;
      pattern = {|after(run) == [ s EXCEPT !.S = run.S, !.deeds = @ \o run.deeds ]|};
      replacement = {|after(run) == s|} };
    { name = "a handler's halt only propagates";
      file = rules;
      pattern = {|        CASE run.is = "halt" -> WATCH_HALT(after(run), run.value)|};
      replacement = {|        CASE run.is = "halt" -> WATCH_PROPAGATE(after(run), s.out[2])|} };
    { name = "allOf runs two branches at a time";
      file = rules;
      pattern = {|       Next_(AllOf(<< Act(bs[j].body) >>, Without(bs, j))), run.deeds)|};
      replacement = {|       Next_(ParOf(<< Act(bs[j].body), AllOf(<< >>, Without(bs, j)) >>)), run.deeds)|} };
    { name = "allOf ends with its first branch";
      file = rules;
      pattern = {|ALLOF_2(s, bs) == By(s, "ALLOF-2", Next_(AllOf(<< >>, bs)))|};
      replacement = {|ALLOF_2(s, bs) == By(s, "ALLOF-2", Done_)|} };
    { name = "until is ignored before the first step";
      file = rules;
      pattern = {|    [] r.op = "until" -> << UNTIL_CUT(run, r.body) >>|};
      replacement = {|    [] r.op = "until" -> IF r.body.op = "ready" THEN << >> ELSE << UNTIL_CUT(run, r.body) >>|} };
    { name = "the timer of a during outlives its task";
      file = rules;
      pattern = {|DURING_2(s) == By(s, "DURING-2", Done_)|};
      replacement = {|DURING_2(s) == By(s, "DURING-2", Next_([ op |-> "idle", timer |-> 0, time |-> Integer(1) ]))|} };
    { name = "what the code of a during does is lost";
      file = rules;
      pattern = {|DURING-SET", "set-time(" \o ShortText(n) \o ")", Program, run.S,|};
      replacement = {|DURING-SET", "set-time(" \o ShortText(n) \o ")", Program, Shared,|} };
    { name = "SEQ-2 skips a part";
      file = rules;
      pattern = {|SEQ_2(s, ts) == By(s, "SEQ-2", Next_(Act(FromParts(ts))))|};
      replacement = {|SEQ_2(s, ts) == By(s, "SEQ-2", Next_(Act(FromParts(IF Len(ts) > 1 THEN Tail(ts) ELSE ts))))|} };
    { name = "an error goes on with the next part";
      file = rules;
      pattern = {|    [] IsErr(s) -> SEQ_ERR(s)|};
      replacement = {|    [] IsErr(s) -> SEQ_2(s, ts)|} };
    { name = "release forgets to unbind";
      file = rules;
      pattern = {|SelectSeq(@, LAMBDA v : v \notin V)|};
      replacement = {|@|} };
    { name = "the end releases no vehicles";
      file = rules;
      pattern = {|Ended(ending), [ S EXCEPT !.A = << >>, !.B = << >> ], deeds)|};
      replacement = {|Ended(ending), [ S EXCEPT !.A = << >> ], deeds)|} };
    { name = "pick takes the first vehicles only";
      file = rules;
      pattern = {|       [] OTHER -> Each(Choices(q.count, fit), LAMBDA V : PICK_BIND(M, V, Program))|};
      replacement = {|       [] OTHER -> << PICK_BIND(M, Choices(q.count, fit)[1], Program) >>|} };
    { name = "branches of | may share vehicles";
      file = rules;
      pattern = {|           \A i \in 1 .. n - 1 : << i, n >> \in exclusive => f[i] # f[n] }|};
      replacement = {|           TRUE }|} };
    { name = "an assertion that fails is an error";
      file = rules;
      pattern = {|IF run.value.assertion THEN ASSERT_ERR(run.S, run.value) ELSE WithFault(run.S, r, run.value)|};
      replacement = {|WithFault(run.S, r, run.value)|} };
    { name = "failures are not counted";
      file = rules;
      pattern = {|         [ outside EXCEPT !.failed = @ + 1 ]|};
      replacement = {|         outside|} };
    { name = "losses are not counted";
      file = rules;
      pattern = {|, !.losses = IF Losses = -1 THEN @ ELSE @ + 1 ]|};
      replacement = {| ]|} };
    { name = "a lost vehicle can be lost no more";
      file = rules;
      pattern = {|MayBeLost(v) == v \in outside.lost \/ |};
      replacement = {|MayBeLost(v) == |} };
    { name = "a lost vehicle stays lost whatever it does";
      file = rules;
      pattern = {|[ before EXCEPT !.lost = @ \ { v } ]|};
      replacement = {|before|} };
    { name = "a lost vehicle is there when it is looked for";
      file = rules;
      pattern = {|LAMBDA v : v \in outside.lost)|};
      replacement = {|LAMBDA v : FALSE)|} };
    { name = "a pick of others finds the lost";
      file = rules;
      pattern = {|!.lost = @ \ (Range(t.S.B) \ Range(B))|};
      replacement = {|!.lost = @ \ Range(t.S.B)|} };
    { name = "who was late is not remembered";
      file = rules;
      pattern = {|IF Latecomers = -1 THEN @ ELSE @ \cup t.late ]|};
      replacement = {|@ ]|} };
    { name = "the late come in the order of the fleet";
      file = rules;
      pattern = {|Each(moved, VehicleOf)|};
      replacement = {|SelectSeq(Fleet, LAMBDA vehicle : vehicle.id \in Range(moved))|} };
    { name = "what was seen is forgotten within the step";
      file = machine;
      pattern = {|Result(m, xs[m.sees[question]])|};
      replacement = {|Result([ m EXCEPT !.sees = NothingSeen ], xs[m.sees[question]])|} };
    { name = "a sensor shows its first value only, and comparisons hold";
      file = machine;
      pattern = {|Flatten([ i \in 1 .. m.stop[3] |-> Only|};
      replacement = {|Flatten([ i \in 1 .. 1 |-> Only|} };
    { name = "sensors of all vehicles show the same";
      file = machine;
      pattern = {|Ok(Reading(quantity, sensor \o "(" \o v \o ")"))|};
      replacement = {|Ok(Reading(quantity, sensor \o "(" \o Fleet[1].id \o ")"))|} };
    { name = "the opposite of a comparison is another comparison";
      file = values;
      pattern = {|HoldsNot(text) == Depends(<< "claim", text >>, << False, True >>)|};
      replacement = {|HoldsNot(text) == Depends(<< "claim", "not " \o text >>, << False, True >>)|} };
    { name = "what was shown is what is shown later";
      file = machine;
      pattern = {|KeptBy(keeper, x) == IF IsReading(x) THEN Reading(x[2], keeper) ELSE x|};
      replacement = {|KeptBy(keeper, x) == x|} };
    { name = "a handler does not see what the code saw";
      file = rules;
      pattern = {|  IN Each(RunCode(s.S, "handler", h,|};
      replacement = {|  IN Each(RunCode(Knowing(s.S, NothingSeen), "handler", h,|} };
    { name = "a step is another one by what sensors show, even if nothing depends on it";
      file = rules;
      pattern = {|IF Len(ts) < 2 THEN ts ELSE|};
      replacement = {|IF TRUE THEN ts ELSE|} };
    { name = "a vehicle is picked and allocated from where it was first";
      file = machine;
      pattern = {|  vehicle.places[IF Len(vehicle.places) = 1 THEN 1 ELSE sees[<< "position", vehicle.id >>]]|};
      replacement = {|  vehicle.places[1]|} };
    { name = "a vehicle is allocated from elsewhere than it was seen in the step";
      file = rules;
      pattern = {|Placings(S.sees, IF PrefersTheNear(t) THEN B ELSE << >>)|};
      replacement = {|Placings(NothingSeen, IF PrefersTheNear(t) THEN B ELSE << >>)|} };
    { name = "only the first of several replies comes";
      file = rules;
      pattern = {|     ELSE Each(given, step)|};
      replacement = {|     ELSE << step(given[1]) >>|} };
    { name = "replies are not counted";
      file = rules;
      pattern = {|[ outside EXCEPT !.called[cause[2]] = cause[3] ]|};
      replacement = {|outside|} };
    { name = "a call never fails";
      file = rules;
      pattern = {|ELSE CALL_ERR(M, call, reply[2], cause)|};
      replacement = {|ELSE REPLY(M, Null, cause)|} };
    { name = "a call forgets its arguments";
      file = machine;
      pattern = {|Request(m, call, << "call", call, arguments >>)|};
      replacement = {|Request(m, call, << "call", call >>)|} };
    { name = "a host object is updated like a list";
      file = machine;
      pattern = {|Result(m, Boolean(Is(x, "host")))|};
      replacement = {|Result(m, False)|} };
    { name = "an interruption stops nothing";
      file = rules;
      pattern = {|ToEnd(<< "INTERRUPT" >>, "interrupt", Interruption, Interrupted, Shared, << >>)|};
      replacement = {|Transition(<< "INTERRUPT" >>, "interrupt", Interruption, Ended(Interrupted), Shared, << >>)|} };
    { name = "an interruption completes the program";
      file = rules;
      pattern = {|"interrupt", Interruption, Interrupted, Shared|};
      replacement = {|"interrupt", Interruption, Completed, Shared|} };
    { name = "what has ended may be interrupted";
      file = rules;
      pattern = {|IF Interruptions /\ control.at # "end"|};
      replacement = {|IF Interruptions|} };
    { name = "who waits cannot be interrupted";
      file = rules;
      pattern = {|IF Interruptions /\ control.at # "end"|};
      replacement = {|IF Interruptions /\ control.at \in { "script", "exec" }|} } ]

(* Where [part] begins in [text], each time. *)
let occurrences part text =
  let n = String.length part in
  let rec go i found =
    if i + n > String.length text then List.rev found
    else if String.sub text i n = part then go (i + n) (i :: found)
    else go (i + 1) found
  in
  go 0 []

let about part = if part = "" then all else List.filter (fun m -> occurrences part m.name <> []) all

let apply m files =
  match List.assoc_opt m.file files with
  | None -> Error (Printf.sprintf "there is no %s" m.file)
  | Some text -> (
      match occurrences m.pattern text with
      | [ i ] ->
        let after = i + String.length m.pattern in
        let mutated = String.sub text 0 i ^ m.replacement ^ String.sub text after (String.length text - after) in
        Ok ((m.file, mutated) :: List.remove_assoc m.file files)
      | found -> Error (Printf.sprintf "its pattern stands %d times in %s" (List.length found) m.file))
