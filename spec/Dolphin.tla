-------------------------------- MODULE Dolphin --------------------------------
(* The rules of Dolphin, to be read beside docs/semantics.md: one operator for    *)
(* each inference rule, under the rule's name (PAR_ERR is [PAR-ERR]). Events from *)
(* outside, and so the whole system, are in DolphinEnvironment.                   *)
(*                                                                                *)
(* Letters as there: v, V vehicles; p a platform task; t a task; r a residual;    *)
(* k, x a pair of N; g a guard; i a timer; m a message; M the script's machine;   *)
(* l a label; w a world. Its kappa and sigma are the variables control and store. *)
(* S is the shared part <store, A, B, N>, with the sensor readings of the step,   *)
(* with the residuals beside the part that takes it, with those that may come     *)
(* after it, with the whole residual, and with the vehicles recruited for it.     *)
(*                                                                                *)
(* Steps(S, r, E) is the steps of the residual r: those that need no event, and   *)
(* those on the events E; the leftmost first. A step is a sequence of its         *)
(* outcomes, one for each thing that sensors may show; mostly there is one.       *)
(* An outcome is a record:                                                        *)
(*                                                                                *)
(*   rules    the derivation, the axiom first                                     *)
(*   label    what an observer sees, as text                                      *)
(*   event    what it answers: Program, or an event from outside                  *)
(*   S        the shared part after it                                            *)
(*   out      <<"next", r>>, <<"ok">>, <<"err", fault>>, or <<"ends", ending>>    *)
(*            if the whole program ends, whatever is around                       *)
(*   effects  what it asks of the outside, in order                               *)
(*   deeds    what its code did, handlers included                                *)
(*                                                                                *)
(* A transition of a configuration is the same, with control instead of out.      *)
(* Effects and deeds are not part of a state.                                      *)
EXTENDS DolphinMachine

VARIABLES
  control,  \* kappa: what runs
  store,    \* sigma: the values of the global variables, << >> for those that have none yet
  A,        \* the allocation: which platform task each vehicle runs, for those that run one
  B,        \* the bound vehicles, in the order in which they were picked
  N,        \* the tuple space
  outside   \* the environment's memory, defined by DolphinEnvironment; the date that code reads is among it

Shared == [ store |-> store, A |-> A, B |-> B, N |-> N, date |-> outside.date, sees |-> NothingSeen,
            beside |-> << >>, around |-> << >>, whole |-> << >>, recruits |-> << >> ]

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
Sequence(r, ts) ==
  IF r.op = "seq" THEN [ op |-> "seq", first |-> r.first, rest |-> r.rest \o ts ]
  ELSE [ op |-> "seq", first |-> r, rest |-> ts ]

Parts(r) == IF r.op = "seq" THEN << r.first >> \o r.rest ELSE << r >>
OfParts(rs) == IF Len(rs) = 1 THEN rs[1] ELSE [ op |-> "seq", first |-> rs[1], rest |-> Tail(rs) ]

(* r1 | .. | rn: it is flat. *)
Parallel(rs) ==
  LET flat == Flatten(Each(rs, LAMBDA r : IF r.op = "par" THEN r.branches ELSE << r >>))
  IN IF Len(flat) = 1 THEN flat[1] ELSE [ op |-> "par", branches |-> flat ]

(* allOf(r; bs) and allOf(bs): of one branch it is a oneOf. *)
AllOf(runs, choices) ==
  CASE choices = << >> -> runs[1]
    [] runs = << >> /\ Len(choices) = 1 -> [ op |-> "oneOf", choices |-> choices ]
    [] OTHER -> [ op |-> "allOf", runs |-> runs, choices |-> choices ]

(* repeat(r; t, n): r is the round that runs, << >> between two; n, in again.left, is how many are to come, or << >>. *)
Repeat(r, again) == IF again.left = << 0 >> THEN r ELSE [ again EXCEPT !.runs = << r >> ]

(* act(r): r when its turn has come; its timers start, its questions are put. *)
RECURSIVE Act(_)
Act(r) ==
  CASE r.op = "seq" -> [ r EXCEPT !.first = Act(@) ]
    [] r.op = "par" -> [ r EXCEPT !.branches = Each(@, Act) ]
    [] r.op \in { "allOf", "repeat" } -> [ r EXCEPT !.runs = Each(@, Act) ]
    [] r.op \in { "until", "watch", "hold", "recruited", "fresh", "ensure" } -> [ r EXCEPT !.body = Act(@) ]
    [] r.op = "during" -> IF Is(r.time, "closure") THEN r ELSE [ r EXCEPT !.started = TRUE, !.body = Act(@) ]
    [] OTHER -> r

(* run(r): the vehicles that run in the active part of r. *)
RECURSIVE Running(_)
Running(r) ==
  CASE r.op = "running" -> << r.v >>
    [] r.op = "seq" -> Running(r.first)
    [] r.op = "par" -> Flatten(Each(r.branches, Running))
    [] r.op \in { "allOf", "repeat" } -> Flatten(Each(r.runs, Running))
    [] r.op \in { "until", "watch", "hold", "recruited", "fresh", "ensure" } -> Running(r.body)
    [] r.op = "during" -> IF r.started THEN Running(r.body) ELSE << >>
    [] OTHER -> << >>

(* tim(r): the timers that run in the active part of r, each with its time; and the questions that stand there, each
   with its prompt. *)
RECURSIVE Timers(_)
Timers(r) ==
  CASE r.op = "idle" -> << [ i |-> r.timer, time |-> r.time ] >>
    [] r.op = "confirm" -> << [ i |-> r.timer, prompt |-> r.prompt ] >>
    [] r.op = "seq" -> Timers(r.first)
    [] r.op = "par" -> Flatten(Each(r.branches, Timers))
    [] r.op \in { "allOf", "repeat" } -> Flatten(Each(r.runs, Timers))
    [] r.op \in { "until", "watch", "hold", "recruited", "fresh", "ensure" } -> Timers(r.body)
    [] r.op = "during" -> IF r.started THEN << [ i |-> r.timer, time |-> r.time ] >> \o Timers(r.body) ELSE << >>
    [] OTHER -> << >>

(* recruits(r): the vehicles that r has recruited and has still. *)
RECURSIVE Recruits(_)
Recruits(r) ==
  CASE r.op = "recruited" -> << r.v >> \o Recruits(r.body)
    [] r.op = "seq" -> Recruits(r.first)
    [] r.op = "par" -> Flatten(Each(r.branches, Recruits))
    [] r.op \in { "allOf", "repeat" } -> Flatten(Each(r.runs, Recruits))
    [] r.op \in { "until", "watch", "hold", "fresh", "ensure" } -> Recruits(r.body)
    [] r.op = "during" -> IF r.started THEN Recruits(r.body) ELSE << >>
    [] OTHER -> << >>

(* The numbers of the keys of tasks in the active part of r. *)
RECURSIVE Keys(_)
Keys(r) ==
  CASE r.op = "fresh" -> r.keys \o Keys(r.body)
    [] r.op = "seq" -> Keys(r.first)
    [] r.op = "par" -> Flatten(Each(r.branches, Keys))
    [] r.op \in { "allOf", "repeat" } -> Flatten(Each(r.runs, Keys))
    [] r.op \in { "until", "watch", "hold", "recruited", "ensure" } -> Keys(r.body)
    [] r.op = "during" -> IF r.started THEN Keys(r.body) ELSE << >>
    [] OTHER -> << >>

(* ensured(r): the deeds of the active part of r if it is cut off, from the inside out and from left to right:
   <<"post", k, x>>, <<"set", i, x, name>> of the global i, and <<"giveBack">>, which does nothing. *)
RECURSIVE EnsuredIn(_)
EnsuredIn(r) ==
  CASE r.op = "ensure" -> EnsuredIn(r.body) \o r.ensured
    [] r.op = "seq" -> EnsuredIn(r.first)
    [] r.op = "par" -> Flatten(Each(r.branches, EnsuredIn))
    [] r.op \in { "allOf", "repeat" } -> Flatten(Each(r.runs, EnsuredIn))
    [] r.op \in { "until", "watch", "hold", "recruited", "fresh" } -> EnsuredIn(r.body)
    [] r.op = "during" -> IF r.started THEN EnsuredIn(r.body) ELSE << >>
    [] OTHER -> << >>

RecruitsOf(kappa) == IF kappa.at = "exec" THEN Recruits(kappa.r) ELSE << >>

(* Those that were picked, and those that were recruited. *)
Bound == Range(B) \cup Range(RecruitsOf(control))

IsQuestion(timer) == "prompt" \in DOMAIN timer

(* So deep are closures in tasks that closures give. *)
Deepest == 100

-----------------------------------------------------------------------------
(* r is the residual of a task whose vehicles are bound, in normal form; its running plans are in A, and only an
  active part has begun. *)
(* No vehicle, and no timer, is in both. *)
AreApart(r1, r2) ==
  HeldBy(<< r1 >>) \cap HeldBy(<< r2 >>) = { } /\ NumbersIn(<< r1 >>) \cap NumbersIn(<< r2 >>) = { }

RECURSIVE IsResidual(_, _)
IsResidual(r, active) ==
  LET areChoices(bs) == \A j \in DOMAIN bs : Is(bs[j].guard, "closure") /\ IsResidual(bs[j].body, FALSE)
  IN CASE r.op = "ready" -> r.p.op = "platform" /\ r.v \in Bound
       [] r.op = "running" -> active /\ r.v \in DOMAIN A /\ A[r.v] = r.p
       [] r.op \in { "action", "condition" } -> Is(r.code, "closure")
       [] r.op = "seq" ->
            /\ r.first.op # "seq" /\ IsResidual(r.first, active)
            /\ r.rest # << >> /\ \A j \in DOMAIN r.rest : r.rest[j].op # "seq" /\ IsResidual(r.rest[j], FALSE)
       [] r.op = "par" ->
            /\ Len(r.branches) > 1
            /\ \A j \in DOMAIN r.branches : r.branches[j].op # "par" /\ IsResidual(r.branches[j], active)
            /\ \A i, j \in DOMAIN r.branches : i = j \/ AreApart(r.branches[i], r.branches[j])
       [] r.op = "allOf" ->
            /\ Len(r.runs) <= 1 /\ (\A j \in DOMAIN r.runs : active /\ IsResidual(r.runs[j], active))
            /\ Len(r.choices) > (IF r.runs = << >> THEN 1 ELSE 0) /\ areChoices(r.choices)
       [] r.op = "oneOf" -> r.choices # << >> /\ areChoices(r.choices)
       [] r.op = "until" -> Is(r.guard, "closure") /\ IsResidual(r.body, active)
       [] r.op \in { "idle", "confirm" } -> r.timer \in Nat \ { 0 }
       [] r.op = "during" ->
            /\ r.timer \in Nat \ { 0 }
            /\ r.started => active /\ ~Is(r.time, "closure")
            /\ IsResidual(r.body, active /\ r.started)
       [] r.op = "watch" ->
            /\ Is(r.handler, "closure") /\ IsResidual(r.body, active)
            /\ \A j \in DOMAIN r.anew : r.anew[j].place \in Nat \ { 0 } /\ r.anew[j].depth \in 0 .. Deepest
       [] r.op = "repeat" ->
            /\ Len(r.runs) <= 1 /\ (\A j \in DOMAIN r.runs : IsResidual(r.runs[j], active))
            /\ r.runs = << >> => active /\ r.until # << >>
            /\ r.left = << >> \/ r.left[1] > 0
            /\ (\A j \in DOMAIN r.until : Is(r.until[j], "closure")) /\ IsResidual(r.each, FALSE)
       [] r.op = "made" -> Is(r.code, "closure") /\ r.place \in Nat \ { 0 } /\ r.depth \in 0 .. Deepest
       [] r.op = "unallocated" -> active /\ r.place \in Nat \ { 0 } /\ r.depth \in 0 .. Deepest
       [] r.op = "hold" ->
            active /\ r.vehicles # << >> /\ Range(r.vehicles) \subseteq Bound /\ IsResidual(r.body, active)
       [] r.op = "recruit" -> r.timer \in Nat \ { 0 } /\ r.place \in Nat \ { 0 } /\ Is(r.code, "closure")
       [] r.op = "fresh" -> Range(r.keys) \subseteq Nat \ { 0 } /\ IsResidual(r.body, active)
       [] r.op = "ensure" -> r.ensured # << >> /\ IsResidual(r.body, active)
       [] r.op = "recruited" -> active /\ r.v \notin Range(B) /\ IsResidual(r.body, active)
       [] OTHER -> FALSE

-----------------------------------------------------------------------------
(* {1 Events} *)

(* No event: the program goes on by itself. *)
Program == << "program" >>

Done(v) == << "done", v >>
FailedOn(v, m) == << "failed", v, m >>
Expired(i) == << "expired", i >>
(* The question i is answered by y: << "yes" >>, << "no" >>, or << "nobody", m >>. *)
Confirmed(i, y) == << "confirmed", i, y >>
(* v is there for the recruit i; whether one of all possible vehicles must come; whether v surely is there. *)
Recruited(i, v, isOwed, isSure) == << "recruited", i, v, isOwed, isSure >>
AnsweredWith(text) == << "answered", text >>
NobodyAnswers(m) == << "nobody answers", m >>
Replied(y) == << "replied", y >>
HostFailed(m) == << "host failed", m >>
(* A person or program posts k:x; whether it is certain to come, sooner or later. *)
Posted(k, x, isCertain) == << "input", k, x, isCertain >>
Interruption == << "interruption" >>

(* The timer of pick and pause. *)
ScriptTimer == 0

-----------------------------------------------------------------------------
(* {1 Effects} *)

(* The requests of a transition to the outside: <<"start", v, p>>, <<"stop", v>>, <<"set timer", i, n>>, <<"cancel
   timer", i>>, <<"put question", i, x>>, <<"withdraw question", i>>, <<"look for", q>>, <<"bind", V>>, <<"release",
   V>>, <<"connection timeout", V, n>>, where V is << >> for all vehicles, <<"say", x>>, <<"ask", x>>, <<"call",
   name, arguments>>, and last of all <<"end", ending>>. *)

SetTimers(timers) ==
  Each(timers, LAMBDA timer : IF IsQuestion(timer) THEN << "put question", timer.i, timer.prompt >>
                              ELSE << "set timer", timer.i, timer.time >>)
CancelTimers(timers) ==
  Each(timers, LAMBDA timer : << IF IsQuestion(timer) THEN "withdraw question" ELSE "cancel timer", timer.i >>)

Releasing(V) == IF V = << >> THEN << >> ELSE << << "release", V >> >>

(* cut(rs): the timers of these residuals are cancelled, then their vehicles stop, then those recruited are released. *)
Cut(rs) ==
  CancelTimers(Flatten(Each(rs, Timers))) \o Each(Flatten(Each(rs, Running)), LAMBDA v : << "stop", v >>)
  \o Releasing(Flatten(Each(rs, Recruits)))

EffectOf(d) ==
  CASE d.did = "message" -> << << "say", d.text >> >>
    [] d.did = "release" -> << << "release", d.vehicles >> >>
    [] d.did = "timeout" -> << << "connection timeout", d.vehicles, d.time >> >>
    [] OTHER -> << >>

EffectsOf(deeds) == Flatten(Each(deeds, EffectOf))

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
(* {1 Allocation} *)

(* The platform tasks of t from left to right, each with the vehicles that the T[V] around it leave: << >> for all. *)
RECURSIVE Leaves(_, _)
Leaves(t, allowed) ==
  CASE t.op = "platform" -> << [ p |-> t, allowed |-> allowed ] >>
    [] t.op \in { "seq", "par" } -> Leaves(t.left, allowed) \o Leaves(t.right, allowed)
    [] t.op = "on" ->
         Leaves(t.body, << IF allowed = << >> THEN t.vehicles ELSE Intersection(t.vehicles, allowed[1]) >>)
    [] t.op \in { "allOf", "oneOf" } -> Flatten(Each(t.branches, LAMBDA b : Leaves(b.body, allowed)))
    [] t.op \in { "until", "during", "watch", "repeat", "fresh", "ensure" } -> Leaves(t.body, allowed)
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
    [] t.op \in { "on", "until", "during", "watch", "repeat", "fresh", "ensure" } -> Exclusive(t.body, n)
    [] OTHER -> { }

(* The devices that v lacks for p, or nothing. *)
Lack(p, v) ==
  LET missing == SelectSeq(Plans[p.plan].devices, LAMBDA d : ~Carries(VehicleOf(v), << d >>))
  IN CASE ~IsKnown(v) -> << "nothing is known of it" >>
       [] p.plan = 0 -> << >>
       [] Plans[p.plan].vehicles # << >> /\ v \notin Range(Plans[p.plan].vehicles) ->
            << "the plan is for other vehicles" >>
       [] missing # << >> -> << "it lacks " \o Join(missing, ", ") >>
       [] OTHER -> << >>

Permitted(leaf, v) == leaf.allowed = << >> \/ v \in Range(leaf.allowed[1])

(* The places in V, the vehicles that are bound for the part, of those that can run it. *)
Candidates(leaf, V) == { j \in DOMAIN V : Permitted(leaf, V[j]) /\ Lack(leaf.p, V[j]) = << >> }

(* How much farther it is from v to the beginning of p than from the nearest place of a vehicle, in millimetres. *)
Farther(p, v, sees) ==
  IF p.plan = 0 \/ ~IsKnown(v) THEN 0 ELSE Plans[p.plan].farther[FoundAt(VehicleOf(v), sees)]

(* f[n] is the place in V of the vehicle of the n-th platform task. *)
RECURSIVE Feasible(_, _, _, _)
Feasible(leaves, exclusive, n, V) ==
  IF n = 0 THEN { << >> }
  ELSE { f \in { Append(f, j) : f \in Feasible(leaves, exclusive, n - 1, V), j \in Candidates(leaves[n], V) } :
           \A i \in 1 .. n - 1 : << i, n >> \in exclusive => f[i] # f[n] }

RECURSIVE Total(_, _, _, _)
Total(leaves, f, sees, V) ==
  IF f = << >> THEN 0
  ELSE Farther(leaves[Len(f)].p, V[Last(f)], sees) + Total(leaves, SubSeq(f, 1, Len(f) - 1), sees, V)

LeastBy(F, Measure(_)) == LET least == Minimum({ Measure(f) : f \in F }) IN { f \in F : Measure(f) = least }

RECURSIVE FirstInPickOrder(_, _)
FirstInPickOrder(F, n) ==
  IF Cardinality(F) = 1 THEN Only(F) ELSE FirstInPickOrder(LeastBy(F, LAMBDA f : f[n]), n + 1)

Best(leaves, F, sees, V) ==
  FirstInPickOrder(LeastBy(LeastBy(F, LAMBDA f : Cardinality(Range(f))), LAMBDA f : Total(leaves, f, sees, V)), 1)

(* Whether the handler of this watch may run its task again, or another one in its place. *)
Recovers(t) == Lambdas[t.handler[2]].recovers

(* t with its vehicles, and timers numbered from left to right: after the n-th platform task and the i-th timer. Code
   that makes a task, or that may recover, has a number among the timers of the executed task, which tasks made there
   keep. *)
RECURSIVE TimerCount(_, _)
TimerCount(t, first) ==
  CASE t.op \in { "idle", "confirm" } -> 1
    [] t.op = "recruit" -> IF first THEN 2 ELSE 1
    [] t.op = "made" -> IF first THEN 1 ELSE 0
    [] t.op = "during" -> 1 + TimerCount(t.body, first)
    [] t.op = "watch" -> (IF first /\ Recovers(t) THEN 1 ELSE 0) + TimerCount(t.body, first)
    [] t.op \in { "seq", "par" } -> TimerCount(t.left, first) + TimerCount(t.right, first)
    [] t.op \in { "allOf", "oneOf" } ->
         LET counts[j \in 0 .. Len(t.branches)] ==
               IF j = 0 THEN 0 ELSE counts[j - 1] + TimerCount(t.branches[j].body, first)
         IN counts[Len(t.branches)]
    [] t.op \in { "on", "until", "repeat", "fresh", "ensure" } -> TimerCount(t.body, first)
    [] OTHER -> 0

(* Timers for a task made at a place of the executed task, as many as it needs: none of those in use. *)
Generation == 1000000

RECURSIVE FreshFrom(_, _, _)
FreshFrom(i, used, count) ==
  CASE count = 0 -> << >>
    [] i \in used -> FreshFrom(i + Generation, used, count)
    [] OTHER -> << i >> \o FreshFrom(i + Generation, used, count - 1)
FreshTimers(place, used, count) == FreshFrom(place + Generation, used, count)

(* The data for the parts of a task besides vehicles of q.bound: q.numbers, if it is made at its turn, are its
   timers; those of q.used are taken. *)
Executed == [ allowed |-> << >>, place |-> 0, depth |-> 0, numbers |-> << >>, used |-> { }, bound |-> B ]
IsExecuted(q) == q.place = 0
TimerOf(i, q) == IF IsExecuted(q) THEN i ELSE q.numbers[i]
KeyNumber(i, q) == IF IsExecuted(q) THEN i ELSE FreshTimers(q.place, q.used, i)[i]

RECURSIVE Assigned(_, _, _, _, _)
Assigned(t, f, n, i, q) ==
  CASE t.op = "platform" -> [ op |-> "ready", p |-> t, v |-> q.bound[f[n + 1]] ]
    [] t.op = "seq" ->
         Sequence(Assigned(t.left, f, n, i, q),
                  Parts(Assigned(t.right, f, n + LeafCount(t.left), i + TimerCount(t.left, IsExecuted(q)), q)))
    [] t.op = "par" ->
         Parallel(<< Assigned(t.left, f, n, i, q),
                     Assigned(t.right, f, n + LeafCount(t.left), i + TimerCount(t.left, IsExecuted(q)), q) >>)
    [] t.op = "on" ->
         LET both == IF q.allowed = << >> THEN t.vehicles ELSE Intersection(q.allowed[1], t.vehicles)
         IN Assigned(t.body, f, n, i, [ q EXCEPT !.allowed = << both >> ])
    [] t.op = "made" ->
         [ op |-> "made", code |-> t.code, given |-> << >>, allowed |-> q.allowed, depth |-> q.depth,
           place |-> IF IsExecuted(q) THEN i + 1 ELSE q.place ]
    [] t.op \in { "allOf", "oneOf" } ->
         LET before(j) == [ op |-> "allOf", branches |-> SubSeq(t.branches, 1, j - 1) ]
             branch(j) == [ guard |-> t.branches[j].guard,
                            body |-> Assigned(t.branches[j].body, f, n + LeafCount(before(j)),
                                              i + TimerCount(before(j), IsExecuted(q)), q) ]
             choices == << >> \o [ j \in DOMAIN t.branches |-> branch(j) ]
         IN IF t.op = "oneOf" THEN [ op |-> "oneOf", choices |-> choices ] ELSE AllOf(<< >>, choices)
    [] t.op \in { "until", "ensure" } -> [ t EXCEPT !.body = Assigned(@, f, n, i, q) ]
    [] t.op = "idle" -> [ op |-> "idle", timer |-> TimerOf(i + 1, q), time |-> t.time ]
    [] t.op = "confirm" -> [ op |-> "confirm", timer |-> TimerOf(i + 1, q), prompt |-> t.prompt, at |-> t.at ]
    [] t.op = "recruit" ->
         [ op |-> "recruit", timer |-> TimerOf(i + 1, q), asked |-> t.asked, code |-> t.code, depth |-> q.depth,
           place |-> IF IsExecuted(q) THEN i + 2 ELSE q.place ]
    [] t.op = "during" ->
         [ op |-> "during", timer |-> TimerOf(i + 1, q), time |-> t.time, started |-> FALSE, fails |-> t.fails,
           body |-> Assigned(t.body, f, n, i + 1, q) ]
    [] t.op = "watch" ->
         LET place == IF IsExecuted(q) THEN i + 1 ELSE q.place
             next == IF IsExecuted(q) /\ Recovers(t) THEN i + 1 ELSE i
             watched == IF "closed" \in DOMAIN t THEN t.closed ELSE t.body
             request == [ task |-> watched, allowed |-> q.allowed, place |-> place, depth |-> q.depth ]
         IN [ op |-> "watch", body |-> Assigned(t.body, f, n, next, q), handler |-> t.handler,
              anew |-> IF Recovers(t) THEN << request >> ELSE << >> ]
    [] t.op = "repeat" ->
         LET each == Assigned(t.body, f, n, i, q)
             left == IF t.rounds = << >> THEN << >> ELSE << t.rounds[1] - 1 >>
         IN [ op |-> "repeat", runs |-> << each >>, left |-> left, until |-> t.until, each |-> each, at |-> t.at ]
    [] t.op = "fresh" -> [ op |-> "fresh", keys |-> t.keys, body |-> Assigned(t.body, f, n, i, q) ]
    [] t.op \in { "action", "condition" } -> t

NoCandidate(leaf, V) ==
  LET permitted == SelectSeq(V, LAMBDA v : Permitted(leaf, v))
      why(v) == v \o ": " \o Lack(leaf.p, v)[1]
      reason == CASE V = << >> -> "no vehicle is bound to the program: pick one first"
                  [] leaf.allowed = << << >> >> -> "the vehicle set given to it is empty"
                  [] permitted = << >> ->
                       "none of the vehicles given to it is bound to the program: " \o Join(leaf.allowed[1], ", ")
                  [] OTHER -> Join(Each(permitted, why), "; ")
  IN Fault("no vehicle can run task '" \o leaf.p.name \o "': " \o reason, leaf.p.at)

(* As few tasks as can be that cannot all have vehicles. *)
Conflict(leaves, exclusive, V) ==
  LET numbers == 1 .. Len(leaves)
      ordered(X) == SelectSeq([ n \in numbers |-> n ], LAMBDA n : n \in X)
      excludes(X) == { << i, j >> \in (1 .. Cardinality(X)) \X (1 .. Cardinality(X)) :
                         i < j /\ << ordered(X)[i], ordered(X)[j] >> \in exclusive }
      impossible(X) == Feasible(Each(ordered(X), LAMBDA n : leaves[n]), excludes(X), Cardinality(X), V) = { }
      few == LeastBy({ X \in SUBSET numbers : impossible(X) }, Cardinality)
      those == FirstInPickOrder({ ordered(X) : X \in few }, 1)
      competing == SelectSeq([ j \in DOMAIN V |-> j ], LAMBDA j : \E n \in Range(those) : j \in Candidates(leaves[n],
        V))
  IN Fault("tasks " \o Join(Each(those, LAMBDA n : "'" \o leaves[n].p.name \o "'"), ", ")
           \o " run side by side and need different vehicles, but there is only "
           \o Join(Each(competing, LAMBDA j : V[j]), ", "), leaves[those[1]].p.at)

(* Whether it matters to the allocation of t where vehicles are. *)
DependsOnPlaces(t) == \E leaf \in Range(Leaves(t, << >>)) : leaf.p.plan # 0

(* alloc(t, V) for those V that are allowed, where vehicles are at their seen places: <<"ok", r and the vehicles that
   it has>>, or <<"wrong", fault>>. The tasks of each fresh in t are known; their keys have the first i numbers. *)
AllocWithin(t, i, allowed, q, sees) ==
  LET leaves == Leaves(t, allowed)
      hopeless == SelectSeq(leaves, LAMBDA leaf : Candidates(leaf, q.bound) = { })
      exclusive == Exclusive(t, 0)
      feasible == Feasible(leaves, exclusive, Len(leaves), q.bound)
  IN CASE hopeless # << >> -> Bad(NoCandidate(hopeless[1], q.bound))
       [] feasible = { } -> Bad(Conflict(leaves, exclusive, q.bound))
       [] OTHER -> Only({ Ok([ r |-> Assigned(t, f, 0, i, q),
                               vehicles |-> SelectSeq(q.bound, LAMBDA v : \E j \in Range(f) : q.bound[j] = v) ]) :
                          f \in { Best(leaves, feasible, sees, q.bound) } })

Alloc(t, i, sees) == AllocWithin(t, i, << >>, Executed, sees)

-----------------------------------------------------------------------------
(* {1 Steps of residuals} *)

Step(rule, label, event, S, out, effects) ==
  [ rules |-> << rule >>, label |-> label, event |-> event, S |-> S, out |-> out, effects |-> effects, deeds |-> << >> ]

(* The step s of a part as a step of the whole around it: by one more rule, the outcome out. *)
By(s, rule, out) == [ s EXCEPT !.rules = Append(@, rule), !.out = out ]

Asking(s, effects) == [ s EXCEPT !.effects = @ \o effects ]

Next_(r) == << "next", r >>
Done_ == << "ok" >>
Err(fault) == << "err", fault >>
Ends(ending) == << "ends", ending >>

GoesOn(s) == s.out[1] = "next"
IsDone(s) == s.out[1] = "ok"
IsErr(s) == s.out[1] = "err"

(* s, after which N is without pairs of the keys of these numbers. *)
Forgetting(s, numbers) ==
  LET keys == { KeyText(i) : i \in Range(numbers) }
      gone == PairsWith(s.S.N, keys)
  IN IF gone = << >> THEN s
     ELSE [ s EXCEPT !.S.N = WithoutKeys(@, keys), !.deeds = Append(@, [ did |-> "forget", pairs |-> gone ]) ]

(* s, by which the executed task is over: no key of fresh has a pair. *)
ForgettingAll(s) ==
  LET keys == { k \in { pair[1] : pair \in DOMAIN s.S.N.bag } \cup DOMAIN s.S.N.queue : IsKeyText(k) }
  IN IF keys = { } THEN s
     ELSE [ s EXCEPT !.S.N = WithoutKeys(@, keys),
                     !.deeds = Append(@, [ did |-> "forget", pairs |-> PairsWith(s.S.N, keys) ]) ]

(* s, in which the end of a task does ds. Its values are known: it cannot fail. *)
RECURSIVE Ensuring(_, _)
Ensuring(s, ds) ==
  IF ds = << >> THEN s
  ELSE LET d == Head(ds)
           after ==
             CASE d[1] = "post" ->
                    [ s EXCEPT !.S.N = Post(@, d[2], d[3]),
                               !.deeds = Append(@, [ did |-> "post", pairs |-> << << d[2], d[3] >> >> ]) ]
               [] d[1] = "set" -> [ s EXCEPT !.S.store = [ @ EXCEPT ![d[2]] = << d[3] >> ] ]
               [] OTHER -> s
       IN Ensuring(after, Tail(ds))

(* s, by which the turn of r comes, which is active now. *)
Entering(s, r) == Asking(Forgetting(s, Keys(r)), SetTimers(Timers(r)))

(* S without A(V). *)
WithoutA(S, V) == [ S EXCEPT !.A = [ v \in DOMAIN @ \ V |-> @[v] ] ]

(* s, by which rs are cut off: S' without A(run(rs)), the effects cut(rs), and their ensured deeds. *)
CutOff(s, rs) ==
  Ensuring(Asking([ s EXCEPT !.S = WithoutA(@, Range(Flatten(Each(rs, Running)))) ], Cut(rs)),
           Flatten(Each(rs, EnsuredIn)))

(* S |- g => x, S', ds: the code g with these arguments, once for each outcome that sensors allow. Of a fault only
   the messages stay. Seen answers stay for the rest of the step. *)
After(S, m) == [ S EXCEPT !.store = m.store, !.B = m.B, !.N = m.N, !.sees = m.sees ]
Knowing(S, sees) == [ S EXCEPT !.sees = sees ]

(* The step is over: the readings of sensors may change from now on. *)
Over(S) == IF HasReadings THEN [ S EXCEPT !.store = KeptInStore(@) ] ELSE S

Endless == "this code does not come to an end, and code inside of a task is atomic"

Said(deeds) == SelectSeq(deeds, LAMBDA d : d.did = "message")

RunCode(S, mode, closure, arguments) ==
  LET result(m, is, value, after, deeds) ==
        [ is |-> is, value |-> value, verdict |-> m.verdict, S |-> after, deeds |-> deeds ]
      of(m) ==
        CASE m.stop[1] = "finished" -> result(m, "value", m.stop[2], After(S, m), m.deeds)
          [] m.stop[1] = "halted" -> result(m, "halt", m.stop[2], After(S, m), m.deeds)
          [] m.stop[1] = "faulted" -> result(m, "fault", m.stop[2], Knowing(S, m.sees), Said(m.deeds))
          [] m.stop[1] = "exhausted" -> result(m, "fault", Fault(Endless, -closure[2]), Knowing(S, m.sees), << >>)
  IN Each(Run(Call(closure, arguments), S, mode, AtomicFuel), of)

(* Code ran, and gave what the rule asks for. *)
CodeStep(rule, label, run, out) ==
  [ Step(rule, label, Program, run.S, out, EffectsOf(run.deeds)) EXCEPT !.deeds = run.deeds ]

(* Code is faulty; the purpose of the code determines the rule. *)
Broken(S, fault, deeds) ==
  [ Step("", "broken(" \o fault.message \o ")", Program, S, Err(fault), EffectsOf(Said(deeds))) EXCEPT !.rules = << >> ]

(* {2 Platform tasks} *)

START(S, r) == Step("START", "start(" \o r.v \o ", " \o r.p.name \o ")", Program,
                    [ S EXCEPT !.A = (r.v :> r.p) @@ @ ], Next_([ r EXCEPT !.op = "running" ]),
                    << << "start", r.v, r.p >> >>)

DONE(S, r) == Step("DONE", "done(" \o r.v \o ", " \o r.p.name \o ")", Done(r.v), WithoutA(S, { r.v }), Done_, << >>)

FAIL(S, r, m) ==
  LET fault == [ Fault(r.p.name \o " failed on " \o r.v \o ": " \o m, r.p.at) EXCEPT !.failed = << r.v, r.p.name >> ]
  IN Step("FAIL", "fail(" \o r.v \o ", " \o r.p.name \o ", " \o m \o ")", FailedOn(r.v, m),
          WithoutA(S, { r.v }), Err(fault), << >>)

(* {2 Code} *)

ACTION_(run) == CodeStep("ACTION", Labelled("act", run.deeds), run, Done_)
ACTION_ERR(s) == By(s, "ACTION-ERR", s.out)

CONDITION(run) == CodeStep("CONDITION", Labelled("check", run.deeds), run, Done_)
CONDITION_ERR(s) == By(s, "CONDITION-ERR", s.out)

(* {2 Assertions, and halt} *)

(* No watch handles an assertion that fails, nor halt. *)
ASSERT_ERR(s, fault) == By(s, "ASSERT-ERR", Ends(Failed(fault)))

HaltLabel(m) == IF m = "" THEN "halt" ELSE "halt(" \o m \o ")"
HALT(run) == CodeStep("HALT", HaltLabel(run.value), run, Ends(Halted(run.value)))

(* {2 One after the other} *)

SEQ_1(s, ts) == By(s, "SEQ-1", Next_(Sequence(s.out[2], ts)))
SEQ_2(s, ts) == LET r == Act(OfParts(ts)) IN Entering(By(s, "SEQ-2", Next_(r)), r)
SEQ_ERR(s) == By(s, "SEQ-ERR", s.out)

InSequence(s, ts) ==
  CASE GoesOn(s) -> SEQ_1(s, ts)
    [] IsDone(s) -> SEQ_2(s, ts)
    [] IsErr(s) -> SEQ_ERR(s)
    [] OTHER -> s

(* {2 Side by side} *)

PAR_1(s, rs, j) == By(s, "PAR-1", Next_(Parallel(With(rs, j, s.out[2]))))
PAR_2(s, rs, j) == By(s, "PAR-2", Next_(Parallel(Without(rs, j))))
PAR_ERR(s, rs, j) == CutOff(By(s, "PAR-ERR", s.out), Without(rs, j))

InParallel(s, rs, j) ==
  CASE GoesOn(s) -> PAR_1(s, rs, j)
    [] IsDone(s) -> PAR_2(s, rs, j)
    [] IsErr(s) -> PAR_ERR(s, rs, j)
    [] OTHER -> s

(* {2 Branches with guards} *)

(* Code in the place of a branch's task gets the values that the guard took; its ensure gets the pairs. *)
PairsTaken(ds) == Flatten(Each(ds, LAMBDA d : IF d.did = "consume" THEN d.pairs ELSE << >>))
ValuesTaken(ds) == Each(PairsTaken(ds), LAMBDA pair : pair[2])

Ensure(ds, r) == IF ds = << >> THEN r ELSE [ op |-> "ensure", ensured |-> ds, body |-> r ]

RECURSIVE Given(_, _)
Given(r, ds) ==
  LET back(d) ==
        IF d[1] # "giveBack" THEN << d >>
        ELSE Each(PairsTaken(ds), LAMBDA pair : << "post", pair[1], pair[2] >>)
  IN CASE r.op = "made" /\ Lambdas[r.code[2]].parameters > 0 -> [ r EXCEPT !.given = ValuesTaken(ds) ]
       [] r.op = "ensure" -> Ensure(Flatten(Each(r.ensured, back)), Given(r.body, ds))
       [] OTHER -> r

ALLOF_WHEN(run, bs, j) ==
  LET r == Act(Given(bs[j].body, run.deeds))
  IN Entering(CodeStep("ALLOF-WHEN", Labelled("check", run.deeds), run, Next_(AllOf(<< r >>, Without(bs, j)))), r)
ALLOF_1(s, bs) == By(s, "ALLOF-1", Next_(AllOf(<< s.out[2] >>, bs)))
ALLOF_2(s, bs) == By(s, "ALLOF-2", Next_(AllOf(<< >>, bs)))
ALLOF_ERR(s) == By(s, "ALLOF-ERR", s.out)

InAllOf(s, bs) ==
  CASE GoesOn(s) -> ALLOF_1(s, bs)
    [] IsDone(s) -> ALLOF_2(s, bs)
    [] IsErr(s) -> ALLOF_ERR(s)
    [] OTHER -> s

ONEOF_WHEN(run, b) ==
  LET r == Act(Given(b.body, run.deeds))
  IN Entering(CodeStep("ONEOF-WHEN", Labelled("check", run.deeds), run, Next_(r)), r)
ONEOF_ERR(s) == By(s, "ONEOF-ERR", s.out)

(* {2 Until and assure} *)

(* r.fails is the place of an assure; or << >>. *)
NotAssured(r) == Fault("assure: { " \o LambdaNames[r.guard[2]] \o " } does not hold", r.fails[1])

UNTIL_CUT(run, r) == CutOff(CodeStep("UNTIL-CUT", Labelled("cut", run.deeds), run, Done_), << r.body >>)
ASSURE_CUT(S, r) == CutOff(Step("ASSURE-CUT", "cut", Program, S, Err(NotAssured(r)), << >>), << r.body >>)
UNTIL_1(s, r) == By(s, "UNTIL-1", Next_([ r EXCEPT !.body = s.out[2] ]))
UNTIL_2(s) == By(s, "UNTIL-2", Done_)

(* rs is the part that still runs: nothing if the body failed, the body if the guard did. *)
UNTIL_ERR(s, rs) == CutOff(By(s, "UNTIL-ERR", s.out), rs)

InUntil(s, r) ==
  CASE GoesOn(s) -> UNTIL_1(s, r)
    [] IsDone(s) -> UNTIL_2(s)
    [] IsErr(s) -> UNTIL_ERR(s, << >>)
    [] OTHER -> s

(* {2 Time} *)

IDLE_END(S, r) == Step("IDLE-END", "timeout", Expired(r.timer), S, Done_, << >>)

DURING_SET(run, r, n) ==
  LET started == [ r EXCEPT !.time = n, !.started = TRUE, !.body = Act(@) ]
  IN Entering(CodeStep("DURING-SET", "set-time(" \o ShortText(n) \o ")", run, Next_(started)), started)
DURING_CUT(S, r) == CutOff(Step("DURING-CUT", "timeout", Expired(r.timer), S, Done_, << >>), << r.body >>)

(* r.fails is the place of a within; or << >>. *)
TooLate(r) == Fault("not done within " \o ShortText(r.time) \o " s", r.fails[1])
WITHIN_CUT(S, r) == CutOff(Step("WITHIN-CUT", "timeout", Expired(r.timer), S, Err(TooLate(r)), << >>), << r.body >>)
DURING_1(s, r) == By(s, "DURING-1", Next_([ r EXCEPT !.body = s.out[2] ]))
DURING_2(s, r) == Asking(By(s, "DURING-2", Done_), << << "cancel timer", r.timer >> >>)

(* Its timer runs unless the code that gives the time is faulty. *)
DURING_ERR(s, r) ==
  Asking(By(s, "DURING-ERR", s.out), IF r.started THEN << << "cancel timer", r.timer >> >> ELSE << >>)

InDuring(s, r) ==
  CASE GoesOn(s) -> DURING_1(s, r)
    [] IsDone(s) -> DURING_2(s, r)
    [] IsErr(s) -> DURING_ERR(s, r)
    [] OTHER -> s

NoTime(x, g) == Fault(LambdaNames[g[2]] \o " takes a time of 0 seconds or more, this code gives " \o Text(x), -g[2])

(* {2 Questions} *)

CONFIRM_YES(S, event) == Step("CONFIRM-YES", "answer(yes)", event, S, Done_, << >>)
CONFIRM_NO(S, r, event) ==
  LET y == event[3]
  IN IF y = << "no" >>
     THEN Step("CONFIRM-NO", "answer(no)", event, S, Err(Fault("'" \o r.prompt \o "' was answered no", r.at)), << >>)
     ELSE Step("CONFIRM-NO", "no-answer", event, S,
               Err(Fault("no answer to '" \o r.prompt \o "': " \o y[2], r.at)), << >>)

(* {2 Errors} *)

WATCH_1(s, r) == By(s, "WATCH-1", Next_([ r EXCEPT !.body = s.out[2] ]))
WATCH_2(s) == By(s, "WATCH-2", Done_)
WATCH_IGNORE(s) == By(s, "WATCH-IGNORE", Done_)
WATCH_PROPAGATE(s, fault) == By(s, "WATCH-PROPAGATE", Err(fault))
WATCH_HALT(s, m) == By(s, "WATCH-HALT", Ends(Halted(m)))

(* The task in the place of that of r has no vehicles yet. *)
Anew(r, t, deeper) ==
  LET q == r.anew[1]
  IN [ op |-> "unallocated", task |-> t, allowed |-> q.allowed, place |-> q.place, depth |-> q.depth + deeper ]

WATCH_RETRY(s, r) == By(s, "WATCH-RETRY", Next_([ r EXCEPT !.body = Anew(r, r.anew[1].task, 0) ]))
WATCH_INSTEAD(s, r, t) == By(s, "WATCH-INSTEAD", Next_(Anew(r, t, 1)))

TooManyInstead(r) ==
  Fault("tasks in the place of tasks that failed nest more than " \o ToString(Deepest) \o " deep", -r.handler[2])
ForeignRetry(r) ==
  Fault("retry() was called for another handler than that in whose text it stands", -r.handler[2])

(* The error, with the vehicle and the task that failed, if it was one. *)
ErrorOf(fault) ==
  << String(fault.message) >>
  \o (IF fault.failed = << >> THEN << Null, Null >>
      ELSE << Vehicles(<< fault.failed[1] >>), String(fault.failed[2]) >>)

(* The handler runs in the step that failed; S is the part seen from this watch. *)
Handled(S, s, r) ==
  LET after(run) ==
        Asking([ s EXCEPT !.S = run.S, !.deeds = @ \o run.deeds ], EffectsOf(run.deeds))
      by(run) ==
        CASE run.is = "halt" -> WATCH_HALT(after(run), run.value)
          [] run.is = "fault" /\ run.value.assertion -> ASSERT_ERR(after(run), run.value)
          [] run.is = "fault" -> WATCH_PROPAGATE(after(run), run.value)
          [] r.anew # << >> /\ Is(run.value, "task") ->
               IF r.anew[1].depth >= Deepest THEN WATCH_PROPAGATE(after(run), TooManyInstead(r))
               ELSE WATCH_INSTEAD(after(run), r, TaskOf(run.value))
          [] run.verdict = "retry" ->
               IF r.anew = << >> THEN WATCH_PROPAGATE(after(run), ForeignRetry(r)) ELSE WATCH_RETRY(after(run), r)
          [] run.verdict = "ignore" -> WATCH_IGNORE(after(run))
          [] OTHER -> WATCH_PROPAGATE(after(run), s.out[2])
      seen == [ s.S EXCEPT !.beside = S.beside, !.around = S.beside \o S.around ]
  IN Each(RunCode(seen, "handler", r.handler, ErrorOf(s.out[2])), by)

InWatch(S, s, r) ==
  CASE GoesOn(s) -> << WATCH_1(s, r) >>
    [] IsDone(s) -> << WATCH_2(s) >>
    [] IsErr(s) -> Handled(S, s, r)
    [] OTHER -> << s >>

(* {2 Rounds} *)

(* s, by which the next round begins. *)
Again(s, rule, r) ==
  LET round == Act(r.each)
      left == IF r.left = << >> THEN << >> ELSE << r.left[1] - 1 >>
  IN Entering(By(s, rule, Next_(Repeat(round, [ r EXCEPT !.left = left ]))), round)

REPEAT_1(s, r) == By(s, "REPEAT-1", Next_([ r EXCEPT !.runs = << s.out[2] >> ]))
REPEAT_2(s, r) ==
  IF r.until = << >> THEN Again(s, "REPEAT-2", r) ELSE By(s, "REPEAT-2", Next_([ r EXCEPT !.runs = << >> ]))
REPEAT_UNTIL(run) == CodeStep("REPEAT-UNTIL", Labelled("check", run.deeds), run, Done_)
REPEAT_AGAIN(S, r) ==
  Again([ Step("", "check", Program, S, Done_, << >>) EXCEPT !.rules = << >> ], "REPEAT-AGAIN", r)
REPEAT_ERR(s) == By(s, "REPEAT-ERR", s.out)

InRepeat(s, r) ==
  CASE GoesOn(s) -> REPEAT_1(s, r)
    [] IsDone(s) -> REPEAT_2(s, r)
    [] IsErr(s) -> REPEAT_ERR(s)
    [] OTHER -> s

(* {2 Tasks made at their turn} *)

Unallocated(r, t) ==
  [ op |-> "unallocated", task |-> t, allowed |-> r.allowed, place |-> r.place, depth |-> r.depth + 1 ]

OnlyComputes(code) ==
  "{ " \o LambdaNames[code[2]] \o " }"
  \o " makes a task, so it may only compute: it must not post, consume, assign or print"

(* Why the code of r made no task, though it ran: << >>, if it did. *)
WhyNotMade(S, r, run) ==
  LET lambda == Lambdas[r.code[2]]
      n == Len(r.given)
      text == "{ " \o LambdaNames[r.code[2]] \o " }"
      many(i) == ToString(i) \o " value" \o (IF i = 1 THEN "" ELSE "s")
  IN CASE lambda.parameters > n /\ ~lambda.implicit ->
            << text \o " takes " \o many(lambda.parameters) \o ", and its guard took "
               \o (IF n = 0 THEN "none" ELSE many(n)) >>
       [] r.depth >= Deepest ->
            << "closures in tasks that closures give nest more than " \o ToString(Deepest)
               \o " deep: write an endless loop as repeat" >>
       [] run.deeds # << >> \/ run.S.store # S.store ->
            << OnlyComputes(r.code) >>
       [] ~IsTask(run.value) -> << text \o ": " \o Sentence(Expected("a task", run.value)) >>
       [] OTHER -> << >>

MAKE(S, r, run) ==
  Step("MAKE", "make", Program, Knowing(S, run.S.sees), Next_(Unallocated(r, TaskOf(run.value))), << >>)
MAKE_ERR(s) == By(s, "MAKE-ERR", s.out)

(* {2 Fresh keys} *)

RECURSIVE HasFresh(_)
HasFresh(t) ==
  CASE t.op = "fresh" -> TRUE
    [] t.op \in { "seq", "par" } -> HasFresh(t.left) \/ HasFresh(t.right)
    [] t.op \in { "allOf", "oneOf" } -> \E j \in DOMAIN t.branches : HasFresh(t.branches[j].body)
    [] t.op \in { "on", "until", "during", "watch", "repeat", "ensure" } -> HasFresh(t.body)
    [] OTHER -> FALSE

(* The task t, the last key of which has the i-th number; or the fault of its code. *)
OpenedAs(S, t, i) == [ S |-> S, t |-> t, i |-> i, why |-> << >> ]
Unopened(S, t, i, fault) == [ OpenedAs(S, t, i) EXCEPT !.why = << fault >> ]
And(outcomes, F(_)) == Flatten(Each(outcomes, LAMBDA o : IF o.why = << >> THEN F(o) ELSE << o >>))

(* t with the task of each fresh in it, of keys with the numbers after the i-th, from left to right: once for each
   outcome that the code may have by the sensors. A handler that retries its task keeps it unopened. *)
RECURSIVE Opened(_, _, _, _, _)
Opened(S, t, i, depth, q) ==
  CASE ~HasFresh(t) -> << OpenedAs(S, t, i) >>
    [] t.op \in { "seq", "par" } ->
         And(Opened(S, t.left, i, depth, q),
             LAMBDA o : And(Opened(o.S, t.right, o.i, depth, q),
                            LAMBDA p : << OpenedAs(p.S, [ t EXCEPT !.left = o.t, !.right = p.t ], p.i) >>))
    [] t.op = "watch" ->
         And(Opened(S, t.body, i, depth, q),
             LAMBDA o : << OpenedAs(o.S, [ t EXCEPT !.body = o.t ] @@ [ closed |-> t.body ], o.i) >>)
    [] t.op \in { "on", "until", "during", "repeat", "ensure" } ->
         And(Opened(S, t.body, i, depth, q), LAMBDA o : << OpenedAs(o.S, [ t EXCEPT !.body = o.t ], o.i) >>)
    [] t.op \in { "allOf", "oneOf" } ->
         LET upTo[j \in 0 .. Len(t.branches)] ==
               IF j = 0 THEN << OpenedAs(S, << >>, i) >>
               ELSE And(upTo[j - 1],
                        LAMBDA o : And(Opened(o.S, t.branches[j].body, o.i, depth, q),
                                       LAMBDA p : << OpenedAs(p.S, Append(o.t, [ t.branches[j] EXCEPT !.body = p.t ]),
                                                              p.i) >>))
         IN And(upTo[Len(t.branches)], LAMBDA o : << OpenedAs(o.S, [ t EXCEPT !.branches = o.t ], o.i) >>)
    [] t.op = "fresh" ->
         LET count == Lambdas[t.code[2]].parameters
             keys == << >> \o [ j \in 1 .. count |-> KeyNumber(i + j, q) ]
             r == [ code |-> t.code, given |-> Each(keys, LAMBDA k : String(KeyText(k))), depth |-> depth ]
             wrong(run, message, at) == << Unopened(Knowing(S, run.S.sees), t, i, Fault(message, at)) >>
             of(run) ==
               CASE run.is = "fault" -> wrong(run, run.value.message, run.value.at)
                 [] run.is = "halt" -> wrong(run, OnlyComputes(t.code), -t.code[2])
                 [] IsReading(run.value) -> Assert(FALSE, OpenHere(run.value[3], -t.code[2]))
                 [] WhyNotMade(S, r, run) # << >> -> wrong(run, WhyNotMade(S, r, run)[1], -t.code[2])
                 [] OTHER -> And(Opened(Knowing(S, run.S.sees), TaskOf(run.value), i + count, depth + 1, q),
                                 LAMBDA o : << OpenedAs(o.S, [ op |-> "fresh", keys |-> keys, body |-> o.t ], o.i) >>)
         IN Flatten(Each(RunCode(S, "task", t.code, r.given), of))

FRESH_1(s, r) == By(s, "FRESH-1", Next_([ r EXCEPT !.body = s.out[2] ]))
FRESH_2(s, r) == Forgetting(By(s, "FRESH-2", Done_), r.keys)
FRESH_ERR(s, r) == Forgetting(By(s, "FRESH-ERR", s.out), r.keys)

InFresh(s, r) ==
  CASE GoesOn(s) -> FRESH_1(s, r)
    [] IsDone(s) -> FRESH_2(s, r)
    [] IsErr(s) -> FRESH_ERR(s, r)
    [] OTHER -> s

(* {2 Ends} *)

ENSURE_1(s, r) == By(s, "ENSURE-1", Next_([ r EXCEPT !.body = s.out[2] ]))
ENSURE_2(s, r) == Ensuring(By(s, "ENSURE-2", Done_), r.ensured)
ENSURE_ERR(s, r) == Ensuring(By(s, "ENSURE-ERR", s.out), r.ensured)

InEnsure(s, r) ==
  CASE GoesOn(s) -> ENSURE_1(s, r)
    [] IsDone(s) -> ENSURE_2(s, r)
    [] IsErr(s) -> ENSURE_ERR(s, r)
    [] OTHER -> s

(* {2 Vehicles at the turn} *)

Hold(V, r) == IF V = << >> THEN r ELSE [ op |-> "hold", vehicles |-> V, body |-> r ]

ALLOCATE(S, found) ==
  LET r == Act(found.r)
  IN Entering(Step("ALLOCATE", "allocate(" \o Join(found.vehicles, ", ") \o ")", Program, S,
                   Next_(Hold(found.vehicles, r)), << >>), r)
ALLOCATE_ERR(S, fault) ==
  Step("ALLOCATE-ERR", "cannot-execute(" \o fault.message \o ")", Program, S, Err(fault), << >>)

HOLD_1(s, r) == By(s, "HOLD-1", Next_([ r EXCEPT !.body = s.out[2] ]))
HOLD_2(s) == By(s, "HOLD-2", Done_)
HOLD_ERR(s) == By(s, "HOLD-ERR", s.out)

InHold(s, r) ==
  CASE GoesOn(s) -> HOLD_1(s, r)
    [] IsDone(s) -> HOLD_2(s)
    [] IsErr(s) -> HOLD_ERR(s)
    [] OTHER -> s

(* alloc(t, V) for the free V of B; an error, if not even all of B would do; or it waits. Those that were recruited
   for the part are in its B. *)
AllocateSteps(S, r) ==
  LET held == HeldBy(S.beside)
      bound == B \o S.recruits
      free == SelectSeq(bound, LAMBDA v : v \notin held)
      within(V) == << IF r.allowed = << >> THEN V ELSE Intersection(r.allowed[1], V) >>
      used == NumbersIn(S.whole)
      q(o) == [ allowed |-> r.allowed, place |-> r.place, depth |-> r.depth, bound |-> bound, used |-> used,
                numbers |-> IF o = << >> THEN << >>
                            ELSE FreshTimers(r.place, used, o[1].i + TimerCount(o[1].t, FALSE)) ]
      alloc(o, allowed, sees) == AllocWithin(o.t, o.i, allowed, q(<< o >>), sees)
      outcome(S2, found, any) ==
        CASE IsOk(found) -> << ALLOCATE(S2, found[2]) >>
          [] IsOk(any) -> << >>
          [] OTHER -> << ALLOCATE_ERR(S2, any[2]) >>
      at(o, sees) == Only({ outcome(Knowing(S, sees), found, alloc(o, r.allowed, sees)) :
                            found \in { alloc(o, within(free), sees) } })
      of(o) ==
        IF o.why # << >> THEN << ALLOCATE_ERR(o.S, o.why[1]) >>
        ELSE Flatten(Each(Placings(o.S.sees, IF DependsOnPlaces(o.t) THEN bound ELSE << >>),
                          LAMBDA sees : at(o, sees)))
      outcomes == Flatten(Each(Opened(S, r.task, 0, r.depth, q(<< >>)), of))
  IN IF outcomes = << >> THEN << >> ELSE << outcomes >>

(* {2 Recruits} *)

(* The event is there only for vehicles that fit, and that no part of the task names: DolphinEnvironment. *)
RECRUIT(S, r, e) ==
  LET made == [ op |-> "made", code |-> r.code, given |-> << Vehicles(<< e[3] >>) >>, allowed |-> << << e[3] >> >>,
                place |-> r.place, depth |-> r.depth ]
  IN Step("RECRUIT", "recruit(" \o e[3] \o ")", e, S, Next_([ op |-> "recruited", v |-> e[3], body |-> made ]),
          << << "bind", << e[3] >> >> >>)

RECRUIT_1(s, r) == By(s, "RECRUIT-1", Next_([ r EXCEPT !.body = s.out[2] ]))
RECRUIT_2(s, r) == Asking(By(s, "RECRUIT-2", Done_), Releasing(<< r.v >>))
RECRUIT_ERR(s, r) == Asking(By(s, "RECRUIT-ERR", s.out), Releasing(<< r.v >>))

InRecruited(s, r) ==
  CASE GoesOn(s) -> RECRUIT_1(s, r)
    [] IsDone(s) -> RECRUIT_2(s, r)
    [] IsErr(s) -> RECRUIT_ERR(s, r)
    [] OTHER -> s

(* {2 All steps of r} *)

(* The code that r looks at: of an action, a condition, guards, a duration that is not known yet. *)
CodeOf(r) ==
  CASE r.op \in { "action", "condition" } -> << r.code >>
    [] r.op = "oneOf" \/ (r.op = "allOf" /\ r.runs = << >>) -> Each(r.choices, LAMBDA b : b.guard)
    [] r.op = "until" -> << r.guard >>
    [] r.op = "during" /\ ~r.started -> << r.time >>
    [] r.op = "repeat" /\ r.runs = << >> -> r.until
    [] r.op = "made" -> << r.code >>
    [] OTHER -> << >>

(* The steps of r when its j-th code is faulty. *)
WithFault(r, s) ==
  CASE r.op = "action" -> ACTION_ERR(s)
    [] r.op = "during" -> DURING_ERR(s, r)
    [] r.op = "condition" -> CONDITION_ERR(s)
    [] r.op = "allOf" -> ALLOF_ERR(s)
    [] r.op = "oneOf" -> ONEOF_ERR(s)
    [] r.op = "until" -> UNTIL_ERR(s, << r.body >>)
    [] r.op = "repeat" -> REPEAT_ERR(s)
    [] r.op = "made" -> MAKE_ERR(s)

(* ... when it gave a value; guards that are not true do nothing. *)
WithValue(S, r, j, run) ==
  CASE r.op = "action" -> << ACTION_(run) >>
    [] IsReading(run.value) -> Assert(FALSE, OpenHere(run.value[3], -CodeOf(r)[j][2]))
    [] r.op = "made" ->
         LET why == WhyNotMade(S, r, run)
         IN << IF why = << >> THEN MAKE(S, r, run)
               ELSE WithFault(r, Broken(Knowing(S, run.S.sees), Fault(why[1], -r.code[2]), << >>)) >>
    [] r.op = "during" ->
         << IF IsTime(run.value) THEN DURING_SET(run, r, Time(run.value))
            ELSE WithFault(r, Broken(Knowing(S, run.S.sees), NoTime(run.value, r.time), run.deeds)) >>
    [] r.op = "until" /\ r.fails # << >> ->
         IF Truth(run.value) THEN << >> ELSE << ASSURE_CUT(Knowing(S, run.S.sees), r) >>
    [] r.op = "repeat" -> << IF Truth(run.value) THEN REPEAT_UNTIL(run) ELSE REPEAT_AGAIN(Knowing(S, run.S.sees), r) >>
    [] ~Truth(run.value) -> << >>
    [] r.op = "condition" -> << CONDITION(run) >>
    [] r.op = "allOf" -> << ALLOF_WHEN(run, r.choices, j) >>
    [] r.op = "oneOf" -> << ONEOF_WHEN(run, r.choices[j]) >>
    [] r.op = "until" -> << UNTIL_CUT(run, r) >>

WithCode(S, r, j, run) ==
  LET broken == Broken(run.S, run.value, run.deeds)
  IN CASE run.is = "value" -> WithValue(S, r, j, run)
       [] run.is = "halt" -> << HALT(run) >>
       [] run.is = "fault" -> << IF run.value.assertion THEN ASSERT_ERR(broken, run.value) ELSE WithFault(r, broken) >>

CodeSteps(S, r) ==
  LET codes == CodeOf(r)
      given == IF r.op = "made" THEN r.given ELSE << >>
      of(j) == Flatten(Each(RunCode(S, "task", codes[j], given), LAMBDA run : WithCode(S, r, j, run)))
  IN IF codes = << >> THEN << >>
     ELSE SelectSeq(<< >> \o [ j \in DOMAIN codes |-> of(j) ], LAMBDA outcomes : outcomes # << >>)

(* A step that does not depend on sensors; steps of a part, in its surroundings. Mostly there is one outcome, which
   TLC need not make a function for. *)
Always(s) == << s >>
In(steps, F(_)) == Each(steps, LAMBDA outcomes : IF Len(outcomes) = 1 THEN << F(outcomes[1]) >> ELSE Each(outcomes, F))

(* The steps, each by F, on those of the events E that are awaited. *)
OnThose(E, Awaits(_), F(_)) == Each(SelectSeq(E, Awaits), LAMBDA e : Always(F(e)))

EndsOn(S, r, E) ==
  OnThose(E, LAMBDA e : e[1] \in { "done", "failed" } /\ e[2] = r.v,
          LAMBDA e : IF e[1] = "done" THEN DONE(S, r) ELSE FAIL(S, r, e[3]))

ExpiresOn(S, r, E) ==
  LET expired ==
        CASE r.op = "idle" -> IDLE_END(S, r)
          [] r.fails = << >> -> DURING_CUT(S, r)
          [] OTHER -> WITHIN_CUT(S, r)
  IN OnThose(E, LAMBDA e : e = Expired(r.timer), LAMBDA e : expired)

AnswersOn(S, r, E) ==
  OnThose(E, LAMBDA e : e[1] = "confirmed" /\ e[2] = r.timer,
          LAMBDA e : IF e[3] = << "yes" >> THEN CONFIRM_YES(S, e) ELSE CONFIRM_NO(S, r, e))

(* S for a part of S, which rs may follow. *)
Amid(S, rs) == [ S EXCEPT !.around = @ \o rs ]
Bodies(choices) == Each(choices, LAMBDA b : b.body)

RECURSIVE Steps(_, _, _)
Steps(S, r, E) ==
  CodeSteps(S, r) \o
  CASE r.op = "ready" -> << Always(START(S, r)) >>
    [] r.op = "running" -> EndsOn(S, r, E)
    [] r.op = "seq" -> In(Steps(Amid(S, r.rest), r.first, E), LAMBDA s : InSequence(s, r.rest))
    [] r.op = "par" ->
         Flatten([ j \in DOMAIN r.branches |->
                   In(Steps([ S EXCEPT !.beside = @ \o Without(r.branches, j) ], r.branches[j], E),
                      LAMBDA s : InParallel(s, r.branches, j)) ])
    [] r.op = "allOf" /\ r.runs # << >> ->
         In(Steps(Amid(S, Bodies(r.choices)), r.runs[1], E), LAMBDA s : InAllOf(s, r.choices))
    [] r.op = "until" -> In(Steps(S, r.body, E), LAMBDA s : InUntil(s, r))
    [] r.op = "unallocated" -> AllocateSteps(S, r)
    [] r.op = "hold" -> In(Steps(S, r.body, E), LAMBDA s : InHold(s, r))
    [] r.op = "fresh" -> In(Steps(S, r.body, E), LAMBDA s : InFresh(s, r))
    [] r.op = "ensure" -> In(Steps(S, r.body, E), LAMBDA s : InEnsure(s, r))
    [] r.op = "recruit" ->
         OnThose(E, LAMBDA e : e[1] = "recruited" /\ e[2] = r.timer, LAMBDA e : RECRUIT(S, r, e))
    [] r.op = "recruited" ->
         In(Steps([ S EXCEPT !.recruits = Append(@, r.v) ], r.body, E), LAMBDA s : InRecruited(s, r))
    [] r.op = "idle" -> ExpiresOn(S, r, E)
    [] r.op = "confirm" -> AnswersOn(S, r, E)
    [] r.op = "during" /\ r.started -> ExpiresOn(S, r, E) \o In(Steps(S, r.body, E), LAMBDA s : InDuring(s, r))
    [] r.op = "repeat" /\ r.runs # << >> -> In(Steps(Amid(S, << r.each >>), r.runs[1], E), LAMBDA s : InRepeat(s, r))
    [] r.op = "watch" ->
         Each(Steps(S, r.body, E), LAMBDA outcomes : Flatten(Each(outcomes, LAMBDA s : InWatch(S, s, r))))
    [] OTHER -> << >>

-----------------------------------------------------------------------------
(* {1 Transitions of configurations} *)

Transition(rule, label, event, kappa, S, effects) ==
  [ rules |-> << rule >>, label |-> label, event |-> event, control |-> kappa, S |-> S, effects |-> effects,
    deeds |-> << >> ]

(* The step s, as a transition to kappa. *)
Becoming(s, kappa) ==
  [ rules |-> s.rules, label |-> s.label, event |-> s.event, control |-> kappa, S |-> s.S, effects |-> s.effects,
    deeds |-> s.deeds ]

(* ended(S, e) by the step s: it cancels the timers that s does not cancel, stops all vehicles, releases all of B,
   and those recruited ones of V that s does not release. *)
EndedBy(s, timers, V) ==
  LET gone == UNION { IF e[1] = "release" THEN Range(e[2]) ELSE { } : e \in Range(s.effects) }
      bound == s.S.B \o SelectSeq(V, LAMBDA v : v \notin gone)
      running == SelectSeq(CancelTimers(timers), LAMBDA cancel : cancel \notin Range(s.effects))
      stops == Each(SelectSeq(bound, LAMBDA v : v \in DOMAIN s.S.A), LAMBDA v : << "stop", v >>)
      released == Releasing(bound)
      asking == Asking(s, running \o stops \o released \o << << "end", s.out[2] >> >>)
  IN Becoming(ForgettingAll([ asking EXCEPT !.S.A = << >>, !.S.B = << >> ]), Ended(s.out[2]))

(* The same where no timer runs any more. *)
EndStep(rule, label, event, S, ending) == EndedBy(Step(rule, label, event, S, Ends(ending), << >>), << >>, << >>)

(* Of the outcomes of a step, the first of those with the same label and the same result. *)
Different(ts) ==
  LET result(t) == << t.label, t.control, Knowing(t.S, NothingSeen) >>
      isNew(j) == \A i \in 1 .. j - 1 : result(ts[i]) # result(ts[j])
  IN IF Len(ts) < 2 THEN ts ELSE Each(SelectSeq([ j \in DOMAIN ts |-> j ], isNew), LAMBDA j : ts[j])

(* {2 Deeds of the script} *)

(* m is the machine after it ran from M, S the shared part then. *)
DeedOf(m) == m.deeds[1]
DeedStep(rule, m, S) ==
  [ Transition(rule, DeedText(DeedOf(m)), Program, Script(Machine(m)), S, EffectsOf(m.deeds)) EXCEPT !.deeds = m.deeds ]

SCRIPT(m, S) == Transition("SCRIPT", "script", Program, Script(Machine(m)), S, << >>)
POST(m, S) == DeedStep("POST", m, S)
CONSUME(m, S) == DeedStep("CONSUME", m, S)
MESSAGE(m, S) == DeedStep("MESSAGE", m, S)
RELEASE(m, S) == DeedStep("RELEASE", m, WithoutA(S, Range(DeedOf(m).vehicles)))
SET_TIMEOUT(m, S) == DeedStep("SET-TIMEOUT", m, S)

Deed(m, S) ==
  CASE DeedOf(m).did = "post" -> POST(m, S)
    [] DeedOf(m).did = "consume" -> CONSUME(m, S)
    [] DeedOf(m).did = "message" -> MESSAGE(m, S)
    [] DeedOf(m).did = "release" -> RELEASE(m, S)
    [] DeedOf(m).did = "timeout" -> SET_TIMEOUT(m, S)

(* {2 Waiting begins} *)

WaitStep(rule, label, m, S, effects) ==
  Transition(rule, label, Program, Waiting(Machine(m), m.stop[2]), S, effects)

PICK_(m, S, q) == WaitStep("PICK", "pick(" \o PickText(q) \o ")", m, S, << << "look for", q >> >>)
ASK(m, S, x) == WaitStep("ASK", "ask(" \o x \o ")", m, S, << << "ask", x >> >>)
PAUSE(m, S, n) == WaitStep("PAUSE", "pause(" \o ShortText(n) \o ")", m, S, << << "set timer", ScriptTimer, n >> >>)
CALL(m, S, call, arguments) == WaitStep("CALL", "call(" \o call \o ")", m, S, << << "call", call, arguments >> >>)

EXECUTE(m, S, r) ==
  LET active == Act(r)
      t == Transition("EXECUTE", "execute", Program, Executing(Machine(m), active), S, SetTimers(Timers(active)))
  IN Forgetting(t, Keys(active))
ALLOC_ERR(S, fault) ==
  EndStep("ALLOC-ERR", "cannot-execute(" \o fault.message \o ")", Program, S, FailedFor("vehicles", fault))

ExecuteSteps(m, S, t) ==
  LET step(allocated) == IF IsOk(allocated) THEN EXECUTE(m, S, allocated[2].r) ELSE ALLOC_ERR(S, allocated[2])
      of(o) ==
        IF o.why # << >> THEN << ALLOC_ERR(S, o.why[1]) >>
        ELSE Each(Placings(o.S.sees, IF DependsOnPlaces(o.t) THEN B ELSE << >>),
                  LAMBDA sees : Only({ step(allocated) : allocated \in { Alloc(o.t, o.i, sees) } }))
  IN Flatten(Each(Opened(S, t, 0, 0, Executed), of))

Wait(m, S, request) ==
  CASE request[1] = "pick" -> << PICK_(m, S, request[2]) >>
    [] request[1] = "ask" -> << ASK(m, S, request[2]) >>
    [] request[1] = "pause" -> << PAUSE(m, S, request[2]) >>
    [] request[1] = "call" -> << CALL(m, S, request[2], request[3]) >>
    [] request[1] = "execute" -> ExecuteSteps(m, S, request[2])

(* {2 Ends} *)

END(S) == EndStep("END", "end", Program, S, Completed)
EndOfLeaving(S) == EndStep("END", "end", Program, S, Interrupted)
FAULT(S, fault) == EndStep("FAULT", "fault(" \o fault.message \o ")", Program, S, Failed(fault))

(* HALT is with the rules of tasks: by the script nothing else is done in its step. *)
HaltOfScript(S, m) == EndedBy(HALT([ value |-> m, S |-> S, deeds |-> << >> ]), << >>, << >>)

TimersOf(kappa) ==
  CASE kappa.at = "exec" -> Timers(kappa.r)
    [] kappa.at = "wait" /\ kappa.request[1] \in { "pick", "pause" } -> << [ i |-> ScriptTimer ] >>
    [] OTHER -> << >>

EnsuredOf(kappa) == IF kappa.at = "exec" THEN EnsuredIn(kappa.r) ELSE << >>

(* The running task is cut off; the task of onInterrupt gets the vehicles of B, and the recruited ones. *)
ON_INTERRUPT(kappa) ==
  LET bound == B \o RecruitsOf(kappa)
      stops == Each(SelectSeq(bound, LAMBDA v : v \in DOMAIN A), LAMBDA v : << "stop", v >>)
      t == Transition("ON-INTERRUPT", "interrupt", Interruption, Script(Call(OnInterrupt[1], << Vehicles(bound) >>)),
                      [ Shared EXCEPT !.A = << >>, !.B = bound ], CancelTimers(TimersOf(kappa)) \o stops)
  IN ForgettingAll(Ensuring(t, EnsuredOf(kappa)))

INTERRUPT(kappa) ==
  EndedBy(Ensuring(Step("INTERRUPT", "interrupt", Interruption, Shared, Ends(Interrupted), << >>), EnsuredOf(kappa)),
          TimersOf(kappa), RecruitsOf(kappa))

(* Of a configuration that is not an end. *)
Interrupt(kappa) ==
  IF OnInterrupt # << >> /\ B \o RecruitsOf(kappa) # << >> /\ ~IsLeaving(kappa.M) THEN ON_INTERRUPT(kappa)
  ELSE INTERRUPT(kappa)

(* {2 Inputs} *)

(* Whatever the control is, but an end. *)
INPUT(kappa, k, x, isCertain) ==
  [ Transition("INPUT", "input " \o PairText(<< k, x >>), Posted(k, x, isCertain), kappa,
               [ Shared EXCEPT !.N = Post(@, k, x) ], << >>)
    EXCEPT !.deeds = << [ did |-> "post", pairs |-> << << k, x >> >> ] >> ]

ScriptSteps(M) ==
  LET of(m, S) ==
        CASE m.stop[1] = "did" -> << Deed(m, S) >>
          [] m.stop[1] = "waits" -> Wait(m, S, m.stop[2])
          [] m.stop[1] = "finished" -> << END(S) >>
          [] m.stop[1] = "left off" -> << EndOfLeaving(S) >>
          [] m.stop[1] = "halted" -> << HaltOfScript(S, m.stop[2]) >>
          [] m.stop[1] = "faulted" -> << FAULT(S, m.stop[2]) >>
          [] m.stop[1] = "exhausted" -> << SCRIPT(m, S) >>
  IN Different(Flatten(Each(Run(M, Shared, "script", ScriptFuel), LAMBDA m : of(m, Over(After(Shared, m))))))

(* {2 Picking vehicles} *)

(* A world w: its vehicles, in the order in which they were heard of; the missing ones, which are silent now; and the
   places where vehicles are seen. *)

(* Wherever it is. *)
Accepts(q, vehicle) ==
  /\ q.id = << >> \/ q.id[1] = vehicle.id
  /\ q.type = << >> \/ q.type[1] = vehicle.type
  /\ Carries(vehicle, q.payload)

IsInRegion(q, w, vehicle) == q.region = << >> \/ Within(q.region[1], FoundAt(vehicle, w.sees))

(* fit(q, w, B) *)
Fit(q, w) ==
  LET meets(vehicle) == /\ Accepts(q, vehicle)
                        /\ vehicle.id \notin Range(B) \cup Range(w.missing)
                        /\ IsInRegion(q, w, vehicle)
  IN Each(SelectSeq(w.vehicles, meets), LAMBDA vehicle : vehicle.id)

WhyNot(q, w, vehicle) ==
  vehicle.id \o " " \o
  CASE vehicle.id \in Range(B) -> "is already bound"
    [] vehicle.id \in Range(w.missing) -> "is not connected"
    [] q.id # << >> /\ q.id[1] # vehicle.id -> "has another id"
    [] q.type # << >> /\ q.type[1] # vehicle.type -> "is a " \o vehicle.type
    [] ~Carries(vehicle, q.payload) ->
         "lacks " \o Join(SelectSeq(q.payload, LAMBDA d : ~Carries(vehicle, << d >>)), ", ")
    [] ~IsInRegion(q, w, vehicle) -> "is at " \o Places[FoundAt(vehicle, w.sees)] \o ", outside of the region"
    [] OTHER -> "fits"

NoVehicles(q, w) ==
  LET shown == SubSeq(w.vehicles, 1, Clipped(8, 0, Len(w.vehicles)))
      more == Len(w.vehicles) - Len(shown)
      there == IF w.vehicles = << >> THEN "no vehicle was heard of"
               ELSE Join(Each(shown, LAMBDA vehicle : WhyNot(q, w, vehicle)), "; ")
                    \o (IF more > 0 THEN "; and " \o ToString(more) \o " more" ELSE "")
  IN "could not pick " \o PickText(q) \o ": " \o there

(* All sequences of n elements of xs in their order, the first ones first. *)
RECURSIVE Choices(_, _)
Choices(n, xs) ==
  CASE n = 0 -> << << >> >>
    [] n > Len(xs) -> << >>
    [] OTHER -> Each(Choices(n - 1, Tail(xs)), LAMBDA chosen : << Head(xs) >> \o chosen) \o Choices(n, Tail(xs))

PICK_BIND(M, V, event) ==
  Transition("PICK-BIND", "bind(" \o Join(V, ", ") \o ")", event, Script(GoOn(M, Vehicles(V))),
             [ Shared EXCEPT !.B = @ \o V ],
             (IF event = Program THEN << << "cancel timer", ScriptTimer >> >> ELSE << >>) \o << << "bind", V >> >>)
PICK_ERR(M, q, w) ==
  EndStep("PICK-ERR", "no-vehicles(" \o NoVehicles(q, w) \o ")", Expired(ScriptTimer), Shared,
          FailedFor("vehicles", Fault(NoVehicles(q, w), M.at)))

PICK_ELSE(M, q, w) ==
  Transition("PICK-ELSE", "no-vehicles(" \o NoVehicles(q, w) \o ")", Expired(ScriptTimer), Script(GoOn(M, Null)),
             Shared, << >>)
TooFewFor(M, q, w) == IF q.otherwise THEN PICK_ELSE(M, q, w) ELSE PICK_ERR(M, q, w)

PickSteps(M, q, w) ==
  LET V == Fit(q, w)
  IN CASE q.all /\ V # << >> -> << PICK_BIND(M, V, Expired(ScriptTimer)) >>
       [] q.all \/ Len(V) < q.count -> << TooFewFor(M, q, w) >>
       [] OTHER -> Each(Choices(q.count, V), LAMBDA chosen : PICK_BIND(M, chosen, Program))

(* {2 Waiting ends} *)

ANSWER(M, text, y) ==
  Transition("ANSWER", "answer(" \o text \o ")", AnsweredWith(text), Script(Machine(GoOn(M, y))), Shared, << >>)
ANSWER_ERR(M, prompt, m) ==
  EndStep("ANSWER-ERR", "no-answer", NobodyAnswers(m), Shared,
          Failed(Fault("no answer to '" \o prompt \o "': " \o m, M.at)))

(* An answer is an expression over the program's variables, which may only compute a value: <<"ok", transitions>>; or
   it is refused: <<"wrong", m>>. *)
AnswerSteps(M, answer) ==
  LET isValue(run) == run.is = "value" /\ run.deeds = << >> /\ run.S.store = store
      by(runs) ==
        CASE \E j \in DOMAIN runs : isValue(runs[j]) ->
               Ok(Different(Each(SelectSeq(runs, isValue), LAMBDA run : ANSWER(M, answer.text, run.value))))
          [] runs[1].is = "fault" -> Bad(runs[1].value.message)
          [] OTHER -> Bad("an answer may only compute a value")
  IN IF answer.lambda = 0 THEN Bad(answer.why)
     ELSE Only({ by(runs) : runs \in { RunCode(Shared, "task", << "closure", answer.lambda, << >> >>, << >>) } })

RESUME(M) == Transition("RESUME", "resume", Expired(ScriptTimer), Script(GoOn(M, Null)), Shared, << >>)

REPLY(M, y) == Transition("REPLY", "reply(" \o Text(y) \o ")", Replied(y), Script(GoOn(M, y)), Shared, << >>)
CALL_ERR(M, call, m) ==
  EndStep("CALL-ERR", "no-reply(" \o m \o ")", HostFailed(m), Shared, Failed(Fault(call \o ": " \o m, M.at)))

(* {2 Executing tasks} *)

EXECUTE_DONE(M, s) == LET t == ForgettingAll(By(s, "EXECUTE-DONE", Done_)) IN Becoming(t, Script(GoOn(M, Null)))

(* The failure has cut off all that ran. *)
EXECUTE_ERR(s) == EndedBy(By(s, "EXECUTE-ERR", Ends(Failed(s.out[2]))), << >>, << >>)

(* Those of the timers that run after the event: the others but the one that expired, or was answered. *)
RunningAfter(event, timers) ==
  SelectSeq(timers, LAMBDA timer : ~ (event[1] \in { "expired", "confirmed" } /\ event[2] = timer.i))

InExecute(M, r, s) ==
  CASE GoesOn(s) -> Becoming(s, Executing(M, s.out[2]))
    [] IsDone(s) -> EXECUTE_DONE(M, s)
    [] IsErr(s) -> EXECUTE_ERR(s)
    [] OTHER -> EndedBy(s, RunningAfter(s.event, Timers(r)), Recruits(r))

(* Those that need no event, and those on the events E. *)
ExecutingSteps(M, r, E) ==
  LET in(s) == InExecute(M, r, IF HasReadings THEN [ s EXCEPT !.S = Over(@) ] ELSE s)
      alone(outcomes) == Len(outcomes) = 1
      all(steps) == IF \A j \in DOMAIN steps : alone(steps[j]) THEN Each(steps, LAMBDA outcomes : in(outcomes[1]))
                    ELSE Flatten(Each(steps, LAMBDA outcomes : Different(Each(outcomes, in))))
  IN Only({ all(steps) : steps \in { Steps([ Shared EXCEPT !.whole = << r >> ], r, E) } })
==============================================================================
