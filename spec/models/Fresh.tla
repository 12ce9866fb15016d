--------------------------------- MODULE Fresh ---------------------------------
(* FRESH-1, FRESH-2, FRESH-ERR: a task with a key of its own. The code of models captures nothing, so the key is spelled
   out: it is the first number of the executed task. *)
EXTENDS Model

WithKey(j) == Plain("fresh", << Closure(j) >>)

Body ==
  Block(<< Assign(1, PickId("u1")), ExecuteTask(WatchOnError(WithKey(1), 3)), ExecuteTask(WithKey(4)) >>)

Closures ==
  << Then(Action(2), Plan("risky")), DoPosting("#1", NumberOf(1)), Ignore, Beside(Idle(1), WithKey(5)), Idle(2) >>

(* N has the pair while the task goes on, and not when it is over; a task inside has a number of its own. *)
Claim ==
  /\ By_("FRESH-1", LAMBDA t : HasKeyIn(t.S.N, "#1") \/ t.control.r.keys = << 1 >>)
  /\ By_("FRESH-2", LAMBDA t : t.S.N = NoTuples)
  /\ By_("FRESH-ERR", LAMBDA t : t.S.N = NoTuples /\ t.control.at = "script")
  /\ control.at = "exec" => NumbersIn(<< control.r >>) # { }
==============================================================================
