-------------------------------- MODULE Inputs --------------------------------
(* INPUT: people post while the script runs, waits or executes; the pairs are there for all that looks at them.
   Inputs.cfg lets them do so. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")),
           ExecuteTask(UntilRun(1, On(Plan("survey"), V))),
           ExecuteTask(WaitFor(2, On(Plan("home"), V))),
           Pause(1) >>)

Closures == << Polling("abort", NumberOf(1)), Consuming("go", NumberOf(1)) >>

(* An abort may come once, or never; 1 or 2 first, as certain inputs come; then 1. *)
InputsOfModel ==
  << [ key |-> "abort", rounds |-> << << Integer(1) >> >>, times |-> 1, certain |-> FALSE ],
     [ key |-> "go", rounds |-> << << Integer(1), Integer(2) >>, << Integer(1) >> >>, times |-> 2, certain |-> TRUE ] >>

Posts_(t) ==
  /\ t.control = control
  /\ t.S.A = A
  /\ t.S.B = B
  /\ t.S.store = store
  /\ t.S.N # N
  /\ t.effects = << >>

Claim == By_("INPUT", Posts_)
==============================================================================
