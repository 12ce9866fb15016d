------------------------------ MODULE Branches ------------------------------
(* ALLOF-WHEN, ALLOF-1, ALLOF-2, ALLOF-ERR, ONEOF-WHEN, ONEOF-ERR: branches with guards. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, PickId("u1")), DoPosting("k", NumberOf(1)), DoPosting("k", NumberOf(2)),
           ExecuteTask(On(Builder("allOf", << << 1, Plan("first") >>, << 2, Plan("second") >>,
                                              << 3, Plan("risky") >> >>), V)),
           DoPosting("k", NumberOf(1)),
           ExecuteTask(WatchOnError(On(Builder("allOf", << << 1, Plan("first") >>, << 4, Plan("second") >> >>), V), 5)),
           ExecuteTask(WatchOnError(On(Builder("oneOf", << << 3, Plan("first") >>, << 4, Plan("second") >> >>), V),
                                    5)) >>)

Closures ==
  << Consuming("k", NumberOf(1)), Consuming("k", NumberOf(2)), Const(True), Broke, Ignore >>

(* One branch at a time. *)
Claim ==
  /\ Cardinality(DOMAIN A) <= 1
  /\ By_("ALLOF-WHEN", LAMBDA t : A = << >>)
  /\ By_("ALLOF-2", LAMBDA t : t.S.A = << >> /\ t.control.at = "exec")
  /\ By_("ONEOF-ERR", LAMBDA t : t.S.N = N)
==============================================================================
