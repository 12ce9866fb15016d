-------------------------------- MODULE Paper --------------------------------
(* The program of the paper: three vehicles survey, report that they are ready, and keep station; a plane meets each,
   in any order. *)
EXTENDS Model

(* No ToString here: TLC would rebuild the program whenever it looks at it. *)
Surveys == << "survey1", "survey2", "survey3" >>
Keeps == << "sk1", "sk2", "sk3" >>
Meetings == << "rv1", "rv2", "rv3" >>

Survey(i) == Then(Then(Plan(Surveys[i]), Action(i)), Plan(Keeps[i]))
Meet(i) == << 3 + i, Plan(Meetings[i]) >>

Body ==
  Block(<< Assign(1, Pick(<< Setting("count", Integer(3)), Setting("type", String("UUV")) >>)),
           Assign(2, Pick(<< Setting("type", String("UAV")) >>)),
           TimeoutOf(120),
           ExecuteTask(Beside(On(Beside(Beside(Survey(1), Survey(2)), Survey(3)), V),
                              On(Builder("allOf", << Meet(1), Meet(2), Meet(3) >>), W))),
           ReleaseAll(Operator("+", V, W)),
           Message("Done!") >>)

Closures == [ j \in 1 .. 6 |-> IF j <= 3 THEN DoPosting("ready", NumberOf(j)) ELSE Consuming("ready", NumberOf(j - 3)) ]

(* No vehicle is met before its survey has ended. *)
Claim == \A i \in 1 .. 3 : ~({ Meetings[i], Surveys[i] } \subseteq RunsOf(Shared))
==============================================================================
