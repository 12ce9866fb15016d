------------------------------ MODULE Platform ------------------------------
(* START, DONE, FAIL: one task of one vehicle, which may fail. *)
EXTENDS Model

Body == Block(<< Assign(1, PickId("u1")), ExecuteTask(On(Plan("risky"), V)) >>)

Closures == << >>

(* A task begins on a free vehicle, and leaves it free. *)
Claim ==
  /\ By_("START", LAMBDA t : A = << >> /\ t.S.A["u1"].name = "risky")
  /\ By_("DONE", LAMBDA t : t.S.A = << >>)
  /\ By_("FAIL", LAMBDA t : t.S.A = << >> /\ Fails_(t))
==============================================================================
