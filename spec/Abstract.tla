------------------------------- MODULE Abstract -------------------------------
(* Dolphin on one page: the vehicles that a program holds, their tasks, and the    *)
(* tuple space, without the reasons for events. Each transition of Dolphin.tla is  *)
(* a sequence of these events: DolphinRefinement.tla states it.                    *)
(*                                                                                 *)
(* TLC checks the theorems of this page in all states of three vehicles, two tasks *)
(* and two pairs, each twice in N at most: models/SmallAbstract.tla.               *)
EXTENDS Naturals, FiniteSets, Bags, TLC

CONSTANTS
  Vehicle,
  Task,  \* what a vehicle may run
  Pair   \* what may be posted

ASSUME IsFiniteSet(Vehicle)

VARIABLES
  A,    \* the allocation: which task each vehicle runs, for those that run one
  B,    \* the bound vehicles, which the program holds
  N,    \* the tuple space, a bag of pairs
  over  \* whether the program has ended

vars == << A, B, N, over >>

Idle == B \ DOMAIN A
WithoutTaskOf(v) == [ u \in DOMAIN A \ { v } |-> A[u] ]

Init == A = << >> /\ B = { } /\ N = EmptyBag /\ over = FALSE

(* {1 Events} *)

(* The program takes v, which it does not hold; and gives it back, when v runs nothing. *)
Bind(v) == ~over /\ v \notin B /\ B' = B \cup { v } /\ UNCHANGED << A, N, over >>
Release(v) == ~over /\ v \in Idle /\ B' = B \ { v } /\ UNCHANGED << A, N, over >>

(* The program starts p on v. The task ends by itself, well or not, or is stopped: the same to A. *)
Start(v, p) == ~over /\ v \in Idle /\ A' = A @@ (v :> p) /\ UNCHANGED << B, N, over >>
End(v) == ~over /\ v \in DOMAIN A /\ A' = WithoutTaskOf(v) /\ UNCHANGED << B, N, over >>
Stop(v) == End(v)

Post(x) == ~over /\ N' = N (+) SetToBag({ x }) /\ UNCHANGED << A, B, over >>
Consume(x) == ~over /\ BagIn(x, N) /\ N' = N (-) SetToBag({ x }) /\ UNCHANGED << A, B, over >>

(* A vehicle of an ended program is held no more. *)
Finish == ~over /\ B = { } /\ over' = TRUE /\ UNCHANGED << A, B, N >>

Next ==
  \/ \E v \in Vehicle : Bind(v) \/ Release(v) \/ End(v) \/ Stop(v) \/ (\E p \in Task : Start(v, p))
  \/ \E x \in Pair : Post(x) \/ Consume(x)
  \/ Finish

Spec == Init /\ [][Next]_vars

(* {1 Invariants} *)

TypeOK ==
  /\ DOMAIN A \subseteq Vehicle /\ (\A v \in DOMAIN A : A[v] \in Task)
  /\ B \subseteq Vehicle
  /\ IsABag(N) /\ BagToSet(N) \subseteq Pair
  /\ over \in BOOLEAN

(* A running vehicle is held; after the end no vehicle runs or is held. *)
AllocationWithinBound == DOMAIN A \subseteq B
EmptyAfterEnd == over => A = << >> /\ B = { }

Inv == TypeOK /\ AllocationWithinBound /\ EmptyAfterEnd

(* Inv is inductive: it holds at first, and each event keeps it. EmptyAfterEnd alone is not: Finish asks for B only. *)
THEOREM InvAtFirst == Init => Inv
THEOREM InvIsKept == Inv /\ [Next]_vars => Inv'
THEOREM Invariance == Spec => []Inv

(* After the end no event follows; a vehicle gets another task only when it has none; and each pair of N was posted,
   one pair by one event. *)
StaysOver == [][~over]_vars
OneTaskAfterTheOther == [][\A v \in DOMAIN A \cap DOMAIN A' : A'[v] = A[v]]_vars
OnePairAtATime == [][\E x \in Pair : N' = N (+) SetToBag({ x }) \/ N = N' (+) SetToBag({ x })]_N

THEOREM Steps == Spec => StaysOver /\ OneTaskAfterTheOther /\ OnePairAtATime
==============================================================================
