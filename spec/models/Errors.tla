------------------------------- MODULE Errors -------------------------------
(* WATCH-1, WATCH-2, WATCH-IGNORE, WATCH-PROPAGATE, WATCH-HALT: an error climbs in one step. *)
EXTENDS Model

Inner == WatchOnError(On(Then(Plan("risky"), Plan("sound")), V), 1)
Middle == WatchOnError(Then(Inner, On(Plan("risky"), V)), 2)

Body == Block(<< Assign(1, PickId("u1")), ExecuteTask(WatchOnError(Then(Middle, On(Plan("risky"), V)), 3)) >>)

Closures ==
  << DoPosting("errors", NumberOf(1)),                          \* handles nothing: propagates
     Block(<< DoPosting("errors", NumberOf(2)), Ignore >>),
     Halt("enough") >>

Claim ==
  /\ By_("WATCH-PROPAGATE", LAMBDA t : "WATCH-IGNORE" \in Rules(t) /\ Len(PairsOf(t.deeds, "post")) = 2)
  /\ By_("WATCH-IGNORE", LAMBDA t : t.S.A = << >> /\ t.control.at = "exec")
  /\ By_("WATCH-HALT", LAMBDA t : t.control.ending = Halted("enough"))
==============================================================================
