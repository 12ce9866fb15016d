open Grammar

let tokens =
  [ "_", WILDCARD; "true", TRUE; "false", FALSE; "null", NULL;
    "def", DEF; "if", IF; "else", ELSE; "while", WHILE; "for", FOR; "in", IN;
    "return", RETURN; "break", BREAK; "continue", CONTINUE;
    "when", WHEN; "watch", WATCH; "waitFor", WAIT_FOR; "repeat", REPEAT;
    "until", UNTIL Completes; "assure", UNTIL Fails; "during", DURING Completes; "within", DURING Fails;
    "then", THEN; "run", RUN; "onError", ON_ERROR;
    "ensure", ENSURE; "using", USING ]

let table =
  let table = Hashtbl.create 64 in
  let add (word : Construct.word) =
    if Construct.is_reserved word then
      Option.iter (fun token -> Hashtbl.replace table token word) (List.assoc_opt word.spelling tokens) in
  List.iter add Construct.words;
  table

let find = function
  | NAME _ | INTEGER _ | NUMBER _ | STRING _ | TEXT _ | COMMAND _ -> None
  | AFTER_UNTIL -> Hashtbl.find_opt table (UNTIL Completes)
  | AFTER_ASSURE -> Hashtbl.find_opt table (UNTIL Fails)
  | AFTER_DURING on_cut -> Hashtbl.find_opt table (DURING on_cut)
  | token -> Hashtbl.find_opt table token

let place token =
  match token, find token with
  | (AFTER_UNTIL | AFTER_ASSURE | AFTER_DURING _), _ -> Some Construct.Limits
  | _, Some word -> Some word.place
  | _, None -> None

let is_word token =
  match place token with
  | Some (Begins | Limits | Begins_or_limits | Joins | Control | Defines) -> true
  | Some (Declares | Constant | Procedure | Task_procedure | Block) | None -> false

let continues token = match place token with Some (Joins | Limits) -> true | Some _ | None -> false
let begins_task token = match place token with Some (Begins | Begins_or_limits) -> true | Some _ | None -> false

(* [{] follows the word in its form. *)
let has_code (word : Construct.word) =
  let before = word.spelling ^ " {" in
  let n = String.length before in
  let rec from i = i + n <= String.length word.form && (String.sub word.form i n = before || from (i + 1)) in
  from 0

let takes_code token = match find token with Some word -> has_code word | None -> false
