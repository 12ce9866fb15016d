------------------------------- MODULE Leaving -------------------------------
(* ON-INTERRUPT: an interruption cuts off what runs, and executes what the program declares, of the vehicles of B; then
   the run ends as interrupted, or as that ends it. Leaving.cfg lets the program be interrupted at any time, once. *)
EXTENDS Model

Body ==
  Block(<< Pause(1), Assign(1, PickId("u1")),
           ExecuteTask(DuringRun(NumberOf(2), On(Plan("survey"), V))), ReleaseAll(V) >>)

(* The first is the task of onInterrupt: its one local is B. *)
Closures ==
  << Plain("interrupted", << ExecuteTask(Then(On(Plan("risky"), V), Action(2))) >>),
     DoPosting("home", NumberOf(1)) >>

OnInterruptOfModel == << << "closure", 3, << >> >> >>

Begins_(t) ==
  /\ B # << >> /\ ~IsLeaving(control.M)
  /\ t.control.at = "script" /\ IsLeaving(t.control.M)
  /\ t.S.A = << >> /\ t.S.B = B /\ t.S.N = N
  /\ \A v \in DOMAIN A : << "stop", v >> \in Range(t.effects)

IsHome == << "home", Integer(1) >> \in DOMAIN N.bag

Claim ==
  /\ By_("ON-INTERRUPT", Begins_)
  /\ By_("INTERRUPT", LAMBDA t : B = << >> /\ t.control.at = "end")
  /\ By_("END", LAMBDA t : (t.control.ending.how = "interrupted") = IsHome)
  /\ By_("EXECUTE-ERR", Fails_)
==============================================================================
