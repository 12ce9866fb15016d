-------------------------------- MODULE Until --------------------------------
(* UNTIL-CUT, UNTIL-1, UNTIL-2, UNTIL-ERR: a task that a condition ends. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")),
           ExecuteTask(Beside(On(UntilRun(1, Then(Plan("long"), Plan("longer"))), V), Action(2))),
           ExecuteTask(WatchOnError(On(UntilRun(4, Plan("long")), V), 3)),
           ExecuteTask(On(UntilRun(5, Plan("risky")), V)) >>)

Closures ==
  << Consuming("k", NumberOf(1)), DoPosting("k", NumberOf(1)), Ignore, Broke, Const(False) >>

(* What is cut off stops. *)
Claim ==
  /\ By_("UNTIL-CUT", LAMBDA t : HasPair(N, "k", Integer(1)) /\ t.S.N = NoTuples /\ t.S.A = << >>)
  /\ By_("UNTIL-ERR", LAMBDA t : t.S.A = << >>)
==============================================================================
