--------------------------- MODULE DolphinRefinement ---------------------------
(* Dolphin refines Abstract.tla. A transition is a sequence of abstract events: a  *)
(* failure beside others ends one task and stops several. So a transition is taken *)
(* here, and then its events one by one, each as the action of Abstract.tla that   *)
(* it is: in Lamport's words, due is a stuttering variable. TLC checks that no     *)
(* event is refused where it is due, and that together they change A, B and N as   *)
(* the transition has done. Then every run of a program is one of Abstract.tla,    *)
(* and the theorems there hold of it.                                              *)
EXTENDS DolphinChecking

VARIABLES
  due,   \* the events of the latest transition that were not taken yet
  abstractA, abstractB, abstractN, over  \* what they change

(* No event depends on which vehicles, tasks and pairs there are: so these need not be listed. *)
Abstract ==
  INSTANCE Abstract
    WITH Vehicle <- { }, Task <- { }, Pair <- { }, A <- abstractA, B <- abstractB, N <- abstractN

abstractVars == << abstractA, abstractB, abstractN, over >>

-----------------------------------------------------------------------------
(* {1 The events of a transition} *)

NormalPair(pair) == << pair[1], Normal(pair[2]) >>

EventsOfEvent(event) == IF event[1] \in { "done", "failed" } THEN << << "end", event[2] >> >> ELSE << >>

EventsOfDeed(d) ==
  CASE d.did \in { "post", "consume" } -> Each(d.pairs, LAMBDA pair : << d.did, NormalPair(pair) >>)
    [] d.did = "forget" -> Each(d.pairs, LAMBDA pair : << "consume", NormalPair(pair) >>)
    [] OTHER -> << >>

EventsOfEffect(e) ==
  CASE e[1] \in { "start", "stop" } -> << e >>
    [] e[1] \in { "bind", "release" } -> Each(e[2], LAMBDA v : << e[1], v >>)
    [] e[1] = "end" -> << << "finish" >> >>
    [] OTHER -> << >>

(* The order: events from outside, deeds of code, requests to the outside. *)
EventsOf(t) ==
  EventsOfEvent(t.event) \o Flatten(Each(t.deeds, EventsOfDeed)) \o Flatten(Each(t.effects, EventsOfEffect))

Happens(e) ==
  CASE e[1] = "start" -> Abstract!Start(e[2], e[3])
    [] e[1] = "end" -> Abstract!End(e[2])
    [] e[1] = "stop" -> Abstract!Stop(e[2])
    [] e[1] = "bind" -> Abstract!Bind(e[2])
    [] e[1] = "release" -> Abstract!Release(e[2])
    [] e[1] = "post" -> Abstract!Post(e[2])
    [] e[1] = "consume" -> Abstract!Consume(e[2])
    [] e[1] = "finish" -> Abstract!Finish

-----------------------------------------------------------------------------
(* {1 Runs, event by event} *)

RefinedInit == CheckedInit /\ due = << >> /\ Abstract!Init

TakeTransition ==
  /\ due = << >>
  /\ \E ts \in { Known(vars) } : \E j \in DOMAIN ts : Unmarked(ts[j]) /\ due' = EventsOf(ts[j])
  /\ UNCHANGED abstractVars

TakeEvent == due # << >> /\ Happens(Head(due)) /\ due' = Tail(due) /\ UNCHANGED << vars, label, again >>

RefinedNext == TakeTransition \/ TakeEvent

(* {1 What TLC checks} *)

NoneRefused == due # << >> => ENABLED Happens(Head(due))

(* The refinement mapping. *)
Mapped ==
  due = << >> => /\ abstractA = A
                 /\ abstractB = Bound
                 /\ abstractN = AllPairs(N)
                 /\ over = HasEnded

AbstractInv == Abstract!AllocationWithinBound /\ Abstract!EmptyAfterEnd

(* Checked on examples, small programs and random ones: crosscheck.exe refinement. *)
THEOREM Refinement ==
  RefinedInit /\ [][RefinedNext]_<< vars, label, again, due, abstractVars >> => [](NoneRefused /\ Mapped)
==============================================================================
