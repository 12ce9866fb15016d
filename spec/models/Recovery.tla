------------------------------- MODULE Recovery -------------------------------
(* WATCH-RETRY, WATCH-INSTEAD: a task that failed runs again, or another one in its place. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")), DoPosting("again", NumberOf(1)), ExecuteTask(WatchOnError(Plan("risky"), 1)),
           ExecuteTask(WatchOnError(Plan("risky"), 2)), ExecuteTask(WatchOnError(Action(3), 4)) >>)

Closures ==
  << If(Consuming("again", NumberOf(1)), Retry, Ignore), Plan("long"), Fail("no reason"), Ignore >>

(* The recovery task is allocated when it is made; a task in the place of another is not watched by its handler. *)
Claim ==
  /\ By_("WATCH-RETRY", LAMBDA t : t.S.A = << >> /\ t.control.r.body.op = "unallocated" /\ t.control.r.op = "watch")
  /\ By_("WATCH-INSTEAD", LAMBDA t : t.S.A = << >> /\ t.control.r.op = "unallocated")
  /\ By_("ACTION-ERR", LAMBDA t : t.label = "broken(no reason)")
==============================================================================
