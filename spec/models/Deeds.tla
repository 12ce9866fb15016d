-------------------------------- MODULE Deeds --------------------------------
(* SCRIPT, POST, CONSUME, MESSAGE, RELEASE, SET-TIMEOUT: the script's visible deeds. Deeds.cfg lets it evaluate only
   20 expressions in one silent step. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, NumberOf(0)),
           Loop(Operator("<", V, NumberOf(5)), Assign(1, Operator("+", V, NumberOf(1)))),
           DoPosting("oldest", NumberOf(1)), DoPosting("oldest", NumberOf(2)), DoPosting("k", NumberOf(1)),
           Loop(Consuming("oldest", Const(Wildcard)), Message("one more")),
           Assign(2, PickId("u1")), TimeoutOf(10), ReleaseAll(W), ReleaseAll(W) >>)

Closures == << >>

(* Without pairs a key is not there. *)
Oldest(tuples) == IF "oldest" \in DOMAIN tuples.queue THEN tuples.queue["oldest"] ELSE << >>

(* The oldest first; only bound vehicles are released. *)
Claim ==
  /\ By_("CONSUME", LAMBDA t : Oldest(t.S.N) = Tail(Oldest(N)))
  /\ By_("RELEASE", LAMBDA t : B = << "u1" >> /\ t.S.B = << >>)
  /\ By_("SCRIPT", LAMBDA t : t.deeds = << >> /\ t.S.N = N)
==============================================================================
