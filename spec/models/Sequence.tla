------------------------------ MODULE Sequence ------------------------------
(* SEQ-1, SEQ-2, SEQ-ERR: one after the other, and nothing after an error. *)
EXTENDS Model

Body == Block(<< Assign(1, PickId("u1")), ExecuteTask(On(Then(Then(Plan("risky"), Idle(1)), Plan("last")), V)) >>)

Closures == << >>

Claim ==
  /\ By_("SEQ-ERR", Fails_)
  /\ By_("SEQ-2", LAMBDA t : t.S.A = << >>)
  /\ "last" \in RunsOf(Shared) => control.r.op = "running"
==============================================================================
