------------------------------- MODULE Waiting -------------------------------
(* ASK, ANSWER, ANSWER-ERR, PAUSE, RESUME, CALL, REPLY, CALL-ERR: the script waits for the outside. *)
EXTENDS Model

Body ==
  Block(<< Assign(1, Ask("how many?")), Pause(1), Assign(2, CallHost), Assign(1, Operator("+", V, Ask("how many?"))),
           Assign(1, Ask("how many?")) >>)

Closures == << >>

(* The third answer never comes. *)
Claim ==
  /\ By_("ANSWER", LAMBDA t : t.control.M.focus = Give(Integer(2)))
  /\ By_("ANSWER-ERR", LAMBDA t : store[1] = << Integer(4) >> /\ Fails_(t))
  /\ By_("CALL-ERR", Fails_)
==============================================================================
