------------------------------- MODULE Fleet -------------------------------
\* The model for TLC; see promela.sh for what the numbers mean.
EXTENDS Naturals, FiniteSets
CONSTANTS N, Failures
VARIABLES phase, u, ready, rv, busy
vars == <<phase, u, ready, rv, busy>>
Ids == 1..N

Over == \A i \in Ids : u[i] = 5 /\ rv[i] = 3
Executing == phase = 5 /\ ~Over

Init == /\ phase = 0 /\ busy = FALSE
        /\ u = [i \in Ids |-> 0] /\ ready = [i \in Ids |-> 0] /\ rv = [i \in Ids |-> 0]

Script == phase < 5 /\ phase' = phase + 1 /\ UNCHANGED <<u, ready, rv, busy>>
End == phase = 5 /\ Over /\ phase' = 7 /\ UNCHANGED <<u, ready, rv, busy>>

Go(i, from) == u[i] = from /\ u' = [u EXCEPT ![i] = from + 1] /\ UNCHANGED <<phase, ready, rv, busy>>
Post(i) == /\ u[i] = 2 /\ u' = [u EXCEPT ![i] = 3] /\ ready' = [ready EXCEPT ![i] = @ + 1]
           /\ UNCHANGED <<phase, rv, busy>>
Consume(i) == /\ ~busy /\ rv[i] = 0 /\ ready[i] > 0
              /\ ready' = [ready EXCEPT ![i] = @ - 1] /\ rv' = [rv EXCEPT ![i] = 1] /\ busy' = TRUE
              /\ UNCHANGED <<phase, u>>
StartMeeting(i) == rv[i] = 1 /\ rv' = [rv EXCEPT ![i] = 2] /\ UNCHANGED <<phase, u, ready, busy>>
EndMeeting(i) == rv[i] = 2 /\ rv' = [rv EXCEPT ![i] = 3] /\ busy' = FALSE /\ UNCHANGED <<phase, u, ready>>
Failed(code) == /\ phase' = code /\ busy' = FALSE
                /\ u' = [i \in Ids |-> 0] /\ rv' = [i \in Ids |-> 0] /\ UNCHANGED ready
Fail(i) == /\ Failures
           /\ \/ u[i] = 1 /\ Failed(5 + 3 * i)
              \/ u[i] = 4 /\ Failed(6 + 3 * i)
              \/ rv[i] = 2 /\ Failed(7 + 3 * i)

Next == \/ Script \/ End
        \/ /\ Executing
           /\ \E i \in Ids : \/ Go(i, 0) \/ Go(i, 1) \/ Post(i) \/ Go(i, 3) \/ Go(i, 4)
                             \/ Consume(i) \/ StartMeeting(i) \/ EndMeeting(i) \/ Fail(i)
Spec == Init /\ [][Next]_vars
Inv == \A i \in Ids : ready[i] <= 1
=============================================================================
