--------------------------------- MODULE Made ---------------------------------
(* MAKE, MAKE-ERR, ALLOCATE, ALLOCATE-ERR, HOLD-1, HOLD-2, HOLD-ERR: tasks made at their turn. *)
EXTENDS Model

Attempt(j) == ExecuteTask(WatchOnError(Closure(j), 5))

Body ==
  Block(<< Assign(1, PickId("u1")), Attempt(1), Attempt(2), Attempt(3), Attempt(4) >>)

(* One vehicle cannot run two plans at once. *)
Closures == << Plan("long"), Plan("risky"), Broke, Beside(Plan("long"), Plan("long")), Ignore >>

(* An allocated vehicle is held until its task ends, done or failed. *)
Claim ==
  /\ By_("MAKE", LAMBDA t : t.control.r.body.op = "unallocated")
  /\ By_("ALLOCATE", LAMBDA t : t.control.r.body.op = "hold" /\ t.control.r.body.vehicles = << "u1" >>)
  /\ By_("HOLD-1", LAMBDA t : t.control.r.body.vehicles = << "u1" >> /\ DOMAIN t.S.A = { "u1" })
  /\ By_("HOLD-2", LAMBDA t : t.control.at = "script" /\ t.S.A = << >>)
  /\ By_("MAKE-ERR", LAMBDA t : t.control.at = "script")
  /\ By_("ALLOCATE-ERR", LAMBDA t : t.control.at = "script")
  /\ By_("HOLD-ERR", LAMBDA t : t.control.at = "script" /\ t.S.A = << >>)
==============================================================================
