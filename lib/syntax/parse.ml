open Grammar
module Machine = Grammar.MenhirInterpreter

let most_faults = 20

(* {1 One run of the parser} *)

type 'a outcome =
  | Accepted of 'a
  | Stuck of { index : int; before : 'a Machine.checkpoint }    (* [before] waits for token [index] *)

(* Runs the parser on the tokens from [first] up to [stop], in place of which stands the end. *)
let run start (tokens : Token.t array) first stop =
  let token index =
    let token = tokens.(index) in
    if index = stop then EOF, token.start, token.start else token.token, token.start, token.stop in
  let rec go checkpoint before index =
    match checkpoint with
    | Machine.InputNeeded _ -> go (Machine.offer checkpoint (token index)) checkpoint (index + 1)
    | Machine.Shifting _ | Machine.AboutToReduce _ -> go (Machine.resume checkpoint) before index
    | Machine.Accepted value -> Accepted value
    | Machine.HandlingError _ | Machine.Rejected -> Stuck { index = index - 1; before }
  in
  let checkpoint = start tokens.(first).start in
  go checkpoint checkpoint first

(* {1 Recovery after a fault} *)

(* The brackets of arranged tokens. *)
type nesting = {
  partner : int array;
  outside : int array;
  (* The brace that encloses a token, itself excluded; -1 at the top. For a [;] that stands wrong, -2. *)
}

let nesting (tokens : Token.t array) =
  let length = Array.length tokens in
  let partner = Array.make length (-1) and outside = Array.make length (-1) in
  let brace openers = match openers with [] -> -1 | (brace, _) :: _ -> brace in
  let step index openers =
    match tokens.(index).token with
    | LBRACE | TRAILING | BLOCK ->
      outside.(index) <- brace openers;
      (index, index) :: openers
    | LPAREN | LBRACKET | HOLE_OPEN ->
      outside.(index) <- brace openers;
      (brace openers, index) :: openers
    | RPAREN | RBRACKET | HOLE_CLOSE | RBRACE ->
      outside.(index) <- brace openers;
      begin match openers with
        | [] -> []
        | (_, opener) :: rest ->
          partner.(opener) <- index;
          rest
      end
    | SEPARATOR ->
      outside.(index) <- (match openers with (brace, opener) :: _ when brace <> opener -> -2 | _ -> brace openers);
      openers
    | _ ->
      outside.(index) <- brace openers;
      openers
  in
  let rec go index openers = if index < length then go (index + 1) (step index openers) in
  go 0 [];
  { partner; outside }

(* The stretches of whole statements after the fault at [index], within the stretch that ends at [stop]:
   the rest of the innermost statements, then the rest of those around them, and so on. *)
let stretches (tokens : Token.t array) { partner; outside } index stop =
  let last brace = if brace < 0 then Array.length tokens - 1 else partner.(brace) in
  let rec separator index brace =
    if index >= last brace then None
    else if tokens.(index).token = SEPARATOR && outside.(index) = brace
            && not (Layout.continues tokens.(index + 1).token) then Some index
    else separator (index + 1) brace
  in
  let rec climb index brace reversed =
    let last = last brace in
    let reversed =
      match separator index brace with
      | Some found when found < stop -> (found + 1, min last stop) :: reversed
      | Some _ | None -> reversed in
    if brace < 0 || last >= stop then List.rev reversed
    else climb (last + 1) outside.(brace) reversed
  in
  let rec home index = if outside.(index) = -2 then home (index - 1) else outside.(index) in
  climb index (home index) []

let statement_faults ~source tokens index acceptable =
  let nesting = nesting tokens in
  let rec go faults count = function
    | [] -> faults
    | _ when count >= most_faults -> faults
    | (first, stop) :: rest ->
      match run Incremental.program tokens first stop with
      | Accepted program -> go (List.rev_append (Well_formed.program program) faults) count rest
      | Stuck { index; before } ->
        let acceptable token = Machine.acceptable before token tokens.(index).start in
        let fault = Explain.fault ~source ~tokens ~index ~acceptable in
        go (fault :: faults) (count + 1) (stretches tokens nesting index stop @ rest)
  in
  let stop = Array.length tokens - 1 in
  go [ Explain.fault ~source ~tokens ~index ~acceptable ] 1 (stretches tokens nesting index stop)

(* {1 All together} *)

let rec take n = function
  | x :: rest when n > 0 -> x :: take (n - 1) rest
  | _ -> []

(* Of several faults, those that are not mere consequences of others: the grammar's faults on a line with a misspelt
   token, or after a bracket without a partner or a foreign construct, are not reported. *)
let select ~scanned ~structure ~parsed =
  let line (d : Diagnostic.t) = Location.line d.at in
  let spoilt = Hashtbl.create 16 in
  List.iter (fun d -> Hashtbl.replace spoilt (line d) ()) scanned;
  let unspoilt = List.filter (fun d -> not (Hashtbl.mem spoilt (line d))) in
  let parsed =
    match structure with
    | [] -> parsed
    | first :: others ->
      let first = List.fold_left (fun a b -> if Diagnostic.compare b a < 0 then b else a) first others in
      List.filter (fun d -> Diagnostic.compare d first < 0 && line d <> line first) parsed in
  take most_faults (List.sort_uniq Diagnostic.compare (scanned @ unspoilt structure @ unspoilt parsed))

let read ~file source start shape faults_from =
  match Text.fault ~file source with
  | Some fault -> Result.Error [ fault ]
  | None ->
    let { Scanner.tokens; faults = scanned } = Scanner.scan ~file source in
    match Brackets.match_up (Array.of_list tokens) with
    | Result.Error fault -> Result.Error (select ~scanned ~structure:[ fault ] ~parsed:[])
    | Ok matched ->
      let tokens = Layout.arrange ~source matched in
      (* After one of these, the grammar's faults are of no use. *)
      let structure = matched.faults @ Foreign.faults tokens in
      match run start tokens 0 (Array.length tokens - 1) with
      | Accepted result ->
        begin match select ~scanned ~structure ~parsed:(shape result) with
          | [] -> Ok result
          | faults -> Result.Error faults
        end
      | Stuck { index; before } ->
        let acceptable token = Machine.acceptable before token tokens.(index).start in
        Result.Error (select ~scanned ~structure ~parsed:(faults_from ~source tokens index acceptable))

let program ~file source = read ~file source Incremental.program Well_formed.program statement_faults

let expression ~file source =
  let fault ~source tokens index acceptable = [ Explain.fault ~source ~tokens ~index ~acceptable ] in
  read ~file source Incremental.answer Well_formed.expression fault
