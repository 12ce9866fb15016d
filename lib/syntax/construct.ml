type place =
  | Begins | Limits | Begins_or_limits | Joins | Control | Defines | Declares | Constant | Procedure | Task_procedure
  | Block

type word = { spelling : string; place : place; form : string; text : string }

type kind = Guard | Code | Handler | Maker | Task | Later | Duration | Number | Text | Pairs | Vehicles | Settings

type part = { name : string; kind : kind; many : bool }

type t = { name : string; words : word list; parts : part list; rules : string list; example : string }

let word place spelling form text = { spelling; place; form; text }
let one name kind = { name; kind; many = false }
let many name kind = { name; kind; many = true }

let row ?(words = []) ?(parts = []) ?(rules = []) ?(example = "") name = { name; words; parts; rules; example }

(* {1 Tasks} *)

let tasks = [
  row "platform task" ~parts:[ one "plan" Text ] ~rules:[ "START"; "DONE"; "FAIL" ] ~example:"task('survey')"
    ~words:[
      word Task_procedure "task" "task('name')" "The platform's plan of this name, as a task.";
      word Task_procedure "imcPlan" "imcPlan('name')"
        "The plan of this name, as a task; `imcPlan { ... }` describes one.";
      word Block "imcPlan" "imcPlan { locate 41.185, -8.706; goTo speed: 1.2 }"
        "An inline plan: settings, and maneuvers in their order.";
      word Block "mission" "mission { takeOff 30; goPos p; returnHomeAndLand() }"
        "A mission of items in their order, for vehicles such as those that speak MAVLink." ];
  row "action" ~parts:[ one "code" Code ] ~rules:[ "ACTION"; "ACTION-ERR" ] ~example:"action { post done: 1 }"
    ~words:[
      word Task_procedure "action" "action { ... }" "A task without a vehicle that runs code at once, in one step." ];
  row "condition" ~parts:[ one "guard" Guard ] ~rules:[ "CONDITION"; "CONDITION-ERR" ]
    ~example:"condition { poll go: 1 }"
    ~words:[
      word Task_procedure "condition" "condition { C }" "A task without a vehicle that is done when C holds." ];
  row "assert" ~parts:[ one "guard" Guard; one "text" Text ] ~rules:[ "ASSERT-ERR" ]
    ~example:"assert({ poll go: 1 }, 'no sign')"
    ~words:[
      word Task_procedure "assert" "assert { C }, 'text'"
        "The program ends with the text if C does not hold. As part of a task, a task that is done at once." ];
  row "sequence" ~parts:[ one "first" Task; one "second" Later ] ~rules:[ "SEQ-1"; "SEQ-2"; "SEQ-ERR" ]
    ~example:"task('a') >> task('b')";
  row "parallel" ~parts:[ one "left" Task; one "right" Task ] ~rules:[ "PAR-1"; "PAR-2"; "PAR-ERR" ]
    ~example:"task('a') | task('b')";
  row "allOf" ~parts:[ many "guard" Guard; many "branch" Later ]
    ~rules:[ "ALLOF-WHEN"; "ALLOF-1"; "ALLOF-2"; "ALLOF-ERR" ]
    ~example:"allOf { when { poll a: 1 } then task('a'); when { poll b: 1 } then task('b') }"
    ~words:[
      word Block "allOf" "allOf { when { C } then T ... }"
        "Each task runs once its condition holds; done when all are.";
      word Begins "when" "when { C } then T"
        "In allOf and oneOf: T runs once C holds, which is judged and taken in one step.";
      word Joins "then" "when { C } then T" "The task that runs once the condition holds." ];
  row "oneOf" ~parts:[ many "guard" Guard; many "branch" Later ] ~rules:[ "ONEOF-WHEN"; "ONEOF-ERR" ]
    ~example:"oneOf { when { poll a: 1 } then task('a'); when { poll b: 1 } then task('b') }"
    ~words:[
      word Block "oneOf" "oneOf { when { C } then T ... }"
        "The task whose condition holds first runs; the others never do.";
      word Block "choose" "choose { when { C } then T ... }" "Another word for `oneOf`." ];
  row "waitFor" ~parts:[ one "guard" Guard; one "task" Later ] ~example:"waitFor { poll go: 1 } then task('a')"
    ~words:[ word Begins "waitFor" "waitFor { C } then T" "T, which starts as soon as C holds." ];
  row "until" ~parts:[ one "guard" Guard; one "task" Task ]
    ~rules:[ "UNTIL-CUT"; "ASSURE-CUT"; "UNTIL-1"; "UNTIL-2"; "UNTIL-ERR" ]
    ~example:"until { poll stop: 1 } run task('a')"
    ~words:[
      word Begins_or_limits "until" "until { C } run T"
        "T, which is stopped and done when C holds. Also `T until { C }`.";
      word Begins_or_limits "assure" "assure { C } run T"
        "T, which is stopped and fails when C does not hold. Also `T assure { C }`." ];
  row "idle" ~parts:[ one "time" Duration ] ~rules:[ "IDLE-END" ] ~example:"idle(10.seconds)"
    ~words:[
      word Task_procedure "idle" "idle(10.seconds)" "A task without a vehicle that is done after this time." ];
  row "confirm" ~parts:[ one "prompt" Text ] ~rules:[ "CONFIRM-YES"; "CONFIRM-NO" ] ~example:"confirm('Go on?')"
    ~words:[
      word Task_procedure "confirm" "confirm 'prompt'"
        "Asks a question that takes yes or no. As part of a task: a task, done by yes, failed by no." ];
  row "during" ~parts:[ one "time" Duration; one "task" Task ]
    ~rules:[ "DURING-SET"; "DURING-CUT"; "WITHIN-CUT"; "DURING-1"; "DURING-2"; "DURING-ERR" ]
    ~example:"during 1.minute run task('a')"
    ~words:[
      word Begins_or_limits "during" "during D run T"
        "T, which is stopped and done after the time D. Also `T during D`.";
      word Begins_or_limits "within" "within D run T"
        "T, which is stopped and fails if it is not done after the time D. Also `T within D`.";
      word Joins "run" "during D run T" "The task to which a limit belongs." ];
  row "watch" ~parts:[ one "task" Task; one "handler" Handler ]
    ~rules:[ "WATCH-1"; "WATCH-2"; "WATCH-IGNORE"; "WATCH-PROPAGATE"; "WATCH-HALT"; "WATCH-RETRY"; "WATCH-INSTEAD" ]
    ~example:"watch task('a') onError { err -> ignore() }"
    ~words:[
      word Begins "watch" "watch T onError { err -> ... }"
        "T; an error in it stops it and runs the code, which may `ignore()`, `propagate()`, `retry()` or `halt()`.";
      word Joins "onError" "watch T onError { err -> ... }" "The reaction to an error of the watched task.";
      word Procedure "ignore" "ignore()" "In `onError`: the watched task counts as done.";
      word Procedure "propagate" "propagate()" "In `onError`: the error climbs on.";
      word Procedure "retry" "retry()"
        "In `onError`: the watched task runs once more, with vehicles that are free then.";
      word Procedure "dismiss" "dismiss e.vehicle"
        "In `onError`: the vehicles leave the program, even if they do not answer.";
      word Procedure "fail" "fail 'why'" "An error with this text, which a `watch` around the task handles." ];
  row "repeat" ~parts:[ one "rounds" Number; one "task" Task; one "guard" Guard ]
    ~rules:[ "REPEAT-1"; "REPEAT-2"; "REPEAT-UNTIL"; "REPEAT-AGAIN"; "REPEAT-ERR" ]
    ~example:"repeat 2, task('a') until { poll stop: 1 }"
    ~words:[ word Begins "repeat" "repeat T" "T, again and again." ];
  row "made" ~parts:[ one "code" Maker ]
    ~rules:[ "MAKE"; "MAKE-ERR"; "ALLOCATE"; "ALLOCATE-ERR"; "HOLD-1"; "HOLD-2"; "HOLD-ERR" ]
    ~example:"task('a') >> { task('b') }";
  row "recruit" ~parts:[ one "vehicle" Settings; one "code" Maker ]
    ~rules:[ "RECRUIT"; "RECRUIT-1"; "RECRUIT-2"; "RECRUIT-ERR" ]
    ~example:"recruit { type 'UAV' } then { v -> task('a') }"
    ~words:[
      word Block "recruit" "recruit { type 'UAV' } then { v -> T }"
        "A task that waits for such a vehicle, has it run the task made of it, and releases it then." ];
  row "fresh" ~parts:[ one "code" Maker ] ~rules:[ "FRESH-1"; "FRESH-2"; "FRESH-ERR" ]
    ~example:"fresh { k -> action { post((k): 1) } }"
    ~words:[
      word Task_procedure "fresh" "fresh { k -> T }"
        "A task with a key of its own, for `post((k): 1)` and the like, unknown to the rest of the program." ];
  row "ensure" ~parts:[ one "task" Task; one "deeds" Pairs ] ~rules:[ "ENSURE-1"; "ENSURE-2"; "ENSURE-ERR" ]
    ~example:"task('a') ensure { post free: 1 }"
    ~words:[
      word Limits "ensure" "T ensure { post k: x }"
        "T, whose end posts pairs and assigns globals in the same step, however it ends: done, failed or stopped." ];
  row "using" ~parts:[ one "pairs" Pairs; one "task" Later ] ~example:"using lock: 1 run task('a')"
    ~words:[
      word Begins "using" "using k: x run T"
        ("T, once the pair is there; it is taken, and given back when T ends, fails or is stopped. "
         ^ "Also `using k: _ run { x -> T }`.") ] ]

(* {1 The script} *)

let script = [
  row "statements" ~rules:[ "SCRIPT" ] ~example:"def n = 1"
    ~words:[
      word Defines "def" "def x = e"
        "A local variable, which ends with its block; at the top of a program the same as `x = e`. `def \
         f(x) { ... }` defines a function.";
      word Declares "parameter" "parameter n = e, 'what it is'"
        "A global whose value can be replaced at the start, by `--set n=e`; `dolphin help` lists them.";
      word Control "if" "if (c) { ... } else { ... }" "Runs the first block if the condition holds, else the second.";
      word Control "else" "if (c) { ... } else { ... }" "The block for a condition that does not hold.";
      word Control "while" "while (c) { ... }" "Repeats the block as long as the condition holds.";
      word Control "for" "for (x in xs) { ... }" "Goes through lists, ranges, vehicle sets, strings and maps.";
      word Control "in" "x in xs" "Whether x is an element of xs; in `for`, the collection to go through.";
      word Control "return" "return e" "Ends a function or closure with the value e.";
      word Control "break" "break" "Ends the innermost loop.";
      word Control "continue" "continue" "Goes on with the next round of the innermost loop.";
      word Constant "true" "true" "The truth value.";
      word Constant "false" "false" "The truth value.";
      word Constant "null" "null" "No value." ];
  row "post" ~parts:[ one "pairs" Pairs ] ~rules:[ "POST" ] ~example:"post k: 1"
    ~words:[ word Procedure "post" "post k: x" "Puts pairs into the tuple space." ];
  row "consume" ~parts:[ one "pairs" Pairs ] ~rules:[ "CONSUME" ] ~example:"consume k: 1"
    ~words:[
      word Procedure "consume" "consume k: x"
        "Takes pairs out of the tuple space, all of them or none, and is true if it took them. `_` is any value.";
      word Procedure "poll" "poll k: x"
        "Whether the pairs are in the tuple space; takes nothing. `poll 'k'` asks for any pair of that key." ];
  row "message" ~parts:[ one "text" Text ] ~rules:[ "MESSAGE" ] ~example:"message 'ready'"
    ~words:[
      word Procedure "message" "message x" "Shows a value to people.";
      word Procedure "println" "println x" "Shows a value to people, as `message`." ];
  row "release" ~parts:[ one "vehicles" Vehicles ] ~rules:[ "RELEASE" ] ~example:"release v"
    ~words:[ word Procedure "release" "release vs" "Gives the vehicles back: others may pick them." ];
  row "setConnectionTimeout" ~parts:[ one "vehicles" Vehicles; one "time" Number ] ~rules:[ "SET-TIMEOUT" ]
    ~example:"setConnectionTimeout v, 2.min"
    ~words:[
      word Procedure "setConnectionTimeout" "setConnectionTimeout vs, 2.min"
        "The longest silence of the vehicles before their tasks fail." ];
  row "pick" ~parts:[ one "vehicles" Settings; one "alternative" Code ]
    ~rules:[ "PICK"; "PICK-BIND"; "PICK-ERR"; "PICK-ELSE" ] ~example:"w = pick { type 'UUV' }"
    ~words:[
      word Block "pick" "pick { count 3; type 'UUV' }"
        "Binds vehicles to the program and gives them as a set. `else { ... }` is the alternative if too few come." ];
  row "ask" ~parts:[ one "prompt" Text ] ~rules:[ "ASK"; "ANSWER"; "ANSWER-ERR" ] ~example:"x = ask('How many?')"
    ~words:[
      word Procedure "ask" "ask 'prompt'"
        "Asks people a question; its value is that of the expression typed in answer." ];
  row "pause" ~parts:[ one "time" Number ] ~rules:[ "PAUSE"; "RESUME" ] ~example:"pause 2.min"
    ~words:[ word Procedure "pause" "pause 2.min" "Makes the script wait." ];
  row "supplier" ~parts:[ one "call" Text ] ~rules:[ "CALL"; "REPLY"; "CALL-ERR" ]
    ~example:"x = getSupplier().next()"
    ~words:[
      word Procedure "getSupplier" "getSupplier()" "The object of the outside process that `--supplier` starts." ];
  row "execute" ~parts:[ many "task" Task ] ~rules:[ "EXECUTE"; "EXECUTE-DONE"; "EXECUTE-ERR"; "ALLOC-ERR" ]
    ~example:"execute task('a')"
    ~words:[
      word Procedure "execute" "execute v1: T1, v2: T2"
        "Allocates the parts of the tasks to vehicles, runs them, and waits until they are done. Also \
         `execute T`, on any of the vehicles picked." ];
  row "input" ~parts:[ many "key" Text ] ~rules:[ "INPUT" ] ~example:"input 'goal'"
    ~words:[
      word Procedure "input" "input 'key', ..."
        "At the top: pairs with these keys may be posted from outside at any time. With `of: 'vehicle'` behind them \
         their values are single vehicles." ];
  row "end" ~rules:[ "END" ];
  row "halt" ~parts:[ one "text" Text ] ~rules:[ "HALT" ] ~example:"halt 'why'"
    ~words:[
      word Procedure "halt" "halt 'why'"
        "Ends the program: running tasks are stopped, and all vehicles are released." ];
  row "fault" ~rules:[ "FAULT" ];
  row "onInterrupt" ~parts:[ one "task" Maker ] ~rules:[ "INTERRUPT"; "ON-INTERRUPT" ]
    ~example:"onInterrupt { vs -> idle(1) }"
    ~words:[
      word Procedure "onInterrupt" "onInterrupt { vs -> T }"
        "At the top: a task that Ctrl-C executes on the picked vehicles, instead of only stopping. A second Ctrl-C \
         stops all." ] ]

let all = tasks @ script
let words = List.concat_map (fun row -> row.words) all
let rules = List.concat_map (fun row -> row.rules) all

let is_reserved word =
  match word.place with
  | Begins | Limits | Begins_or_limits | Joins | Control | Defines | Constant -> true
  | Declares | Procedure | Task_procedure | Block -> false

let kind_name = function
  | Guard -> "guard"
  | Code -> "code"
  | Handler -> "handler"
  | Maker -> "code that gives a task"
  | Task -> "task"
  | Later -> "task that begins later"
  | Duration -> "time"
  | Number -> "number"
  | Text -> "text"
  | Pairs -> "pairs"
  | Vehicles -> "vehicles"
  | Settings -> "settings"
