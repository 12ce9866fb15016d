------------------------------ MODULE Questions ------------------------------
(* CONFIRM-YES, CONFIRM-NO: a task that waits for the answer yes. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")),
           ExecuteTask(WatchOnError(On(Beside(Then(Confirm("go?"), Plan("long")), Idle(5)), V), 1)),
           ExecuteTask(WatchOnError(WithinRun(NumberOf(10), Confirm("go?")), 1)),
           ExecuteTask(Confirm("is anybody there?")) >>)

Closures == << Ignore >>

Claim ==
  /\ HasEnded => control.ending.message = "no answer to 'is anybody there?': none is given"
  /\ By_("CONFIRM-YES", LAMBDA t : t.label = "answer(yes)" /\ "long" \notin RunsOf(t.S))
  /\ By_("CONFIRM-NO", LAMBDA t : t.S.A = << >> /\ t.label \in { "answer(no)", "no-answer" })
==============================================================================
