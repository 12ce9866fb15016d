-------------------------------- MODULE Until --------------------------------
(* UNTIL-CUT, ASSURE-CUT, UNTIL-1, UNTIL-2, UNTIL-ERR: a task that a condition ends. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")),
           ExecuteTask(Beside(On(UntilRun(1, Then(Plan("long"), Plan("longer"))), V), Action(2))),
           ExecuteTask(WatchOnError(On(UntilRun(4, Plan("long")), V), 3)),
           ExecuteTask(WatchOnError(Beside(On(AssureRun(6, Plan("long")), V), Action(2)), 3)),
           ExecuteTask(Condition(1)),
           ExecuteTask(On(UntilRun(5, Plan("risky")), V)) >>)

Closures ==
  << Consuming("k", NumberOf(1)), DoPosting("k", NumberOf(1)), Ignore, Broke, Const(False),
     Apply([ op |-> "unary", sign |-> "!" ], << Consuming("k", NumberOf(1)) >>) >>

(* A task that is cut off stops. *)
Claim ==
  /\ By_("UNTIL-CUT", LAMBDA t : HasPair(N, "k", Integer(1)) /\ t.S.N = NoTuples /\ t.S.A = << >>)
  /\ By_("ASSURE-CUT", LAMBDA t : HasPair(N, "k", Integer(1)) /\ t.S.N = N /\ t.S.A = << >>)
  /\ By_("UNTIL-ERR", LAMBDA t : t.S.A = << >>)
==============================================================================
