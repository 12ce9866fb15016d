---------------------------- MODULE DolphinChecking ----------------------------
(* The additions for checking a program by TLC: transitions computed once a state;  *)
(* a run with distinguishable steps, so that termination can be checked; an action  *)
(* for each rule, for TLC to count; and the printed graph. A model extends this     *)
(* module.                                                                          *)
EXTENDS DolphinEnvironment

VARIABLES
  label,  \* of the last transition, "" at the start. It belongs to runs, not to states: View leaves it out
  again   \* TRUE after an odd number of transitions that all left the state as it was

View == << vars, again >>

-----------------------------------------------------------------------------
(* {1 Transitions, once a state} *)

(* Known(vars) is Transitions. It is a constant, for which a configuration puts ComputedOnce: TLC's register 1 has
   the last ones, for all actions and properties that ask. TLC's -coverage lays out everything that an action can
   reach, separately for each action; it does not go on into the replacement of a constant, if that is a LET. *)
CONSTANT Known(_)

ASSUME TLCSet(1, << >>)

ComputedOnce(state) ==
  LET last == TLCGet(1)
  IN IF last # << >> /\ last[1] = state THEN last[2]
     ELSE CHOOSE ts \in { Transitions } : TLCSet(1, << state, ts >>)

(* A transition on an event that Which holds of is possible. *)
Possible(Which(_)) == \E ts \in { Known(vars) } : \E j \in DOMAIN ts : Which(ts[j].event)

-----------------------------------------------------------------------------
(* {1 Runs} *)

CheckedInitAt(date, silent) == InitAt(date, silent) /\ label = "" /\ again = FALSE
CheckedInit == CheckedInitAt(AnyDate, << >>)

(* A transition may leave the state as it is: each round of "while (true) { message 'x' }" does. To TLA+ such a
   transition is stuttering, and a run of nothing else looks unfair, as if the program stood still though it could go
   on. The bit again makes every transition a step. *)
Some(Which(_)) ==
  \E ts \in { Known(vars) } : \E j \in DOMAIN ts :
    /\ Which(ts[j].event)
    /\ Becomes(ts[j])
    /\ label' = ts[j].label
    /\ again' = (vars' = vars /\ ~again)

IsAny(event) == TRUE

(* WF_View(Some(Which)). Each transition is a step, so Possible(Which) is ENABLED <<Some(Which)>>_View; it is faster. *)
Fair(Which(_)) == []<>~Possible(Which) \/ []<><< Some(Which) >>_View

(* Tasks that run end, timers that run expire, steps of the program that stay possible are taken. *)
Fairness ==
  /\ Fair(IsOwed)
  /\ Fair(IsProgram)
  /\ Fair(IsTimer)
  /\ \A v \in Identifiers : Fair(LAMBDA event : IsEndOf(v, event))

Spec == CheckedInit /\ [][Some(IsAny)]_<< View, label >> /\ Fairness

-----------------------------------------------------------------------------
(* {1 Properties of transitions} *)

NoDeadlock == HasEnded \/ Possible(IsOwed)

TuplesConserved == \A ts \in { Known(vars) } : \A j \in DOMAIN ts : ConservesTuples(ts[j])

(* r may begin rounds without a number: of a repeat, or of a task that its handler tries again. *)
RECURSIVE GoesRound(_)
GoesRound(r) ==
  CASE r.op = "repeat" -> r.left = << >> \/ \E j \in DOMAIN r.runs : GoesRound(r.runs[j])
    [] r.op = "watch" -> r.anew # << >> \/ GoesRound(r.body)
    [] r.op = "seq" -> GoesRound(r.first)
    [] r.op = "par" -> \E j \in DOMAIN r.branches : GoesRound(r.branches[j])
    [] r.op = "allOf" -> \E j \in DOMAIN r.runs : GoesRound(r.runs[j])
    [] r.op \in { "until", "during", "hold", "recruited", "fresh", "ensure" } -> GoesRound(r.body)
    [] OTHER -> FALSE

InRounds == control.at = "exec" /\ GoesRound(control.r)

(* Runs that stay in the rounds of one task are left out: Fairness is too weak for them. *)
Termination == <>HasEnded \/ <>[]InRounds

(* Of every program; NoDeadlock and Termination are of some only. *)
THEOREM Conservation == Spec => []TuplesConserved

-----------------------------------------------------------------------------
(* {1 The graph} *)

(* For graphs, label and again stay as they are: the states are those of the system. *)
Unmarked(t) == Becomes(t) /\ UNCHANGED << label, again >>

GraphNext == \E ts \in { Known(vars) } : \E j \in DOMAIN ts : Unmarked(ts[j])

(* A graph has the runs of Spec, but for its fairness and its marks. make crosscheck compares it with the explorer's. *)
THEOREM SameSteps == [][Some(IsAny)]_<< View, label >> => [][Next]_vars

(* {2 An action for each rule} *)

(* Those of the transitions ts in whose derivations this rule stands, by number. *)
Taking(rule, ts) == { j \in DOMAIN ts : rule \in Range(ts[j].rules) }

Take_START(ts) == \E j \in Taking("START", ts) : Unmarked(ts[j])
Take_DONE(ts) == \E j \in Taking("DONE", ts) : Unmarked(ts[j])
Take_FAIL(ts) == \E j \in Taking("FAIL", ts) : Unmarked(ts[j])
Take_ACTION(ts) == \E j \in Taking("ACTION", ts) : Unmarked(ts[j])
Take_ACTION_ERR(ts) == \E j \in Taking("ACTION-ERR", ts) : Unmarked(ts[j])
Take_CONDITION(ts) == \E j \in Taking("CONDITION", ts) : Unmarked(ts[j])
Take_CONDITION_ERR(ts) == \E j \in Taking("CONDITION-ERR", ts) : Unmarked(ts[j])
Take_ASSERT_ERR(ts) == \E j \in Taking("ASSERT-ERR", ts) : Unmarked(ts[j])
Take_SEQ_1(ts) == \E j \in Taking("SEQ-1", ts) : Unmarked(ts[j])
Take_SEQ_2(ts) == \E j \in Taking("SEQ-2", ts) : Unmarked(ts[j])
Take_SEQ_ERR(ts) == \E j \in Taking("SEQ-ERR", ts) : Unmarked(ts[j])
Take_PAR_1(ts) == \E j \in Taking("PAR-1", ts) : Unmarked(ts[j])
Take_PAR_2(ts) == \E j \in Taking("PAR-2", ts) : Unmarked(ts[j])
Take_PAR_ERR(ts) == \E j \in Taking("PAR-ERR", ts) : Unmarked(ts[j])
Take_ALLOF_WHEN(ts) == \E j \in Taking("ALLOF-WHEN", ts) : Unmarked(ts[j])
Take_ALLOF_1(ts) == \E j \in Taking("ALLOF-1", ts) : Unmarked(ts[j])
Take_ALLOF_2(ts) == \E j \in Taking("ALLOF-2", ts) : Unmarked(ts[j])
Take_ALLOF_ERR(ts) == \E j \in Taking("ALLOF-ERR", ts) : Unmarked(ts[j])
Take_ONEOF_WHEN(ts) == \E j \in Taking("ONEOF-WHEN", ts) : Unmarked(ts[j])
Take_ONEOF_ERR(ts) == \E j \in Taking("ONEOF-ERR", ts) : Unmarked(ts[j])
Take_UNTIL_CUT(ts) == \E j \in Taking("UNTIL-CUT", ts) : Unmarked(ts[j])
Take_ASSURE_CUT(ts) == \E j \in Taking("ASSURE-CUT", ts) : Unmarked(ts[j])
Take_UNTIL_1(ts) == \E j \in Taking("UNTIL-1", ts) : Unmarked(ts[j])
Take_UNTIL_2(ts) == \E j \in Taking("UNTIL-2", ts) : Unmarked(ts[j])
Take_UNTIL_ERR(ts) == \E j \in Taking("UNTIL-ERR", ts) : Unmarked(ts[j])
Take_IDLE_END(ts) == \E j \in Taking("IDLE-END", ts) : Unmarked(ts[j])
Take_CONFIRM_YES(ts) == \E j \in Taking("CONFIRM-YES", ts) : Unmarked(ts[j])
Take_CONFIRM_NO(ts) == \E j \in Taking("CONFIRM-NO", ts) : Unmarked(ts[j])
Take_DURING_SET(ts) == \E j \in Taking("DURING-SET", ts) : Unmarked(ts[j])
Take_DURING_CUT(ts) == \E j \in Taking("DURING-CUT", ts) : Unmarked(ts[j])
Take_WITHIN_CUT(ts) == \E j \in Taking("WITHIN-CUT", ts) : Unmarked(ts[j])
Take_DURING_1(ts) == \E j \in Taking("DURING-1", ts) : Unmarked(ts[j])
Take_DURING_2(ts) == \E j \in Taking("DURING-2", ts) : Unmarked(ts[j])
Take_DURING_ERR(ts) == \E j \in Taking("DURING-ERR", ts) : Unmarked(ts[j])
Take_WATCH_1(ts) == \E j \in Taking("WATCH-1", ts) : Unmarked(ts[j])
Take_WATCH_2(ts) == \E j \in Taking("WATCH-2", ts) : Unmarked(ts[j])
Take_WATCH_IGNORE(ts) == \E j \in Taking("WATCH-IGNORE", ts) : Unmarked(ts[j])
Take_WATCH_PROPAGATE(ts) == \E j \in Taking("WATCH-PROPAGATE", ts) : Unmarked(ts[j])
Take_WATCH_HALT(ts) == \E j \in Taking("WATCH-HALT", ts) : Unmarked(ts[j])
Take_WATCH_RETRY(ts) == \E j \in Taking("WATCH-RETRY", ts) : Unmarked(ts[j])
Take_WATCH_INSTEAD(ts) == \E j \in Taking("WATCH-INSTEAD", ts) : Unmarked(ts[j])
Take_REPEAT_1(ts) == \E j \in Taking("REPEAT-1", ts) : Unmarked(ts[j])
Take_REPEAT_2(ts) == \E j \in Taking("REPEAT-2", ts) : Unmarked(ts[j])
Take_REPEAT_UNTIL(ts) == \E j \in Taking("REPEAT-UNTIL", ts) : Unmarked(ts[j])
Take_REPEAT_AGAIN(ts) == \E j \in Taking("REPEAT-AGAIN", ts) : Unmarked(ts[j])
Take_REPEAT_ERR(ts) == \E j \in Taking("REPEAT-ERR", ts) : Unmarked(ts[j])
Take_MAKE(ts) == \E j \in Taking("MAKE", ts) : Unmarked(ts[j])
Take_MAKE_ERR(ts) == \E j \in Taking("MAKE-ERR", ts) : Unmarked(ts[j])
Take_ALLOCATE(ts) == \E j \in Taking("ALLOCATE", ts) : Unmarked(ts[j])
Take_ALLOCATE_ERR(ts) == \E j \in Taking("ALLOCATE-ERR", ts) : Unmarked(ts[j])
Take_HOLD_1(ts) == \E j \in Taking("HOLD-1", ts) : Unmarked(ts[j])
Take_HOLD_2(ts) == \E j \in Taking("HOLD-2", ts) : Unmarked(ts[j])
Take_HOLD_ERR(ts) == \E j \in Taking("HOLD-ERR", ts) : Unmarked(ts[j])
Take_RECRUIT(ts) == \E j \in Taking("RECRUIT", ts) : Unmarked(ts[j])
Take_RECRUIT_1(ts) == \E j \in Taking("RECRUIT-1", ts) : Unmarked(ts[j])
Take_RECRUIT_2(ts) == \E j \in Taking("RECRUIT-2", ts) : Unmarked(ts[j])
Take_RECRUIT_ERR(ts) == \E j \in Taking("RECRUIT-ERR", ts) : Unmarked(ts[j])
Take_FRESH_1(ts) == \E j \in Taking("FRESH-1", ts) : Unmarked(ts[j])
Take_FRESH_2(ts) == \E j \in Taking("FRESH-2", ts) : Unmarked(ts[j])
Take_FRESH_ERR(ts) == \E j \in Taking("FRESH-ERR", ts) : Unmarked(ts[j])
Take_ENSURE_1(ts) == \E j \in Taking("ENSURE-1", ts) : Unmarked(ts[j])
Take_ENSURE_2(ts) == \E j \in Taking("ENSURE-2", ts) : Unmarked(ts[j])
Take_ENSURE_ERR(ts) == \E j \in Taking("ENSURE-ERR", ts) : Unmarked(ts[j])
Take_SCRIPT(ts) == \E j \in Taking("SCRIPT", ts) : Unmarked(ts[j])
Take_POST(ts) == \E j \in Taking("POST", ts) : Unmarked(ts[j])
Take_CONSUME(ts) == \E j \in Taking("CONSUME", ts) : Unmarked(ts[j])
Take_MESSAGE(ts) == \E j \in Taking("MESSAGE", ts) : Unmarked(ts[j])
Take_RELEASE(ts) == \E j \in Taking("RELEASE", ts) : Unmarked(ts[j])
Take_SET_TIMEOUT(ts) == \E j \in Taking("SET-TIMEOUT", ts) : Unmarked(ts[j])
Take_PICK(ts) == \E j \in Taking("PICK", ts) : Unmarked(ts[j])
Take_PICK_BIND(ts) == \E j \in Taking("PICK-BIND", ts) : Unmarked(ts[j])
Take_PICK_ERR(ts) == \E j \in Taking("PICK-ERR", ts) : Unmarked(ts[j])
Take_PICK_ELSE(ts) == \E j \in Taking("PICK-ELSE", ts) : Unmarked(ts[j])
Take_ASK(ts) == \E j \in Taking("ASK", ts) : Unmarked(ts[j])
Take_ANSWER(ts) == \E j \in Taking("ANSWER", ts) : Unmarked(ts[j])
Take_ANSWER_ERR(ts) == \E j \in Taking("ANSWER-ERR", ts) : Unmarked(ts[j])
Take_PAUSE(ts) == \E j \in Taking("PAUSE", ts) : Unmarked(ts[j])
Take_RESUME(ts) == \E j \in Taking("RESUME", ts) : Unmarked(ts[j])
Take_CALL(ts) == \E j \in Taking("CALL", ts) : Unmarked(ts[j])
Take_REPLY(ts) == \E j \in Taking("REPLY", ts) : Unmarked(ts[j])
Take_CALL_ERR(ts) == \E j \in Taking("CALL-ERR", ts) : Unmarked(ts[j])
Take_EXECUTE(ts) == \E j \in Taking("EXECUTE", ts) : Unmarked(ts[j])
Take_EXECUTE_DONE(ts) == \E j \in Taking("EXECUTE-DONE", ts) : Unmarked(ts[j])
Take_EXECUTE_ERR(ts) == \E j \in Taking("EXECUTE-ERR", ts) : Unmarked(ts[j])
Take_ALLOC_ERR(ts) == \E j \in Taking("ALLOC-ERR", ts) : Unmarked(ts[j])
Take_INPUT(ts) == \E j \in Taking("INPUT", ts) : Unmarked(ts[j])
Take_END(ts) == \E j \in Taking("END", ts) : Unmarked(ts[j])
Take_HALT(ts) == \E j \in Taking("HALT", ts) : Unmarked(ts[j])
Take_FAULT(ts) == \E j \in Taking("FAULT", ts) : Unmarked(ts[j])
Take_INTERRUPT(ts) == \E j \in Taking("INTERRUPT", ts) : Unmarked(ts[j])
Take_ON_INTERRUPT(ts) == \E j \in Taking("ON-INTERRUPT", ts) : Unmarked(ts[j])

(* The same as GraphNext. A transition is counted under each rule of its derivation: TLC -coverage shows which rules
   were used. TLC looks through all that a definition without parameters applies before it starts, but once through
   what a LET names. *)
NextByRule ==
  LET ts == Known(vars) IN
     \/ Take_START(ts) \/ Take_DONE(ts) \/ Take_FAIL(ts) \/ Take_ACTION(ts) \/ Take_ACTION_ERR(ts)
     \/ Take_CONDITION(ts) \/ Take_CONDITION_ERR(ts) \/ Take_ASSERT_ERR(ts) \/ Take_SEQ_1(ts) \/ Take_SEQ_2(ts)
     \/ Take_SEQ_ERR(ts) \/ Take_PAR_1(ts) \/ Take_PAR_2(ts) \/ Take_PAR_ERR(ts) \/ Take_ALLOF_WHEN(ts)
     \/ Take_ALLOF_1(ts) \/ Take_ALLOF_2(ts) \/ Take_ALLOF_ERR(ts) \/ Take_ONEOF_WHEN(ts) \/ Take_ONEOF_ERR(ts)
     \/ Take_UNTIL_CUT(ts) \/ Take_ASSURE_CUT(ts) \/ Take_UNTIL_1(ts) \/ Take_UNTIL_2(ts) \/ Take_UNTIL_ERR(ts)
     \/ Take_IDLE_END(ts) \/ Take_CONFIRM_YES(ts) \/ Take_CONFIRM_NO(ts) \/ Take_DURING_SET(ts)
     \/ Take_DURING_CUT(ts) \/ Take_WITHIN_CUT(ts) \/ Take_DURING_1(ts) \/ Take_DURING_2(ts) \/ Take_DURING_ERR(ts)
     \/ Take_WATCH_1(ts) \/ Take_WATCH_2(ts) \/ Take_WATCH_IGNORE(ts) \/ Take_WATCH_PROPAGATE(ts)
     \/ Take_WATCH_HALT(ts) \/ Take_WATCH_RETRY(ts) \/ Take_WATCH_INSTEAD(ts) \/ Take_REPEAT_1(ts)
     \/ Take_REPEAT_2(ts) \/ Take_REPEAT_UNTIL(ts) \/ Take_REPEAT_AGAIN(ts) \/ Take_REPEAT_ERR(ts) \/ Take_MAKE(ts)
     \/ Take_MAKE_ERR(ts) \/ Take_ALLOCATE(ts) \/ Take_ALLOCATE_ERR(ts) \/ Take_HOLD_1(ts) \/ Take_HOLD_2(ts)
     \/ Take_HOLD_ERR(ts) \/ Take_RECRUIT(ts) \/ Take_RECRUIT_1(ts) \/ Take_RECRUIT_2(ts) \/ Take_RECRUIT_ERR(ts)
     \/ Take_FRESH_1(ts) \/ Take_FRESH_2(ts) \/ Take_FRESH_ERR(ts) \/ Take_ENSURE_1(ts) \/ Take_ENSURE_2(ts)
     \/ Take_ENSURE_ERR(ts) \/ Take_SCRIPT(ts) \/ Take_POST(ts) \/ Take_CONSUME(ts) \/ Take_MESSAGE(ts)
     \/ Take_RELEASE(ts) \/ Take_SET_TIMEOUT(ts) \/ Take_PICK(ts) \/ Take_PICK_BIND(ts) \/ Take_PICK_ERR(ts)
     \/ Take_PICK_ELSE(ts) \/ Take_ASK(ts) \/ Take_ANSWER(ts) \/ Take_ANSWER_ERR(ts) \/ Take_PAUSE(ts)
     \/ Take_RESUME(ts) \/ Take_CALL(ts) \/ Take_REPLY(ts) \/ Take_CALL_ERR(ts) \/ Take_EXECUTE(ts)
     \/ Take_EXECUTE_DONE(ts) \/ Take_EXECUTE_ERR(ts) \/ Take_ALLOC_ERR(ts) \/ Take_INPUT(ts) \/ Take_END(ts)
     \/ Take_HALT(ts) \/ Take_FAULT(ts) \/ Take_INTERRUPT(ts) \/ Take_ON_INTERRUPT(ts)

-----------------------------------------------------------------------------
(* {1 A run, told} *)

(* An ALIAS, for TLC to show for each state of a run instead of the variables: the visible part of it, and the
   transition by which the run goes on; by several, if they lead to the same state. *)
Told ==
  LET taken == SelectSeq(Known(vars), Becomes)
  IN [ control |-> IF control.at = "end" THEN << "end", control.ending.how, control.ending.message >>
                   ELSE << control.at >>,
       store |-> [ x \in Range(GlobalNames) |-> store[IndexOf(GlobalNames, x)] ],
       A |-> [ v \in DOMAIN A |-> A[v].name ],
       B |-> B,
       N |-> N,
       goes_on |-> Each(taken, LAMBDA t : t.label),
       by |-> Each(taken, LAMBDA t : t.rules) ]

-----------------------------------------------------------------------------
(* {1 The graph, printed} *)

(* The elements of a set, in an order that is always the same. *)
RECURSIVE InOrder(_)
InOrder(set) == IF set = { } THEN << >> ELSE LET x == CHOOSE x \in set : TRUE IN << x >> \o InOrder(set \ { x })

(* A text for a state, the same for equal ones: comparing a value brings TLC to put the fields of its records in
   order. *)
StateText(kappa, S, environment) ==
  Only({ IF state = state THEN ToString(state) ELSE "" : state \in {
    << kappa, S.store, Each(S.B, LAMBDA v : IF v \in DOMAIN S.A THEN << S.A[v] >> ELSE << >>), S.B,
       Each(InOrder(DOMAIN S.N.queue), LAMBDA k : << k, S.N.queue[k] >>),
       Each(InOrder(DOMAIN S.N.bag), LAMBDA pair : << pair, S.N.bag[pair] >>),
       environment.failed, environment.losses, InOrder(environment.lost), InOrder(environment.late),
       Each(InOrder(Prompts), LAMBDA prompt : environment.asked[prompt]),
       Each(InOrder(Calls), LAMBDA call : environment.called[call]), environment.sent >> } })

(* {2 Effects} *)

EffectText(e) ==
  CASE e[1] = "start" -> "start " \o e[3].name \o " on " \o e[2]
    [] e[1] = "stop" -> "stop " \o e[2]
    [] e[1] = "set timer" -> "set timer " \o ToString(e[2]) \o " to " \o ShortText(e[3]) \o " s"
    [] e[1] \in { "cancel timer", "withdraw question" } -> e[1] \o " " \o ToString(e[2])
    [] e[1] = "put question" -> "put question " \o ToString(e[2]) \o ": " \o e[3]
    [] e[1] = "look for" -> "look for " \o PickText(e[2])
    [] e[1] \in { "bind", "release" } -> e[1] \o " " \o Join(e[2], ", ")
    [] e[1] = "connection timeout" ->
         "connection timeout " \o ShortText(e[3]) \o " s"
         \o (IF e[2] = << >> THEN "" ELSE " for " \o Join(e[2][1], ", "))
    [] e[1] \in { "say", "ask", "call" } -> e[1] \o " " \o e[2]
    [] e[1] = "end" ->
         CASE e[2].how = "completed" -> "end"
           [] e[2].how = "halted" -> "end: halted " \o e[2].message
           [] e[2].how = "failed" -> "end: " \o e[2].message
           [] e[2].how = "interrupted" -> "end: interrupted"

(* The order in which vehicles stop together is open: here in pick order, recruits last. *)
RECURSIVE InPickOrder(_)
InPickOrder(effects) ==
  LET isStop(j) == effects[j][1] = "stop"
      n == CHOOSE n \in 0 .. Len(effects) :
             (\A j \in 1 .. n : isStop(j)) /\ (n = Len(effects) \/ ~isStop(n + 1))
      stopped == { effects[j][2] : j \in 1 .. n }
  IN CASE effects = << >> -> << >>
       [] n = 0 -> << Head(effects) >> \o InPickOrder(Tail(effects))
       [] OTHER -> Each(SelectSeq(B \o RecruitsOf(control), LAMBDA v : v \in stopped), LAMBDA v : << "stop", v >>)
                   \o InPickOrder(SubSeq(effects, n + 1, Len(effects)))

(* The label of t, and its effects after that. *)
LabelOf(t) == t.label
LabelAndEffects(t) ==
  t.label \o (IF t.effects = << >> THEN "" ELSE " ! " \o Join(Each(InPickOrder(t.effects), EffectText), "; "))

(* {2 Lines} *)

PrintMark(text) == PrintT("M\t" \o text)

PrintEnd ==
  LET ending == control.ending
  IN PrintMark("ended: " \o
       CASE ending.how = "completed" -> IF NothingLeft THEN "completed" ELSE "completed, with tuples left"
         [] ending.how = "interrupted" -> "interrupted"
         [] OTHER -> ending.how \o ": " \o ending.message)

(* A normal value, to be printed. *)
RECURSIVE Listed(_)
Listed(x) ==
  CASE Is(x, "list") -> List(Each(x[2], Listed))
    [] Is(x, "map") -> << "map", Each(InOrder(x[2]), LAMBDA entry : << entry[1], Listed(entry[2]) >>) >>
    [] Is(x, "vehicles") ->
         LET known == SelectSeq(Fleet, LAMBDA vehicle : vehicle.id \in x[2])
         IN Vehicles(Each(known, LAMBDA vehicle : vehicle.id))
    [] OTHER -> x

(* The visible part of the state: its ending, B, A and N. *)
PrintMarks ==
  /\ control.at = "end" => PrintEnd
  /\ B # << >> => PrintMark("B " \o Join(B, ", "))
  /\ \A v \in DOMAIN A : PrintMark("A " \o v \o ": " \o A[v].name)
  /\ \A k \in DOMAIN N.queue :
       PrintMark("N " \o PairsText(Each(N.queue[k], LAMBDA x : << k, x >>)) \o " in order")
  /\ \A pair \in DOMAIN N.bag :
       PrintMark("N " \o PairText(<< pair[1], Listed(pair[2]) >>) \o " * " \o ToString(N.bag[pair]))

(* Prints the state and its transitions, of the program with this number. TLC evaluates an invariant once for each state
   that it finds: this one is always true. *)
PrintGraphOf(program, TextOf(_)) ==
  LET here == ToString(program) \o ": "
  IN /\ PrintT("S\t" \o here \o StateText(control, Shared, outside) \o "\t" \o ToString(program))
     /\ PrintMarks
     /\ \A ts \in { Known(vars) } : \A j \in DOMAIN ts :
          PrintT("E\t" \o TextOf(ts[j]) \o "\t" \o here \o StateText(ts[j].control, ts[j].S, ts[j].outside)
                 \o "\t" \o Join(ts[j].rules, ", "))

PrintGraph == PrintGraphOf(1, LabelOf)
==============================================================================
