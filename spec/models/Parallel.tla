------------------------------ MODULE Parallel ------------------------------
(* PAR-1, PAR-2, PAR-ERR: side by side, until one of them fails. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")), Assign(2, PickId("u2")),
           ExecuteTask(WatchOnError(Beside(Beside(On(Plan("risky"), V), On(Plan("sound"), W)), Idle(1)), 1)) >>)

Closures == << Ignore >>

(* An error stops the siblings. *)
Claim ==
  /\ By_("PAR-ERR", LAMBDA t : t.S.A = << >> /\ t.control.at = "script")
  /\ By_("PAR-2", LAMBDA t : t.control.at = "exec")
==============================================================================
