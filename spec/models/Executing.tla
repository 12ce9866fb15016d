------------------------------ MODULE Executing ------------------------------
(* EXECUTE, EXECUTE-DONE, EXECUTE-ERR, ALLOC-ERR: the fewest vehicles that can, disjoint side by side. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, Pick(<< Setting("type", String("UUV")), Setting("count", Integer(2)) >>)),
           ExecuteTask(Then(Plan("one"), Plan("two"))),
           ExecuteTask(Beside(Plan("one"), Plan("risky"))),
           ExecuteTask(Beside(Beside(Plan("one"), Plan("two")), Plan("three"))) >>)

Closures == << >>

Claim ==
  /\ "three" \notin RunsOf(Shared)
  /\ "two" \in RunsOf(Shared) => DOMAIN A = { B[1] }
  /\ By_("ALLOC-ERR", LAMBDA t : A = << >> /\ Fails_(t))
  /\ By_("EXECUTE-ERR", Fails_)
==============================================================================
