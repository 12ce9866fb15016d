-------------------------------- MODULE Ends --------------------------------
(* END, HALT, FAULT, INTERRUPT: however it ends, all stops and all is released. Ends.cfg lets the program be interrupted
   at any time. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")),
           ExecuteTask(Beside(WatchOnError(On(Plan("risky"), V), 1), Beside(Action(2), Action(3)))),
           If(Polling("k", NumberOf(1)), Halt("by the script"),
              If(Polling("failed", NumberOf(1)), Broke, Message("well"))) >>)

Closures ==
  << Block(<< DoPosting("failed", NumberOf(1)), Ignore >>),
     If(Polling("failed", NumberOf(1)), Halt("by a task"), DoPosting("k", NumberOf(1))),
     Consuming("k", NumberOf(1)) >>

Ending_(t) == t.control.at = "end" /\ t.S.A = << >> /\ t.S.B = << >>

Claim == \A rule \in { "END", "HALT", "FAULT", "INTERRUPT" } : By_(rule, Ending_)
==============================================================================
