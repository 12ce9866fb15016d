----------------------------- MODULE CodeOfTasks -----------------------------
(* ACTION, CONDITION, their faults, and ASSERT-ERR: code of tasks is atomic, and a fault leaves no effect. *)
EXTENDS Model

Task == Beside(Beside(Action(1), Condition(2)), Beside(Action(3), Beside(Condition(4), Action(5))))
Body == Block(<< ExecuteTask(WatchOnError(Task, 6)) >>)

Closures ==
  << DoPosting("k", NumberOf(1)),                        \* 1
     Consuming("k", NumberOf(1)),                        \* 2
     Block(<< DoPosting("lost", NumberOf(1)), Broke >>),   \* 3
     Broke,                                              \* 4
     Assertion(Polling("k", NumberOf(1))),               \* 5
     Ignore >>

Claim ==
  /\ ~HasKeyIn(N, "lost")
  /\ By_("CONDITION", LAMBDA t : HasPair(N, "k", Integer(1)) /\ ~HasPair(t.S.N, "k", Integer(1)))
  /\ By_("ASSERT-ERR", LAMBDA t : ~HasPair(N, "k", Integer(1)) /\ Fails_(t))
  /\ By_("ACTION-ERR", LAMBDA t : t.S.N = N /\ "WATCH-IGNORE" \in Rules(t))
==============================================================================
