type t = { name : string; file : string; pattern : string; replacement : string }

let rules = "Dolphin.tla"
let environment = "DolphinEnvironment.tla"
let machine = "DolphinMachine.tla"
let values = "DolphinValues.tla"
let checking = "DolphinChecking.tla"
let abstract = "Abstract.tla"
let refinement = "DolphinRefinement.tla"

(* A mistake in what states are is no mistake in the rules: graphs stay as they are. *)
let types = "no residual has a task that runs"

let all =
  [ { name = "PAR-ERR leaves the siblings running";
      file = rules;
      pattern = {|CutOff(By(s, "PAR-ERR", s.out), Without(rs, j))|};
      replacement = {|By(s, "PAR-ERR", s.out)|} };
    { name = "PAR-ERR lets the siblings go on";
      file = rules;
      pattern = {|    [] IsErr(s) -> PAR_ERR(s, rs, j)|};
      replacement = {|    [] IsErr(s) -> PAR_2(s, rs, j)|} };
    { name = "UNTIL-CUT stops nothing";
      file = rules;
      pattern = {|CutOff(CodeStep("UNTIL-CUT", Labelled("cut", run.deeds), run, Done_), << r.body >>)|};
      replacement = {|CodeStep("UNTIL-CUT", Labelled("cut", run.deeds), run, Done_)|} };
    { name = "a fault of an until's condition stops nothing";
      file = rules;
      pattern = {|UNTIL_ERR(s, << r.body >>)|};
      replacement = {|UNTIL_ERR(s, << >>)|} };
    { name = "DURING-CUT stops nothing";
      file = rules;
      pattern = {|Expired(r.timer), S, Done_, << >>), << r.body >>)|};
      replacement = {|Expired(r.timer), S, Done_, << >>), << >>)|} };
    { name = "a handler that breaks leaves what it did before";
      file = rules;
      pattern = {|result(m, "fault", m.stop[2], Knowing(S, m.sees), Said(m.deeds))|};
      replacement = {|result(m, "fault", m.stop[2], After(S, m), Said(m.deeds))|} };
    { name = "what faulty code said is lost";
      file = rules;
      pattern = {|result(m, "fault", m.stop[2], Knowing(S, m.sees), Said(m.deeds))|};
      replacement = {|result(m, "fault", m.stop[2], Knowing(S, m.sees), << >>)|} };
    { name = "a guard that is false takes effect";
      file = rules;
      pattern = {|    [] ~Truth(run.value) -> << >>|};
      replacement =
        {|    [] ~Truth(run.value) ->
         IF run.deeds = << >> THEN << >> ELSE << Step("CONDITION", "check", Program, run.S, Next_(r), << >>) >>|} };
    { name = "consume takes some of the pairs if not all are there";
      file = machine;
      pattern = {|Append(taken, << k, y >>))
          ELSE << >>|};
      replacement = {|Append(taken, << k, y >>))
          ELSE TakeAll(N, Tail(pairs), taken)|} };
    { name = "consume takes the newest pair";
      file = machine;
      pattern = {|Taken(N, k, x) == IF x = Wildcard THEN Head(N.queue[k]) ELSE x|};
      replacement = {|Taken(N, k, x) == IF x = Wildcard THEN Last(N.queue[k]) ELSE x|} };
    { name = "a pattern takes the newest pair";
      file = machine;
      pattern = {|  IF k \in OrderedKeys THEN N.queue[k]
  ELSE InSomeOrder|};
      replacement = {|  IF k \in OrderedKeys THEN << >> \o [ i \in DOMAIN N.queue[k] |-> N.queue[k][Len(N.queue[k]) + 1 - i] ]
  ELSE InSomeOrder|} };
    { name = "a computed key is the first one";
      file = machine;
      pattern = {|<< << Text(Canonical(Head(xs))), Canonical(xs[2]) >> >>|};
      replacement = {|<< << "x", Canonical(xs[2]) >> >>|} };
    { name = "N is a set";
      file = machine;
      pattern = {|  ELSE [ N EXCEPT !.bag = @ (+) |};
      replacement = {|  ELSE IF BagIn(<< k, x >>, N.bag) THEN N ELSE [ N EXCEPT !.bag = @ (+) |} };
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
      pattern = {|        Asking([ s EXCEPT !.S = run.S, !.deeds = @ \o run.deeds ], EffectsOf(run.deeds))|};
      replacement = {|        s|} };
    { name = "a handler's halt only propagates";
      file = rules;
      pattern = {|        CASE run.is = "halt" -> WATCH_HALT(after(run), run.value)|};
      replacement = {|        CASE run.is = "halt" -> WATCH_PROPAGATE(after(run), s.out[2])|} };
    { name = "allOf runs two branches at a time";
      file = rules;
      pattern = {|run, Next_(AllOf(<< r >>, Without(bs, j)))), r)|};
      replacement = {|run, Next_(Parallel(<< r, AllOf(<< >>, Without(bs, j)) >>))), r)|} };
    { name = "allOf ends with its first branch";
      file = rules;
      pattern = {|ALLOF_2(s, bs) == By(s, "ALLOF-2", Next_(AllOf(<< >>, bs)))|};
      replacement = {|ALLOF_2(s, bs) == By(s, "ALLOF-2", Done_)|} };
    { name = "until is ignored before the first step";
      file = rules;
      pattern = {|    [] r.op = "until" -> << UNTIL_CUT(run, r) >>|};
      replacement = {|    [] r.op = "until" -> IF r.body.op = "ready" THEN << >> ELSE << UNTIL_CUT(run, r) >>|} };
    { name = "what is not assured ends as done";
      file = rules;
      pattern = {|Step("ASSURE-CUT", "cut", Program, S, Err(NotAssured(r)), << >>)|};
      replacement = {|Step("ASSURE-CUT", "cut", Program, S, Done_, << >>)|} };
    { name = "what is not done within its time ends as done";
      file = rules;
      pattern = {|[] r.fails = << >> -> DURING_CUT(S, r)|};
      replacement = {|[] TRUE -> DURING_CUT(S, r)|} };
    { name = "ASSURE-CUT stops nothing";
      file = rules;
      pattern = {|Err(NotAssured(r)), << >>), << r.body >>)|};
      replacement = {|Err(NotAssured(r)), << >>), << >>)|} };
    { name = "what a condition that is not assured did stays";
      file = rules;
      pattern = {|ASSURE_CUT(Knowing(S, run.S.sees), r)|};
      replacement = {|ASSURE_CUT(run.S, r)|} };
    { name = "WITHIN-CUT stops nothing";
      file = rules;
      pattern = {|Err(TooLate(r)), << >>), << r.body >>)|};
      replacement = {|Err(TooLate(r)), << >>), << >>)|} };
    { name = "a round begins without its timers";
      file = rules;
      pattern = {|  IN Entering(By(s, rule, Next_(Repeat(round, [ r EXCEPT !.left = left ]))), round)|};
      replacement = {|  IN By(s, rule, Next_(Repeat(round, [ r EXCEPT !.left = left ])))|} };
    { name = "there is a round more";
      file = rules;
      pattern = {|             left == IF t.rounds = << >> THEN << >> ELSE << t.rounds[1] - 1 >>|};
      replacement = {|             left == t.rounds|} };
    { name = "what the condition of a repeat did stays though it does not hold";
      file = rules;
      pattern = {|ELSE REPEAT_AGAIN(Knowing(S, run.S.sees), r) >>|};
      replacement = {|ELSE REPEAT_AGAIN(run.S, r) >>|} };
    { name = "the condition of a repeat is asked after the last round too";
      file = rules;
      pattern = {|Repeat(r, again) == IF again.left = << 0 >> THEN r ELSE|};
      replacement = {|Repeat(r, again) == IF again.left = << 0 >> /\ again.until = << >> THEN r ELSE|} };
    { name = "the timer of a during outlives its task";
      file = rules;
      pattern = {|DURING_2(s, r) == Asking(By(s, "DURING-2", Done_), |};
      replacement =
        {|DURING_2(s, r) == Asking(By(s, "DURING-2", Next_([ op |-> "idle", timer |-> 0, time |-> Integer(1) ])), |} };
    { name = "what the code of a during does is lost";
      file = rules;
      pattern = {|"set-time(" \o ShortText(n) \o ")", run, Next_(started))|};
      replacement = {|"set-time(" \o ShortText(n) \o ")", [ run EXCEPT !.S = Shared ], Next_(started))|} };
    { name = "SEQ-2 skips a part";
      file = rules;
      pattern = {|LET r == Act(OfParts(ts)) IN|};
      replacement = {|LET r == Act(OfParts(IF Len(ts) > 1 THEN Tail(ts) ELSE ts)) IN|} };
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
      pattern = {|[ asking EXCEPT !.S.A = << >>, !.S.B = << >> ]|};
      replacement = {|[ asking EXCEPT !.S.A = << >> ]|} };
    { name = "pick takes the first vehicles only";
      file = rules;
      pattern = {|       [] OTHER -> Each(Choices(q.count, V), LAMBDA chosen : PICK_BIND(M, chosen, Program))|};
      replacement = {|       [] OTHER -> << PICK_BIND(M, Choices(q.count, V)[1], Program) >>|} };
    { name = "branches of | may share vehicles";
      file = rules;
      pattern = {|           \A i \in 1 .. n - 1 : << i, n >> \in exclusive => f[i] # f[n] }|};
      replacement = {|           TRUE }|} };
    { name = "an assertion that fails is an error";
      file = rules;
      pattern = {|IF run.value.assertion THEN ASSERT_ERR(broken, run.value) ELSE WithFault(r, broken)|};
      replacement = {|WithFault(r, broken)|} };
    { name = "failures are not counted";
      file = environment;
      pattern = {|[ heard EXCEPT !.failed = @ + 1 ]|};
      replacement = {|heard|} };
    { name = "losses are not counted";
      file = environment;
      pattern = {|, !.losses = IF Losses = -1 THEN @ ELSE @ + 1 ]|};
      replacement = {| ]|} };
    { name = "a lost vehicle can be lost no more";
      file = environment;
      pattern = {|MayBeLost(v) == v \in outside.lost \/ |};
      replacement = {|MayBeLost(v) == |} };
    { name = "a lost vehicle stays lost whatever it does";
      file = environment;
      pattern = {|heard == [ outside EXCEPT !.lost = @ \ { v } ]|};
      replacement = {|heard == outside|} };
    { name = "a lost vehicle is there when it is looked for";
      file = environment;
      pattern = {|LAMBDA v : v \in outside.lost)|};
      replacement = {|LAMBDA v : FALSE)|} };
    { name = "a pick of others finds the lost";
      file = environment;
      pattern = {|!.lost = @ \ (Range(t.S.B) \ Range(B))|};
      replacement = {|!.lost = @ \ Range(t.S.B)|} };
    { name = "who was late is not remembered";
      file = environment;
      pattern = {|IF Latecomers = -1 THEN @ ELSE @ \cup LateIn(a) ]|};
      replacement = {|@ ]|} };
    { name = "the late come in the order of the fleet";
      file = environment;
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
      pattern = {|Placings(S.sees, IF DependsOnPlaces(t) THEN B ELSE << >>)|};
      replacement = {|Placings(NothingSeen, IF DependsOnPlaces(t) THEN B ELSE << >>)|} };
    { name = "only the first of several replies comes";
      file = environment;
      pattern = {|     ELSE Each(given, on)|};
      replacement = {|     ELSE << on(given[1]) >>|} };
    { name = "replies are not counted";
      file = environment;
      pattern = {|[ outside EXCEPT !.called[call] = n ]|};
      replacement = {|outside|} };
    { name = "a call never fails";
      file = environment;
      pattern = {|ELSE CALL_ERR(M, call, reply[2]),|};
      replacement = {|ELSE REPLY(M, Null),|} };
    { name = "a call forgets its arguments";
      file = machine;
      pattern = {|Request(m, call, << "call", call, arguments >>)|};
      replacement = {|Request(m, call, << "call", call >>)|} };
    { name = "a host object is updated like a list";
      file = machine;
      pattern = {|Result(m, Boolean(Is(x, "host")))|};
      replacement = {|Result(m, False)|} };
    { name = "an input posts nothing";
      file = rules;
      pattern = {|               [ Shared EXCEPT !.N = Post(@, k, x) ], << >>)|};
      replacement = {|               Shared, << >>)|} };
    { name = "an input goes on with the script";
      file = rules;
      pattern = {|Posted(k, x, isCertain), kappa,|};
      replacement = {|Posted(k, x, isCertain), IF kappa.at = "wait" THEN Script(GoOn(kappa.M, Null)) ELSE kappa,|} };
    { name = "an input comes again and again";
      file = environment;
      pattern = {|      after == [ outside EXCEPT !.sent[i] = @ + 1 ]|};
      replacement = {|      after == [ outside EXCEPT !.sent[i] = (@ + 1) % input.times ]|} };
    { name = "nobody posts while the script runs";
      file = environment;
      pattern = {|IF kappa.at = "end" THEN << >> ELSE InputTransitions|};
      replacement = {|IF kappa.at \in { "end", "script" } THEN << >> ELSE InputTransitions|} };
    { name = "the first input comes again";
      file = environment;
      pattern = {|Each(ThisTime(input.rounds, outside.sent[i])|};
      replacement = {|Each(ThisTime(input.rounds, 0)|} };
    { name = "each input is certain";
      file = environment;
      pattern = {|(event[1] = "input" => event[4])|};
      replacement = {|TRUE|} };
    { name = "an interruption stops nothing";
      file = rules;
      pattern =
        {|  EndedBy(Step("INTERRUPT", "interrupt", Interruption, Shared, Ends(Interrupted), << >>), TimersOf(kappa))|};
      replacement = {|  Transition("INTERRUPT", "interrupt", Interruption, Ended(Interrupted), Shared, << >>)|} };
    { name = "an interruption completes the program";
      file = rules;
      pattern = {|Interruption, Shared, Ends(Interrupted)|};
      replacement = {|Interruption, Shared, Ends(Completed)|} };
    { name = "what has ended may be interrupted";
      file = environment;
      pattern = {|IF Interruptions /\ kappa.at # "end"|};
      replacement = {|IF Interruptions|} };
    { name = "who waits cannot be interrupted";
      file = environment;
      pattern = {|IF Interruptions /\ kappa.at # "end"|};
      replacement = {|IF Interruptions /\ kappa.at \in { "script", "exec" }|} };
    { name = "a timer is not set when its task's turn comes";
      file = rules;
      pattern = {|Entering(s, r) == Asking(s, SetTimers(Timers(r)))|};
      replacement = {|Entering(s, r) == s|} };
    { name = "EXECUTE sets no timers";
      file = rules;
      pattern = {|Executing(Machine(m), active), S, SetTimers(Timers(active)))|};
      replacement = {|Executing(Machine(m), active), S, << >>)|} };
    { name = "timers are set for the shortest time";
      file = rules;
      pattern = {|<< "set timer", timer.i, timer.time >>|};
      replacement = {|<< "set timer", timer.i, Integer(0) >>|} };
    { name = "what is cut off leaves its timers running";
      file = rules;
      pattern = {|  CancelTimers(Flatten(Each(rs, Timers))) \o Each|};
      replacement = {|  Each|} };
    { name = "what is cut off leaves its vehicles running";
      file = rules;
      pattern = {|\o Each(Flatten(Each(rs, Running)), LAMBDA v : << "stop", v >>)|};
      replacement = {|\o << >>|} };
    { name = "of a during only the body's timers are cancelled";
      file = rules;
      pattern = {|THEN << [ i |-> r.timer, time |-> r.time ] >> \o Timers(r.body) ELSE|};
      replacement = {|THEN Timers(r.body) ELSE|} };
    { name = "a during that ends in time leaves its timer running";
      file = rules;
      pattern = {|Asking(By(s, "DURING-2", Done_), << << "cancel timer", r.timer >> >>)|};
      replacement = {|By(s, "DURING-2", Done_)|} };
    { name = "a during whose body fails leaves its timer running";
      file = rules;
      pattern = {|IF r.started THEN << << "cancel timer", r.timer >> >> ELSE << >>)|};
      replacement = {|<< >>)|} };
    { name = "messages are said to nobody";
      file = rules;
      pattern = {|  CASE d.did = "message" -> << << "say", d.text >> >>|};
      replacement = {|  CASE d.did = "message" -> << >>|} };
    { name = "a connection timeout is for all vehicles";
      file = rules;
      pattern = {|<< << "connection timeout", d.vehicles, d.time >> >>|};
      replacement = {|<< << "connection timeout", << >>, d.time >> >>|} };
    { name = "what a handler says is said before what it handles";
      file = rules;
      pattern = {|Asking([ s EXCEPT !.S = run.S, !.deeds = @ \o run.deeds ], EffectsOf(run.deeds))|};
      replacement = {|[ s EXCEPT !.S = run.S, !.deeds = @ \o run.deeds, !.effects = EffectsOf(run.deeds) \o @ ]|} };
    { name = "a task is started on the vehicle bound first";
      file = rules;
      pattern = {|<< << "start", r.v, r.p >> >>)|};
      replacement = {|<< << "start", B[1], r.p >> >>)|} };
    { name = "a pick that is met leaves its timer running";
      file = rules;
      pattern = {|(IF event = Program THEN << << "cancel timer", ScriptTimer >> >> ELSE << >>) \o|};
      replacement = {|<< >> \o|} };
    { name = "a pick of all cancels the timer that expired";
      file = rules;
      pattern = {|(IF event = Program THEN << << "cancel timer", ScriptTimer >> >> ELSE << >>) \o|};
      replacement = {|<< << "cancel timer", ScriptTimer >> >> \o|} };
    { name = "nobody is looked for";
      file = rules;
      pattern = {|m, S, << << "look for", q >> >>)|};
      replacement = {|m, S, << >>)|} };
    { name = "nobody is asked";
      file = rules;
      pattern = {|m, S, << << "ask", x >> >>)|};
      replacement = {|m, S, << >>)|} };
    { name = "a pause has no timer";
      file = rules;
      pattern = {|m, S, << << "set timer", ScriptTimer, n >> >>)|};
      replacement = {|m, S, << >>)|} };
    { name = "nobody is called";
      file = rules;
      pattern = {|m, S, << << "call", call, arguments >> >>)|};
      replacement = {|m, S, << >>)|} };
    { name = "the end cancels no timers";
      file = rules;
      pattern = {|Asking(s, running \o stops|};
      replacement = {|Asking(s, stops|} };
    { name = "a vehicle set is taken in its own order only";
      file = machine;
      pattern = {|BagIn(<< k, Normal(x) >>, N.bag)|};
      replacement = {|BagIn(<< k, x >>, N.bag)|} };
    { name = "a queue's values are taken in their own order only";
      file = machine;
      pattern = {|Normal(x) \in Range(Each(N.queue[k], Normal))|};
      replacement = {|x \in Range(N.queue[k])|} };
    { name = "the end cancels timers twice";
      file = rules;
      pattern = {|LET running == SelectSeq(CancelTimers(timers), LAMBDA cancel : cancel \notin Range(s.effects))|};
      replacement = {|LET running == CancelTimers(timers)|} };
    { name = "the end stops all that are bound";
      file = rules;
      pattern = {|SelectSeq(s.S.B, LAMBDA v : v \in DOMAIN s.S.A)|};
      replacement = {|s.S.B|} };
    { name = "the end tells of no release";
      file = rules;
      pattern = {|IF s.S.B = << >> THEN << >> ELSE << << "release", s.S.B >> >>|};
      replacement = {|<< >>|} };
    { name = "an interruption leaves the script's timer running";
      file = rules;
      pattern = {|kappa.request[1] \in { "pick", "pause" } ->|};
      replacement = {|kappa.request[1] \in { "pick" } ->|} };
    { name = "a code's fault leads to no error of the branches";
      file = rules;
      pattern = {|    [] r.op = "allOf" -> ALLOF_ERR(s)|};
      replacement = {|    [] r.op = "allOf" -> [ ALLOF_ERR(s) EXCEPT !.out = Done_ ]|} };
    { name = "the end of a task is taken by all";
      file = rules;
      pattern = {|e[1] \in { "done", "failed" } /\ e[2] = r.v,|};
      replacement = {|e[1] \in { "done", "failed" },|} };
    { name = "timers expire one for another";
      file = rules;
      pattern = {|LAMBDA e : e = Expired(r.timer),|};
      replacement = {|LAMBDA e : e[1] = "expired",|} };
    { name = "a refused answer is no answer";
      file = environment;
      pattern = {|        IF times + 1 < Len(rounds) THEN AnswerTransitions(M, prompt, times + 1)
        ELSE |};
      replacement = {|        |} };
    { name = "questions are not counted";
      file = environment;
      pattern = {|[ outside EXCEPT !.asked[prompt] = n ]|};
      replacement = {|outside|} };
    { name = "what must fail may be done";
      file = environment;
      pattern = {|IF fails THEN << >> ELSE << Done(v) >>|};
      replacement = {|<< Done(v) >>|} };
    { name = "there is no end to the failures";
      file = environment;
      pattern = {|mayFail == MayFail(v) /\ (Failures = -1 \/ outside.failed < Failures)|};
      replacement = {|mayFail == MayFail(v)|} };
    { name = "who is released is not told";
      file = rules;
      pattern = {|<< << "release", d.vehicles >> >>|};
      replacement = {|<< >>|} };
    { name = "a transition that changes nothing is no step";
      file = checking;
      pattern = {|again' = (vars' = vars /\ ~again)|};
      replacement = {|again' = FALSE|} };
    { name = "an interruption is owed";
      file = checking;
      pattern = {|HasEnded \/ Possible(IsOwed)|};
      replacement = {|HasEnded \/ Possible(IsAny)|} };
    { name = "answers and replies need not come";
      file = checking;
      pattern = {|  /\ Fair(IsOwed)
|};
      replacement = "" };
    { name = "abstract: what is not bound starts";
      file = abstract;
      pattern = {|Start(v, p) == ~over /\ v \in Idle|};
      replacement = {|Start(v, p) == ~over /\ v \notin DOMAIN A|} };
    { name = "abstract: a vehicle that runs is given another task";
      file = abstract;
      pattern = {|Start(v, p) == ~over /\ v \in Idle /\ A' = A @@ (v :> p)|};
      replacement = {|Start(v, p) == ~over /\ v \in B /\ A' = (v :> p) @@ A|} };
    { name = "abstract: what runs is released";
      file = abstract;
      pattern = {|Release(v) == ~over /\ v \in Idle|};
      replacement = {|Release(v) == ~over /\ v \in B|} };
    { name = "abstract: the end holds vehicles";
      file = abstract;
      pattern = {|Finish == ~over /\ B = { }|};
      replacement = {|Finish == ~over /\ A = << >>|} };
    { name = "abstract: something is posted after the end";
      file = abstract;
      pattern = {|Post(x) == ~over /\ N' = N (+) SetToBag({ x })|};
      replacement = {|Post(x) == N' = N (+) SetToBag({ x })|} };
    { name = "abstract: a pair is taken twice";
      file = abstract;
      pattern = {|N' = N (-) SetToBag({ x }) /\|};
      replacement = {|N' = N (-) (SetToBag({ x }) (+) SetToBag({ x })) /\|} };
    { name = "refinement: what stops is not told";
      file = refinement;
      pattern = {|CASE e[1] \in { "start", "stop" } -> << e >>|};
      replacement = {|CASE e[1] = "start" -> << e >>|} };
    { name = "refinement: only the first of several vehicles is released";
      file = refinement;
      pattern = {|e[1] \in { "bind", "release" } -> Each(e[2], LAMBDA v : << e[1], v >>)|};
      replacement = {|e[1] \in { "bind", "release" } -> << << e[1], e[2][1] >> >>|} };
    { name = "refinement: what is consumed is not told";
      file = refinement;
      pattern = {|IF d.did \in { "post", "consume" }|};
      replacement = {|IF d.did = "post"|} };
    { name = types;
      file = rules;
      pattern = {|active /\ r.v \in DOMAIN A /\ A[r.v] = r.p|};
      replacement = {|FALSE|} } ]

(* Where [part] begins in [text], each time. *)
let occurrences part text =
  let n = String.length part in
  let rec go i found =
    if i + n > String.length text then List.rev found
    else if String.sub text i n = part then go (i + n) (i :: found)
    else go (i + 1) found
  in
  go 0 []

let is_of_checking m = m.file = checking
let is_of_abstract m = m.file = abstract
let is_of_refinement m = m.file = refinement || m.name = types
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
