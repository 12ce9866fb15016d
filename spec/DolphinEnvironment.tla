-------------------------- MODULE DolphinEnvironment --------------------------
(* The events from outside, and so the whole system: the events and worlds in each *)
(* state, the environment's memory of them, Init and Next, and the properties.     *)
(* Environment and Faults in lib/environment are its counterparts.                 *)
EXTENDS Dolphin

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
  Confirmations(_), \* to the prompt of a task's question: how it may be answered, as in Confirmed
  HostReplies(_, _), \* to a call, made at this place: likewise what the host may reply, <<"value", y>>, or why it
                 \* fails, <<"failure", m>>
  Calls,         \* the calls whose replies depend on how often they were made
  Inputs,        \* what people and programs may post, a sequence of records: the key; the rounds of what may be posted
                 \* the first time, the second ..., the last for all later times; how many times at most; whether it is
                 \* certain to come so often, sooner or later
  InputKeys,     \* the keys that the program declares by input
  Interruptions  \* whether the program may be interrupted

(* outside is the number of failures and losses, the lost vehicles, the late ones, how often each question was asked,
   each call made and each input posted; and the date. Where links come and go by the time, it is the silent links,
   and the vehicles that came later than the others, in that order: Timed defines when. *)
vars == << control, store, A, B, N, outside >>

Identifiers == { Fleet[j].id : j \in DOMAIN Fleet }

EnvironmentOK ==
  /\ Is(Main, "closure") /\ Main[2] \in DOMAIN Lambdas
  /\ Len(OnInterrupt) <= 1 /\ \A i \in DOMAIN OnInterrupt : Is(OnInterrupt[i], "closure")
  /\ { Failures, Losses, Latecomers } \subseteq Nat \cup { -1 }
  /\ MayBeLate \subseteq Identifiers
  /\ Prompts \subseteq STRING /\ Calls \subseteq STRING
  /\ Interruptions \in BOOLEAN
  /\ \A i \in DOMAIN Inputs : Inputs[i].key \in InputKeys
  /\ \A i \in DOMAIN Inputs : Inputs[i].rounds # << >> /\ Inputs[i].times \in Nat /\ Inputs[i].certain \in BOOLEAN

ASSUME EnvironmentOK

(* The transition t, after which the environment remembers o. *)
Remembering(t, o) ==
  [ rules |-> t.rules, label |-> t.label, event |-> t.event, control |-> t.control, S |-> t.S, effects |-> t.effects,
    deeds |-> t.deeds, outside |-> o ]

-----------------------------------------------------------------------------
(* {1 Ends of tasks} *)

Failure(v) == FailedOn(v, "failure")
LostConnection(v) == FailedOn(v, "connection lost")

MayFail(v) == Ending(v, A[v].name) = "may fail"

(* The connection is lost for longer than its timeout: that counts as a failure. As long as the vehicle was not heard
   of otherwise, it does not count as a further loss. *)
MayBeLost(v) == v \in outside.lost \/ Losses = -1 \/ outside.losses < Losses

(* How the task that v runs may end now: as long as its link is silent, only by that. *)
EndsOf(v) ==
  IF v \in Range(outside.silent) THEN << LostConnection(v) >> ELSE
  LET fails == Ending(v, A[v].name) = "fails"
      mayFail == MayFail(v) /\ (Failures = -1 \/ outside.failed < Failures)
  IN (IF fails THEN << >> ELSE << Done(v) >>)
     \o (IF fails \/ mayFail THEN << Failure(v) >> ELSE << >>)
     \o (IF MayBeLost(v) THEN << LostConnection(v) >> ELSE << >>)

(* A timer that runs may expire at any moment, and a question that stands may be answered: in which order answers are
   given is left open. *)
EndsOfTimer(timer) ==
  IF IsQuestion(timer) THEN Each(Confirmations(timer.prompt), LAMBDA y : Confirmed(timer.i, y))
  ELSE << Expired(timer.i) >>

(* The recruits that wait in the active part of r. *)
RECURSIVE Waiting_(_)
Waiting_(r) ==
  CASE r.op = "recruit" -> << r >>
    [] r.op = "seq" -> Waiting_(r.first)
    [] r.op = "par" -> Flatten(Each(r.branches, Waiting_))
    [] r.op \in { "allOf", "repeat" } -> Flatten(Each(r.runs, Waiting_))
    [] r.op \in { "until", "watch", "hold", "recruited", "fresh", "ensure" } -> Waiting_(r.body)
    [] r.op = "during" -> IF r.started THEN Waiting_(r.body) ELSE << >>
    [] OTHER -> << >>

(* A vehicle that is lost, or may be late, may stay away; so may all of V, if at most the allowed number of them are
   late for the first time. *)
MayStayAway(v) == v \in outside.lost \/ (Latecomers # 0 /\ v \in MayBeLate)
MayAllStayAway(V) ==
  /\ \A v \in V : MayStayAway(v)
  /\ Latecomers = -1 \/ Cardinality(V \ (outside.lost \cup outside.late)) <= Latecomers - Cardinality(outside.late)

MayBeIn(q, vehicle) == q.region = << >> \/ \E place \in Range(vehicle.places) : Within(q.region[1], place)

(* The vehicles that fit and that no part of r names, each for each recruit that waits. *)
RecruitsFor(r) ==
  LET waiting == Waiting_(r)
      named == HeldBy(<< r >>)
      away == Range(B) \cup named \cup Range(outside.silent)
      wanted(q) == SelectSeq(Fleet, LAMBDA vehicle : /\ Accepts(q, vehicle) /\ vehicle.id \notin away
                                                     /\ MayBeIn(q, vehicle))
      pairs == Flatten(Each(waiting, LAMBDA w : Each(wanted(w.asked), LAMBDA vehicle : << w.timer, vehicle.id >>)))
      isOwed == ~MayAllStayAway({ pair[2] : pair \in Range(pairs) })
  IN Each(pairs, LAMBDA pair : Recruited(pair[1], pair[2], isOwed, ~MayStayAway(pair[2])))

(* The events that may come while r executes. *)
Events(r) == Flatten(Each(Running(r), EndsOf)) \o Flatten(Each(Timers(r), EndsOfTimer)) \o RecruitsFor(r)

(* Failures and losses are counted where their number is bounded. Of a vehicle whose task ends otherwise than by a loss
   something was heard. *)
AfterEnd(event) ==
  LET v == event[2]
      heard == [ outside EXCEPT !.lost = @ \ { v } ]
  IN CASE event = Failure(v) /\ Failures # -1 /\ MayFail(v) -> [ heard EXCEPT !.failed = @ + 1 ]
       [] event # LostConnection(v) -> heard
       [] v \in outside.lost \cup Range(outside.silent) -> outside
       [] OTHER -> [ outside EXCEPT !.lost = @ \cup { v }, !.losses = IF Losses = -1 THEN @ ELSE @ + 1 ]

(* Something was heard of a vehicle that is recruited. *)
AfterStep(event) ==
  CASE event[1] \in { "done", "failed" } -> AfterEnd(event)
    [] event[1] = "recruited" -> [ outside EXCEPT !.lost = @ \ { event[3] } ]
    [] OTHER -> outside

ExecutingTransitions(M, r) ==
  LET of(E) == Each(ExecutingSteps(M, r, E), LAMBDA t : Remembering(t, AfterStep(t.event)))
  IN Only({ of(E) : E \in { Events(r) } })

-----------------------------------------------------------------------------
(* {1 Who is there} *)

(* An attendance is the vehicles that come after all others, in this order, and the missing ones. *)
WorldOf(a, sees) ==
  LET missing == a.missing \o outside.silent
      moved == outside.came \o a.coming \o missing
  IN [ vehicles |-> SelectSeq(Fleet, LAMBDA vehicle : vehicle.id \notin Range(moved)) \o Each(moved, VehicleOf),
       missing |-> missing,
       sees |-> sees ]

Subsequences(xs) == Flatten([ n \in 1 .. Len(xs) + 1 |-> Choices(n - 1, xs) ])

(* All sequences of at most n different elements of xs. *)
RECURSIVE Arrangements(_, _)
Arrangements(n, xs) ==
  << << >> >> \o
  IF n = 0 THEN << >>
  ELSE Flatten([ j \in DOMAIN xs |-> Each(Arrangements(n - 1, Without(xs, j)), LAMBDA rest : << xs[j] >> \o rest) ])

(* The vehicles that q looks for, wherever they are. Nothing was heard of the silent ones since they were lost; the
   unsure may be late. *)
Wanted(q) ==
  Each(SelectSeq(Fleet, LAMBDA vehicle : Accepts(q, vehicle) /\ vehicle.id \notin Range(B \o outside.silent)),
       LAMBDA vehicle : vehicle.id)
Silent(q) == SelectSeq(Wanted(q), LAMBDA v : v \in outside.lost)
Unsure(q) == SelectSeq(Wanted(q), LAMBDA v : v \notin outside.lost /\ Latecomers # 0 /\ v \in MayBeLate)

LateIn(a) == (Range(a.coming) \cup Range(a.missing)) \ outside.lost
NewlyLate(a) == Cardinality(LateIn(a) \ outside.late)

(* The vehicles that q takes if they are there, wherever they may be seen. *)
AlwaysFit(q) ==
  LET isAlwaysIn(v) == q.region = << >> \/ (\A place \in Range(VehicleOf(v).places) : Within(q.region[1], place))
  IN SelectSeq(Wanted(q), isAlwaysIn)

(* As many of them as must be missing for too few to come, if that number may be: those first whose absence is
   nothing new, and each choice of others. *)
TooFew(q) ==
  LET always(vs) == SelectSeq(vs, LAMBDA v : v \in Range(AlwaysFit(q)))
      least == Len(AlwaysFit(q)) - (q.count - 1)
      forNothing == always(Silent(q) \o SelectSeq(Unsure(q), LAMBDA v : v \in outside.late))
      unknown == always(SelectSeq(Unsure(q), LAMBDA v : v \notin outside.late))
      more == Clipped(least - Len(forNothing), 0, Len(unknown))
      first == SubSeq(forNothing, 1, least - more)
  IN IF least < 1 \/ least - Len(forNothing) > Len(unknown) THEN << >>
     ELSE Each(Choices(more, unknown), LAMBDA others : first \o others)

(* A pick of all vehicles waits for its whole timeout: some may come late while others are missing. A pick of n
   vehicles goes on with the first n, of which up to n were late. Or too few come. Attendances with fewer newly late
   vehicles come first. *)
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
              \o Each(TooFew(q), LAMBDA absent : attendance(<< >>, absent))
      most == IF Latecomers = -1 THEN Len(unsure) ELSE Latecomers - Cardinality(outside.late)
      byNumber(as) == Flatten([ n \in 1 .. most + 1 |-> SelectSeq(as, LAMBDA a : NewlyLate(a) = n - 1) ])
  IN Only({ byNumber(as) : as \in { IF q.all THEN all ELSE some } })

(* Something was heard of a vehicle that is picked. Late vehicles are remembered where their number is bounded. *)
AfterPick(t, a) ==
  [ outside EXCEPT !.lost = @ \ (Range(t.S.B) \ Range(B)),
                   !.late = IF Latecomers = -1 THEN @ ELSE @ \cup LateIn(a) ]

(* In each world that may be. A transition that is there in several worlds is remembered as in the first of them:
   with the fewest newly late vehicles. Nothing follows PICK-ERR, whose ways differ in the text only: one is enough.
   The steps after PICK-ELSE know the late vehicles. *)
PickTransitions(M, q) ==
  LET placings == Placings(NothingSeen, IF q.region = << >> THEN << >> ELSE Wanted(q))
      in(a) == Flatten(Each(placings, LAMBDA sees : PickSteps(M, q, WorldOf(a, sees))))
      steps(a) == Each(in(a), LAMBDA t : Remembering(t, AfterPick(t, a)))
      areBoth(name, t, u) == t.rules = << name >> /\ u.rules = << name >>
      isSame(t, u) ==
        IF areBoth("PICK-ELSE", t, u) THEN t.outside.late \subseteq u.outside.late
        ELSE t.label = u.label \/ areBoth("PICK-ERR", t, u)
      first(ts) == SelectSeq([ j \in DOMAIN ts |-> j ], LAMBDA j : \A i \in 1 .. j - 1 : ~isSame(ts[i], ts[j]))
  IN Only({ Each(first(ts), LAMBDA j : ts[j]) : ts \in { Flatten(Each(Attendances(q), steps)) } })

-----------------------------------------------------------------------------
(* {1 Answers and replies} *)

(* Of rounds, the answers for the first time, the second ..., those for this time; and how often it was asked then, as
   far as it matters. *)
ThisTime(rounds, times) ==
  IF rounds = << >> THEN << >> ELSE rounds[IF times < Len(rounds) THEN times + 1 ELSE Len(rounds)]
OnceMore(rounds, times) == IF times + 1 < Len(rounds) THEN times + 1 ELSE times

(* A refused answer is asked for again, while there are others to come; then it counts as none. *)
RECURSIVE AnswerTransitions(_, _, _)
AnswerTransitions(M, prompt, times) ==
  LET rounds == Answers(prompt)
      given == ThisTime(rounds, times)
      asked(n) == IF prompt \in Prompts THEN [ outside EXCEPT !.asked[prompt] = n ] ELSE outside
      remembering(t) == Remembering(t, asked(OnceMore(rounds, times)))
      refused(m) ==
        IF times + 1 < Len(rounds) THEN AnswerTransitions(M, prompt, times + 1)
        ELSE << remembering(ANSWER_ERR(M, prompt, m)) >>
      of(result) == IF IsOk(result) THEN Each(result[2], remembering) ELSE refused(result[2])
      on(answer) == Only({ of(result) : result \in { AnswerSteps(M, answer) } })
  IN IF given = << >> THEN << Remembering(ANSWER_ERR(M, prompt, "none is given"), asked(times)) >>
     ELSE Flatten(Each(given, on))

ReplyTransitions(M, call, times) ==
  LET rounds == HostReplies(call, M.at)
      given == ThisTime(rounds, times)
      called(n) == IF call \in Calls THEN [ outside EXCEPT !.called[call] = n ] ELSE outside
      on(reply) == Remembering(IF reply[1] = "value" THEN REPLY(M, reply[2]) ELSE CALL_ERR(M, call, reply[2]),
                               called(OnceMore(rounds, times)))
  IN IF given = << >>
     THEN << Remembering(CALL_ERR(M, call, "the fleet has no reply " \o Quoted(call)), called(times)) >>
     ELSE Each(given, on)

-----------------------------------------------------------------------------
(* {1 Inputs} *)

InputTransitions(kappa) ==
  LET of(i) ==
        LET input == Inputs[i]
            after == [ outside EXCEPT !.sent[i] = @ + 1 ]
        IN IF outside.sent[i] = input.times THEN << >>
           ELSE Each(ThisTime(input.rounds, outside.sent[i]),
                     LAMBDA x : Remembering(INPUT(kappa, input.key, x, input.certain), after))
  IN Flatten(<< >> \o [ i \in DOMAIN Inputs |-> of(i) ])

-----------------------------------------------------------------------------
(* {1 The whole system} *)

Unnoticed(t) == Remembering(t, outside)

WaitTransitions(M, request) ==
  LET name == request[2]
  IN CASE request[1] = "pick" -> PickTransitions(M, request[2])
       [] request[1] = "ask" -> AnswerTransitions(M, name, IF name \in Prompts THEN outside.asked[name] ELSE 0)
       [] request[1] = "pause" -> << Unnoticed(RESUME(M)) >>
       [] request[1] = "call" -> ReplyTransitions(M, name, IF name \in Calls THEN outside.called[name] ELSE 0)

(* No run is interrupted twice. *)
MayBeInterrupted(kappa) == Interruptions /\ kappa.at # "end" /\ ~IsLeaving(kappa.M)

TransitionsFrom(kappa) ==
  (CASE kappa.at = "script" -> Each(ScriptSteps(kappa.M), Unnoticed)
     [] kappa.at = "wait" -> WaitTransitions(kappa.M, kappa.request)
     [] kappa.at = "exec" -> ExecutingTransitions(kappa.M, kappa.r)
     [] kappa.at = "end" -> << >>)
  \o (IF kappa.at = "end" THEN << >> ELSE InputTransitions(kappa))
  \o (IF MayBeInterrupted(kappa) THEN << Unnoticed(Interrupt(kappa)) >> ELSE << >>)

(* All that may happen now. *)
Transitions == TransitionsFrom(control)

Becomes(t) ==
  /\ control' = t.control
  /\ store' = t.S.store
  /\ A' = t.S.A
  /\ B' = t.S.B
  /\ N' = t.S.N
  /\ outside' = t.outside

InitAt(date, silent) ==
  /\ control = Script(Call(Main, << >>))
  /\ store = << >> \o [ i \in DOMAIN GlobalNames |-> << >> ]
  /\ A = << >>
  /\ B = << >>
  /\ N = NoTuples
  /\ outside = [ failed |-> 0, losses |-> 0, lost |-> { }, late |-> { }, asked |-> [ prompt \in Prompts |-> 0 ],
                  called |-> [ call \in Calls |-> 0 ], sent |-> << >> \o [ i \in DOMAIN Inputs |-> 0 ],
                  date |-> date, silent |-> silent, came |-> << >> ]

Init == InitAt(AnyDate, << >>)

Next == \E j \in DOMAIN Transitions : Becomes(Transitions[j])

(* {2 Events by kind} *)

(* An interruption, or a post of uncertain pairs, need never come; a vehicle to be recruited may stay away. *)
IsOwed(event) == event # Interruption /\ (event[1] \in { "input", "recruited" } => event[4])
IsProgram(event) == event = Program
IsTimer(event) == event[1] \in { "expired", "confirmed" }
IsEndOf(v, event) == event[1] \in { "done", "failed" } /\ event[2] = v

-----------------------------------------------------------------------------
(* {1 Properties} *)

(* NoDeadlock, TuplesConserved and Termination are about transitions: they are in DolphinChecking. *)

HasEnded == control.at = "end"

(* How a run may end. NoHalt and NoLeftover are asked for by name only: a program may mean to halt, or to leave pairs
   in N. *)
EndsSo(how, why) == HasEnded /\ control.ending.how = how /\ control.ending.why = why
NothingLeft == DOMAIN N.queue = { } /\ DOMAIN N.bag = { }
(* The program cannot know which inputs come, or take them all. *)
OnlyInputsLeft ==
  /\ DOMAIN N.queue \subseteq InputKeys
  /\ \A pair \in DOMAIN N.bag : pair[1] \in InputKeys

NoError == ~EndsSo("failed", "error")
Assertions == ~EndsSo("failed", "assertion")
EnoughVehicles == ~EndsSo("failed", "vehicles")
NoHalt == ~EndsSo("halted", "")
NoLeftover == EndsSo("completed", "") => OnlyInputsLeft

IsControl(kappa) ==
  CASE kappa.at = "script" -> IsMachine(kappa.M)
    [] kappa.at = "wait" -> IsMachine(kappa.M) /\ kappa.request[1] \in { "pick", "ask", "pause", "call" }
    [] kappa.at = "exec" -> IsMachine(kappa.M) /\ IsResidual(kappa.r, TRUE)
    [] kappa.at = "end" -> kappa.ending.how \in { "completed", "halted", "failed", "interrupted" }
    [] OTHER -> FALSE

TypeOK ==
  /\ IsControl(control)
  /\ Len(store) = Len(GlobalNames) /\ \A i \in DOMAIN store : Len(store[i]) <= 1
  /\ DOMAIN A \subseteq Identifiers
  /\ Range(B) \subseteq Identifiers
  /\ Cardinality(Range(B)) = Len(B)
  /\ \A k \in DOMAIN N.queue : IsOrdered(k) /\ N.queue[k] # << >>
  /\ \A pair \in DOMAIN N.bag : N.bag[pair] \in Nat \ { 0 }
  /\ outside.failed \in Nat
  /\ outside.date \in Nat \cup { AnyDate }
  /\ outside.losses \in Nat
  /\ outside.lost \subseteq Identifiers
  /\ Range(outside.silent) \cup Range(outside.came) \subseteq Identifiers
  /\ \A i \in DOMAIN Inputs : outside.sent[i] \in 0 .. Inputs[i].times
  /\ outside.late \subseteq MayBeLate

AllocationWithinBound == DOMAIN A \subseteq Bound

(* A is exactly what runs, and no vehicle runs two tasks. *)
OneTaskEach ==
  LET running == IF control.at = "exec" THEN Running(control.r) ELSE << >>
  IN Range(running) = DOMAIN A /\ Cardinality(Range(running)) = Len(running)

(* No vehicle is picked and recruited, or recruited twice. *)
RecruitedOnce ==
  LET V == RecruitsOf(control) IN Cardinality(Range(V)) = Len(V) /\ Range(V) \cap Range(B) = { }

EmptyAfterEnd == HasEnded => A = << >> /\ B = << >>

(* N changes by posts and consumes, and by keys that are forgotten. *)
RECURSIVE Tally(_)
Tally(pairs) ==
  IF pairs = << >> THEN EmptyBag
  ELSE SetToBag({ << Head(pairs)[1], Normal(Head(pairs)[2]) >> }) (+) Tally(Tail(pairs))

PairsOf(deeds, kind) == Flatten(Each(SelectSeq(deeds, LAMBDA d : d.did = kind), LAMBDA d : d.pairs))

AllPairs(n) ==
  LET queued == UNION { { << k, j >> : j \in DOMAIN n.queue[k] } : k \in DOMAIN n.queue }
      value(q) == Normal(n.queue[q[1]][q[2]])
      pairs == { << q[1], value(q) >> : q \in queued }
      count(pair) == Cardinality({ q \in queued : q[1] = pair[1] /\ value(q) = pair[2] })
  IN [ pair \in pairs |-> count(pair) ] (+) n.bag

ConservesTuples(t) ==
  AllPairs(t.S.N) (+) Tally(PairsOf(t.deeds, "consume")) (+) Tally(PairsOf(t.deeds, "forget"))
    = AllPairs(N) (+) Tally(PairsOf(t.deeds, "post"))

(* Of every program. TLC checks it on every program that it is given: `dolphin tla --run`, crosscheck.exe. *)
THEOREM Invariants ==
  Init /\ [][Next]_vars => [](TypeOK /\ AllocationWithinBound /\ OneTaskEach /\ RecruitedOnce /\ EmptyAfterEnd)
==============================================================================
