--------------------------------- MODULE Model ---------------------------------
(* Words to write small programs in, as TLA+ expressions, where `dolphin tla` would translate a text. A model extends
   this module and defines the script (Body), the code of its closures (Closures), and its claim (Claim). Model.cfg
   has the rest in common. *)
EXTENDS DolphinChecking

CONSTANTS
  ScriptOfModel,   \* Body
  ClosuresOfModel  \* Closures

(* {1 Expressions, as tables: a node, then those of its parts; the parts by how far on they are} *)

(* Recursive functions rather than operators, here: TLC recomputes definitions by operators at each use. *)
All(es) == LET first[j \in 0 .. Len(es)] == IF j = 0 THEN << >> ELSE first[j - 1] \o es[j] IN first[Len(es)]

Tree(is, fields, es) ==
  << [ is |-> is, fields |-> fields,
       parts |-> << >> \o [ j \in DOMAIN es |-> 1 + Len(All(SubSeq(es, 1, j - 1))) ] ] >> \o All(es)

Const(x) == Tree("constant", x, << >>)
Apply(operation, es) == Tree("apply", operation, es)
Block(es) == Tree("block", 0, es)
Variable(i) == Tree("global", i, << >>)
Assign(i, e) == Tree("setGlobal", i, << e >>)
If(test, yes, no) == Tree("if", 0, << test, yes, no >>)
Loop(test, body) == Tree("while", 0, << test, body >>)

Constant(s) == Const(String(s))
NumberOf(n) == Const(Integer(n))
Plain(op, es) == Apply([ op |-> op ], es)
Operator(sign, a, b) == Apply([ op |-> "binary", sign |-> sign ], << a, b >>)

(* The script is closure 1 of the table, and 2 is the answer of people. *)
Closure(j) == Const(<< "closure", j + 2, << >> >>)

Then(a, b) == Operator(">>", a, b)
Beside(a, b) == Operator("|", a, b)
On(t, V) == Plain("element", << t, V >>)
Plan(p) == Plain("task", << Constant(p) >>)
Action(j) == Plain("action", << Closure(j) >>)
Condition(j) == Plain("condition", << Closure(j) >>)
WaitFor(j, t) == Plain("waitFor", << Closure(j), t >>)
UntilRun(j, t) == Plain("until", << Closure(j), t >>)
Idle(n) == Plain("idle", << NumberOf(n) >>)
AssureRun(j, t) == Plain("assure", << Closure(j), t >>)
DuringRun(e, t) == Plain("during", << e, t >>)
WithinRun(e, t) == Plain("within", << e, t >>)
WatchOnError(t, j) == Plain("watch", << t, Closure(j) >>)

RepeatTimes(n, t) == Apply([ op |-> "repeat", counted |-> TRUE, asked |-> FALSE ], << NumberOf(n), t >>)
RepeatUntil(t, j) == Apply([ op |-> "repeat", counted |-> FALSE, asked |-> TRUE ], << t, Closure(j) >>)

(* allOf { ... } and oneOf { ... }: guards by number, with their tasks. *)
Branches(whens) ==
  LET first[j \in 0 .. Len(whens)] ==
        IF j = 0 THEN Const(Settings(<< >>))
        ELSE Plain("branch", << first[j - 1], Closure(whens[j][1]), whens[j][2] >>)
  IN first[Len(whens)]

Builder(name, whens) == Apply([ op |-> "build", builder |-> name ], << Branches(whens) >>)

Setting(name, x) == [ name |-> name, positional |-> << x >>, named |-> << >>, at |-> 1 ]
Pick(settings) == Apply([ op |-> "build", builder |-> "pick" ], << Const(Settings(settings)) >>)
PickId(v) == Pick(<< Setting("id", String(v)) >>)

DoPosting(k, e) == Apply([ op |-> "post", keys |-> << << k >> >> ], << e >>)
Consuming(k, e) == Apply([ op |-> "consume", keys |-> << << k >> >> ], << e >>)
Polling(k, e) == Apply([ op |-> "poll", keys |-> << << k >> >> ], << e >>)
Message(s) == Plain("message", << Constant(s) >>)
Halt(s) == Plain("halt", << Constant(s) >>)
Ignore == Plain("ignore", << >>)
Retry == Plain("retry", << >>)
Fail(s) == Plain("fail", << Constant(s) >>)
Pause(n) == Plain("pause", << NumberOf(n) >>)
Ask(s) == Plain("ask", << Constant(s) >>)
Confirm(s) == Plain("confirm", << Constant(s) >>)
ReleaseAll(e) == Plain("release", << e >>)
TimeoutOf(n) == Plain("setConnectionTimeout", << NumberOf(n) >>)
CallHost == Plain("getSupplier", << >>)
ExecuteTask(t) == Plain("execute", << t >>)
Broke == Operator("/", NumberOf(1), NumberOf(0))
Assertion(test) == If(test, Const(Null), Plain("assert", << >>))

(* {1 The tables of the specification, where parts have the numbers of their nodes} *)

NodeOf(e, n) ==
  LET part == << >> \o [ j \in DOMAIN e.parts |-> n + e.parts[j] ]
  IN CASE e.is = "constant" -> [ is |-> e.is, value |-> e.fields ]
       [] e.is = "apply" -> [ is |-> e.is, operation |-> e.fields, arguments |-> part ]
       [] e.is = "block" -> [ is |-> e.is, parts |-> part ]
       [] e.is = "global" -> [ is |-> e.is, global |-> e.fields ]
       [] e.is = "setGlobal" -> [ is |-> e.is, global |-> e.fields, value |-> part[1] ]
       [] e.is = "if" -> [ is |-> e.is, test |-> part[1], yes |-> part[2], no |-> part[3] ]
       [] e.is = "while" -> [ is |-> e.is, test |-> part[1], body |-> part[2] ]

LambdaAt(n, name, parameters) ==
  [ label |-> name, parameters |-> parameters, implicit |-> TRUE, captures |-> << >>, slots |-> parameters, code |-> n,
    recovers |-> TRUE ]

Pieces(body, closures) == << body, NumberOf(2) >> \o closures

CodeOfModel(body, closures) ==
  LET all == All(Pieces(body, closures)) IN << >> \o [ n \in DOMAIN all |-> NodeOf(all[n], n) ]

LambdasOfModel(body, closures) ==
  << >> \o [ j \in DOMAIN Pieces(body, closures) |->
              LambdaAt(1 + Len(All(SubSeq(Pieces(body, closures), 1, j - 1))), "code", IF j < 3 THEN 0 ELSE 1) ]

(* TLC recomputes the replacement of a constant in a configuration at each use, other definitions once: so a name of
   one of these is put there. *)
CodeTable == CodeOfModel(ScriptOfModel, ClosuresOfModel)
LambdaTable == LambdasOfModel(ScriptOfModel, ClosuresOfModel)
LambdaNameTable == << >> \o [ j \in 1 .. 2 + Len(ClosuresOfModel) |-> "closure " \o ToString(j) ]

ModelCode == CodeTable
ModelLambdas == LambdaTable

(* {1 A world} *)

SensorNamed(name, text, shows) == [ name |-> name, text |-> text, shows |-> shows ]

VehicleNamed(v, type) ==
  [ id |-> v, type |-> type, payload |-> << >>, devices |-> { }, places |-> << 1 >>,
    position |-> << << "position", 1 >> >>,
    sensors |-> << SensorNamed("battery", "battery(" \o v \o ")", << << "number", 1, 1 >> >>) >> ]

(* Three UUVs and a plane, at one place. *)
ModelFleet ==
  << VehicleNamed("u1", "UUV"), VehicleNamed("u2", "UUV"), VehicleNamed("u3", "UUV"), VehicleNamed("a", "UAV") >>

(* The answer of people, twice; and then nothing. *)
Two_ == [ text |-> "2", lambda |-> 2, why |-> "" ]
ModelAnswers(prompt) == << << Two_ >>, << Two_ >>, << >> >>
(* Questions of tasks they answer by yes or by no, but for one. *)
ModelConfirmations(prompt) ==
  IF prompt = "is anybody there?" THEN << << "nobody", "none is given" >> >> ELSE << << "yes" >>, << "no" >> >>
ModelPrompts == { "how many?" }

(* The supplier replies, or fails. *)
ModelHostReplies(call, at) == << << << "value", String("yes") >>, << "failure", "no" >> >> >>
ModelCalls == { }
ModelInputs == << >>

(* Plans succeed, but for some. *)
ModelEnding(v, p) == CASE p = "risky" -> "may fail" [] p = "doomed" -> "fails" [] OTHER -> "succeeds"
ModelFailures == -1

ModelSiteOf(n) == "expression " \o ToString(n)

ModelMain == << "closure", 1, << >> >>
ModelOnInterrupt == << >>
ModelPlaces == << "(41.185000, -8.706200)" >>
ModelDistances == << << 0 >> >>
ModelPlans == << >>
ModelNames == << "v", "w" >>
ModelLambdaNames == LambdaNameTable
ModelOrderedKeys == { "oldest" }
ModelOrderedPrefixes == { }

V == Variable(1)
W == Variable(2)

(* {1 Claims} *)

Rules(t) == Range(t.rules)

(* Wherever this rule is used, P holds of the transition. *)
By_(rule, P(_)) == \A ts \in { Known(vars) } : \A j \in DOMAIN ts : rule \in Rules(ts[j]) => P(ts[j])

(* The comparison with this text was seen to have this answer. *)
Seen(t, text, answer) == \E question \in Claims(t.S.sees) : question[2] = text /\ t.S.sees[question] = answer

Fails_(t) == t.control.at = "end" /\ t.control.ending.how = "failed"
RunsOf(S) == { S.A[v].name : v \in DOMAIN S.A }
==============================================================================
