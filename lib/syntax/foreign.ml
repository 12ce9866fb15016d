open Grammar

let advice = function
  | "try" -> Some "errors of tasks are handled by watch task onError { error -> ... }"
  | "switch" -> Some "write if (...) { } else if (...) { } else { }"
  | "class" | "interface" | "enum" -> Some "a map [name: value] holds what belongs together"
  | "import" | "package" -> Some "everything there is can be used as it is"
  | "new" -> Some "write a map [name: value], or call a function"
  | "throw" -> Some "write halt 'reason'"
  | "do" -> Some "write while (...) { }"
  | "void" | "final" | "static" | "public" | "private" -> Some "variables and functions begin with def"
  | "function" | "fun" | "func" -> Some "functions begin with def: def f(x) { ... }"
  | "as" -> Some "x.toString(), x.toInteger(), x.toDouble() and xs.toList() convert"
  | "instanceof" -> Some "values have no types that a program can ask for"
  | _ -> None

let is_word word = advice word <> None

(* Whether a word is followed as only the construct of that name is. *)
let is_used word following =
  match word, following with
  | ("try" | "do"), (TRAILING | BLOCK) -> true
  | "switch", LPAREN -> true
  | ("class" | "interface" | "enum" | "import" | "package" | "new"), (NAME _ | COMMAND _) -> true
  | "throw", (NAME _ | COMMAND _ | STRING _ | TEMPLATE_OPEN) -> true
  | ("function" | "fun" | "func"), (NAME _ | COMMAND _) -> true
  | ("void" | "final" | "static" | "public" | "private"), (NAME _ | COMMAND _ | DEF) -> true
  | ("as" | "instanceof"), NAME _ -> true
  | _ -> false

let advice_for_new (tokens : Token.t array) i word =
  match word, tokens.(i + 1).token with
  | "new", (NAME ("Position" | "Location") | COMMAND ("Position" | "Location")) ->
    Some "a position is location(41.18, -8.70), or pos { lat 41.18; lon 8.70.west; height 100 }"
  | _, _ -> None

let faults (tokens : Token.t array) =
  let found = ref [] in
  let look i (token : Token.t) =
    match token.token with
    | NAME word | COMMAND word when i + 1 < Array.length tokens && is_used word tokens.(i + 1).token ->
      let is_member = i > 0 && (match tokens.(i - 1).token with DOT | SAFE_DOT | DEF -> true | _ -> false) in
      begin match advice word with
        | Some hint when not is_member ->
          let hint = Option.value (advice_for_new tokens i word) ~default:hint in
          let message = Printf.sprintf "this language has no '%s'" word in
          found := Diagnostic.error (Token.at token) message ~hint :: !found
        | Some _ | None -> ()
      end
    | _ -> ()
  in
  Array.iteri look tokens;
  List.rev !found
