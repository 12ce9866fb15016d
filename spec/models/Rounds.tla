-------------------------------- MODULE Rounds --------------------------------
(* REPEAT-1, REPEAT-2, REPEAT-UNTIL, REPEAT-AGAIN, REPEAT-ERR: rounds of a task. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")),
           ExecuteTask(RepeatTimes(3, On(Plan("long"), V))),
           ExecuteTask(RepeatUntil(Then(On(Plan("long"), V), Action(1)), 2)),
           ExecuteTask(WatchOnError(RepeatTimes(2, On(Plan("risky"), V)), 3)) >>)

TakingTwo == Apply([ op |-> "consume", keys |-> << << "k" >>, << "k" >> >> ], << NumberOf(1), NumberOf(1) >>)

Closures == << DoPosting("k", NumberOf(1)), TakingTwo, Ignore >>

(* The pairs that the condition took are there again where it does not hold. *)
Claim ==
  /\ By_("REPEAT-AGAIN", LAMBDA t : HasPair(N, "k", Integer(1)) /\ t.S.N = N /\ t.control.r.runs # << >>)
  /\ By_("REPEAT-UNTIL", LAMBDA t : t.S.N = NoTuples /\ t.control.at = "script")
  /\ By_("REPEAT-ERR", LAMBDA t : t.S.A = << >>)
==============================================================================
