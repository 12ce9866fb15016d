-------------------------------- MODULE Dolphin --------------------------------
(* The semantics of Dolphin, to be read next to docs/semantics.md: one operator   *)
(* for each inference rule, under the rule's name (PAR_ERR is [PAR-ERR]).         *)
(*                                                                                *)
(* Letters as there: v, V vehicles; p a platform task; t a task; r a residual;    *)
(* k, x a pair of N; g a guard; i a timer; m a message; M the script's machine;   *)
(* S the shared part <store, A, B, N>, with what sensors have shown in the step;  *)
(* l a label. Its kappa and sigma are the variables control and store.            *)
(*                                                                                *)
(* Steps(S, r) is the steps of a residual, Transitions those of a configuration:  *)
(* sequences, the leftmost first. A step of a residual is a sequence of what it   *)
(* may be, as sensors show this or that; mostly of one. Each of these is a        *)
(* record:                                                                        *)
(*                                                                                *)
(*   rules  the derivation, the axiom first                                       *)
(*   label  what an observer sees, as text                                        *)
(*   cause  what it answers: <<"program">>, or an event <<"task", v>> ...         *)
(*   S      the shared part after it                                              *)
(*   out    <<"next", r>>, <<"ok">>, <<"err", fault>>, or <<"ends", ending>> if   *)
(*          the whole program ends, whatever is around                            *)
(*   deeds  what its code did, handlers included                                  *)
(*                                                                                *)
(* Effects are in docs/semantics.md only: they follow from the step, and nothing  *)
(* here depends on them.                                                          *)
EXTENDS DolphinMachine

CONSTANTS
  Main,          \* the closure of the whole program
  Ending(_, _),  \* how plan p may end on vehicle v: "succeeds", "may fail" or "fails"
  Failures,      \* how many of the failures that need not be there may be in one run; -1: any number
  Losses,        \* how often connections may be lost in one run; -1: any number
  Latecomers,    \* how many vehicles of one run may be late, or missing, when they are looked for; -1: any number
  MayBeLate,     \* which ones those may be
  Answers(_),    \* to a prompt: for the first time it is asked, the second ..., the answers that may be given; the last
                 \* item is for all later times
  Prompts,       \* the prompts whose answers depend on how often they were asked
  HostReplies(_, _), \* to a call, made at this place: likewise what the host may reply, <<"value", y>>, or why it
                 \* fails, <<"failure", m>>
  Calls,         \* the calls whose replies depend on how often they were made
  Interruptions  \* whether the program may be interrupted

(* Known(vars) is Transitions. It is for whoever asks several times, and a constant, for which a configuration puts
   ComputedOnce. *)
CONSTANT Known(_)

VARIABLES
  control,  \* kappa: what runs
  store,    \* sigma: the values of the global variables, << >> for those that have none yet
  A,        \* the allocation: which platform task each vehicle runs, for those that run one
  B,        \* the bound vehicles, in the order in which they were picked
  N,        \* the tuple space
  outside   \* what the environment remembers: failures and losses so far, who is lost, who was late, how often it was asked
            \* and called

vars == << control, store, A, B, N, outside >>

Shared == [ store |-> store, A |-> A, B |-> B, N |-> N, sees |-> NothingSeen ]

(* kappa *)
Script(M) == [ at |-> "script", M |-> M ]
Waiting(M, request) == [ at |-> "wait", M |-> M, request |-> request ]
Executing(M, r) == [ at |-> "exec", M |-> M, r |-> r ]
Ended(ending) == [ at |-> "end", ending |-> ending ]

Completed == [ how |-> "completed", why |-> "", message |-> "", site |-> 0 ]
Halted(m) == [ how |-> "halted", why |-> "", message |-> m, site |-> 0 ]
FailedFor(why, fault) == [ how |-> "failed", why |-> why, message |-> fault.message, site |-> fault.at ]
Failed(fault) == FailedFor(IF fault.assertion THEN "assertion" ELSE "error", fault)
Interrupted == [ how |-> "interrupted", why |-> "", message |-> "", site |-> 0 ]

-----------------------------------------------------------------------------
(* {1 Residuals} *)

(* r >> ts: it leans to the right. *)
SeqOf(r, ts) ==
  IF r.op = "seq" THEN [ op |-> "seq", first |-> r.first, rest |-> r.rest \o ts ]
  ELSE [ op |-> "seq", first |-> r, rest |-> ts ]

Parts(r) == IF r.op = "seq" THEN << r.first >> \o r.rest ELSE << r >>
FromParts(rs) == IF Len(rs) = 1 THEN rs[1] ELSE [ op |-> "seq", first |-> rs[1], rest |-> Tail(rs) ]

(* r1 | .. | rn: it is flat. *)
ParOf(rs) ==
  LET flat == Flatten(Each(rs, LAMBDA r : IF r.op = "par" THEN r.branches ELSE << r >>))
  IN IF Len(flat) = 1 THEN flat[1] ELSE [ op |-> "par", branches |-> flat ]

(* allOf(r; bs) and allOf(bs): of one branch it is a oneOf. *)
AllOf(runs, choices) ==
  CASE choices = << >> -> runs[1]
    [] runs = << >> /\ Len(choices) = 1 -> [ op |-> "oneOf", choices |-> choices ]
    [] OTHER -> [ op |-> "allOf", runs |-> runs, choices |-> choices ]

(* act(r): r when its turn has come; its timers start. *)
RECURSIVE Act(_)
Act(r) ==
  CASE r.op = "seq" -> [ r EXCEPT !.first = Act(@) ]
    [] r.op = "par" -> [ r EXCEPT !.branches = Each(@, Act) ]
    [] r.op = "allOf" -> [ r EXCEPT !.runs = Each(@, Act) ]
    [] r.op \in { "until", "watch" } -> [ r EXCEPT !.body = Act(@) ]
    [] r.op = "during" -> IF Is(r.time, "closure") THEN r ELSE [ r EXCEPT !.started = TRUE, !.body = Act(@) ]
    [] OTHER -> r

(* run(r): the vehicles that run in the active part of r. *)
RECURSIVE Running(_)
Running(r) ==
  CASE r.op = "running" -> << r.v >>
    [] r.op = "seq" -> Running(r.first)
    [] r.op = "par" -> Flatten(Each(r.branches, Running))
    [] r.op = "allOf" -> Flatten(Each(r.runs, Running))
    [] r.op \in { "until", "watch" } -> Running(r.body)
    [] r.op = "during" -> IF r.started THEN Running(r.body) ELSE << >>
    [] OTHER -> << >>

(* S without A(run(r)): what is cut off stops. *)
WithoutA(S, V) == [ S EXCEPT !.A = [ v \in DOMAIN @ \ V |-> @[v] ] ]
Cut(S, r) == WithoutA(S, Range(Running(r)))

-----------------------------------------------------------------------------
(* {1 Labels} *)

PairText(pair) == pair[1] \o ":" \o Literal(pair[2])
PairsText(pairs) == Join(Each(pairs, PairText), ", ")

DeedText(d) ==
  CASE d.did = "post" -> "post " \o PairsText(d.pairs)
    [] d.did = "consume" -> "consume " \o PairsText(d.pairs)
    [] d.did = "message" -> "message " \o Quoted(d.text)
    [] d.did = "release" -> "release " \o Join(d.vehicles, ", ")
    [] d.did = "timeout" ->
         "setConnectionTimeout " \o (IF d.vehicles = << >> THEN "" ELSE Join(d.vehicles[1], ", ") \o ", ")
         \o ShortText(d.time)

Labelled(name, ds) == IF ds = << >> THEN name ELSE name \o "(" \o Join(Each(ds, DeedText), "; ") \o ")"

PickText(q) ==
  (CASE q.all -> "all vehicles" [] q.count = 1 -> "1 vehicle" [] OTHER -> ToString(q.count) \o " vehicles")
  \o (IF q.id = << >> THEN "" ELSE " with id '" \o q.id[1] \o "'")
  \o (IF q.type = << >> THEN "" ELSE " of type '" \o q.type[1] \o "'")
  \o (IF q.payload = << >> THEN "" ELSE " with payload " \o Join(q.payload, ", "))
  \o (IF q.region = << >> THEN "" ELSE " in region " \o Text(q.region[1]))

-----------------------------------------------------------------------------
(* {1 Steps of residuals} *)

Step(rule, label, cause, S, out, deeds) ==
  [ rules |-> << rule >>, label |-> label, cause |-> cause, S |-> S, out |-> out, deeds |-> deeds ]

Program == << "program" >>

(* What the step s of a part is for the whole around it: by one more rule, the outcome out. *)
By(s, rule, out) == [ s EXCEPT !.rules = Append(@, rule), !.out = out ]

Next_(r) == << "next", r >>
Done_ == << "ok" >>
Err(fault) == << "err", fault >>
Ends(ending) == << "ends", ending >>

GoesOn(s) == s.out[1] = "next"
IsDone(s) == s.out[1] = "ok"
IsErr(s) == s.out[1] = "err"

(* S |- g => x, S', ds: the code g with these arguments, as often as its outcome may be another one by what sensors show.
   A fault leaves no effect. What was seen stays so for the rest of the step. *)
After(S, m) == [ S EXCEPT !.store = m.store, !.N = m.N, !.sees = m.sees ]
Knowing(S, sees) == [ S EXCEPT !.sees = sees ]

(* The step is over: what sensors show is from now on what they have shown. *)
Over(S) == IF HasReadings THEN [ S EXCEPT !.store = KeptInStore(@) ] ELSE S

Endless == "this code does not come to an end, and code inside of a task is atomic"

RunCode(S, mode, closure, arguments) ==
  LET result(m, is, value, after, deeds) ==
        [ is |-> is, value |-> value, verdict |-> m.verdict, S |-> after, deeds |-> deeds ]
      of(m) ==
        CASE m.stop[1] = "finished" -> result(m, "value", m.stop[2], After(S, m), m.deeds)
          [] m.stop[1] = "halted" -> result(m, "halt", m.stop[2], After(S, m), m.deeds)
          [] m.stop[1] = "faulted" -> result(m, "fault", m.stop[2], Knowing(S, m.sees), << >>)
          [] m.stop[1] = "exhausted" -> result(m, "fault", Fault(Endless, -closure[2]), Knowing(S, m.sees), << >>)
  IN Each(Run(Call(closure, arguments), S, mode, AtomicFuel), of)

(* No watch handles an assertion that fails, nor halt. *)
ASSERT_ERR(S, fault) == Step("ASSERT-ERR", "broken(" \o fault.message \o ")", Program, S, Ends(Failed(fault)), << >>)
HaltLabel(m) == IF m = "" THEN "halt" ELSE "halt(" \o m \o ")"
HALT_CODE(run) == Step("HALT", HaltLabel(run.value), Program, run.S, Ends(Halted(run.value)), run.deeds)

Broken(rule, S, fault) == Step(rule, "broken(" \o fault.message \o ")", Program, S, Err(fault), << >>)

(* {2 Platform tasks} *)

START(S, r) == Step("START", "start(" \o r.v \o ", " \o r.p.name \o ")", Program,
                    [ S EXCEPT !.A = (r.v :> r.p) @@ @ ], Next_([ r EXCEPT !.op = "running" ]), << >>)

DONE(S, r) == Step("DONE", "done(" \o r.v \o ", " \o r.p.name \o ")", << "task", r.v, "done" >>,
                   WithoutA(S, { r.v }), Done_, << >>)

FAIL(S, r, m) ==
  LET fault == Fault(r.p.name \o " failed on " \o r.v \o ": " \o m, r.p.at)
  IN Step("FAIL", "fail(" \o r.v \o ", " \o r.p.name \o ", " \o m \o ")", << "task", r.v, "failed" >>,
          WithoutA(S, { r.v }), Err(fault), << >>)

(* {2 Code} *)

ACTION_(run) == Step("ACTION", Labelled("act", run.deeds), Program, run.S, Done_, run.deeds)
ACTION_ERR(S, fault) == Broken("ACTION-ERR", S, fault)

CONDITION(run) == Step("CONDITION", Labelled("check", run.deeds), Program, run.S, Done_, run.deeds)
CONDITION_ERR(S, fault) == Broken("CONDITION-ERR", S, fault)

(* {2 One after the other} *)

SEQ_1(s, ts) == By(s, "SEQ-1", Next_(SeqOf(s.out[2], ts)))
SEQ_2(s, ts) == By(s, "SEQ-2", Next_(Act(FromParts(ts))))
SEQ_ERR(s) == By(s, "SEQ-ERR", s.out)

InSeq(s, ts) ==
  CASE GoesOn(s) -> SEQ_1(s, ts)
    [] IsDone(s) -> SEQ_2(s, ts)
    [] IsErr(s) -> SEQ_ERR(s)
    [] OTHER -> s

(* {2 Side by side} *)

PAR_1(s, rs, j) == By(s, "PAR-1", Next_(ParOf(With(rs, j, s.out[2]))))
PAR_2(s, rs, j) == By(s, "PAR-2", Next_(ParOf(Without(rs, j))))
PAR_ERR(s, rs, j) ==
  By([ s EXCEPT !.S = WithoutA(@, Range(Flatten(Each(Without(rs, j), Running)))) ], "PAR-ERR", s.out)

InPar(s, rs, j) ==
  CASE GoesOn(s) -> PAR_1(s, rs, j)
    [] IsDone(s) -> PAR_2(s, rs, j)
    [] IsErr(s) -> PAR_ERR(s, rs, j)
    [] OTHER -> s

(* {2 Branches with guards} *)

ALLOF_WHEN(run, bs, j) ==
  Step("ALLOF-WHEN", Labelled("check", run.deeds), Program, run.S,
       Next_(AllOf(<< Act(bs[j].body) >>, Without(bs, j))), run.deeds)
ALLOF_1(s, bs) == By(s, "ALLOF-1", Next_(AllOf(<< s.out[2] >>, bs)))
ALLOF_2(s, bs) == By(s, "ALLOF-2", Next_(AllOf(<< >>, bs)))
ALLOF_ERR(s) == By(s, "ALLOF-ERR", s.out)
ALLOF_ERR_WHEN(S, fault) == Broken("ALLOF-ERR", S, fault)

InAllOf(s, bs) ==
  CASE GoesOn(s) -> ALLOF_1(s, bs)
    [] IsDone(s) -> ALLOF_2(s, bs)
    [] IsErr(s) -> ALLOF_ERR(s)
    [] OTHER -> s

ONEOF_WHEN(run, b) ==
  Step("ONEOF-WHEN", Labelled("check", run.deeds), Program, run.S, Next_(Act(b.body)), run.deeds)
ONEOF_ERR(S, fault) == Broken("ONEOF-ERR", S, fault)

(* {2 Until} *)

UNTIL_CUT(run, r) == Step("UNTIL-CUT", Labelled("cut", run.deeds), Program, Cut(run.S, r), Done_, run.deeds)
UNTIL_1(s, g) == By(s, "UNTIL-1", Next_([ op |-> "until", guard |-> g, body |-> s.out[2] ]))
UNTIL_2(s) == By(s, "UNTIL-2", Done_)
UNTIL_ERR(s) == By(s, "UNTIL-ERR", s.out)
UNTIL_ERR_WHEN(S, r, fault) == Broken("UNTIL-ERR", Cut(S, r), fault)

InUntil(s, g) ==
  CASE GoesOn(s) -> UNTIL_1(s, g)
    [] IsDone(s) -> UNTIL_2(s)
    [] IsErr(s) -> UNTIL_ERR(s)
    [] OTHER -> s

(* {2 Time} *)

IDLE_END(S, r) == Step("IDLE-END", "timeout", << "timer", r.timer >>, S, Done_, << >>)

DURING_SET(run, r, n) ==
  Step("DURING-SET", "set-time(" \o ShortText(n) \o ")", Program, run.S,
       Next_([ r EXCEPT !.time = n, !.started = TRUE, !.body = Act(@) ]), run.deeds)
DURING_CUT(S, r) == Step("DURING-CUT", "timeout", << "timer", r.timer >>, Cut(S, r.body), Done_, << >>)
DURING_1(s, r) == By(s, "DURING-1", Next_([ r EXCEPT !.body = s.out[2] ]))
DURING_2(s) == By(s, "DURING-2", Done_)
DURING_ERR(s) == By(s, "DURING-ERR", s.out)
DURING_ERR_SET(S, fault) == Broken("DURING-ERR", S, fault)

InDuring(s, r) ==
  CASE GoesOn(s) -> DURING_1(s, r)
    [] IsDone(s) -> DURING_2(s)
    [] IsErr(s) -> DURING_ERR(s)
    [] OTHER -> s

NoTime(x, g) == Fault("during takes a time of 0 seconds or more, this code gives " \o Text(x), -g[2])

(* {2 Errors} *)

WATCH_1(s, h) == By(s, "WATCH-1", Next_([ op |-> "watch", body |-> s.out[2], handler |-> h ]))
WATCH_2(s) == By(s, "WATCH-2", Done_)
WATCH_IGNORE(s) == By(s, "WATCH-IGNORE", Done_)
WATCH_PROPAGATE(s, fault) == By(s, "WATCH-PROPAGATE", Err(fault))
WATCH_HALT(s, m) == By(s, "WATCH-HALT", Ends(Halted(m)))

(* The handler runs in the step that failed. *)
Handled(s, h) ==
  LET after(run) == [ s EXCEPT !.S = run.S, !.deeds = @ \o run.deeds ]
      by(run) ==
        CASE run.is = "halt" -> WATCH_HALT(after(run), run.value)
          [] run.is = "fault" ->
               IF run.value.assertion THEN By(after(run), "ASSERT-ERR", Ends(Failed(run.value)))
               ELSE WATCH_PROPAGATE(after(run), run.value)
          [] run.verdict = "ignore" -> WATCH_IGNORE(after(run))
          [] OTHER -> WATCH_PROPAGATE(after(run), s.out[2])
  IN Each(RunCode(s.S, "handler", h, << String(s.out[2].message) >>), by)

InWatch(s, h) ==
  CASE GoesOn(s) -> << WATCH_1(s, h) >>
    [] IsDone(s) -> << WATCH_2(s) >>
    [] IsErr(s) -> Handled(s, h)
    [] OTHER -> << s >>

(* {2 All steps of r} *)

(* A platform task that runs ends as the environment lets it. *)
Endings(S, r) ==
  LET ending == Ending(r.v, r.p.name)
      mayFail == ending = "may fail" /\ (Failures = -1 \/ outside.failed < Failures)
      done == << DONE(S, r) >>
      fail == << FAIL(S, r, "failure") >>
  IN CASE ending = "fails" -> fail
       [] mayFail -> done \o fail
       [] OTHER -> done

(* Or the connection is lost for longer than its timeout: that counts as a failure. As long as nothing else was heard of *)
(* the vehicle, it is no further loss.                                                                                   *)
LostConnection(S, r) == [ FAIL(S, r, "connection lost") EXCEPT !.cause = << "task", r.v, "lost" >> ]

MayBeLost(v) == v \in outside.lost \/ Losses = -1 \/ outside.losses < Losses
LossOf(S, r) == IF MayBeLost(r.v) THEN << LostConnection(S, r) >> ELSE << >>

(* The code that r looks at: of an action, a condition, guards, a duration that is not known yet. *)
CodeOf(r) ==
  CASE r.op \in { "action", "condition" } -> << r.code >>
    [] r.op = "oneOf" \/ (r.op = "allOf" /\ r.runs = << >>) -> Each(r.choices, LAMBDA b : b.guard)
    [] r.op = "until" -> << r.guard >>
    [] r.op = "during" /\ ~r.started -> << r.time >>
    [] OTHER -> << >>

(* What r does when its j-th code gave a value; guards that are not true do nothing. *)
WithValue(S, r, j, run) ==
  CASE r.op = "action" -> << ACTION_(run) >>
    [] IsReading(run.value) -> Assert(FALSE, OpenHere(run.value[3], -CodeOf(r)[j][2]))
    [] r.op = "during" ->
         << IF IsTime(run.value) THEN DURING_SET(run, r, Time(run.value))
            ELSE DURING_ERR_SET(Knowing(S, run.S.sees), NoTime(run.value, r.time)) >>
    [] ~Truth(run.value) -> << >>
    [] r.op = "condition" -> << CONDITION(run) >>
    [] r.op = "allOf" -> << ALLOF_WHEN(run, r.choices, j) >>
    [] r.op = "oneOf" -> << ONEOF_WHEN(run, r.choices[j]) >>
    [] r.op = "until" -> << UNTIL_CUT(run, r.body) >>

(* ... when it broke. *)
WithFault(S, r, fault) ==
  CASE r.op = "action" -> ACTION_ERR(S, fault)
    [] r.op = "during" -> DURING_ERR_SET(S, fault)
    [] r.op = "condition" -> CONDITION_ERR(S, fault)
    [] r.op = "allOf" -> ALLOF_ERR_WHEN(S, fault)
    [] r.op = "oneOf" -> ONEOF_ERR(S, fault)
    [] r.op = "until" -> UNTIL_ERR_WHEN(S, r.body, fault)

WithCode(S, r, j, run) ==
  CASE run.is = "value" -> WithValue(S, r, j, run)
    [] run.is = "halt" -> << HALT_CODE(run) >>
    [] run.is = "fault" ->
         << IF run.value.assertion THEN ASSERT_ERR(run.S, run.value) ELSE WithFault(run.S, r, run.value) >>

CodeSteps(S, r) ==
  LET codes == CodeOf(r)
      of(j) == Flatten(Each(RunCode(S, "task", codes[j], << >>), LAMBDA run : WithCode(S, r, j, run)))
  IN IF codes = << >> THEN << >>
     ELSE SelectSeq(<< >> \o [ j \in DOMAIN codes |-> of(j) ], LAMBDA outcomes : outcomes # << >>)

(* A step that does not depend on sensors; steps of a part, in what is around it. Mostly there is one outcome, which TLC
   need not make a function for. *)
Always(s) == << s >>
In(steps, F(_)) == Each(steps, LAMBDA outcomes : IF Len(outcomes) = 1 THEN << F(outcomes[1]) >> ELSE Each(outcomes, F))

RECURSIVE Steps(_, _)
Steps(S, r) ==
  CodeSteps(S, r) \o
  CASE r.op = "ready" -> << Always(START(S, r)) >>
    [] r.op = "running" -> Each(Endings(S, r) \o LossOf(S, r), Always)
    [] r.op = "seq" -> In(Steps(S, r.first), LAMBDA s : InSeq(s, r.rest))
    [] r.op = "par" ->
         Flatten([ j \in DOMAIN r.branches |-> In(Steps(S, r.branches[j]), LAMBDA s : InPar(s, r.branches, j)) ])
    [] r.op = "allOf" /\ r.runs # << >> -> In(Steps(S, r.runs[1]), LAMBDA s : InAllOf(s, r.choices))
    [] r.op = "until" -> In(Steps(S, r.body), LAMBDA s : InUntil(s, r.guard))
    [] r.op = "idle" -> << Always(IDLE_END(S, r)) >>
    [] r.op = "during" /\ r.started ->
         << Always(DURING_CUT(S, r)) >> \o In(Steps(S, r.body), LAMBDA s : InDuring(s, r))
    [] r.op = "watch" ->
         Each(Steps(S, r.body), LAMBDA outcomes : Flatten(Each(outcomes, LAMBDA s : InWatch(s, r.handler))))
    [] OTHER -> << >>

-----------------------------------------------------------------------------
(* {1 Allocation} *)

(* The platform tasks of t from left to right, each with the vehicles that the T[V] around it leave: << >> for all. *)
RECURSIVE Leaves(_, _)
Leaves(t, allowed) ==
  CASE t.op = "platform" -> << [ p |-> t, allowed |-> allowed ] >>
    [] t.op \in { "seq", "par" } -> Leaves(t.left, allowed) \o Leaves(t.right, allowed)
    [] t.op = "on" ->
         Leaves(t.body, << IF allowed = << >> THEN t.vehicles ELSE Intersection(t.vehicles, allowed[1]) >>)
    [] t.op \in { "allOf", "oneOf" } -> Flatten(Each(t.branches, LAMBDA b : Leaves(b.body, allowed)))
    [] t.op \in { "until", "during", "watch" } -> Leaves(t.body, allowed)
    [] OTHER -> << >>

LeafCount(t) == Len(Leaves(t, << >>))

(* The pairs of platform tasks, by number after the n-th, that are in different branches of a |. *)
RECURSIVE Exclusive(_, _)
Exclusive(t, n) ==
  CASE t.op = "seq" -> Exclusive(t.left, n) \cup Exclusive(t.right, n + LeafCount(t.left))
    [] t.op = "par" ->
         LET middle == n + LeafCount(t.left)
             right == middle + LeafCount(t.right)
         IN Exclusive(t.left, n) \cup Exclusive(t.right, middle) \cup ((n + 1 .. middle) \X (middle + 1 .. right))
    [] t.op \in { "allOf", "oneOf" } ->
         UNION { LET before == Flatten(Each(SubSeq(t.branches, 1, j - 1), LAMBDA b : Leaves(b.body, << >>)))
                 IN Exclusive(t.branches[j].body, n + Len(before)) : j \in DOMAIN t.branches }
    [] t.op \in { "on", "until", "during", "watch" } -> Exclusive(t.body, n)
    [] OTHER -> { }

(* What v lacks for p, or nothing. *)
Lack(p, v) ==
  LET missing == SelectSeq(Plans[p.plan].devices, LAMBDA d : ~Carries(VehicleOf(v), << d >>))
  IN CASE ~IsKnown(v) -> << "nothing is known of it" >>
       [] p.plan = 0 -> << >>
       [] Plans[p.plan].vehicles # << >> /\ v \notin Range(Plans[p.plan].vehicles) ->
            << "the plan is for other vehicles" >>
       [] missing # << >> -> << "it lacks " \o Join(missing, ", ") >>
       [] OTHER -> << >>

Permitted(leaf, v) == leaf.allowed = << >> \/ v \in Range(leaf.allowed[1])

(* The places in B of those that can run it. *)
Candidates(leaf) == { j \in DOMAIN B : Permitted(leaf, B[j]) /\ Lack(leaf.p, B[j]) = << >> }

(* How much farther it is from v to where p begins than from the nearest place of a vehicle, in millimetres. *)
Farther(p, v, sees) ==
  IF p.plan = 0 \/ ~IsKnown(v) THEN 0 ELSE Plans[p.plan].farther[FoundAt(VehicleOf(v), sees)]

(* f[n] is the place in B of the vehicle of the n-th platform task. *)
RECURSIVE Feasible(_, _, _)
Feasible(leaves, exclusive, n) ==
  IF n = 0 THEN { << >> }
  ELSE { f \in { Append(f, j) : f \in Feasible(leaves, exclusive, n - 1), j \in Candidates(leaves[n]) } :
           \A i \in 1 .. n - 1 : << i, n >> \in exclusive => f[i] # f[n] }

RECURSIVE Total(_, _, _)
Total(leaves, f, sees) ==
  IF f = << >> THEN 0
  ELSE Farther(leaves[Len(f)].p, B[Last(f)], sees) + Total(leaves, SubSeq(f, 1, Len(f) - 1), sees)

LeastBy(F, Measure(_)) == LET least == Minimum({ Measure(f) : f \in F }) IN { f \in F : Measure(f) = least }

RECURSIVE FirstInPickOrder(_, _)
FirstInPickOrder(F, n) ==
  IF Cardinality(F) = 1 THEN Only(F) ELSE FirstInPickOrder(LeastBy(F, LAMBDA f : f[n]), n + 1)

Best(leaves, F, sees) ==
  FirstInPickOrder(LeastBy(LeastBy(F, LAMBDA f : Cardinality(Range(f))), LAMBDA f : Total(leaves, f, sees)), 1)

(* t with its vehicles, and timers numbered from left to right: after the n-th platform task and the i-th timer. *)
RECURSIVE TimerCount(_)
TimerCount(t) ==
  CASE t.op = "idle" -> 1
    [] t.op = "during" -> 1 + TimerCount(t.body)
    [] t.op \in { "seq", "par" } -> TimerCount(t.left) + TimerCount(t.right)
    [] t.op \in { "allOf", "oneOf" } ->
         LET counts[j \in 0 .. Len(t.branches)] == IF j = 0 THEN 0 ELSE counts[j - 1] + TimerCount(t.branches[j].body)
         IN counts[Len(t.branches)]
    [] t.op \in { "on", "until", "watch" } -> TimerCount(t.body)
    [] OTHER -> 0

RECURSIVE Assigned(_, _, _, _)
Assigned(t, f, n, i) ==
  CASE t.op = "platform" -> [ op |-> "ready", p |-> t, v |-> B[f[n + 1]] ]
    [] t.op = "seq" ->
         SeqOf(Assigned(t.left, f, n, i), Parts(Assigned(t.right, f, n + LeafCount(t.left), i + TimerCount(t.left))))
    [] t.op = "par" ->
         ParOf(<< Assigned(t.left, f, n, i), Assigned(t.right, f, n + LeafCount(t.left), i + TimerCount(t.left)) >>)
    [] t.op = "on" -> Assigned(t.body, f, n, i)
    [] t.op \in { "allOf", "oneOf" } ->
         LET before(j) == [ op |-> "allOf", branches |-> SubSeq(t.branches, 1, j - 1) ]
             branch(j) == [ guard |-> t.branches[j].guard,
                            body |-> Assigned(t.branches[j].body, f, n + LeafCount(before(j)),
                                              i + TimerCount(before(j))) ]
             choices == << >> \o [ j \in DOMAIN t.branches |-> branch(j) ]
         IN IF t.op = "oneOf" THEN [ op |-> "oneOf", choices |-> choices ] ELSE AllOf(<< >>, choices)
    [] t.op = "until" -> [ op |-> "until", guard |-> t.guard, body |-> Assigned(t.body, f, n, i) ]
    [] t.op = "idle" -> [ op |-> "idle", timer |-> i + 1, time |-> t.time ]
    [] t.op = "during" ->
         [ op |-> "during", timer |-> i + 1, time |-> t.time, started |-> FALSE,
           body |-> Assigned(t.body, f, n, i + 1) ]
    [] t.op = "watch" -> [ op |-> "watch", body |-> Assigned(t.body, f, n, i), handler |-> t.handler ]
    [] t.op \in { "action", "condition" } -> t

NoCandidate(leaf) ==
  LET permitted == SelectSeq(B, LAMBDA v : Permitted(leaf, v))
      why(v) == v \o ": " \o Lack(leaf.p, v)[1]
      reason == CASE B = << >> -> "no vehicle is bound to the program: pick one first"
                  [] leaf.allowed = << << >> >> -> "the vehicle set given to it is empty"
                  [] permitted = << >> ->
                       "none of the vehicles given to it is bound to the program: " \o Join(leaf.allowed[1], ", ")
                  [] OTHER -> Join(Each(permitted, why), "; ")
  IN Fault("no vehicle can run task '" \o leaf.p.name \o "': " \o reason, leaf.p.at)

(* As few tasks as can be that cannot all have vehicles. *)
Conflict(leaves, exclusive) ==
  LET numbers == 1 .. Len(leaves)
      ordered(X) == SelectSeq([ n \in numbers |-> n ], LAMBDA n : n \in X)
      excludes(X) == { << i, j >> \in (1 .. Cardinality(X)) \X (1 .. Cardinality(X)) :
                         i < j /\ << ordered(X)[i], ordered(X)[j] >> \in exclusive }
      impossible(X) == Feasible(Each(ordered(X), LAMBDA n : leaves[n]), excludes(X), Cardinality(X)) = { }
      few == LeastBy({ X \in SUBSET numbers : impossible(X) }, Cardinality)
      those == FirstInPickOrder({ ordered(X) : X \in few }, 1)
      competing == SelectSeq([ j \in DOMAIN B |-> j ], LAMBDA j : \E n \in Range(those) : j \in Candidates(leaves[n]))
  IN Fault("tasks " \o Join(Each(those, LAMBDA n : "'" \o leaves[n].p.name \o "'"), ", ")
           \o " run side by side and need different vehicles, but there is only "
           \o Join(Each(competing, LAMBDA j : B[j]), ", "), leaves[those[1]].p.at)

(* Whether it matters to the allocation of t where vehicles are. *)
PrefersTheNear(t) == \E leaf \in Range(Leaves(t, << >>)) : leaf.p.plan # 0

(* alloc(t, B) where vehicles are where they were seen: <<"ok", r>>, or <<"wrong", fault>>. *)
Alloc(t, sees) ==
  LET leaves == Leaves(t, << >>)
      hopeless == SelectSeq(leaves, LAMBDA leaf : Candidates(leaf) = { })
      exclusive == Exclusive(t, 0)
      feasible == Feasible(leaves, exclusive, Len(leaves))
  IN CASE hopeless # << >> -> Bad(NoCandidate(hopeless[1]))
       [] feasible = { } -> Bad(Conflict(leaves, exclusive))
       [] OTHER -> Ok(Assigned(t, Best(leaves, feasible, sees), 0, 0))

-----------------------------------------------------------------------------
(* {1 Transitions of configurations} *)

Transition(rules, label, cause, kappa, S, deeds) ==
  [ rules |-> rules, label |-> label, cause |-> cause, control |-> kappa, S |-> S, deeds |-> deeds, late |-> { } ]

(* Of what a step may be as sensors show this or that, the first of those with the same label and the same result. *)
Different(ts) ==
  LET result(t) == << t.label, t.control, Knowing(t.S, NothingSeen) >>
      isNew(j) == \A i \in 1 .. j - 1 : result(ts[i]) # result(ts[j])
  IN IF Len(ts) < 2 THEN ts ELSE Each(SelectSeq([ j \in DOMAIN ts |-> j ], isNew), LAMBDA j : ts[j])

(* ended(S, e): all stops, all of B is released. *)
ToEnd(rules, label, cause, ending, S, deeds) ==
  Transition(rules, label, cause, Ended(ending), [ S EXCEPT !.A = << >>, !.B = << >> ], deeds)

(* {2 Deeds of the script} *)

(* m is the machine after it ran from M, S the shared part then. *)
DeedOf(m) == m.deeds[1]
DeedStep(rule, m, S) == Transition(<< rule >>, DeedText(DeedOf(m)), Program, Script(Machine(m)), S, m.deeds)

SCRIPT(m, S) == Transition(<< "SCRIPT" >>, "script", Program, Script(Machine(m)), S, << >>)
POST(m, S) == DeedStep("POST", m, S)
CONSUME(m, S) == DeedStep("CONSUME", m, S)
MESSAGE(m, S) == DeedStep("MESSAGE", m, S)
RELEASE(m, S) ==
  LET V == Range(DeedOf(m).vehicles)
  IN DeedStep("RELEASE", m, WithoutA([ S EXCEPT !.B = SelectSeq(@, LAMBDA v : v \notin V) ], V))
SET_TIMEOUT(m, S) == DeedStep("SET-TIMEOUT", m, S)

Deed(m, S) ==
  CASE DeedOf(m).did = "post" -> POST(m, S)
    [] DeedOf(m).did = "consume" -> CONSUME(m, S)
    [] DeedOf(m).did = "message" -> MESSAGE(m, S)
    [] DeedOf(m).did = "release" -> RELEASE(m, S)
    [] DeedOf(m).did = "timeout" -> SET_TIMEOUT(m, S)

(* {2 Waiting begins} *)

WaitStep(rule, label, m, S) ==
  Transition(<< rule >>, label, Program, Waiting(Machine(m), m.stop[2]), S, << >>)

PICK_(m, S, q) == WaitStep("PICK", "pick(" \o PickText(q) \o ")", m, S)
ASK(m, S, x) == WaitStep("ASK", "ask(" \o x \o ")", m, S)
PAUSE(m, S, n) == WaitStep("PAUSE", "pause(" \o ShortText(n) \o ")", m, S)
CALL(m, S, what) == WaitStep("CALL", "call(" \o what \o ")", m, S)

EXECUTE(m, S, r) == Transition(<< "EXECUTE" >>, "execute", Program, Executing(Machine(m), Act(r)), S, << >>)
ALLOC_ERR(S, fault) ==
  ToEnd(<< "ALLOC-ERR" >>, "cannot-execute(" \o fault.message \o ")", Program, FailedFor("vehicles", fault), S, << >>)

ExecuteSteps(m, S, t) ==
  LET step(allocated) == IF IsOk(allocated) THEN EXECUTE(m, S, allocated[2]) ELSE ALLOC_ERR(S, allocated[2])
  IN Each(Placings(S.sees, IF PrefersTheNear(t) THEN B ELSE << >>),
          LAMBDA sees : Only({ step(allocated) : allocated \in { Alloc(t, sees) } }))

Wait(m, S, request) ==
  CASE request[1] = "pick" -> << PICK_(m, S, request[2]) >>
    [] request[1] = "ask" -> << ASK(m, S, request[2]) >>
    [] request[1] = "pause" -> << PAUSE(m, S, request[2]) >>
    [] request[1] = "call" -> << CALL(m, S, request[2]) >>
    [] request[1] = "execute" -> ExecuteSteps(m, S, request[2])

(* {2 Ends} *)

END(S) == ToEnd(<< "END" >>, "end", Program, Completed, S, << >>)
HALT(S, m) == ToEnd(<< "HALT" >>, HaltLabel(m), Program, Halted(m), S, << >>)
FAULT(S, fault) == ToEnd(<< "FAULT" >>, "fault(" \o fault.message \o ")", Program, Failed(fault), S, << >>)
Interruption == << "interruption" >>
INTERRUPT == ToEnd(<< "INTERRUPT" >>, "interrupt", Interruption, Interrupted, Shared, << >>)

ScriptSteps(M) ==
  LET of(m, S) ==
        CASE m.stop[1] = "did" -> << Deed(m, S) >>
          [] m.stop[1] = "waits" -> Wait(m, S, m.stop[2])
          [] m.stop[1] = "finished" -> << END(S) >>
          [] m.stop[1] = "halted" -> << HALT(S, m.stop[2]) >>
          [] m.stop[1] = "faulted" -> << FAULT(S, m.stop[2]) >>
          [] m.stop[1] = "exhausted" -> << SCRIPT(m, S) >>
  IN Different(Flatten(Each(Run(M, Shared, "script", ScriptFuel), LAMBDA m : of(m, Over(After(Shared, m))))))

(* {2 Who is there} *)

(* Wherever it is. *)
Accepts(q, vehicle) ==
  /\ q.id = << >> \/ q.id[1] = vehicle.id
  /\ q.type = << >> \/ q.type[1] = vehicle.type
  /\ Carries(vehicle, q.payload)

IsInRegion(q, vehicle, sees) == q.region = << >> \/ Within(q.region[1], FoundAt(vehicle, sees))

(* All sequences of n elements of xs in their order, the first ones first. *)
RECURSIVE Choices(_, _)
Choices(n, xs) ==
  CASE n = 0 -> << << >> >>
    [] n > Len(xs) -> << >>
    [] OTHER -> Each(Choices(n - 1, Tail(xs)), LAMBDA chosen : << Head(xs) >> \o chosen) \o Choices(n, Tail(xs))

(* An attendance is who comes after all others, in this order, and who is missing. *)
World(a) ==
  LET moved == a.coming \o a.missing
  IN SelectSeq(Fleet, LAMBDA vehicle : vehicle.id \notin Range(moved)) \o Each(moved, VehicleOf)

Subsequences(xs) == Flatten([ n \in 1 .. Len(xs) + 1 |-> Choices(n - 1, xs) ])

(* All sequences of at most n different elements of xs. *)
RECURSIVE Arrangements(_, _)
Arrangements(n, xs) ==
  << << >> >> \o
  IF n = 0 THEN << >>
  ELSE Flatten([ j \in DOMAIN xs |-> Each(Arrangements(n - 1, Without(xs, j)), LAMBDA rest : << xs[j] >> \o rest) ])

(* Whom q looks for, wherever they are. Nothing was heard of the silent ones since they were lost; the unsure may be late. *)
Wanted(q) ==
  Each(SelectSeq(Fleet, LAMBDA vehicle : Accepts(q, vehicle) /\ vehicle.id \notin Range(B)),
       LAMBDA vehicle : vehicle.id)
Silent(q) == SelectSeq(Wanted(q), LAMBDA v : v \in outside.lost)
Unsure(q) == SelectSeq(Wanted(q), LAMBDA v : v \notin outside.lost /\ Latecomers # 0 /\ v \in MayBeLate)

LateIn(a) == (Range(a.coming) \cup Range(a.missing)) \ outside.lost
LateAnew(a) == Cardinality(LateIn(a) \ outside.late)

(* A pick of all waits for its whole time-out: some may come late while others are missing. One of n vehicles goes on with the *)
(* first n, of which up to n were late; or too few come, and then all silent ones are missing, and of the unsure any or, where  *)
(* there is no bound, all. Attendances with fewer vehicles that are late anew come first.                                      *)
Attendances(q) ==
  LET silent == Silent(q)
      unsure == Unsure(q)
      attendance(coming, missing) == [ coming |-> coming, missing |-> missing ]
      ofAll(unheard, absent) ==
        Each(Arrangements(Len(unsure), SelectSeq(unsure, LAMBDA v : v \notin Range(absent))),
             LAMBDA coming : attendance(coming, unheard \o absent))
      all == Flatten(Each(Subsequences(silent), LAMBDA unheard :
                            Flatten(Each(Subsequences(unsure), LAMBDA absent : ofAll(unheard, absent)))))
      some == Each(Arrangements(q.count, unsure), LAMBDA coming : attendance(coming, << >>))
              \o Each(IF Latecomers = -1 THEN << unsure >> ELSE Subsequences(unsure),
                      LAMBDA absent : attendance(<< >>, silent \o absent))
      most == IF Latecomers = -1 THEN Len(unsure) ELSE Latecomers - Cardinality(outside.late)
      byNumber(as) == Flatten([ n \in 1 .. most + 1 |-> SelectSeq(as, LAMBDA a : LateAnew(a) = n - 1) ])
  IN Only({ byNumber(as) : as \in { IF q.all THEN all ELSE some } })

(* {2 Picking vehicles} *)

(* fit(q, w, B), in the order in which they were heard of, where w is the world with attendance a and vehicles where they
   were seen. *)
Fit(q, a, sees) ==
  LET fits(vehicle) == /\ Accepts(q, vehicle)
                       /\ vehicle.id \notin Range(B) \cup Range(a.missing)
                       /\ IsInRegion(q, vehicle, sees)
  IN Each(SelectSeq(World(a), fits), LAMBDA vehicle : vehicle.id)

WhyNot(q, a, sees, vehicle) ==
  vehicle.id \o " " \o
  CASE vehicle.id \in Range(B) -> "is already bound"
    [] vehicle.id \in Range(a.missing) -> "is not connected"
    [] q.id # << >> /\ q.id[1] # vehicle.id -> "has another id"
    [] q.type # << >> /\ q.type[1] # vehicle.type -> "is a " \o vehicle.type
    [] ~Carries(vehicle, q.payload) ->
         "lacks " \o Join(SelectSeq(q.payload, LAMBDA d : ~Carries(vehicle, << d >>)), ", ")
    [] ~IsInRegion(q, vehicle, sees) -> "is at " \o Places[FoundAt(vehicle, sees)] \o ", outside of the region"
    [] OTHER -> "fits"

NoVehicles(q, a, sees) ==
  LET shown == SubSeq(World(a), 1, Clipped(8, 0, Len(Fleet)))
      more == Len(Fleet) - Len(shown)
      there == IF Fleet = << >> THEN "no vehicle was heard of"
               ELSE Join(Each(shown, LAMBDA vehicle : WhyNot(q, a, sees, vehicle)), "; ")
                    \o (IF more > 0 THEN "; and " \o ToString(more) \o " more" ELSE "")
  IN "could not pick " \o PickText(q) \o ": " \o there

PICK_BIND(M, V, cause) ==
  Transition(<< "PICK-BIND" >>, "bind(" \o Join(V, ", ") \o ")", cause, Script(GoOn(M, Vehicles(V))),
             [ Shared EXCEPT !.B = @ \o V ], << >>)
PICK_ERR(M, q, a, sees) ==
  ToEnd(<< "PICK-ERR" >>, "no-vehicles(" \o NoVehicles(q, a, sees) \o ")", << "timer", 0 >>,
        FailedFor("vehicles", Fault(NoVehicles(q, a, sees), M.at)), Shared, << >>)

PickStepsIn(M, q, a, sees) ==
  LET fit == Fit(q, a, sees)
  IN CASE q.all -> << IF fit = << >> THEN PICK_ERR(M, q, a, sees) ELSE PICK_BIND(M, fit, << "timer", 0 >>) >>
       [] Len(fit) < q.count -> << PICK_ERR(M, q, a, sees) >>
       [] OTHER -> Each(Choices(q.count, fit), LAMBDA V : PICK_BIND(M, V, Program))

(* In each world that may be. What comes of several is remembered as of the first: with the fewest that are late anew. *)
PickSteps(M, q) ==
  LET placings == Placings(NothingSeen, IF q.region = << >> THEN << >> ELSE Wanted(q))
      in(a) == Flatten(Each(placings, LAMBDA sees : PickStepsIn(M, q, a, sees)))
      steps(a) == Each(in(a), LAMBDA t : [ t EXCEPT !.late = LateIn(a) ])
      first(ts) == SelectSeq([ j \in DOMAIN ts |-> j ], LAMBDA j : \A i \in 1 .. j - 1 : ts[i].label # ts[j].label)
  IN Only({ Each(first(ts), LAMBDA j : ts[j]) : ts \in { Flatten(Each(Attendances(q), steps)) } })

(* {2 Waiting ends} *)

ANSWER(M, prompt, text, y, cause) ==
  Transition(<< "ANSWER" >>, "answer(" \o text \o ")", cause, Script(Machine(GoOn(M, y))), Shared, << >>)
ANSWER_ERR(M, prompt, m, cause) ==
  ToEnd(<< "ANSWER-ERR" >>, "no-answer", cause,
        Failed(Fault("no answer to '" \o prompt \o "': " \o m, M.at)), Shared, << >>)

RESUME(M) == Transition(<< "RESUME" >>, "resume", << "timer", 0 >>, Script(GoOn(M, Null)), Shared, << >>)

REPLY(M, y, cause) ==
  Transition(<< "REPLY" >>, "reply(" \o Text(y) \o ")", cause, Script(GoOn(M, y)), Shared, << >>)
CALL_ERR(M, call, m, cause) ==
  ToEnd(<< "CALL-ERR" >>, "no-reply(" \o m \o ")", cause, Failed(Fault(call \o ": " \o m, M.at)), Shared, << >>)

Times(prompt) == IF prompt \in Prompts THEN outside.asked[prompt] ELSE 0
TimesCalled(call) == IF call \in Calls THEN outside.called[call] ELSE 0

(* Of rounds, what is answered the first time, the second ..., the one for this time; and how often it was asked then,
   as far as it matters. *)
ThisTime(rounds, times) ==
  IF rounds = << >> THEN << >> ELSE rounds[IF times < Len(rounds) THEN times + 1 ELSE Len(rounds)]
OnceMore(rounds, times) == IF times + 1 < Len(rounds) THEN times + 1 ELSE times

(* An answer is an expression over the program's variables, which may only compute a value. A refused one is asked for
   again, while there are others to come; then it counts as none. *)
RECURSIVE AnswerSteps(_, _, _)
AnswerSteps(M, prompt, times) ==
  LET rounds == Answers(prompt)
      given == ThisTime(rounds, times)
      cause == << "answer", prompt, OnceMore(rounds, times) >>
      refused(m) ==
        IF times + 1 < Len(rounds) THEN AnswerSteps(M, prompt, times + 1) ELSE << ANSWER_ERR(M, prompt, m, cause) >>
      evaluated(answer) == RunCode(Shared, "task", << "closure", answer.lambda, << >> >>, << >>)
      isValue(run) == run.is = "value" /\ run.deeds = << >> /\ run.S.store = store
      by(answer, runs) ==
        CASE \E j \in DOMAIN runs : isValue(runs[j]) ->
               Different(Each(SelectSeq(runs, isValue), LAMBDA run : ANSWER(M, prompt, answer.text, run.value, cause)))
          [] runs[1].is = "fault" -> refused(runs[1].value.message)
          [] OTHER -> refused("an answer may only compute a value")
      step(answer) ==
        IF answer.lambda = 0 THEN refused(answer.why) ELSE Only({ by(answer, runs) : runs \in { evaluated(answer) } })
  IN IF given = << >> THEN << ANSWER_ERR(M, prompt, "none is given", << "answer", prompt, times >>) >>
     ELSE Flatten(Each(given, step))

ReplySteps(M, call, times) ==
  LET rounds == HostReplies(call, M.at)
      given == ThisTime(rounds, times)
      cause == << "host", call, OnceMore(rounds, times) >>
      step(reply) == IF reply[1] = "value" THEN REPLY(M, reply[2], cause) ELSE CALL_ERR(M, call, reply[2], cause)
  IN IF given = << >>
     THEN << CALL_ERR(M, call, "the fleet has no reply " \o Quoted(call), << "host", call, times >>) >>
     ELSE Each(given, step)

WaitSteps(M, request) ==
  CASE request[1] = "pick" -> PickSteps(M, request[2])
    [] request[1] = "ask" -> AnswerSteps(M, request[2], Times(request[2]))
    [] request[1] = "pause" -> << RESUME(M) >>
    [] request[1] = "call" -> ReplySteps(M, request[2], TimesCalled(request[2]))

(* {2 Executing tasks} *)

EXECUTE_DONE(M, s) ==
  Transition(Append(s.rules, "EXECUTE-DONE"), s.label, s.cause, Script(GoOn(M, Null)), s.S, s.deeds)
EXECUTE_ERR(M, s) == ToEnd(Append(s.rules, "EXECUTE-ERR"), s.label, s.cause, Failed(s.out[2]), s.S, s.deeds)

InExecute(M, s) ==
  CASE GoesOn(s) -> Transition(s.rules, s.label, s.cause, Executing(M, s.out[2]), s.S, s.deeds)
    [] IsDone(s) -> EXECUTE_DONE(M, s)
    [] IsErr(s) -> EXECUTE_ERR(M, s)
    [] OTHER -> ToEnd(s.rules, s.label, s.cause, s.out[2], s.S, s.deeds)

-----------------------------------------------------------------------------
(* {1 The whole system} *)

ExecutingSteps(M, r) ==
  LET in(s) == InExecute(M, IF HasReadings THEN [ s EXCEPT !.S = Over(@) ] ELSE s)
      alone(outcomes) == Len(outcomes) = 1
      all(steps) == IF \A j \in DOMAIN steps : alone(steps[j]) THEN Each(steps, LAMBDA outcomes : in(outcomes[1]))
                    ELSE Flatten(Each(steps, LAMBDA outcomes : Different(Each(outcomes, in))))
  IN Only({ all(steps) : steps \in { Steps(Shared, r) } })

Transitions ==
  (CASE control.at = "script" -> ScriptSteps(control.M)
     [] control.at = "wait" -> WaitSteps(control.M, control.request)
     [] control.at = "exec" -> ExecutingSteps(control.M, control.r)
     [] control.at = "end" -> << >>)
  \o (IF Interruptions /\ control.at # "end" THEN << INTERRUPT >> ELSE << >>)

(* To stand for Known: Transitions, computed once for a state, however many actions and properties ask. TLC's register 1 has
   the last ones. If Known were defined as this and no constant, TLC -coverage would lay out all that Transitions applies,
   for each action anew, and come to no end. *)
ASSUME TLCSet(1, << >>)

ComputedOnce(state) ==
  LET last == TLCGet(1)
  IN IF last # << >> /\ last[1] = state THEN last[2]
     ELSE CHOOSE ts \in { Transitions } : TLCSet(1, << state, ts >>)

(* The environment counts failures where their number is bounded, and questions and calls as far as what comes of them
   depends on it. *)
OutsideAfter(cause) ==
  CASE cause[1] = "task" /\ cause[3] = "failed" /\ Failures # -1 /\ Ending(cause[2], A[cause[2]].name) = "may fail" ->
         [ outside EXCEPT !.failed = @ + 1 ]
    [] cause[1] = "answer" /\ cause[2] \in Prompts -> [ outside EXCEPT !.asked[cause[2]] = cause[3] ]
    [] cause[1] = "host" /\ cause[2] \in Calls -> [ outside EXCEPT !.called[cause[2]] = cause[3] ]
    [] OTHER -> outside

(* Of a vehicle whose task ends otherwise than by a loss something was heard, so it was of one that is picked. What has no   *)
(* bound is not counted.                                                                                                    *)
Remembered(t) ==
  LET before == OutsideAfter(t.cause)
      v == t.cause[2]
  IN CASE t.cause[1] = "task" /\ t.cause[3] # "lost" -> [ before EXCEPT !.lost = @ \ { v } ]
       [] t.cause[1] = "task" /\ v \notin outside.lost ->
            [ before EXCEPT !.lost = @ \cup { v }, !.losses = IF Losses = -1 THEN @ ELSE @ + 1 ]
       [] OTHER ->
            [ before EXCEPT !.lost = @ \ (Range(t.S.B) \ Range(B)),
                            !.late = IF Latecomers = -1 THEN @ ELSE @ \cup t.late ]

Becomes(t) ==
  /\ control' = t.control
  /\ store' = t.S.store
  /\ A' = t.S.A
  /\ B' = t.S.B
  /\ N' = t.S.N
  /\ outside' = Remembered(t)

Init ==
  /\ control = Script(Call(Main, << >>))
  /\ store = << >> \o [ i \in DOMAIN GlobalNames |-> << >> ]
  /\ A = << >>
  /\ B = << >>
  /\ N = NoTuples
  /\ outside = [ failed |-> 0, losses |-> 0, lost |-> { }, late |-> { }, asked |-> [ prompt \in Prompts |-> 0 ],
                  called |-> [ call \in Calls |-> 0 ] ]

(* A transition for which Which holds of what it answers. *)
Some(Which(_)) == \E ts \in { Known(vars) } : \E j \in DOMAIN ts : Which(ts[j].cause) /\ Becomes(ts[j])
Possible(Which(_)) == \E ts \in { Known(vars) } : \E j \in DOMAIN ts : Which(ts[j].cause)

IsAny(cause) == TRUE
IsOwed(cause) == cause # Interruption
IsProgram(cause) == cause = Program
IsTimer(cause) == cause[1] = "timer"

Next == Some(IsAny)

(* {2 An action for each rule} *)

(* Those of the transitions ts in whose derivations this rule stands, by number. *)
Taking(rule, ts) == { j \in DOMAIN ts : rule \in Range(ts[j].rules) }

Take_START(ts) == \E j \in Taking("START", ts) : Becomes(ts[j])
Take_DONE(ts) == \E j \in Taking("DONE", ts) : Becomes(ts[j])
Take_FAIL(ts) == \E j \in Taking("FAIL", ts) : Becomes(ts[j])
Take_ACTION(ts) == \E j \in Taking("ACTION", ts) : Becomes(ts[j])
Take_ACTION_ERR(ts) == \E j \in Taking("ACTION-ERR", ts) : Becomes(ts[j])
Take_CONDITION(ts) == \E j \in Taking("CONDITION", ts) : Becomes(ts[j])
Take_CONDITION_ERR(ts) == \E j \in Taking("CONDITION-ERR", ts) : Becomes(ts[j])
Take_ASSERT_ERR(ts) == \E j \in Taking("ASSERT-ERR", ts) : Becomes(ts[j])
Take_SEQ_1(ts) == \E j \in Taking("SEQ-1", ts) : Becomes(ts[j])
Take_SEQ_2(ts) == \E j \in Taking("SEQ-2", ts) : Becomes(ts[j])
Take_SEQ_ERR(ts) == \E j \in Taking("SEQ-ERR", ts) : Becomes(ts[j])
Take_PAR_1(ts) == \E j \in Taking("PAR-1", ts) : Becomes(ts[j])
Take_PAR_2(ts) == \E j \in Taking("PAR-2", ts) : Becomes(ts[j])
Take_PAR_ERR(ts) == \E j \in Taking("PAR-ERR", ts) : Becomes(ts[j])
Take_ALLOF_WHEN(ts) == \E j \in Taking("ALLOF-WHEN", ts) : Becomes(ts[j])
Take_ALLOF_1(ts) == \E j \in Taking("ALLOF-1", ts) : Becomes(ts[j])
Take_ALLOF_2(ts) == \E j \in Taking("ALLOF-2", ts) : Becomes(ts[j])
Take_ALLOF_ERR(ts) == \E j \in Taking("ALLOF-ERR", ts) : Becomes(ts[j])
Take_ONEOF_WHEN(ts) == \E j \in Taking("ONEOF-WHEN", ts) : Becomes(ts[j])
Take_ONEOF_ERR(ts) == \E j \in Taking("ONEOF-ERR", ts) : Becomes(ts[j])
Take_UNTIL_CUT(ts) == \E j \in Taking("UNTIL-CUT", ts) : Becomes(ts[j])
Take_UNTIL_1(ts) == \E j \in Taking("UNTIL-1", ts) : Becomes(ts[j])
Take_UNTIL_2(ts) == \E j \in Taking("UNTIL-2", ts) : Becomes(ts[j])
Take_UNTIL_ERR(ts) == \E j \in Taking("UNTIL-ERR", ts) : Becomes(ts[j])
Take_IDLE_END(ts) == \E j \in Taking("IDLE-END", ts) : Becomes(ts[j])
Take_DURING_SET(ts) == \E j \in Taking("DURING-SET", ts) : Becomes(ts[j])
Take_DURING_CUT(ts) == \E j \in Taking("DURING-CUT", ts) : Becomes(ts[j])
Take_DURING_1(ts) == \E j \in Taking("DURING-1", ts) : Becomes(ts[j])
Take_DURING_2(ts) == \E j \in Taking("DURING-2", ts) : Becomes(ts[j])
Take_DURING_ERR(ts) == \E j \in Taking("DURING-ERR", ts) : Becomes(ts[j])
Take_WATCH_1(ts) == \E j \in Taking("WATCH-1", ts) : Becomes(ts[j])
Take_WATCH_2(ts) == \E j \in Taking("WATCH-2", ts) : Becomes(ts[j])
Take_WATCH_IGNORE(ts) == \E j \in Taking("WATCH-IGNORE", ts) : Becomes(ts[j])
Take_WATCH_PROPAGATE(ts) == \E j \in Taking("WATCH-PROPAGATE", ts) : Becomes(ts[j])
Take_WATCH_HALT(ts) == \E j \in Taking("WATCH-HALT", ts) : Becomes(ts[j])
Take_SCRIPT(ts) == \E j \in Taking("SCRIPT", ts) : Becomes(ts[j])
Take_POST(ts) == \E j \in Taking("POST", ts) : Becomes(ts[j])
Take_CONSUME(ts) == \E j \in Taking("CONSUME", ts) : Becomes(ts[j])
Take_MESSAGE(ts) == \E j \in Taking("MESSAGE", ts) : Becomes(ts[j])
Take_RELEASE(ts) == \E j \in Taking("RELEASE", ts) : Becomes(ts[j])
Take_SET_TIMEOUT(ts) == \E j \in Taking("SET-TIMEOUT", ts) : Becomes(ts[j])
Take_PICK(ts) == \E j \in Taking("PICK", ts) : Becomes(ts[j])
Take_PICK_BIND(ts) == \E j \in Taking("PICK-BIND", ts) : Becomes(ts[j])
Take_PICK_ERR(ts) == \E j \in Taking("PICK-ERR", ts) : Becomes(ts[j])
Take_ASK(ts) == \E j \in Taking("ASK", ts) : Becomes(ts[j])
Take_ANSWER(ts) == \E j \in Taking("ANSWER", ts) : Becomes(ts[j])
Take_ANSWER_ERR(ts) == \E j \in Taking("ANSWER-ERR", ts) : Becomes(ts[j])
Take_PAUSE(ts) == \E j \in Taking("PAUSE", ts) : Becomes(ts[j])
Take_RESUME(ts) == \E j \in Taking("RESUME", ts) : Becomes(ts[j])
Take_CALL(ts) == \E j \in Taking("CALL", ts) : Becomes(ts[j])
Take_REPLY(ts) == \E j \in Taking("REPLY", ts) : Becomes(ts[j])
Take_CALL_ERR(ts) == \E j \in Taking("CALL-ERR", ts) : Becomes(ts[j])
Take_EXECUTE(ts) == \E j \in Taking("EXECUTE", ts) : Becomes(ts[j])
Take_EXECUTE_DONE(ts) == \E j \in Taking("EXECUTE-DONE", ts) : Becomes(ts[j])
Take_EXECUTE_ERR(ts) == \E j \in Taking("EXECUTE-ERR", ts) : Becomes(ts[j])
Take_ALLOC_ERR(ts) == \E j \in Taking("ALLOC-ERR", ts) : Becomes(ts[j])
Take_END(ts) == \E j \in Taking("END", ts) : Becomes(ts[j])
Take_HALT(ts) == \E j \in Taking("HALT", ts) : Becomes(ts[j])
Take_FAULT(ts) == \E j \in Taking("FAULT", ts) : Becomes(ts[j])
Take_INTERRUPT(ts) == \E j \in Taking("INTERRUPT", ts) : Becomes(ts[j])

(* The same as Next. A transition is counted under each rule of its derivation: TLC -coverage shows which rules were used.
   TLC looks through all that a definition without parameters applies before it starts, but once through what a LET names. *)
NextByRule ==
  LET ts == Known(vars) IN
     \/ Take_START(ts) \/ Take_DONE(ts) \/ Take_FAIL(ts) \/ Take_ACTION(ts) \/ Take_ACTION_ERR(ts)
     \/ Take_CONDITION(ts) \/ Take_CONDITION_ERR(ts) \/ Take_ASSERT_ERR(ts) \/ Take_SEQ_1(ts)
     \/ Take_SEQ_2(ts) \/ Take_SEQ_ERR(ts) \/ Take_PAR_1(ts) \/ Take_PAR_2(ts) \/ Take_PAR_ERR(ts)
     \/ Take_ALLOF_WHEN(ts) \/ Take_ALLOF_1(ts) \/ Take_ALLOF_2(ts) \/ Take_ALLOF_ERR(ts)
     \/ Take_ONEOF_WHEN(ts) \/ Take_ONEOF_ERR(ts) \/ Take_UNTIL_CUT(ts) \/ Take_UNTIL_1(ts)
     \/ Take_UNTIL_2(ts) \/ Take_UNTIL_ERR(ts) \/ Take_IDLE_END(ts) \/ Take_DURING_SET(ts)
     \/ Take_DURING_CUT(ts) \/ Take_DURING_1(ts) \/ Take_DURING_2(ts) \/ Take_DURING_ERR(ts)
     \/ Take_WATCH_1(ts) \/ Take_WATCH_2(ts) \/ Take_WATCH_IGNORE(ts) \/ Take_WATCH_PROPAGATE(ts)
     \/ Take_WATCH_HALT(ts) \/ Take_SCRIPT(ts) \/ Take_POST(ts) \/ Take_CONSUME(ts) \/ Take_MESSAGE(ts)
     \/ Take_RELEASE(ts) \/ Take_SET_TIMEOUT(ts) \/ Take_PICK(ts) \/ Take_PICK_BIND(ts) \/ Take_PICK_ERR(ts)
     \/ Take_ASK(ts) \/ Take_ANSWER(ts) \/ Take_ANSWER_ERR(ts) \/ Take_PAUSE(ts) \/ Take_RESUME(ts)
     \/ Take_CALL(ts) \/ Take_REPLY(ts) \/ Take_CALL_ERR(ts) \/ Take_EXECUTE(ts) \/ Take_EXECUTE_DONE(ts)
     \/ Take_EXECUTE_ERR(ts) \/ Take_ALLOC_ERR(ts) \/ Take_END(ts) \/ Take_HALT(ts) \/ Take_FAULT(ts)
     \/ Take_INTERRUPT(ts)

(* WF_vars(Some(Which)), where Possible(Which) is the same as ENABLED <<Some(Which)>>_vars, as each transition changes
   something, and is faster. Tasks that run end, timers that run expire, steps of the program that stay possible are
   taken. Nobody need ever interrupt. *)
Fair(Which(_)) == []<>~Possible(Which) \/ []<><< Some(Which) >>_vars

Identifiers == { Fleet[j].id : j \in DOMAIN Fleet }

Fairness ==
  /\ Fair(IsOwed)
  /\ Fair(IsProgram)
  /\ Fair(IsTimer)
  /\ \A v \in Identifiers : Fair(LAMBDA cause : cause[1] = "task" /\ cause[2] = v)

Spec == Init /\ [][Next]_vars /\ Fairness

-----------------------------------------------------------------------------
(* {1 Properties} *)

HasEnded == control.at = "end"

NoDeadlock == HasEnded \/ Possible(IsOwed)

Termination == <>HasEnded

(* How a run may end. NoHalt and NoLeftover are asked for by name only: a program may mean to halt, or to leave pairs
   in N. *)
EndsSo(how, why) == HasEnded /\ control.ending.how = how /\ control.ending.why = why
NothingLeft == (\A k \in OrderedKeys : N.queue[k] = << >>) /\ DOMAIN N.bag = { }

NoError == ~EndsSo("failed", "error")
Assertions == ~EndsSo("failed", "assertion")
EnoughVehicles == ~EndsSo("failed", "vehicles")
NoHalt == ~EndsSo("halted", "")
NoLeftover == EndsSo("completed", "") => NothingLeft

TypeOK ==
  /\ control.at \in { "script", "wait", "exec", "end" }
  /\ Len(store) = Len(GlobalNames)
  /\ DOMAIN A \subseteq Identifiers
  /\ Range(B) \subseteq Identifiers
  /\ Cardinality(Range(B)) = Len(B)
  /\ DOMAIN N.queue = OrderedKeys
  /\ \A pair \in DOMAIN N.bag : N.bag[pair] \in Nat \ { 0 }
  /\ outside.failed \in Nat
  /\ outside.losses \in Nat
  /\ outside.lost \subseteq Identifiers
  /\ outside.late \subseteq MayBeLate

AllocationWithinBound == DOMAIN A \subseteq Range(B)

(* A is exactly what runs, and no vehicle runs two tasks. *)
OneTaskEach ==
  LET running == IF control.at = "exec" THEN Running(control.r) ELSE << >>
  IN Range(running) = DOMAIN A /\ Cardinality(Range(running)) = Len(running)

EmptyAfterEnd == HasEnded => A = << >> /\ B = << >>

(* N changes by what is posted and consumed, and by nothing else. *)
RECURSIVE Tally(_)
Tally(pairs) == IF pairs = << >> THEN EmptyBag ELSE SetToBag({ Head(pairs) }) (+) Tally(Tail(pairs))

PairsOf(deeds, kind) == Flatten(Each(SelectSeq(deeds, LAMBDA d : d.did = kind), LAMBDA d : d.pairs))

AllPairs(n) ==
  LET queued == UNION { { << k, j >> : j \in DOMAIN n.queue[k] } : k \in OrderedKeys }
      pairs == { << k, n.queue[k][j] >> : << k, j >> \in queued } 
      count(pair) == Cardinality({ q \in queued : q[1] = pair[1] /\ n.queue[q[1]][q[2]] = pair[2] })
  IN [ pair \in pairs |-> count(pair) ] (+) n.bag

TuplesConserved ==
  \A ts \in { Known(vars) } : \A j \in DOMAIN ts :
    LET t == ts[j]
    IN AllPairs(t.S.N) (+) Tally(PairsOf(t.deeds, "consume")) = AllPairs(N) (+) Tally(PairsOf(t.deeds, "post"))

-----------------------------------------------------------------------------
(* {1 A run, told} *)

(* An ALIAS, for TLC to show of each state of a run instead of the variables: what is seen of it, and by what transition
   the run goes on; by several, if they lead to the same state. *)
Told ==
  LET taken == SelectSeq(Known(vars), Becomes)
  IN [ control |-> IF control.at = "end" THEN << "end", control.ending.how, control.ending.message >>
                   ELSE << control.at >>,
       store |-> [ x \in Range(GlobalNames) |-> store[IndexOf(GlobalNames, x)] ],
       A |-> [ v \in DOMAIN A |-> A[v].name ],
       B |-> B,
       N |-> N,
       goes_on |-> Each(taken, LAMBDA t : t.label),
       by |-> Each(taken, LAMBDA t : t.rules) ]

-----------------------------------------------------------------------------
(* {1 The graph, printed} *)

(* The elements of a set, in an order that is always the same. *)
RECURSIVE InOrder(_)
InOrder(set) == IF set = { } THEN << >> ELSE LET x == CHOOSE x \in set : TRUE IN << x >> \o InOrder(set \ { x })

(* A text for a state, the same for equal ones: comparing a value brings TLC to put the fields of its records in
   order. *)
StateText(kappa, S, environment) ==
  Only({ IF state = state THEN ToString(state) ELSE "" : state \in {
    << kappa, S.store, Each(S.B, LAMBDA v : IF v \in DOMAIN S.A THEN << S.A[v] >> ELSE << >>), S.B,
       Each(InOrder(OrderedKeys), LAMBDA k : S.N.queue[k]),
       Each(InOrder(DOMAIN S.N.bag), LAMBDA pair : << pair, S.N.bag[pair] >>),
       environment.failed, environment.losses, InOrder(environment.lost), InOrder(environment.late),
       Each(InOrder(Prompts), LAMBDA prompt : environment.asked[prompt]),
       Each(InOrder(Calls), LAMBDA call : environment.called[call]) >> } })

PrintTransition(t) ==
  PrintT("E\t" \o t.label \o "\t" \o StateText(t.control, t.S, Remembered(t)) \o "\t" \o Join(t.rules, ", "))

(* TLC evaluates an invariant once for each state that it finds: this one is always true, and prints the state and its
   transitions. *)
PrintGraph ==
  /\ PrintT("S\t" \o StateText(control, Shared, outside))
  /\ \A ts \in { Known(vars) } : \A j \in DOMAIN ts : PrintTransition(ts[j])
==============================================================================
