-------------------------------- MODULE Time --------------------------------
(* IDLE-END, DURING-SET, DURING-CUT, WITHIN-CUT, DURING-1, DURING-2, DURING-ERR: time is an event. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")),
           ExecuteTask(Then(Idle(1), DuringRun(NumberOf(10), On(Then(Plan("long"), Plan("longer")), V)))),
           ExecuteTask(DuringRun(Closure(1), On(Plan("risky"), V))),
           ExecuteTask(WatchOnError(WithinRun(NumberOf(10), On(Plan("long"), V)), 3)),
           ExecuteTask(DuringRun(Closure(2), On(Plan("never"), V))) >>)

Closures == << Operator("*", NumberOf(2), NumberOf(5)), Const(False), Ignore >>

Claim ==
  /\ "never" \notin RunsOf(Shared)
  /\ By_("DURING-CUT", LAMBDA t : t.S.A = << >> /\ t.control.at = "script")
  /\ By_("WITHIN-CUT", LAMBDA t : t.S.A = << >> /\ t.control.at = "script")
  /\ By_("DURING-SET", LAMBDA t : t.control.r.time = Integer(10) /\ t.control.r.started)
==============================================================================
