---------------------------- MODULE DolphinMachine ----------------------------
(* The machine that runs a program's code: the script between the steps that     *)
(* others see, and the code of guards, actions and handlers in one go. Machine,  *)
(* Operation, Procedures and Methods in lib/semantics are its counterparts; the  *)
(* judgements "M -> ..." and "S |- g => x, S', ds" of docs/semantics.md are Run  *)
(* and RunCode here.                                                             *)
EXTENDS DolphinValues, Bags

CONSTANTS
  Code,         \* the expressions of the program, by number: records with a field "is"
  Lambdas,      \* its closures and functions, by number
  GlobalNames,  \* the names of its global variables, by number
  OrderedKeys,  \* the keys of which some "consume k:_" takes the oldest pair
  OrderedPrefixes, \* how keys begin of which some "consume k:_" may take the oldest pair, that computes its key
  OnInterrupt,  \* the closure that an interruption calls with the vehicles of B, if there is one: << it >>, or << >>
  Fleet,        \* the vehicles around, in the order in which they were heard of; position: what it may show, anything
                \* if it is nothing; sensors: likewise of those that the program reads, with names and texts;
                \* places: where it may be when it is picked
  Plans,        \* what allocation must know of each inline plan, by number
  ScriptFuel,   \* how many expressions the script evaluates in one silent step
  AtomicFuel,   \* how many code of a task may take before it counts as endless
  MaximumCalls, \* how deep calls may nest
  SiteOf(_)     \* where expression n is in the text of the program; of -n, where closure n is

ProgramOK ==
  /\ \A n \in DOMAIN Code : Code[n].is \in STRING
  /\ \A i \in DOMAIN Lambdas : Lambdas[i].code \in DOMAIN Code /\ Lambdas[i].parameters <= Lambdas[i].slots
  /\ OrderedKeys \cup OrderedPrefixes \subseteq STRING
  /\ \A i \in DOMAIN Plans : IsFiniteSet(Plans[i].devices)
  /\ { ScriptFuel, AtomicFuel, MaximumCalls } \subseteq Nat \ { 0 }

FleetOK ==
  /\ \A i, j \in DOMAIN Fleet : Fleet[i].id = Fleet[j].id => i = j
  /\ \A i \in DOMAIN Fleet : Fleet[i].places # << >> /\ Range(Fleet[i].places) \subseteq DOMAIN Places

ASSUME ProgramOK

ASSUME FleetOK

(* {1 The tuple space N} *)

(* A queue for each key that has a pair and whose order can matter, of values as they were posted; for all others a bag
   of pairs, whose values are normal. *)
NoTuples == [ queue |-> << >>, bag |-> EmptyBag ]

IsOrdered(k) ==
  k \in OrderedKeys \/ \E prefix \in OrderedPrefixes : Len(prefix) <= Len(k) /\ SubSeq(k, 1, Len(prefix)) = prefix

QueueOf(N, k) == IF k \in DOMAIN N.queue THEN N.queue[k] ELSE << >>
WithQueue(N, k, xs) ==
  LET others == [ l \in DOMAIN N.queue \ { k } |-> N.queue[l] ]
  IN [ N EXCEPT !.queue = IF xs = << >> THEN others ELSE (k :> xs) @@ others ]

Post(N, k, x) ==
  IF IsOrdered(k) THEN WithQueue(N, k, Append(QueueOf(N, k), x))
  ELSE [ N EXCEPT !.bag = @ (+) SetToBag({ << k, Normal(x) >> }) ]

RECURSIVE PostAll(_, _)
PostAll(N, pairs) == IF pairs = << >> THEN N ELSE PostAll(Post(N, Head(pairs)[1], Head(pairs)[2]), Tail(pairs))

HasPair(N, k, x) ==
  IF IsOrdered(k) THEN Normal(x) \in Range(Each(QueueOf(N, k), Normal)) ELSE BagIn(<< k, Normal(x) >>, N.bag)

HasKeyIn(N, k) ==
  IF IsOrdered(k) THEN k \in DOMAIN N.queue ELSE \E pair \in BagToSet(N.bag) : pair[1] = k

IsThere(N, k, x) == IF x = Wildcard THEN HasKeyIn(N, k) ELSE HasPair(N, k, x)

(* The value of the pair that "consume k:x" takes, which is there. *)
Taken(N, k, x) == IF x = Wildcard THEN Head(N.queue[k]) ELSE x

WithoutPair(N, k, x) ==
  IF IsOrdered(k)
  THEN LET xs == QueueOf(N, k) IN WithQueue(N, k, Without(xs, IndexOf(Each(xs, Normal), Normal(x))))
  ELSE [ N EXCEPT !.bag = @ (-) SetToBag({ << k, Normal(x) >> }) ]

(* All of the pairs, one after the other, or none: the pairs taken, and the rest. *)
RECURSIVE TakeAll(_, _, _)
TakeAll(N, pairs, taken) ==
  IF pairs = << >> THEN << [ N |-> N, taken |-> taken ] >>
  ELSE LET k == Head(pairs)[1]
           x == Head(pairs)[2]
       IN IF IsThere(N, k, x)
          THEN LET y == Taken(N, k, x) IN TakeAll(WithoutPair(N, k, y), Tail(pairs), Append(taken, << k, y >>))
          ELSE << >>

(* N without the pairs of these keys; and those pairs. *)
WithoutKeys(N, keys) ==
  LET bag == N.bag
      queue == N.queue
  IN [ bag |-> [ pair \in { pair \in DOMAIN bag : pair[1] \notin keys } |-> bag[pair] ],
       queue |-> [ k \in DOMAIN queue \ keys |-> queue[k] ] ]

RECURSIVE OneByOne(_)
OneByOne(bag) ==
  IF DOMAIN bag = { } THEN << >>
  ELSE LET pair == CHOOSE pair \in DOMAIN bag : TRUE IN << pair >> \o OneByOne(bag (-) SetToBag({ pair }))

RECURSIVE QueuedWith(_, _)
QueuedWith(N, keys) ==
  IF keys = { } THEN << >>
  ELSE LET k == CHOOSE k \in keys : TRUE IN Each(QueueOf(N, k), LAMBDA x : << k, x >>) \o QueuedWith(N, keys \ { k })

PairsWith(N, keys) ==
  LET bag == N.bag
  IN OneByOne([ pair \in { pair \in DOMAIN bag : pair[1] \in keys } |-> bag[pair] ]) \o QueuedWith(N, keys)

(* The key of this number. *)
KeyText(i) == "#" \o ToString(i)
IsKeyText(k) ==
  /\ Len(k) > 1 /\ SubSeq(k, 1, 1) = "#"
  /\ \A i \in 2 .. Len(k) : SubSeq(k, i, i) \in { "0", "1", "2", "3", "4", "5", "6", "7", "8", "9" }

(* {1 The world} *)

(* Of vehicle v; the fleet alone determines the rest. *)
VehicleOf(v) == Fleet[CHOOSE i \in DOMAIN Fleet : Fleet[i].id = v]
IsKnown(v) == \E i \in DOMAIN Fleet : Fleet[i].id = v

Carries(vehicle, devices) == { Lower(d) : d \in Range(devices) } \subseteq vehicle.devices

(* {2 Sensors} *)

(* A sensor's reading is open, at each step; within one step it stays. S.sees is the answers seen in this step so
   far: for each question its answer, by number. There are two kinds of questions: <<sensor, v>> where the sensor (by
   its name, or "position") may show one of several values, and those of comparisons, as ComparisonOf has them. *)
NothingSeen == << >>
Seeing(sees, question, i) == (question :> i) @@ sees
Claims(sees) == { question \in DOMAIN sees : question[1] = "claim" }

MostClaims == 12

(* {3 The date} *)

(* S.date is the number of whole seconds since the start; the value of now() is open if it is AnyDate. *)
AnyDate == -1
DateAsValue(date) == IF date = AnyDate THEN Reading("amount", "now()") ELSE Integer(date)

(* In seconds since midnight: begins is that of the date 0, or << >> if it is not known. *)
DayLength == 86400
TimeOfDay(begins, date) ==
  IF date = AnyDate THEN Reading("amount", "timeOfDay()") ELSE Integer((begins[1] + date) % DayLength)

ReadsDate == \E n \in DOMAIN Code : Code[n].is = "apply" /\ Code[n].operation.op \in { "now", "timeOfDay" }

(* {3 Readings} *)

(* Whether there may be readings at all. *)
HasReadings ==
  ReadsDate \/
  \E j \in DOMAIN Fleet :
    Fleet[j].position = << >> \/ \E i \in DOMAIN Fleet[j].sensors : Fleet[j].sensors[i].shows = << >>

(* The sensor [name] of v, whose text is [text], shows one of xs. *)
Shown(quantity, name, text, v, xs) ==
  CASE xs = << >> -> Ok(Reading(quantity, text))
    [] Len(xs) = 1 -> Ok(xs[1])
    [] OTHER -> Depends(<< name, v >>, xs)

(* The place of v, as far as picking and allocating are concerned. *)
FoundAt(vehicle, sees) ==
  vehicle.places[IF Len(vehicle.places) = 1 THEN 1 ELSE sees[<< "position", vehicle.id >>]]

(* The seen answers, and the place of each of vs: in all ways. *)
RECURSIVE Placings(_, _)
Placings(sees, vs) ==
  IF vs = << >> THEN << sees >>
  ELSE LET question == << "position", Head(vs) >>
           places == VehicleOf(Head(vs)).places
           at(i) == Placings(Seeing(sees, question, i), Tail(vs))
       IN IF Len(places) = 1 \/ question \in DOMAIN sees THEN Placings(sees, Tail(vs))
          ELSE Flatten([ i \in DOMAIN places |-> at(i) ])

(* In the next step a sensor may have another reading: its reading then must not be taken for the present one. So a
   reading is known by the variable that keeps it. *)
KeptBy(keeper, x) == IF IsReading(x) THEN Reading(x[2], keeper) ELSE x

KeptInStore(store) ==
  LET kept(i) == IF store[i] = << >> THEN << >> ELSE << KeptBy(GlobalNames[i], store[i][1]) >>
  IN << >> \o [ i \in DOMAIN store |-> kept(i) ]

(* {1 What is held} *)

(* All nodes of the residuals rs, those to come included. *)
RECURSIVE Nodes(_)
Nodes(rs) ==
  LET below(r) ==
        CASE r.op = "seq" -> << r.first >> \o r.rest
          [] r.op = "par" -> r.branches
          [] r.op = "allOf" -> r.runs \o Each(r.choices, LAMBDA b : b.body)
          [] r.op = "repeat" -> Append(r.runs, r.each)
          [] r.op = "oneOf" -> Each(r.choices, LAMBDA b : b.body)
          [] r.op \in { "until", "during", "watch", "hold", "recruited", "fresh", "ensure" } -> << r.body >>
          [] OTHER -> << >>
  IN Flatten(Each(rs, LAMBDA r : << r >> \o Nodes(below(r))))

(* The vehicles that they name: on which their platform tasks run, or which they hold. *)
HeldBy(rs) ==
  UNION { CASE r.op \in { "ready", "running", "recruited" } -> { r.v }
            [] r.op = "hold" -> Range(r.vehicles)
            [] OTHER -> { } : r \in Range(Nodes(rs)) }

(* The timers that they name, the questions, the recruits, and the keys. *)
NumbersIn(rs) ==
  { r.timer : r \in { r \in Range(Nodes(rs)) : r.op \in { "idle", "confirm", "during", "recruit" } } }
  \cup UNION { Range(r.keys) : r \in { r \in Range(Nodes(rs)) : r.op = "fresh" } }

(* {1 Machines} *)

(* M is a record: its focus, an expression to evaluate or a value to give to the stack; its locals; its stack of
   frames, the latest first; and its place. While it runs, m has beside these what code sees and changes, and why it
   stops. *)

IsFrame(f) ==
  CASE f.frame \in { "arguments", "choose", "rest", "loopTest", "loopBody", "loopRange", "items", "iterate" } ->
         f.node \in DOMAIN Code
    [] f.frame = "setLocal" -> f.slot \in Nat \ { 0 }
    [] f.frame = "setGlobal" -> f.global \in DOMAIN GlobalNames
    [] f.frame = "leave" -> TRUE
    [] OTHER -> FALSE

IsMachine(M) ==
  /\ DOMAIN M = { "focus", "locals", "stack", "at" }
  /\ M.focus[1] = "give" \/ (M.focus[1] = "evaluate" /\ M.focus[2] \in DOMAIN Code)
  /\ M.at \in DOMAIN Code
  /\ \A i \in DOMAIN M.stack : IsFrame(M.stack[i])

(* While it runs, the focus may also be an operation whose arguments are values, or the result of one. *)
Evaluate(e) == << "evaluate", e >>
Give(x) == << "give", x >>

LocalsOf(closure, arguments) ==
  LET lambda == Lambdas[closure[2]]
      captured(slot) == IndexOf(lambda.captures, slot)
  IN << >> \o [ slot \in 1 .. lambda.slots |->
                  CASE captured(slot) # 0 -> closure[3][captured(slot)]
                    [] slot <= lambda.parameters /\ slot <= Len(arguments) -> arguments[slot]
                    [] OTHER -> Null ]

Call(closure, arguments) ==
  LET code == Lambdas[closure[2]].code
  IN [ focus |-> Evaluate(code), locals |-> LocalsOf(closure, arguments), stack |-> << >>, at |-> code ]

(* The expression whose part runs at the bottom of the stack, or which is about to run; 0 without one. *)
Outermost(M) ==
  CASE M.stack # << >> -> LET f == M.stack[Len(M.stack)] IN IF f.frame = "arguments" THEN f.node ELSE 0
    [] M.focus[1] = "evaluate" -> M.focus[2]
    [] OTHER -> 0

(* Whether M runs what onInterrupt executes: all of that is the argument of its end. *)
IsLeaving(M) ==
  LET n == Outermost(M)
  IN n # 0 /\ Code[n].is = "apply" /\ Code[n].operation.op = "interrupted"

(* M(x): a machine that waited, going on with x. *)
GoOn(M, x) == [ M EXCEPT !.focus = Give(x) ]

Going == << "going" >>

Started(M, S, mode, fuel) ==
  [ focus |-> M.focus, locals |-> M.locals, stack |-> M.stack, at |-> M.at,
    store |-> S.store, A |-> S.A, B |-> S.B, N |-> S.N, date |-> S.date, sees |-> S.sees, beside |-> S.beside,
    around |-> S.around,
    mode |-> mode, verdict |-> "propagate", deeds |-> << >>, fuel |-> fuel, stop |-> Going ]

(* Slots are counted from 0 here, arguments from the last one backwards. *)
KeptInSlots(where, xs) == << >> \o [ j \in DOMAIN xs |-> KeptBy(where \o " " \o ToString(j - 1), xs[j]) ]

KeptInFrame(f, height) ==
  LET n == Len(f.values)
      argument(j) == "argument at " \o ToString(height) \o ": " \o ToString(n - j)
  IN CASE f.frame = "arguments" ->
            [ f EXCEPT !.values = << >> \o [ j \in 1 .. n |-> KeptBy(argument(j), f.values[j]) ] ]
       [] f.frame = "leave" -> [ f EXCEPT !.locals = KeptInSlots("local at " \o ToString(height) \o ":", @) ]
       [] OTHER -> f

Machine(m) ==
  IF HasReadings
  THEN LET height(i) == Len(m.stack) + 1 - i
       IN [ focus |-> IF m.focus[1] = "give" THEN Give(KeptBy("value 0", m.focus[2])) ELSE m.focus,
            locals |-> KeptInSlots("local", m.locals),
            stack |-> << >> \o [ i \in DOMAIN m.stack |-> KeptInFrame(m.stack[i], height(i)) ],
            at |-> m.at ]
  ELSE [ focus |-> m.focus, locals |-> m.locals, stack |-> m.stack, at |-> m.at ]

Stop(m, why) == [ m EXCEPT !.stop = why ]

(* failed: the vehicle and the platform task that failed; << >> for other failures. *)
Fault(message, at) == [ message |-> message, at |-> at, assertion |-> FALSE, failed |-> << >> ]
Faulty(m, message) == Stop(m, << "faulted", Fault(message, m.at) >>)

(* x is a reading, and more than a comparison depends on it. *)
NoTelling(m, x) == Stop(m, << "unsettled", x[3] >>)

OpenHere(text, at) ==
  SiteOf(at) \o ": the value of " \o text
  \o " is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and "
  \o "measurements"

Result(m, x) == [ m EXCEPT !.focus = Give(x) ]
Settle(m, result) == [ m EXCEPT !.focus = << "result", result >> ]
Operate(m, n, xs) == [ m EXCEPT !.focus = << "operate", n, xs >> ]

Enter(m, e) == [ m EXCEPT !.focus = Evaluate(e) ]
Push(m, frame) == [ m EXCEPT !.stack = << frame >> \o @ ]

(* {1 Deeds and requests} *)

(* The script stops after each deed, so that others can see it; code of tasks goes on. *)
Did(m, deed, x) ==
  [ m EXCEPT !.deeds = Append(@, deed), !.focus = Give(x), !.stop = IF m.mode = "script" THEN << "did" >> ELSE Going ]

Request(m, name, request) ==
  IF m.mode = "script" THEN [ m EXCEPT !.focus = Give(Null), !.stop = << "waits", request >> ]
  ELSE Faulty(m, name \o " belongs to the script: code inside of a task cannot wait")

(* A call of the host: a procedure, or of an object a property (no arguments) or a method (one sequence of them). *)
RequestCall(m, call, arguments) == Request(m, call, << "call", call, arguments >>)
MemberOf(x, name) == x[2] \o "." \o name

(* {1 Settings} *)

SettingExpected(s, what) ==
  << "at", s.at, IF Len(s.positional) = 1 THEN Expected(what \o " after '" \o s.name \o "'", s.positional[1])
                 ELSE Bad("'" \o s.name \o "' takes " \o what) >>

SettingWrong(s, message) == << "at", s.at, Bad(message) >>

RECURSIVE Unescaped(_)
Unescaped(characters) ==
  CASE Len(characters) = 0 -> ""
    [] Head(characters) = "\\" /\ Len(characters) > 1 ->
         characters[2] \o Unescaped(SubSeq(characters, 3, Len(characters)))
    [] OTHER -> Head(characters) \o Unescaped(Tail(characters))

AnyVehicle ==
  [ id |-> << >>, type |-> << >>, payload |-> << >>, region |-> << >>, count |-> 1, all |-> FALSE, timeout |-> << >>,
    otherwise |-> FALSE ]

IsString(x) == Is(x, "string")
AreStrings(xs) ==
  \A i \in DOMAIN xs : Is(xs[i], "string") \/ (Is(xs[i], "list") /\ \A j \in DOMAIN xs[i][2] : IsString(xs[i][2][j]))
StringsOf(x) == IF IsString(x) THEN << x[2] >> ELSE LET text(y) == y[2] IN Each(x[2], text)

PickSetting(q, s) ==
  LET one == Len(s.positional) = 1
      x == s.positional[1]
      count == Canonical(x)
  IN CASE s.name = "id" ->
            IF one /\ IsString(x) THEN Ok([ q EXCEPT !.id = << Unescaped(Characters(x[2])) >> ])
            ELSE SettingExpected(s, "a string")
       [] s.name = "type" ->
            IF one /\ IsString(x) THEN Ok([ q EXCEPT !.type = << x[2] >> ])
            ELSE SettingExpected(s, "a string, as in type 'UUV'")
       [] s.name = "payload" ->
            CASE s.positional = << >> -> SettingExpected(s, "names of devices, as in payload 'DVL', 'Sidescan'")
              [] AreStrings(s.positional) -> Ok([ q EXCEPT !.payload = @ \o Flatten(Each(s.positional, StringsOf)) ])
              [] OTHER -> SettingExpected(s, "names of devices")
       [] s.name = "region" ->
            CASE one /\ Is(x, "area") -> Ok([ q EXCEPT !.region = << x >> ])
              [] Len(s.positional) = 2 /\ Is(x, "position") ->
                   LET area == Around(x, s.positional[2])
                   IN IF IsOk(area) THEN Ok([ q EXCEPT !.region = << area[2] >> ]) ELSE << "at", s.at, area >>
              [] OTHER -> SettingExpected(s, "an area, or a centre and a radius")
       [] s.name = "count" ->
            CASE one /\ Is(x, "wildcard") -> Ok([ q EXCEPT !.all = TRUE ])
              [] one /\ Is(count, "integer") ->
                   IF count[2] > 0 THEN Ok([ q EXCEPT !.count = count[2], !.all = FALSE ])
                   ELSE SettingWrong(s, "the number of vehicles must be greater than 0, it is " \o ToString(count[2]))
              [] OTHER -> SettingExpected(s, "a whole number, or _ for all")
       [] s.name = "timeout" ->
            CASE one /\ IsNumber(x) /\ ~Less(x, Integer(0)) -> Ok([ q EXCEPT !.timeout = << Canonical(x) >> ])
              [] one /\ IsNumber(x) -> SettingWrong(s, "a timeout is 0 seconds or more, not " \o ShortText(x))
              [] OTHER -> SettingExpected(s, "a time, as in timeout 10.seconds")
       [] OTHER -> SettingWrong(s, "pick has no setting '" \o s.name \o "'")

RECURSIVE ReadPick(_, _)
ReadPick(q, ss) ==
  IF ss = << >> THEN Ok(q)
  ELSE LET next == PickSetting(q, Head(ss)) IN IF IsOk(next) THEN ReadPick(next[2], Tail(ss)) ELSE next

RECURSIVE ReadBranches(_, _)
ReadBranches(branches, ss) ==
  IF ss = << >> THEN Ok(branches)
  ELSE LET s == Head(ss)
           is == s.name = "when" /\ Len(s.positional) = 2 /\ Is(s.positional[1], "closure")
       IN CASE is /\ IsTask(s.positional[2]) ->
                 LET branch == [ guard |-> s.positional[1], body |-> TaskOf(s.positional[2]) ]
                 IN ReadBranches(Append(branches, branch), Tail(ss))
            [] is -> << "at", s.at, Expected("a task after then", s.positional[2]) >>
            [] OTHER -> SettingWrong(s, "only when { ... } then TASK may stand here")

(* The name of an inline plan: that of its last planName, if it has one. *)
RECURSIVE ReadName(_, _)
ReadName(name, ss) ==
  CASE ss = << >> -> Ok(name)
    [] Head(ss).name # "planName" -> ReadName(name, Tail(ss))
    [] Len(Head(ss).positional) = 1 /\ IsString(Head(ss).positional[1]) ->
         LET given == Head(ss).positional[1][2]
         IN IF Assert(given # "", "a plan's name may not be empty") THEN ReadName(given, Tail(ss)) ELSE Ok(given)
    [] OTHER -> Bad(Assert(FALSE, "planName is translated for strings"))

Build(m, op, ss) ==
  CASE op.builder \in { "pick", "pick if any" } ->
         LET q == ReadPick([ AnyVehicle EXCEPT !.otherwise = op.builder = "pick if any" ], ss)
         IN IF IsOk(q) THEN Request(m, "pick", << "pick", q[2] >>) ELSE Settle(m, q)
    [] op.builder \in { "allOf", "oneOf" } ->
         LET branches == ReadBranches(<< >>, ss)
         IN CASE ~IsOk(branches) -> Settle(m, branches)
              [] branches[2] = << >> -> Faulty(m, "no when { ... } then TASK: there is nothing to choose from")
              [] OTHER -> Result(m, TaskValue([ op |-> op.builder, branches |-> branches[2] ]))
    [] op.builder = "imcPlan" ->
         Result(m, TaskValue([ op |-> "platform", name |-> ReadName(op.name, ss)[2], plan |-> op.plan, at |-> m.at ]))

(* {1 Properties and methods} *)

(* F gives a result. *)
OneVehicle(vs, F(_)) ==
  CASE Len(vs) # 1 -> Bad("the set must be a single vehicle, it has " \o ToString(Len(vs)))
    [] ~IsKnown(vs[1]) -> Bad("nothing is known of vehicle " \o vs[1])
    [] OTHER -> F(VehicleOf(vs[1]))

OneVehicleValue(x, F(_)) == IF Is(x, "vehicles") THEN OneVehicle(x[2], F) ELSE Expected("a vehicle", x)

StringList(names) == List(Each(names, String))

PositionOf(vehicle) ==
  Shown("place", "position", "position(" \o vehicle.id \o ")", vehicle.id, vehicle.position)

SensorOf(vehicle, name) ==
  LET s == CHOOSE s \in Range(vehicle.sensors) : s.name = name
  IN Shown("amount", name, s.text, vehicle.id, s.shows)

BatteryOf(vehicle) == SensorOf(vehicle, "battery")

NoGetter == << "none" >>

(* x is a list, a range or a vehicle set. *)
ItemGetter(x, name) ==
  LET items == Items(x)
      ofVehicles == Is(x, "vehicles")
      without(what) == Bad("an empty " \o (IF ofVehicles THEN "vehicle set" ELSE "list") \o " has no " \o what)
      rest(s) == IF s = << >> THEN << >> ELSE Tail(s)
  IN CASE name \in { "first", "head" } /\ items # << >> -> Ok(Head(items))
       [] name = "last" /\ items # << >> -> Ok(Last(items))
       [] name = "head" -> without("head")
       [] name \in { "first", "last" } -> without(name \o " element")
       [] name = "tail" -> Ok(IF ofVehicles THEN Vehicles(rest(x[2])) ELSE List(rest(items)))
       [] OTHER -> NoGetter

VehicleGetter(vs, name) ==
  CASE name = "id" -> IF Len(vs) = 1 THEN Ok(String(vs[1])) ELSE OneVehicle(vs, LAMBDA vehicle : Ok(String(vehicle.id)))
    [] name = "ids" -> Ok(StringList(vs))
    [] name = "type" -> OneVehicle(vs, LAMBDA vehicle : Ok(String(vehicle.type)))
    [] name = "position" -> OneVehicle(vs, PositionOf)
    [] name = "battery" -> OneVehicle(vs, BatteryOf)
    [] name = "payload" -> OneVehicle(vs, LAMBDA vehicle : Ok(StringList(vehicle.payload)))
    [] OTHER -> ItemGetter(Vehicles(vs), name)

SpecificGetter(x, name) ==
  CASE Is(x, "vehicles") -> VehicleGetter(x[2], name)
    [] Is(x, "list") \/ Is(x, "range") -> ItemGetter(x, name)
    [] Is(x, "area") ->
         CASE HasCorners(x) /\ name = "radius" -> Bad("only circles have a radius")
           [] name \in { "size", "bounds", "corners", "hull" } -> Bad(NoComputing)
           [] HasCorners(x) /\ name \in { "centre", "center" } -> Bad(NoComputing)
           [] name \in { "centre", "center" } -> Ok(<< "position", x[2] >>)
           [] name = "radius" -> Ok(Number(x[3], x[4]))
           [] OTHER -> NoGetter
    [] Is(x, "task") /\ x[2].op = "platform" /\ name \in { "id", "name" } -> Ok(String(x[2].name))
    [] OTHER -> NoGetter

Getter(x, name) ==
  LET specific == SpecificGetter(x, name)
  IN CASE specific # NoGetter -> specific
       [] HasItems(x) /\ name \in { "size", "length" } -> Ok(Integer(Length(x)))
       [] HasItems(x) /\ name \in { "empty", "isEmpty" } -> Ok(Boolean(Length(x) = 0))
       [] OTHER -> NoGetter

Property(x, name) ==
  LET getter == Getter(x, name)
  IN CASE Is(x, "map") /\ HasKey(x[2], name) -> Ok(Lookup(x[2], name))
       [] getter # NoGetter -> getter
       [] Is(x, "map") -> Ok(Null)
       [] IsNumber(x) -> InUnit(x, name)
       [] Is(x, "null") -> Bad("null has no property '" \o name \o "'")
       [] OTHER -> Bad(Kind(x) \o " has no property '" \o name \o "'")

RECURSIVE Sum(_, _)
Sum(total, items) ==
  IF items = << >> THEN Ok(total)
  ELSE LET next == Add(total, Head(items)) IN IF IsOk(next) THEN Sum(next[2], Tail(items)) ELSE next

(* The best item so far, bettered by those that compare with it so. *)
RECURSIVE Extreme(_, _, _)
Extreme(better, best, items) ==
  IF items = << >> THEN Ok(best)
  ELSE LET replace == Compared(better, Head(items), best)
       IN IF ~IsOk(replace) THEN replace
          ELSE Extreme(better, IF Truth(replace[2]) THEN Head(items) ELSE best, Tail(items))

RECURSIVE Distinct(_, _)
Distinct(kept, items) ==
  CASE items = << >> -> kept
    [] \E i \in DOMAIN kept : Equals(kept[i], Head(items)) -> Distinct(kept, Tail(items))
    [] OTHER -> Distinct(Append(kept, Head(items)), Tail(items))

Reversed(s) == << >> \o [ i \in DOMAIN s |-> s[Len(s) + 1 - i] ]
Clipped(n, low, high) == IF n < low THEN low ELSE IF n > high THEN high ELSE n

RECURSIVE FirstEqual(_, _, _)
FirstEqual(items, x, i) == IF i > Len(items) THEN 0 ELSE IF Equals(items[i], x) THEN i ELSE FirstEqual(items, x, i + 1)

(* Sorted by rank, equal ones in their order: the least of the rest comes next. *)
RECURSIVE SortedBy(_, _)
SortedBy(items, ranks) ==
  IF items = << >> THEN << >>
  ELSE LET i == CHOOSE i \in DOMAIN items :
                  \A j \in DOMAIN items : Less(ranks[i], ranks[j]) \/ (i <= j /\ ~Less(ranks[j], ranks[i]))
       IN << items[i] >> \o SortedBy(Without(items, i), Without(ranks, i))

Sorted(items, ranks) ==
  IF Assert(\A i \in DOMAIN ranks : IsNumber(ranks[i]), "this model can sort by numbers only")
  THEN SortedBy(items, ranks)
  ELSE << >>

ItemMethod(x, items, name, xs) ==
  LET one == Len(xs) = 1
      whole == one /\ Is(xs[1], "integer")
      n == xs[1][2]
  IN CASE name = "get" /\ one -> Element(x, xs[1])
       [] name \in { "add", "push", "leftShift" } /\ one -> AppendTo(x, xs[1])
       [] name = "addAll" /\ one -> Add(x, xs[1])
       [] name \in { "remove", "removeAt" } /\ whole ->
            IF 0 <= n /\ n < Len(items) THEN Ok(List(Without(items, n + 1))) ELSE OutOfRange(n, "the list", Len(items))
       [] name = "removeElement" /\ one ->
            LET i == FirstEqual(items, xs[1], 1) IN Ok(List(IF i = 0 THEN items ELSE Without(items, i)))
       [] name = "clear" /\ xs = << >> -> Ok(List(<< >>))
       [] name = "indexOf" /\ one -> Ok(Integer(FirstEqual(items, xs[1], 1) - 1))
       [] name = "reverse" /\ xs = << >> -> Ok(List(Reversed(items)))
       [] name = "sum" /\ xs = << >> -> Sum(Integer(0), items)
       [] name = "max" /\ xs = << >> -> IF items = << >> THEN Ok(Null) ELSE Extreme(">", Head(items), items)
       [] name = "min" /\ xs = << >> -> IF items = << >> THEN Ok(Null) ELSE Extreme("<", Head(items), items)
       [] name = "unique" /\ xs = << >> -> Ok(List(Distinct(<< >>, items)))
       [] name = "take" /\ whole -> Ok(List(SubSeq(items, 1, Clipped(n, 0, Len(items)))))
       [] name = "drop" /\ whole -> Ok(List(SubSeq(items, 1 + Clipped(n, 0, Len(items)), Len(items))))
       [] name = "toList" /\ xs = << >> -> Ok(List(items))
       [] name = "join" /\ (xs = << >> \/ (one /\ IsString(xs[1]))) ->
            Ok(String(Join(Each(items, Text), IF one THEN xs[1][2] ELSE "")))
       [] name = "sort" /\ xs = << >> -> Ok(List(Sorted(items, items)))
       [] OTHER -> NoGetter

MapMethod(x, name, xs) ==
  LET one == Len(xs) = 1
      entries == x[2]
      key == Text(xs[1])
  IN CASE name \in { "get", "getAt" } /\ one -> Element(x, xs[1])
       [] name = "get" /\ Len(xs) = 2 -> Ok(IF HasKey(entries, key) THEN Lookup(entries, key) ELSE xs[2])
       [] name = "containsKey" /\ one -> Ok(Boolean(HasKey(entries, key)))
       [] name = "containsValue" /\ one -> Ok(Boolean(\E i \in DOMAIN entries : Equals(xs[1], entries[i][2])))
       [] name \in { "keySet", "keys" } /\ xs = << >> -> Ok(List(Each(entries, LAMBDA e : String(e[1]))))
       [] name = "values" /\ xs = << >> -> Ok(List(Each(entries, LAMBDA e : e[2])))
       [] name = "put" /\ Len(xs) = 2 -> ReplaceElement(x, xs[1], xs[2])
       [] name = "remove" /\ one ->
            Ok(<< "map", IF HasKey(entries, key) THEN Without(entries, PlaceOfKey(entries, key, 1)) ELSE entries >>)
       [] name = "clear" /\ xs = << >> -> Ok(<< "map", << >> >>)
       [] OTHER -> NoGetter

NumberMethod(x, name, xs) ==
  CASE xs # << >> -> NoGetter
    [] name = "abs" -> Ok(IF Is(x, "integer") THEN Integer(Abs(x[2])) ELSE Number(Abs(Numerator(x)), Denominator(x)))
    [] name = "round" -> Ok(Integer(Rounded(x)))
    [] name \in { "intValue", "toInteger" } -> Ok(Integer(Truncated(Fraction(x)[1], Fraction(x)[2])))
    [] name \in { "doubleValue", "toDouble" } -> Ok(Number(Numerator(x), Denominator(x)))
    [] OTHER -> NoGetter

StringMethod(s, name, xs) ==
  CASE name \in { "toLowerCase", "toLower" } /\ xs = << >> -> Ok(String(Lower(s)))
    [] name = "startsWith" /\ Len(xs) = 1 /\ IsString(xs[1]) ->
         Ok(Boolean(Len(xs[1][2]) <= Len(s) /\ SubSeq(s, 1, Len(xs[1][2])) = xs[1][2]))
    [] OTHER -> NoGetter

Specific(x, name, xs) ==
  CASE Is(x, "string") -> StringMethod(x[2], name, xs)
    [] Is(x, "map") -> MapMethod(x, name, xs)
    [] x[1] \in { "list", "range", "vehicles" } -> ItemMethod(x, Items(x), name, xs)
    [] IsNumber(x) -> NumberMethod(x, name, xs)
    [] Is(x, "position") ->
         IF name \in { "distance", "distanceTo" } /\ Len(xs) = 1 /\ Is(xs[1], "position")
         THEN Ok(<< "distance", Distances[x[2]][xs[1][2]] >>) ELSE NoGetter
    [] Is(x, "area") /\ name \in { "offset", "grid" } -> Bad(NoComputing)
    [] OTHER -> NoGetter

(* getX() is the getter x. *)
Getters == [ getId |-> "id", getIds |-> "ids", getType |-> "type", getPosition |-> "position", getBattery |-> "battery",
             getPayload |-> "payload", getSize |-> "size", getLength |-> "length", getFirst |-> "first",
             getLast |-> "last",
             getCentre |-> "centre", getCenter |-> "center", getRadius |-> "radius", getName |-> "name",
             getBounds |-> "bounds", getCorners |-> "corners" ]

Method(x, name, xs) ==
  LET specific == Specific(x, name, xs)
      getter == IF name \in DOMAIN Getters THEN Getter(x, Getters[name]) ELSE Getter(x, name)
  IN CASE name = "equals" /\ Len(xs) = 1 -> Ok(Boolean(Equals(x, xs[1])))
       [] name = "toString" /\ xs = << >> -> Ok(String(Text(x)))
       [] name = "contains" /\ Len(xs) = 1 /\ (HasItems(x) \/ Is(x, "area")) -> Member(xs[1], x)
       [] specific # NoGetter -> specific
       [] xs = << >> /\ getter # NoGetter -> getter
       [] IsString(x) /\ name \in { "toInteger", "toDouble" } -> Bad(Assert(FALSE, "this model cannot read numbers"))
       [] OTHER -> Bad(Kind(x) \o " has no method '" \o name \o "'")

Mathematics(name, xs) ==
  LET x == xs[1]
      numbers == \A i \in DOMAIN xs : IsNumber(xs[i])
  IN CASE name = "abs" /\ Is(x, "integer") -> Ok(Integer(Abs(x[2])))
       [] ~numbers -> Bad("Math." \o name \o " takes numbers")
       [] name = "max" -> Ok(IF Less(x, xs[2]) THEN xs[2] ELSE x)
       [] name = "min" -> Ok(IF Less(xs[2], x) THEN xs[2] ELSE x)
       [] name = "abs" -> Ok(Number(Abs(Numerator(x)), Denominator(x)))
       [] name = "round" -> LET a == Fraction(x) IN Ok(Integer((2 * a[1] + a[2]) \div (2 * a[2])))
       [] name = "floor" -> Ok(Number(Floor(x), 1))
       [] name = "ceil" -> LET a == Fraction(x) IN Ok(Number(-((-a[1]) \div a[2]), 1))
       [] name = "signum" -> Ok(Number(Sign(Fraction(x)[1]), 1))

(* {1 Going through items with a closure} *)

Iterations == { "each", "eachWithIndex", "times", "collect", "collectWithIndex", "findAll", "filter", "find", "any",
                "every",
                "count", "sum", "sort", "max", "min", "inject" }

IsIteration(x, name, xs) ==
  /\ name \in Iterations
  /\ xs # << >>
  /\ Is(Last(xs), "closure")
  /\ Len(xs) = IF name = "inject" THEN 2 ELSE 1
  /\ HasItems(x) \/ (Is(x, "integer") /\ name = "times")

IteratedItems(x) ==
  IF Is(x, "integer") THEN Each([ i \in 1 .. Clipped(x[2], 0, x[2]) |-> i - 1 ], Integer) ELSE Items(x)

IterationArguments(f, item) ==
  LET two == Lambdas[f.closure[2]].parameters = 2
  IN CASE f.iteration = "inject" -> << Last(f.gathered), item >>
       [] two /\ Is(f.subject, "map") -> << item[2][1][2], item[2][2][2] >>
       [] two -> << item, Integer(f.index - 1) >>
       [] OTHER -> << item >>

Picked(items, results) == LET keep(i) == Truth(results[i]) IN
  LET places == SelectSeq([ i \in DOMAIN items |-> i ], keep) IN Each(places, LAMBDA i : items[i])

SameKind(subject, items) ==
  CASE Is(subject, "vehicles") -> Vehicles(Flatten(Each(items, LAMBDA item : item[2])))
    [] Is(subject, "map") -> << "map", Each(items, LAMBDA item : << item[2][1][2][2], item[2][2][2] >>) >>
    [] OTHER -> List(items)

Concluded(f) ==
  LET name == f.iteration
  IN CASE name \in { "each", "eachWithIndex", "times" } -> Ok(f.subject)
       [] name \in { "collect", "collectWithIndex" } -> Ok(List(f.gathered))
       [] name \in { "findAll", "filter" } -> Ok(SameKind(f.subject, Picked(f.items, f.gathered)))
       [] name = "find" -> Ok(Null)
       [] name = "any" -> Ok(False)
       [] name = "every" -> Ok(True)
       [] name = "count" -> Ok(Integer(Len(SelectSeq(f.gathered, Truth))))
       [] name = "sum" -> Sum(Integer(0), f.gathered)
       [] name = "inject" -> Ok(Last(f.gathered))
       [] name = "sort" -> Ok(SameKind(f.subject, Sorted(f.items, f.gathered)))
       [] name = "max" -> Ok(IF f.items = << >> THEN Null ELSE Last(Sorted(f.items, f.gathered)))
       [] name = "min" -> Ok(IF f.items = << >> THEN Null ELSE Head(Sorted(f.items, f.gathered)))

(* The result that item i settles already, or nothing. *)
Early(f, result) ==
  CASE f.iteration = "find" /\ Truth(result) -> << f.items[f.index] >>
    [] f.iteration = "any" /\ Truth(result) -> << True >>
    [] f.iteration = "every" /\ ~Truth(result) -> << False >>
    [] OTHER -> << >>

(* {1 Calls} *)

Nesting(stack) == Cardinality({ i \in DOMAIN stack : stack[i].frame = "leave" })

EnterClosure(m, closure, xs) ==
  LET lambda == Lambdas[closure[2]]
      n == Len(xs)
      tail == m.stack # << >> /\ Head(m.stack).frame = "leave"
      inside == IF tail THEN m ELSE Push(m, [ frame |-> "leave", locals |-> m.locals ])
  IN CASE n # lambda.parameters /\ ~(lambda.implicit /\ n = 0) ->
            Faulty(m, lambda.label \o " takes " \o ToString(lambda.parameters) \o " argument"
                      \o (IF lambda.parameters = 1 THEN "" ELSE "s") \o ", not " \o ToString(n))
       [] Nesting(m.stack) >= MaximumCalls ->
            Faulty(m, "calls nest more than " \o ToString(MaximumCalls) \o " deep: does " \o lambda.label
                      \o " call itself without end?")
       [] OTHER -> [ inside EXCEPT !.locals = LocalsOf(closure, xs), !.focus = Evaluate(lambda.code) ]

(* The frame f: items that a closure is yet to be called with, one by one. *)
Iterate(m, f) ==
  IF f.index <= Len(f.items)
  THEN EnterClosure(Push(m, f), f.closure, IterationArguments(f, f.items[f.index]))
  ELSE Settle([ m EXCEPT !.at = f.node ], Concluded(f))

Walk(m, name, closure, subject, initial) ==
  Iterate(m, [ frame |-> "iterate", node |-> m.at, iteration |-> name, closure |-> closure, subject |-> subject,
               items |-> IteratedItems(subject), index |-> 1, gathered |-> initial ])

(* Named arguments come as a map, before the others. *)
Named(names, xs) ==
  LET places == << >> \o [ i \in DOMAIN xs |-> i ]
      named == SelectSeq(places, LAMBDA i : names[i] # "")
      positional == Each(SelectSeq(places, LAMBDA i : names[i] = ""), LAMBDA i : xs[i])
  IN IF named = << >> THEN positional
     ELSE << << "map", Each(named, LAMBDA i : << names[i], xs[i] >>) >> >> \o positional

CallMethod(m, name, xs) ==
  LET x == Head(xs)
      more == Tail(xs)
  IN CASE Is(x, "host") -> RequestCall(m, MemberOf(x, name), << more >>)
       [] Is(x, "closure") /\ name = "call" -> EnterClosure(m, x, more)
       [] Is(x, "map") /\ HasKey(x[2], name) /\ Is(Lookup(x[2], name), "closure") ->
            EnterClosure(m, Lookup(x[2], name), more)
       [] IsIteration(x, name, more) ->
            Walk(m, name, Last(more), x, IF name = "inject" THEN << Head(more) >> ELSE << >>)
       [] OTHER -> Settle(m, Method(x, name, more))

(* {1 Procedures} *)

Time(x) == Canonical(x)

TimeWanted(what, example, x) ==
  IF IsNumber(x) THEN Bad(what \o " takes a time of 0 seconds or more, not " \o ShortText(x)) ELSE Expected(example, x)

IsTime(x) == IsNumber(x) /\ ~Less(x, Integer(0))

(* at is the place of an assure or a within, which fail when they are cut off. *)
MakeTask(op, at, xs) ==
  LET x == xs[1]
      y == xs[2]
  IN CASE op = "action" ->
            IF Is(x, "closure") THEN Ok(TaskValue([ op |-> "action", code |-> x ])) ELSE Expected("code { ... }", x)
       [] op = "condition" ->
            IF Is(x, "closure") THEN Ok(TaskValue([ op |-> "condition", code |-> x ])) ELSE Expected("code { ... }", x)
       [] op = "waitFor" ->
            IF IsTask(y)
            THEN Ok(TaskValue([ op |-> "oneOf", branches |-> << [ guard |-> x, body |-> TaskOf(y) ] >> ]))
            ELSE Expected("a task", y)
       [] op \in { "until", "assure" } ->
            LET fails == IF op = "assure" THEN << at >> ELSE << >>
            IN IF IsTask(y) THEN Ok(TaskValue([ op |-> "until", guard |-> x, fails |-> fails, body |-> TaskOf(y) ]))
               ELSE Expected("a task", y)
       [] op = "watch" ->
            IF IsTask(x) THEN Ok(TaskValue([ op |-> "watch", body |-> TaskOf(x), handler |-> y ]))
            ELSE Expected("a task after watch", x)
       [] op = "fresh" ->
            IF Is(x, "closure") THEN Ok(TaskValue([ op |-> "fresh", code |-> x ])) ELSE Expected("code { k -> T }", x)
       [] op = "idle" ->
            IF IsTime(x) THEN Ok(TaskValue([ op |-> "idle", time |-> Time(x) ]))
            ELSE TimeWanted("idle", "a time after idle, as in idle(10.seconds)", x)
       [] op = "confirm" -> Ok(TaskValue([ op |-> "confirm", prompt |-> Text(x), at |-> at ]))
       [] op \in { "during", "within" } ->
            LET fails == IF op = "within" THEN << at >> ELSE << >>
                during(time) == Ok(TaskValue([ op |-> "during", time |-> time, fails |-> fails, body |-> TaskOf(y) ]))
            IN CASE ~IsTask(y) -> Expected("a task", y)
                 [] Is(x, "closure") -> during(x)
                 [] IsTime(x) -> during(Time(x))
                 [] OTHER -> TimeWanted(op, "a time after " \o op \o ", as in " \o op \o " 10.minutes run T", x)

TaskNames == { "action", "condition", "waitFor", "until", "assure", "watch", "fresh", "idle", "confirm", "during",
               "within" }

(* Whether t is done without any wait. *)
RECURSIVE NeverWaits(_)
NeverWaits(t) ==
  CASE t.op = "action" -> TRUE
    [] t.op \in { "seq", "par" } -> NeverWaits(t.left) /\ NeverWaits(t.right)
    [] t.op \in { "on", "until", "watch", "repeat", "ensure" } -> NeverWaits(t.body)
    [] t.op = "during" -> ~Is(t.time, "closure") /\ NeverWaits(t.body)
    [] OTHER -> FALSE

(* The deeds by these forms with the values xs, or the first fault. *)
RECURSIVE Ensured(_, _)
Ensured(forms, xs) ==
  LET d == Head(forms)
      after(deed, n) ==
        LET rest == Ensured(Tail(forms), SubSeq(xs, n + 1, Len(xs)))
        IN IF IsOk(rest) THEN Ok(<< deed >> \o rest[2]) ELSE rest
      pair(k, x, n) ==
        IF x = Wildcard THEN Bad("only consume and poll take the wildcard _")
        ELSE after(<< "post", k, Canonical(x) >>, n)
  IN CASE forms = << >> -> Ok(<< >>)
       [] d.op = "giveBack" -> after(<< "giveBack" >>, 0)
       [] d.op = "set" -> after(<< "set", d.global, xs[1], d.name >>, 1)
       [] d.key # << >> -> pair(d.key[1], xs[1], 1)
       [] ~(IsString(xs[1]) \/ IsNumber(xs[1])) -> Expected("a string as a key", xs[1])
       [] OTHER -> pair(Text(Canonical(xs[1])), xs[2], 2)

(* T ensure { } is T; of two around one another, the inner one comes first. *)
MakeEnsure(op, xs) ==
  LET ds == Ensured(op.forms, Tail(xs))
      t == TaskOf(xs[1])
  IN CASE ~IsTask(xs[1]) -> Expected("a task before ensure", xs[1])
       [] ~IsOk(ds) -> ds
       [] ds[2] = << >> -> Ok(TaskValue(t))
       [] t.op = "ensure" -> Ok(TaskValue([ t EXCEPT !.ensured = @ \o ds[2] ]))
       [] OTHER -> Ok(TaskValue([ op |-> "ensure", ensured |-> ds[2], body |-> t ]))

(* op has those of n, t, c that xs contains: n rounds, of t, until c. *)
MakeRepeat(op, at, xs) ==
  LET j == IF op.counted THEN 2 ELSE 1
      t == xs[j]
      until == IF op.asked THEN << xs[j + 1] >> ELSE << >>
      n == Canonical(xs[1])
      repeat(rounds) ==
        TaskValue([ op |-> "repeat", rounds |-> rounds, until |-> until, body |-> TaskOf(t), at |-> at ])
  IN CASE ~IsTask(t) -> Expected("a task to repeat", t)
       [] ~op.counted /\ ~op.asked /\ NeverWaits(TaskOf(t)) ->
            Bad("a round of this repeat never waits: it would loop endlessly, and nothing else would happen")
       [] ~op.counted -> Ok(repeat(<< >>))
       [] ~IsNumber(n) -> Expected("how many rounds there are, as in repeat 3, T", n)
       [] ~Is(n, "integer") \/ Less(n, Integer(1)) ->
            Bad("repeat takes a whole number of rounds, 1 or more, not " \o Text(n))
       [] n = Integer(1) -> Ok(TaskValue(TaskOf(t)))
       [] OTHER -> Ok(repeat(<< Numerator(n) >>))

PlatformTask(m, x) ==
  CASE ~IsString(x) -> Settle(m, Expected("the name of a plan, a string", x))
    [] x[2] = "" -> Faulty(m, "a plan's name may not be empty")
    [] OTHER -> Result(m, TaskValue([ op |-> "platform", name |-> x[2], plan |-> 0, at |-> m.at ]))

(* execute v1: t1, v2: t2 is execute t1[v1] | (t2[v2] | ...); a name _ gives no vehicles. *)
RECURSIVE ForEach(_, _)
ForEach(names, xs) ==
  CASE xs = << >> -> << >>
    [] names = << >> -> << Bad("more tasks than names") >>
    [] Head(names) = "_" ->
         << IF IsTask(Head(xs)) THEN Ok(TaskOf(Head(xs))) ELSE Expected("a task after _:", Head(xs)) >>
         \o ForEach(Tail(names), Tail(xs))
    [] ~Is(Head(xs), "vehicles") -> << Expected("'" \o Head(names) \o "' to name a vehicle set", Head(xs)) >>
    [] ~IsTask(xs[2]) -> << Expected("a task after " \o Head(names) \o ":", xs[2]) >>
    [] OTHER -> << Ok([ op |-> "on", body |-> TaskOf(xs[2]), vehicles |-> Head(xs)[2] ]) >>
                \o ForEach(Tail(names), SubSeq(xs, 3, Len(xs)))

RECURSIVE SideBySide(_)
SideBySide(ts) == IF Len(ts) = 1 THEN ts[1] ELSE [ op |-> "par", left |-> ts[1], right |-> SideBySide(Tail(ts)) ]

Execute(m, t) == Request(m, "execute", << "execute", t >>)

ExecuteFor(m, names, xs) ==
  LET parts == ForEach(names, xs)
      wrong == SelectSeq(parts, LAMBDA part : ~IsOk(part))
  IN CASE wrong # << >> -> Settle(m, wrong[1])
       [] parts = << >> -> Faulty(m, "nothing to execute")
       [] OTHER -> Execute(m, SideBySide(Each(parts, LAMBDA part : part[2])))

(* A key is a name, or nothing: then it is the value before its own. *)
RECURSIVE Pairs(_, _)
Pairs(keys, xs) ==
  CASE keys = << >> -> << >>
    [] Head(keys) # << >> -> << << Head(keys)[1], Canonical(Head(xs)) >> >> \o Pairs(Tail(keys), Tail(xs))
    [] OTHER -> << << Text(Canonical(Head(xs))), Canonical(xs[2]) >> >> \o Pairs(Tail(keys), Tail(Tail(xs)))

IsKey(x) == IsString(x) \/ IsNumber(x)

(* Stand-ins for keys that are not values. *)
RECURSIVE WrongKeys(_, _)
WrongKeys(keys, xs) ==
  CASE keys = << >> -> << >>
    [] Head(keys) # << >> -> WrongKeys(Tail(keys), Tail(xs))
    [] OTHER -> (IF IsKey(Head(xs)) THEN << >> ELSE << Head(xs) >>) \o WrongKeys(Tail(keys), Tail(Tail(xs)))

WrongKey(keys, xs) == Expected("a string as a key", WrongKeys(keys, xs)[1])

RECURSIVE InSomeOrder(_)
InSomeOrder(bag) ==
  IF bag = EmptyBag THEN << >>
  ELSE LET pair == CHOOSE pair \in BagToSet(bag) : TRUE
       IN << pair[2] >> \o InSomeOrder(bag (-) SetToBag({ pair }))

(* The values of the pairs of k: those of a queue in their order. *)
ValuesOf(N, k) ==
  IF IsOrdered(k) THEN QueueOf(N, k)
  ELSE InSomeOrder([ pair \in { p \in BagToSet(N.bag) : p[1] = k } |-> N.bag[pair] ])

DoPost(m, pairs) ==
  IF \E i \in DOMAIN pairs : pairs[i][2] = Wildcard THEN Faulty(m, "only consume and poll take the wildcard _")
  ELSE Did([ m EXCEPT !.N = PostAll(@, pairs) ], [ did |-> "post", pairs |-> pairs ], Null)

Codes(pairs) == SelectSeq(pairs, LAMBDA pair : Is(pair[2], "closure"))

CodeAsValue(m, k) == Faulty(m, "a pattern is written behind its key, as in consume " \o k \o ": { x -> ... }")

DoConsume(m, pairs) ==
  LET found == TakeAll(m.N, pairs, << >>)
  IN IF Codes(pairs) # << >> THEN CodeAsValue(m, Codes(pairs)[1][1])
     ELSE IF found = << >> THEN Result(m, False)
     ELSE Did([ m EXCEPT !.N = found[1].N ], [ did |-> "consume", pairs |-> found[1].taken ], True)

DoPoll(m, pairs) ==
  IF Codes(pairs) # << >> THEN CodeAsValue(m, Codes(pairs)[1][1])
  ELSE Result(m, Boolean(\A i \in DOMAIN pairs : IsThere(m.N, pairs[i][1], pairs[i][2])))

Released(m, V) ==
  IF V = << >> THEN Result(m, Null)
  ELSE Did([ m EXCEPT !.B = SelectSeq(@, LAMBDA v : v \notin Range(V)) ], [ did |-> "release", vehicles |-> V ], Null)

DoRelease(m, x) ==
  LET common == Intersection(x[2], m.B)
  IN CASE ~Is(x, "vehicles") -> Settle(m, Expected("a vehicle set to release", x))
       [] m.mode # "script" -> Faulty(m, "release belongs to the script, not to code inside of a task")
       [] OTHER -> Released(m, common)

(* Tasks beside or after the watch of the handler may not need them. *)
DoDismiss(m, x) ==
  LET common == Intersection(x[2], m.B)
      held == HeldBy(m.around)
      needed == SelectSeq(common, LAMBDA v : v \in held)
  IN CASE ~Is(x, "vehicles") -> Settle(m, Expected("a vehicle set to dismiss", x))
       [] m.mode # "handler" -> Faulty(m, "dismiss belongs in onError { ... }")
       [] needed # << >> ->
            Faulty(m, needed[1] \o " cannot be dismissed: a task beside or after this watch is to run on it")
       [] OTHER -> Released(m, common)

DoSetTimeout(m, vehicles, x) ==
  CASE ~IsNumber(x) -> Settle(m, Expected("a time, as in 2.min", x))
    [] Less(x, Integer(5)) \/ Less(Integer(3600), x) ->
         Faulty(m, "a connection timeout is from 5 seconds to 1 hour, not " \o ShortText(x) \o " seconds")
    [] OTHER -> Did(m, [ did |-> "timeout", vehicles |-> vehicles, time |-> Time(x) ], Null)

Verdict(m, verdict) ==
  IF m.mode = "handler" THEN Result([ m EXCEPT !.verdict = verdict ], Null)
  ELSE Faulty(m, "ignore(), propagate() and retry() belong in onError { ... }")

Refuted(m, text) == Stop(m, << "faulted", [ Fault(text, m.at) EXCEPT !.assertion = TRUE ] >>)

(* The free ones of V, from the place of the code. *)
IdleOf(m, V) == LET held == HeldBy(m.beside) IN SelectSeq(V, LAMBDA v : v \in Range(m.B) /\ v \notin held)

Procedure(m, op, xs) ==
  LET name == op.op
      x == xs[1]
  IN CASE name \in { "post", "consume", "poll" } /\ WrongKeys(op.keys, xs) # << >> -> Settle(m, WrongKey(op.keys, xs))
       [] name = "post" /\ op.keys = << >> ->
            IF Is(x, "map") THEN DoPost(m, Each(x[2], LAMBDA entry : << entry[1], Canonical(entry[2]) >>))
            ELSE Settle(m, Expected("pairs, as in post ready: 1, or a map", x))
       [] name = "post" -> DoPost(m, Pairs(op.keys, xs))
       [] name = "consume" -> DoConsume(m, Pairs(op.keys, xs))
       [] name = "valuesOf" ->
            IF IsKey(x) THEN Result(m, List(ValuesOf(m.N, Text(Canonical(x)))))
            ELSE Settle(m, Expected("a string as a key", x))
       [] name = "poll" ->
            CASE op.keys # << >> -> DoPoll(m, Pairs(op.keys, xs))
              [] IsString(x) -> DoPoll(m, << << x[2], Wildcard >> >>)
              [] OTHER -> Settle(m, Expected("a key, as in poll 'ready', or pairs, as in poll(ready: 1)", x))
       [] name = "task" -> PlatformTask(m, x)
       [] name = "repeat" -> Settle(m, MakeRepeat(op, m.at, xs))
       [] name = "ensure" -> Settle(m, MakeEnsure(op, xs))
       [] name = "idle" /\ Is(x, "vehicles") -> Result(m, Vehicles(IdleOf(m, x[2])))
       [] name \in TaskNames -> Settle(m, MakeTask(name, m.at, xs))
       [] name = "execute" ->
            IF IsTask(x) THEN Execute(m, TaskOf(x)) ELSE Settle(m, Expected("a task to execute", x))
       [] name = "executeFor" -> ExecuteFor(m, op.names, xs)
       [] name = "message" -> Did(m, [ did |-> "message", text |-> Text(x) ], Null)
       [] name = "release" -> DoRelease(m, x)
       [] name = "setConnectionTimeout" ->
            CASE Len(xs) = 1 -> DoSetTimeout(m, << >>, x)
              [] Is(x, "vehicles") -> DoSetTimeout(m, << x[2] >>, xs[2])
              [] OTHER -> Settle(m, Expected("a vehicle set", x))
       [] name = "ask" -> Request(m, "ask", << "ask", Text(x) >>)
       [] name = "pause" ->
            IF IsTime(x) THEN Request(m, "pause", << "pause", Time(x) >>)
            ELSE Settle(m, TimeWanted("pause", "a time after pause, as in pause 12.seconds", x))
       [] name = "halt" -> Stop(m, << "halted", IF xs = << >> THEN "" ELSE Text(x) >>)
       [] name = "interrupted" -> Stop(m, << "left off" >>)
       [] name = "assert" -> Refuted(m, IF xs = << >> THEN "assertion failed" ELSE "assertion failed: " \o Text(x))
       [] name = "fail" -> Faulty(m, Text(x))
       [] name = "ignore" -> Verdict(m, "ignore")
       [] name = "propagate" -> Verdict(m, "propagate")
       [] name = "retry" -> Verdict(m, "retry")
       [] name = "dismiss" -> DoDismiss(m, x)
       [] name = "position" -> Settle(m, OneVehicleValue(x, PositionOf))
       [] name = "sensor" -> Settle(m, OneVehicleValue(x, LAMBDA vehicle : SensorOf(vehicle, op.name)))
       [] name = "reading" ->
            Settle(m, OneVehicleValue(x, LAMBDA vehicle : SensorOf(vehicle, "reading " \o xs[2][2])))
       [] name = "running" ->
            Settle(m, OneVehicleValue(x, LAMBDA vehicle : Ok(Boolean(vehicle.id \in DOMAIN m.A))))
       [] name = "now" -> Result(m, DateAsValue(m.date))
       [] name = "timeOfDay" -> Result(m, TimeOfDay(op.begins, m.date))
       [] name = "area" -> Settle(m, Around(x, xs[2]))
       [] name = "math" -> Settle(m, Mathematics(op.name, xs))
       [] name = "isThere" -> Result(m, Boolean(IsNumber(x) \/ Truth(x)))
       [] name = "isA" -> Result(m, Boolean(IsA(op.form, x)))
       [] name = "isHost" -> Result(m, Boolean(Is(x, "host")))
       [] name = "getSupplier" -> RequestCall(m, "getSupplier", << << >> >>)

RECURSIVE MapOf(_, _, _)
MapOf(entries, keys, xs) ==
  CASE keys = << >> -> entries
    [] Head(keys) # << >> -> MapOf(Put(entries, Head(keys)[1], Head(xs)), Tail(keys), Tail(xs))
    [] OTHER -> MapOf(Put(entries, Text(Canonical(Head(xs))), xs[2]), Tail(keys), SubSeq(xs, 3, Len(xs)))

AddSetting(op, xs, at) ==
  LET more == Tail(xs)
      places == << >> \o [ i \in DOMAIN more |-> i ]
      positional == SelectSeq(places, LAMBDA i : op.names[i] = "")
      named == SelectSeq(places, LAMBDA i : op.names[i] # "")
  IN Settings(Append(Head(xs)[2],
       [ name |-> op.name, positional |-> Each(positional, LAMBDA i : more[i]),
         named |-> Each(named, LAMBDA i : << op.names[i], more[i] >>), at |-> at ]))

ArePositional(names) == \A i \in DOMAIN names : names[i] = ""

(* These hand readings on, or print them, as they do with any values. *)
TakesReadings(op, xs) ==
  \/ op.op = "call" /\ Is(xs[1], "closure") /\ ArePositional(op.names)
  \/ op.op \in { "message", "halt", "assert", "fail", "isA", "isHost", "isThere" }

IsAboutReadings(op, xs) == (\E i \in DOMAIN xs : IsReading(xs[i])) /\ ~TakesReadings(op, xs)

(* The result of all other operations for values some of which are readings. *)
OnReadings(op, xs) ==
  CASE op.op = "binary" -> BinaryOnReadings(op.sign, xs[1], xs[2])
    [] op.op = "unary" /\ op.sign = "-" /\ IsReadingOf(xs[1], "amount") ->
         Ok(Reading("amount", "-" \o Enclosed(xs[1][3])))
    [] op.op = "concatenate" -> Ok(Reading("words", Join(Each(xs, Text), "")))
    [] op.op = "math" -> MathematicsOnReadings(op.name, xs)
    [] op.op = "property" /\ IsPlace(xs[1]) -> MethodOnReadings(op.name, xs)
    [] op.op = "method" /\ ArePositional(op.names) -> MethodOnReadings(op.name, xs)
    [] OTHER -> AnyMore(xs)

(* The effect of expression n once its arguments are the values xs. *)
Perform(before, n, xs) ==
  LET op == Code[n].operation
      m == [ before EXCEPT !.at = n ]
  IN CASE HasReadings /\ IsAboutReadings(op, xs) -> Settle(m, OnReadings(op, xs))
       [] op.op = "unary" -> Settle(m, Unary(op.sign, xs[1]))
       [] op.op = "binary" ->
            IF op.sign = "|" /\ Is(xs[1], "vehicles") /\ Is(xs[2], "closure")
            THEN Walk(m, "findAll", xs[2], xs[1], << >>)
            ELSE Settle(m, Binary(op.sign, xs[1], xs[2]))
       [] op.op = "property" ->
            IF Is(xs[1], "host") THEN RequestCall(m, MemberOf(xs[1], op.name), << >>)
            ELSE Settle(m, Property(xs[1], op.name))
       [] op.op = "method" -> CallMethod(m, op.name, Named(<< "" >> \o op.names, xs))
       [] op.op = "call" ->
            IF Is(xs[1], "closure") THEN EnterClosure(m, xs[1], Named(op.names, Tail(xs)))
            ELSE Settle(m, Expected("a function or closure to call", xs[1]))
       [] op.op = "setting" -> Result(m, AddSetting(op, xs, n))
       [] op.op = "branch" -> Result(m, AddSetting([ name |-> "when", names |-> << "", "" >> ], xs, n))
       [] op.op = "recruit" ->
            LET q == ReadPick(AnyVehicle, xs[1][2])
            IN IF IsOk(q) THEN Result(m, TaskValue([ op |-> "recruit", asked |-> q[2], code |-> xs[2] ]))
               ELSE Settle(m, q)
       [] op.op = "build" -> Build(m, op, xs[1][2])
       [] op.op = "element" -> Settle(m, Element(xs[1], xs[2]))
       [] op.op = "replaceElement" -> Settle(m, ReplaceElement(xs[1], xs[2], xs[3]))
       [] op.op = "replaceMember" -> Settle(m, ReplaceElement(xs[1], String(op.name), xs[2]))
       [] op.op = "concatenate" -> Result(m, String(Join(Each(xs, Text), "")))
       [] op.op = "list" -> Result(m, List(xs))
       [] op.op = "map" -> Result(m, << "map", MapOf(<< >>, op.keys, xs) >>)
       [] op.op = "range" -> Settle(m, MakeRange(xs[1], xs[2], op.inclusive))
       [] OTHER -> Procedure(m, op, xs)

(* {1 The steps of the machine} *)

RECURSIVE UpToCall(_)
UpToCall(stack) ==
  IF stack = << >> \/ Head(stack).frame = "leave" THEN stack ELSE UpToCall(Tail(stack))

RECURSIVE UpToLoop(_)
UpToLoop(stack) ==
  IF stack = << >> \/ Head(stack).frame \in { "loopBody", "items" } THEN stack ELSE UpToLoop(Tail(stack))

AfterLoop(stack) == LET loop == UpToLoop(stack) IN IF loop = << >> THEN << >> ELSE Tail(loop)

(* The expression in focus. *)
Evaluation(m, n) ==
  LET e == Code[n]
      going == [ m EXCEPT !.fuel = @ - 1, !.at = n ]
  IN CASE e.is = "constant" -> Result(going, e.value)
       [] e.is = "local" -> Result(going, m.locals[e.slot])
       [] e.is = "global" ->
            IF m.store[e.global] = << >> THEN Faulty(going, "'" \o GlobalNames[e.global] \o "' has no value yet")
            ELSE Result(going, m.store[e.global][1])
       [] e.is = "setLocal" -> Enter(Push(going, [ frame |-> "setLocal", slot |-> e.slot ]), e.value)
       [] e.is = "setGlobal" -> Enter(Push(going, [ frame |-> "setGlobal", global |-> e.global ]), e.value)
       [] e.is = "apply" ->
            IF e.arguments = << >> THEN Operate(going, n, << >>)
            ELSE Enter(Push(going, [ frame |-> "arguments", node |-> n, values |-> << >> ]), e.arguments[1])
       [] e.is = "closure" ->
            LET captured == Each(e.slots, LAMBDA slot : m.locals[slot])
                open == SelectSeq(captured, IsReading)
            IN IF open = << >> THEN Result(going, << "closure", e.lambda, captured >>) ELSE NoTelling(going, open[1])
       [] e.is = "if" -> Enter(Push(going, [ frame |-> "choose", node |-> n ]), e.test)
       [] e.is = "block" ->
            CASE e.parts = << >> -> Result(going, Null)
              [] Len(e.parts) = 1 -> Enter(going, e.parts[1])
              [] OTHER -> Enter(Push(going, [ frame |-> "rest", node |-> n, next |-> 2 ]), e.parts[1])
       [] e.is = "while" -> Enter(Push(going, [ frame |-> "loopTest", node |-> n ]), e.test)
       [] e.is = "for" -> Enter(Push(going, [ frame |-> "loopRange", node |-> n ]), e.range)
       [] e.is = "return" -> Enter([ going EXCEPT !.stack = UpToCall(@) ], e.value)
       [] e.is = "break" -> Result([ going EXCEPT !.stack = AfterLoop(@) ], Null)
       [] e.is = "continue" -> Result([ going EXCEPT !.stack = UpToLoop(@) ], Null)

(* The items of a for loop that are left: <<"these", xs, i>> from the i-th on, <<"numbers", i, last>> up or down. *)
NextItem(m, n, items) ==
  LET e == Code[n]
      body(x, left) ==
        Enter(Push([ m EXCEPT !.locals[e.slot] = x ], [ frame |-> "items", node |-> n, items |-> left ]), e.body)
  IN CASE items[1] = "these" ->
            IF items[3] <= Len(items[2]) THEN body(items[2][items[3]], << "these", items[2], items[3] + 1 >>)
            ELSE Result(m, Null)
       [] items[2] = items[3] -> body(Integer(items[2]), << "these", << >>, 1 >>)
       [] OTHER ->
            body(Integer(items[2]), << "numbers", items[2] + (IF items[2] < items[3] THEN 1 ELSE -1), items[3] >>)

BeginLoop(m, n, x) ==
  CASE Is(x, "range") -> NextItem(m, n, << "numbers", x[2], x[3] >>)
    [] Is(x, "null") -> Result(m, Null)
    [] HasItems(x) -> NextItem(m, n, << "these", Items(x), 1 >>)
    [] OTHER -> Settle(m, Expected("a list, range, map, string or vehicle set to loop over", x))

(* The result of f depends on its arguments, and not by comparisons alone. *)
MustKnow(f) ==
  f.frame \in { "choose", "loopTest", "loopRange" }
  \/ (f.frame = "iterate" /\ f.iteration \notin { "each", "eachWithIndex", "times" })

(* The value x, given to the frame f on top of the stack. *)
Continuation(m, f, x) ==
  LET below == [ m EXCEPT !.stack = Tail(@) ]
  IN CASE HasReadings /\ IsReading(x) /\ MustKnow(f) -> NoTelling(m, x)
       [] f.frame = "arguments" ->
            LET xs == Append(f.values, x)
                arguments == Code[f.node].arguments
            IN IF Len(xs) = Len(arguments) THEN Operate(below, f.node, xs)
               ELSE Enter(Push(below, [ f EXCEPT !.values = xs ]), arguments[Len(xs) + 1])
       [] f.frame = "setLocal" -> [ below EXCEPT !.locals[f.slot] = x ]
       [] f.frame = "setGlobal" -> [ below EXCEPT !.store[f.global] = << x >> ]
       [] f.frame = "choose" -> Enter(below, IF Truth(x) THEN Code[f.node].yes ELSE Code[f.node].no)
       [] f.frame = "rest" ->
            LET parts == Code[f.node].parts
            IN Enter(IF f.next = Len(parts) THEN below ELSE Push(below, [ f EXCEPT !.next = @ + 1 ]), parts[f.next])
       [] f.frame = "loopTest" ->
            IF Truth(x) THEN Enter(Push(below, [ f EXCEPT !.frame = "loopBody" ]), Code[f.node].body)
            ELSE Result(below, Null)
       [] f.frame = "loopBody" -> Enter(Push(below, [ f EXCEPT !.frame = "loopTest" ]), Code[f.node].test)
       [] f.frame = "loopRange" -> BeginLoop(below, f.node, x)
       [] f.frame = "items" -> NextItem(below, f.node, f.items)
       [] f.frame = "leave" -> [ below EXCEPT !.locals = f.locals ]
       [] f.frame = "iterate" ->
            LET early == Early(f, x)
            IN IF early # << >> THEN Result([ below EXCEPT !.at = f.node ], early[1])
               ELSE Iterate(below, [ f EXCEPT !.gathered = Append(@, x), !.index = @ + 1 ])

(* Which of xs it is depends on the answer to the question: if that is not known, the machine stops and asks for it. *)
Answered(m, question, xs) ==
  CASE question \in DOMAIN m.sees -> Result(m, xs[m.sees[question]])
    [] question[1] = "claim" /\ Cardinality(Claims(m.sees)) >= MostClaims -> Stop(m, << "unsettled", question[2] >>)
    [] OTHER -> Stop(m, << "asks", question, Len(xs) >>)

(* The value of an operation, or its fault; of a setting, at the place of the setting. *)
Conclusion(m, result) ==
  CASE IsOk(result) -> Result(m, result[2])
    [] result[1] = "at" -> Stop(m, << "faulted", Fault(Sentence(result[3]), result[2]) >>)
    [] result[1] = "depends" -> Answered(m, result[2], result[3])
    [] result[1] = "unsettled" -> Stop(m, result)
    [] OTHER -> Faulty(m, Sentence(result))

MachineStep(m) ==
  CASE m.focus[1] = "evaluate" ->
         IF m.fuel = 0 THEN [ m EXCEPT !.at = m.focus[2], !.stop = << "exhausted" >> ]
         ELSE Evaluation(m, m.focus[2])
    [] m.focus[1] = "operate" -> Perform(m, m.focus[2], m.focus[3])
    [] m.focus[1] = "result" -> Conclusion(m, m.focus[2])
    [] m.stack = << >> -> Stop(m, << "finished", m.focus[2] >>)
    [] OTHER -> Continuation(m, Head(m.stack), m.focus[2])

(* 2^k steps of the machine, or as many as it takes to stop. *)
RECURSIVE Steps2(_, _)
Steps2(k, m) ==
  CASE m.stop # Going -> m
    [] k = 0 -> MachineStep(m)
    [] OTHER -> Only({ Steps2(k - 1, half) : half \in { Steps2(k - 1, m) } })

(* A machine takes at most a few steps for each expression, so it stops before it has made 2^26. *)
Stopped(started) == Only({ Steps2(26, m) : m \in { started } })

(* The answer i to the question of m, or an earlier answer in this step, is wrong. *)
IsContradicted(m, i) ==
  m.stop[2][1] = "claim" /\ \E claim \in Claims(m.sees) : Contradict(m.stop[2], i, claim, m.sees[claim])

(* A machine that asks goes on with each answer that agrees with those before, the first one first. *)
RECURSIVE WithAllAnswers(_)
WithAllAnswers(m) ==
  LET seeing(i) == Stopped([ m EXCEPT !.stop = Going, !.sees = Seeing(@, m.stop[2], i) ])
  IN CASE m.stop[1] = "asks" ->
            Flatten([ i \in 1 .. m.stop[3] |->
                        IF IsContradicted(m, i) THEN << >> ELSE Only({ WithAllAnswers(n) : n \in { seeing(i) } }) ])
       [] m.stop[1] = "unsettled" -> Assert(FALSE, OpenHere(m.stop[2], m.at))
       [] OTHER -> << m >>

(* The machines that M comes to: one, unless it depends on sensors. *)
Run(M, S, mode, fuel) == Only({ WithAllAnswers(m) : m \in { Stopped(Started(M, S, mode, fuel)) } })
==============================================================================
