------------------------------- MODULE Ensuring -------------------------------
(* ENSURE-1, ENSURE-2, ENSURE-ERR: two vehicles that use one pair. The task of one is cut off by a time, that of the
   other may fail. *)
EXTENDS Model

GivingBack(t) == Apply([ op |-> "ensure", forms |-> << [ op |-> "giveBack" ] >> ], << t >>)
Using(t) == WaitFor(1, GivingBack(t))

Body ==
  Block(<< Assign(1, PickId("u1")), Assign(2, PickId("u2")), DoPosting("k", NumberOf(1)),
           ExecuteTask(Beside(DuringRun(NumberOf(1), Using(On(Plan("long"), V))),
                              WatchOnError(Using(On(Plan("risky"), W)), 2))) >>)

Closures == << Consuming("k", NumberOf(1)), Ignore >>

Free(S) == S.N = Post(NoTuples, "k", Integer(1))

(* The pair is neither lost nor doubled: it is in N, or one task has it. *)
Claim ==
  /\ control.at = "exec" => IF EnsuredIn(control.r) = << >> THEN Free(Shared) ELSE N = NoTuples
  /\ By_("ENSURE-1", LAMBDA t : t.S.N = NoTuples)
  /\ By_("ENSURE-2", LAMBDA t : Free(t.S))
  /\ By_("ENSURE-ERR", LAMBDA t : Free(t.S))
==============================================================================
