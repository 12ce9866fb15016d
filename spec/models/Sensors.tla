-------------------------------- MODULE Sensors --------------------------------
(* Sensors are open at each step, and stay within a step: those of u1 have any reading, u2 is seen in one of two
   places. *)
EXTENDS Model

Battery(e) == Apply([ op |-> "sensor", name |-> "battery" ], << e >>)
Low(e) == Operator("<", e, Const(Number(3, 10)))
Charged(e) == Operator(">=", e, Const(Number(3, 10)))
Both(a, b) == Operator("&&", a, b)

Body ==
  Block(<< Assign(1, PickId("u1")),
           Assign(2, Battery(V)),
           ExecuteTask(Beside(On(UntilRun(1, Plan("long")), V), Condition(2))),
           If(Both(Low(Battery(V)), Charged(Battery(V))), Halt("both"), Const(Null)),
           If(Both(Low(W), Charged(Battery(V))), Halt("charged since"), Const(Null)),
           Pick(<< Setting("id", String("u2")), Setting("region", << "area", 1, 100, 1 >>) >>) >>)

Closures == << Low(Battery(V)), Charged(Battery(V)) >>

(* A comparison is known by its text; its answers are 1 and 2, that it holds and that it does not. *)
IsLow == "battery(u1) < 0.3"
WasLow == "w < 0.3"

Claim ==
  /\ By_("UNTIL-CUT", LAMBDA t : Seen(t, IsLow, 1))
  /\ By_("CONDITION", LAMBDA t : Seen(t, IsLow, 2))
  /\ By_("HALT", LAMBDA t : t.label = "halt(charged since)" /\ Seen(t, IsLow, 2) /\ Seen(t, WasLow, 1))

Sighted(j) == << "position", j >>
SensorFleet ==
  << [ ModelFleet[1] EXCEPT !.position = << >>, !.sensors[1].shows = << >> ],
     [ ModelFleet[2] EXCEPT !.places = << 1, 2 >>, !.position = << Sighted(1), Sighted(2) >> ] >>
SensorPlaces == << "(41.185000, -8.706200)", "(41.195000, -8.706200)" >>
SensorDistances == << << 0, 1110671 >>, << 1110671, 0 >> >>
==============================================================================
