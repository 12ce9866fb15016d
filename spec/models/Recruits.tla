------------------------------- MODULE Recruits -------------------------------
(* RECRUIT, RECRUIT-1, RECRUIT-2, RECRUIT-ERR: a task that waits for a vehicle, and releases it. *)
EXTENDS Model

Recruit(v, j) == Apply([ op |-> "recruit" ], << Const(Settings(<< Setting("id", String(v)) >>)), Closure(j) >>)

Body ==
  Block(<< ExecuteTask(WatchOnError(Recruit("u1", 1), 3)),
           ExecuteTask(WatchOnError(Beside(Recruit("u2", 2), Recruit("u2", 1)), 3)) >>)

Closures == << Plan("risky"), Idle(5), Ignore >>

(* No vehicle is recruited twice, and recruits are not in B. *)
Claim ==
  /\ B = << >>
  /\ By_("RECRUIT", LAMBDA t : Cardinality(Range(RecruitsOf(t.control))) = Len(RecruitsOf(t.control)))
  /\ By_("RECRUIT-1", LAMBDA t : RecruitsOf(t.control) # << >>)
  /\ By_("RECRUIT-2", LAMBDA t : \E j \in DOMAIN t.effects : t.effects[j][1] = "release")
  /\ By_("RECRUIT-ERR", LAMBDA t : \E j \in DOMAIN t.effects : t.effects[j][1] = "release")
==============================================================================
