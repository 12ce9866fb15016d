---------------------------- MODULE DolphinValues ----------------------------
(* The values of Dolphin programs, and their texts: the counterpart of Value and *)
(* Operators in lib/semantics.                                                   *)
(*                                                                               *)
(* A value is a tuple that begins with its kind, so that any two values can be   *)
(* compared:                                                                     *)
(*                                                                               *)
(*   <<"null">>  <<"boolean", TRUE>>  <<"integer", 3>>  <<"string", "x">>        *)
(*   <<"number", 3, 10>>      0.3, as a fraction in lowest terms                 *)
(*   <<"distance", 1234>>     a number of metres, known to the millimetre        *)
(*   <<"wildcard">>  <<"symbol", "Z.Units.DEPTH">>                               *)
(*   <<"list", <<x, y>>>>     <<"map", <<<<k, x>>, <<k', x'>>>>>>                *)
(*   <<"range", 1, 3>>        <<"vehicles", <<v, v'>>>>                          *)
(*   <<"position", i>>        place i of Places                                  *)
(*   <<"area", i, n, d>>      around place i, with a radius of n/d metres; if n  *)
(*                            is -1, an area with corners, which place i is      *)
(*   <<"task", t>>            <<"closure", lambda, captured values>>             *)
(*   <<"host", "queue">>      an object of the host, by its name there           *)
(*   <<"settings", ss>>       the lines of a block of settings, as far as read   *)
(*   <<"reading", "amount", "battery(x8)">>   what a sensor shows that may show  *)
(*                            anything, or what is computed from it: an amount,  *)
(*                            a place, a region, or words                        *)
EXTENDS Integers, Sequences, FiniteSets, TLC

CONSTANTS
  Places,      \* positions that the program names and where vehicles are: a sequence of their texts
  Distances,   \* Distances[i][j]: from place i to place j, in millimetres
  LambdaNames  \* by lambda: what the text of a closure says

PlacesOK ==
  /\ \A i \in DOMAIN Places : Places[i] \in STRING
  /\ Len(Distances) = Len(Places)
  /\ \A i \in DOMAIN Places : Len(Distances[i]) = Len(Places) /\ \A j \in DOMAIN Places : Distances[i][j] \in Nat

ASSUME PlacesOK

(* {1 Sequences} *)

Range(s) == { s[i] : i \in DOMAIN s }

(* The tuple of F(s[1]), F(s[2]) ... *)
Each(s, F(_)) == << >> \o [ i \in 1 .. Len(s) |-> F(s[i]) ]

Without(s, i) == SubSeq(s, 1, i - 1) \o SubSeq(s, i + 1, Len(s))
With(s, i, x) == [ s EXCEPT ![i] = x ]
Last(s) == s[Len(s)]

RECURSIVE Flatten(_)
Flatten(ss) == IF ss = << >> THEN << >> ELSE Head(ss) \o Flatten(Tail(ss))

RECURSIVE Join(_, _)
Join(texts, between) ==
  CASE Len(texts) = 0 -> ""
    [] Len(texts) = 1 -> texts[1]
    [] OTHER -> texts[1] \o between \o Join(Tail(texts), between)

RECURSIVE IndexFrom(_, _, _)
IndexFrom(s, x, i) == IF i > Len(s) THEN 0 ELSE IF s[i] = x THEN i ELSE IndexFrom(s, x, i + 1)

(* The first place of x in s; 0 if it is not there. *)
IndexOf(s, x) == IndexFrom(s, x, 1)

(* The element of a set of one element. TLC evaluates it once, whereas it would evaluate a LET at each use. *)
Only(S) == CHOOSE x \in S : TRUE

Minimum(S) == CHOOSE x \in S : \A y \in S : x <= y

(* {1 Constructors} *)

Null == << "null" >>
True == << "boolean", TRUE >>
False == << "boolean", FALSE >>
Boolean(b) == << "boolean", b >>
Integer(n) == << "integer", n >>
String(s) == << "string", s >>
Wildcard == << "wildcard" >>
List(xs) == << "list", xs >>
Vehicles(vs) == << "vehicles", vs >>
TaskValue(t) == << "task", t >>
Settings(ss) == << "settings", ss >>

Is(x, kind) == x[1] = kind

Abs(n) == IF n < 0 THEN -n ELSE n

RECURSIVE Gcd(_, _)
Gcd(a, b) == IF b = 0 THEN a ELSE Gcd(b, a % b)

(* The number n/d, for d greater than 0. *)
Number(n, d) == LET g == Gcd(Abs(n), d) IN << "number", n \div g, d \div g >>

(* {1 Numbers} *)

IsNumber(x) == x[1] \in { "integer", "number", "distance" }
IsExact(x) == x[1] \in { "integer", "number" }

(* A number known to the millimetre only may be rounded and compared; computing on would need the rest of it. *)
Exactly(x) == Assert(~Is(x, "distance"), "a distance is known to the millimetre: this model cannot compute with it")

Numerator(x) == IF Exactly(x) THEN x[2] ELSE 0
Denominator(x) == IF Is(x, "number") THEN x[3] ELSE 1

(* Numbers as fractions, distances too. *)
Fraction(x) == IF Is(x, "distance") THEN << x[2], 1000 >> ELSE << Numerator(x), Denominator(x) >>
Sign(n) == IF n < 0 THEN -1 ELSE IF n > 0 THEN 1 ELSE 0

(* -1, 0 or 1: how two numbers compare. *)
CompareNumbers(x, y) == LET a == Fraction(x) b == Fraction(y) IN Sign(a[1] * b[2] - b[1] * a[2])

Less(x, y) == CompareNumbers(x, y) < 0

(* Division that rounds towards zero, as the language's does. *)
Truncated(a, b) == IF (a >= 0) = (b > 0) THEN Abs(a) \div Abs(b) ELSE -(Abs(a) \div Abs(b))

Floor(x) == LET a == Fraction(x) IN a[1] \div a[2]

(* Half away from zero. *)
Rounded(x) ==
  LET a == Fraction(x)
      up == (2 * Abs(a[1]) + a[2]) \div (2 * a[2])
  IN IF a[1] < 0 THEN -up ELSE up

(* {1 Equality and truth} *)

RECURSIVE Canonical(_)
Canonical(x) ==
  CASE Is(x, "number") /\ x[3] = 1 -> Integer(x[2])
    [] Is(x, "list") -> List(Each(x[2], Canonical))
    [] Is(x, "map") -> << "map", << >> \o [ i \in DOMAIN x[2] |-> << x[2][i][1], Canonical(x[2][i][2]) >> ] >>
    [] OTHER -> x

(* The same for all values that are equal: vehicle sets and maps are sets. *)
RECURSIVE Normal(_)
Normal(x) ==
  CASE Is(x, "number") -> Canonical(x)
    [] Is(x, "list") -> List(Each(x[2], Normal))
    [] Is(x, "map") -> << "map", { << x[2][i][1], Normal(x[2][i][2]) >> : i \in DOMAIN x[2] } >>
    [] Is(x, "vehicles") -> << "vehicles", Range(x[2]) >>
    [] OTHER -> x

(* x == y in a program. *)
Equals(x, y) ==
  LET a == Normal(x)
      b == Normal(y)
  IN CASE Is(a, "distance") \/ Is(b, "distance") ->
            Assert(IsNumber(a) # IsNumber(b),
                   "a distance is known to the millimetre: this model cannot tell what it equals")
            /\ FALSE
       [] OTHER -> a = b

(* How a condition takes x. *)
Truth(x) ==
  CASE Is(x, "null") -> FALSE
    [] Is(x, "boolean") -> x[2]
    [] Is(x, "integer") -> x[2] # 0
    [] Is(x, "number") -> x[2] # 0
    [] Is(x, "distance") -> x[2] # 0
    [] Is(x, "string") -> x[2] # ""
    [] Is(x, "list") -> x[2] # << >>
    [] Is(x, "map") -> x[2] # << >>
    [] Is(x, "vehicles") -> x[2] # << >>
    [] OTHER -> TRUE

(* {1 Maps} *)

RECURSIVE PlaceOfKey(_, _, _)
PlaceOfKey(entries, k, i) ==
  IF i > Len(entries) THEN 0 ELSE IF entries[i][1] = k THEN i ELSE PlaceOfKey(entries, k, i + 1)

HasKey(entries, k) == PlaceOfKey(entries, k, 1) # 0
Lookup(entries, k) == entries[PlaceOfKey(entries, k, 1)][2]

Put(entries, k, x) ==
  LET i == PlaceOfKey(entries, k, 1)
  IN IF i = 0 THEN Append(entries, << k, x >>) ELSE With(entries, i, << k, x >>)

RECURSIVE PutAll(_, _)
PutAll(entries, more) ==
  IF more = << >> THEN entries ELSE PutAll(Put(entries, Head(more)[1], Head(more)[2]), Tail(more))

(* {1 Text} *)

Characters(s) == << >> \o [ i \in 1 .. Len(s) |-> SubSeq(s, i, i) ]

Capitals == "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
Smalls   == "abcdefghijklmnopqrstuvwxyz"

LowerCharacter(c) ==
  LET there == { i \in 1 .. 26 : SubSeq(Capitals, i, i) = c }
  IN IF there = { } THEN c ELSE SubSeq(Smalls, Only(there), Only(there))

Lower(s) == Join(Each(Characters(s), LowerCharacter), "")

EscapedCharacter(c) ==
  CASE c = "'" -> "\\'"
    [] c = "\\" -> "\\\\"
    [] c = "\n" -> "\\n"
    [] OTHER -> c

Quoted(s) ==
  IF \E i \in 1 .. Len(s) : SubSeq(s, i, i) \in { "'", "\\", "\n" }
  THEN "'" \o Join(Each(Characters(s), EscapedCharacter), "") \o "'"
  ELSE "'" \o s \o "'"

RECURSIVE Zeros(_)
Zeros(n) == IF n <= 0 THEN "" ELSE "0" \o Zeros(n - 1)

(* How many decimals n/d has; more than 9 are not for this model. *)
RECURSIVE DecimalsFrom(_, _)
DecimalsFrom(d, k) ==
  CASE (10 ^ k) % d = 0 -> k
    [] k < 9 -> DecimalsFrom(d, k + 1)
    [] OTHER -> Assert(FALSE, "a number has too many decimals for this model to write it")

Decimals(d) == DecimalsFrom(d, 0)

(* n/d with its decimals, none if it is whole. *)
DecimalText(n, d) ==
  LET k == Decimals(d)
      whole == ToString(Abs(n) \div d)
      digits == ToString((Abs(n) % d) * ((10 ^ k) \div d))
      sign == IF n < 0 THEN "-" ELSE ""
  IN IF k = 0 THEN sign \o whole ELSE sign \o whole \o "." \o Zeros(k - Len(digits)) \o digits

NumberText(n, d) ==
  CASE n = 0 -> "0.0"
    [] d = 1 -> ToString(n) \o ".0"
    [] OTHER ->
         IF Assert(10000 * Abs(n) >= d, "a number is too small for this model to write it")
         THEN DecimalText(n, d) ELSE ""

(* Without a point if the number is whole, as labels show seconds: C's %g, with six digits or as many more as it
   takes. A million is 1e+06 there. *)
ShortText(x) ==
  LET n == Numerator(x)
      d == Denominator(x)
      isPlain == Abs(n) < 1000000 * d \/ Decimals(d) > 0 \/ n % 10 # 0
  IN IF Assert(isPlain, "a time is written with an exponent, which this model cannot") THEN DecimalText(n, d) ELSE ""

Parenthesised(needed, level, text) == IF level > needed THEN "(" \o text \o ")" ELSE text

(* Loosest first: |, >>, /, operands. *)
RECURSIVE Written(_, _)
RECURSIVE TaskText(_, _)
TaskText(t, level) ==
  CASE t.op = "platform" -> "task(" \o Quoted(t.name) \o ")"
    [] t.op = "action" -> "action { " \o LambdaNames[t.code[2]] \o " }"
    [] t.op = "condition" -> "condition { " \o LambdaNames[t.code[2]] \o " }"
    [] t.op = "par" -> Parenthesised(0, level, TaskText(t.left, 0) \o " | " \o TaskText(t.right, 1))
    [] t.op = "seq" -> Parenthesised(1, level, TaskText(t.left, 1) \o " >> " \o TaskText(t.right, 2))
    [] t.op = "on" -> TaskText(t.body, 3) \o "[" \o Join(t.vehicles, " + ") \o "]"
    [] t.op \in { "allOf", "oneOf" } ->
         LET branch(b) == "when { ... } then " \o TaskText(b.body, 1)
         IN t.op \o " { " \o Join(Each(t.branches, branch), ", ") \o " }"
    [] t.op = "until" ->
         LET name == IF t.fails = << >> THEN "until" ELSE "assure"
         IN Parenthesised(0, level, name \o " { ... } run " \o TaskText(t.body, 1))
    [] t.op = "idle" -> "idle(" \o ShortText(t.time) \o ".seconds)"
    [] t.op = "confirm" -> "confirm(" \o Quoted(t.prompt) \o ")"
    [] t.op = "during" ->
         LET time == IF Is(t.time, "closure") THEN "{ ... }" ELSE ShortText(t.time) \o ".seconds"
             name == IF t.fails = << >> THEN "during " ELSE "within "
         IN Parenthesised(0, level, name \o time \o " run " \o TaskText(t.body, 1))
    [] t.op = "watch" -> Parenthesised(0, level, "watch " \o TaskText(t.body, 1) \o " onError { ... }")
    [] t.op = "repeat" ->
         LET rounds == IF t.rounds = << >> THEN "" ELSE ToString(t.rounds[1]) \o ", "
             until == IF t.until = << >> THEN "" ELSE " until { ... }"
         IN Parenthesised(0, level, "repeat " \o rounds \o TaskText(t.body, 1) \o until)
    [] t.op = "recruit" -> Parenthesised(0, level, "recruit { ... } then { ... }")
    [] t.op = "fresh" -> "fresh { " \o LambdaNames[t.code[2]] \o " }"
    [] t.op = "made" -> "{ " \o LambdaNames[t.code[2]] \o " }"
    [] t.op = "ensure" ->
         LET deed(d) ==
               CASE d[1] = "post" -> "post " \o d[2] \o ": " \o Written(d[3], FALSE)
                 [] d[1] = "set" -> d[4] \o " = " \o Written(d[3], FALSE)
                 [] OTHER -> "giveBack()"
         IN TaskText(t.body, 3) \o " ensure { " \o Join(Each(t.ensured, deed), "; ") \o " }"

HasCorners(area) == area[3] = -1
NoComputing == Assert(FALSE, "this model cannot compute with areas")

AreaText(x) == IF HasCorners(x) THEN Places[x[2]] ELSE Places[x[2]] \o " ^ " \o ShortText(Number(x[3], x[4])) \o " m"

(* bare: strings without quotes, as message shows them. *)
Written(x, bare) ==
  CASE Is(x, "string") -> IF bare THEN x[2] ELSE Quoted(x[2])
    [] Is(x, "integer") -> ToString(x[2])
    [] Is(x, "number") -> NumberText(x[2], x[3])
    [] Is(x, "distance") ->
         Assert(FALSE, "a distance is known to the millimetre: this model cannot write it; round() it first")
    [] Is(x, "vehicles") -> IF Len(x[2]) = 1 THEN x[2][1] ELSE "[" \o Join(x[2], ", ") \o "]"
    [] Is(x, "null") -> "null"
    [] Is(x, "boolean") -> IF x[2] THEN "true" ELSE "false"
    [] Is(x, "wildcard") -> "_"
    [] Is(x, "symbol") -> x[2]
    [] Is(x, "list") -> LET item(y) == Written(y, bare) IN "[" \o Join(Each(x[2], item), ", ") \o "]"
    [] Is(x, "map") ->
         LET entry(e) == e[1] \o ":" \o Written(e[2], bare)
         IN IF x[2] = << >> THEN "[:]" ELSE "[" \o Join(Each(x[2], entry), ", ") \o "]"
    [] Is(x, "range") -> ToString(x[2]) \o ".." \o ToString(x[3])
    [] Is(x, "position") -> Places[x[2]]
    [] Is(x, "area") -> AreaText(x)
    [] Is(x, "task") -> TaskText(x[2], 0)
    [] Is(x, "closure") -> "{ " \o LambdaNames[x[2]] \o " }"
    [] Is(x, "host") -> "host object " \o x[2]
    [] Is(x, "settings") -> "{ ... }"
    [] Is(x, "reading") -> x[3]

Text(x) == Written(x, TRUE)
Literal(x) == Written(x, FALSE)

Kind(x) ==
  CASE Is(x, "null") -> "null"
    [] Is(x, "boolean") -> "a truth value"
    [] IsNumber(x) -> "a number"
    [] Is(x, "string") -> "a string"
    [] Is(x, "wildcard") -> "the wildcard _"
    [] Is(x, "symbol") -> "a unit"
    [] Is(x, "list") -> "a list"
    [] Is(x, "map") -> "a map"
    [] Is(x, "range") -> "a range"
    [] Is(x, "position") -> "a position"
    [] Is(x, "area") -> "an area"
    [] Is(x, "vehicles") -> "a vehicle set"
    [] Is(x, "task") -> "a task"
    [] Is(x, "closure") -> "a closure"
    [] Is(x, "host") -> "a host object"
    [] Is(x, "settings") -> "a block of settings"
    [] Is(x, "reading") ->
         CASE x[2] = "amount" -> "a number"
           [] x[2] = "place" -> "a position"
           [] x[2] = "region" -> "an area"
           [] x[2] = "words" -> "a string"

(* {1 Results of operations: a value, or a fault; or the value depends on sensors} *)

Ok(x) == << "ok", x >>
Bad(message) == << "wrong", message >>
Expected(what, x) == << "expected", what, x >>
Mismatch(op, x, y) == << "mismatch", op, x, y >>
IsOk(result) == result[1] = "ok"

(* The value is xs[i] if the i-th answer to the question is the one that is given. *)
Depends(question, xs) == << "depends", question, xs >>

(* It cannot be known. *)
Unsettled(text) == << "unsettled", text >>

Takes(op) ==
  CASE op = "/" -> "two numbers, or a task and a condition { ... }"
    [] op \in { "*", "%", "**" } -> "two numbers"
    [] op = "+" -> "numbers, strings, lists, maps, areas or vehicle sets"
    [] op = "-" -> "numbers, lists, areas or vehicle sets"
    [] op = ">>" -> "two tasks"
    [] op = "<<" -> "a list and an element"
    [] op \in { "<", "<=", ">", ">=" } -> "two numbers or two strings"
    [] op = "in" -> "a value, and a list, range, map, string, area or vehicle set"
    [] op = "&" -> "two vehicle sets or two areas"
    [] op = "^" -> "a position and a radius in metres"
    [] op = "|" -> "two tasks, or a vehicle set and a predicate { v -> ... }"
    [] OTHER -> "two values"

Found(x) ==
  IF x[1] \in { "null", "closure", "settings", "reading" } \/ Len(Text(x)) > 60 THEN Kind(x)
  ELSE Kind(x) \o ", " \o Literal(x)

(* The sentence of a result that is not a value. TLC looks through all operators that a definition can reach, once
   for each way there; so sentences are made here, and not where the trouble is. *)
Sentence(result) ==
  CASE result[1] = "wrong" -> result[2]
    [] result[1] = "expected" -> "expected " \o result[2] \o ", found " \o Found(result[3])
    [] result[1] = "mismatch" ->
         result[2] \o " takes " \o Takes(result[2]) \o ", not " \o Kind(result[3]) \o " and " \o Kind(result[4])

(* {1 Items} *)

RangeItem(x, i) == IF x[2] <= x[3] THEN x[2] + i - 1 ELSE x[2] - i + 1
RangeLength(x) == Abs(x[3] - x[2]) + 1
HasItems(x) == x[1] \in { "list", "range", "vehicles", "map", "string" }

(* The elements of a loop over x. *)
Items(x) ==
  CASE Is(x, "list") -> x[2]
    [] Is(x, "range") -> << >> \o [ i \in 1 .. RangeLength(x) |-> Integer(RangeItem(x, i)) ]
    [] Is(x, "vehicles") -> LET single(v) == Vehicles(<< v >>) IN Each(x[2], single)
    [] Is(x, "map") ->
         LET entry(e) == << "map", << << "key", String(e[1]) >>, << "value", e[2] >> >> >> IN Each(x[2], entry)
    [] Is(x, "string") -> Each(Characters(x[2]), String)

Length(x) == IF Is(x, "range") THEN RangeLength(x) ELSE IF Is(x, "string") THEN Len(x[2]) ELSE Len(x[2])

(* {1 Operators} *)

Union(vs, ws) == vs \o SelectSeq(ws, LAMBDA w : w \notin Range(vs))
Difference(vs, ws) == SelectSeq(vs, LAMBDA v : v \notin Range(ws))
Intersection(vs, ws) == SelectSeq(vs, LAMBDA v : v \in Range(ws))

(* Two integers give an integer, other numbers a number that is not an integer. *)
Arithmetic(op, x, y, OnIntegers(_, _), OnNumbers(_, _)) ==
  CASE Is(x, "integer") /\ Is(y, "integer") -> OnIntegers(x[2], y[2])
    [] IsNumber(x) /\ IsNumber(y) -> OnNumbers(x, y)
    [] OTHER -> Mismatch(op, x, y)

AddFractions(x, y) ==
  Number(Numerator(x) * Denominator(y) + Numerator(y) * Denominator(x), Denominator(x) * Denominator(y))

Negated(x) == IF Is(x, "integer") THEN Integer(-x[2]) ELSE Number(-Numerator(x), Denominator(x))

RECURSIVE RaisedTo(_, _)
RaisedTo(x, n) ==
  IF n = 0 THEN Number(1, 1)
  ELSE LET y == RaisedTo(x, n - 1) IN Number(Numerator(x) * y[2], Denominator(x) * y[3])

Power(x, y) ==
  IF Assert(Denominator(y) = 1 /\ Numerator(y) >= 0, "** is translated for whole exponents from 0")
  THEN RaisedTo(x, Numerator(y)) ELSE Null

Add(x, y) ==
  CASE Is(x, "string") \/ Is(y, "string") -> Ok(String(Text(x) \o Text(y)))
    [] Is(x, "vehicles") /\ Is(y, "vehicles") -> Ok(Vehicles(Union(x[2], y[2])))
    [] Is(x, "list") /\ Is(y, "list") -> Ok(List(x[2] \o y[2]))
    [] Is(x, "list") -> Ok(List(Append(x[2], y)))
    [] Is(x, "map") /\ Is(y, "map") -> Ok(<< "map", PutAll(x[2], y[2]) >>)
    [] OTHER -> Arithmetic("+", x, y, LAMBDA a, b : Ok(Integer(a + b)), LAMBDA a, b : Ok(AddFractions(a, b)))

Subtract(x, y) ==
  CASE Is(x, "vehicles") /\ Is(y, "vehicles") -> Ok(Vehicles(Difference(x[2], y[2])))
    [] Is(x, "list") /\ Is(y, "list") ->
         Ok(List(SelectSeq(x[2], LAMBDA a : ~\E i \in DOMAIN y[2] : Equals(a, y[2][i]))))
    [] OTHER -> Arithmetic("-", x, y, LAMBDA a, b : Ok(Integer(a - b)), LAMBDA a, b : Ok(AddFractions(a, Negated(b))))

Multiply(x, y) ==
  Arithmetic("*", x, y, LAMBDA a, b : Ok(Integer(a * b)),
    LAMBDA a, b : Ok(Number(Numerator(a) * Numerator(b), Denominator(a) * Denominator(b))))

(* Code in the place of a task is the task that it makes. *)
IsTask(x) == Is(x, "task") \/ Is(x, "closure")
TaskOf(x) == IF Is(x, "closure") THEN [ op |-> "made", code |-> x ] ELSE x[2]

Divide(x, y) ==
  CASE IsTask(x) /\ Is(y, "closure") ->
         Ok(TaskValue([ op |-> "until", guard |-> y, fails |-> << >>, body |-> TaskOf(x) ]))
    [] IsNumber(x) /\ IsNumber(y) /\ Numerator(y) = 0 -> Bad("division by zero")
    [] Is(x, "integer") /\ Is(y, "integer") /\ x[2] % Abs(y[2]) = 0 -> Ok(Integer(Truncated(x[2], y[2])))
    [] IsNumber(x) /\ IsNumber(y) ->
         LET n == Numerator(x) * Denominator(y)
             d == Denominator(x) * Numerator(y)
         IN Ok(IF d < 0 THEN Number(-n, -d) ELSE Number(n, d))
    [] OTHER -> Mismatch("/", x, y)

(* The remainder has the sign of the dividend. *)
Remainder(x, y) ==
  CASE IsNumber(x) /\ IsNumber(y) /\ Numerator(y) = 0 -> Bad("remainder of a division by zero")
    [] Is(x, "integer") /\ Is(y, "integer") -> Ok(Integer(x[2] - y[2] * Truncated(x[2], y[2])))
    [] IsNumber(x) /\ IsNumber(y) ->
         LET a == Numerator(x) * Denominator(y)
             b == Numerator(y) * Denominator(x)
         IN Ok(Number(a - b * Truncated(a, b), Denominator(x) * Denominator(y)))
    [] OTHER -> Mismatch("%", x, y)

(* Places to a millimetre's accuracy: the rim belongs to the area. *)
Within(area, place) ==
  IF HasCorners(area) THEN Distances[area[2]][place] = 0
  ELSE (Distances[area[2]][place] - 1) * area[4] <= 1000 * area[3]

Contains(text, part) ==
  \E i \in 1 .. Len(text) - Len(part) + 1 : SubSeq(text, i, i + Len(part) - 1) = part

Member(x, y) ==
  CASE Is(y, "list") -> Ok(Boolean(\E i \in DOMAIN y[2] : Equals(x, y[2][i])))
    [] Is(y, "range") ->
         LET i == Canonical(x)
             low == Minimum({ y[2], y[3] })
         IN Ok(Boolean(Is(i, "integer") /\ low <= i[2] /\ i[2] <= low + Abs(y[3] - y[2])))
    [] Is(y, "map") -> Ok(Boolean(HasKey(y[2], Text(x))))
    [] Is(y, "vehicles") /\ Is(x, "vehicles") -> Ok(Boolean(Range(x[2]) \subseteq Range(y[2])))
    [] Is(y, "area") /\ Is(x, "position") -> Ok(Boolean(Within(y, x[2])))
    [] Is(y, "string") /\ Is(x, "string") -> Ok(Boolean(Contains(y[2], x[2])))
    [] OTHER -> Mismatch("in", x, y)

(* Strings are compared for equality only: TLA+ has no order of characters. *)
Compared(op, x, y) ==
  IF IsNumber(x) /\ IsNumber(y)
  THEN LET c == CompareNumbers(x, y)
       IN Ok(Boolean(CASE op = "<" -> c < 0 [] op = "<=" -> c <= 0 [] op = ">" -> c > 0 [] op = ">=" -> c >= 0))
  ELSE IF Is(x, "string") /\ Is(y, "string")
  THEN Assert(FALSE, "this model cannot order strings")
  ELSE Mismatch(op, x, y)

AppendTo(x, y) == IF Is(x, "list") THEN Ok(List(Append(x[2], y))) ELSE Mismatch("<<", x, y)

Around(x, y) ==
  IF Is(x, "position") /\ IsNumber(y)
  THEN IF Numerator(y) < 0 THEN Bad("a radius is 0 m or more, not " \o ShortText(y))
       ELSE Ok(<< "area", x[2], Numerator(y), Denominator(y) >>)
  ELSE Mismatch("^", x, y)

Binary(op, x, y) ==
  CASE op \in { "+", "-", "&" } /\ Is(x, "area") /\ Is(y, "area") -> Bad(NoComputing)
    [] op = "+" -> Add(x, y)
    [] op = "-" -> Subtract(x, y)
    [] op = "==" -> Ok(Boolean(Equals(x, y)))
    [] op = "!=" -> Ok(Boolean(~Equals(x, y)))
    [] op \in { "<", "<=", ">", ">=" } -> Compared(op, x, y)
    [] op = ">>" ->
         IF IsTask(x) /\ IsTask(y) THEN Ok(TaskValue([ op |-> "seq", left |-> TaskOf(x), right |-> TaskOf(y) ]))
         ELSE Mismatch(op, x, y)
    [] op = "|" ->
         CASE IsTask(x) /\ IsTask(y) -> Ok(TaskValue([ op |-> "par", left |-> TaskOf(x), right |-> TaskOf(y) ]))
           [] Is(x, "boolean") /\ Is(y, "boolean") -> Ok(Boolean(x[2] \/ y[2]))
           [] OTHER -> Mismatch(op, x, y)
    [] op = "/" -> Divide(x, y)
    [] op = "*" -> Multiply(x, y)
    [] op = "%" -> Remainder(x, y)
    [] op = "**" ->
         Arithmetic(op, x, y, LAMBDA a, b : Ok(Integer(Power(Integer(a), Integer(b))[2])),
                    LAMBDA a, b : Ok(Power(a, b)))
    [] op = "<<" -> AppendTo(x, y)
    [] op = "in" -> Member(x, y)
    [] op = "&" ->
         CASE Is(x, "vehicles") /\ Is(y, "vehicles") -> Ok(Vehicles(Intersection(x[2], y[2])))
           [] Is(x, "boolean") /\ Is(y, "boolean") -> Ok(Boolean(x[2] /\ y[2]))
           [] OTHER -> Mismatch(op, x, y)
    [] op = "^" -> Around(x, y)
    [] op = "&&" -> Ok(Boolean(Truth(x) /\ Truth(y)))
    [] op = "||" -> Ok(Boolean(Truth(x) \/ Truth(y)))

Unary(op, x) ==
  CASE op = "!" -> Ok(Boolean(~Truth(x)))
    [] op = "-" -> IF IsNumber(x) THEN Ok(Negated(x)) ELSE Expected("a number after -", x)

(* The place of index i of the language, from 0 or backwards from -1, in a sequence of that length; 0 if outside. *)
PlaceOf(length, i) ==
  LET j == IF i < 0 THEN length + i ELSE i
  IN IF 0 <= j /\ j < length THEN j + 1 ELSE 0

OutOfRange(i, what, length) ==
  Bad("index " \o ToString(i) \o " is out of range: " \o what \o " has " \o ToString(length) \o " elements")

Element(x, index) ==
  LET i == Canonical(index)
      place == PlaceOf(Length(x), i[2])
  IN CASE IsTask(x) ->
            IF Is(i, "vehicles") THEN Ok(TaskValue([ op |-> "on", body |-> TaskOf(x), vehicles |-> i[2] ]))
            ELSE Expected("a vehicle set between [ and ] after a task", i)
       [] Is(x, "map") -> Ok(IF HasKey(x[2], Text(i)) THEN Lookup(x[2], Text(i)) ELSE Null)
       [] HasItems(x) /\ Is(i, "integer") ->
            IF place = 0 THEN OutOfRange(i[2], Kind(x), Length(x)) ELSE Ok(Items(x)[place])
       [] HasItems(x) -> Expected("a whole number as index", i)
       [] OTHER -> Expected("a list, a map or a task before [", x)

ReplaceElement(x, index, y) ==
  LET i == Canonical(index)
      place == PlaceOf(Len(x[2]), i[2])
  IN CASE Is(x, "list") /\ Is(i, "integer") ->
            CASE place # 0 -> Ok(List(With(x[2], place, y)))
              [] i[2] = Len(x[2]) -> Ok(List(Append(x[2], y)))
              [] OTHER -> OutOfRange(i[2], "the list", Len(x[2]))
       [] Is(x, "map") -> Ok(<< "map", Put(x[2], Text(i), y) >>)
       [] OTHER -> Expected("a list or a map to assign an element of", x)

MakeRange(first, last, inclusive) ==
  LET a == Canonical(first)
      b == Canonical(last)
  IN CASE ~Is(a, "integer") -> Expected("a whole number as end of a range", a)
       [] ~Is(b, "integer") -> Expected("a whole number as end of a range", b)
       [] inclusive -> Ok(<< "range", a[2], b[2] >>)
       [] a[2] = b[2] -> Ok(List(<< >>))
       [] OTHER -> Ok(<< "range", a[2], IF a[2] < b[2] THEN b[2] - 1 ELSE b[2] + 1 >>)

(* Metres, seconds, degrees, and parts of one. *)
Unit(name) ==
  CASE name \in { "m", "meter", "meters", "metre", "metres", "second", "seconds", "sec", "degree", "degrees", "north",
                  "east" } -> << 1, 1 >>
    [] name \in { "km", "kilometer", "kilometers", "kilometre", "kilometres" } -> << 1000, 1 >>
    [] name \in { "ms", "milliseconds" } -> << 1, 1000 >>
    [] name \in { "min", "minute", "minutes" } -> << 60, 1 >>
    [] name \in { "hour", "hours" } -> << 3600, 1 >>
    [] name \in { "day", "days" } -> << 86400, 1 >>
    [] name \in { "south", "west" } -> << -1, 1 >>
    [] name = "percent" -> << 1, 100 >>
    [] name \in { "nauticalMile", "nauticalMiles" } -> << 1852, 1 >>
    [] name \in { "foot", "feet" } -> << 381, 1250 >>
    [] name \in { "fathom", "fathoms" } -> << 1143, 625 >>
    [] name \in { "knot", "knots" } -> << 463, 900 >>
    [] OTHER -> << 0, 0 >>

InUnit(x, name) ==
  LET unit == Unit(name)
  IN CASE unit[2] = 0 -> Bad("a number has no unit '" \o name \o "'")
       [] Is(x, "integer") /\ unit[2] = 1 -> Ok(Integer(x[2] * unit[1]))
       [] OTHER -> Ok(Number(Numerator(x) * unit[1], Denominator(x) * unit[2]))

(* {1 Readings} *)

(* A reading is known by its text: how it was got, or where it is kept. It may be handed on, computed with, compared
   and printed. Of a comparison either outcome is possible, the same wherever the same texts are compared in the same
   way; the outcomes of any other use cannot be listed. *)

Reading(quantity, text) == << "reading", quantity, text >>
IsReading(x) == Is(x, "reading")
IsReadingOf(x, quantity) == IsReading(x) /\ x[2] = quantity

IsAmount(x) == IsNumber(x) \/ IsReadingOf(x, "amount")
IsPlace(x) == Is(x, "position") \/ IsReadingOf(x, "place")
IsRegion(x) == Is(x, "area") \/ IsReadingOf(x, "region")
IsWords(x) == Is(x, "string") \/ IsReadingOf(x, "words")

IsA(form, x) ==
  CASE form = "number" -> IsAmount(x)
    [] form = "string" -> IsWords(x)
    [] form = "list" -> Is(x, "list") \/ Is(x, "range")
    [] OTHER -> Is(x, "map")

(* In the text of a comparison; as an operand of an operator in it. *)
Spelled(x) == IF IsReading(x) THEN x[3] ELSE Literal(Canonical(x))
Enclosed(text) == IF Contains(text, " ") THEN "(" \o text \o ")" ELSE text
SpelledBinary(op, x, y) == Enclosed(Spelled(x)) \o " " \o op \o " " \o Enclosed(Spelled(y))

Mirrored(op) == CASE op = "<" -> ">" [] op = ">" -> "<" [] OTHER -> op

(* The question whether a comparison holds, answered by 1 or 2; of an operand with a number, it has these, too. *)
ComparisonOf(op, x, y) ==
  LET text == SpelledBinary(op, x, y)
      isKnown(z) == z[1] \in { "integer", "number" }
  IN CASE isKnown(y) -> << "claim", text, Enclosed(Spelled(x)), op, y >>
       [] isKnown(x) -> << "claim", text, Enclosed(Spelled(y)), Mirrored(op), x >>
       [] OTHER -> << "claim", text >>

(* The bounds from below, and from above, of what is compared, each with whether it is among the values. *)
LowerBounds(claim, answer) ==
  CASE << claim[4], answer >> \in { << "<", 2 >>, << "==", 1 >> } -> { << claim[5], TRUE >> }
    [] << claim[4], answer >> = << ">", 1 >> -> { << claim[5], FALSE >> }
    [] OTHER -> { }
UpperBounds(claim, answer) ==
  CASE << claim[4], answer >> \in { << ">", 2 >>, << "==", 1 >> } -> { << claim[5], TRUE >> }
    [] << claim[4], answer >> = << "<", 1 >> -> { << claim[5], FALSE >> }
    [] OTHER -> { }

(* No number has both answers. *)
Contradict(claim, answer, other, otherAnswer) ==
  /\ Len(claim) = 5 /\ Len(other) = 5
  /\ claim[3] = other[3]
  /\ \E least \in LowerBounds(claim, answer) \cup LowerBounds(other, otherAnswer) :
       \E most \in UpperBounds(claim, answer) \cup UpperBounds(other, otherAnswer) :
         \/ Less(most[1], least[1])
         \/ ~Less(least[1], most[1]) /\ ~(least[2] /\ most[2])

(* A comparison that holds, or does not; its opposite. *)
Holds(op, x, y) == Depends(ComparisonOf(op, x, y), << True, False >>)
HoldsNot(op, x, y) == Depends(ComparisonOf(op, x, y), << False, True >>)

AnyMore(xs) == Unsettled(Join(Each(SelectSeq(xs, IsReading), Spelled), ", "))

BinaryOnReadings(op, x, y) ==
  LET amounts == IsAmount(x) /\ IsAmount(y)
      computed(quantity) == Ok(Reading(quantity, SpelledBinary(op, x, y)))
      isNumber == ~IsReading(y) /\ IsNumber(y)
  IN CASE op \in { "<", ">" } /\ amounts -> Holds(op, x, y)
       [] op = ">=" /\ amounts -> HoldsNot("<", x, y)
       [] op = "<=" /\ amounts -> HoldsNot(">", x, y)
       [] op = "==" -> Holds(op, x, y)
       [] op = "!=" -> HoldsNot("==", x, y)
       [] op = "in" /\ IsPlace(x) /\ IsRegion(y) -> Holds(op, x, y)
       [] op = "+" /\ (IsWords(x) \/ IsWords(y)) -> Ok(Reading("words", Text(x) \o Text(y)))
       [] op \in { "+", "-", "*" } /\ amounts -> computed("amount")
       [] op = "/" /\ amounts /\ isNumber -> IF Numerator(y) = 0 THEN Bad("division by zero") ELSE computed("amount")
       [] op = "^" /\ IsPlace(x) /\ isNumber /\ ~Less(y, Integer(0)) -> computed("region")
       [] OTHER -> AnyMore(<< x, y >>)

Coordinates ==
  { "latitude", "lat", "longitude", "lon", "height", "getLatitude", "getLat", "getLongitude", "getLon", "getHeight" }

(* They make a number of each number. *)
Roundings == { "abs", "round", "intValue", "toInteger", "doubleValue", "toDouble" }

MethodOnReadings(name, xs) ==
  LET x == xs[1]
      y == xs[2]
      alone == Len(xs) = 1
      two == Len(xs) = 2
      amount(text) == Ok(Reading("amount", text))
  IN CASE alone /\ IsPlace(x) /\ name \in Coordinates -> amount(Spelled(x) \o "." \o name)
       [] alone /\ IsAmount(x) /\ name \in Roundings -> amount(Enclosed(Spelled(x)) \o "." \o name \o "()")
       [] two /\ name = "round" /\ IsAmount(x) /\ Is(y, "integer") ->
            amount(Enclosed(Spelled(x)) \o ".round(" \o ToString(y[2]) \o ")")
       [] two /\ name \in { "distance", "distanceTo", "bearing", "bearingTo" } /\ IsPlace(x) /\ IsPlace(y) ->
            amount(Spelled(x) \o "." \o name \o "(" \o Spelled(y) \o ")")
       [] two /\ name = "contains" -> BinaryOnReadings("in", y, x)
       [] two /\ name = "equals" -> BinaryOnReadings("==", x, y)
       [] OTHER -> AnyMore(xs)

MathematicsOnReadings(name, xs) ==
  IF name \in { "abs", "round", "floor", "ceil", "min", "max" } /\ \A i \in DOMAIN xs : IsAmount(xs[i])
  THEN Ok(Reading("amount", "Math." \o name \o "(" \o Join(Each(xs, Spelled), ", ") \o ")"))
  ELSE AnyMore(xs)
==============================================================================
