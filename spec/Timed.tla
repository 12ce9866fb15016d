---------------------------------- MODULE Timed ----------------------------------
(* Dolphin with time, by Lamport's old-fashioned recipe: a variable now, an action *)
(* Tick that counts it up, and bounds before and after which no awaited event may  *)
(* happen. The effects of events are those of DolphinEnvironment: a run without    *)
(* its times is one of those there. Time is counted in ticks.                      *)
(* All bounds include their ends and are whole numbers of ticks, so the earliest   *)
(* and latest dates of runs in continuous time are reached by runs in ticks.       *)
(* docs/semantics.md has the same rules, "Runs with time"; lib/time runs them.     *)
EXTENDS DolphinChecking

CONSTANTS
  TickLength,   \* how many milliseconds a tick has
  Lasts(_, _),  \* how long the plan of this name takes on a vehicle: bounds, as below, but in milliseconds
  Posts(_),     \* likewise, until a pair with this key is posted, from the start or from the time before
  CodeDates,    \* the dates after the start at which code that reads the date may come to do something else, in
                \* seconds and in ascending order
  Announced,    \* the time-out of a pick that has none, in milliseconds
  Silence,      \* how long nothing is heard of a vehicle before its task fails, unless the program says so; likewise
  Links,        \* the changes of links, one after another: whose link comes or goes, and when, in milliseconds
  SilentAtFirst,  \* the vehicles that are not heard of at the start, in the order in which they are
  Horizon       \* so many ticks are looked at

VARIABLES
  now,      \* ticks since the start
  awaited,  \* all that is awaited: since when, and within what bounds from then on
  changes,  \* how many of Links there were
  patience  \* how long links may be silent: of vehicles of which the program has said so, and of all others

timedVars == << vars, now, awaited, changes, patience >>

(* The part that distinguishes states, for TLC. *)
TimedView == timedVars

TimedOK ==
  /\ { TickLength, Horizon } \subseteq Nat \ { 0 }
  /\ { Announced, Silence } \subseteq Nat

ASSUME TimedOK

-----------------------------------------------------------------------------
(* {1 Bounds} *)

(* <<least, most>>, both included; most is -1 without a bound. Or << >>, of events that never happen. *)
Unlimited == -1
AnyTime == << 0, Unlimited >>
AtOnce == << 0, 0 >>
Precisely(n) == << n, n >>

NoTicks(n, d) ==
  "a time of " \o ToString(n) \o (IF d = 1 THEN "" ELSE "/" \o ToString(d)) \o " ms is no whole number of ticks of "
  \o ToString(TickLength) \o " ms: make the model with a shorter --tick"

(* n/d milliseconds. *)
InTicks(n, d) ==
  IF n % (d * TickLength) = 0 THEN n \div (d * TickLength) ELSE Assert(FALSE, NoTicks(n, d))

BoundsInTicks(b) ==
  IF b = << >> THEN b ELSE << InTicks(b[1], 1), IF b[2] = Unlimited THEN Unlimited ELSE InTicks(b[2], 1) >>

(* A number of seconds, as the language has it. *)
Seconds(x) == InTicks(Numerator(x) * 1000, Denominator(x))

HasLinks == Links # << >> \/ SilentAtFirst # << >>

(* A time that is not longer than a and b, one after the other. *)
Added(a, b) == IF Unlimited \in { a, b } THEN Unlimited ELSE a + b

IsOver(most, age) == most # Unlimited /\ age > most

-----------------------------------------------------------------------------
(* {1 What is awaited} *)

Task(v) == << "task", v >>
Timer(i) == << "timer", i >>
Question(i) == << "question", i >>
Word == << "word" >>  \* of whom the script asks, or calls
Posting(k) == << "posting", k >>
Date(n) == << "date", n >>
SilenceOf(v) == << "silence", v >>  \* that v is given up

(* The next of the dates that code names. *)
NextDates(remembered) == { CodeDates[i] : i \in { i \in DOMAIN CodeDates : CodeDates[i] > remembered.date } }
NextDate(remembered) ==
  IF NextDates(remembered) = { } THEN { } ELSE { Date(Minimum(NextDates(remembered))) }

(* By which event an item is over; << >>, if none is. *)
ItemOf(event) ==
  CASE event[1] \in { "done", "failed" } -> Task(event[2])
    [] event[1] = "expired" -> Timer(event[2])
    [] event[1] = "confirmed" -> Question(event[2])
    [] event[1] \in { "answered", "nobody answers", "replied", "host failed" } -> Word
    [] event[1] = "input" -> Posting(event[2])
    [] event[1] = "recruited" -> << >>  \* at once, or at any time
    [] event \in { Program, Interruption } -> << >>

(* All that is awaited in a state. *)
ItemsOf(kappa, remembered) ==
  LET request == kappa.request[1]
      byControl ==
        CASE kappa.at = "exec" ->
               { Task(v) : v \in Range(Running(kappa.r)) }
               \cup { SilenceOf(v) : v \in Range(Running(kappa.r)) \cap Range(remembered.silent) }
               \cup { IF IsQuestion(timer) THEN Question(timer.i) ELSE Timer(timer.i) :
                      timer \in Range(Timers(kappa.r)) }
          [] kappa.at = "wait" ->
               { CASE request \in { "pick", "pause" } -> Timer(ScriptTimer) [] request \in { "ask", "call" } -> Word }
          [] OTHER -> { }
      mayCome(i) == remembered.sent[i] < Inputs[i].times
  IN byControl
     \cup (IF kappa.at = "end" THEN { }
           ELSE NextDate(remembered) \cup { Posting(Inputs[i].key) : i \in { i \in DOMAIN Inputs : mayCome(i) } })

(* How long the task p takes on v. *)
TaskLasts(v, p) ==
  IF p.plan = 0 THEN BoundsInTicks(Lasts(v, p.name))
  ELSE Assert(FALSE, "how long the plan '" \o p.name \o "' takes, which is described in the program, is not known here")

(* The item that begins by an effect, with its bounds: at most one. The time-out of a pick matters only if it waits,
   so it need not be a whole number of ticks: see PickTimeout. *)
BegunBy(e) ==
  CASE e[1] = "start" -> << << Task(e[2]), TaskLasts(e[2], e[3]) >> >>
    [] e[1] = "set timer" -> << << Timer(e[2]), Precisely(Seconds(e[3])) >> >>
    [] e[1] = "look for" -> << << Timer(ScriptTimer), AnyTime >> >>
    [] e[1] = "put question" -> << << Question(e[2]), AnyTime >> >>
    [] OTHER -> << >>

(* {2 Silent links} *)

SaidOfSilence(silent, e) ==
  CASE e[1] = "connection timeout" /\ e[2] = << >> -> [ others |-> Seconds(e[3]), of |-> << >> ]
    [] e[1] = "connection timeout" ->
         [ silent EXCEPT !.of = [ v \in Range(e[2][1]) |-> Seconds(e[3]) ] @@ @ ]
    [] OTHER -> silent

RECURSIVE PatienceAfter(_, _)
PatienceAfter(silent, effects) ==
  IF effects = << >> THEN silent ELSE PatienceAfter(SaidOfSilence(silent, Head(effects)), Tail(effects))

PatienceWith(v) ==
  CASE v \in DOMAIN patience.of -> patience.of[v]
    [] patience.others = Unlimited -> InTicks(Silence, 1)
    [] OTHER -> patience.others

(* Without any effect: words come at once, and pairs are awaited from the start, or from the time before. *)
ByItself(item, remembered) ==
  CASE item[1] = "posting" -> BoundsInTicks(Posts(item[2]))
    [] item[1] = "date" -> Precisely(InTicks((item[2] - remembered.date) * 1000, 1))
    [] item[1] = "silence" -> Precisely(PatienceWith(item[2]))
    [] OTHER -> AtOnce

(* Of a task that waits for the link, until it begins. *)
ClockOf(b, waits) == [ since |-> now, bounds |-> b, waits |-> waits ]
Clock(b) == ClockOf(b, FALSE)

(* The awaited items after the transition t. *)
AwaitedAfter(t) ==
  LET begun == Flatten(Each(t.effects, BegunBy))
      over == ItemOf(t.event)
      clock(item) ==
        LET latest == SelectSeq(begun, LAMBDA b : b[1] = item)
            waits == item[1] = "task" /\ item[2] \in Range(t.outside.silent)
        IN CASE latest # << >> -> ClockOf(Last(latest)[2], waits)
             [] item \in DOMAIN awaited /\ item # over -> awaited[item]
             [] OTHER -> Clock(ByItself(item, t.outside))
  IN [ item \in ItemsOf(t.control, t.outside) |-> clock(item) ]

-----------------------------------------------------------------------------
(* {1 When} *)

(* A vehicle comes late by this transition of a pick: the transition does not exist with only the vehicles that are
   there at once. *)
ComesLate(t) ==
  /\ control.at = "wait" /\ control.request[1] = "pick" /\ t.event = Program
  /\ LET q == control.request[2]
         nobody == [ coming |-> << >>, missing |-> << >> ]
         placings == Placings(NothingSeen, IF q.region = << >> THEN << >> ELSE Wanted(q))
         onTime == Flatten(Each(placings, LAMBDA sees : PickSteps(control.M, q, WorldOf(nobody, sees))))
     IN \A j \in DOMAIN onTime : onTime[j].label # t.label

(* Code that depends on a sensor may take another branch later. *)
MayWait(t) ==
  /\ t.S.sees # NothingSeen
  /\ t.rules # << >> /\ t.rules[1] \in { "CONDITION", "ALLOF-WHEN", "ONEOF-WHEN", "UNTIL-CUT", "ASSURE-CUT" }

(* The program does it now. *)
(* A vehicle that surely is there is recruited at once. *)
IsByItself(event) == IF event[1] = "recruited" THEN event[5] ELSE event = Program
IsUrgent(t) == IsByItself(t.event) /\ ~ComesLate(t) /\ ~MayWait(t)

(* The order to a vehicle that is lost waits for the link, as long as the program does. *)
DoneWithin(v, b) ==
  IF v \notin outside.lost THEN b
  ELSE IF b = << >> THEN AnyTime ELSE << b[1], Added(b[2], PatienceWith(v)) >>

EndsWithin(v, event, b) ==
  LET done == DoneWithin(v, b)
      most == IF done = << >> THEN Unlimited ELSE done[2]
  IN CASE event[1] = "done" -> done
       [] event = LostConnection(v) ->
            IF most = Unlimited THEN AnyTime ELSE << PatienceWith(v), most + PatienceWith(v) >>
       [] OTHER -> << 0, most >>

PickTimeout(q) == IF q.timeout = << >> THEN InTicks(Announced, 1) ELSE Seconds(q.timeout[1])

(* When a pick goes on, or is given up. *)
PickWithin(t) ==
  LET q == control.request[2]
  IN CASE t.event # Program -> Precisely(PickTimeout(q))
       [] ComesLate(t) -> << 0, PickTimeout(q) >>
       [] HasLinks -> AnyTime
       [] OTHER -> AtOnce

IsOfPick(t) ==
  control.at = "wait" /\ control.request[1] = "pick" /\ t.event \in { Program, Expired(ScriptTimer) }

(* The item for which t is taken, and within what bounds; << >>: at any moment. *)
Due(t) ==
  LET item == ItemOf(t.event)
      b == awaited[item].bounds
  IN CASE IsOfPick(t) -> << Timer(ScriptTimer), PickWithin(t) >>
       [] item = << >> -> << >>
       [] item[1] = "task" /\ item[2] \in Range(outside.silent) ->
            << SilenceOf(item[2]), awaited[SilenceOf(item[2])].bounds >>
       [] item[1] = "task" -> << item, EndsWithin(item[2], t.event, b) >>
       [] OTHER -> << item, b >>

Age(item) == now - awaited[item].since

MayBeNow(due) == IF due = << >> THEN TRUE ELSE Age(due[1]) >= due[2][1] /\ ~IsOver(due[2][2], Age(due[1]))

(* The transitions ts, each with when it is due, without those that never are. While something is urgent, only what
   needs no event happens; but a pick waits for those that may come late. *)
Timely(ts) ==
  LET dues == Each(ts, Due)
      possible == SelectSeq([ j \in DOMAIN ts |-> j ], LAMBDA j : IF dues[j] = << >> THEN TRUE ELSE dues[j][2] # << >>)
      urgent == SelectSeq(possible, LAMBDA j : IsUrgent(ts[j]))
      own == SelectSeq(possible, LAMBDA j : IsByItself(ts[j].event))
      holdsBack == urgent # << >> /\ \A j \in Range(possible) : ~ComesLate(ts[j])
  IN Only({ [ steps |-> Each(js, LAMBDA j : [ t |-> ts[j], due |-> dues[j] ]), urgent |-> holdsBack ] :
            js \in { IF holdsBack THEN own ELSE possible } })

(* After this number of ticks, each awaited item may still have an event. *)
NoneIsOver(timely, ticks) ==
  LET steps == Range(timely.steps)
      items == { s.due[1] : s \in { s \in steps : s.due # << >> } }
      mayCome(item) == \E s \in steps : s.due # << >> /\ s.due[1] = item /\ ~IsOver(s.due[2][2], Age(item) + ticks)
  IN \A item \in items : mayCome(item)

(* The possible events now. Nothing, if of an item nothing may happen any more: time has passed because a link might
   be lost, and then another one was, with which the losses are counted up. That is not a run. *)
TakenNow(timely) ==
  IF ~timely.urgent /\ ~NoneIsOver(timely, 0) THEN { } ELSE { s \in Range(timely.steps) : MayBeNow(s.due) }

(* The date that code comes to next, if there is one. *)
DatesToCome == { item \in DOMAIN awaited : item[1] = "date" }

(* When the next link comes or goes, if one does. *)
ChangesToCome == control.at # "end" /\ changes < Len(Links)
NextChange == InTicks(Links[changes + 1][2], 1)

(* Something is still to come. *)
IsAnythingOwed(timely) == DatesToCome # { } \/ ChangesToCome \/ \E s \in Range(timely.steps) : IsOwed(s.t.event)

(* A tick may pass: something is still to come, and of each item that is awaited something may happen after it. *)
MayTick(timely) ==
  /\ ~timely.urgent
  /\ IsAnythingOwed(timely)
  /\ \A item \in DatesToCome : ~IsOver(awaited[item].bounds[2], Age(item) + 1)
  /\ IF ChangesToCome THEN now < NextChange ELSE TRUE
  /\ NoneIsOver(timely, 1)

-----------------------------------------------------------------------------
(* {1 Runs} *)

TimedInit ==
  /\ CheckedInitAt(0, SilentAtFirst)
  /\ now = 0
  /\ changes = 0
  /\ awaited = [ item \in ItemsOf(control, outside) |-> Clock(ByItself(item, outside)) ]
  /\ patience = [ others |-> Unlimited, of |-> << >> ]

Step_(t) ==
  /\ Becomes(t)
  /\ awaited' = AwaitedAfter(t)
  /\ patience' = IF Losses = 0 /\ ~HasLinks THEN patience ELSE PatienceAfter(patience, t.effects)
  /\ label' = t.label
  /\ UNCHANGED << now, changes, again >>

Take ==
  \E ts \in { Known(vars) } : \E timely \in { Timely(ts) } :
    \E s \in TakenNow(timely) : Step_(s.t)

Tick ==
  /\ now < Horizon
  /\ \E ts \in { Known(vars) } : MayTick(Timely(ts))
  /\ now' = now + 1
  /\ label' = "tick"
  /\ UNCHANGED << vars, awaited, changes, patience, again >>

(* A date passes that code names, before or after whatever else happens at that moment. Code that reads it sees it
   from now on. *)
Pass(item) ==
  /\ Age(item) = awaited[item].bounds[1]
  /\ \E ts \in { Known(vars) } : ~Timely(ts).urgent
  /\ LET after == [ outside EXCEPT !.date = item[2] ]
     IN /\ Becomes([ control |-> control, S |-> Shared, outside |-> after ])
        /\ awaited' =
             [ other \in (DOMAIN awaited \ { item }) \cup NextDate(after) |->
               IF other \in DOMAIN awaited THEN awaited[other] ELSE Clock(ByItself(other, after)) ]
  /\ label' = "date"
  /\ UNCHANGED << now, changes, patience, again >>

(* The link of v comes or goes. When it is back, an order that waited for it is carried out: its task begins; and a
   task that cannot last that long is over, which is reported now. *)
AwaitedWithLink(item, v, after) ==
  LET isBack == item = Task(v) /\ v \in Range(outside.silent)
      isKnown == item \in DOMAIN awaited
      b == IF isKnown THEN awaited[item].bounds ELSE << >>
  IN CASE ~isKnown -> Clock(ByItself(item, after))
       [] isBack /\ awaited[item].waits -> Clock(b)
       [] isBack /\ b # << >> /\ IsOver(b[2], Age(item)) -> Clock(AtOnce)
       [] OTHER -> awaited[item]

Change ==
  /\ ChangesToCome
  /\ now = NextChange
  /\ \E ts \in { Known(vars) } : ~Timely(ts).urgent
  /\ LET v == Links[changes + 1][1]
         isIn(vs) == v \in Range(vs)
         others(vs) == SelectSeq(vs, LAMBDA w : w # v)
         silent == IF isIn(outside.silent) THEN others(outside.silent) ELSE Append(outside.silent, v)
         after == [ outside EXCEPT !.silent = silent,
                                   !.came = SelectSeq(SilentAtFirst, LAMBDA w : w \notin Range(silent)) ]
     IN /\ Becomes([ control |-> control, S |-> Shared, outside |-> after ])
        /\ awaited' = [ item \in ItemsOf(control, after) |-> AwaitedWithLink(item, v, after) ]
  /\ changes' = changes + 1
  /\ label' = "link"
  /\ UNCHANGED << now, patience, again >>

TimedNext == Take \/ Tick \/ Change \/ \E item \in DatesToCome : Pass(item)

(* Time can be erased: with an open date, where code reads it; with vehicles that are late or lost, where links come
   and go. *)
THEOREM Erasure ==
  CodeDates = << >> /\ ~ReadsDate /\ ~HasLinks =>
    (TimedInit /\ [][TimedNext]_<< timedVars, label, again >> => InitAt(0, << >>) /\ [][Next]_vars)

-----------------------------------------------------------------------------
(* {1 Dates} *)

(* The dated events: the end of a run; when a task starts, ends, fails, is stopped. Also "goes on", at the horizon,
   and "stuck", where no owed event is left. *)
EndingMoments == IF HasEnded THEN { << control.ending.how >> } ELSE { }

TaskMoment(what, v, p) == << what, p.name, v, SiteOf(p.at) >>

MomentsOf(t) ==
  LET running(what, v) == IF v \in DOMAIN A THEN { TaskMoment(what, v, A[v]) } ELSE { }
      ofEffect(e) ==
        CASE e[1] = "start" -> { TaskMoment("starts", e[2], e[3]) }
          [] e[1] = "stop" -> running("stopped", e[2])
          [] OTHER -> { }
      ofEvent ==
        CASE t.event[1] = "done" -> running("ends", t.event[2])
          [] t.event[1] = "failed" -> running("fails", t.event[2])
          [] OTHER -> { }
  IN ofEvent \cup UNION { ofEffect(e) : e \in Range(t.effects) }

Moments ==
  EndingMoments \cup
  IF HasEnded THEN { }
  ELSE LET timely == Timely(Known(vars))
       IN UNION { MomentsOf(s.t) : s \in TakenNow(timely) }
          \cup (IF now = Horizon /\ MayTick(timely) THEN { << "goes on" >> } ELSE { })
          \cup (IF IsAnythingOwed(timely) THEN { } ELSE { << "stuck" >> })

(* TLC's register 2 has the earliest and the latest date of each moment so far, by program. *)
ASSUME TLCSet(2, << >>)

(* Prints each moment of this state whose date is earlier or later than all so far. *)
DatesOf(program) ==
  \A moment \in Moments :
    LET dates == TLCGet(2)
        key == << program, moment >>
        isKnown == key \in DOMAIN dates
        earliest == IF isKnown THEN Minimum({ now, dates[key][1] }) ELSE now
        latest == IF isKnown /\ dates[key][2] > now THEN dates[key][2] ELSE now
    IN IF isKnown /\ dates[key] = << earliest, latest >> THEN TRUE
       ELSE /\ TLCSet(2, (key :> << earliest, latest >>) @@ dates)
            /\ PrintT("T\t" \o ToString(program) \o "\t" \o ToString(now) \o "\t" \o Join(moment, "\t"))

Dates == DatesOf(1)
==============================================================================
