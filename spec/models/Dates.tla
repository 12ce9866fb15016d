-------------------------------- MODULE Dates --------------------------------
(* The date that code reads is open at each step, one within a step, and may be kept. *)
EXTENDS Model

Date == Plain("now", << >>)
Reached == Operator(">=", Date, NumberOf(600))
Before == Operator("<", Date, NumberOf(600))
Both(a, b) == Operator("&&", a, b)

(* w keeps the date of the start. *)
Body ==
  Block(<< Assign(1, PickId("u1")),
           Assign(2, Date),
           ExecuteTask(Beside(On(UntilRun(1, Plan("survey")), V), Condition(2))),
           If(Both(Before, Reached), Halt("both"), Const(Null)),
           If(Both(Operator(">=", W, NumberOf(600)), Before), Halt("back"), Const(Null)),
           Plain("message", << Date >>) >>)

Closures == << Reached, Operator(">", Operator("-", Date, W), NumberOf(300)) >>

(* A comparison is known by its text, and is the same question as its opposite; its answers are 1 and 2, that it holds
   and that it does not. *)
IsBefore == "now() < 600"
WasBefore == "w < 600"
IsLater == "(now() - w) > 300"

(* Comparisons of dates at one step do not bind the next: they may seem to go back, but not within a step. *)
Claim ==
  /\ By_("UNTIL-CUT", LAMBDA t : Seen(t, IsBefore, 2))
  /\ By_("CONDITION", LAMBDA t : Seen(t, IsLater, 1))
  /\ By_("HALT", LAMBDA t : t.label = "halt(back)" /\ Seen(t, WasBefore, 2) /\ Seen(t, IsBefore, 1))
  /\ By_("MESSAGE", LAMBDA t : t.label = "message 'now()'")
==============================================================================
