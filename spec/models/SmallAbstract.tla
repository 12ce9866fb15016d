----------------------------- MODULE SmallAbstract -----------------------------
(* The theorems of Abstract.tla, checked: every small state in which Inv holds is an initial state here, and TLC takes
   every event from it. So Inv is found to be inductive, in all these states, whether they can be reached or not. *)
EXTENDS Abstract

CONSTANT Most  \* of each pair

SmallBags == UNION { [ P -> 1 .. Most ] : P \in SUBSET Pair }

(* With Init, for TLC to see that Inv holds at first. *)
EverySmallState ==
  \/ Init
  \/ /\ A \in UNION { [ V -> Task ] : V \in SUBSET Vehicle }
     /\ B \in SUBSET Vehicle
     /\ N \in SmallBags
     /\ over \in BOOLEAN
     /\ Inv

(* Other states are checked, but nothing is taken from them. *)
IsSmall == N \in SmallBags
==============================================================================
